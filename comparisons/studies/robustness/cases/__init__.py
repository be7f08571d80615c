"""Stiff and extreme cases of the half-plane side."""
