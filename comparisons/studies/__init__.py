"""Questions to one solved scene, each with its figures.

A new study is named here, and nowhere else."""

from comparisons.figures.figure import Figure
from comparisons.figures.quantity import Quantity
from comparisons.studies import (
    answers,
    checks,
    comparison,
    contact,
    heat,
    ladder,
    problem,
    published,
    running_in,
    scatter,
    statistics,
)
from comparisons.studies.friction import PARTIAL_SLIP, coupling
from comparisons.studies.ladder.layered import STUDY as LAYERED
from comparisons.studies.model_error.study import STUDY as MODEL_ERROR
from comparisons.studies.subsurface import quiescent_zone, yielding

# In the order in which they are done, and their figures shown.
STUDIES = (
    *(contact.STUDY, comparison.STUDY, LAYERED, coupling.STUDY, MODEL_ERROR),
    *(problem.STUDY, running_in.STUDY, checks.STUDY, scatter.STUDY, yielding.STUDY),
    *(quiescent_zone.STUDY, statistics.STUDY, answers.STUDY, heat.STUDY),
    *(PARTIAL_SLIP, published.STUDY, ladder.STUDY),
)


# Those that have rows of the wide table, by name.
TABLED = {name: study.quantities[name] for study in STUDIES for name in study.tabled}


def meaning(figure: Figure) -> Quantity:
    """What a figure is of; of another program's study its name in words."""
    for study in STUDIES:
        if study.name == figure.study and figure.quantity in study.quantities:
            return study.quantities[figure.quantity]
    return Quantity(figure.quantity.replace("_", " "))
