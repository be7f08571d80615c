"""The comparison as rows of text, for the page and for the terminal."""

from dataclasses import dataclass, replace

from comparisons.common.numbers import Scale, given_percent, percent, plain, scale_of, with_unit
from comparisons.figures.quantity import HYPHENATED, QUANTITIES, label
from comparisons.figures.verdict import Comparison
from comparisons.models.problem import Problem
from comparisons.report.tables.model_error import left_out
from comparisons.report.tables.text import (
    REPEATED,
    TextTable,
    error_text,
    grouped,
    is_shown,
    listed,
)
from comparisons.results.outcome import Outcome
from comparisons.studies.contact import figures, uncertainties
from comparisons.studies.coupling import SHIFT, Change
from comparisons.studies.model_error.catalogue import EFFECTS

SAME_PROBLEM = "the same problem"
SHIFT_LABEL = "shift of the pressure's centroid"
AT_HARDNESS = 1e-9  # relative: a pressure so close to the hardness is held there


@dataclass(frozen=True)
class ComparisonRow:
    """A quantity at one friction coefficient, or at several that give the same figures."""

    quantity: str
    label: str
    friction: str
    half_plane: str  # with unit; empty for the norm of a difference
    finite_element: str
    in_hertz: tuple[str, str]  # the same two in units of the Hertz contact's
    difference: str  # in the digits that the uncertainty supports
    uncertainty: str
    tolerance: str
    verdict: str  # "" where nothing was judged
    reference: str  # what problem the finite elements' figure is one of
    note: str  # what to know before the figures are taken for evidence


def comparison_rows(outcome: Outcome) -> list[ComparisonRow]:
    """In the order of quantities, then of friction coefficients."""
    rows = []
    for name in QUANTITIES:
        found = [row for row in outcome.comparisons if row.quantity == name]
        for same in grouped(found, lambda row: replace(row, friction=0.0)):
            frictions = listed(row.friction for row in same)
            rows.append(_row(outcome, same[0], frictions))
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


def figure_rows(outcome: Outcome) -> list[tuple[str, ...]]:
    """Of the only model: quantity, friction, figure with unit and over Hertz's, uncertainty."""
    [run] = outcome.runs.values()
    problem, found = outcome.problem, []
    for friction in problem.scene.load.friction:
        known = uncertainties(run, problem, friction)
        for name, value in figures(run.finest, problem, friction).items():
            if is_shown(outcome, name):
                found.append((friction, name, value, known[name].total))
    found.sort(key=lambda entry: list(QUANTITIES).index(entry[1]))
    rows = []
    for same in grouped(found, lambda entry: entry[1:]):
        _, name, value, uncertainty = same[0]
        frictions = listed(entry[0] for entry in same)
        sizes = with_unit(value, QUANTITIES[name].unit), _in_hertz(problem, name, value)
        rows.append((name, frictions, *sizes, percent(uncertainty)))
    return rows


def figure_table(outcome: Outcome) -> TextTable:
    """The same for the page."""
    [model] = outcome.runs
    head = ("quantity", "friction", f"{HYPHENATED[model]} model", "over Hertz", "uncertainty")
    rows = ((label(name), *cells) for name, *cells in figure_rows(outcome))
    return TextTable("", head, tuple(rows))


def _row(outcome: Outcome, row: Comparison, frictions: str) -> ComparisonRow:
    problem, values = outcome.problem, (row.half_plane, row.finite_element)
    capped = "capped in both" if _capped(problem, row) else ""
    scale = scale_of(values, QUANTITIES[row.quantity].unit)
    half_plane, finite_element = ("" if v is None else scale.text(v) for v in values)
    return ComparisonRow(
        quantity=row.quantity,
        label=label(row.quantity),
        friction=frictions,
        half_plane=half_plane,
        finite_element=finite_element,
        in_hertz=tuple(_in_hertz(problem, row.quantity, value) for value in values),
        difference=error_text(row.quantity, row.difference, row.uncertainty),
        uncertainty=percent(row.uncertainty),
        tolerance="" if row.tolerance is None else given_percent(row.tolerance),
        verdict=row.verdict or "",
        reference=reference_of(outcome, row.quantity),
        note=", ".join(filter(None, (capped, left_out(outcome, row.quantity)))),
    )


def _capped(problem: Problem, row: Comparison) -> bool:
    """Whether the hardness holds the peaks of both models, which makes them equal by itself."""
    if row.quantity != "peak_pressure" or problem.scene.body.hardness is None:
        return False
    lowest = min(row.half_plane, row.finite_element)
    return lowest >= (1.0 - AT_HARDNESS) * problem.scene.body.hardness


def _in_hertz(problem: Problem, quantity: str, value: float | None) -> str:
    """The figure over that of the smooth contact under the same load."""
    hertz = problem.hertz
    pressures = ("peak_pressure", "tau1_max", "txz_max_abs")
    units = dict.fromkeys(pressures, Scale(hertz.peak_pressure, "p₀"))
    units["contact_length"] = Scale(2.0 * hertz.half_width, "× 2a")
    units["tau1_max_depth"] = Scale(hertz.half_width, "a")
    return "" if value is None or quantity not in units else units[quantity].text(value)


def coupling_table(outcome: Outcome) -> TextTable | None:
    """Figures with the surfaces moved, and the change; None where friction moves nothing."""
    shown = [coupling for coupling in outcome.couplings if coupling.changes]
    if not shown:
        return None
    names = {SHIFT: SHIFT_LABEL} | {name: label(name) for name in QUANTITIES if name != REPEATED}
    rows = []
    for name, words in names.items():
        changes = [coupling.changes[name] for coupling in shown if name in coupling.changes]
        if changes:
            rows.append((words, *(cell for change in changes for cell in _cells(name, change))))
    head = [cell for c in shown for cell in (f"friction {plain(c.friction)}", "change")]
    return TextTable("Half-plane, surfaces moved by friction", ("", *head), tuple(rows))


def coupling_line(outcome: Outcome) -> str | None:
    """The change at the largest friction in one sentence; None where friction moves nothing."""
    if not outcome.couplings:
        return None
    coupling = max(outcome.couplings, key=lambda coupling: abs(coupling.friction))
    if not coupling.changes:
        return f"not known: {coupling.why}"
    contained = "contained" if outcome.problem.scene.load.coupled else "not modelled"
    changed = {name: _cells(name, change) for name, change in coupling.changes.items()}
    shift, of_a = with_unit(coupling.changes[SHIFT].value, "m", 3), changed[SHIFT][1]
    return (
        f"friction {plain(coupling.friction)} moves the surfaces ({contained}): the contact by "
        f"{shift} ({of_a}), peak pressure {changed['peak_pressure'][1]}, "
        f"contact length {changed['contact_length'][1]}"
    )


def _cells(name: str, change: Change) -> tuple[str, str]:
    """The figure and its change, in percent; of a shift, of the Hertz half-width."""
    if change.value is None:
        return "", percent(change.difference)
    moved = percent(change.difference, signed=True)
    if name == SHIFT:
        return with_unit(change.value, "m"), f"{moved} of a"
    return with_unit(change.value, QUANTITIES[name].unit), moved
