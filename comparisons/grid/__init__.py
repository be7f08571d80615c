"""Grids of scenes: many points, one table; swept fields, and maps over two groups."""
