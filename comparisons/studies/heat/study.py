"""Flash temperature by both models: figures with uncertainties, their difference, the verdict.

The half-space takes the half-plane's pressures, the finite elements their own, so that the
difference has what both theories leave out: OTHER_PRESSURES is the part of it that the half-space
finds under the finite elements' pressures. One rule judges it, as everything else."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import partial
from itertools import product

import numpy as np

from comparisons.common.tasks import Tasks
from comparisons.figures.convergence import grid_convergence
from comparisons.figures.figure import Figure, Findings, Part, Statement, figures_of
from comparisons.figures.quantity import MODELS, Quantity
from comparisons.figures.uncertainty import Uncertainty, far_boundary, iteration, peak_resolution
from comparisons.judging.study import Solved
from comparisons.models.level import Level, ModelRun
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.studies.heat.half_space import (
    HEAT_QUANTITIES,
    HEATED,
    WITHOUT,
    HeatedContact,
    HeatedStress,
    check_heat,
    half_plane_stress,
    half_space_heat,
    half_spaces,
    peclet_numbers,
    what_it_contains,
)

NAME = "heat"
QUANTITIES = {
    "flash_temperature": Quantity("largest rise in the contact", "K"),
    "mean_temperature": Quantity("mean rise, by heat", "K"),
    "fraction_into_body": Quantity("heat that enters the body"),
    "tau1_heated": Quantity("largest τ₁ with heat", "Pa"),
    "tau1_heated_without_heat": Quantity("largest τ₁ without heat", "Pa"),
    "tau1_depth_heated": Quantity("depth of the largest τ₁ with heat", "m"),
    "tau1_depth_heated_without_heat": Quantity("depth of the largest τ₁ without heat", "m"),
    "sx_heated": Quantity("largest tensile σx of the surface with heat", "Pa"),
    "sx_heated_without_heat": Quantity("largest tensile σx of the surface without heat", "Pa"),
    "peclet_number": Quantity("Peclet number V a / 2κ"),
}
OTHER_PRESSURES = "other pressures"  # the part of a difference that these make
FORMAL_ORDER = 1.0  # next to the ends of contact, where the fluxes are infinite
DEPTHS, COLUMNS = 60, 600  # of the subsurface field
Histories = dict[str, list[HeatedContact] | list[HeatedStress]]  # by model, on every level


@dataclass(frozen=True)
class HeatStudy:
    """Temperatures of a scene at its largest friction coefficient, for pictures and files."""

    contacts: dict[str, HeatedContact]  # by model, on the finest level
    contains: dict[str, str]  # what the finite elements alone have, in words
    # by model, on the finest level; empty where thermal stresses are not asked for
    stresses: dict[str, HeatedStress] = field(repr=False)
    x: np.ndarray = field(repr=False)  # (n,) [m]
    z: np.ndarray = field(repr=False)  # (m,) [m]
    field: np.ndarray = field(repr=False)  # (2, m, n) [K] in body and roller, half-planes


def begin(solved: Solved, tasks: Tasks) -> None:
    """Raise SceneError for a sliding speed that no temperature can be computed for."""
    if not solved.runs:
        check_heat(solved.problem)


def solve(solved: Solved, before: Mapping[str, Findings], tasks: Tasks) -> Findings:
    """Temperatures on every level of every model that was run, with thermal stresses in the window
    where they are asked for, and the comparison; what older rules say, and in words what the
    finite elements have."""
    case = max(solved.cases, key=lambda case: case.friction)
    problem, friction, runs = case.problem, case.friction, case.runs
    tasks.callback("frictional heat")
    contains = what_it_contains(problem) if "finite_element" in runs else {}
    figures, finest = _heat_figures(problem, runs, contains)
    stresses: dict[str, HeatedStress] = {}
    if problem.scene.heat.stresses:
        tasks.callback("thermal stresses")
        of_stresses, stresses = _stress_figures(problem, runs, solved.window)
        figures += of_stresses
    model, contact = next(iter(finest.items()))
    stated = {f.quantity: f.uncertainty for f in figures if (f.source, f.against) == (model, None)}
    at = {"friction": friction}
    peclet = [
        figure
        for body, number in peclet_numbers(problem).items()
        for figure in figures_of(NAME, body, {"peclet_number": number}, None, at)
    ]
    rules = [
        figure
        for rule, values in _rules(problem, contact).items()
        for quantity, value in values.items()
        for figure in figures_of(NAME, rule, {quantity: value}, stated[quantity], at)
    ]
    said = tuple(Statement("the finite elements have", text, n) for n, text in contains.items())
    data = HeatStudy(finest, contains, stresses, *_subsurface(problem, contact))
    return Findings((*peclet, *figures, *rules), statements=said, data=data)


def _heat_figures(
    problem: Problem, runs: Mapping[str, ModelRun], features: Iterable[str]
) -> tuple[list[Figure], dict[str, HeatedContact]]:
    """The figures, with what each of the finite elements' `features` (`what_it_contains`) does, and
    both models' contacts on the finest level."""
    from comparisons.studies.heat.finite_elements import finite_element_heat

    solve = {
        "half_plane": partial(half_space_heat, problem),
        "finite_element": partial(finite_element_heat, problem),
    }
    smaller = partial(finite_element_heat, problem, block=0.5)
    histories, domain = _histories(runs, solve, smaller)
    dropped = {}
    for feature in features:
        levels = runs["finite_element"].levels
        bare = [finite_element_heat(problem, level, without={feature}) for level in levels]
        dropped[feature] = list(zip(bare, histories["finite_element"], strict=True))
    figures = []
    for name in HEAT_QUANTITIES:
        parts = [_effect(feature, pairs, name) for feature, pairs in dropped.items()]
        figures += _figures(problem, runs, histories, domain, name, parts)
    return figures, {name: history[-1] for name, history in histories.items()}


def _stress_figures(
    problem: Problem, runs: Mapping[str, ModelRun], window: Window
) -> tuple[list[Figure], dict[str, HeatedStress]]:
    """Thermal stresses with those of the contact, and both models' on the finest level."""
    from comparisons.studies.heat.finite_elements import finite_element_stress

    solve = {
        "half_plane": partial(half_plane_stress, problem, window=window),
        "finite_element": partial(finite_element_stress, problem, window=window),
    }
    smaller = partial(finite_element_stress, problem, window=window, beyond=0.5)
    histories, domain = _histories(runs, solve, smaller)
    figures = [f for name in HEATED for f in _figures(problem, runs, histories, domain, name, [])]
    return figures, {name: history[-1] for name, history in histories.items()}


def _histories(
    runs: Mapping[str, ModelRun],
    solve: Mapping[str, Callable[[Level], HeatedContact | HeatedStress]],
    smaller: Callable[[Level], HeatedContact | HeatedStress],
) -> tuple[Histories, dict[str, float]]:
    """What each model finds on its levels; and, by figure, what the far boundary leaves in the
    finite elements', by the coarsest level on a `smaller` block."""
    histories = {name: [solve[name](level) for level in run.levels] for name, run in runs.items()}
    if "finite_element" not in runs:
        return histories, {}
    run, whole = runs["finite_element"], histories["finite_element"][0].figures
    moved = smaller(run.far_boundary_check or run.levels[0]).figures
    return histories, {name: far_boundary(moved[name], whole[name]) for name in whole}


def _figures(
    problem: Problem,
    runs: Mapping[str, ModelRun],
    histories: Histories,
    domain: Mapping[str, float],
    name: str,
    parts: list[Part],
) -> Iterator[Figure]:
    """One quantity by each model, with heat and without, and their difference. Both models'
    uncertainties add up: next to the ends of contact, where the flux is infinite, they discretise
    it each in its own way. All is over the finite elements' value; of stresses over that without
    heat where it is larger, as heat may cancel it; of depths over a.

    parts  of each feature that the finite elements alone have, what the figure is without it, over
           what it is with it, less 1"""
    values = {model: history[-1].figures for model, history in histories.items()}
    names = [n for n in (f"{name}{WITHOUT}", name) if n in values[list(values)[-1]]]
    size = max(abs(values[list(values)[-1]][n]) for n in names)
    size = problem.hertz.half_width if name == "tau1_depth_heated" else size
    common = {"study": NAME, "at": {"friction": problem.largest_friction}, "scale": size}
    uncertainties, alone = {}, len(values) == 1
    for (model, history), quantity in product(histories.items(), names):
        solution, place = runs[model].finest.solution, history[-1].places.get(quantity)
        # at the surface stress is as certain as the pressure there
        read = peak_resolution(solution.pressure) if place and place[1:] == (0.0,) else 0.0
        levels = [known.figures[quantity] for known in history]
        left = grid_convergence(levels, FORMAL_ORDER, read * levels[-1]).uncertainty
        left += domain[quantity] if model == "finite_element" else 0.0
        # what heat takes back is as uncertain as before
        least = uncertainties.get((f"{name}{WITHOUT}", model), 0.0) if name == "sx_heated" else 0.0
        uncertainties[quantity, model] = max(least, left / size + iteration(solution))
        yield Figure(
            quantity=quantity,
            source=model,
            value=levels[-1],
            uncertainty=Uncertainty({"numerical": uncertainties[quantity, model]}),
            parts=tuple(parts) if alone and model == "finite_element" else (),
            place=place,
            **common,
        )
    if alone:
        return
    one, other = (values[model][name] for model in MODELS)
    if len(names) == 1:
        under_theirs = half_space_heat(problem, runs["finite_element"].finest).figures[name]
        share = (one - under_theirs) / size
        parts = [*parts, Part(OTHER_PRESSURES, share)]
    tolerance = problem.scene.heat.tolerance
    yield Figure(
        quantity=name,
        source="half_plane",
        value=(one - other) / size,
        against="finite_element",
        uncertainty=Uncertainty({model: uncertainties[name, model] for model in MODELS}),
        bounds=(-tolerance, tolerance),
        parts=tuple(parts),
        **common,
    )


def _effect(feature: str, pairs: list[tuple[HeatedContact, HeatedContact]], name: str) -> Part:
    """Of what the first of each pair has not and the second has, on every level."""
    moved = [bare.figures[name] / whole.figures[name] - 1.0 for bare, whole in pairs]
    change = grid_convergence(moved, FORMAL_ORDER)
    return Part(feature, change.value, change.uncertainty)


def _rules(problem: Problem, contact: HeatedContact) -> dict[str, dict[str, float]]:
    """Older rules on the half-spaces, under the heat of a solved contact."""
    from analytic.heat.partition import layered_fraction, one_fraction

    heat, pitch = contact.heat, float(contact.x[1] - contact.x[0])
    bodies, settings = half_spaces(problem, len(heat), pitch), problem.scene.heat
    surface = settings.coating or settings.body
    body = settings.body.conductivity, surface.conductivity
    fractions = {
        "equal_largest": one_fraction(*bodies, heat, np.max),
        "equal_mean": one_fraction(*bodies, heat, np.mean),
        "conductivities": layered_fraction(body, 2 * (settings.roller.conductivity,)),
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
    into_bodies = contact.into_body, contact.heat - contact.into_body
    fluxes = [np.pad(flux, beside) for flux in into_bodies]
    x = contact.x[0] + pitch * np.arange(-beside, len(contact.x) + beside)
    z = half_width * np.linspace(0.0, 1.0, DEPTHS) ** 2
    bodies = half_spaces(problem, len(x), pitch)
    shown = slice(None, None, max(1, len(x) // COLUMNS))
    fields = [body.field(flux, z)[:, shown] for body, flux in zip(bodies, fluxes, strict=True)]
    return x[shown], z, np.array(fields)
