"""Processes, compilation of forms, factorisations by MUMPS."""
