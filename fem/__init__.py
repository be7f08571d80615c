"""Plane-strain finite elements: surface compliance, stresses, a second contact solver."""

import os

# PETSc's own handlers turn a closed pipe (`crosscheck run … | head`) into an abort of all ranks;
# without them Python reports it as an error. It must be said before PETSc is first imported.
_QUIET = "-no_signal_handler"
if _QUIET not in os.environ.get("PETSC_OPTIONS", ""):
    os.environ["PETSC_OPTIONS"] = f"{os.environ.get('PETSC_OPTIONS', '')} {_QUIET}".strip()
