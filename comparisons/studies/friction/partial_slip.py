"""Partial slip by both models: what sticks under a tangential load that does not make it slide.

In: a solved scene with [partial_slip], of which each level is loaded again along the history. Out:
figures at its end with their uncertainties, the models' difference judged as any other, zones and
loads as series. At the scene's largest friction coefficient."""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np

from comparisons.common.tasks import Tasks
from comparisons.figures.figure import Figure, Figures, Findings, Series, Statement, columns_of
from comparisons.figures.quantity import MODELS, Quantity
from comparisons.figures.uncertainty import (
    PRESSURE_PER_RESIDUAL,
    Uncertainty,
    by_levels,
    far_boundary,
    length_resolution,
    of_increments,
)
from comparisons.judging.study import CONVERGED, WHY_NOT, Solved
from comparisons.models.level import Level
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
Solve = Callable[[Level, int], SlippedLevel]  # of a level, by so many increments


@dataclass(frozen=True)
class ModelSlip:
    """One model's histories, by level."""

    levels: tuple[SlippedLevel, ...]
    smaller: SlippedLevel | None = None  # the coarsest on a block of half the size
    fewer: SlippedLevel | None = None  # the coarsest by half as many increments
    most_order: float = math.inf  # of convergence, that its elements have

    @property
    def finest(self) -> SlippedLevel:
        return self.levels[-1]


def solve(solved: Solved, before: Mapping[str, Findings], tasks: Tasks) -> Findings:
    """Every level of every model that was run is loaded along the path."""
    problem, path = solved.problem, solved.problem.scene.partial_slip.path
    at, models, said = {"friction": problem.largest_friction}, {}, []
    for name, solve_level in solvers(solved).items():
        tasks.callback(f"partial slip: {name.replace('_', ' ')}")
        models[name] = _model_slip(solved, name, solve_level)
        settled = all(s.converged for level in models[name].levels for s in level.states)
        said.append(Statement(CONVERGED, "yes" if settled else "no", name, at))
    if problem.scene.finite_element.plastic and "finite_element" in solved.runs:
        said.append(Statement(WHY_NOT, OF_FLOW, "finite_element", at))
    figures, series = list(_figures(solved, models)), []
    for name, model in models.items():
        known = Figures(figures).of(source=name, against=None)
        series += _series(name, model.finest, path, at, known)
    outside = before.get(answers.NAME)
    if outside is not None and models:
        name, model = list(models.items())[-1]
        stuck = Figures(figures).one(quantity="stick_length", source=name, against=None)
        slip = problem.scene.partial_slip
        figures += outside_figures(outside.data, model.levels, stuck, slip.tolerance)
    finest = {name: model.finest for name, model in models.items()}
    return Findings(tuple(figures), tuple(series), tuple(said), finest)


def solvers(solved: Solved) -> dict[str, Solve]:
    """What loads a level of each model that was run, and can be."""
    problem, window = solved.problem, solved.window
    solvers: dict[str, Solve] = {}
    if "half_plane" in solved.runs:
        solvers["half_plane"] = lambda level, count: half_plane_slip(problem, level, window, count)
    if "finite_element" in solved.runs and not problem.scene.finite_element.plastic:
        from comparisons.studies.friction.finite_elements import finite_element_slip

        solvers["finite_element"] = partial(finite_element_slip, problem, solved.plan, window)
    return solvers


def _model_slip(solved: Solved, name: str, solve_level: Solve) -> ModelSlip:
    case = solved.case(solved.problem.largest_friction)
    run, count = case.runs[name], solved.problem.scene.partial_slip.increments
    levels = tuple(solve_level(level, count) for level in run.levels)
    smaller = fewer = None
    if run.far_boundary_check is not None:
        smaller = solve_level(run.levels[0], count, half_block=True)
    if levels[0].is_stepped:
        fewer = solve_level(run.levels[0], count // 2)
    most = solved.problem.scene.finite_element.most_order
    return ModelSlip(levels, smaller, fewer, most if name == "finite_element" else math.inf)


def _figures(solved: Solved, models: Mapping[str, ModelSlip]) -> Iterator[Figure]:
    """By each model, and their difference over the finite elements' figure."""
    slip = solved.problem.scene.partial_slip
    common = {"study": NAME, "at": {"friction": solved.problem.largest_friction}}
    for name in QUANTITIES:
        known = {n: m for n, m in models.items() if name in m.finest.figures(slip.path)}
        for source, model in known.items():
            value = model.finest.figures(slip.path)[name]
            scale = abs(value) or 1.0
            yield Figure(
                quantity=name,
                source=source,
                value=value,
                scale=scale,
                uncertainty=_uncertainty(slip.path, name, scale, (model,)),
                place=model.finest.places.get(name),
                levels=tuple(level.figures(slip.path)[name] for level in model.levels),
                **common,
            )
        if set(known) == set(MODELS) and name in COMPARED:
            pair = tuple(known[source] for source in MODELS)
            one, other = (model.finest.figures(slip.path)[name] for model in pair)
            scale = abs(other) or abs(one) or 1.0
            yield Figure(
                quantity=name,
                source=MODELS[0],
                value=(one - other) / scale,
                against=MODELS[1],
                scale=scale,
                uncertainty=_uncertainty(slip.path, name, scale, pair),
                bounds=(-slip.tolerance, slip.tolerance),
                **common,
            )


def _uncertainty(
    path: tuple[float, ...], name: str, scale: float, models: tuple[ModelSlip, ...]
) -> Uncertainty:
    """Of one model's figure, or of the difference of two on the same pressure elements: what both
    leave out alike is not in it."""

    def of(*levels: SlippedLevel | None) -> float:
        one, *other = (level.figures(path)[name] for level in levels)
        return one - other[0] if other else one

    values = [of(*levels) for levels in zip(*(model.levels for model in models), strict=True)]
    resolution = 0.0
    if name in LENGTHS:
        ends = (length_resolution(m.finest.grid.pitch, len(m.finest.zones[-1])) for m in models)
        known = models[0].finest.figures(path)
        resolution = sum(ends) * (known[name] / known["stick_length"] if known[name] else 0.0)
    resolution += END_READ * AT_AN_END.get(name, 0.0) * scale
    order = min(QUANTITIES[name].formal_order, *(model.most_order for model in models))
    domain = sum(
        far_boundary(of(model.smaller), of(model.levels[0])) for model in models if model.smaller
    )
    increments = 0.0
    if any(model.fewer for model in models):
        fewer = [model.fewer or model.levels[0] for model in models]
        increments = of_increments([of(*fewer), of(*(model.levels[0] for model in models))])
    worst = sum(PRESSURE_PER_RESIDUAL * model.finest.worst for model in models)
    repeated = domain, increments
    return by_levels(values, order, scale, resolution, iteration=worst, repeated=repeated)


def _series(
    name: str,
    level: SlippedLevel,
    path: tuple[float, ...],
    at: Mapping[str, float],
    figures: Figures,
) -> list[Series]:
    """Zones at the end, and the path, as certain as the figures at its end."""
    columns = {
        "stick_length": [float(np.ptp(zones, axis=1).sum()) for zones in level.zones],
        "tangential_displacement": level.displacements.tolist(),
        "energy_lost": level.energies.tolist(),
    }
    columns = {k: values for k, values in columns.items() if figures.one(quantity=k) is not None}
    table = zip(path, *columns.values(), strict=True)
    rows = [dict(zip(("load", *columns), row, strict=True)) for row in table]
    units = {key: QUANTITIES[key].unit for key in columns}
    unsure = {
        key: [figures.one(quantity=key).numerical * max(map(abs, values))] * len(path)
        for key, values in columns.items()
    }
    ends = [{"start": float(start), "stop": float(stop)} for start, stop in level.zones[-1]]
    read = {key: [2.0 * level.grid.pitch] * len(ends) for key in ("start", "stop")}
    zones = columns_of(ends, {"start": "m", "stop": "m"}, read)
    return [
        Series("stick_zones", zones, name, at),
        Series("history", columns_of(rows, units, unsure), name, at),
    ]
