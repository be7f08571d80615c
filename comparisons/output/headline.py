"""The verdict: in a word, in one sentence with the figure that decides it, and what to do next.

In: the figures of a run. Out: what terminal, page, JUnit and result.json say alike."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from comparisons.common.numbers import percent, percent_as_written, plain, significant, with_unit
from comparisons.figures.figure import Figure, nearest_to_tolerance
from comparisons.figures.quantity import HYPHENATED, LABELS, QUANTITIES, error_text, label
from comparisons.models.assumptions import laws, without_law
from comparisons.output.next_step import next_of, next_of_flow, worst_of
from comparisons.studies import contact
from comparisons.studies.friction import coupling
from comparisons.studies.model_error.account import INTERACTION
from comparisons.studies.model_error.catalogue import EFFECTS
from comparisons.studies.model_error.selection import FLOW
from comparisons.studies.model_error.show import flow_taken, law_range
from comparisons.studies.scatter.study import beside_inputs, by_inputs
from comparisons.studies.study import MODEL_ERROR, SCATTER, Run
from comparisons.studies.subsurface import yielding

Kind = Literal["holds", "fails", "inconclusive", "not compared", "not converged"]


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
        nearest = _named([nearest_to_tolerance(errors)])
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
        return Headline(kind, f"{flows[0].upper()}{flows[1:]}.", *next_of_flow(run))
    return Headline(kind, f"{_sentence_of(run, kind)}{_inputs(run)}", *next_of(run, kind))


def _sentence_of(run: Run, kind: Kind) -> str:
    """What the half-plane's model errors come to."""
    errors = run.model_errors
    several = len(run.problem.scene.load.friction) > 1
    law = _law_leaned_on(run)
    if kind == "holds":
        nearest = nearest_to_tolerance(errors)
        said = f"{_all_hold(errors)}; nearest to its tolerance, {_said(nearest, several)}"
        return f"The half-plane holds here: {said}{'' if law_range(nearest) else law}."
    if kind == "fails":
        outside = [error for error in errors if error.verdict == "fails"]
        worst, more = nearest_to_tolerance(outside), len(outside) - 1
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
    error = nearest_to_tolerance(run.model_errors)
    wanted = {"quantity": error.quantity, "friction": error.friction}
    figure = run.figures.one(study=SCATTER, **wanted)
    if figure is None or by_inputs(figure) <= error.tolerance:
        return ""
    return f" {beside_inputs(run, error.quantity, error.friction)}"


def _inconclusive(run: Run, several: bool) -> str:
    """What prevents a verdict: the uncertainty of an error, or what is not modelled."""
    worst = worst_of(run)
    largest = max(worst.unknown, key=worst.unknown.get, default="")
    is_solved = worst.part(largest) is not None  # its range
    if not largest or worst.is_unresolved or is_solved:
        return f"{_said(worst, several)}, an uncertainty that reaches across the tolerance"
    why = run.data(MODEL_ERROR).selection.impossible.get(largest)
    return (
        f"{_said(worst, several)}, but {EFFECTS[largest].label}, which is not modelled"
        f"{f' ({why})' if why else ''}, may change it by {percent(worst.not_modelled)} (estimate)"
    )


def _all_hold(errors: Sequence[Figure]) -> str:
    if len(errors) == 1:
        return "the one judged error is within its tolerance"
    several = "both" if len(errors) == 2 else f"all {len(errors)}"
    return f"{several} judged errors are within their tolerances"


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
