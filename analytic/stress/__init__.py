"""Stresses in a half-plane under a line of pressure and traction elements."""
