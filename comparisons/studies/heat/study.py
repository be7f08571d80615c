"""Flash temperature by both models: figures with uncertainties, their difference, the verdict.

The half-space takes the half-plane's pressures, the finite elements their own, so that the
difference has what both theories leave out: `by_pressure` is the part of it that the half-space
finds under the finite elements' pressures. One rule judges it, as everything else."""

from collections.abc import Iterable, Mapping, Set
from dataclasses import replace

import numpy as np

from comparisons.common.progress import ProgressCallback
from comparisons.common.tasks import Tasks
from comparisons.figures.convergence import grid_convergence
from comparisons.figures.figure import Findings
from comparisons.figures.quantity import HEAT_QUANTITIES
from comparisons.figures.uncertainty import far_boundary, iteration
from comparisons.models.heat import (
    HeatedContact,
    friction_of,
    half_space_heat,
    half_spaces,
    peclet_numbers,
    what_it_contains,
)
from comparisons.models.level import ModelRun
from comparisons.models.problem import Problem
from comparisons.models.thermal_stress import HeatedStress, half_plane_stress
from comparisons.models.window import Window
from comparisons.studies.heat import show
from comparisons.studies.heat.figures import (
    COMPARED,
    HEATED,
    NAME,
    QUANTITIES,
    HeatFigure,
    HeatStudy,
)
from comparisons.studies.study import Solved, Study

FORMAL_ORDER = 1.0  # next to the ends of contact, where the fluxes are infinite
DEPTHS, COLUMNS = 60, 600  # of the subsurface field


def heat_study(
    problem: Problem, runs: dict[str, ModelRun], window: Window | None, callback: ProgressCallback
) -> HeatStudy:
    """Temperatures on every level of every model that was run, with thermal stresses in the window
    where they are asked for, and the comparison."""
    callback("frictional heat")
    contains = what_it_contains(problem) if "finite_element" in runs else {}
    figures, finest = heat_figures(problem, runs, effects=contains)
    stresses = {}
    if problem.scene.heat.stresses:
        callback("thermal stresses")
        histories, moved = _stresses(problem, runs, window)
        figures += tuple(_figure(problem, runs, histories, moved, {}, name) for name in HEATED)
        stresses = {model: history[-1] for model, history in histories.items()}
    first, peclet = next(iter(finest.values())), peclet_numbers(problem)
    found = friction_of(problem), peclet, finest, figures, _rules(problem, first), contains
    return HeatStudy(*found, stresses, *_subsurface(problem, first))


def heat_figures(
    problem: Problem,
    runs: dict[str, ModelRun],
    without: Set[str] = frozenset(),
    effects: Iterable[str] = (),
) -> tuple[tuple[HeatFigure, ...], dict[str, HeatedContact]]:
    """The figures, and both models' contacts on the finest level. The finite elements are `without`
    features (`what_it_contains`); the `effects` of some are stated."""
    histories, moved, dropped = {}, {}, {}
    if "half_plane" in runs:
        levels = runs["half_plane"].levels
        histories["half_plane"] = [half_space_heat(problem, level) for level in levels]
    if "finite_element" in runs:
        from comparisons.models.finite_element.heat import finite_element_heat

        levels = runs["finite_element"].levels
        coarse, *_ = own = [finite_element_heat(problem, each, without=without) for each in levels]
        histories["finite_element"] = own
        smaller = finite_element_heat(problem, levels[0], 0.5, without)
        for name in HEAT_QUANTITIES:
            moved[name] = far_boundary(smaller.figures[name], coarse.figures[name])
        for feature in effects:
            bare = [finite_element_heat(problem, level, without={feature}) for level in levels]
            dropped[feature] = list(zip(bare, own, strict=True))
    given = problem, runs, histories, moved, dropped
    figures = tuple(_figure(*given, name) for name in HEAT_QUANTITIES)
    return figures, {name: history[-1] for name, history in histories.items()}


def _stresses(
    problem: Problem, runs: dict[str, ModelRun], window: Window
) -> tuple[dict[str, list[HeatedStress]], dict[str, float]]:
    """On every level, and what the far boundary leaves of the finite elements' figures."""
    histories, moved = {}, {}
    if "half_plane" in runs:
        levels = runs["half_plane"].levels
        histories["half_plane"] = [half_plane_stress(problem, each, window) for each in levels]
    if "finite_element" in runs:
        from comparisons.models.finite_element.thermal_stress import finite_element_stress

        levels = runs["finite_element"].levels
        coarse, *_ = own = [finite_element_stress(problem, each, window) for each in levels]
        histories["finite_element"] = own
        smaller = finite_element_stress(problem, levels[0], window, beyond=0.5).figures
        moved = {name: far_boundary(smaller[name], coarse.figures[name]) for name in HEATED}
    return histories, moved


def _figure(
    problem: Problem,
    runs: dict[str, ModelRun],
    histories: dict[str, list[HeatedContact | HeatedStress]],
    moved: dict[str, float],
    dropped: dict[str, list[tuple[HeatedContact, HeatedContact]]],
    name: str,
) -> HeatFigure:
    """One quantity. Both models' uncertainties add up: next to the ends of contact, where the flux
    is infinite, they discretise it each in its own way. All is over the finite elements' value; of
    stresses over that without heat where it is larger, as heat may cancel it; of depths over a."""
    values = {model: [each.figures[name] for each in h] for model, h in histories.items()}
    shown, own = {model: history[-1] for model, history in values.items()}, {}
    elastic = {m: h[-1].elastic[name] for m, h in histories.items() if name in HEATED}
    size = max(abs(each[list(shown)[-1]]) for each in (shown, elastic) if each)
    size = problem.hertz.half_width if name == "tau1_depth_heated" else size
    for model, history in values.items():
        left = grid_convergence(history, FORMAL_ORDER).uncertainty
        left += moved[name] if model == "finite_element" else 0.0
        own[model] = left / size + iteration(runs[model].finest)
    effects = {feature: _effect(pairs, name) for feature, pairs in dropped.items()}
    if len(values) < 2:
        return HeatFigure(name, shown, own, size, effects=effects, elastic=elastic)
    difference, by_pressure = (shown["half_plane"] - shown["finite_element"]) / size, None
    if not elastic:
        under_theirs = half_space_heat(problem, runs["finite_element"].finest).figures[name]
        by_pressure = (shown["half_plane"] - under_theirs) / size
    judged = sum(own.values()), problem.scene.heat.tolerance
    found = by_pressure, effects, *judged, elastic
    return HeatFigure(name, shown, own, size, difference, *found)


def _effect(pairs: list[tuple[HeatedContact, HeatedContact]], name: str) -> dict[str, float]:
    """Of what the first of each pair has not and the second has, on every level."""
    moved = [bare.figures[name] / whole.figures[name] - 1.0 for bare, whole in pairs]
    found = grid_convergence(moved, FORMAL_ORDER)
    return {"value": found.value, "uncertainty": found.uncertainty}


def _rules(problem: Problem, contact: HeatedContact) -> dict[str, dict[str, float]]:
    """Older rules on the half-spaces, under the heat of a solved contact."""
    from analytic.heat.partition import layered_fraction, one_fraction

    heat, pitch = contact.heat, float(contact.x[1] - contact.x[0])
    bodies, own = half_spaces(problem, len(heat), pitch), problem.scene.heat
    body = own.body.conductivity, (own.coating or own.body).conductivity
    fractions = {
        "equal_largest": one_fraction(*bodies, heat, np.max),
        "equal_mean": one_fraction(*bodies, heat, np.mean),
        "conductivities": layered_fraction(body, 2 * (own.roller.conductivity,)),
    }
    alone = float(bodies[0].rise(heat).max())
    return {
        name: {"fraction_into_body": share, "flash_temperature": share * alone}
        for name, share in fractions.items()
    }


def _subsurface(
    problem: Problem, contact: HeatedContact
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Places, depths and rises in both half-spaces, half as far again as the grid: a picture."""
    pitch, half_width = float(contact.x[1] - contact.x[0]), problem.hertz.half_width
    beside = len(contact.x) // 4
    fluxes = [
        np.pad(each, beside) for each in (contact.into_body, contact.heat - contact.into_body)
    ]
    x = contact.x[0] + pitch * np.arange(-beside, len(contact.x) + beside)
    z = half_width * np.linspace(0.0, 1.0, DEPTHS) ** 2
    bodies = half_spaces(problem, len(x), pitch)
    shown = slice(None, None, max(1, len(x) // COLUMNS))
    fields = [body.field(flux, z)[:, shown] for body, flux in zip(bodies, fluxes, strict=True)]
    return x[shown], z, np.array(fields)


def solve(solved: Solved, before: Mapping[str, Findings], tasks: Tasks) -> Findings:
    study = heat_study(solved.problem, solved.runs, solved.window, tasks.callback)
    return replace(study.findings(), data=study)


STUDY = Study(
    name=NAME,
    quantities=QUANTITIES,
    solve=solve,
    applies=lambda solved: solved.problem.scene.heat is not None,
    data=HeatStudy,
    tabled=COMPARED,
    blocks=show.blocks,
    pictures=show.PICTURES,
    files=show.files,
    lines=show.lines,
)
