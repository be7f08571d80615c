"""Closed-form solutions, one module each, with their source."""
