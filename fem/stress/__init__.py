"""Stresses from displacements: recovery, error, kinks, maxima."""
