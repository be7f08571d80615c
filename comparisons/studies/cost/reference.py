"""What the measured answers are measured by: the exact one, or the best one with its uncertainty.

Hertz's contact is exact where the scene is smooth and both models solve it. On a rough half-plane
both models have one limit, and the finest half-plane is next to it. Where the finite elements have
what the half-plane lacks, the finest of them are the reference, quantity by quantity those of the
smallest uncertainty; the half-plane's errors then hold its own.

An error below the reference's uncertainty is not known better than that: the floor.
"""

from dataclasses import dataclass

import numpy as np

from analytic.exact.hertz import hertz_extremes, hertz_stress
from comparisons.assessment.comparison import (
    DEEP,
    NEAR,
    layer_thickness,
    relative_l2,
    uncertainties,
)
from comparisons.common.quantities import QUANTITIES
from comparisons.models.level import ModelRun
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.studies.cost.methods import FINEST, is_half_plane_problem
from comparisons.studies.cost.solve import Answer
from comparisons.studies.cost.study import Row, Study

EXACT_POINTS = 20_001
FLOOR = 1e-12  # of an exact answer: rounding
NORMS = ("pressure_l2", "tau1_field_near", "tau1_field_deep")


@dataclass(frozen=True)
class Reference:
    """The best known value of one quantity.

    source   in words              floor    its relative uncertainty, the largest of any friction
    values   one a friction, SI; empty for a norm
    answer   curves of norms: nodes and pressure, tau1 on the window
    row      that it is, None where it is exact
    """

    source: str
    floor: float
    values: tuple[float, ...]
    x: np.ndarray
    pressure: np.ndarray
    tau1: tuple[np.ndarray, ...]
    row: Row | None


def references(problem: Problem, study: Study, window: Window | None) -> dict[str, Reference]:
    """By quantity; without those that no good row gives."""
    if is_exact(problem):
        return _exact(problem, window)
    names = [FINEST.name] if is_half_plane_problem(problem) else ["P1", "P2", "P3"]
    best: dict[str, Reference] = {}
    for name in names:
        for quantity, found in _finest(problem, study, name, window).items():
            if quantity not in best or found.floor < best[quantity].floor:
                best[quantity] = found
    return best


def is_exact(problem: Problem) -> bool:
    """Whether Hertz's contact solves the scene."""
    scene = problem.scene
    capped = scene.hardness is not None and scene.hardness <= problem.hertz.peak_pressure
    smooth = scene.profile is None and not problem.coupling and not capped
    return smooth and is_half_plane_problem(problem)


def error_of(
    answer: Answer, quantity: str, reference: Reference, problem: Problem, window: Window | None
) -> float | None:
    """Largest relative error of any friction coefficient; None where the answer has none."""
    if quantity == "pressure_l2":
        found = np.interp(reference.x, answer.x, answer.pressure, left=0.0, right=0.0)
        return relative_l2(found, reference.pressure)
    if quantity in NORMS:
        if len(answer.stresses) != len(reference.tau1) or not reference.tau1:
            return None
        weights = _weights(quantity, problem, window)
        pairs = zip(answer.stresses, reference.tau1, strict=True)
        return max(relative_l2(s.field.tau1, known, weights) for s, known in pairs)
    if any(quantity not in own for own in answer.figures):
        return None
    pairs = zip(answer.figures, reference.values, strict=True)
    scale = QUANTITIES[quantity].scale(problem.hertz)
    return max(abs(own[quantity] - value) / (abs(value) or scale) for own, value in pairs)


def _weights(quantity: str, problem: Problem, window: Window) -> np.ndarray:
    """Of the window's points in the norm of a field."""
    depth = window.z[:, None] / problem.hertz.half_width
    part = depth < NEAR if quantity == "tau1_field_near" else depth > DEEP
    weights = np.where(part, layer_thickness(window.z)[:, None], 0.0)
    return np.broadcast_to(weights, (len(window.z), len(window.x)))


def _exact(problem: Problem, window: Window | None) -> dict[str, Reference]:
    hertz, frictions = problem.hertz, problem.scene.friction
    x = np.linspace(*problem.extent, EXACT_POINTS)
    values: dict[str, tuple[float, ...]] = {
        "peak_pressure": (hertz.peak_pressure,) * len(frictions),
        "contact_length": (2.0 * hertz.half_width,) * len(frictions),
        "contact_ratio": (1.0,) * len(frictions),
        "pressure_l2": (),
    }
    tau1: tuple[np.ndarray, ...] = ()
    if window is not None:
        known = [hertz_extremes(hertz, friction) for friction in frictions]
        values["tau1_max"] = tuple(each.tau1.value for each in known)
        values["tau1_max_depth"] = tuple(each.tau1.z for each in known)
        values["txz_max_abs"] = tuple(
            max(abs(each.txz_max.value), abs(each.txz_min.value)) for each in known
        )
        z = window.z[:, None]
        tau1 = tuple(hertz_stress(hertz, window.x, z, friction).tau1 for friction in frictions)
        values |= dict.fromkeys(_shown_norms(problem, window), ())
    pressure = hertz.pressure(x)
    return {
        name: Reference("exact (Hertz)", FLOOR, given, x, pressure, tau1, None)
        for name, given in values.items()
    }


def _shown_norms(problem: Problem, window: Window) -> list[str]:
    """Norms of fields that have a point in the window."""
    return [name for name in NORMS[1:] if np.any(_weights(name, problem, window))]


def _finest(
    problem: Problem, study: Study, name: str, window: Window | None
) -> dict[str, Reference]:
    """References by the finest row of a method, with what its levels say of their uncertainty."""
    rows = study.of(name)
    if len(rows) < 3:
        return {}
    row, before = rows[-1], rows[-2]
    answer, check = row.measured.answer, study.far_boundary_check.get(name)
    run = ModelRun(
        row.method.model,
        tuple(each.measured.answer.level for each in rows),
        None if check is None else check.answer.level,
    )
    frictions = problem.scene.friction
    doubts = [uncertainties(run, problem, friction) for friction in frictions]
    source = f"{name} at {row.label}"
    curves = (answer.x, answer.pressure, tuple(s.field.tau1 for s in answer.stresses), row)
    found = {}
    for quantity in answer.figures[0]:
        floor = max(each[quantity].total for each in doubts)
        values = tuple(own[quantity] for own in answer.figures)
        found[quantity] = Reference(source, float(floor), values, *curves)
    norms = ["pressure_l2"] if window is None else ["pressure_l2", *_shown_norms(problem, window)]
    for quantity in norms:
        # of first order: the finest errs by what the one before is off
        bare = Reference(source, 0.0, (), *curves)
        floor = error_of(before.measured.answer, quantity, bare, problem, window)
        found[quantity] = Reference(source, float(floor), (), *curves)
    return found
