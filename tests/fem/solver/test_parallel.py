"""How MPI begins, alone and under a launcher; the same displacements under mpirun."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from scenes import PROJECT

SCRIPT = """
import json, sys
import numpy as np
from mpi4py import MPI
from analytic.material import Material
from fem.compliance.operator import FiniteElementCompliance
from fem.body.elasticity import Coating, Support, elastic_body
from fem.compliance.far_field import FarField
from meshes.block import BlockMesh, BlockSpec

def found(file, degree, thickness, far):
    data = np.load(file)
    spec = BlockSpec(1.0, 1.0, np.array([[-1.0, 1.0]]), 0.1)
    mesh = BlockMesh(data["points"], data["triangles"], data["shift"], spec)
    coating = Coating(Material(9.0, 0.1), thickness) if thickness else None
    support = Support("bonded", "fixed") if far else Support("frictionless", "rollers")
    body = elastic_body(mesh, Material(2.0, 0.3), support, degree=degree, coating=coating)
    hats = -0.25 + 0.025 * np.arange(-1, 22)
    field = FarField(body, hats[0], hats[-1]) if far else None
    operator = FiniteElementCompliance(body, hats, far=field)
    pressure = np.linspace(0.0, 1.0, 21)
    moved = operator.displacement(pressure, 0.2)
    found = [operator.apply(pressure), operator.matrix() @ pressure, operator.weighted(moved)]
    return [f.tolist() for f in found], 2.0 * len(body.owned) / body.unknowns

every = MPI.COMM_WORLD.gather([found(*case) for case in json.loads(sys.argv[1])])
if MPI.COMM_WORLD.rank == 0:
    print(json.dumps(every))
"""
# Profile, degree, thickness of a coating, far field of a half-plane.
CASES = {
    "straight": (False, 2, 0.0, False),
    "curved and coated": (True, 3, 0.1, False),
    "far field": (False, 2, 0.0, True),
}


@pytest.fixture(scope="module")
def displacements(structured_block, launch, tmp_path_factory):
    """By case, of one process and of each of two, and their shares of the matrix."""
    line, cases = np.linspace(-1, 1, 21), []
    for rough, degree, thickness, far in CASES.values():
        height = (lambda x: 0.02 * np.cos(4 * x)) if rough else None
        mesh = structured_block(line, line[10:], height, seed=None if thickness else 9)
        file = tmp_path_factory.mktemp("mesh") / "mesh.npz"
        np.savez(file, points=mesh.points, triangles=mesh.triangles, shift=mesh.shift)
        cases.append((str(file), degree, thickness, far))

    def solved(processes):
        done = launch(processes, "-c", SCRIPT, json.dumps(cases))
        assert done.returncode == 0, done.stderr
        return [dict(zip(CASES, moved, strict=True)) for moved in json.loads(done.stdout)]

    return *solved(1), *solved(2)


@pytest.mark.parametrize("case", CASES)
def test_two_processes_find_what_one_finds(displacements, case):
    """Displacements under pressure, by the matrix, and under traction too; half the matrix each."""
    (alone, _), (first, share), (second, rest) = (process[case] for process in displacements)
    np.testing.assert_array_equal(first, second)
    np.testing.assert_allclose(first, alone, rtol=1e-11)
    assert share + rest == 1.0 and 0.4 < share < 0.6


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
