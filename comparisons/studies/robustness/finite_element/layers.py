"""Finite elements on layers from a/t = 1e-3 to 1e2, near nu = 1/2, and under thin hard coatings.

The reference is the analytic layer's contact on the same hats: Fourier's kernel, which knows no
mesh and no locking (and is held to its own references by the half-plane's rows).
"""

from functools import partial

import numpy as np

from analytic.contact.problem import solve_contact
from analytic.exact.hertz import hertz_from_load
from analytic.material import Material, combined_modulus
from comparisons.models.nearest_operator import nearest_operator
from comparisons.studies.robustness.finite_element.scene_ends import held
from comparisons.studies.robustness.row import Case, Figure, Findings
from comparisons.studies.robustness.scenes import (
    LOAD,
    ORDINARY,
    RIGID,
    STEEL,
    Tables,
    finite_level,
    problem_from,
)

# L2 of the pressure on the coarsest level: of a thick layer that of the half-plane, of a thin one
# that of springs. Quadratic elements near nu = 1/2 leave more.
THICK, MEDIUM, THIN, LOCKING = 8e-3, 3e-3, 1e-4, 1.5e-2


def layer_findings(tables: Tables, pressure: float = THICK, refinement: int = 0) -> Findings:
    """A scene with a layer or a coating against the analytic one on the same hats."""
    problem = problem_from(tables)
    level = finite_level(problem, refinement)
    grid = level.grid
    exact = solve_contact(
        nearest_operator(problem.scene, grid),
        grid.hat_integrals(problem.gap, problem.knots),
        grid.weights,
        problem.constraints(),
    )
    expected = exact.pressure
    error = np.linalg.norm(level.solution.pressure - expected) / np.linalg.norm(expected)
    peak = abs(level.solution.pressure.max() / expected.max() - 1.0)
    figures = (
        Figure("pressure, L2", float(error), pressure, "the analytic layer on the same hats"),
        Figure("peak pressure", float(peak), pressure, "the analytic layer on the same hats"),
    )
    return held(level, *figures)


def cases() -> tuple[Case, ...]:
    """The cases of this module."""
    steel = Material(**STEEL)
    hertz = hertz_from_load(LOAD["per_length"], RIGID["radius"], combined_modulus(steel, None))
    a = hertz.half_width

    def layer(a_over_t: float, **fields: object) -> Tables:
        return {**ORDINARY, "body": {**STEEL, "thickness": a / a_over_t, **fields}}

    cubic = {"finite_element": {"element": "P3"}}
    rows = [
        (f"a/t = {ratio:g}, bonded", partial(layer_findings, layer(ratio), most))
        for ratio, most in (
            (1e-3, THICK),
            (0.1, THICK),
            (1.0, THICK),
            (10.0, MEDIUM),
            (100.0, THIN),
        )
    ]
    rows += [
        (
            f"a/t = {ratio:g}, frictionless",
            partial(layer_findings, layer(ratio, base="frictionless"), most),
        )
        for ratio, most in ((1.0, THICK), (100.0, THIN))
    ]
    rows += [
        (
            "a/t = 1, bonded, nu = 0.4999",
            partial(layer_findings, layer(1.0, poissons_ratio=0.4999), LOCKING),
        ),
        (
            "a/t = 10, bonded, nu = 0.4999, cubic",
            partial(layer_findings, {**layer(10.0, poissons_ratio=0.4999), **cubic}, MEDIUM),
        ),
    ]
    coatings = [  # a stiff one concentrates the pressure: one level finer
        (f"coating a/{part:g} thick, {ratio:g} times as stiff", ratio, part, refinement)
        for ratio, part, refinement in (
            (1e3, 10.0, 1),
            (1e-3, 10.0, 0),
            (1e-6, 0.5, 0),
            (3.0, 50.0, 0),
        )
    ]
    coated = [
        (
            name,
            partial(
                layer_findings,
                {
                    **ORDINARY,
                    "coating": {
                        "thickness": a / part,
                        "youngs_modulus": ratio * 207e9,
                        "poissons_ratio": 0.25,
                    },
                },
                refinement=refinement,
            ),
        )
        for name, ratio, part, refinement in coatings
    ]
    return (
        *(Case("layer", name, "finite_element", solve) for name, solve in rows),
        *(Case("coating", name, "finite_element", solve) for name, solve in coated),
    )
