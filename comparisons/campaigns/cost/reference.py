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
from comparisons.campaigns.cost.measure import OK, CostRow, MeasuredRun
from comparisons.campaigns.cost.methods import FINEST, Values, is_half_plane_problem
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
    """The best known solution, for some quantities."""

    source: str  # in words
    problem: Problem
    window: Window | None  # of the fields, None without stresses
    floors: dict[str, float]  # relative uncertainty, the largest of any friction, by quantity
    values: Values  # without norms
    # x, pressure: (n,) [m], [Pa] nodes of the pressure
    x: np.ndarray
    pressure: np.ndarray
    # (m, k) [Pa] at the window's sparse points, one a friction coefficient
    tau1: tuple[np.ndarray, ...]
    row: CostRow | None = None  # that it is, None where it is exact


def references(
    problem: Problem, rows: list[CostRow], window: Window | None
) -> dict[str, Reference]:
    """By quantity; without those that no solved row has."""
    if is_exact(problem):
        exact = _exact(problem, window)
        return dict.fromkeys(exact.floors, exact)
    names = [FINEST.name] if is_half_plane_problem(problem) else ["P1", "P2", "P3"]
    best: dict[str, Reference] = {}
    for name in names:
        solved = [row for row in rows if row.method.name == name and row.status == OK]
        if len(solved) < 3:  # their levels show no uncertainty
            continue
        reference = _finest(problem, solved, window)
        for quantity, floor in reference.floors.items():
            if quantity not in best or floor < best[quantity].floors[quantity]:
                best[quantity] = reference
    return best


def is_exact(problem: Problem) -> bool:
    scene = problem.scene
    capped = scene.body.hardness is not None and scene.body.hardness <= problem.hertz.peak_pressure
    smooth = scene.profile is None and not problem.coupling and not capped
    return smooth and is_half_plane_problem(problem)


def errors_of(row: CostRow, known: dict[str, Reference]) -> dict[str, Figure]:
    """A row's largest error of any friction coefficient in each quantity, judged by the scene's
    tolerance; without those that it has not, or is itself the reference of."""
    errors = {}
    for name, reference in known.items():
        if row.measured is None or row is reference.row:
            continue
        error = error_of(row.measured, name, reference)
        if error is not None:
            tolerance = reference.problem.scene.tolerances.get(name)
            errors[name] = Figure(
                study=NAME,
                quantity=name,
                source=row.method.name,
                value=error,
                at={"pitch": row.setting},
                against=reference.source,
                uncertainty=Uncertainty({"reference": reference.floors[name]}),
                bounds=None if tolerance is None else (-tolerance, tolerance),
            )
    return errors


def error_of(measured: MeasuredRun, quantity: str, reference: Reference) -> float | None:
    """Largest relative error of any friction coefficient; None where the solution has none."""
    if QUANTITIES[quantity].of_pair:
        return _norms(measured.level, reference).get(quantity)
    if any(quantity not in values for values in measured.values):
        return None
    scale = QUANTITIES[quantity].scale(reference.problem.hertz)
    pairs = [
        (values[quantity], best[quantity])
        for values, best in zip(measured.values, reference.values, strict=True)
    ]
    return max(abs(value - best) / (abs(best) or scale) for value, best in pairs)


def _norms(level: Level, reference: Reference) -> dict[str, float]:
    """Relative L2 errors of the curve of pressure and of the fields, by quantity."""
    pressure = np.interp(reference.x, *_curve(level), left=0.0, right=0.0)
    fields = [(None, None)]
    if level.stresses and len(level.stresses) == len(reference.tau1):
        tau1 = (stress.sparse_tau1 for stress in level.stresses)
        fields = list(zip(tau1, reference.tau1, strict=True))
    pressures = pressure, reference.pressure
    norms = [pair_norms(pressures, pair, reference.problem, reference.window) for pair in fields]
    return {name: max(norm[name] for norm in norms) for name in norms[0]}


def _curve(level: Level) -> tuple[np.ndarray, np.ndarray]:
    """Nodes of the pressure (n,) [m] and (n,) [Pa], linear between them, zero at both ends."""
    grid = level.grid
    x = grid.pitch * np.arange(grid.first - 1, grid.last + 2)
    return x, np.concatenate([[0.0], level.solution.pressure, [0.0]])


def _exact(problem: Problem, window: Window | None) -> Reference:
    hertz, frictions = problem.hertz, problem.scene.load.friction
    contact = {"peak_pressure": hertz.peak_pressure, "contact_length": 2.0 * hertz.half_width}
    contact["contact_ratio"] = 1.0
    values, tau1, norms = (contact,) * len(frictions), (), {"pressure_l2"}
    if window is not None:
        known = [hertz_extremes(hertz, friction) for friction in frictions]
        values = tuple(
            {
                **contact,
                "tau1_max": extremes.tau1.value,
                "tau1_max_depth": extremes.tau1.z,
                "txz_max_abs": max(abs(extremes.txz_max.value), abs(extremes.txz_min.value)),
            }
            for extremes in known
        )
        at = window.sparse.x, window.sparse.z[:, None]
        tau1 = tuple(hertz_stress(hertz, *at, friction).tau1 for friction in frictions)
        norms |= field_norms(tau1[0], tau1[0], problem, window).keys()
    floors = {name: FLOOR for name in QUANTITIES if name in values[0] or name in norms}
    x = np.linspace(*problem.extent, EXACT_POINTS)
    curve = x, hertz.pressure(x)
    return Reference("exact (Hertz)", problem, window, floors, values, *curve, tau1)


def _finest(problem: Problem, rows: list[CostRow], window: Window | None) -> Reference:
    """The finest of a method's rows, with the uncertainty that its levels show."""
    row, before, check = rows[-1], rows[-2], rows[0].far_boundary_check
    levels = tuple(solved.measured.level for solved in rows)
    run = ModelRun(row.method.model, levels, None if check is None else check.level)
    stated = [uncertainties(run, problem, friction) for friction in problem.scene.load.friction]
    values = row.measured.values
    floors = {name: float(max(by_name[name].total for by_name in stated)) for name in values[0]}
    tau1 = tuple(stress.sparse_tau1 for stress in run.finest.stresses)
    source, curve = f"{row.method.name} at {row.label}", _curve(run.finest)
    reference = Reference(source, problem, window, floors, values, *curve, tau1, row)
    # norms are of first order: the finest row errs by its distance from the one before
    return replace(reference, floors=floors | _norms(before.measured.level, reference))
