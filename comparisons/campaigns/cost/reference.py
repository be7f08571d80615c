"""What the solutions' errors are measured by: exact values, or the best solution's.

Hertz's contact is exact where the scene is smooth and both models solve the same problem. On a
rough half-plane both models have the same limit, and the finest half-plane is the reference. Where
the finite elements drop an assumption of the half-plane, the finest of them are the reference, for
each quantity those of the smallest uncertainty; the half-plane's model error then counts as error.

The floor is the reference's own uncertainty: no error below it is known."""

from dataclasses import dataclass, replace

import numpy as np

from analytic.exact.hertz import hertz_extremes, hertz_stress
from comparisons.campaigns.cost.methods import FINEST, is_half_plane_problem
from comparisons.campaigns.cost.solve import SolvedContact
from comparisons.campaigns.cost.study import CostRow, CostRun
from comparisons.figures.quantity import QUANTITIES
from comparisons.models.level import ModelRun
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.studies.comparison import field_norms, relative_l2
from comparisons.studies.contact import uncertainties

EXACT_POINTS = 20_001
FLOOR = 1e-12  # of exact values: rounding


@dataclass(frozen=True)
class Reference:
    """The best known value of one quantity."""

    source: str  # in words
    floor: float  # its relative uncertainty, the largest of any friction coefficient
    values: tuple[float, ...]  # one a friction coefficient, SI; empty for a norm
    # x, pressure: (n,) [m], [Pa] nodes of the pressure
    x: np.ndarray
    pressure: np.ndarray
    tau1: tuple[np.ndarray, ...]  # (m, k) [Pa] on the window, one a friction coefficient
    row: CostRow | None  # that it is, None where it is exact


def references(problem: Problem, study: CostRun, window: Window | None) -> dict[str, Reference]:
    """By quantity; without those that no solved row has."""
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
    scene = problem.scene
    capped = scene.body.hardness is not None and scene.body.hardness <= problem.hertz.peak_pressure
    smooth = scene.profile is None and not problem.coupling and not capped
    return smooth and is_half_plane_problem(problem)


def error_of(
    solved: SolvedContact,
    quantity: str,
    reference: Reference,
    problem: Problem,
    window: Window | None,
) -> float | None:
    """Largest relative error of any friction coefficient; None where the solution has none."""
    if QUANTITIES[quantity].of_pair:
        return _norms(solved, reference, problem, window).get(quantity)
    if any(quantity not in figures for figures in solved.figures):
        return None
    pairs = zip(solved.figures, reference.values, strict=True)
    scale = QUANTITIES[quantity].scale(problem.hertz)
    return max(abs(figures[quantity] - value) / (abs(value) or scale) for figures, value in pairs)


def _norms(
    solved: SolvedContact, reference: Reference, problem: Problem, window: Window | None
) -> dict[str, float]:
    """Relative L2 errors of the curve of pressure and of the fields, by quantity."""
    pressure = np.interp(reference.x, solved.x, solved.pressure, left=0.0, right=0.0)
    found = {"pressure_l2": relative_l2(pressure, reference.pressure)}
    if len(solved.stresses) == len(reference.tau1):
        for stress, tau1 in zip(solved.stresses, reference.tau1, strict=True):
            for name, error in field_norms(stress.field.tau1, tau1, problem, window).items():
                found[name] = max(error, found.get(name, 0.0))
    return found


def _exact(problem: Problem, window: Window | None) -> dict[str, Reference]:
    hertz, frictions = problem.hertz, problem.scene.load.friction
    x = np.linspace(*problem.extent, EXACT_POINTS)
    figures = {"peak_pressure": hertz.peak_pressure, "contact_length": 2.0 * hertz.half_width}
    figures["contact_ratio"] = 1.0
    values = {name: (value,) * len(frictions) for name, value in figures.items()}
    values["pressure_l2"] = ()
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
        values |= dict.fromkeys(field_norms(tau1[0], tau1[0], problem, window), ())
    pressure = hertz.pressure(x)
    return {
        name: Reference("exact (Hertz)", FLOOR, given, x, pressure, tau1, None)
        for name, given in values.items()
    }


def _finest(
    problem: Problem, study: CostRun, name: str, window: Window | None
) -> dict[str, Reference]:
    """References by the finest row of a method, with the uncertainty that its levels show."""
    rows = study.of(name)
    if len(rows) < 3:
        return {}
    row, before = rows[-1], rows[-2]
    solved, check = row.measured.solved, study.far_boundary_check.get(name)
    run = ModelRun(
        row.method.model,
        tuple(each.measured.solved.level for each in rows),
        None if check is None else check.solved.level,
    )
    known = [uncertainties(run, problem, friction) for friction in problem.scene.load.friction]
    tau1 = tuple(stress.field.tau1 for stress in solved.stresses)
    bare = Reference(f"{name} at {row.label}", 0.0, (), solved.x, solved.pressure, tau1, row)
    found = {}
    for quantity in solved.figures[0]:
        floor = float(max(each[quantity].total for each in known))
        values = tuple(figures[quantity] for figures in solved.figures)
        found[quantity] = replace(bare, floor=floor, values=values)
    # norms are of first order: the finest row errs by its distance from the one before
    for quantity, floor in _norms(before.measured.solved, bare, problem, window).items():
        found[quantity] = replace(bare, floor=floor)
    return found
