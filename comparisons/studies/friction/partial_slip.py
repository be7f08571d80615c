"""Partial slip by both models: what sticks under a tangential load that does not make it slide.

In: a solved scene with [partial_slip], of which each level is loaded again along the history. Out:
figures at its end with their uncertainties, the models' difference judged as any other, zones and
loads as series. At the scene's largest friction coefficient."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from math import inf

import numpy as np

from comparisons.common.tasks import Tasks
from comparisons.figures.figure import Column, Figure, Findings, Series, Statement
from comparisons.figures.quantity import Quantity
from comparisons.figures.uncertainty import PRESSURE_PER_RESIDUAL, Reading, length_resolution
from comparisons.judging.rule import judged_by
from comparisons.judging.study import CONVERGED, WHY_NOT, Case, Solved
from comparisons.models.level import Solution
from comparisons.scenes.studies.published import HELD_LOWERING, HELD_PRESSURE
from comparisons.studies.answers import study as answers
from comparisons.studies.friction.half_planes import SlippedLevel, half_plane_slip
from comparisons.studies.friction.outside import outside_figures

NAME = "partial_slip"
QUANTITIES = {
    "stick_length": Quantity("length that sticks", "m"),
    "tangential_displacement": Quantity("tangential displacement", "m", formal_order=2.0),
    "energy_lost": Quantity("energy lost from the first touch on", "J/m", formal_order=2.0),
    "energy_of_cycle": Quantity("energy lost in a cycle", "J/m", formal_order=2.0),
    "edge_tension": Quantity("largest σx of the surface", "Pa"),
    "tau1_slip": Quantity("largest τ₁", "Pa", formal_order=2.0),
    "slip_amplitude": Quantity("largest slip amplitude", "m"),
    "ruiz": Quantity("Ruiz' parameter σx q δ, largest", "Pa^2 m"),
    "smith_watson_topper": Quantity("Smith, Watson and Topper's parameter, largest", "Pa"),
    "stick_ratio": Quantity("share of the contact that sticks"),
    HELD_PRESSURE: Quantity("largest pressure that friction leaves", "Pa", formal_order=2.0),
    HELD_LOWERING: Quantity("lowering that friction leaves", "m", formal_order=2.0),
    "traction_l2": Quantity("tractions, relative L2 difference"),
}
COMPARED = tuple(QUANTITIES)[:9]  # judged where both models have them
OF_FLOW = "of a body that flows what sticks is not known: remove plastic"
LENGTHS = "stick_length", "stick_ratio"  # read with the grid's resolution
# Of the largest stress of the surface: how well it is read at an end of contact, where it is a cusp
# (`analytic.contact.end_stress`; 8e-4 off the exact one at 77 elements to a half-width); and by
# which power of that stress figures go
END_READ = 1.5e-3
AT_AN_END = {"edge_tension": 1.0, "ruiz": 1.0, "smith_watson_topper": 2.0}
Solve = Callable[..., SlippedLevel]  # of a level, by so many increments


def solve(solved: Solved, before: Mapping[str, Findings], tasks: Tasks) -> Findings:
    """Every level of every model that was run is loaded along the path."""
    problem, case = solved.problem, solved.case(solved.problem.largest_friction)
    slip = problem.scene.partial_slip
    models, figures, series, said = {}, [], [], []
    for name, solver in solvers(solved).items():
        tasks.callback(f"partial slip: {name.replace('_', ' ')}")
        load = partial(solver, problem)
        model = models[name] = _loaded(case.runs[name], load, slip.increments)
        settled = all(s.converged for level in model.levels for s in level.states)
        said.append(Statement(CONVERGED, "yes" if settled else "no", name, case.at))
        known = slip_figures(case, [model])
        figures += known.values()
        series += _series(model, case.at, known)
    if problem.scene.finite_element.plastic and "finite_element" in solved.runs:
        said.append(Statement(WHY_NOT, OF_FLOW, "finite_element", case.at))
    if len(models) > 1:
        figures += slip_figures(case, list(models.values())).values()
    outside = before.get(answers.NAME)
    if outside is not None and models:
        stuck = known["stick_length"]
        figures += outside_figures(outside.data, model.levels, stuck, slip.tolerance)
    finest = {name: model.finest for name, model in models.items()}
    return Findings(tuple(figures), tuple(series), tuple(said), finest)


def solvers(solved: Solved) -> dict[str, Solve]:
    """Functions that load a level of each model that was run, where there is one."""
    solvers: dict[str, Solve] = {"half_plane": half_plane_slip}
    if "finite_element" in solved.runs and not solved.problem.scene.finite_element.plastic:
        from comparisons.studies.friction.finite_elements import finite_element_slip

        solvers["finite_element"] = finite_element_slip
    return {name: solvers[name] for name in solved.runs if name in solvers}


def _loaded(run: Solution, load: Solve, count: int) -> Solution:
    """A model's levels under the path of loads, the coarsest also on a block of half the size and
    by half as many increments."""
    levels, repeated = tuple(load(level, increments=count) for level in run.levels), {}
    if "domain" in run.repeated:
        repeated["domain"] = (load(run.levels[0], increments=count, half_block=True),)
    if levels[0].is_stepped:
        repeated["increments"] = (load(run.levels[0], increments=count // 2),)
    return Solution(run.name, levels, repeated)


def slip_figures(case: Case, models: Sequence[Solution]) -> dict[str, Figure]:
    """Figures of a model, or both models' difference over the finite elements' figure."""
    slip, meshed = case.problem.scene.partial_slip, case.problem.scene.finite_element
    finest, apart = [model.finest for model in models], len(models) > 1
    ends = [level.figures for level in finest]
    names = [n for n in (COMPARED if apart else QUANTITIES) if all(n in end for end in ends)]
    sizes = {n: abs(ends[-1][n]) or abs(ends[0][n]) or 1.0 for n in names}
    unsolved = PRESSURE_PER_RESIDUAL * sum(level.worst for level in finest)
    edges = sum(length_resolution(one.grid.pitch, len(one.zones[-1])) for one in finest)
    order = meshed.most_order if models[-1].name == "finite_element" else inf

    def read(*levels: SlippedLevel) -> dict[str, float]:
        one, *other = (level.figures for level in levels)
        return {n: (one[n] - other[0][n]) / sizes[n] if other else one[n] for n in names}

    def how(name: str, value: float) -> Reading:
        resolution = END_READ * AT_AN_END.get(name, 0.0)
        if name in LENGTHS and ends[0][name]:
            resolution += edges * ends[0][name] / ends[0]["stick_length"] / sizes[name]
        return Reading(
            min(QUANTITIES[name].formal_order, order),
            sizes[name],
            resolution,
            unsolved,
            tolerance=slip.tolerance if apart else None,
            place=None if apart else finest[0].places.get(name),
        )

    return judged_by(NAME, models, read, how, case.at)


def _series(
    model: Solution, at: Mapping[str, float], figures: Mapping[str, Figure]
) -> tuple[Series, Series]:
    """Zones at the end, and the path, as certain as the figures at its end."""
    level = model.finest
    read = (2.0 * level.grid.pitch,) * len(level.zones[-1])
    ends = zip(("start", "stop"), level.zones[-1].T.tolist(), strict=True)
    zones = {name: Column(tuple(x), "m", read) for name, x in ends}
    along = {
        "stick_length": [float(np.ptp(zones, axis=1).sum()) for zones in level.zones],
        "tangential_displacement": level.displacements.tolist(),
        "energy_lost": level.energies.tolist(),
    }
    history = {"load": Column(level.path)}
    for name, values in along.items():
        if name in figures:
            unsure = (figures[name].numerical * max(map(abs, values)),) * len(values)
            history[name] = Column(tuple(values), QUANTITIES[name].unit, unsure)
    return Series("stick_zones", zones, model.name, at), Series("history", history, model.name, at)
