"""Questions to one solved scene, each with its figures.

A new study is named here, and nowhere else."""

from comparisons.figures.figure import Figure
from comparisons.figures.quantity import Quantity
from comparisons.judging import comparison, contact, coupling, ladder, yielding
from comparisons.judging.ladder import cost
from comparisons.judging.model_error.study import STUDY as MODEL_ERROR
from comparisons.studies import (
    answers,
    checks,
    heat,
    problem,
    published,
    quiescent_zone,
    running_in,
    scatter,
    statistics,
)
from comparisons.studies.friction import PARTIAL_SLIP

# In the order in which they are done, and their figures shown.
STUDIES = (
    *(contact.STUDY, comparison.STUDY, comparison.LAYERED_STUDY, coupling.STUDY, MODEL_ERROR),
    *(problem.STUDY, running_in.STUDY, checks.STUDY, scatter.STUDY, yielding.STUDY),
    *(quiescent_zone.STUDY, statistics.STUDY, answers.STUDY, heat.STUDY),
    *(PARTIAL_SLIP, published.STUDY, ladder.STUDY, cost.STUDY),
)


def meaning(figure: Figure) -> Quantity:
    """Quantity of a figure, with its meaning."""
    return quantity_of(figure.study, figure.quantity)


def quantity_of(study: str, name: str) -> Quantity:
    """A study's quantity by its name; of another program's study its name in words."""
    for known in STUDIES:
        if known.name == study and name in known.quantities:
            return known.quantities[name]
    return Quantity(name.replace("_", " "))
