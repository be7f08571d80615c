"""From differences and uncertainties to verdicts, by one rule.

A difference d with uncertainty U stands for the interval d +- U. The verdict is yes where the whole
interval is within the tolerance, |d| + U <= tolerance; no where all of it is beyond,
|d| - U > tolerance; and inconclusive where it reaches across, or where U is not known. Everything
that is judged is judged so: the models' difference, the model error, points of maps, settings of a
cost study, claims of the paper."""

import math
from dataclasses import dataclass
from typing import Literal

Verdict = Literal["agree", "differ", "inconclusive"]
Validity = Literal["holds", "fails", "inconclusive"]
SMALL = 1.0 / 3.0  # of what is not modelled: a numerical uncertainty that hardly matters


@dataclass(frozen=True)
class Comparison:
    """One quantity at one friction coefficient; figures in SI, the last three relative."""

    quantity: str
    friction: float
    half_plane: float | None  # None for a norm of the difference
    finite_element: float | None  # None as well
    # (half-plane - finite element) / finite element, or the norm; where the finite elements' value
    # vanishes, over the Hertz contact's
    difference: float
    uncertainty: float | None  # of the difference, numerical: both models' together
    tolerance: float | None  # None: not judged
    verdict: Verdict | None  # None: not judged


def is_within(value: float, uncertainty: float, low: float, high: float) -> bool | None:
    """Whether value +- uncertainty lies between the bounds, which belong to the inside: all of it
    (True), nothing (False), or neither (None), as where one is not finite. All in one unit."""
    first, last = value - uncertainty, value + uncertainty
    if not (math.isfinite(first) and math.isfinite(last)):
        return None
    if low <= first and last <= high:
        return True
    return False if last < low or first > high else None


def judge(difference: float, uncertainty: float, tolerance: float) -> Verdict:
    """Verdict on a relative difference, by the rule above."""
    verdicts = {True: "agree", False: "differ", None: "inconclusive"}
    return verdicts[is_within(difference, uncertainty, -tolerance, tolerance)]


@dataclass(frozen=True)
class ToleranceCheck:
    """The half-plane's model error in a judged quantity against its tolerance; all relative."""

    quantity: str
    friction: float
    value: float  # half-plane against finite elements with every effect that matters
    uncertainty: float  # numerical, of `value`
    # by name, estimates of the effects that no model has; independent of each other
    not_modelled: dict[str, float]
    tolerance: float

    @property
    def total_uncertainty(self) -> float:
        """Uncertainty and what is not modelled."""
        return self.uncertainty + self.unknown

    @property
    def unknown(self) -> float:
        """Root of the sum of squares of what is not modelled."""
        return math.hypot(*self.not_modelled.values())

    @property
    def verdict(self) -> Validity:
        """By the rule of `judge`, with the whole uncertainty."""
        judged = judge(self.value, self.total_uncertainty, self.tolerance)
        return {"agree": "holds", "differ": "fails"}.get(judged, judged)

    @property
    def is_unresolved(self) -> bool:
        """Whether the numerical uncertainty alone makes the verdict inconclusive, and is no smaller
        than what is not modelled."""
        alone = judge(self.value, self.uncertainty, self.tolerance) == "inconclusive"
        return alone and self.uncertainty >= self.unknown

    @property
    def is_fixed(self) -> bool:
        """Whether a finer solution leaves the verdict as it is, wherever in the uncertainty its
        value comes to lie. Of inconclusive ones only where what is not modelled is by far the
        larger unknown: else the error itself is worth a finer solution."""
        if self.verdict != "inconclusive":
            return True
        least = max(0.0, abs(self.value) - self.uncertainty)
        most = abs(self.value) + self.uncertainty
        turns = least + self.unknown <= self.tolerance or most - self.unknown > self.tolerance
        return not turns and self.uncertainty <= SMALL * self.unknown


def is_decided(difference: float, uncertainty: float, size: float, tolerance: float) -> bool:
    """Whether a difference agrees or differs by the rule of `judge`, whatever effects that change
    its reference by up to `size` in all do to it; all relative."""
    if not size < 1.0:
        return False
    moved = (1.0 + abs(difference)) * size / (1.0 - size)
    return judge(difference, uncertainty + moved, tolerance) != "inconclusive"
