"""Finite-element bodies at their worst: backward errors of MUMPS, conditions, exact states of
strain, contact of every node and on slopes of 1.

LAPACK's test ratio must stay below its threshold whatever the condition number is. A state that the
elements represent exactly must come out to rounding, which the condition may magnify. References of
the contacts: elimination on the whole compliance matrix, cubic elements on the same mesh."""

from functools import lru_cache

import numpy as np
from scipy.sparse import csr_matrix

from analytic.contact.defect_correction import solve_with_model
from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import ContactSolution
from analytic.grid import HatGrid
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane
from comparisons.campaigns.cases import CONDITION, CaseFigures, account, bounded
from comparisons.campaigns.robustness.backward_error import (
    EPS,
    THRESHOLD,
    backward_ratio,
    condition_estimate,
    one_norm,
)
from comparisons.campaigns.robustness.loaded_contact import (
    Constants,
    costs,
    deviation,
    residual_figures,
)
from comparisons.figures.figure import Figure
from fem.body.coating import Coating
from fem.body.elasticity import ElasticBody, elastic_body
from fem.body.support import Support
from fem.body.surface import hat_forces
from fem.compliance.operator import FiniteElementCompliance
from meshes.block import BlockMesh, BlockSpec
from meshes.build import build_block
from meshes.real_shape import roughen

MOST_STEPS = 20  # of the outer iteration; the ordinary contact takes ORDINARY_STEPS
ORDINARY_STEPS = 4
SUPPORTS = {"bonded": Support("bonded", "fixed"), "even": Support("frictionless", "rollers")}
GIVEN_BACK = 1e-8  # error of a state that the elements represent, whatever the condition
SAME = 1e-7  # of the peak: the iteration's own tolerance
PRESSED = (0.91, 0.3)  # plane-strain modulus 1
# Half-width, depth, refined on |x| <=, edge there, growth, lower side of a coating [m].
FLAT = {
    "plain": (40.0, 40.0, 1.5, 0.1, 0.3, None),
    "graded": (1.0, 1.0, 1e-6, 1e-7, 0.5, None),
    "thin": (40.0, 0.1, 1.5, 0.1, 0.3, None),
    "coated": (40.0, 40.0, 1.5, 0.1, 0.3, 0.2),
    "fine": (8.0, 8.0, 3.0, 0.05, 0.3, None),
}


@lru_cache
def mesh_named(name: str) -> BlockMesh:
    """One of FLAT; or "rough", whose top is a sinusoid of rms slope 1 on the refined range."""
    if name == "rough":
        return roughen(mesh_named("fine"), _wave)
    half_width, depth, reach, edge, growth, interface = FLAT[name]
    intervals = np.array([[-reach, reach]])
    return build_block(BlockSpec(half_width, depth, intervals, edge, growth, interface=interface))


def _wave(x: np.ndarray) -> np.ndarray:
    return np.exp(-((x / 2.0) ** 8)) * np.sqrt(2.0) / np.pi * np.cos(np.pi * x)


def body_on(
    mesh: str,
    material: Constants = (207e9, 0.3),
    degree: int = 2,
    coating: float | None = None,
    support: str = "bonded",
) -> ElasticBody:
    """A body on a named mesh; `coating`, how many times as stiff as steel."""
    layer = coating and Coating(Material(coating * 207e9, 0.2), FLAT["coated"][-1])
    held = SUPPORTS[support]
    return elastic_body(mesh_named(mesh), Material(*material), held, degree=degree, coating=layer)


def factor_findings(mesh: str = "plain", **settings: object) -> CaseFigures:
    """Random forces, and the forces of a hat: residual against rounding, and the condition."""
    body = body_on(mesh, **settings)
    matrix = csr_matrix(body.stiffness())
    shape, x = body.nodes.shape, body.surface.x
    hats = np.linspace(0.25 * x[0], 0.25 * x[-1], 7)
    one_hat = np.zeros(shape)
    one_hat[body.surface.point] = hat_forces(body.surface, hats)[:, 2].toarray().reshape(-1, 2)
    loads = {"random forces": np.random.default_rng(5).standard_normal(shape), "one hat": one_hat}
    figures = []
    for name, load in loads.items():
        load[body.held] = 0.0
        ratio = backward_ratio(matrix, body.solve(load).ravel(), load.ravel())
        figures.append(bounded(f"backward error, {name}", ratio, THRESHOLD, "LAPACK's test ratio"))
    # held rows are the identity's, whose scale is none of the body's
    free = np.flatnonzero(~body.held)

    def inverse(right: np.ndarray) -> np.ndarray:
        load = np.zeros(shape)
        load.flat[free] = np.ravel(right)
        return body.solve(load).ravel()[free]

    condition = condition_estimate(matrix[free][:, free], inverse)
    asymmetry = float(abs(matrix - matrix.T).max() / abs(matrix).max())
    return (
        *figures,
        bounded("asymmetry", asymmetry, 1e-14, "none"),
        account(CONDITION, "estimate", condition),
    )


def even_findings(mesh: str = "plain", **settings: object) -> CaseFigures:
    """Even compression, which elements of any shape represent, below a rough boundary, too. uz =
    depth - z needs no force inside, and on the top the resultant of M = 2G(1-nu)/(1-2nu)."""
    body = body_on(mesh, support="even", **settings)
    material, matrix = body.material, csr_matrix(body.stiffness())
    moved = np.zeros(body.nodes.shape)
    moved[:, 1] = body.mesh.spec.depth - body.nodes[:, 1]
    moved[body.held] = 0.0
    force = (matrix @ moved.ravel()).reshape(-1, 2)
    top = body.surface.point
    inside = ~body.held
    inside[top] = False
    ratio = np.abs(force[inside]).max() / (one_norm(matrix) * np.abs(moved).max() * EPS)
    nu, shear = material.poissons_ratio, material.shear_modulus
    resultant = 2.0 * body.mesh.spec.half_width * 2.0 * shear * (1.0 - nu) / (1.0 - 2.0 * nu)
    carried = abs(force[top, 1].sum() / resultant - 1.0)
    load = np.zeros_like(force)
    load[top] = force[top]
    error = np.abs(body.solve(load) - moved).max() / np.abs(moved).max()
    return (
        bounded("displacement", error, GIVEN_BACK, "even compression, exact"),
        bounded("forces inside", ratio, THRESHOLD, "none, as LAPACK's test ratio"),
        bounded("resultant", carried, GIVEN_BACK, "even compression, exact"),
    )


def pressed(
    height: np.ndarray, load: float, grid: HatGrid, mesh: str, degree: int = 2
) -> tuple[FiniteElementCompliance, ContactSolution]:
    """A rigid flat on heights (n,) [m] of a body, by way of a half-plane."""
    hats = grid.pitch * np.arange(grid.first - 1, grid.last + 2)
    compliance = FiniteElementCompliance(body_on(mesh, PRESSED, degree), hats)
    model, constraints = HalfPlane(grid.count, grid.pitch, 1.0), Constraints(load=load)
    gap = -grid.pitch * height
    return compliance, solve_with_model(compliance, model, gap, grid.weights, constraints)


def closed_findings() -> CaseFigures:
    """A load that closes all gaps of a rough line: every node touches."""
    grid, load = HatGrid(0.1, -14, 14), 10.0
    height = 1e-3 * np.random.default_rng(8).standard_normal(grid.count)
    compliance, solution = pressed(height, load, grid, "plain")
    matrix, weights = compliance.matrix(), grid.weights
    system = np.block([[matrix, -weights[:, None]], [weights, np.zeros((1, 1))]])
    expected = np.linalg.solve(system, np.append(grid.pitch * height, load))[:-1]
    asymmetry = float(np.abs(matrix - matrix.T).max() / np.abs(matrix).max())
    touching = np.count_nonzero(solution.pressure)
    return finite_element_findings(
        solution,
        deviation(solution.pressure, expected, "pressure", SAME, "elimination on the whole matrix"),
        bounded("nodes in contact", touching, grid.count, "all", low=grid.count),
        bounded("asymmetry", asymmetry, 1e-12, "none"),
        account(CONDITION, "dense", np.linalg.cond(matrix)),
    )


def slope_findings() -> CaseFigures:
    """A rough boundary of rms slope 1: quadratic against cubic displacements on one mesh."""
    grid = HatGrid(0.1, -12, 12)
    line = -(grid.x**2) / 20.0, 0.05, grid, "rough"
    (_, quadratic), (_, cubic) = (pressed(*line, degree) for degree in (2, 3))
    reference = "cubic elements, same mesh"
    figure = deviation(quadratic.pressure, cubic.pressure, "pressure", 2e-2, reference)
    return finite_element_findings(quadratic, figure)


def finite_element_findings(
    solution: ContactSolution,
    *figures: Figure,
    most: int = MOST_STEPS,
    ordinary: int = ORDINARY_STEPS,
) -> CaseFigures:
    """The figures, the contact conditions, and steps of the outer iteration, `most` at most."""
    steps = float(solution.iterations["steps"])
    limit = bounded("steps", steps, float(most), "the most of an outer iteration")
    return *figures, *residual_figures(solution), limit, *costs(solution, steps / ordinary)
