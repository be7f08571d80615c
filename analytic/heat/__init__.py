"""Heat conduction in half-spaces, and the flash temperature of sliding contacts."""
