"""Stiffness matrices at their worst: backward errors of MUMPS, conditions, exact states of strain.

LAPACK's test ratio must stay below its threshold whatever the condition number is. A state that the
elements represent exactly must come out to rounding, which the condition may magnify.
"""

from collections.abc import Callable
from functools import partial

import numpy as np
from scipy.sparse import csr_matrix

from analytic.material import Material
from comparisons.studies.checks import BoundedFigure, Findings, Groups
from comparisons.studies.robustness.backward_error import (
    EPS,
    THRESHOLD,
    backward_ratio,
    condition_estimate,
    one_norm,
)
from comparisons.studies.robustness.finite_element.loaded_body import BONDED, flat_mesh, rough_mesh
from fem.body.coating import Coating
from fem.body.elasticity import ElasticBody, elastic_body
from fem.body.support import Support
from fem.body.surface import hat_forces
from meshes.block import BlockMesh

EVEN = Support("frictionless", "rollers")
STEEL = Material(207e9, 0.3)
GIVEN_BACK = 1e-8  # error of a state that the elements represent, whatever the condition


def factor_findings(make: Callable[[], ElasticBody]) -> Findings:
    """Random forces, and the forces of a hat: residual against rounding, and the condition."""
    body = make()
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
        figures.append(
            BoundedFigure(f"backward error, {name}", ratio, THRESHOLD, "LAPACK's test ratio")
        )
    # held rows are the identity's, whose scale is none of the body's
    free = np.flatnonzero(~body.held)

    def inverse(right: np.ndarray) -> np.ndarray:
        load = np.zeros(shape)
        load.flat[free] = np.ravel(right)
        return body.solve(load).ravel()[free]

    condition = condition_estimate(matrix[free][:, free], inverse)
    asymmetry = float(abs(matrix - matrix.T).max() / abs(matrix).max())
    return Findings((*figures, BoundedFigure("asymmetry", asymmetry, 1e-14, "none")), condition)


def even_findings(make: Callable[[], ElasticBody]) -> Findings:
    """Even compression, which elements of any shape represent, below a rough boundary, too.

    uz = depth - z needs no force inside, and on the top the resultant of M = 2G(1-nu)/(1-2nu).
    """
    body = make()
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
    return Findings(
        (
            BoundedFigure("displacement", float(error), GIVEN_BACK, "even compression, exact"),
            BoundedFigure("forces inside", float(ratio), THRESHOLD, "none, as LAPACK's test ratio"),
            BoundedFigure("resultant", float(carried), GIVEN_BACK, "even compression, exact"),
        )
    )


def body_on(
    mesh: Callable[[], BlockMesh],
    material: Material = STEEL,
    support: Support = BONDED,
    degree: int = 2,
    coating: Coating | None = None,
) -> ElasticBody:
    return elastic_body(mesh(), material, support, degree=degree, coating=coating)


def cases() -> Groups:
    plain = partial(flat_mesh, 40.0, 40.0, 1.5, 0.1)
    graded = partial(flat_mesh, 1.0, 1.0, 1e-6, 1e-7, 0.5)
    thin = partial(flat_mesh, 40.0, 0.1, 1.5, 0.1)
    coated = partial(flat_mesh, 40.0, 40.0, 1.5, 0.1, 0.3, 0.2)
    bodies: dict[str, Callable[[], ElasticBody]] = {
        "ordinary": partial(body_on, plain),
        "nu = 0": partial(body_on, plain, Material(1.0, 0.0)),
        "nu = 0.4999": partial(body_on, plain, Material(1.0, 0.4999)),
        "nu = 0.5 less 1e-9, cubic": partial(body_on, plain, Material(1.0, 0.5 - 1e-9), degree=3),
        "grading of 1e7": partial(body_on, graded),
        "a sheet 800 times as wide as thick": partial(body_on, thin),
        "rms slope 1": partial(body_on, partial(rough_mesh, 1.0)),
        "modulus 1e-12 Pa": partial(body_on, plain, Material(1e-12, 0.3)),
    }
    coatings = {
        f"coating {ratio:g} times as stiff": partial(
            body_on, coated, coating=Coating(Material(ratio * 207e9, 0.2), 0.2)
        )
        for ratio in (1e6, 1e-6)
    }
    even = {
        "ordinary": partial(body_on, plain, support=EVEN),
        "nu = 0.4999": partial(body_on, plain, Material(1.0, 0.4999), EVEN),
        "cubic, nu = 0.4999": partial(body_on, plain, Material(1.0, 0.4999), EVEN, 3),
        "linear": partial(body_on, plain, support=EVEN, degree=1),
        "grading of 1e7": partial(body_on, graded, support=EVEN),
        "rms slope 1": partial(body_on, partial(rough_mesh, 1.0), support=EVEN),
    }
    named = {name: partial(factor_findings, make) for name, make in (bodies | coatings).items()}
    named |= {f"even compression, {name}": partial(even_findings, m) for name, m in even.items()}
    return {"stiffness": named}
