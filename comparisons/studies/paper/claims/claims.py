"""What the paper claims, and how a number judges it: confirmed, denied, or it cannot be told.

A number confirms where its whole uncertainty lies inside the claim's bounds, and denies where it
lies outside of them (of wider ones, where the paper gives words and no number). A claim is told
only where all models that can measure it say the same, and never where the stand-in profile was
made to show it.
"""

from dataclasses import dataclass
from math import inf, isfinite

from comparisons.common.model_names import LABELS
from comparisons.common.numbers import plain, significant
from comparisons.results.outcome import Outcome
from comparisons.studies.paper.claims.views import Measured, Reading, measured

CONFIRMED, DENIED, UNTOLD = "confirmed", "denied", "cannot be told"
OUTCOMES = (CONFIRMED, DENIED, UNTOLD)
BOTH = ("half_plane", "finite_element")

Bounds = tuple[float, float]


@dataclass(frozen=True)
class Claim:
    """One claim.

    key       for paper.json
    figure    of the paper that shows it, with its letter
    title     in a few words
    text      what the paper says, in words of this project
    measure   how the number is found
    scene     whose stresses it is about
    reading   of the number
    confirms  bounds of the number inside which the claim holds
    unit      "" | "a" | "p₀"
    allows    wider bounds, outside of which it is denied; None: the same
    vague     why nothing is told between the two
    tuned     the figure that the stand-in profile was made to show, so that it proves nothing
    models    that can measure it
    exact     the number is an error against an exact value
    besides   further numbers, by what they are
    """

    key: str
    figure: str
    title: str
    text: str
    measure: str
    scene: str
    reading: Reading
    confirms: Bounds
    unit: str = ""
    allows: Bounds | None = None
    vague: str | None = None
    tuned: str | None = None
    models: tuple[str, ...] = BOTH
    exact: bool = False
    besides: tuple[tuple[str, Reading], ...] = ()

    @property
    def criterion(self) -> str:
        """What would confirm the claim, and what deny it."""
        if self.allows is None:
            return f"Confirmed {_range(self.confirms, self.unit)}, else denied."
        return (
            f"Confirmed {_range(self.confirms, self.unit)}, "
            f"denied unless {_range(self.allows, self.unit)}."
        )


@dataclass(frozen=True)
class Judged:
    """A claim with its outcome.

    numbers  by model
    besides  by what they are, then by model
    outcome  of OUTCOMES
    why      it cannot be told; None where it can
    """

    claim: Claim
    numbers: dict[str, Measured]
    besides: dict[str, dict[str, float]]
    outcome: str
    why: str | None = None

    def as_dict(self) -> dict:
        """For paper.json: None stands for a bound or an uncertainty that there is not."""
        claim = self.claim
        return {
            "key": claim.key,
            "figure": claim.figure,
            "title": claim.title,
            "text": claim.text,
            "measure": claim.measure,
            "scene": claim.scene,
            "unit": {"p₀": "p0"}.get(claim.unit, claim.unit),
            "confirmed_within": [_finite(bound) for bound in claim.confirms],
            "denied_outside": [_finite(bound) for bound in claim.allows or claim.confirms],
            "criterion": claim.criterion,
            "numbers": {
                model: {
                    "value": _finite(number.value),
                    "uncertainty": _finite(number.uncertainty),
                    "converged": number.converged,
                }
                for model, number in self.numbers.items()
            },
            "besides": {
                words: {model: _finite(value) for model, value in values.items()}
                for words, values in self.besides.items()
            },
            "outcome": self.outcome,
            "why": self.why,
        }


def judge(claim: Claim, outcome: Outcome) -> Judged:
    """Measure a claim on the run of its scene by every model that can, and judge it."""
    numbers = {m: measured(outcome, m, claim.reading, claim.exact) for m in claim.models}
    besides = {
        words: {m: measured(outcome, m, reading, exact=True).value for m in claim.models}
        for words, reading in claim.besides
    }
    return Judged(claim, numbers, besides, *told(claim, numbers))


def told(claim: Claim, numbers: dict[str, Measured]) -> tuple[str, str | None]:
    """Outcome, and why it cannot be told."""
    unsolved = [LABELS[model] for model, number in numbers.items() if not number.converged]
    if unsolved:
        return UNTOLD, f"the contact of the {' and the '.join(unsolved)} did not converge"
    places = {model: _place(claim, number) for model, number in numbers.items()}
    unclear = [LABELS[model] for model, place in places.items() if place == "on a bound"]
    if unclear:
        return UNTOLD, (
            f"the numerical uncertainty of the {' and the '.join(unclear)} reaches over a bound"
        )
    if len(set(places.values())) > 1:
        return UNTOLD, "the two models do not say the same"
    (place,) = set(places.values())
    if place == "between":
        return UNTOLD, claim.vague
    if place == "outside":
        return DENIED, None
    if claim.tuned:
        return UNTOLD, (
            f"the stand-in profile was made to show {claim.tuned}, so that the number is met "
            "proves nothing"
        )
    return CONFIRMED, None


def _place(claim: Claim, number: Measured) -> str:
    """Where a number with its uncertainty lies: inside | outside | between | on a bound."""
    low, high = number.value - number.uncertainty, number.value + number.uncertainty
    inner, outer = claim.confirms, claim.allows or claim.confirms
    if not (isfinite(low) and isfinite(high)):
        return "on a bound"
    if inner[0] <= low and high <= inner[1]:
        return "inside"
    if high < outer[0] or low > outer[1]:
        return "outside"
    clear_of_inner = high < inner[0] or low > inner[1]
    if clear_of_inner and outer[0] <= low and high <= outer[1]:
        return "between"
    return "on a bound"


def with_symbol(value: float, unit: str, digits: int = 3) -> str:
    """A number with the symbol that it is in."""
    return f"{significant(value, digits)} {unit}".rstrip()


def _range(bounds: Bounds, unit: str) -> str:
    low, high = bounds
    if low == -inf:
        return f"up to {plain(high)} {unit}".rstrip()
    if high == inf:
        return f"from {plain(low)} {unit}".rstrip() + " on"
    return f"from {plain(low)} to {plain(high)} {unit}".rstrip()


def _finite(value: float) -> float | None:
    return float(value) if isfinite(value) else None
