"""Scenes, checked, and their surfaces; `library/` holds the shipped scenes."""
