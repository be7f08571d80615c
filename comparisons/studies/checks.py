"""Checks of the solutions: the contact conditions.

In: the finest level of each model. Out: residuals, relative and zero when exact."""

from collections.abc import Mapping
from dataclasses import asdict

from analytic.contact.problem import KKT_TOLERANCE
from comparisons.figures.figure import Figure, Findings
from comparisons.figures.quantity import Quantity
from comparisons.figures.uncertainty import Uncertainty
from comparisons.judging.study import Solved, Study

NAME = "checks"
QUANTITIES = {
    "load_balance": Quantity("load balance"),
    "complementarity": Quantity("pressure where there is a gap"),
    "penetration": Quantity("overlap"),
    "negative_pressure": Quantity("tension"),
    "excess_pressure": Quantity("pressure above the hardness"),
}


def solve(solved: Solved, before: Mapping[str, Findings], tasks: object) -> Findings:
    """A residual is as sure as what converged is allowed to leave of it."""
    figures, sure = [], Uncertainty({"iteration": KKT_TOLERANCE})
    for name in solved.runs:
        finest = (case.runs[name].finest for case in solved.cases)
        residuals = [asdict(level.solution.residuals) for level in finest]
        for quantity in residuals[0]:
            value = max(row[quantity] for row in residuals)
            figures.append(Figure(NAME, quantity, name, value, uncertainty=sure))
    return Findings(tuple(figures))


STUDY = Study(
    name=NAME,
    quantities=QUANTITIES,
    solve=solve,
    title="Checks",
    note="How far the solution on the finest level is from the contact conditions, evaluated again "
    "with each model's operator; relative, zero when exact.",
    lines=lambda run: [],
)
