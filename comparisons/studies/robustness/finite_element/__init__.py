"""Stiff and extreme cases of the finite-element side."""
