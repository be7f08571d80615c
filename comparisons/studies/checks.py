"""What the solutions are checked by: the contact conditions, and the compliance before any contact.

In: the finest level of each model. Out: residuals, relative and zero when exact, and how the finite
elements' compliance differs from that of analytic surfaces."""

from collections.abc import Iterator, Mapping
from dataclasses import asdict

from analytic.contact.problem import KKT_TOLERANCE
from comparisons.figures.figure import Figure, Findings, Series, Statement, columns_of
from comparisons.figures.quantity import Quantity
from comparisons.figures.uncertainty import Uncertainty
from comparisons.models.finite_element.compliance_check import ComplianceCheck
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
        residuals = [asdict(level.solution.residuals) for level in run.finest.by_friction]
        for quantity in residuals[0]:
            value = max(row[quantity] for row in residuals)
            figures.append(Figure(NAME, quantity, name, value, uncertainty=sure))
        if (check := run.finest.operator) is not None:
            series += _compliance(check, name)
            levels = [level.operator for level in run.levels]
            words = {
                "": check.verdict,
                ", because": check.because,
                ", by level": ", ".join(known.verdict for known in levels if known is not None),
                ", datum": "of the base" if check.datum else "a constant is removed",
                ", not modelled": ", ".join(check.not_modelled),
                ", finite": ", ".join(check.finite),
            }
            said += [Statement(COMPLIANCE + n, text, name) for n, text in words.items() if text]
    return Findings(tuple(figures), tuple(series), tuple(said))


def _compliance(check: ComplianceCheck, source: str) -> Iterator[Series]:
    """Columns and waves by the surface that they differ from."""
    against = {"nearest surface": check.nearest, "half-plane": check.half_plane}
    for surface, differences in against.items():
        for kind, place in (("columns", "x"), ("waves", "length")):
            rows = [asdict(row) for row in getattr(differences, kind, ())]
            if rows:
                # places are exact; a difference is an error: as sure as its order of size
                sizes = {n: [abs(row[n]) for row in rows] for n in rows[0] if n != place}
                columns = columns_of(rows, {place: "m"}, sizes)
                yield Series(f"{COMPLIANCE}, {kind}, {surface}", columns, source)


STUDY = Study(NAME, QUANTITIES, solve)
