"""Finite elements where contact degenerates: one node, every node, slopes of 1, mirrored meshes.

References: a load over one node's weight; elimination and bounded least squares on the whole
compliance matrix; cubic elements on the same mesh; the same body from behind.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache, partial

import numpy as np

from analytic.contact.defect_correction import solve_with_model
from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import ContactSolution
from analytic.grid import HatGrid
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane
from comparisons.studies.checks import BoundedFigure, Findings, Groups, relative_error
from comparisons.studies.robustness.cases.rough import plateau, spike, steps, touching_figure
from comparisons.studies.robustness.finite_element.loaded_body import (
    BONDED,
    GRID,
    compliance_of,
    finite_element_findings,
    flat_mesh,
    rough_mesh,
)
from comparisons.studies.robustness.loaded_contact import deviation, least_squares
from fem.body.elasticity import elastic_body
from fem.compliance.operator import FiniteElementCompliance
from meshes.block import BlockMesh

SAME = 1e-7  # of the peak: the iteration's own tolerance
BODY = Material(0.91, 0.3)  # plane-strain modulus 1


def block() -> BlockMesh:
    """Forty times as wide as the grid."""
    return flat_mesh(40.0, 40.0, 1.5, 0.1)


@lru_cache
def plain_compliance() -> FiniteElementCompliance:
    return compliance_of(elastic_body(block(), BODY, BONDED))


def heights() -> np.ndarray:
    """Of a rough line on the grid [m]."""
    return 1e-3 * np.random.default_rng(8).standard_normal(GRID.count)


def pressed(
    compliance: FiniteElementCompliance, height: np.ndarray, load: float, grid: HatGrid = GRID
) -> ContactSolution:
    """A rigid flat on heights (n,) [m], by way of a half-plane."""
    model, gap = HalfPlane(grid.count, grid.pitch, BODY.plane_strain_modulus), -grid.pitch * height
    return solve_with_model(compliance, model, gap, grid.weights, Constraints(load=load))


def vanishing_findings(load: float) -> Findings:
    """Under next to no load the highest node carries all of it."""
    height = heights()
    found = pressed(plain_compliance(), height, load)
    opened = float(np.abs(found.gap - (height.max() - height)).max() / np.ptp(height))
    carried = found.pressure.max() * GRID.pitch
    return finite_element_findings(
        found,
        relative_error("pressure", carried, load, 1e-15, "the load over the node's weight"),
        touching_figure(found.pressure, 1, "one"),
        BoundedFigure("gap", opened, 1e-12 + 1e6 * load, "the initial gap"),
    )


def twin_findings() -> Findings:
    """Two equal highest peaks on a mesh of no symmetry: each carries half, but for the mesh."""
    height = np.full(GRID.count, -1.0)
    height[[5, GRID.count - 6]] = 0.0
    found = pressed(plain_compliance(), height, 1e-6)
    share = found.pressure[: GRID.count // 2].sum() / found.pressure.sum()
    return finite_element_findings(
        found,
        BoundedFigure("share of a peak", abs(share - 0.5), 1e-3, "half of the load"),
        touching_figure(found.pressure, 2, "two"),
    )


def closed_findings() -> Findings:
    height, load, compliance = heights(), 10.0, plain_compliance()
    found = pressed(compliance, height, load)
    matrix, weights = compliance.matrix(), GRID.weights
    system = np.block([[matrix, -weights[:, None]], [weights, np.zeros((1, 1))]])
    expected = np.linalg.solve(system, np.append(GRID.pitch * height, load))[:-1]
    asymmetry = float(np.abs(matrix - matrix.T).max() / np.abs(matrix).max())
    return finite_element_findings(
        found,
        deviation(found.pressure, expected, "pressure", SAME, "elimination on the whole matrix"),
        touching_figure(found.pressure, GRID.count, "all"),
        BoundedFigure("asymmetry", asymmetry, 1e-12, "none"),
        condition=float(np.linalg.cond(matrix)),
    )


def shape_findings(shape: Callable[[int], np.ndarray], load: float) -> Findings:
    height, compliance = 1e-3 * shape(GRID.count), plain_compliance()
    found = pressed(compliance, height, load)
    matrix, gap = compliance.matrix(), -GRID.pitch * height
    # the iteration ends at 1e-8 of the displacements, which pressures magnify
    expected = least_squares(0.5 * (matrix + matrix.T), gap, GRID.pitch, found.approach, np.inf)
    figure = deviation(found.pressure, expected, "pressure", 1e-6, "least squares, whole matrix")
    return finite_element_findings(found, figure)


def slope_findings(rms_slope: float) -> Findings:
    """A rough boundary: quadratic against cubic displacements on one mesh."""
    grid, mesh = HatGrid(0.1, -12, 12), rough_mesh(rms_slope)
    quadratic, cubic = (
        pressed(
            compliance_of(elastic_body(mesh, BODY, BONDED, degree=degree), grid),
            -(grid.x**2) / 20.0,
            0.05,
            grid,
        )
        for degree in (2, 3)
    )
    reference = "cubic elements, same mesh"
    figure = deviation(quadratic.pressure, cubic.pressure, "pressure", 2e-2, reference)
    return finite_element_findings(quadratic, figure)


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
    height, ahead = heights(), plain_compliance()
    behind = compliance_of(elastic_body(turned(block()), BODY, BONDED))
    here, there = pressed(ahead, height, 1e-3), pressed(behind, height[::-1], 1e-3)
    probe = np.abs(height)
    moved, again = ahead.apply(probe, friction), behind.apply(probe[::-1], -friction)[::-1]
    return finite_element_findings(
        here,
        deviation(there.pressure[::-1], here.pressure, "pressure", SAME, "its mirror image"),
        deviation(again, moved, "displacement", 1e-11, "its mirror image"),
    )


def cases() -> Groups:
    return {
        "one node": {
            f"load {load:g} of modulus times length": partial(vanishing_findings, load)
            for load in (1e-12, 1e-100)
        },
        "equal peaks": {"two equal highest peaks": twin_findings},
        "full contact": {"a load that closes all gaps": closed_findings},
        "shapes": {
            "plateau": partial(shape_findings, plateau, 1e-4),
            "spike, pressed in": partial(shape_findings, spike, 1e-2),
            "steps": partial(shape_findings, steps, 1e-3),
            "flat": partial(shape_findings, np.zeros, 1e-3),
        },
        "slope": {
            f"rms slope {slope:g}, rough boundary": partial(slope_findings, slope)
            for slope in (0.1, 1.0)
        },
        "mirror": {"body and profile reversed, sliding, too": partial(mirrored_findings, 1.0)},
    }
