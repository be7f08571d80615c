"""The verdict: in a word, in one sentence with the figure that decides it, and what to do next.

In: the figures of a run. Out: what terminal, page, JUnit and result.json say alike."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from comparisons.common.numbers import percent, percent_as_written, plain, significant, with_unit
from comparisons.figures.figure import Figure
from comparisons.figures.quantity import HYPHENATED, LABELS, QUANTITIES, error_text, label
from comparisons.models.assumptions import laws, without_law
from comparisons.models.forecast import time_with_flow
from comparisons.scenes.materials import kinds_like, measured_solids
from comparisons.scenes.sections import ElasticSection
from comparisons.studies import contact
from comparisons.studies.friction import coupling
from comparisons.studies.model_error.account import INPUTS, INTERACTION
from comparisons.studies.model_error.catalogue import EFFECTS
from comparisons.studies.model_error.laws import EFFECT as LAW
from comparisons.studies.model_error.selection import FLOW
from comparisons.studies.model_error.show import ROUNDING, figure_of_whole, flow_taken, law_range
from comparisons.studies.scatter.study import beside_inputs, by_inputs
from comparisons.studies.study import MODEL_ERROR, SCATTER, Run
from comparisons.studies.subsurface import yielding

Kind = Literal["holds", "fails", "inconclusive", "not compared", "not converged"]
AT_TOLERANCE = 0.2  # of the tolerance: an error that is certain to that and still not decided


@dataclass(frozen=True)
class Headline:
    """`kind` in a word or two, the sentence, and what would decide or improve it."""

    kind: Kind
    sentence: str
    next: str  # a sentence
    paste: tuple[str, ...] = ()  # the same as text for the scene or the command


def verdict_of(run: Run) -> tuple[Kind, str]:
    """Whether the half-plane's assumption holds in a scene, and which figures decide it."""
    if not run.converged:
        return "not converged", f"a solver did not converge ({_unconverged(run)})"
    if not run.plan.compares:
        [name] = run.runs
        return "not compared", f"only the {HYPHENATED[name]} model was run"
    kind, why = validity(run.model_errors)
    why += _law_leaned_on(run)
    if flows := run.findings[yielding.NAME].said(yielding.BEYOND_DOUBT):
        return "fails", f"{flows}; {why}"
    return kind, why


def validity(errors: Sequence[Figure]) -> tuple[Kind, str]:
    """By the judged model errors alone."""
    if not errors:
        return "inconclusive", "no quantity was judged against a tolerance"
    outside = [error for error in errors if error.verdict == "fails"]
    if outside:
        return "fails", f"outside the tolerance: {_named(outside)}"
    unclear = [error for error in errors if error.verdict != "holds"]
    if not unclear:
        nearest = _named([_nearest(errors)])
        return "holds", f"every judged error is within its tolerance; nearest: {nearest}"
    numerical = [error for error in unclear if error.is_unresolved]
    if numerical:
        return "inconclusive", f"an error cannot be told from its tolerance: {_named(numerical)}"
    why = "what no model of this run contains may move an error across its tolerance"
    return "inconclusive", f"{why}: {_named(unclear)}, by {_effects(unclear)}"


def _named(errors: Sequence[Figure]) -> str:
    return ", ".join(
        f"{e.quantity} {e.value:+.2%} +- {e.numerical:.2%} at friction {e.friction:g} "
        f"(tolerance {e.tolerance:.2g})"
        for e in errors
    )


def _effects(errors: Sequence[Figure]) -> str:
    """The largest estimate of each effect."""
    largest: dict[str, float] = {}
    for error in errors:
        for name, size in error.unknown.items():
            largest[name] = max(size, largest.get(name, 0.0))
    by_size = sorted(largest.items(), key=lambda item: -item[1])
    return ", ".join(f"{EFFECTS[name].label} {size:.1%}" for name, size in by_size)


def headline(run: Run) -> Headline:
    """What the reader needs first: the verdict, and the one thing to do about it."""
    kind, _ = verdict_of(run)
    if kind == "not converged":
        said = f"A solver did not converge ({_unconverged(run)}): what was computed is shown, "
        remedy = "a lighter load, or finer pressures (resolution.pitch)."
        return Headline(kind, f"{said}but no conclusion rests on it.", remedy)
    if kind == "not compared":
        both = f"--models {','.join(HYPHENATED.values())}"
        return Headline(kind, _one_model(run), f"{both} compares both models.", (both,))
    if flows := run.findings[yielding.NAME].said(yielding.BEYOND_DOUBT):
        return Headline(kind, f"{flows[0].upper()}{flows[1:]}.", *_next_of_flow(run))
    return Headline(kind, f"{_sentence_of(run, kind)}{_inputs(run)}", *_next(run, kind))


def _sentence_of(run: Run, kind: Kind) -> str:
    """What the half-plane's model errors come to."""
    errors = run.model_errors
    several = len(run.problem.scene.load.friction) > 1
    law = _law_leaned_on(run)
    if kind == "holds":
        nearest = _nearest(errors)
        said = f"{_all_hold(errors)}; nearest to its tolerance, {_said(nearest, several)}"
        return f"The half-plane holds here: {said}{'' if law_range(nearest) else law}."
    if kind == "fails":
        outside = [error for error in errors if error.verdict == "fails"]
        worst, more = _nearest(outside), len(outside) - 1
        taken = flow_taken([e for e in errors if e.friction == worst.friction])
        taken = f"{taken}; " if taken else ""
        are = "are" if more > 1 else "is"
        others = f"; {more} more of {len(errors)} judged errors {are} outside" if more else ""
        said = f"{taken}{_said(worst, several)}{'' if taken else _dominant(worst)}{others}{law}"
        return f"The half-plane fails here: {said}."
    said = _inconclusive(run, several) if errors else "no figure has a tolerance"
    return f"The half-plane cannot be judged here: {said}."


def _law_leaned_on(run: Run) -> str:
    """For the end of a sentence: the law of elasticity that the whole has, or that none changes the
    verdict; nothing where the whole deforms little."""
    selection, scene = run.data(MODEL_ERROR).selection, run.problem.scene
    if "finite_strain" not in selection.whole or FLOW in selection.whole:  # that has Hencky's
        return ""
    if not without_law(scene):
        return f", with {laws(scene)} elasticity"
    solved = any(not law.is_scatter for law in selection.laws)
    return ", whatever the law of elasticity" if solved else ""


def _inputs(run: Run) -> str:
    """What uncertain inputs do to the figure that decides, where that is more than its tolerance:
    a model error below that is not what a user would see first."""
    if not run.model_errors:
        return ""
    error = _nearest(run.model_errors)
    wanted = {"quantity": error.quantity, "friction": error.friction}
    figure = run.figures.one(study=SCATTER, **wanted)
    if figure is None or by_inputs(figure) <= error.tolerance:
        return ""
    return f" {beside_inputs(run, error.quantity, error.friction)}"


def _inconclusive(run: Run, several: bool) -> str:
    """What prevents a verdict: the uncertainty of an error, or what is not modelled."""
    worst = _worst(run)
    largest = max(worst.unknown, key=worst.unknown.get, default="")
    is_solved = worst.part(largest) is not None  # its range
    if not largest or worst.is_unresolved or is_solved:
        return f"{_said(worst, several)}, an uncertainty that reaches across the tolerance"
    why = run.data(MODEL_ERROR).selection.impossible.get(largest)
    return (
        f"{_said(worst, several)}, but {EFFECTS[largest].label}, which is not modelled"
        f"{f' ({why})' if why else ''}, may change it by {percent(worst.not_modelled)} (estimate)"
    )


def _worst(run: Run) -> Figure:
    """The error that is farthest from a verdict that holds."""
    return _nearest([error for error in run.model_errors if error.verdict != "holds"])


def _all_hold(errors: Sequence[Figure]) -> str:
    if len(errors) == 1:
        return "the one judged error is within its tolerance"
    several = "both" if len(errors) == 2 else f"all {len(errors)}"
    return f"{several} judged errors are within their tolerances"


def _nearest(errors: Sequence[Figure]) -> Figure:
    """The one farthest outside, or nearest to, its tolerance, uncertainty included."""
    return max(errors, key=lambda error: (abs(error.value) + error.total) / error.tolerance)


def _said(error: Figure, several: bool) -> str:
    """An error of the half-plane as a clause: what, how much, tolerance, uncertainty."""
    stress = QUANTITIES[error.quantity].needs_stress
    where = f" at friction {plain(error.friction)}" if several and stress else ""
    size = error_text(error.value, error.numerical)
    if by_law := law_range(error):
        size = f"{by_law} by the law of elasticity"
    return (
        f"its model error in the {label(error.quantity)}{where} is {size} (tolerance "
        f"{percent_as_written(error.tolerance)}, uncertainty {percent(error.numerical)})"
    )


def _dominant(error: Figure) -> str:
    """That the effects interact, or the one that makes more than half of an error, if any does."""
    sizes = {part.name: abs(part.value) for part in error.parts if part.name in EFFECTS}
    joint = error.part(INTERACTION)
    if sizes and abs(joint.value) > max(sizes.values()):
        return "; the effects interact"
    largest = max(sizes, key=sizes.get, default=None)
    if largest is None or sizes[largest] <= 0.5 * abs(error.value):
        return ""
    return f", dominated by {EFFECTS[largest].label}"


def _next(run: Run, kind: Kind) -> tuple[str, tuple[str, ...]]:
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
    worst = _worst(run)
    holds_at = _rounded_up(abs(worst.value) + worst.total)
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


def _next_of_flow(run: Run) -> tuple[str, tuple[str, ...]]:
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


def _one_model(run: Run) -> str:
    [name] = run.runs
    known = run.figures.of(study=contact.NAME, source=name)
    peak, p0 = known.one(quantity="peak_pressure").value, run.problem.hertz.peak_pressure
    length = known.one(quantity="contact_length").value
    smooth = "the mean" if run.problem.scene.periodic else "Hertz"
    return (
        f"Only the {HYPHENATED[name]} model was run: peak pressure {with_unit(peak, 'Pa')}, "
        f"{significant(peak / p0)} times {smooth}, contact length {with_unit(length, 'm')}; "
        "nothing was compared."
    )


def _unconverged(run: Run) -> str:
    said = [
        f"{LABELS[name]}, pressure elements of {with_unit(level.grid.pitch, 'm', 3)}"
        for name, model in run.runs.items()
        for level in model.levels
        if not level.converged
    ]
    said += [
        f"half-plane with normal-tangential coupling, friction {plain(change.friction)}"
        for change in run.data(coupling.NAME) or ()
        if not change.converged
    ]
    run_in = run.problem.surface.run_in
    if run_in is not None and not run_in.converged:
        failed = sum(not one.converged for one in run_in.passes)
        said.insert(0, f"running-in, {failed} of {len(run_in.passes)} passes")
    return ", ".join(said)
