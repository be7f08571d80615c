"""What the half-plane's figures become where friction moves the surfaces, as a table and a line."""

from comparisons.assessment.coupling import SHIFT, Change, Coupling
from comparisons.common.numbers import percent, plain, scale_of, with_unit
from comparisons.common.quantities import QUANTITIES, label
from comparisons.report.tables.evidence import Table
from comparisons.results.outcome import Outcome

SHIFT_LABEL = "shift of the pressure's centroid"
UNCHANGED = "contact_ratio"  # it changes as the contact length does


def coupling_table(outcome: Outcome) -> Table | None:
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
    return Table("Half-plane, surfaces moved by friction", ("", *head), tuple(rows))


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
