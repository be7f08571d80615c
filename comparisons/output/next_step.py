"""What to do next: a sentence, and the same as text to paste into the scene or the command.

In: a run and its verdict. Out: what would decide or improve it."""

import math

import numpy as np

from comparisons.common.numbers import percent, plain, with_unit
from comparisons.figures.figure import Figure, nearest_to_tolerance
from comparisons.figures.quantity import QUANTITIES, WHOLE, label
from comparisons.models.forecast import time_with_flow
from comparisons.scenes.materials import kinds_like, measured_solids
from comparisons.scenes.sections import ElasticSection
from comparisons.studies.model_error.account import INPUTS
from comparisons.studies.model_error.catalogue import EFFECTS
from comparisons.studies.model_error.laws import EFFECT as LAW
from comparisons.studies.model_error.sampling import EFFECT as SAMPLING
from comparisons.studies.model_error.selection import FLOW
from comparisons.studies.model_error.show import ROUNDING, figure_of_whole
from comparisons.studies.study import LADDER, MODEL_ERROR, Run
from comparisons.studies.subsurface import yielding

SHEARS = ("tau1_max", "txz_max_abs")
LINEAR = "--law linear"
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
    if largest == FLOW:
        return next_of_flow(run)
    if largest == SAMPLING:
        finer = "a trace with more samples on the contact"
        return (f"{finer}; {tolerance} holds.", (tolerance,)) if tolerance else (f"{finer}.", ())
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
        either = f"{fields}, or what it is (crosscheck materials), for its moduli"
        return f"{either}; {tolerance} holds{_or_linear(run)}.", paste
    unmeasured = dict.fromkeys(part.solid for part in sections.values())
    if not unmeasured:
        return f"{tolerance} holds.", (tolerance,)
    known = f"no third-order constants of {' or '.join(unmeasured)} are published"
    linear = (LINEAR,) if _or_linear(run) else ()
    return f"{tolerance} holds{_or_linear(run)}; {known}.", (tolerance, *linear)


def _or_linear(run: Run) -> str:
    """For the end of a clause: the question of a textbook, where the scene can ask it."""
    if run.problem.scene.finite_element.deformation == "finite":
        return ""
    return f", or {LINEAR}: within linear elasticity"


def _like(section: ElasticSection) -> str:
    """A measured solid that a body may be."""
    kinds = kinds_like(section.youngs_modulus, section.poissons_ratio)
    return next((solid.name for solid in measured_solids(*kinds) if kinds), "…")


def next_of_flow(run: Run) -> tuple[str, tuple[str, ...]]:
    """Where a body flows, or may, and no model of the run does."""
    problem = run.problem
    why = run.data(MODEL_ERROR).selection.impossible.get(FLOW, "")
    if problem.scene.body.yield_stress is None:
        linear = (LINEAR,) if _or_linear(run) else ()
        return f'body.yield_stress = "…" computes the flow{_or_linear(run)}.', linear
    if "budget.effects" in why:
        return "budget.effects = true computes the flow.", ("[budget]\neffects = true",)
    if "budget.time" in why:
        patches = run.runs["half_plane"].levels[0].patches
        time = _rounded_up(time_with_flow(problem, run.plan, patches))
        return f"budget.time = {time:g} computes the flow.", (f"[budget]\ntime = {time:g}",)
    return f"a scene whose flow can be computed: {why}.", ()


def _figures_of_whole(run: Run) -> str:
    """The figures to use instead, at the largest friction, each with its uncertainty; before them
    those that are not known to their tolerance, or that the body cannot bear, and why."""
    friction, known = max(run.problem.scene.load.friction), run.figures.of(study=LADDER)
    offered, withheld = [], {}
    for error in run.model_errors.of(friction=friction):
        of_whole = known.one(source=WHOLE, quantity=error.quantity, friction=friction) or error
        unsure, value = of_whole.total, figure_of_whole(run, error)
        borne = _borne(run, friction) if error.quantity in SHEARS else math.inf
        size = with_unit(value, QUANTITIES[error.quantity].unit)
        figure = f"{label(error.quantity)} {size} ± {percent(unsure)}"
        if value > borne:
            why = f"more than the body bears, {with_unit(borne, 'Pa')}"
            withheld.setdefault(why, []).append(figure)
        elif not unsure <= error.tolerance:
            largest = max(of_whole.unknown, key=of_whole.unknown.get, default="")
            why = "finer levels take more budget.time"
            if of_whole.not_modelled > of_whole.numerical:
                why = f"{EFFECTS[largest].label} is not modelled"
            withheld.setdefault(f"not known to the tolerance ({why})", []).append(figure)
        else:
            offered.append(figure)
    where = f" (friction {plain(friction)})" if len(run.problem.scene.load.friction) > 1 else ""
    said = f"take the whole model's {', '.join(offered)}" if offered else "take no figure"
    words = (f"{', '.join(figures)}: {why}" for why, figures in withheld.items())
    return "; ".join([*words, f"{said}{where}"])


def _borne(run: Run, friction: float) -> float:
    """The largest shear [Pa] that a body bears which flows in the whole model: by von Mises, with
    what it has hardened by; infinite where the flow stress is not known."""
    body = run.problem.scene.body
    if body.yield_stress is None or FLOW not in run.data(MODEL_ERROR).selection.whole:
        return math.inf
    flow = body.flow_stress()
    wanted = {"study": yielding.NAME, "quantity": yielding.PLASTIC_STRAIN, "source": WHOLE}
    strain = run.figures.one(**wanted, friction=friction)
    if strain is None:
        hardens = flow.slope(np.zeros(1))[0] or flow.kinematic
        return math.inf if hardens else flow.yield_stress / 3.0**0.5
    most = strain.value * (1.0 + strain.numerical)
    # Prager's back stress in tension is H' times the plastic strain
    return float(flow.stress(most) + flow.kinematic * most) / 3.0**0.5


def _rounded_up(size: float) -> float | None:
    """To two digits, a tolerance that a user would write; None where it is not known."""
    if not math.isfinite(size) or size <= 0.0:
        return None
    step = 10.0 ** (math.floor(math.log10(size)) - 1)
    return round(math.ceil(size / step * (1.0 - ROUNDING)) * step, 12)
