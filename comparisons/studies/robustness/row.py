"""A case, the figures by which it passes, and the row that comes of it.

A figure has a bound, named with what it is held against. A case that raises is a row that failed,
with the error's words; one that ends without a bounded figure has shown nothing and fails too.
"""

import math
import warnings
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from time import process_time
from typing import Literal

from comparisons.common.errors import one_line

Model = Literal["half_plane", "finite_element"]


@dataclass(frozen=True)
class Figure:
    """A number that must lie within bounds.

    name     what it is
    value    dimensionless
    most     largest value that passes
    least    smallest value that passes
    against  what it is compared with
    """

    name: str
    value: float
    most: float
    against: str
    least: float = 0.0

    @property
    def passed(self) -> bool:
        return bool(math.isfinite(self.value) and self.least <= self.value <= self.most)

    @property
    def excess(self) -> float:
        """How many times the value is beyond its nearer bound."""
        if not math.isfinite(self.value):
            return math.inf
        above = self.value / self.most if self.most > 0.0 else math.inf
        below = self.least / self.value if self.value > 0.0 else math.inf
        return above if self.value > self.most else below


@dataclass(frozen=True)
class Findings:
    """What a case found.

    figures    decide; the first is what the case is about
    checks     contact residuals by name, dimensionless; they decide as figures do
    condition  estimated condition number of the matrix behind it, None where there is none
    cost       applications and steps, and as multiples of the ordinary case's
    digits     significant decimal digits of results under perturbed input
    """

    figures: tuple[Figure, ...]
    checks: dict[str, float] = field(default_factory=dict)
    condition: float | None = None
    cost: dict[str, float] = field(default_factory=dict)
    digits: dict[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Case:
    """A named case of a model; `solve` computes what there is to judge."""

    group: str
    name: str
    model: Model
    solve: Callable[[], Findings]


@dataclass(frozen=True)
class Row:
    """A case that was carried out; `error` says what it raised, None where it came to an end."""

    case: Case
    findings: Findings
    error: str | None
    seconds: float

    @property
    def passed(self) -> bool:
        figures = self.findings.figures
        return self.error is None and bool(figures) and all(f.passed for f in figures)

    @property
    def telling(self) -> Figure | None:
        """The figure that failed by most, or else the one that the case is about."""
        figures = self.findings.figures
        failed = [figure for figure in figures if not figure.passed]
        return max(failed, key=lambda f: f.excess, default=figures[0] if figures else None)

    def as_dict(self) -> dict:
        """For JSON: numbers that it has no words for are None."""
        figures = [
            {**asdict(f), "value": _finite(f.value), "passed": f.passed}
            for f in self.findings.figures
        ]
        return {
            "group": self.case.group,
            "case": self.case.name,
            "model": self.case.model,
            "passed": self.passed,
            "figures": figures,
            "checks": {name: _finite(v) for name, v in self.findings.checks.items()},
            "condition": _finite(self.findings.condition),
            "cost": {name: _finite(v) for name, v in self.findings.cost.items()},
            "digits": {name: _finite(v) for name, v in self.findings.digits.items()},
            "seconds": self.seconds,
            "error": self.error,
        }


def carried_out(case: Case) -> Row:
    """The row of a case, whatever the case does but for an interrupt."""
    start = process_time()
    findings, error = Findings(()), None
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # overflow on the way shows in the figures
            findings = case.solve()
    except Exception as raised:
        error = one_line(f"{type(raised).__name__}: {raised}")
    return Row(case, findings, error, process_time() - start)


def _finite(value: float | None) -> float | None:
    return float(value) if value is not None and math.isfinite(value) else None
