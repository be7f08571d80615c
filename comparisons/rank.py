"""Which of several processes speaks and writes, where mpirun starts the command more than once."""

import os

# the number of the process, as Open MPI, MPICH and PMIx launchers hand it on
RANKS = ("OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK")


def is_first() -> bool:
    """Whether this is rank 0, or was started alone; the others solve the same and stay silent."""
    return all(os.environ.get(name, "0") == "0" for name in RANKS)
