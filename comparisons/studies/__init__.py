"""Questions to one solved scene, each with its figures.

A new study is named here, and nowhere else."""

from comparisons.figures.figure import Figure
from comparisons.figures.quantity import Quantity
from comparisons.studies import (
    bulge,
    checks,
    comparison,
    contact,
    coupling,
    problem,
    quiescent_zone,
    running_in,
    yielding,
)
from comparisons.studies.answers import study as answers
from comparisons.studies.heat import study as heat
from comparisons.studies.model_error import study as model_error
from comparisons.studies.scatter import study as scatter
from comparisons.studies.statistics import study as statistics
from comparisons.studies.study import Study

# In the order in which they are done, and their figures shown.
STUDIES: tuple[Study, ...] = (
    *(contact.STUDY, comparison.STUDY, coupling.STUDY, model_error.STUDY),
    *(problem.STUDY, running_in.STUDY, checks.STUDY, scatter.STUDY, yielding.STUDY),
    *(quiescent_zone.STUDY, bulge.STUDY, statistics.STUDY, answers.STUDY, heat.STUDY),
)


def meaning(figure: Figure) -> Quantity:
    """What a figure is of; of another program's study its name in words."""
    for study in STUDIES:
        if study.name == figure.study and figure.quantity in study.quantities:
            return study.quantities[figure.quantity]
    return Quantity(figure.quantity.replace("_", " "))
