"""How pictures look, and how they become part of a page."""
