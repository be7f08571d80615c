"""Look of pictures, and how they become part of a page."""
