"""Flash temperature by both models: figures with uncertainties, their difference, the verdict.

The half-space takes the half-plane's pressures, the finite elements their own, so that the
difference has what both theories leave out: `by_pressure` is the part of it that the half-space
finds under the finite elements' pressures. One rule judges it, as everything else."""

from collections.abc import Iterable, Mapping, Set

import numpy as np

from comparisons.common.progress import ProgressCallback
from comparisons.common.tasks import Tasks
from comparisons.figures.convergence import grid_convergence
from comparisons.figures.figure import Figure, Figures, Findings, Part, Statement, figures_of
from comparisons.figures.quantity import HEAT_QUANTITIES
from comparisons.figures.uncertainty import Uncertainty, far_boundary, iteration
from comparisons.models.level import ModelRun
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.studies.heat import show
from comparisons.studies.heat.figures import (
    COMPARED,
    HEATED,
    NAME,
    OTHER_PRESSURES,
    QUANTITIES,
    HeatRow,
    HeatStudy,
    place_of,
)
from comparisons.studies.heat.half_plane_stress import HeatedStress, half_plane_stress
from comparisons.studies.heat.half_space import (
    HeatedContact,
    check_heat,
    friction_of,
    half_space_heat,
    half_spaces,
    peclet_numbers,
    what_it_contains,
)
from comparisons.studies.study import Solved, Study

FORMAL_ORDER = 1.0  # next to the ends of contact, where the fluxes are infinite
DEPTHS, COLUMNS = 60, 600  # of the subsurface field


def findings_of(
    problem: Problem, runs: dict[str, ModelRun], window: Window | None, callback: ProgressCallback
) -> Findings:
    """Temperatures on every level of every model that was run, with thermal stresses in the window
    where they are asked for, and the comparison; what older rules say, and in words what the
    finite elements have."""
    callback("frictional heat")
    contains = what_it_contains(problem) if "finite_element" in runs else {}
    figures, finest = heat_figures(problem, runs, effects=contains)
    at, stresses = {"friction": friction_of(problem)}, {}
    if problem.scene.heat.stresses:
        callback("thermal stresses")
        histories, moved = _stresses(problem, runs, window)
        for name in HEATED:
            figures += _figures(problem, runs, histories, moved, {}, name)
        stresses = {model: history[-1] for model, history in histories.items()}
    model, first = next(iter(finest.items()))
    numbers = [
        figure
        for body, number in peclet_numbers(problem).items()
        for figure in figures_of(NAME, body, {"peclet_number": number}, None, at)
    ]
    rules = [
        figure
        for rule, values in _rules(problem, first).items()
        for name, value in values.items()
        for figure in figures_of(NAME, rule, {name: value}, _stated(figures, name, model), at)
    ]
    said = tuple(Statement("the finite elements have", text, n) for n, text in contains.items())
    data = HeatStudy(finest, contains, stresses, *_subsurface(problem, first))
    return Findings((*numbers, *figures, *rules), statements=said, data=data)


def _stated(figures: Iterable[Figure], quantity: str, model: str) -> Uncertainty:
    return Figures(figures).one(quantity=quantity, source=model, against=None).uncertainty


def heat_figures(
    problem: Problem,
    runs: dict[str, ModelRun],
    without: Set[str] = frozenset(),
    effects: Iterable[str] = (),
) -> tuple[list[Figure], dict[str, HeatedContact]]:
    """The figures, and both models' contacts on the finest level. The finite elements are `without`
    features (`what_it_contains`); the `effects` of some are stated."""
    histories, moved, dropped = {}, {}, {}
    if "half_plane" in runs:
        levels = runs["half_plane"].levels
        histories["half_plane"] = [half_space_heat(problem, level) for level in levels]
    if "finite_element" in runs:
        from comparisons.studies.heat.conduction import finite_element_heat

        levels = runs["finite_element"].levels
        coarse, *_ = own = [finite_element_heat(problem, each, without=without) for each in levels]
        histories["finite_element"] = own
        smaller = finite_element_heat(problem, levels[0], 0.5, without)
        for name in HEAT_QUANTITIES:
            moved[name] = far_boundary(smaller.figures[name], coarse.figures[name])
        for feature in effects:
            bare = [finite_element_heat(problem, level, without={feature}) for level in levels]
            dropped[feature] = list(zip(bare, own, strict=True))
    figures = []
    for name in HEAT_QUANTITIES:
        figures += _figures(problem, runs, histories, moved, dropped, name)
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
        from comparisons.studies.heat.element_stress import finite_element_stress

        levels = runs["finite_element"].levels
        coarse, *_ = own = [finite_element_stress(problem, each, window) for each in levels]
        histories["finite_element"] = own
        smaller = finite_element_stress(problem, levels[0], window, beyond=0.5).figures
        moved = {name: far_boundary(smaller[name], coarse.figures[name]) for name in HEATED}
    return histories, moved


def _figures(
    problem: Problem,
    runs: dict[str, ModelRun],
    histories: dict[str, list[HeatedContact | HeatedStress]],
    moved: dict[str, float],
    dropped: dict[str, list[tuple[HeatedContact, HeatedContact]]],
    name: str,
) -> list[Figure]:
    """One quantity. Both models' uncertainties add up: next to the ends of contact, where the flux
    is infinite, they discretise it each in its own way. All is over the finite elements' value; of
    stresses over that without heat where it is larger, as heat may cancel it; of depths over a."""
    values = {model: [each.figures[name] for each in h] for model, h in histories.items()}
    shown, own = {model: history[-1] for model, history in values.items()}, {}
    cold = {m: h[-1].elastic[name] for m, h in histories.items() if name in HEATED}
    size = max(abs(each[list(shown)[-1]]) for each in (shown, cold) if each)
    size = problem.hertz.half_width if name == "tau1_depth_heated" else size
    for model, history in values.items():
        left = grid_convergence(history, FORMAL_ORDER).uncertainty
        left += moved[name] if model == "finite_element" else 0.0
        own[model] = left / size + iteration(runs[model].finest)
    parts = [_effect(feature, pairs, name) for feature, pairs in dropped.items()]
    difference = None
    if len(values) > 1:
        difference = (shown["half_plane"] - shown["finite_element"]) / size
    if difference is not None and not cold:
        under_theirs = half_space_heat(problem, runs["finite_element"].finest).figures[name]
        parts.append(Part(OTHER_PRESSURES, (shown["half_plane"] - under_theirs) / size))
    places = {model: place_of(name, h[-1].figures) for model, h in histories.items()}
    judged = difference, tuple(parts), problem.scene.heat.tolerance
    row = HeatRow(name, shown, own, size, *judged, cold, places)
    return list(row.figures(friction_of(problem)))


def _effect(feature: str, pairs: list[tuple[HeatedContact, HeatedContact]], name: str) -> Part:
    """Of what the first of each pair has not and the second has, on every level."""
    moved = [bare.figures[name] / whole.figures[name] - 1.0 for bare, whole in pairs]
    change = grid_convergence(moved, FORMAL_ORDER)
    return Part(feature, change.value, change.uncertainty)


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


def begin(solved: Solved, tasks: Tasks) -> None:
    """Raise SceneError for a sliding speed that no temperature can be computed for."""
    if not solved.runs:
        check_heat(solved.problem)


def solve(solved: Solved, before: Mapping[str, Findings], tasks: Tasks) -> Findings:
    return findings_of(solved.problem, solved.runs, solved.window, tasks.callback)


STUDY = Study(
    name=NAME,
    quantities=QUANTITIES,
    solve=solve,
    applies=lambda solved: solved.problem.scene.heat is not None,
    begin=begin,
    data=HeatStudy,
    tabled=COMPARED,
    blocks=show.blocks,
    pictures=show.PICTURES,
    files=show.files,
    lines=show.lines,
)
