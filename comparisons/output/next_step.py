"""What to do next: a sentence, and the same as text to paste into the scene or the command.

In: a run and its verdict. Out: what would decide or improve it."""

import math

from comparisons.common.numbers import plain, with_unit
from comparisons.figures.figure import Figure, nearest_to_tolerance
from comparisons.figures.quantity import QUANTITIES, label
from comparisons.models.forecast import time_with_flow
from comparisons.scenes.materials import kinds_like, measured_solids
from comparisons.scenes.sections import ElasticSection
from comparisons.studies.model_error.account import INPUTS
from comparisons.studies.model_error.laws import EFFECT as LAW
from comparisons.studies.model_error.selection import FLOW
from comparisons.studies.model_error.show import ROUNDING, figure_of_whole
from comparisons.studies.study import MODEL_ERROR, Run
from comparisons.studies.subsurface import yielding

AT_TOLERANCE = 0.2  # of the tolerance: an error that is certain to that and still not decided


def worst_of(run: Run) -> Figure:
    """The error that is farthest from a verdict that holds."""
    return nearest_to_tolerance([error for error in run.model_errors if error.verdict != "holds"])


def next_of(run: Run, kind: str) -> tuple[str, tuple[str, ...]]:
    """What would decide or improve a verdict on elastic bodies: a sentence, and text to paste."""
    if not run.model_errors:
        paste = "[tolerance]\npeak_pressure = 0.02"
        return "a tolerance, to judge by: tolerance = {peak_pressure = 0.02}.", (paste,)
    if kind != "inconclusive":
        unknown = yielding.may_flow(run, at_any=kind == "fails")
        if unknown:
            return f'body.yield_stress = "…": {unknown}.', ()
        whole = f"{_figures_of_whole(run)} in place of the half-plane's."
        return ("nothing." if kind == "holds" else whole), ()
    worst = worst_of(run)
    holds_at = _rounded_up(worst.reach)
    tolerance = f"--tolerance {holds_at:g}" if holds_at else ""
    largest = max(worst.unknown, key=worst.unknown.get, default="")
    why = run.data(MODEL_ERROR).selection.impossible.get(largest, "")
    not_asked = "budget.effects" in why
    if largest == LAW and not worst.is_unresolved and not not_asked:
        return _next_of_law(run, worst, tolerance)
    if worst.is_unresolved and worst.uncertainty.parts.get(INPUTS, 0.0) > 0.5 * worst.numerical:
        return f"{tolerance} holds; third-order constants are measured no better.", (tolerance,)
    if worst.is_unresolved or not worst.unknown:
        if worst.total <= AT_TOLERANCE * worst.tolerance:
            said = f"{tolerance} holds: the error lies at the tolerance, and more digits decide "
            return f"{said}nothing that matters.", (tolerance,)
        time = 2.0 * run.problem.scene.budget.time
        said = f"budget = {{time = {time:g}}}, finer levels for a smaller uncertainty."
        return said, (f"[budget]\ntime = {time:g}",)
    if not_asked:
        asked = "true" if "not asked for" in why else '"all"'
        return f"budget.effects = {asked} computes it.", (f"[budget]\neffects = {asked}",)
    if largest == "roller_support":
        paste = '[roller]\nsupport = "opposite"'
        others = '"half disc" or {hub = "…"}'
        return f'roller.support = "opposite", {others}: what holds the roller.', (paste,)
    if largest == "finite_strain" and (time := run.data(MODEL_ERROR).selection.time):
        time = _rounded_up(time)
        return f"budget.time = {time:g} computes it.", (f"[budget]\ntime = {time:g}",)
    if largest == "plastic_flow":
        paste = "[finite_element]\nplastic = true"
        missing = "" if run.problem.scene.body.yield_stress else ", with body.yield_stress,"
        return f"finite_element.plastic = true{missing} computes it.", (paste,)
    return f"{tolerance} holds.", (tolerance,)


def _next_of_law(run: Run, worst: Figure, tolerance: str) -> tuple[str, tuple[str, ...]]:
    """Name the solid; where that is done, what is not known of it."""
    scene = run.problem.scene
    ranges = (law for law in run.data(MODEL_ERROR).selection.laws if not law.is_scatter)
    sections = {name: getattr(scene, name) for law in ranges for name in law.bodies}
    unnamed = {name: part for name, part in sections.items() if part.solid is None}
    if unnamed:
        paste = tuple(f'[{name}]\nmaterial = "{_like(part)}"' for name, part in unnamed.items())
        fields = " and ".join(f'{n}.material = "{_like(s)}"' for n, s in unnamed.items())
        return f"{fields}, or what it is (crosscheck materials), for its moduli.", paste
    unmeasured = dict.fromkeys(part.solid for part in sections.values())
    if not unmeasured:
        return f"{tolerance} holds.", (tolerance,)
    known = f"no third-order constants of {' or '.join(unmeasured)} are published"
    return f"{tolerance} holds; {known}.", (tolerance,)


def _like(section: ElasticSection) -> str:
    """A measured solid that a body may be."""
    kinds = kinds_like(section.youngs_modulus, section.poissons_ratio)
    return next((solid.name for solid in measured_solids(*kinds) if kinds), "…")


def next_of_flow(run: Run) -> tuple[str, tuple[str, ...]]:
    """Where a body flows beyond doubt, and no model of the run does."""
    problem = run.problem
    why = run.data(MODEL_ERROR).selection.impossible.get(FLOW, "")
    if problem.scene.body.yield_stress is None:
        return 'body.yield_stress = "…" computes the flow.', ()
    if "budget.effects" in why:
        return "budget.effects = true computes the flow.", ("[budget]\neffects = true",)
    if "budget.time" in why:
        patches = run.runs["half_plane"].levels[0].patches
        time = _rounded_up(time_with_flow(problem, run.plan, patches))
        return f"budget.time = {time:g} computes the flow.", (f"[budget]\ntime = {time:g}",)
    return f"a scene whose flow can be computed: {why}.", ()


def _figures_of_whole(run: Run) -> str:
    """The figures to use instead, at the largest friction."""
    friction = max(run.problem.scene.load.friction)
    shown = [
        f"{label(error.quantity)} "
        f"{with_unit(figure_of_whole(run, error), QUANTITIES[error.quantity].unit)}"
        for error in run.model_errors
        if error.friction == friction
    ]
    where = f" (friction {plain(friction)})" if len(run.problem.scene.load.friction) > 1 else ""
    return f"take the whole model's {', '.join(shown)}{where}" if shown else "take the whole model"


def _rounded_up(size: float) -> float | None:
    """To two digits, a tolerance that a user would write; None where it is not known."""
    if not math.isfinite(size) or size <= 0.0:
        return None
    step = 10.0 ** (math.floor(math.log10(size)) - 1)
    return round(math.ceil(size / step * (1.0 - ROUNDING)) * step, 12)
