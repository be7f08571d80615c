"""What the paper claims, and how a number judges it: confirmed, denied, or inconclusive.

A number confirms a claim where its whole uncertainty lies inside the claim's bounds, and denies it
where it lies outside of them (of wider bounds where the paper gives words and no number). The
outcome is inconclusive unless all models that can measure the claim say the same, and wherever the
stand-in profile was made to show what the claim says."""

from dataclasses import asdict, dataclass, replace
from math import inf

from comparisons.campaigns.paper.claims.readings import SLIDING, LevelView, Reading
from comparisons.common.numbers import finite, plain
from comparisons.figures.convergence import grid_convergence
from comparisons.figures.quantity import LABELS, MODELS
from comparisons.figures.uncertainty import iteration
from comparisons.figures.verdict import is_within
from comparisons.studies.contact import by_repetition
from comparisons.studies.study import MODEL_ERROR, Run

CONFIRMED, DENIED, INCONCLUSIVE = "confirmed", "denied", "inconclusive"
OUTCOMES = (CONFIRMED, DENIED, INCONCLUSIVE)
THEORY = "theory"  # what judges a claim that neither model solves
ORDER = 1.0  # formal, of what is read: with it a regular sequence gets the widest margin

PLAIN = ("key", "figure", "title", "text", "measure", "scene")  # fields of a claim in paper.json

Bounds = tuple[float, float]


@dataclass(frozen=True)
class Claim:
    """One claim."""

    key: str  # for paper.json
    figure: str  # of the paper that shows it, with its letter
    title: str  # in a few words
    text: str  # what the paper says, in words of this project
    measure: str  # how the number is found
    scene: str  # whose stresses it is about
    reading: Reading  # of the number
    confirms: Bounds  # bounds of the number inside which the claim holds
    unit: str = ""  # "" | "a" | "p₀"
    allows: Bounds | None = None  # wider bounds, outside of which it is denied; None: the same
    ambiguity: str | None = None  # why a number between the two is inconclusive
    # what the stand-in profile was made to show, so that it proves nothing
    tuned: str | None = None
    models: tuple[str, ...] = MODELS  # that can measure it
    exact: bool = False  # the number is an error against an exact value
    besides: tuple[tuple[str, Reading], ...] = ()  # further numbers, by what they are
    # the compared one whose model error bears on the number; None: no figure of a real contact
    quantity: str | None = None
    slides: bool = False  # the number is one of the sliding contact

    @property
    def criterion(self) -> str:
        """What would confirm the claim, and what deny it."""
        confirmed = f"Confirmed {_range(self.confirms, self.unit)}"
        if self.allows is None:
            return f"{confirmed}, else denied."
        return f"{confirmed}, denied unless {_range(self.allows, self.unit)}."


@dataclass(frozen=True)
class MeasuredNumber:
    """A number of one model with what numerical error may account for, both in its unit."""

    value: float
    # 0 of an error against an exact value; infinite where fewer than three levels are known
    uncertainty: float
    converged: bool = True  # all levels met their contact conditions


@dataclass(frozen=True)
class FigureModelError:
    """The half-plane's model error in the quantity of a claim's figure, relative."""

    quantity: str
    # value, uncertainty: of the effects that were computed
    value: float
    uncertainty: float
    not_modelled: dict[str, float]  # estimates of the others, by name


@dataclass(frozen=True)
class JudgedClaim:
    """A claim with its outcome."""

    claim: Claim
    numbers: dict[str, MeasuredNumber]  # by model
    besides: dict[str, dict[str, float]]  # by what they are, then by model
    outcome: str  # one of OUTCOMES
    why: str | None = None  # why it is inconclusive; None where it is not
    model_error: FigureModelError | None = None  # of its figure; None where there is none

    def as_dict(self) -> dict:
        """For paper.json: None stands for what is infinite."""
        claim = self.claim
        content = {
            **{name: getattr(claim, name) for name in PLAIN},
            "unit": {"p₀": "p0"}.get(claim.unit, claim.unit),
            "confirmed_within": claim.confirms,
            "denied_outside": claim.allows or claim.confirms,
            "criterion": claim.criterion,
            "numbers": {model: asdict(number) for model, number in self.numbers.items()},
            "besides": self.besides,
            "outcome": self.outcome,
            "why": self.why,
            "model_error": self.model_error and asdict(self.model_error),
        }
        return finite(content)


def judge(claim: Claim, outcome: Run) -> JudgedClaim:
    """Measure a claim on the run of its scene by every model that can, and judge it."""
    numbers = {m: measured(outcome, m, claim.reading, claim.exact) for m in claim.models}
    besides = {
        words: {m: measured(outcome, m, reading, exact=True).value for m in claim.models}
        for words, reading in claim.besides
    }
    error = model_error_of(claim, outcome)
    return JudgedClaim(claim, numbers, besides, *judgement(claim, numbers), error)


def model_error_of(claim: Claim, outcome: Run) -> FigureModelError | None:
    """What the half-plane does not model in the figure of a claim."""
    friction = SLIDING if claim.slides else 0.0
    wanted = {"study": MODEL_ERROR, "quantity": claim.quantity, "friction": friction}
    error = outcome.figures.one(**wanted)
    if error is None:
        return None
    return FigureModelError(error.quantity, error.value, error.numerical, dict(error.unknown))


def measured(outcome: Run, model: str, reading: Reading, exact: bool = False) -> MeasuredNumber:
    """A number on the finest level of a model, with its uncertainty from all levels.

    Discretisation, far boundary and iteration as for a run's figures; besides, what reading only
    every second row and column of the window changes.
    exact  the number is an error against an exact value: it has no uncertainty of its own"""
    run = outcome.runs[model]
    views = [LevelView(model, outcome.problem, level, outcome.window) for level in run.levels]
    values = [reading(view) for view in views]
    value = values[-1]
    converged = all(level.solution.converged for level in run.levels)
    if exact:
        return MeasuredNumber(value, 0.0, converged)
    uncertainty = grid_convergence(values, ORDER).uncertainty
    uncertainty += iteration(run.finest) * abs(value)
    uncertainty += abs(reading(replace(views[-1], every=2)) - value)
    repeated = by_repetition(
        run,
        lambda level: {"": reading(LevelView(model, outcome.problem, level, outcome.window))},
    )
    uncertainty += sum(repeated[""])
    return MeasuredNumber(value, float(uncertainty), converged)


def judgement(claim: Claim, numbers: dict[str, MeasuredNumber]) -> tuple[str, str | None]:
    """Outcome by the numbers of each model, and why it is inconclusive."""
    unsolved = [LABELS[model] for model, number in numbers.items() if not number.converged]
    if unsolved:
        return INCONCLUSIVE, f"the contact of the {' and the '.join(unsolved)} did not converge"
    places = {model: _place(claim, number) for model, number in numbers.items()}
    unclear = [LABELS[model] for model, place in places.items() if place == "on a bound"]
    if unclear:
        return INCONCLUSIVE, (
            f"the numerical uncertainty of the {' and the '.join(unclear)} reaches over a bound"
        )
    if len(set(places.values())) > 1:
        return INCONCLUSIVE, "the two models do not say the same"
    (place,) = set(places.values())
    if place == "between":
        return INCONCLUSIVE, claim.ambiguity
    if place == "outside":
        return DENIED, None
    if claim.tuned:
        return INCONCLUSIVE, (
            f"the stand-in profile was made to show {claim.tuned}, so that the number is met "
            "proves nothing"
        )
    return CONFIRMED, None


def _place(claim: Claim, number: MeasuredNumber) -> str:
    """Where a number with its uncertainty lies: inside | outside | between | on a bound."""
    inner, outer = (
        is_within(number.value, number.uncertainty, *bounds)
        for bounds in (claim.confirms, claim.allows or claim.confirms)
    )
    if inner:
        return "inside"
    if outer is False:
        return "outside"
    return "between" if outer and inner is False else "on a bound"


def _range(bounds: Bounds, unit: str) -> str:
    low, high = bounds
    if high == inf:
        return f"from {plain(low)} {unit}".rstrip() + " on"
    return f"from {plain(low)} to {plain(high)} {unit}".rstrip()
