"""The error budget as rows of text, for the page and for the terminal."""

from dataclasses import dataclass

from comparisons.assessment.effects.catalogue import EFFECTS
from comparisons.assessment.effects.model_error import ModelError
from comparisons.common.numbers import given_percent, percent, plain
from comparisons.common.quantities import QUANTITIES, label
from comparisons.results.outcome import Outcome

SHOWN = 5e-4  # effects below this, and below a tenth of the error, are not listed


@dataclass(frozen=True)
class BudgetRow:
    """The half-plane's own error in a quantity, at one friction coefficient or several alike.

    parts  what makes it up, the largest first, each with its sign
    """

    quantity: str
    label: str
    friction: str
    own: str
    uncertainty: str
    tolerance: str
    parts: tuple[str, ...]


def budget_rows(outcome: Outcome, judged: bool = False) -> list[BudgetRow]:
    """In the order of quantities, then of friction coefficients; `judged` ones alone, if asked."""
    tolerance = outcome.problem.scene.tolerance
    rows = []
    for name in QUANTITIES:
        alike: dict[tuple, list[float]] = {}
        for own in outcome.budget.model_errors:
            if own.quantity == name and (name in tolerance or not judged):
                alike.setdefault(_figures(own), []).append(own.friction)
        for (value, doubt, parts), frictions in alike.items():
            rows.append(
                BudgetRow(
                    quantity=name,
                    label=label(name),
                    friction=", ".join(plain(friction) for friction in frictions),
                    own=value,
                    uncertainty=doubt,
                    tolerance=given_percent(tolerance[name]) if name in tolerance else "",
                    parts=parts,
                )
            )
    return rows


def _figures(own: ModelError) -> tuple[str, str, tuple[str, ...]]:
    signed = not QUANTITIES[own.quantity].of_pair
    return (
        percent(own.value, signed=signed, uncertainty=own.uncertainty),
        percent(own.uncertainty),
        parts_in_words(own),
    )


def parts_in_words(own: ModelError) -> tuple[str, ...]:
    """What the half-plane lacks, as shares of its error: an effect that raises the finite
    elements' figure makes the half-plane's too low. Norms have no sign."""
    signed = not QUANTITIES[own.quantity].of_pair
    sizes = {EFFECTS[name].label: -share.value for name, share in own.effects.items()}
    sizes["interaction"] = -own.interaction
    least = max(SHOWN, 0.1 * abs(own.value))
    by_size = sorted(sizes.items(), key=lambda item: -abs(item[1]))
    return tuple(
        f"{name} {percent(value if signed else abs(value), signed=signed)}"
        for name, value in by_size
        if abs(value) >= least
    )


def left_out_line(outcome: Outcome) -> str:
    """The effects that no model of the run has, each with its largest estimate on what is judged,
    or on anything where nothing is; those that one reason keeps out stand together."""
    selection = outcome.budget.selection
    judged = set(outcome.problem.scene.tolerance)
    alike: dict[str, list[str]] = {}
    for name in (*selection.impossible, *selection.negligible):
        sizes = selection.estimates[name]
        largest = max((sizes[q] for q in judged & set(sizes)), default=max(sizes.values()))
        why = selection.impossible.get(name, "")
        alike.setdefault(why, []).append(f"{EFFECTS[name].label} (at most {percent(largest)})")
    parts = [", ".join(named) + (f": {why}" if why else "") for why, named in alike.items()]
    return "; ".join(parts) or "nothing"
