"""Scenes whose exact solution is known, as a user would write them, and their solution.

Each is solved as `run` does, from the tables of a scene to a stated uncertainty, and judged by a
closed form (or, on layers, by a table of ten digits) that the solution does not use. An elastic
contact depends on ratios alone. What differs numerically is where the edges fall between two nodes,
so each case has its own number of pressure elements on a half-width.

Nomenclature: a half-width [m], h pitch of the pressure elements [m], R radius [m], p0 peak
pressure [Pa], mu friction coefficient."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial
from itertools import product

import numpy as np

from analytic.exact.cases import (
    STEEL,
    Curve,
    ExactContact,
    capped_case,
    exact_contacts,
    hertz_case,
    sliding_case,
)
from analytic.exact.layers import LayerReference, layer_references
from analytic.material import Material
from comparisons.campaigns.cases import Trial
from comparisons.campaigns.verify.coverage import EXACT, PRESSURE, compared
from comparisons.common.tasks import Here, Tasks
from comparisons.figures.convergence import Convergence
from comparisons.figures.figure import Figure, Figures
from comparisons.figures.quantity import MODELS, WHOLE
from comparisons.figures.uncertainty import Uncertainty
from comparisons.judging import comparison, contact
from comparisons.judging.model_error import study as model_error
from comparisons.judging.rule import relative_l2, values_of
from comparisons.judging.study import MODEL_ERROR, studied, unsolved
from comparisons.models.model import scene_model
from comparisons.models.plan import make_plan
from comparisons.models.posing import problem_of
from comparisons.models.problem import Levels, Problem
from comparisons.runs.refinement import refined
from comparisons.scenes.scene import Origin, Scene
from comparisons.scenes.surface import KnownTrace, surface_of

FRICTIONS = (0.0, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5)  # the last two shear the surface most
SLIDING_FRICTIONS = (0.1, 0.3, 0.6, 1.0)
SHARES = (0.95, 0.8, 0.6)  # of the peak pressure that a hardness leaves
# a/h of the third level. With fewer the first level has too few open nodes to find an edge from.
RESOLUTIONS = 55.0, 130.0
HALF_PLANE_ROUNDS = 6
GOLDEN = 0.5 * (np.sqrt(5.0) - 1.0)
# Extremes are searched in the window of the field.
WINDOW = {"half_range": 1.5, "depth": 1.5, "points": [60, 20]}
LAYER_RADIUS, LAYER_THICKNESS, LAYER_MODULUS = 0.1, 1e-3, 200e9
LAYER_SOURCE = "slope equation by collocation, analytic/exact/layer_contact.json"
FINE = 6  # level of a half-plane, a reference
NEARLY_INCOMPRESSIBLE = 0.4999  # beside 0.3, where any Poisson's ratio gives the same

# The clock must not decide on a fourth.
LEVELS = Levels(3, effects=2)
LINEAR = {"effects": False}  # as what is exact; in [budget]
JUDGED = comparison.STUDY, model_error.STUDY
COMPARED = ("peak_pressure", "contact_length", "tau1_max", "tau1_max_depth", "txz_max_abs")


@dataclass(frozen=True)
class ExactScene:
    """A scene and its exact figures."""

    # name, source: of the case, and of its solution
    name: str
    source: str
    # Hertz | surface (Hertz, most shear on the surface) | sliding | hardness | layer | rough
    kind: str
    tables: Mapping[str, object]  # of the scene, as TOML has them
    exact: Mapping[str, float]  # figures [SI] by the names of `comparisons.figures.quantity`
    pressure: Curve | None = None  # p(x) [Pa] where it is known in closed form
    models: tuple[str, ...] = MODELS  # that the solution holds for
    trace: KnownTrace | None = None  # in place of the file that the scene's profile names
    # figures of the half-plane on the same gap, None where its model error is not asked for
    half_plane: Callable[[Problem], Mapping[str, float]] | None = None


def exact_scenes() -> tuple[ExactScene, ...]:
    return (*gallery_scenes(), *half_plane_scenes(), *finite_element_scenes(), *layer_scenes())


def gallery_scenes() -> tuple[ExactScene, ...]:
    return tuple(
        scene_of(case)
        for case in exact_contacts()
        if case.period is None and not case.knots and case.friction >= 0.0
    )


def half_plane_scenes(rounds: int = HALF_PLANE_ROUNDS) -> tuple[ExactScene, ...]:
    """Many resolutions, which are cheap for the half-plane."""
    cases = rollers(FRICTIONS, SLIDING_FRICTIONS, SHARES)
    return _resolved("half_plane", [(None, case) for case in cases * rounds])


def finite_element_scenes() -> tuple[ExactScene, ...]:
    """Fewer, with other sizes, growths and degrees of the finite elements."""
    others = {"element": "P3"}, {"block": 200.0, "growth": 0.1}
    asked = product([{}], rollers(FRICTIONS, (0.5,), (0.8,)))
    fewer = product(others, rollers(FRICTIONS[::2], (0.5,), (0.8,)))
    return _resolved("finite_element", [*asked, *fewer])


def _resolved(
    model: str, asked: Sequence[tuple[Mapping[str, object] | None, ExactContact]]
) -> tuple[ExactScene, ...]:
    """Scenes of contacts by their settings of the finite elements, each with its own resolution."""
    return tuple(
        replace(scene_of(case, elements, setting), models=(model,))
        for (setting, case), elements in zip(asked, spread(len(asked)), strict=True)
    )


def spread(count: int, ends: tuple[float, float] = RESOLUTIONS) -> list[float]:
    """Numbers between the ends, even on a logarithmic scale, in steps of the golden ratio."""
    low, ratio = ends[0], ends[1] / ends[0]
    return [round(low * ratio ** (k * GOLDEN % 1.0), 1) for k in range(1, count + 1)]


def layer_scenes() -> tuple[ExactScene, ...]:
    """Rigid cylinders on layers, for the finite elements alone."""
    any_ratio = 0.3, NEARLY_INCOMPRESSIBLE
    scenes = [
        layer_scene(reference, nu)
        for reference in layer_references()
        for nu in (any_ratio if reference.poissons_ratio is None else [reference.poissons_ratio])
    ]
    # every other one's model error: with both models it takes twice the time
    return tuple(
        replace(scene, half_plane=smooth_half_plane) if number % 2 else scene
        for number, scene in enumerate(scenes)
    )


@cache
def rollers(
    frictions: tuple[float, ...], sliding_frictions: tuple[float, ...], shares: tuple[float, ...]
) -> tuple[ExactContact, ...]:
    """Hertz's contact of like bodies, where friction does not change the pressure; rigid cylinders,
    where it does; Hertz's contact under a hardness of these shares of the peak pressure."""
    hertz = (
        hertz_case(f"Hertz, friction {friction:g}", (STEEL, STEEL), 8.2e-3, 1.4e9, friction)
        for friction in frictions
    )
    sliding = (
        sliding_case(f"sliding, friction {friction:g}", (STEEL, None), 10e-3, 1e6, friction)
        for friction in sliding_frictions
    )
    capped = (
        capped_case(f"flattened, hardness {share:g} p0", (STEEL, STEEL), 8.2e-3, 1.4e9, share)
        for share in shares
    )
    return (*hertz, *sliding, *capped)


def scene_of(
    case: ExactContact,
    elements: float | None = None,
    finite_element: Mapping[str, object] | None = None,
) -> ExactScene:
    """The scene of a roller, with a/h = `elements` on the third level (None: the default)."""
    radius = 0.5 * case.half_range**2 / float(case.gap(np.array(case.half_range)))
    load = {"per_length": case.load, "friction": case.friction, "coupled": case.coupled}
    tables = {
        "roller": {"radius": radius, **elastic_table(case.roller)},
        "body": elastic_table(case.body),
        "load": load,
        "budget": LINEAR,
    }
    name = case.name
    if np.isfinite(case.hardness):
        tables["body"]["hardness"] = case.hardness
    if "tau1_max" in case.quantities:
        tables["stress"] = WINDOW
    if elements is not None:
        half_width = np.sqrt(4.0 * case.load * radius / (np.pi * case.combined_modulus))
        tables["resolution"] = {"pitch": 4.0 * float(half_width) / elements}
        name += f", a/h = {elements:g}"
    if finite_element is not None:
        tables["finite_element"] = dict(finite_element)
        name += "".join(f", {field} {value}" for field, value in finite_element.items())
    exact = {q: case.quantities[q] for q in COMPARED if q in case.quantities}
    kind = "hardness" if np.isfinite(case.hardness) else "sliding" if case.coupled else "Hertz"
    if exact.get("tau1_max_depth") == 0.0:
        kind = "surface"
    return ExactScene(name, case.source, kind, tables, exact, case.pressure)


def layer_scene(reference: LayerReference, nu: float) -> ExactScene:
    """A rigid cylinder on a layer of Poisson's ratio `nu`."""
    modulus = LAYER_MODULUS / (1.0 - nu**2)
    load = reference.load * modulus * LAYER_THICKNESS**2 / LAYER_RADIUS
    tables = {
        "roller": {"radius": LAYER_RADIUS, "rigid": True},
        "body": {
            **elastic_table(Material(LAYER_MODULUS, nu)),
            "thickness": LAYER_THICKNESS,
            "base": reference.base,
        },
        "load": {"per_length": load},
        "budget": LINEAR,
    }
    exact = {
        "peak_pressure": reference.peak_pressure * modulus * LAYER_THICKNESS / LAYER_RADIUS,
        "contact_length": 2.0 * reference.half_width * LAYER_THICKNESS,
    }
    name = f"layer, {reference.base}, nu = {nu:g}, a = {reference.half_width:g} t"
    return ExactScene(name, LAYER_SOURCE, "layer", tables, exact, models=("finite_element",))


def scene_cases(scenes: Iterable[ExactScene]) -> list[Trial]:
    return [
        Trial(scene.kind, scene.name, model, partial(scene_figures, scene, model))
        for scene in scenes
        for model in scene.models
    ]


def scene_figures(scene: ExactScene, model: str) -> Iterator[Figure]:
    """Solve a scene with one model, as `run` does, and compare each figure with the exact one.
    Where the half-plane's are known too, both solve it, and its model error is compared."""
    asked = Scene.of(scene.tables, Origin("verify", source=f"verify: {scene.name}"))
    surface = surface_of(asked, scene.trace, standard=False)
    problem = problem_of(asked, surface, levels=LEVELS)
    (friction,) = asked.load.friction
    posed = unsolved(problem, make_plan(problem, MODELS if scene.half_plane else (model,)))
    solved = refined(posed, tasks := Tasks())
    figures = Figures(contact.solve(solved, {}, None).figures)
    runs = solved.runs.values()
    converged = all(level.solution.converged for run in runs for level in run.levels)
    common = scene.source, scene.kind, converged
    for quantity, exact in scene.exact.items():
        yield from compared(figures.one(source=model, quantity=quantity), exact, *common)
    if scene.half_plane:
        errors = Figures(studied(JUDGED, solved, tasks)[MODEL_ERROR].figures)
        half_plane = scene.half_plane(problem)
        for quantity, exact in scene.exact.items():
            error = errors.one(against=WHOLE, quantity=quantity, friction=friction)
            yield from compared(_by_itself(error), half_plane[quantity] / exact - 1.0, *common)
    if scene.pressure is not None:
        curves = ((level.grid.x, level.solution.pressure) for level in solved.runs[model].levels)
        errors = tuple(relative_l2(p, scene.pressure(x)) for x, p in curves)
        yield Figure("pressure", PRESSURE, model, errors[-1], against=EXACT, levels=errors)


def _by_itself(error: Figure) -> Figure:
    """A model error with one uncertainty for all causes, and no levels."""
    value, stated = error.value, error.numerical
    known = Convergence(value, value, stated, 1.0, None, "too few levels")
    return Figure(
        *(MODEL_ERROR, error.quantity, "half_plane", value),
        against=WHOLE,
        uncertainty=Uncertainty({"discretisation": stated}, known),
        levels=(value,),
    )


def smooth_half_plane(problem: Problem) -> dict[str, float]:
    """Hertz's figures."""
    hertz = problem.hertz
    return {"peak_pressure": hertz.peak_pressure, "contact_length": 2.0 * hertz.half_width}


def fine_half_plane(problem: Problem) -> dict[str, float]:
    """Figures of the half-plane on the FINE level."""
    [level] = scene_model("half_plane", problem).solve(Here(), problem, FINE).values()
    return values_of(level, problem)


def elastic_table(material: Material | None) -> dict:
    """A material as a scene's table has it; None is rigid."""
    if material is None:
        return {"rigid": True}
    return {"youngs_modulus": material.youngs_modulus, "poissons_ratio": material.poissons_ratio}
