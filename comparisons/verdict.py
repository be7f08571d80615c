"""From differences and uncertainties to verdicts."""

import math
from dataclasses import dataclass
from typing import Literal

Verdict = Literal["agree", "differ", "indistinct"]


@dataclass(frozen=True)
class Comparison:
    """One quantity at one friction coefficient; figures in SI, the last three relative.

    half_plane, finite_element   the models' values; None for a norm of the difference
    difference                   (half-plane - finite element) / finite element, or the norm; where
                                 the finite elements' value vanishes, over the Hertz contact's
    uncertainty                  of the difference, numerical: both models' together
    tolerance                    None: not judged
    verdict                      None: not judged
    """

    quantity: str
    friction: float
    half_plane: float | None
    finite_element: float | None
    difference: float
    uncertainty: float | None
    tolerance: float | None
    verdict: Verdict | None


def judge(difference: float, uncertainty: float, tolerance: float) -> Verdict:
    """Verdict on a relative difference.

    `indistinct` when the difference is smaller than an uncertainty that exceeds the tolerance:
    the numerics cannot tell, refine before you conclude. Otherwise the tolerance decides.
    """
    if abs(difference) < uncertainty and uncertainty > tolerance:
        return "indistinct"
    return "agree" if abs(difference) <= tolerance else "differ"


def half_space_verdict(
    comparisons: list[Comparison], unshown: dict[str, dict[str, float]]
) -> tuple[Literal["holds", "fails", "undecided"], str]:
    """Whether the half-plane's assumption holds in this scene, and which figures decide it.

    unshown   by quantity and name, estimates (relative) of the effects that the finite-element
              model of this run cannot show; independent of each other, they are added as squares.
              An agreement within the tolerance proves nothing where they exceed it, nor does a
              difference that they could explain.
    """
    judged = [c for c in comparisons if c.verdict is not None]
    if not judged:
        return "undecided", "no quantity was judged against a tolerance"

    def size(c: Comparison) -> float:
        return math.hypot(*unshown.get(c.quantity, {}).values())

    def named(items: list[Comparison]) -> str:
        return ", ".join(
            f"{c.quantity} {c.difference:+.2%} at friction {c.friction:g} (tolerance "
            f"{c.tolerance:.2g})"
            for c in items
        )

    def effects(items: list[Comparison]) -> str:
        alike: dict[str, list[str]] = {}
        for name in dict.fromkeys(c.quantity for c in items):
            sizes = ", ".join(f"{effect} {s:.1%}" for effect, s in unshown[name].items())
            alike.setdefault(sizes, []).append(name)
        return "; ".join(f"{', '.join(names)} by {sizes}" for sizes, names in alike.items())

    differing = [c for c in judged if c.verdict == "differ"]
    proven = [c for c in differing if abs(c.difference) > size(c)]
    if proven:
        return "fails", f"outside the tolerance: {named(proven)}"
    if differing:
        return "undecided", (
            f"outside the tolerance: {named(differing)}, but what this run's finite elements "
            f"lack may move {effects(differing)}"
        )
    unclear = [c for c in judged if c.verdict == "indistinct"]
    if unclear:
        return "undecided", f"numerical uncertainty above the tolerance: {named(unclear)}"
    unproven = [c for c in judged if size(c) > c.tolerance]
    if unproven:
        return "undecided", (
            "both models agree, but what neither contains may exceed the tolerance: "
            f"it may move {effects(unproven)}"
        )
    worst = max(judged, key=lambda c: abs(c.difference) / c.tolerance)
    return "holds", f"all judged quantities agree; nearest to its tolerance: {named([worst])}"
