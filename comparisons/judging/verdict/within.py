"""How far the half-plane is right: the least tolerance at which every judged figure holds.

In: a finished run. Out: that number and the figure that makes it, or why there is none; and the
sentence that stands first wherever a run is shown.

It is the largest `Figure.reach` of the judged model errors. What else may move one of them belongs
into its uncertainty or its estimates, where the verdict sees it, too; what leaves all of them
unknown is said in its place."""

from dataclasses import dataclass
from decimal import ROUND_CEILING, Decimal
from math import hypot, isfinite
from typing import Literal

from comparisons.common.numbers import percent, percent_as_written, plain, significant, with_unit
from comparisons.figures.figure import Figure
from comparisons.figures.quantity import HYPHENATED, LABELS, QUANTITIES, error_text
from comparisons.judging import contact, yielding
from comparisons.judging.effects.catalogue import EFFECTS, FLOW, SAMPLING
from comparisons.judging.model_error.show import law_range, leaves_flow_out
from comparisons.judging.study import CONVERGED, MODEL_ERROR, Run
from comparisons.models.assumptions import question

Kind = Literal["holds", "fails", "inconclusive", "not compared", "not converged"]
DIGITS = 2  # of a tolerance that a user would write
FLOWS = "No figure of an elastic body holds at such stresses."
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
    if why := _why_unknown(run):
        return Within(None, None, why, asked)
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


def rounded_up(size: float) -> float:
    """To two digits, never below it: a tolerance that a user would write."""
    exact = Decimal(repr(size))
    step = Decimal(1).scaleb(exact.adjusted() - DIGITS + 1)
    return float(exact.quantize(step, ROUND_CEILING)) if size else size


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
    size = law_range(error) or error_text(error.value, error.numerical)
    size = f"{size.removesuffix(' %')} ± {percent(error.numerical)}"
    others = hypot(*(of for name, of in error.unknown.items() if not error.part(name)))
    if others <= SMALL * error.reach:
        return size
    sampled = error.unknown.get(SAMPLING, 0.0) > 0.5 * others
    by = f", mostly {EFFECTS[SAMPLING].label}" if sampled else ""
    return f"{size}, {percent(others)} not modelled{by}"


@dataclass(frozen=True)
class Obstacle:
    """What keeps a run from a verdict by its errors."""

    kind: Kind
    why: str  # nothing is known of these, as a clause
    said: str  # in place of what decides, a sentence


def obstacle(run: Run) -> Obstacle | None:
    """None where the errors decide."""
    if not run.converged:
        why = f"a solver did not converge ({', '.join(_not_converged(run))})"
        return Obstacle("not converged", why, UNFOUNDED)
    if not run.plan.compares:
        [name, *_] = run.runs
        why = f"only the {HYPHENATED[name]} model was run"
        return Obstacle("not compared", why, _one_model(run))
    flows = run.findings[yielding.NAME].said(yielding.BEYOND_DOUBT)
    return None if flows is None else Obstacle("fails", flows, FLOWS)


def _why_unknown(run: Run) -> str:
    """Why it is not known, as a clause; nothing where that does not apply."""
    if found := obstacle(run):
        return found.why
    at_such = run.findings[yielding.NAME].said(yielding.AT_SUCH_STRESSES)
    flows = "" if run.problem.scene.asks_elastic else at_such
    return flows or ("" if run.model_errors else "no figure has a tolerance")


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
