"""From differences and uncertainties to verdicts, by one rule.

A difference d with uncertainty U stands for the interval d +- U. The verdict is yes where the whole
interval is within the tolerance, |d| + U <= tolerance; no where all of it is beyond,
|d| - U > tolerance; and inconclusive where it reaches across, or where U is not known. Everything
that is judged is judged so: the models' difference, the model error, points of maps, settings of a
cost study, claims of the paper."""

import math
from typing import Literal

Verdict = Literal["agree", "differ", "inconclusive", "holds", "fails"]
Validity = Literal["holds", "fails", "inconclusive"]


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


def is_decided(difference: float, uncertainty: float, size: float, tolerance: float) -> bool:
    """Whether a difference agrees or differs by the rule of `judge`, whatever effects that change
    its reference by up to `size` in all do to it; all relative."""
    if not size < 1.0:
        return False
    moved = (1.0 + abs(difference)) * size / (1.0 - size)
    return judge(difference, uncertainty + moved, tolerance) != "inconclusive"
