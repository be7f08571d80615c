"""Stresses from displacements: recovery, kinks, maxima."""
