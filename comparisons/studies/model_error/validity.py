"""Whether the half-plane's assumption holds in a scene, by its judged model errors."""

from collections.abc import Sequence

from comparisons.figures.verdict import ToleranceCheck, Validity
from comparisons.studies.model_error.catalogue import EFFECTS


def validity_verdict(checks: Sequence[ToleranceCheck]) -> tuple[Validity, str]:
    """Whether the half-plane's assumption holds in a scene, and which figures decide it."""
    if not checks:
        return "inconclusive", "no quantity was judged against a tolerance"
    outside = [s for s in checks if s.verdict == "fails"]
    if outside:
        return "fails", f"outside the tolerance: {_named(outside)}"
    unclear = [s for s in checks if s.verdict != "holds"]
    if not unclear:
        worst = max(checks, key=lambda s: (abs(s.value) + s.total_uncertainty) / s.tolerance)
        return "holds", f"every judged error is within its tolerance; nearest: {_named([worst])}"
    numerical = [s for s in unclear if s.is_unresolved]
    if numerical:
        return "inconclusive", f"an error cannot be told from its tolerance: {_named(numerical)}"
    why = "what no model of this run contains may move an error across its tolerance"
    return "inconclusive", f"{why}: {_named(unclear)}, by {_effects(unclear)}"


def _named(checks: Sequence[ToleranceCheck]) -> str:
    return ", ".join(
        f"{s.quantity} {s.value:+.2%} +- {s.uncertainty:.2%} at friction {s.friction:g} "
        f"(tolerance {s.tolerance:.2g})"
        for s in checks
    )


def _effects(checks: Sequence[ToleranceCheck]) -> str:
    """The largest estimate of each effect."""
    largest: dict[str, float] = {}
    for check in checks:
        for name, size in check.not_modelled.items():
            largest[name] = max(size, largest.get(name, 0.0))
    by_size = sorted(largest.items(), key=lambda item: -item[1])
    return ", ".join(f"{EFFECTS[name].label} {size:.1%}" for name, size in by_size)
