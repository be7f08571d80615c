"""How each judged figure converged, and its parts in the terms of ASME V&V 20.

In: the figures of a run, with their levels. Out: sequences for pictures, and rows of text."""

from dataclasses import dataclass

from comparisons.common.numbers import given_percent, percent, plain, scale_of, significant
from comparisons.drawing.blocks import TextTable
from comparisons.figures.convergence import IRREGULAR, LOWEST_ORDER, REGULAR, Convergence
from comparisons.figures.figure import Figure
from comparisons.figures.quantity import LABELS, MODELS, QUANTITIES, error_text, label
from comparisons.figures.uncertainty import COVERAGE
from comparisons.output.page.tables.text import wording
from comparisons.studies import comparison, contact
from comparisons.studies.model_error.account import INPUTS
from comparisons.studies.study import Run

DIFFERENCE = "difference"  # of both models, in place of one
NO_DATA = "no data"
_BOUNDS = {"lowest": LOWEST_ORDER, "regular": REGULAR, "irregular": IRREGULAR}
_BOUNDS = {name: plain(value) for name, value in _BOUNDS.items()}
WORDS = tuple((term, text.format(**_BOUNDS)) for term, text in wording()["convergence"].items())


@dataclass(frozen=True)
class JudgedSequence:
    """A judged figure over the levels, coarse to fine."""

    figure: Figure
    name: str  # quantity, with its friction coefficient where it depends on one
    source: str  # model's name, or DIFFERENCE
    pitches: tuple[float, ...]  # of the pressure elements [m]

    @property
    def known(self) -> Convergence:
        return self.figure.uncertainty.convergence

    @property
    def errors(self) -> list[float]:
        """Distance of each level from the extrapolated value, relative."""
        scale = 1.0 if self.source == DIFFERENCE else self.figure.scale
        return [abs(value - self.known.limit) / scale for value in self.figure.levels]


def judged_sequences(run: Run) -> list[JudgedSequence]:
    """In the order of quantities, then of friction coefficients and models."""
    sequences = []
    for quantity in (name for name in QUANTITIES if name in run.problem.scene.tolerances):
        for friction in run.problem.scene.load.friction:
            if name := row_name(run, quantity, friction):
                known = run.figures.of(quantity=quantity, friction=friction)
                of_models = [known.one(study=contact.NAME, source=model) for model in MODELS]
                for figure in filter(None, (*of_models, known.one(study=comparison.NAME))):
                    source = DIFFERENCE if figure.against else figure.source
                    levels = run.runs[figure.against or figure.source].levels
                    pitches = tuple(level.grid.pitch for level in levels)
                    sequences.append(JudgedSequence(figure, name, source, pitches))
    return sequences


def row_name(run: Run, name: str, friction: float) -> str:
    """A quantity and its friction; what does not depend on that is empty but at the first."""
    frictions = run.problem.scene.load.friction
    if not QUANTITIES[name].needs_stress:
        return label(name) if friction == frictions[0] else ""
    return label(name) + (f", friction {plain(friction)}" if len(frictions) > 1 else "")


def judged_table(run: Run) -> TextTable | None:
    """Orders, extrapolated value and uncertainty of each judged figure; None where none is."""
    rows = []
    for each in judged_sequences(run):
        known, quantity = each.known, QUANTITIES[each.figure.quantity]
        if each.source == DIFFERENCE:
            shown = {"digits": 3, "signed": not quantity.of_pair}
            value, limit = (percent(v, **shown) for v in (known.value, known.limit))
        else:
            scale = scale_of(each.figure.levels, quantity.unit)
            value, limit = (scale.text(v, 5) for v in (known.value, known.limit))
        rows.append(
            (
                f"{each.name}, {LABELS.get(each.source, each.source)}",
                value,
                limit,
                plain(known.formal_order),
                "none" if known.order is None else significant(known.order, 2),
                known.behaviour,
                "none" if known.safety_factor is None else plain(known.safety_factor),
                percent(each.figure.uncertainty.parts["discretisation"]),
                given_percent(COVERAGE),
            )
        )
    head = ("", "finest level", "extrapolated", "formal order", "observed order", "behaviour")
    head += ("safety factor", "discretisation", "coverage")
    return TextTable("Judged figures under refinement", head, tuple(rows)) if rows else None


def validation_table(run: Run) -> TextTable | None:
    """Each judged model error as ASME V&V 20 names its parts; None where none is judged."""
    rows = []
    for error in run.model_errors:
        name, friction, inputs = error.quantity, error.friction, error.part(INPUTS)
        named = row_name(run, name, friction) or f"{label(name)}, friction {plain(friction)}"
        rows.append(
            (
                named,
                error_text(name, error.value, error.numerical),
                percent(error.numerical),
                "no trace" if inputs is None else percent(inputs.value),
                NO_DATA,
            )
        )
    head = ("", "E", "u_num", "u_input", "u_D")
    return TextTable("In the terms of ASME V&V 20", head, tuple(rows)) if rows else None
