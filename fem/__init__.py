"""Plane-strain finite elements on dolfinx: compliance of the surface, stresses, a second contact solver."""
