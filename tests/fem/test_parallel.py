"""The same displacements under mpirun."""

import json

import numpy as np
import pytest

SCRIPT = """
import json, sys
import numpy as np
from mpi4py import MPI
from analytic.material import Material
from fem.compliance import FiniteElementCompliance
from fem.elasticity import Coating, Support, elastic_body
from fem.far_field import FarField
from fem.surface import hat_nodes
from meshes.block import BlockMesh, BlockSpec

data = np.load(sys.argv[1])
spec = BlockSpec(1.0, 1.0, np.array([[-1.0, 1.0]]), 0.1)
mesh = BlockMesh(data["points"], data["triangles"], data["shift"], spec)
degree, thickness, far = int(sys.argv[2]), float(sys.argv[3]), sys.argv[4] == "True"
coating = Coating(Material(9.0, 0.1), thickness) if thickness else None
support = Support("bonded", "fixed") if far else Support("frictionless", "rollers")
body = elastic_body(mesh, Material(2.0, 0.3), support, degree=degree, coating=coating)
hats = hat_nodes(-0.25, 0.025, 21)
field = FarField(body, hats[0], hats[-1]) if far else None
operator = FiniteElementCompliance(body, hats, far=field)
pressure = np.linspace(0.0, 1.0, 21)
moved = operator.displacement(pressure, 0.2)
found = [operator.apply(pressure), operator.matrix() @ pressure, operator.weighted(moved)]
share = body.matrix.getLocalSize()[0] / body.unknowns
every = MPI.COMM_WORLD.gather(([f.tolist() for f in found], share))
if MPI.COMM_WORLD.rank == 0:
    print(json.dumps(every))
"""


@pytest.mark.parametrize(
    ("rough", "degree", "thickness", "far"),
    [(False, 2, 0.0, False), (True, 3, 0.1, False), (False, 2, 0.0, True)],
    ids=["straight", "curved and coated", "far field"],
)
def test_two_processes_find_what_one_finds(
    structured_block, tmp_path, launch, rough, degree, thickness, far
):
    """Displacements under pressure, by the matrix, and under traction too; half the matrix each."""

    def found(processes):
        done = launch(processes, "-c", SCRIPT, file, degree, thickness, far)
        assert done.returncode == 0, done.stderr
        displacements, shares = zip(*json.loads(done.stdout), strict=True)
        return np.array(displacements), shares

    line = np.linspace(-1, 1, 21)
    height = (lambda x: 0.02 * np.cos(4 * x)) if rough else None
    mesh = structured_block(line, line[10:], height, seed=None if thickness else 9)
    file = tmp_path / "mesh.npz"
    np.savez(file, points=mesh.points, triangles=mesh.triangles, shift=mesh.shift)
    (alone,), _ = found(1)
    (first, second), shares = found(2)
    np.testing.assert_array_equal(first, second)
    np.testing.assert_allclose(first, alone, rtol=1e-11)
    assert sum(shares) == 1.0 and 0.4 < shares[0] < 0.6
