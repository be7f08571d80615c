"""The comparison as rows of text, for the page and for the terminal."""

from dataclasses import dataclass

from comparisons.assessment.comparison import figures, uncertainties
from comparisons.assessment.effects.catalogue import EFFECTS
from comparisons.assessment.normal_tangential_coupling import SHIFT, Change, Coupling
from comparisons.assessment.verdict import Comparison
from comparisons.common.numbers import Scale, given_percent, percent, plain, scale_of, with_unit
from comparisons.common.quantities import QUANTITIES, label
from comparisons.models.problem import Problem
from comparisons.report.tables.text import TextTable
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
    selection = outcome.budget.selection
    named = [
        EFFECTS[name].label
        for name in EFFECTS
        if name in selection.contained and quantity in selection.estimates.get(name, [quantity])
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


SHIFT_LABEL = "shift of the pressure's centroid"
UNCHANGED = "contact_ratio"  # it changes as the contact length does


def coupling_table(outcome: Outcome) -> TextTable | None:
    """Figures with the surfaces moved, and the change; None where friction moves nothing."""
    shown = [coupling for coupling in outcome.couplings if coupling.changes]
    if not shown:
        return None
    names = [SHIFT, *(name for name in QUANTITIES if name != UNCHANGED)]
    rows = []
    for name in names:
        given = [coupling.changes[name] for coupling in shown if name in coupling.changes]
        if given:
            cells = [cell for change in given for cell in _cells(name, change)]
            rows.append((_label(name), *cells))
    head = [
        text for coupling in shown for text in (f"friction {plain(coupling.friction)}", "change")
    ]
    return TextTable("Half-plane, surfaces moved by friction", ("", *head), tuple(rows))


def coupling_line(outcome: Outcome) -> str | None:
    """The change at the largest friction in one sentence; None where friction moves nothing."""
    if not outcome.couplings:
        return None
    coupling = max(outcome.couplings, key=lambda coupling: abs(coupling.friction))
    if not coupling.changes:
        return f"not known: {coupling.why}"
    contained = "contained" if outcome.problem.scene.coupled else "left out"
    return (
        f"friction {plain(coupling.friction)} moves the surfaces ({contained}): the contact by "
        f"{_shift(coupling)}, peak pressure {_change(coupling, 'peak_pressure')}, "
        f"contact length {_change(coupling, 'contact_length')}"
    )


def _shift(coupling: Coupling) -> str:
    shift = coupling.changes[SHIFT]
    return f"{with_unit(shift.value, 'm', 3)} ({percent(shift.difference, signed=True)} of a)"


def _change(coupling: Coupling, name: str) -> str:
    return percent(coupling.changes[name].difference, signed=True)


def _cells(name: str, change: Change) -> tuple[str, str]:
    """The figure and its change, in percent; of a shift, of the Hertz half-width."""
    if change.value is None:
        return "", percent(change.difference)
    unit = "m" if name == SHIFT else QUANTITIES[name].unit
    moved = percent(change.difference, signed=True)
    return scale_of([change.value], unit).text(change.value), (
        f"{moved} of a" if name == SHIFT else moved
    )


def _label(name: str) -> str:
    return SHIFT_LABEL if name == SHIFT else label(name)
