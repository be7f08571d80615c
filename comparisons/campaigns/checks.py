"""Cases whose figures must lie within bounds, for `verify` and `stability`: run, show, write.

A case that raises fails with the error's message; one without a figure fails, too."""

import math
import warnings
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from time import process_time
from typing import TYPE_CHECKING

from comparisons.common.errors import ExitStatus, one_line
from comparisons.common.files import check_writable, publish
from comparisons.common.mpi import is_first
from comparisons.common.numbers import finite
from comparisons.common.progress import ProgressCallback, Step, no_progress
from comparisons.common.provenance import as_json, machine, versions
from comparisons.common.tasks import Here, ProcessEnded, tasks_here
from comparisons.figures.quantity import LABELS
from comparisons.output.junit import JunitCase, check_place, junit_xml, write_junit

if TYPE_CHECKING:
    from rich.console import RenderableType
    from rich.table import Table

SCHEMA = 2
MODEL_LABELS = LABELS | {"layer": "analytic layer", "both": "both"}
# Of a case, by its model: whether other processes are worth their start.
USUAL_SECONDS = {"finite_element": 0.5, "half_plane": 0.05}
COLUMNS = ("model", "case", "holds", "figure", "value", "bound", "cond.", "cost x", "s")


@dataclass(frozen=True)
class BoundedFigure:
    """A dimensionless number that must lie between `low` and `high`, both included."""

    name: str  # what was measured
    value: float
    high: float
    reference: str  # what it is compared with
    low: float = 0.0
    note: str = ""  # more about it, for JUnit

    @property
    def holds(self) -> bool:
        return bool(math.isfinite(self.value) and self.low <= self.value <= self.high)

    @property
    def excess(self) -> float:
        """By what factor the value is beyond its nearer bound."""
        if not math.isfinite(self.value):
            return math.inf
        above = self.value / self.high if self.high > 0.0 else math.inf
        below = self.low / self.value if self.value > 0.0 else math.inf
        return above if self.value > self.high else below

    @property
    def bounds(self) -> str:
        if math.isinf(self.high):
            return f"at least {self.low:.4g}"
        return f"{self.low:.4g} to {self.high:.4g}" if self.low else f"at most {self.high:.4g}"

    def as_dict(self) -> dict:
        fields = asdict(self) | {"holds": self.holds}
        del fields["note"]
        return fields


def order_figure(
    name: str, order: float, expected: float, margin: float, reference: str
) -> BoundedFigure:
    """An observed order of convergence: one above the expected order is a mistake, too."""
    return BoundedFigure(name, float(order), expected + margin, reference, expected - margin)


def relative_error(
    name: str, found: float, expected: float, high: float, reference: str
) -> BoundedFigure:
    """|found / expected - 1|."""
    return BoundedFigure(name, float(abs(found / expected - 1.0)), high, reference)


@dataclass(frozen=True)
class CaseFindings:
    """What a case found."""

    figures: tuple[BoundedFigure, ...]  # decide; the first is what the case is about
    # estimated condition number of its matrix, None where it has none
    condition: float | None = None
    # iterations by name; `times_the_ordinary` is their ratio to the ordinary case's
    cost: dict[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class CheckedCase:
    """A named case of a model; `solve` computes its figures."""

    group: str
    name: str
    model: str
    solve: Callable[[], CaseFindings]


@dataclass(frozen=True)
class CheckedRow:
    """A case with its findings; `error` is the message of what it raised, else None."""

    case: CheckedCase
    findings: CaseFindings
    error: str | None
    seconds: float

    @property
    def holds(self) -> bool:
        figures = self.findings.figures
        return self.error is None and bool(figures) and all(f.holds for f in figures)

    @property
    def decisive(self) -> BoundedFigure | None:
        """The figure that fails by most, or else the one that the case is about."""
        figures = self.findings.figures
        failed = [figure for figure in figures if not figure.holds]
        return max(failed, key=lambda f: f.excess, default=figures[0] if figures else None)

    @property
    def faults(self) -> list[str]:
        """A line for each figure that does not hold, for an error, or for the lack of figures."""
        label = f"{self.case.model}, {self.case.group}, {self.case.name}"
        if self.error is not None or not self.findings.figures:
            return [f"{label}: {self.error or 'no figures'}"]
        failed = [figure for figure in self.findings.figures if not figure.holds]
        return [f"{label}, {f.name}: {f.value:.4g}, expected {f.bounds}" for f in failed]

    def as_dict(self) -> dict:
        return {
            "group": self.case.group,
            "case": self.case.name,
            "model": self.case.model,
            "holds": self.holds,
            "figures": [figure.as_dict() for figure in self.findings.figures],
            "condition": self.findings.condition,
            "cost": self.findings.cost,
            "seconds": self.seconds,
            "error": self.error,
        }


def run_case(case: CheckedCase) -> CheckedRow:
    return CheckedRow(case, *_found(None, case.solve))


def _found(
    here: Here | None, solve: Callable[[], CaseFindings]
) -> tuple[CaseFindings, str | None, float]:
    """What a case finds or raises, and its processor seconds."""
    start = process_time()
    findings, error = CaseFindings(()), None
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # an overflow shows in the figures
            findings = solve()
    except Exception as raised:
        error = one_line(f"{type(raised).__name__}: {raised}")
    return findings, error, process_time() - start


def run_cases(
    cases: Iterable[CheckedCase], callback: ProgressCallback = no_progress
) -> tuple[CheckedRow, ...]:
    """The rows of all cases, which processes share where that pays (`comparisons.common.tasks`):
    what solves a case can be pickled then."""
    cases, rows = tuple(cases), []
    with tasks_here() as tasks:
        for number, case in enumerate(cases, start=1):
            tasks.add(str(number), _found, case.solve, seconds=USUAL_SECONDS.get(case.model, 0.0))
        for number, case in enumerate(cases, start=1):
            failed = sum(not row.holds for row in rows)
            name = f"{number} of {len(cases)}{f', {failed} failed' if failed else ''}: "
            name += f"{case.model}: {case.group}: {case.name}"
            callback(Step(name, (number - 1) / len(cases)))
            try:
                rows.append(CheckedRow(case, *tasks.result(str(number))))
            except ProcessEnded as ended:
                rows.append(CheckedRow(case, CaseFindings(()), str(ended), 0.0))
    return tuple(rows)


@dataclass(frozen=True)
class CheckedStudy:
    """All rows of a command, and the seconds that they took together."""

    command: str
    rows: tuple[CheckedRow, ...]
    seconds: float

    @property
    def faults(self) -> list[str]:
        return [line for row in self.rows for line in row.faults] or ["no rows"] * (not self.rows)

    @property
    def holds(self) -> bool:
        return not self.faults

    @property
    def exit_status(self) -> ExitStatus:
        return ExitStatus.DONE if self.holds else ExitStatus.OUTSIDE_TOLERANCE

    def as_dict(self) -> dict:
        passed = sum(row.holds for row in self.rows)
        return {
            "schema": SCHEMA,
            "holds": self.holds,
            "faults": self.faults,
            "passed": passed,
            "failed": len(self.rows) - passed,
            "rows": [row.as_dict() for row in self.rows],
            "seconds": self.seconds,
            "versions": versions(),
            "machine": machine(),
        }


def check_places(command: str, out: Path, junit: Path | None) -> None:
    """Raise InputError unless the command's files can be written in `out`, and the file `junit`."""
    check_writable(out, (f"{command}.json", f"{command}.html"))
    check_place(junit)


def write_study(
    study: CheckedStudy, out: Path, junit: Path | None, page: str | None = None
) -> None:
    """Leave <command>.json, and .html where there is a page, in `out`; JUnit XML in `junit`."""
    if not is_first():
        return
    files = {f"{study.command}.json": as_json(finite(study.as_dict()))}
    if page is not None:
        files[f"{study.command}.html"] = page
    publish(out, files)
    write_junit(junit, study_junit(study))


def study_junit(study: CheckedStudy) -> str:
    cases = (case for row in study.rows for case in _junit_cases(study.command, row))
    return junit_xml(study.command, cases, study.seconds)


def _junit_cases(command: str, row: CheckedRow) -> list[JunitCase]:
    name, group = f"{row.case.group}: {row.case.name}", f"{command}.{row.case.model}"
    if row.error is not None or not row.findings.figures:
        text = row.error or "no figures"
        return [JunitCase(group, name, text, "failure", f"no figures: {text}")]
    cases = []
    for f in row.findings.figures:
        text = f"{f.value:.6g}, expected {f.bounds} ({f.reference}){f.note and '; '}{f.note}"
        result = "passed" if f.holds else "failure"
        cases.append(JunitCase(group, f"{name}: {f.name}", text, result, f"out of bounds: {text}"))
    return cases


def rows_table(rows: Sequence[CheckedRow]) -> "Table":
    from rich.table import Table
    from rich.text import Text

    cells = []
    for row in rows:
        shown, cost = row.decisive, row.findings.cost.get("times_the_ordinary")
        condition = row.findings.condition
        cells.append(
            (
                MODEL_LABELS[row.case.model],
                Text(f"{row.case.group}: {row.case.name}"),
                Text("yes", style="green") if row.holds else Text("NO", style="bold red"),
                Text(row.error or (f"{shown.name} ({shown.reference})" if shown else "no figures")),
                f"{shown.value:.2g}" if shown else "",
                shown.bounds if shown else "",
                "" if condition is None else f"{condition:.0e}",
                "" if cost is None else f"{cost:.1f}",
                f"{row.seconds:.1f}",
            )
        )
    filled = [k for k in range(len(COLUMNS)) if any(row[k] for row in cells)]
    table = Table(*(COLUMNS[k] for k in filled))
    for row in cells:
        table.add_row(*(row[k] for k in filled))
    return table


def verdict_lines(study: CheckedStudy) -> "RenderableType":
    from rich.console import Group
    from rich.text import Text

    passed = sum(row.holds for row in study.rows)
    verdict = Text("HOLDS" if study.holds else "DOES NOT HOLD", style="bold")
    verdict.append(f"  {passed} of {len(study.rows)} cases hold, {study.seconds:.0f} s", "not bold")
    faults = [Text(f"does not hold: {line}", style="bold red") for line in study.faults]
    return Group(*faults, verdict)
