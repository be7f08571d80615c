"""The verdict: in a word, in one sentence with what decides it, and what to do next.

In: the figures of a run. Out: what terminal, page, JUnit and result.json say alike."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import inf

from comparisons.common.numbers import percent, percent_as_written
from comparisons.figures.figure import Figure, deciding
from comparisons.judging import yielding
from comparisons.judging.effects.catalogue import EFFECTS, FLOW
from comparisons.judging.model_error.model_error import INTERACTION
from comparisons.judging.model_error.show import flow_taken
from comparisons.judging.study import MODEL_ERROR, Run
from comparisons.judging.verdict.next_step import next_of, pasted
from comparisons.judging.verdict.within import Kind, Within, name_of, obstacle, size_of, within_of
from comparisons.models.assumptions import WITHIN_LINEAR, laws, without_law


@dataclass(frozen=True)
class Headline:
    """What the reader needs first, in this order: within what the half-plane is right, the verdict
    on the tolerances in a word or two and a sentence, and what would decide or improve it."""

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
    """By the judged model errors alone."""
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
    error = deciding(run.model_errors) if run.model_errors else None
    said = "nothing is judged" if error is None else _decided(run, kind, within, error)
    law = "" if kind == "inconclusive" else _law_leaned_on(run)
    asked = f", {WITHIN_LINEAR}" if run.problem.scene.linear else ""
    idle = kind == "holds" and FLOW in run.data(MODEL_ERROR).selection.found
    clauses = f"{law}{asked}{f'; {yielding.IDLE}' if idle else ''}"
    remarks = [study.remark(run, error) for study in run.studies] if error else []
    return " ".join(filter(None, (f"{said[0].upper()}{said[1:]}{clauses}.", *remarks)))


def verdicts(run: Run, said: Headline) -> list[tuple[str, str]]:
    """That on the half-plane, and those of studies: a word or two and a sentence."""
    others = (verdict for study in run.studies for verdict in study.verdicts(run))
    return [(kind.upper(), sentence) for kind, sentence in ((said.kind, said.sentence), *others)]


def _decided(run: Run, kind: Kind, within: Within, error: Figure) -> str:
    """What an error decides on the tolerances, without a full stop."""
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
    """For the end of a sentence: the law of elasticity that the whole has, or that none changes the
    verdict; nothing where the whole deforms little."""
    selection, scene = run.data(MODEL_ERROR).selection, run.problem.scene
    if "finite_strain" not in selection.whole or FLOW in selection.whole:  # that has Hencky's
        return ""
    if not without_law(scene):
        return f", with {laws(scene)} elasticity"
    solved = any(not law.is_scatter for law in selection.laws)
    return ", whatever the law of elasticity" if solved else ""


def _inconclusive(run: Run, within: Within, worst: Figure) -> str:
    """What prevents a verdict: the uncertainty of an error, or what is not modelled."""
    if run.findings[yielding.NAME].said(yielding.AT_SUCH_STRESSES) and not within.figure:
        return "nothing said of an elastic body will hold"
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
    """That the effects interact, or the one that makes more than half of an error, if any does."""
    sizes = {part.name: abs(part.value) for part in error.parts if part.name in EFFECTS}
    joint = error.part(INTERACTION)
    if sizes and abs(joint.value) > max(sizes.values()):
        return "; the effects interact"
    largest = max(sizes, key=sizes.get, default=None)
    if largest is None or sizes[largest] <= 0.5 * abs(error.value):
        return ""
    return f", dominated by {EFFECTS[largest].label}"
