"""The verdict: in a word, in one sentence with what decides it, and what to do next.

In: the figures of a run. Out: what terminal, page, JUnit and result.json say alike.

What stands first is how far the half-plane is right: the least tolerance at which every judged
figure holds, the largest `Figure.reach` of the judged model errors. What else may move one of them
belongs into its uncertainty or its estimates, where the verdict sees it, too; what leaves all of
them unknown is said instead."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import inf, isfinite
from typing import Literal

from comparisons.common.numbers import (
    percent,
    percent_as_written,
    plain,
    rounded_up,
    significant,
    with_unit,
)
from comparisons.figures.figure import Figure, deciding
from comparisons.figures.quantity import HYPHENATED, LABELS, QUANTITIES
from comparisons.judging import contact, yielding
from comparisons.judging.effects.catalogue import EFFECTS, FLOW, SAMPLING
from comparisons.judging.model_error.model_error import INTERACTION
from comparisons.judging.model_error.show import (
    beside_its_range,
    flow_taken,
    leaves_flow_out,
    sized_by_law,
)
from comparisons.judging.study import CONVERGED, MODEL_ERROR, Run
from comparisons.judging.verdict.next_step import next_of, pasted
from comparisons.models.assumptions import WITHIN_LINEAR, laws, question, without_law

Kind = Literal["holds", "fails", "inconclusive", "not compared", "not converged"]
FLOWS = "No figure of an elastic body holds at such stresses."
MAY_FLOW = "Nothing said of an elastic body will hold."
UNFOUNDED = "What was computed is shown, but no conclusion rests on it."
SMALL = 0.02  # of an error's reach: what is not modelled is not said below it


@dataclass(frozen=True)
class Within:
    """The least tolerance at which every judged figure of a run holds."""

    size: float | None  # relative; None: not known
    figure: Figure | None  # that makes it, or that is not known
    said: str  # that figure with its error, or why it is not known, as a clause
    asked: str = ""  # within what it is meant, where that is not everything

    @property
    def sentence(self) -> str:
        if self.size is None:
            said = f"how wrong the half-plane may be here is not known: {self.said}."
        else:
            size = percent_as_written(rounded_up(self.size))
            how = f"right within {size}" if self.size < 1.0 else f"off by up to {size}"
            said = f"the half-plane is {how} here (largest: {self.said})."
        said = f"{self.asked}, {said}" if self.asked else said
        return said[0].upper() + said[1:]


def within_of(run: Run) -> Within:
    asked = question(run.problem.scene)
    if found := obstacle(run):
        return Within(None, None, found.why, asked)
    largest = max(run.model_errors, key=lambda error: (not isfinite(error.reach), error.reach))
    if isfinite(largest.reach):
        said = f"{name_of(run, largest)}, {size_of(run, largest)}"
        return Within(largest.reach, largest, said, asked)
    open_effects = (name for name, size in largest.unknown.items() if not isfinite(size))
    what = f"the {name_of(run, largest)}, whose uncertainty has no bound"
    if effect := next(open_effects, ""):
        why = run.data(MODEL_ERROR).selection.impossible.get(effect, "")
        what = f"the effect of {EFFECTS[effect].label} on the {name_of(run, largest)}"
        what += f" ({why})" if why else ""
    return Within(None, largest, what, asked)


def name_of(run: Run, error: Figure) -> str:
    """A judged error's quantity, and its friction coefficient where there are several."""
    several = len(run.problem.scene.load.friction) > 1
    at = f" at friction {plain(error.friction)}" if several else ""
    return f"{QUANTITIES[error.quantity].short}{at}"


def size_of(run: Run, error: Figure) -> str:
    """An error with its uncertainty, its range by the law of elasticity, and what else may add; of
    one that leaves flow out, what that may change alone."""
    if leaves_flow_out(run, error):
        return f"{percent(error.unknown[FLOW])} by {EFFECTS[FLOW].label}, which is not modelled"
    size = f"{sized_by_law(error).removesuffix(' %')} ± {percent(error.numerical)}"
    others = beside_its_range(error)
    if others <= SMALL * error.reach:
        return size
    sampled = error.unknown.get(SAMPLING, 0.0) > 0.5 * others
    by = f", mostly {EFFECTS[SAMPLING].label}" if sampled else ""
    return f"{size}, {percent(others)} not modelled{by}"


@dataclass(frozen=True)
class Obstacle:
    """Reason why a run's errors give no verdict."""

    kind: Kind
    why: str  # nothing is known of these, as a clause
    said: str  # in place of what decides, a sentence


def obstacle(run: Run) -> Obstacle | None:
    """Obstacle to a verdict; None where the errors decide."""
    if not run.converged:
        why = f"a solver did not converge ({', '.join(_not_converged(run))})"
        return Obstacle("not converged", why, UNFOUNDED)
    if not run.plan.compares:
        [name, *_] = run.runs
        why = f"only the {HYPHENATED[name]} model was run"
        return Obstacle("not compared", why, _one_model(run))
    said = run.findings[yielding.NAME].said
    if flows := said(yielding.BEYOND_DOUBT):
        return Obstacle("fails", flows, FLOWS)
    flows = said(yielding.AT_SUCH_STRESSES)
    if flows and not run.problem.scene.asks_elastic:
        return Obstacle("inconclusive", flows, MAY_FLOW)
    if not run.model_errors:
        return Obstacle("inconclusive", "no figure has a tolerance", "Nothing is judged.")
    return None


def _not_converged(run: Run) -> list[str]:
    """Levels of the models, and studies of further solutions."""
    said = dict.fromkeys(
        f"{LABELS[name]}, pressure elements of {with_unit(level.grid.pitch, 'm', 3)}"
        for case in run.solved.cases
        for name, model in case.runs.items()
        for level in model.levels
        if not level.converged
    )
    failed = (
        ", ".join(filter(None, (study.replace("_", " "), LABELS.get(words.source, words.source))))
        for study, found in run.findings.items()
        for words in found.statements
        if (words.name, words.text) == (CONVERGED, "no") and study != contact.NAME
    )
    return [*said, *failed]


def _one_model(run: Run) -> str:
    wanted = ("peak_pressure", "contact_length")
    peak, length = (run.figures.one(study=contact.NAME, quantity=name).value for name in wanted)
    p0 = run.problem.hertz.peak_pressure
    smooth = "the mean" if run.problem.scene.periodic else "Hertz"
    others = any(study.verdicts(run) for study in run.studies)
    compared = "only answers from outside were" if others else "nothing was"
    return (
        f"Peak pressure {with_unit(peak, 'Pa')}, {significant(peak / p0)} times {smooth}, contact "
        f"length {with_unit(length, 'm')}; {compared} compared."
    )


@dataclass(frozen=True)
class Headline:
    """Words that the reader needs first: within what the half-plane is right, the verdict on the
    tolerances in a word or two and a sentence, and what would decide or improve it."""

    within: Within
    kind: Kind
    sentence: str
    next: str  # a sentence
    paste: tuple[str, ...] = ()  # the same as commands to paste


def kind_of(run: Run) -> Kind:
    """Whether the half-plane's assumption holds in a scene."""
    found = obstacle(run)
    return found.kind if found else validity(run.model_errors)


def validity(errors: Sequence[Figure]) -> Kind:
    """Verdict by the judged model errors alone."""
    verdicts = {error.verdict for error in errors}
    if "fails" in verdicts:
        return "fails"
    return "holds" if verdicts == {"holds"} else "inconclusive"


@lru_cache(maxsize=1)  # what Next offers is posed anew
def headline(run: Run) -> Headline:
    """The verdict does not repeat what is said of the least tolerance."""
    within, kind = within_of(run), kind_of(run)
    said, offers = _sentence(run, kind, within), next_of(run, kind)
    words = "; or ".join(offer.says for offer in offers)
    paste = tuple(text for offer in offers for text in pasted(run, offer))
    return Headline(within, kind, said, f"{words}.", paste)


def _sentence(run: Run, kind: Kind, within: Within) -> str:
    if found := obstacle(run):
        return found.said
    error = deciding(run.model_errors)
    said = _decided(run, kind, within, error)
    law = "" if kind == "inconclusive" else _law_leaned_on(run)
    asked = f", {WITHIN_LINEAR}" if run.problem.scene.linear else ""
    idle = kind == "holds" and FLOW in run.data(MODEL_ERROR).selection.found
    clauses = f"{law}{asked}{f'; {yielding.IDLE}' if idle else ''}"
    remarks = (study.remark(run, error) for study in run.studies)
    return " ".join(filter(None, (f"{said[0].upper()}{said[1:]}{clauses}.", *remarks)))


def verdicts(run: Run, said: Headline) -> list[tuple[str, str]]:
    """Verdicts on the half-plane and of studies: a word or two and a sentence."""
    others = (verdict for study in run.studies for verdict in study.verdicts(run))
    return [(kind.upper(), sentence) for kind, sentence in ((said.kind, said.sentence), *others)]


def _decided(run: Run, kind: Kind, within: Within, error: Figure) -> str:
    """Decision of an error on the tolerances, without a full stop."""
    if kind == "inconclusive":
        return _inconclusive(run, within, error)
    errors = run.model_errors
    if kind == "holds":
        nearest = _other(run, within, error, "; nearest to its tolerance: ")
        return f"every judged error is within {_tolerance(errors)}{nearest}"
    count = sum(one.verdict == "fails" for one in errors)
    are, which = ("are", "; the farthest: ") if count > 1 else ("is", ": ")
    said = f"{count} of {len(errors)} judged errors {are} outside {_tolerance(errors)}"
    said += _other(run, within, error, which)
    taken = flow_taken(errors.of(friction=error.friction))
    return f"{taken}; {said}" if taken else f"{said}{_dominant(error)}"


def _tolerance(errors: Sequence[Figure]) -> str:
    written = {percent_as_written(error.tolerance) for error in errors}
    return f"the tolerance of {written.pop()}" if len(written) == 1 else "its tolerance"


def _other(run: Run, within: Within, error: Figure, words: str) -> str:
    """An error that decides, in words, where it is not the largest, which is described already."""
    if error is within.figure:
        return ""
    tolerances = {figure.tolerance for figure in run.model_errors}
    its = f" (tolerance {percent_as_written(error.tolerance)})" if len(tolerances) > 1 else ""
    return f"{words}{name_of(run, error)}, {size_of(run, error)}{its}"


def _law_leaned_on(run: Run) -> str:
    """End of a sentence: the whole model's law of elasticity, or that none changes the
    verdict; nothing where it deforms little."""
    selection, scene = run.data(MODEL_ERROR).selection, run.problem.scene
    if "finite_strain" not in selection.whole or FLOW in selection.whole:  # that has Hencky's
        return ""
    if not without_law(scene):
        return f", with {laws(scene)} elasticity"
    solved = any(not law.is_scatter for law in selection.laws)
    return ", whatever the law of elasticity" if solved else ""


def _inconclusive(run: Run, within: Within, worst: Figure) -> str:
    """Reason for no verdict: the uncertainty of an error, or what is not modelled."""
    error = _other(run, within, worst, "the error of ") or "this error"
    largest, tolerance = worst.largest_unknown, _tolerance([worst])
    if worst.not_modelled == inf:
        return "an error of unknown size lies within no tolerance"
    if not largest or worst.is_unresolved:
        return f"the uncertainty of {error} reaches across {tolerance}"
    if worst.part(largest) is not None:  # its range
        return f"by the law of elasticity {error} reaches across {tolerance}"
    why = run.data(MODEL_ERROR).selection.impossible.get(largest)
    return (
        f"{EFFECTS[largest].label}, which is not modelled{f' ({why})' if why else ''}, may change "
        f"{error} by {percent(worst.not_modelled)} (estimate), across {tolerance}"
    )


def _dominant(error: Figure) -> str:
    """Clause that the effects interact, or on the one that makes more than half of an error."""
    sizes = {part.name: abs(part.value) for part in error.parts if part.name in EFFECTS}
    joint = error.part(INTERACTION)
    if sizes and abs(joint.value) > max(sizes.values()):
        return "; the effects interact"
    largest = max(sizes, key=sizes.get, default=None)
    if largest is None or sizes[largest] <= 0.5 * abs(error.value):
        return ""
    return f", dominated by {EFFECTS[largest].label}"
