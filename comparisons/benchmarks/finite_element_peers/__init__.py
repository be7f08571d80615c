"""Contact on finite elements beside CalculiX."""
