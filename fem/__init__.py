"""Plane-strain finite elements: surface compliance, stresses, an independent contact solver."""

import os

# PETSc's signal handlers turn a closed pipe (`crosscheck run … | head`) into an abort of all ranks;
# without them Python reports an error. PETSc reads the option at its first import.
_QUIET = "-no_signal_handler"
if _QUIET not in os.environ.get("PETSC_OPTIONS", ""):
    os.environ["PETSC_OPTIONS"] = f"{os.environ.get('PETSC_OPTIONS', '')} {_QUIET}".strip()
