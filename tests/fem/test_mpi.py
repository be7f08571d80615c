"""MPI begins as one process, without a daemon, whatever started the process."""

from pathlib import Path

import pytest
from scenes import python

CHILDREN = """
import os, pathlib, fem
from mpi4py import MPI
assert MPI.COMM_WORLD.size == 1
print(pathlib.Path(f"/proc/{os.getpid()}/task/{os.getpid()}/children").read_text())
"""
SET = "import os, fem; print(*(n for n in os.environ if n.startswith(('OMPI_', 'PMI'))))"
LAUNCHED = {"OMPI_COMM_WORLD_RANK": "1", "OMPI_COMM_WORLD_SIZE": "2", "PMI_RANK": "1"}


def said(code: str, **variables: str) -> str:
    done = python("-c", code, env={"HOME": str(Path.home())}, **variables)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


@pytest.mark.skipif(not Path("/proc/self/task").exists(), reason="there is no /proc to look in")
@pytest.mark.parametrize("variables", [{}, LAUNCHED], ids=["alone", "launched"])
def test_a_process_is_alone_and_starts_no_daemon(variables):
    assert said(CHILDREN, **variables) == ""


def test_settings_of_the_user_s_stay():
    assert said(SET, **LAUNCHED).split() == ["OMPI_MCA_ess_singleton_isolated", "OMPI_MCA_pml"]
    assert said("import os, fem; print(os.environ['OMPI_MCA_pml'])", OMPI_MCA_pml="cm") == "cm"
