"""Plane-strain finite elements: surface compliance, stresses, an independent contact solver."""

import os

from meshes.build import LAUNCHER_VARIABLES

# PETSc's signal handlers turn a closed pipe (`crosscheck run … | head`) into an abort;
# without them Python reports an error. PETSc reads the option at its first import.
_QUIET = "-no_signal_handler"
if _QUIET not in os.environ.get("PETSC_OPTIONS", ""):
    os.environ["PETSC_OPTIONS"] = f"{os.environ.get('PETSC_OPTIONS', '')} {_QUIET}".strip()

# One process solves a body. What srun or mpirun set for it would make it, and all that it forks,
# the same rank of a job.
if any(name.startswith(("OMPI_COMM_", "PMI_", "PMIX_")) for name in os.environ):
    for _name in [name for name in os.environ if name.startswith(LAUNCHER_VARIABLES)]:
        del os.environ[_name]
# It needs neither Open MPI's daemon nor its search for fast networks, which take a third of a
# second. Open MPI reads these when MPI begins; what the user set stays.
os.environ.setdefault("OMPI_MCA_ess_singleton_isolated", "1")
os.environ.setdefault("OMPI_MCA_pml", "ob1")
