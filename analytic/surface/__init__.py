"""Rough surfaces: reading, filtering, measuring and making them."""
