"""What solves: processes, compiled forms, factorisations by MUMPS."""
