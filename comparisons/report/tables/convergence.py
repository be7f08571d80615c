"""How each judged figure converged, and its parts in the terms of ASME V&V 20."""

from dataclasses import dataclass

from comparisons.common.numbers import given_percent, percent, plain, scale_of, significant
from comparisons.figures.convergence import IRREGULAR, LOWEST_ORDER, REGULAR
from comparisons.figures.quantity import LABELS, QUANTITIES, label
from comparisons.figures.uncertainty import COVERAGE, Uncertainty
from comparisons.report.tables.text import TextTable, error_text, wording
from comparisons.results.outcome import Outcome
from comparisons.studies.contact import figures, uncertainties

DIFFERENCE = "difference"  # of both models, in place of one
NO_DATA = "no data"
_BOUNDS = {"lowest": LOWEST_ORDER, "regular": REGULAR, "irregular": IRREGULAR}
_BOUNDS = {name: plain(value) for name, value in _BOUNDS.items()}
WORDS = tuple((term, text.format(**_BOUNDS)) for term, text in wording()["convergence"].items())


@dataclass(frozen=True)
class JudgedSequence:
    """A judged figure over the levels, coarse to fine."""

    quantity: str
    figure: str  # quantity, with its friction coefficient where it depends on one
    source: str  # model's name, or DIFFERENCE
    pitches: tuple[float, ...]  # of the pressure elements [m]
    values: tuple[float, ...]  # SI
    scale: float  # what errors are relative to, SI
    uncertainty: Uncertainty  # of the last value, relative

    @property
    def errors(self) -> list[float]:
        """Distance of each level from the extrapolated value, relative."""
        limit = self.uncertainty.convergence.limit
        return [abs(value - limit) / self.scale for value in self.values]


def judged_sequences(outcome: Outcome) -> list[JudgedSequence]:
    """In the order of quantities, then of friction coefficients and models."""
    problem, found = outcome.problem, []
    for name in (name for name in QUANTITIES if name in problem.scene.tolerances):
        for friction in problem.scene.load.friction:
            figure = row_name(outcome, name, friction)
            if figure:
                found += _sequences(outcome, name, friction, figure)
    return found


def row_name(outcome: Outcome, name: str, friction: float) -> str:
    """A quantity and its friction; what does not depend on that is empty but at the first."""
    frictions = outcome.problem.scene.load.friction
    if not QUANTITIES[name].needs_stress:
        return label(name) if friction == frictions[0] else ""
    return label(name) + (f", friction {plain(friction)}" if len(frictions) > 1 else "")


def _sequences(outcome: Outcome, name: str, friction: float, figure: str) -> list[JudgedSequence]:
    problem, found = outcome.problem, []
    for model, run in outcome.runs.items():
        values = [figures(level, problem, friction).get(name) for level in run.levels]
        if None not in values:
            pitches = tuple(level.grid.pitch for level in run.levels)
            scale = abs(values[-1]) or QUANTITIES[name].scale(problem.hertz)
            stated = uncertainties(run, problem, friction)[name]
            parts = pitches, tuple(values), scale, stated
            found.append(JudgedSequence(name, figure, model, *parts))
    for pair in outcome.pairs:
        if pair.friction == friction and name in pair.uncertainties:
            levels = outcome.runs["finite_element"].levels
            pitches = tuple(level.grid.pitch for level in levels)
            values = tuple(table[name] for table in pair.differences)
            parts = pitches, values, 1.0, pair.uncertainties[name]
            found.append(JudgedSequence(name, figure, DIFFERENCE, *parts))
    return found


def judged_table(outcome: Outcome) -> TextTable | None:
    """Orders, extrapolated value and uncertainty of each judged figure; None where none is."""
    rows = []
    for each in judged_sequences(outcome):
        known = each.uncertainty.convergence
        if each.source == DIFFERENCE:
            shown = {"digits": 3, "signed": not QUANTITIES[each.quantity].of_pair}
            value, limit = (percent(v, **shown) for v in (known.value, known.limit))
        else:
            scale = scale_of(each.values, QUANTITIES[each.quantity].unit)
            value, limit = (scale.text(v, 5) for v in (known.value, known.limit))
        rows.append(
            (
                f"{each.figure}, {LABELS.get(each.source, each.source)}",
                value,
                limit,
                plain(known.formal_order),
                "none" if known.order is None else significant(known.order, 2),
                known.behaviour,
                "none" if known.safety_factor is None else plain(known.safety_factor),
                percent(each.uncertainty.discretisation),
                given_percent(COVERAGE),
            )
        )
    head = ("", "finest level", "extrapolated", "formal order", "observed order", "behaviour")
    head += ("safety factor", "discretisation", "coverage")
    return TextTable("Judged figures under refinement", head, tuple(rows)) if rows else None


def validation_table(outcome: Outcome) -> TextTable | None:
    """Each judged model error as ASME V&V 20 names its parts; None where none is judged."""
    rows = []
    for check in outcome.tolerance_checks:
        name, friction = check.quantity, check.friction
        sampling = outcome.budget.sampling.get(friction, {}).get(name)
        figure = row_name(outcome, name, friction) or f"{label(name)}, friction {plain(friction)}"
        rows.append(
            (
                figure,
                error_text(name, check.value, check.uncertainty),
                percent(check.uncertainty),
                "no trace" if sampling is None else percent(sampling),
                NO_DATA,
            )
        )
    head = ("", "E", "u_num", "u_input", "u_D")
    return TextTable("In the terms of ASME V&V 20", head, tuple(rows)) if rows else None
