"""From differences and uncertainties to verdicts."""

from dataclasses import dataclass
from typing import Literal

Verdict = Literal["agree", "differ", "indistinct"]


@dataclass(frozen=True)
class Comparison:
    """One quantity at one friction coefficient; figures in SI, the last three relative.

    half_plane, finite_element   the models' values; None for a norm of the difference
    difference                   (half-plane - finite element) / finite element, or the norm;
                                 None where the finite elements' value vanishes
    uncertainty                  of the difference, numerical: both models' together
    tolerance                    None: not judged
    verdict                      None: not judged
    """

    quantity: str
    friction: float
    half_plane: float | None
    finite_element: float | None
    difference: float | None
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
    comparisons: list[Comparison], unresolved: dict[str, float]
) -> tuple[Literal["holds", "fails", "undecided"], str]:
    """Whether the half-plane's assumption holds in this scene, and which figures decide it.

    unresolved   estimates (relative) of effects that the finite-element model of this run shares
                 with the half-plane and so cannot show, by name: an effect that may exceed the
                 smallest tolerance leaves the question open even where the models agree.
    """
    judged = [c for c in comparisons if c.verdict is not None]
    if not judged:
        return "undecided", "no quantity was judged against a tolerance"

    def named(items: list[Comparison]) -> str:
        return ", ".join(
            f"{c.quantity} "
            + ("without a reference" if c.difference is None else f"{c.difference:+.2%}")
            + f" at friction {c.friction:g} (tolerance {c.tolerance:.2g})"
            for c in items
        )

    differing = [c for c in judged if c.verdict == "differ"]
    if differing:
        return "fails", f"outside the tolerance: {named(differing)}"
    unclear = [c for c in judged if c.verdict == "indistinct"]
    if unclear:
        return "undecided", f"numerical uncertainty above the tolerance: {named(unclear)}"
    tightest = min(c.tolerance for c in judged)
    large = {name: size for name, size in unresolved.items() if size > tightest}
    if large:
        listed = ", ".join(
            f"{name} may change figures by {size:.1%}" for name, size in large.items()
        )
        return "undecided", f"both models agree, but share what neither shows: {listed}"
    worst = max(judged, key=lambda c: abs(c.difference) / c.tolerance)
    return "holds", f"all judged quantities agree; nearest to its tolerance: {named([worst])}"
