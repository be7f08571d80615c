"""Stresses from displacements: recovery, kinks, maxima, error indicator."""
