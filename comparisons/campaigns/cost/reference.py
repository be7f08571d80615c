"""What the solutions' errors are measured by: exact values, or the best solution's.

In: what was measured of a scene. Out: a reference by quantity, and the error of every row as a
figure against it. Hertz's contact is exact where the scene is smooth and both models solve the same
problem. On a rough half-plane both models have the same limit, and the finest half-plane is the
reference. Where the finite elements drop an assumption of the half-plane, the finest of them are
the reference, for each quantity those of the smallest uncertainty; the half-plane's model error
then counts as error.

The floor is the reference's own uncertainty: no error below it is known."""

from dataclasses import dataclass, replace

import numpy as np

from analytic.exact.hertz import hertz_extremes, hertz_stress
from comparisons.campaigns.cost.measure import MeasuredRun
from comparisons.campaigns.cost.methods import FINEST, is_half_plane_problem
from comparisons.campaigns.cost.study import OK, CostRow
from comparisons.figures.figure import Figure
from comparisons.figures.quantity import QUANTITIES
from comparisons.figures.uncertainty import Uncertainty
from comparisons.models.level import Level, ModelRun
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.studies.comparison import field_norms, pair_norms
from comparisons.studies.contact import uncertainties

NAME = "cost"
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


def references(
    problem: Problem, rows: list[CostRow], window: Window | None
) -> dict[str, Reference]:
    """By quantity; without those that no solved row has."""
    if is_exact(problem):
        return _exact(problem, window)
    names = [FINEST.name] if is_half_plane_problem(problem) else ["P1", "P2", "P3"]
    best: dict[str, Reference] = {}
    for name in names:
        for quantity, reference in _finest(problem, rows, name, window).items():
            if quantity not in best or reference.floor < best[quantity].floor:
                best[quantity] = reference
    return best


def is_exact(problem: Problem) -> bool:
    scene = problem.scene
    capped = scene.body.hardness is not None and scene.body.hardness <= problem.hertz.peak_pressure
    smooth = scene.profile is None and not problem.coupling and not capped
    return smooth and is_half_plane_problem(problem)


def errors_of(
    row: CostRow, known: dict[str, Reference], problem: Problem, window: Window | None
) -> dict[str, Figure]:
    """A row's largest error of any friction coefficient in each quantity, judged by the scene's
    tolerance; without those that it has not, or is itself the reference of."""
    errors = {}
    for name, reference in known.items():
        if row.measured is None or row is reference.row:
            continue
        error = error_of(row.measured, name, reference, problem, window)
        if error is not None:
            tolerance = problem.scene.tolerances.get(name)
            errors[name] = Figure(
                study=NAME,
                quantity=name,
                source=row.method.name,
                value=error,
                at={"pitch": row.setting},
                against=reference.source,
                uncertainty=Uncertainty({"reference": reference.floor}),
                bounds=None if tolerance is None else (-tolerance, tolerance),
            )
    return errors


def error_of(
    measured: MeasuredRun,
    quantity: str,
    reference: Reference,
    problem: Problem,
    window: Window | None,
) -> float | None:
    """Largest relative error of any friction coefficient; None where the solution has none."""
    if QUANTITIES[quantity].of_pair:
        return _norms(measured.level, reference, problem, window).get(quantity)
    if any(quantity not in values for values in measured.values):
        return None
    pairs = zip(measured.values, reference.values, strict=True)
    scale = QUANTITIES[quantity].scale(problem.hertz)
    return max(abs(values[quantity] - value) / (abs(value) or scale) for values, value in pairs)


def _norms(
    level: Level, reference: Reference, problem: Problem, window: Window | None
) -> dict[str, float]:
    """Relative L2 errors of the curve of pressure and of the fields, by quantity."""
    pressure = np.interp(reference.x, *_curve(level), left=0.0, right=0.0)
    fields = [(None, None)]
    if level.stresses and len(level.stresses) == len(reference.tau1):
        tau1 = (stress.field.tau1 for stress in level.stresses)
        fields = list(zip(tau1, reference.tau1, strict=True))
    pressures = pressure, reference.pressure
    norms = [pair_norms(pressures, pair, problem, window) for pair in fields]
    return {name: max(norm[name] for norm in norms) for name in norms[0]}


def _curve(level: Level) -> tuple[np.ndarray, np.ndarray]:
    """Nodes of the pressure (n,) [m] and (n,) [Pa], linear between them, zero at both ends."""
    grid = level.grid
    x = grid.pitch * np.arange(grid.first - 1, grid.last + 2)
    return x, np.concatenate([[0.0], level.solution.pressure, [0.0]])


def _exact(problem: Problem, window: Window | None) -> dict[str, Reference]:
    hertz, frictions = problem.hertz, problem.scene.load.friction
    x = np.linspace(*problem.extent, EXACT_POINTS)
    single = {"peak_pressure": hertz.peak_pressure, "contact_length": 2.0 * hertz.half_width}
    single["contact_ratio"] = 1.0
    values = {name: (value,) * len(frictions) for name, value in single.items()}
    values["pressure_l2"] = ()
    tau1: tuple[np.ndarray, ...] = ()
    if window is not None:
        known = [hertz_extremes(hertz, friction) for friction in frictions]
        values["tau1_max"] = tuple(extremes.tau1.value for extremes in known)
        values["tau1_max_depth"] = tuple(extremes.tau1.z for extremes in known)
        values["txz_max_abs"] = tuple(
            max(abs(extremes.txz_max.value), abs(extremes.txz_min.value)) for extremes in known
        )
        z = window.z[:, None]
        tau1 = tuple(hertz_stress(hertz, window.x, z, friction).tau1 for friction in frictions)
        values |= dict.fromkeys(field_norms(tau1[0], tau1[0], problem, window), ())
    pressure = hertz.pressure(x)
    return {
        name: Reference("exact (Hertz)", FLOOR, by_friction, x, pressure, tau1, None)
        for name, by_friction in values.items()
    }


def _finest(
    problem: Problem, measured: list[CostRow], name: str, window: Window | None
) -> dict[str, Reference]:
    """References by the finest row of a method, with the uncertainty that its levels show."""
    rows = [row for row in measured if row.method.name == name and row.status == OK]
    if len(rows) < 3:
        return {}
    row, before = rows[-1], rows[-2]
    check = rows[0].far_boundary_check
    levels = tuple(known.measured.level for known in rows)
    run = ModelRun(row.method.model, levels, None if check is None else check.level)
    known = [uncertainties(run, problem, friction) for friction in problem.scene.load.friction]
    tau1 = tuple(stress.field.tau1 for stress in run.finest.stresses)
    bare = Reference(f"{name} at {row.label}", 0.0, (), *_curve(run.finest), tau1, row)
    finest = {}
    for quantity in row.measured.values[0]:
        floor = float(max(stated[quantity].total for stated in known))
        values = tuple(by_name[quantity] for by_name in row.measured.values)
        finest[quantity] = replace(bare, floor=floor, values=values)
    # norms are of first order: the finest row errs by its distance from the one before
    for quantity, floor in _norms(before.measured.level, bare, problem, window).items():
        finest[quantity] = replace(bare, floor=floor)
    return finest
