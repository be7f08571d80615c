"""How MPI begins: alone without a daemon, under a launcher as that has it."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

PROJECT = Path(__file__).resolve().parents[3]
CHILDREN = """
import os, pathlib, fem
from mpi4py import MPI
assert MPI.COMM_WORLD.size == 1
print(pathlib.Path(f"/proc/{os.getpid()}/task/{os.getpid()}/children").read_text())
"""
SET = "import os, fem; print(*(n for n in os.environ if n.startswith('OMPI_MCA_')))"


def said(code: str, **variables: str) -> str:
    launcher = ("OMPI_", "PMI_", "PMIX_")
    bare = {name: value for name, value in os.environ.items() if not name.startswith(launcher)}
    words = [sys.executable, "-c", code]
    environment = bare | {"PYTHONPATH": str(PROJECT)} | variables
    return subprocess.run(
        words, env=environment, check=True, capture_output=True, text=True
    ).stdout.strip()


@pytest.mark.skipif(not Path("/proc/self/task").exists(), reason="there is no /proc to look in")
def test_a_process_alone_starts_no_daemon():
    assert said(CHILDREN) == ""


def test_under_a_launcher_its_settings_stay():
    assert said(SET).split() == ["OMPI_MCA_ess_singleton_isolated", "OMPI_MCA_pml"]
    assert said(SET, PMIX_RANK="0") == ""
    assert said("import os, fem; print(os.environ['OMPI_MCA_pml'])", OMPI_MCA_pml="cm") == "cm"
