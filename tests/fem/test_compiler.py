"""The just-in-time compiler: silent when cold, and idle once it has run."""

import os
import subprocess
import sys
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
SCRIPT = """
import numpy as np
from analytic.material import Material
from fem.elasticity import Support, elastic_body
from meshes.block import BlockMesh, BlockSpec
from meshes.second_order import add_midpoints

vertices = np.array([[-1.0, 0.0], [0.0, 0.0], [1.0, 0.0], [-1.0, 1.0], [0.0, 1.0], [1.0, 1.0]])
corners = np.array([[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]])
points, triangles = add_midpoints(vertices, corners)
spec = BlockSpec(1.0, 1.0, np.array([[-1.0, 1.0]]), 1.0)
for shift in (0.0 * points[:, 0], 0.1 * (1.0 - points[:, 1])):
    body = elastic_body(BlockMesh(points, triangles, shift, spec), Material(1.0, 0.3), Support())
    assert np.isfinite(body.solve(np.ones_like(points))).all()
"""


def run(cache):
    environment = os.environ | {"XDG_CACHE_HOME": str(cache), "PYTHONPATH": str(PROJECT)}
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT], env=environment, cwd=PROJECT, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return done.stdout + done.stderr


def test_a_cold_compile_is_silent_and_serves_later_processes(tmp_path):
    assert run(tmp_path) == ""
    compiled = {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*.so")}
    assert compiled
    assert run(tmp_path) == ""
    assert {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*.so")} == compiled
