"""The verdict: in a word, in one sentence with the number that decides it, and why.

In: the figures of a run. Out: what terminal, page, JUnit and result.json say alike."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from comparisons.common.numbers import given_percent, percent, plain, significant, with_unit
from comparisons.figures.figure import Figure
from comparisons.figures.quantity import HYPHENATED, LABELS, QUANTITIES, error_text, label
from comparisons.models.assumptions import without_law
from comparisons.studies import contact, coupling, yielding
from comparisons.studies.model_error.account import INTERACTION
from comparisons.studies.model_error.catalogue import EFFECTS
from comparisons.studies.model_error.selection import law_leaned_on
from comparisons.studies.scatter.figures import NAME as SCATTER
from comparisons.studies.scatter.figures import by_inputs
from comparisons.studies.scatter.show import beside_inputs
from comparisons.studies.study import MODEL_ERROR, Run

REMEDIES = {
    "law_of_elasticity": "; body.law and roller.law can name one",
    "roller_support": "; roller.support can name one",
}
Kind = Literal["holds", "fails", "inconclusive", "not compared", "not converged"]


@dataclass(frozen=True)
class Headline:
    """`kind` in a word or two, and the sentence."""

    kind: Kind
    sentence: str


def verdict_of(run: Run) -> tuple[Kind, str]:
    """Whether the half-plane's assumption holds in a scene, and which figures decide it."""
    if not run.converged:
        return "not converged", f"a solver did not converge ({_unconverged(run)})"
    if not run.plan.compares:
        [name] = run.runs
        return "not compared", f"only the {HYPHENATED[name]} model was run"
    kind, why = validity(run.model_errors)
    why += law_leaned_on(run.data(MODEL_ERROR).selection, run.problem.scene)
    if flows := run.found[yielding.NAME].said(yielding.BEYOND_DOUBT):
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


def remedies(run: Run) -> tuple[str, ...]:
    """What would decide an open verdict, as text to paste into the scene or the command."""
    kind, _ = verdict_of(run)
    if kind == "not compared":
        return (f"--models {','.join(HYPHENATED.values())}",)
    if kind != "inconclusive":
        return ()
    if not run.model_errors:
        return ("[tolerance]\npeak_pressure = 0.02",)
    worst = _nearest([error for error in run.model_errors if error.verdict != "holds"])
    if not worst.unknown or worst.is_unresolved:
        return (f"[budget]\ntime = {2.0 * run.problem.scene.budget.time:g}",)
    largest, selection = max(worst.unknown, key=worst.unknown.get), run.data(MODEL_ERROR).selection
    if largest == "law_of_elasticity":
        bodies = without_law(run.problem.scene)
        return tuple(f'[{name}]\nlaw = "neo-hookean"' for name in bodies)
    if largest == "roller_support":
        return ('[roller]\nsupport = "opposite"',)
    asked = "budget.effects" in selection.impossible.get(largest, "")
    return ('[budget]\neffects = "all"',) if asked else ()


def headline(run: Run) -> Headline:
    """What the reader needs first: the verdict, and what there is to say of flow."""
    kind, _ = verdict_of(run)
    if kind == "not converged":
        said = f"A solver did not converge ({_unconverged(run)}): what was computed is shown, "
        return Headline(kind, f"{said}but no conclusion rests on it.")
    said, flow = _sentence_of(run), _sentence(yielding.flow_sentence(run))
    if run.plan.compares and run.found[yielding.NAME].said(yielding.BEYOND_DOUBT):
        return Headline(kind, f"{flow} Were it elastic: {said[0].lower()}{said[1:]}")
    return Headline(kind, f"{said} {_inputs(run)}{flow}")


def _sentence_of(run: Run) -> str:
    """The half-plane's model errors, or the only model."""
    if not run.plan.compares:
        return _one_model(run)
    errors = run.model_errors
    kind, _ = validity(errors)
    several = len(run.problem.scene.load.friction) > 1
    law = law_leaned_on(run.data(MODEL_ERROR).selection, run.problem.scene)
    if kind == "holds":
        nearest = _said(_nearest(errors), several)
        said = f"{_allvalidity(errors)}; nearest to its tolerance, {nearest}"
        return f"The half-plane holds here: {said}{law}."
    if kind == "fails":
        outside = [error for error in errors if error.verdict == "fails"]
        worst, more = _nearest(outside), len(outside) - 1
        are = "are" if more > 1 else "is"
        others = f"; {more} more of {len(errors)} judged errors {are} outside" if more else ""
        return f"The half-plane fails here: {_said(worst, several)}{_dominant(worst)}{others}{law}."
    said = _inconclusive(errors, several) if errors else "no figure has a tolerance"
    return f"The half-plane cannot be judged here: {said}."


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
    return beside_inputs(run, error.quantity, error.friction) + " "


def _sentence(text: str) -> str:
    return f"{text[0].upper()}{text[1:]}."


def _inconclusive(errors: Sequence[Figure], several: bool) -> str:
    """What prevents a verdict: the uncertainty of an error, or what is not modelled."""
    worst = _nearest([error for error in errors if error.verdict != "holds"])
    if not worst.unknown or worst.is_unresolved:
        return f"{_said(worst, several)}, an uncertainty that reaches across the tolerance"
    largest = max(worst.unknown, key=worst.unknown.get)
    remedy = REMEDIES.get(largest, "")
    return (
        f"{_said(worst, several)}, but effects that are not modelled may change it by "
        f"{percent(worst.not_modelled)} (estimate), {EFFECTS[largest].label} most{remedy}"
    )


def _allvalidity(errors: Sequence[Figure]) -> str:
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
    return (
        f"its model error in the {label(error.quantity)}{where} is "
        f"{error_text(error.quantity, error.value, error.numerical)} (tolerance "
        f"{given_percent(error.tolerance)}, uncertainty {percent(error.numerical)})"
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
    return (
        f"Only the {HYPHENATED[name]} model was run: peak pressure {with_unit(peak, 'Pa')}, "
        f"{significant(peak / p0)} times Hertz, contact length {with_unit(length, 'm')}; nothing "
        "was compared."
    )


def _unconverged(run: Run) -> str:
    found = [
        f"{LABELS[name]}, pressure elements of {with_unit(level.grid.pitch, 'm', 3)}"
        for name, model in run.runs.items()
        for level in model.levels
        if not level.solution.converged
    ]
    moved = run.data(coupling.NAME)
    found += [
        f"half-plane with normal-tangential coupling, friction {plain(each.friction)}"
        for each in (moved.changes if moved else ())
        if not each.converged
    ]
    run_in = run.problem.surface.run_in
    if run_in is not None and not run_in.converged:
        failed = sum(not one.converged for one in run_in.passes)
        found.insert(0, f"running-in, {failed} of {len(run_in.passes)} passes")
    return ", ".join(found)
