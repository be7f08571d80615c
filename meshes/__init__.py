"""Graded meshes of the rough body: built by gmsh, checked, stored."""
