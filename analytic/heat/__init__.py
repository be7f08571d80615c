"""Heat conduction in half-spaces and slabs, and the flash temperature of sliding contacts."""
