"""Problem that was asked: smooth contact under the load, the scene's groups, surface and plan.

In: a problem, its plan, and how far each model is known. Out: figures that need no solution, or of
which it is a part; what was skipped and assumed, in words; the levels that were planned."""

from collections.abc import Mapping
from dataclasses import asdict, replace

from comparisons.figures.figure import Figure, Findings, Series, Statement, columns_of, figures_of
from comparisons.figures.quantity import Quantity
from comparisons.figures.uncertainty import Uncertainty
from comparisons.judging import contact
from comparisons.judging.effects.catalogue import with_effects
from comparisons.judging.study import MODEL_ERROR, Solved, Study
from comparisons.models.assumptions import assumptions_of
from comparisons.models.plan import forecast
from comparisons.scenes.surface import ProfileInfo

NAME, ASSUMED = "problem", "assumed"  # the study; its statements of what models assume
HERTZ, SCENE, PRESSED, STANDARD = "hertz", "scene", "as pressed", "standard"  # sources
QUANTITIES = {
    "half_width": Quantity("half-width a of the smooth contact", "m"),
    "peak_pressure": Quantity("peak pressure p₀ of the smooth contact", "Pa"),
    "reduced_modulus": Quantity("combined modulus E*", "Pa"),
    "tau1_max": Quantity("largest τ₁ of the smooth contact", "Pa"),
    "tau1_max_depth": Quantity("its depth", "m"),
    "a_over_thickness": Quantity("half-width over thickness, a/t"),
    "a_over_radius": Quantity("half-width over radius, a/R"),
    "a_over_width": Quantity("half-width over width, a/w"),
    "rms_slope": Quantity("rms slope"),
    "max_slope": Quantity("largest slope"),
    "friction_dundurs": Quantity("friction times Dundurs' β, µβ"),
    "peak_pressure_over_hardness": Quantity("peak pressure over hardness, p/H"),
    **{name: Quantity(name.capitalize(), "m") for name in ("ra", "rq", "rt", "rz", "rsm")},
    **{name: Quantity(name.capitalize()) for name in ("rsk", "rku", "rdq", "sections")},
    "mean": Quantity("mean height", "m"),
    "cutoff": Quantity("cut-off λc", "m"),
    "short_cutoff": Quantity("cut-off λs", "m"),
    "start": Quantity("start of the first section length", "m"),
}
GROUPS = tuple(QUANTITIES)[5:12]


def solve(solved: Solved, before: Mapping[str, Findings], tasks: object) -> Findings:
    """`before` has the models' figures: a load that they find is as uncertain as they are."""
    problem, hertz = solved.problem, solved.problem.hertz
    known = before[contact.NAME].figures
    unsure = _largest(known) if problem.scene.load.kind == "approach" else None
    smooth = {
        "half_width": hertz.half_width,
        "peak_pressure": hertz.peak_pressure,
        "reduced_modulus": hertz.combined_modulus,
    }
    if not problem.scene.periodic:
        smooth |= {"tau1_max": hertz.tau1_max, "tau1_max_depth": hertz.tau1_max_depth}
    figures = figures_of(NAME, HERTZ, smooth, unsure)
    scene, half_width, info = problem.scene, hertz.half_width, problem.surface.info
    body, roughness = scene.body, info and info.roughness
    groups = {
        "a_over_thickness": body.thickness and half_width / body.thickness,
        "a_over_radius": None if scene.periodic else half_width / scene.roller.radius,
        "a_over_width": body.width and half_width / body.width,
        "rms_slope": None if roughness is None else roughness.rms_slope,
        "max_slope": None if roughness is None else roughness.max_slope,
        "friction_dundurs": max(scene.load.friction) * problem.dundurs_beta,
    }
    figures += figures_of(NAME, SCENE, groups, unsure)
    if (hardness := problem.scene.body.hardness) is not None:
        peaks = [f for f in known if f.quantity == "peak_pressure"]
        over = {"peak_pressure_over_hardness": max(f.value for f in peaks) / hardness}
        figures += figures_of(NAME, SCENE, over, _largest(peaks))
    figures += figures_of_surface(info)
    levels = [asdict(level) for level in forecast(problem, solved.plan).levels]
    columns = columns_of(levels, {"pitch": "m", "seconds": "s", "memory": "byte"})
    planned = Series("planned levels", columns, is_account=True)
    return Findings(tuple(figures), (planned,), tuple(_statements(solved, before)))


def figures_of_surface(info: ProfileInfo | None) -> list[Figure]:
    """Roughness as pressed and, where it is known, by the standard; none of a smooth body."""
    if info is None:
        return []
    filters = {"cutoff": info.cutoff, "short_cutoff": info.short_cutoff}
    figures = figures_of(NAME, PRESSED, asdict(info.roughness) | filters)
    standard = {} if info.standard is None else asdict(info.standard)
    return figures + figures_of(NAME, STANDARD, standard)


def _largest(figures: tuple[Figure, ...] | list[Figure]) -> Uncertainty:
    """The largest uncertainty of any of these."""
    worst = max((f for f in figures if f.levels), key=lambda f: f.numerical)
    return Uncertainty(worst.uncertainty.parts)


def _statements(solved: Solved, before: Mapping[str, Findings]) -> list[Statement]:
    """Assumptions, what was skipped, why refinement stopped, why there are no standard figures."""
    plan, info = solved.plan, solved.problem.surface.info
    said = [Statement(ASSUMED, text) for text in assumed(solved, before.get(MODEL_ERROR))]
    said += [Statement("skipped", why, step) for step, why in plan.skipped.items()]
    said.append(Statement("refinement", solved.refinement))
    if info is not None and info.standard_why is not None:
        said.append(Statement("no standard parameters", info.standard_why, STANDARD))
    return said


def assumed(solved: Solved, errors: Findings | None) -> tuple[str, ...]:
    """Assumptions of the models, the whole model among them where it has more effects."""
    own, problem = solved.plan.assumptions, solved.problem
    if errors is None or not (errors.data.wholes and errors.data.selection.added):
        return own
    whole = replace(problem, scene=with_effects(problem.scene, errors.data.selection.whole))
    said = [text.replace("finite elements:", "whole model:") for text in assumptions_of(whole)]
    others = [text for text in own if "finite elements:" in text]
    others = others or ["the finite elements beside the whole model: as the half-plane"]
    return (*said, *others)


STUDY = Study(NAME, QUANTITIES, solve)
