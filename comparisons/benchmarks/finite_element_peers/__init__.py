"""Contact on finite elements beside general finite-element codes."""
