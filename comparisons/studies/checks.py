"""What the solutions are checked by: the contact conditions, and the compliance before any contact.

In: the finest level of each model. Out: residuals, relative and zero when exact, and how the finite
elements' compliance differs from that of analytic surfaces."""

from collections.abc import Iterator, Mapping
from dataclasses import asdict

from analytic.contact.problem import KKT_TOLERANCE
from comparisons.figures.figure import Column, Figure, Findings, Series, Statement
from comparisons.figures.quantity import Quantity
from comparisons.figures.uncertainty import Uncertainty
from comparisons.models.finite_element.compliance_check import ComplianceCheck, Differences
from comparisons.studies.study import Solved, Study

NAME = "checks"
QUANTITIES = {
    "load_balance": Quantity("load balance"),
    "complementarity": Quantity("pressure where there is a gap"),
    "penetration": Quantity("overlap"),
    "negative_pressure": Quantity("tension"),
    "excess_pressure": Quantity("pressure above the hardness"),
}
COMPLIANCE = "compliance"  # name of what was said of it


def solve(solved: Solved, before: Mapping[str, Findings], tasks: object) -> Findings:
    """A residual is as sure as what converged is allowed to leave of it."""
    figures, series, said = [], [], []
    sure = Uncertainty({"iteration": KKT_TOLERANCE})
    for name, run in solved.runs.items():
        for quantity, value in asdict(run.finest.solution.residuals).items():
            figures.append(Figure(NAME, quantity, name, value, uncertainty=sure))
        if (check := run.finest.operator) is not None:
            series += _compliance(check, name)
            levels = [level.operator for level in run.levels]
            words = {
                "": check.verdict,
                ", because": check.because,
                ", by level": ", ".join(each.verdict for each in levels if each is not None),
                ", datum": "of the base" if check.datum else "a constant is removed",
                ", not modelled": ", ".join(check.not_modelled),
                ", finite": ", ".join(check.finite),
            }
            said += [Statement(COMPLIANCE + n, text, name) for n, text in words.items() if text]
    return Findings(tuple(figures), tuple(series), tuple(said))


def _compliance(check: ComplianceCheck, source: str) -> Iterator[Series]:
    """Columns and waves by the surface that they differ from."""
    against: dict[str, Differences | None] = {"nearest surface": check.nearest}
    against["half-plane"] = check.half_plane
    for surface, found in against.items():
        for kind, units in (("columns", {"x": "m"}), ("waves", {"length": "m"})):
            rows = [asdict(row) for row in getattr(found, kind)] if found is not None else []
            if rows:
                columns = {
                    name: _column([row[name] for row in rows], units.get(name)) for name in rows[0]
                }
                yield Series(f"{COMPLIANCE}, {kind}, {surface}", columns, source)


def _column(values: list[float], unit: str | None) -> Column:
    """Places are exact; a difference is an error: as sure as its order of size."""
    exact = unit is not None
    return Column(tuple(values), unit or "", None if exact else tuple(map(abs, values)))


STUDY = Study(NAME, QUANTITIES, solve)
