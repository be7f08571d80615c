"""The same figures under mpirun."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

PROJECT = Path(__file__).resolve().parents[2]
SCRIPT = """
import json, sys
import numpy as np
from mpi4py import MPI
from analytic.material import Material
from fem.compliance import FiniteElementCompliance
from fem.elasticity import Coating, Support, elastic_body
from fem.surface import hat_nodes
from meshes.block import BlockMesh, BlockSpec

data = np.load(sys.argv[1])
spec = BlockSpec(1.0, 1.0, np.array([[-1.0, 1.0]]), 0.1)
mesh = BlockMesh(data["points"], data["triangles"], data["shift"], spec)
degree, thickness = int(sys.argv[2]), float(sys.argv[3])
coating = Coating(Material(9.0, 0.1), thickness) if thickness else None
support = Support("frictionless", "rollers")
body = elastic_body(mesh, Material(2.0, 0.3), support, degree=degree, coating=coating)
operator = FiniteElementCompliance(body, hat_nodes(-0.5, 0.05, 21))
pressure = np.linspace(0.0, 1.0, 21)
found = [operator.apply(pressure), operator.matrix() @ pressure, operator.apply(pressure, 0.2)]
every = MPI.COMM_WORLD.gather([f.tolist() for f in found])
if MPI.COMM_WORLD.rank == 0:
    print(json.dumps(every))
"""
LAUNCHER_VARIABLES = ("OMPI_", "PMIX_", "PMI_", "PRTE_", "HYDI_")


def run(command, file, *more):
    """Every process's displacements (processes, 3, n)."""
    environment = {k: v for k, v in os.environ.items() if not k.startswith(LAUNCHER_VARIABLES)}
    environment |= {"PYTHONPATH": str(PROJECT), "OMP_NUM_THREADS": "1"}
    environment |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    done = subprocess.run(
        [*command, sys.executable, "-c", SCRIPT, file, *map(str, more)],
        env=environment,
        cwd=PROJECT,
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    return np.array(json.loads(done.stdout))


@pytest.mark.skipif(shutil.which("mpirun") is None, reason="mpirun is not installed")
@pytest.mark.parametrize(
    ("rough", "degree", "thickness"),
    [(False, 2, 0.0), (True, 3, 0.1)],
    ids=["straight", "curved and coated"],
)
def test_two_processes_find_what_one_finds(structured_block, tmp_path, rough, degree, thickness):
    line = np.linspace(-1, 1, 21)
    height = (lambda x: 0.02 * np.cos(4 * x)) if rough else None
    mesh = structured_block(line, line[10:], height, seed=None if thickness else 9)
    file = tmp_path / "mesh.npz"
    np.savez(file, points=mesh.points, triangles=mesh.triangles, shift=mesh.shift)
    (alone,) = run([], file, degree, thickness)
    two = ["mpirun", "--oversubscribe", "-n", "2"]
    first, second = run(two, file, degree, thickness)
    np.testing.assert_array_equal(first, second)
    np.testing.assert_allclose(first, alone, rtol=1e-11)
