"""The comparison as rows of text, for the page and for the terminal."""

from dataclasses import dataclass

from comparisons.assessment.comparison import figures, uncertainties
from comparisons.assessment.effects.effects import EFFECTS
from comparisons.assessment.verdict import Comparison
from comparisons.common.numbers import Scale, given_percent, percent, plain, scale_of
from comparisons.common.quantities import QUANTITIES, label
from comparisons.models.problem import Problem
from comparisons.results.outcome import Outcome

SAME_PROBLEM = "the same problem"
AT_HARDNESS = 1e-9  # relative: a pressure so close to the hardness is held there


@dataclass(frozen=True)
class ComparisonRow:
    """A quantity at one friction coefficient, or at several that give the same figures.

    half_plane, finite_element   with unit; empty for the norm of a difference
    in_hertz                     the same two in units of the Hertz contact's
    difference                   in the digits that the uncertainty supports
    verdict                      "" where nothing was judged
    reference                    what problem the finite elements' figure is one of
    note                         what to know before the figures are taken for evidence
    """

    quantity: str
    label: str
    friction: str
    half_plane: str
    finite_element: str
    in_hertz: tuple[str, str]
    difference: str
    uncertainty: str
    tolerance: str
    verdict: str
    reference: str = ""
    note: str = ""


@dataclass(frozen=True)
class FigureRow:
    """A figure of the only model, with unit, in units of Hertz's, and its uncertainty."""

    quantity: str
    label: str
    friction: str
    value: str
    in_hertz: str
    uncertainty: str


def comparison_rows(outcome: Outcome) -> list[ComparisonRow]:
    """In the order of quantities, then of friction coefficients."""
    rows = []
    for name in QUANTITIES:
        alike: dict[tuple, list[Comparison]] = {}
        for row in outcome.comparisons:
            if row.quantity == name:
                alike.setdefault(_figures(row), []).append(row)
        rows += [
            _row(outcome.problem, same, reference_of(outcome, name)) for same in alike.values()
        ]
    return rows


def reference_of(outcome: Outcome, quantity: str) -> str:
    """What the finite elements solve: the half-plane's problem, or that with effects that bear on
    the quantity; those without an estimate bear on all."""
    choice = outcome.budget.choice
    named = [
        name
        for name in EFFECTS
        if name in choice.contained and quantity in choice.estimates.get(name, [quantity])
    ]
    return ", ".join(named) or SAME_PROBLEM


def figure_rows(outcome: Outcome) -> list[FigureRow]:
    """Figures of the only model of a run."""
    [run] = outcome.runs.values()
    problem = outcome.problem
    alike: dict[tuple, list[float]] = {}
    for friction in problem.scene.friction:
        doubts = uncertainties(run, problem, friction)
        for name, value in figures(run.finest, problem, friction).items():
            alike.setdefault((name, value, doubts[name].total), []).append(friction)
    order = list(QUANTITIES)
    rows = []
    for (name, value, doubt), frictions in sorted(
        alike.items(), key=lambda i: order.index(i[0][0])
    ):
        rows.append(
            FigureRow(
                quantity=name,
                label=label(name),
                friction=_listed(frictions),
                value=scale_of([value], QUANTITIES[name].unit).text(value),
                in_hertz=_in_hertz(problem, name, value),
                uncertainty=percent(doubt),
            )
        )
    return rows


def _figures(row: Comparison) -> tuple:
    return (
        row.half_plane,
        row.finite_element,
        row.difference,
        row.uncertainty,
        row.tolerance,
        row.verdict,
    )


def _row(problem: Problem, same: list[Comparison], reference: str) -> ComparisonRow:
    row, quantity = same[0], QUANTITIES[same[0].quantity]
    scale = scale_of([row.half_plane, row.finite_element], quantity.unit)
    return ComparisonRow(
        quantity=row.quantity,
        label=label(row.quantity),
        friction=_listed([r.friction for r in same]),
        half_plane=_value(scale, row.half_plane),
        finite_element=_value(scale, row.finite_element),
        in_hertz=(
            _in_hertz(problem, row.quantity, row.half_plane),
            _in_hertz(problem, row.quantity, row.finite_element),
        ),
        difference=percent(
            row.difference, signed=not quantity.of_pair, uncertainty=row.uncertainty
        ),
        uncertainty=percent(row.uncertainty),
        tolerance="" if row.tolerance is None else given_percent(row.tolerance),
        verdict=row.verdict or "",
        reference=reference,
        note="capped in both" if _capped(problem, row) else "",
    )


def _capped(problem: Problem, row: Comparison) -> bool:
    """Whether the hardness holds the peaks of both models, which makes them equal by itself."""
    if row.quantity != "peak_pressure" or problem.scene.hardness is None:
        return False
    lowest = min(row.half_plane, row.finite_element)
    return lowest >= (1.0 - AT_HARDNESS) * problem.scene.hardness


def _value(scale: Scale, value: float | None) -> str:
    return "" if value is None else scale.text(value)


def _listed(frictions: list[float]) -> str:
    return ", ".join(plain(friction) for friction in frictions)


def _in_hertz(problem: Problem, quantity: str, value: float | None) -> str:
    """The figure over that of the smooth contact under the same load."""
    hertz = problem.hertz
    units = {
        "peak_pressure": Scale(hertz.peak_pressure, "p₀"),
        "contact_length": Scale(2.0 * hertz.half_width, "× 2a"),
        "tau1_max": Scale(hertz.peak_pressure, "p₀"),
        "tau1_max_depth": Scale(hertz.half_width, "a"),
        "txz_max_abs": Scale(hertz.peak_pressure, "p₀"),
    }
    return "" if value is None or quantity not in units else units[quantity].text(value)
