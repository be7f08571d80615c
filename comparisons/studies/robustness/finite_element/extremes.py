"""Finite elements where contact degenerates: one node, every node, slopes of 1, mirrored meshes.

References: a load over one node's weight; elimination on the whole compliance matrix; the same
hats on cubic elements of the same mesh; the same body from behind.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache, partial

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.grid import HatGrid
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane
from comparisons.studies.robustness.cases.rough import flat, plateau, spike, steps
from comparisons.studies.robustness.finite_element.algebra import BONDED, rough_on
from comparisons.studies.robustness.finite_element.bodies import (
    FinitePressed,
    compliance_of,
    flat_mesh,
    held_finite,
    press_finite,
)
from comparisons.studies.robustness.pressing import departure, least_squares
from comparisons.studies.robustness.row import Case, Figure, Findings
from fem.body.elasticity import elastic_body
from fem.compliance.operator import FiniteElementCompliance
from meshes.block import BlockMesh

SAME = 1e-7  # of the peak: the iteration's own tolerance
BODY = Material(0.91, 0.3)  # plane-strain modulus 1
GRID = HatGrid(0.1, -14, 14)


@lru_cache
def plain_compliance() -> FiniteElementCompliance:
    """Of hats on a block forty times as wide."""
    mesh = flat_mesh(40.0, 40.0, 1.5, 0.1)
    return compliance_of(elastic_body(mesh, BODY, BONDED), GRID)


def heights() -> np.ndarray:
    """Of a rough line on the grid, and a second highest peak."""
    return 1e-3 * np.random.default_rng(8).standard_normal(GRID.count)


def pressed_by(
    compliance: FiniteElementCompliance, height: np.ndarray, load: float, grid: HatGrid = GRID
) -> FinitePressed:
    model = HalfPlane(grid.count, grid.pitch, BODY.plane_strain_modulus)
    gap = -grid.pitch * height
    return press_finite(compliance, model, grid, gap, Constraints(load=load))


def vanishing_findings(load: float) -> Findings:
    """Under next to no load the highest node carries all of it."""
    height = heights()
    pressed = pressed_by(plain_compliance(), height, load)
    alone = pressed.pressure.max() * GRID.pitch / load
    opened = pressed.solution.gap - (height.max() - height)
    figures = (
        Figure("pressure", abs(alone - 1.0), 1e-15, "the load over the node's weight"),
        Figure("nodes in contact", np.count_nonzero(pressed.pressure), 1.0, "one", least=1.0),
        Figure(
            "gap",
            float(np.abs(opened).max() / np.ptp(height)),
            1e-12 + 1e6 * load,
            "the initial gap",
        ),
    )
    return held_finite(pressed, *figures)


def twin_findings() -> Findings:
    """Two equal highest peaks on a mesh of no symmetry: each carries half, but for the mesh."""
    height = np.full(GRID.count, -1.0)
    height[[5, GRID.count - 6]] = 0.0
    pressed = pressed_by(plain_compliance(), height, 1e-6)
    share = pressed.pressure[: GRID.count // 2].sum() / pressed.pressure.sum()
    figures = (
        Figure("share of a peak", abs(share - 0.5), 1e-3, "half of the load"),
        Figure("nodes in contact", np.count_nonzero(pressed.pressure), 2.0, "two", least=2.0),
    )
    return held_finite(pressed, *figures)


def closed_findings() -> Findings:
    """A load that closes all gaps: elimination on the whole matrix."""
    height, load = heights(), 10.0
    compliance = plain_compliance()
    pressed = pressed_by(compliance, height, load)
    matrix, weights = compliance.matrix(), GRID.weights
    system = np.block([[matrix, -weights[:, None]], [weights, np.zeros((1, 1))]])
    right = np.append(GRID.pitch * height, load)
    expected = np.linalg.solve(system, right)[:-1]
    asymmetry = np.abs(matrix - matrix.T).max() / np.abs(matrix).max()
    figures = (
        departure(pressed.pressure, expected, "pressure", SAME, "elimination on the whole matrix"),
        Figure(
            "nodes in contact",
            np.count_nonzero(pressed.pressure),
            GRID.count,
            "all",
            least=GRID.count,
        ),
        Figure("asymmetry", float(asymmetry), 1e-12, "none"),
    )
    condition = float(np.linalg.cond(matrix))
    return held_finite(pressed, *figures, condition=condition)


def shape_findings(shape: Callable[[int], np.ndarray], load: float) -> Findings:
    """Against bounded least squares on the whole matrix."""
    height, compliance = 1e-3 * shape(GRID.count), plain_compliance()
    pressed = pressed_by(compliance, height, load)
    matrix, gap = compliance.matrix(), -GRID.pitch * height
    # the iteration ends at 1e-8 of the displacements, which pressures magnify
    expected = least_squares(0.5 * (matrix + matrix.T), gap, GRID.pitch, pressed.solution.approach)
    figure = departure(pressed.pressure, expected, "pressure", 1e-6, "least squares, whole matrix")
    return held_finite(pressed, figure)


def slope_findings(rms_slope: float) -> Findings:
    """A real boundary of rms slope 1: quadratic against cubic displacements on one mesh."""
    grid, found = HatGrid(0.1, -12, 12), []
    mesh = rough_on(rms_slope)()
    for degree in (2, 3):
        body = elastic_body(mesh, BODY, BONDED, degree=degree)
        pressed = pressed_by(compliance_of(body, grid), -(grid.x**2) / 20.0, 0.05, grid)
        found.append(pressed)
    quadratic, cubic = found
    figures = (
        departure(
            quadratic.pressure, cubic.pressure, "pressure", 2e-2, "cubic elements, same mesh"
        ),
    )
    return held_finite(quadratic, *figures)


def turned(mesh: BlockMesh) -> BlockMesh:
    """The mesh from behind: x turned over, and the sense of its triangles with it."""
    order = [0, 2, 1, 5, 4, 3]  # corners, then midpoints of the edges between them
    intervals = -mesh.spec.intervals[::-1, ::-1]
    return replace(
        mesh,
        points=mesh.points * [-1.0, 1.0],
        shift=mesh.shift * [-1.0, 1.0],
        triangles=mesh.triangles[:, order],
        spec=replace(mesh.spec, intervals=intervals),
    )


def mirrored_findings(friction: float) -> Findings:
    """A body and its surface from behind, sliding the other way: the same, reversed."""
    mesh, height = flat_mesh(40.0, 40.0, 1.5, 0.1), heights()
    ahead, behind = (
        plain_compliance(),
        compliance_of(elastic_body(turned(mesh), BODY, BONDED), GRID),
    )
    here = pressed_by(ahead, height, 1e-3)
    there = pressed_by(behind, height[::-1], 1e-3)
    probe = np.abs(height)
    sunk, again = ahead.apply(probe, friction), behind.apply(probe[::-1], -friction)[::-1]
    figures = (
        departure(there.pressure[::-1], here.pressure, "pressure", SAME, "its mirror image"),
        departure(again, sunk, "displacement", 1e-11, "its mirror image"),
    )
    return held_finite(here, *figures)


def cases() -> tuple[Case, ...]:
    """The cases of this module."""
    rows = [
        *(
            (
                "one node",
                f"load {load:g} of modulus times length",
                partial(vanishing_findings, load),
            )
            for load in (1e-12, 1e-100)
        ),
        ("equal peaks", "two equal highest peaks", twin_findings),
        ("full contact", "a load that closes all gaps", closed_findings),
        *(
            ("shapes", name, partial(shape_findings, shape, load))
            for name, shape, load in (
                ("plateau", plateau, 1e-4),
                ("spike, pressed in", spike, 1e-2),
                ("steps", steps, 1e-3),
                ("flat", flat, 1e-3),
            )
        ),
        *(
            ("slope", f"rms slope {slope:g}, real boundary", partial(slope_findings, slope))
            for slope in (0.1, 1.0)
        ),
        ("mirror", "body and profile reversed, sliding, too", partial(mirrored_findings, 1.0)),
    ]
    return tuple(Case(group, name, "finite_element", solve) for group, name, solve in rows)
