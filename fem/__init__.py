"""Plane-strain finite elements: surface compliance, stresses, a second contact solver."""
