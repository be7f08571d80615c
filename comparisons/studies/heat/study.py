"""Flash temperature by both models: figures with uncertainties, their difference, the verdict.

The half-space takes the half-plane's pressures, the finite elements their own, so that the
difference has what both theories leave out: OTHER_PRESSURES is the part of it that the half-space
finds under the finite elements' pressures. One rule judges it, as everything else."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from comparisons.common.tasks import Tasks
from comparisons.figures.convergence import grid_convergence
from comparisons.figures.figure import Figure, Findings, Part, Statement, figures_of
from comparisons.figures.quantity import MODELS, Quantity
from comparisons.figures.uncertainty import Reading, Uncertainty, iteration, peak_resolution
from comparisons.judging.rule import judged_by
from comparisons.judging.study import Case, Solved
from comparisons.models.level import Solution
from comparisons.models.problem import Problem
from comparisons.studies.heat.half_space import (
    HEAT_QUANTITIES,
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
Heated = HeatedContact | HeatedStress


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
    from comparisons.studies.heat import finite_elements as meshed

    case = max(solved.cases, key=lambda case: case.friction)
    problem = case.problem
    tasks.callback("frictional heat")
    contains = what_it_contains(problem) if "finite_element" in case.runs else {}
    models = _heated(case, half_space_heat, meshed.finite_element_heat, block=0.5)
    contacts = {model.name: model.finest for model in models}
    figures, stresses = _figures(case, models, _parts(case, models, contains)), {}
    if problem.scene.heat.stresses:
        tasks.callback("thermal stresses")
        solvers = half_plane_stress, meshed.finite_element_stress
        models = _heated(case, *solvers, beyond=0.5)
        stresses = {model.name: model.finest for model in models}
        figures += _figures(case, models)
    contact = next(iter(contacts.values()))
    for body, number in peclet_numbers(problem).items():
        figures += figures_of(NAME, body, {"peclet_number": number}, at=case.at)
    stated = {figure.quantity: figure.uncertainty.parts for figure in figures[::-1]}
    for rule, values in _rules(problem, contact).items():
        for quantity, value in values.items():
            sure = Uncertainty(stated[quantity])
            figures += figures_of(NAME, rule, {quantity: value}, sure, case.at)
    said = tuple(Statement("the finite elements have", text, n) for n, text in contains.items())
    data = HeatStudy(contacts, contains, stresses, *_subsurface(problem, contact))
    return Findings(tuple(figures), statements=said, data=data)


def _heated(
    case: Case,
    by_half_plane: Callable[..., Heated],
    by_elements: Callable[..., Heated],
    **smaller: float,
) -> list[Solution]:
    """Heat of each model on its levels; of finite elements also on the coarsest in a `smaller`
    block."""
    models, solvers = [], dict(zip(MODELS, (by_half_plane, by_elements), strict=True))
    for name, run in case.runs.items():
        solve, repeated = solvers[name], {}
        levels = tuple(solve(case.problem, level) for level in run.levels)
        if solve is by_elements:
            first, *_ = run.repeated.get("domain", run.levels)
            repeated["domain"] = (solve(case.problem, first, **smaller),)
        models.append(Solution(name, levels, repeated))
    return models


def _figures(
    case: Case, models: Sequence[Solution], parts: Mapping[str, Sequence[Part]] = {}
) -> list[Figure]:
    """Figures of each model, with heat and without, and their differences. Uncertainties of both
    add up: next to the ends of contact, where the flux is infinite, they discretise it each in its
    own way. All is over the finite elements' value; of stresses over that without heat where it is
    larger, as heat may cancel it; of depths over a."""
    reference, a = models[-1].finest.figures, case.problem.hertz.half_width

    def size(name: str) -> float:
        both = name.removesuffix(WITHOUT), name.removesuffix(WITHOUT) + WITHOUT
        return a if "depth" in name else max(abs(reference.get(one, 0.0)) for one in both)

    sizes, tolerance = {name: size(name) for name in reference}, case.problem.scene.heat.tolerance
    *found, last = by_model = [_by_model(case, model, sizes) for model in models]
    for name in parts if not found else ():
        last[name] = replace(last[name], parts=tuple(parts[name]))
    differences = [
        replace(
            figure,
            value=(figure.value - last[name].value) / figure.scale,
            against=last[name].source,
            uncertainty=Uncertainty({f.source: f.numerical for f in (figure, last[name])}),
            bounds=(-tolerance, tolerance),
            parts=tuple(parts.get(name, ())),
            place=None,
            levels=(),
        )
        for name, figure in (found[0] if found else {}).items()
        if not name.endswith(WITHOUT)
    ]
    return [*(figure for of_model in by_model for figure in of_model.values()), *differences]


def _by_model(case: Case, model: Solution, sizes: Mapping[str, float]) -> dict[str, Figure]:
    solution, places = case.runs[model.name].finest.solution, model.finest.places

    def how(name: str, value: float) -> Reading:
        size, place = sizes[name], places.get(name)
        # at the surface stress is as certain as the pressure there
        read = peak_resolution(solution.pressure) if place and place[1:] == (0.0,) else 0.0
        return Reading(FORMAL_ORDER, size, read * value / size, iteration(solution), place=place)

    figures = judged_by(NAME, [model], lambda heated: heated.figures, how, case.at)
    if (tension := figures.get("sx_heated")) is not None:
        # what heat takes back is as uncertain as before
        pair = figures[f"sx_heated{WITHOUT}"], tension
        worst = max(pair, key=lambda figure: figure.numerical).uncertainty
        sure = replace(tension.uncertainty, parts=worst.parts)
        figures["sx_heated"] = replace(tension, uncertainty=sure)
    return figures


def _parts(
    case: Case, models: Sequence[Solution], features: Iterable[str]
) -> dict[str, list[Part]]:
    """Parts by figure: for each of the `features` that the finite elements alone have, the figure
    without it over that with it, less 1; of both models' difference also what their pressures
    make."""
    from comparisons.studies.heat.finite_elements import finite_element_heat

    problem, last = case.problem, models[-1]
    parts, run = {name: [] for name in HEAT_QUANTITIES}, case.runs[last.name]
    for feature in features:
        bare = [finite_element_heat(problem, one, without={feature}).figures for one in run.levels]
        for name in parts:
            pairs = zip(bare, last.levels, strict=True)
            moved = [without[name] / whole.figures[name] - 1.0 for without, whole in pairs]
            change = grid_convergence(moved, FORMAL_ORDER)
            parts[name].append(Part(feature, change.value, change.uncertainty))
    if len(models) > 1:
        ours, under_theirs = models[0].finest.figures, half_space_heat(problem, run.finest).figures
        for name in parts:
            share = (ours[name] - under_theirs[name]) / abs(last.finest.figures[name])
            parts[name].append(Part(OTHER_PRESSURES, share))
    return parts


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
    """Points x, depths and rises in both half-spaces, half as far again as the grid: a picture."""
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
