"""Named cases whose figures must lie within bounds: carried out, shown and written.

In: cases, each a function that yields figures: those with bounds decide, others only inform. Out: a
row a case; of all rows the terminal's table, json and JUnit. A case that raises, that ends its
process, or that yields nothing to judge is a row that does not hold. `verify` and `stability`
differ in their cases, and in what they say of them."""

import math
import warnings
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter, process_time
from typing import TYPE_CHECKING

from comparisons.common.cache import NO_CACHE, Cache, kinds_of
from comparisons.common.errors import ExitStatus, check_finite_elements, one_line
from comparisons.common.files import check_file, check_writable, publish, unfinished, write_whole
from comparisons.common.numbers import finite
from comparisons.common.progress import ProgressCallback, Step, no_progress
from comparisons.common.provenance import as_json, key_of, machine, program_code, versions
from comparisons.common.tasks import ProcessEnded, called, tasks_here
from comparisons.figures.figure import Figure
from comparisons.figures.quantity import LABELS
from comparisons.figures.uncertainty import Uncertainty
from comparisons.output.junit import JunitCase, junit_xml
from comparisons.output.records import Records
from comparisons.output.terminal import Printed, plain_table

if TYPE_CHECKING:
    from rich.console import RenderableType
    from rich.table import Table
    from rich.text import Text

SCHEMA = 2
# Studies of what cases yield: bounded figures, the condition number of a matrix, iterations.
CASE, CONDITION, COST = "case", "condition", "cost"
# Quantity of a cost: iterations over those of the ordinary case.
TIMES_THE_ORDINARY = "times_the_ordinary"
MODEL_LABELS = LABELS | {"layer": "analytic layer", "both": "both"}
# Of a case, by its model: whether other processes are worth their start.
USUAL_SECONDS = {"finite_element": 0.5, "half_plane": 0.05}
CaseFigures = tuple[Figure, ...]
COLUMNS = ("model", "case", "holds", "figure", "value", "bound", "cond.", "cost x", "s")
ENDED, NOTHING = "the process that solved it ended", "no figures"


def bounded(
    quantity: str, value: float, high: float, against: str, low: float = 0.0, note: str = ""
) -> Figure:
    """A dimensionless number that must lie between `low` and `high`, both included."""
    return Figure(
        *(CASE, quantity, "computed", float(value)),
        against=against,
        uncertainty=Uncertainty(),
        bounds=(low, high),
        notes=(note,) if note else (),
    )


def order_figure(
    quantity: str, order: float, expected: float, margin: float, against: str
) -> Figure:
    """An observed order of convergence: one above the expected order is a mistake, too."""
    return bounded(quantity, order, expected + margin, against, expected - margin)


def relative_error(
    quantity: str, value: float, expected: float, high: float, against: str
) -> Figure:
    """|value / expected - 1|."""
    return bounded(quantity, abs(value / expected - 1.0), high, against)


def holds(figure: Figure) -> bool:
    return figure.verdict == "agree"


def excess(figure: Figure) -> float:
    """Factor by which a value is beyond its nearer bound."""
    value, (low, high) = figure.value, figure.bounds
    if not math.isfinite(value):
        return math.inf
    if value > high:
        return value / high if high > 0.0 else math.inf
    return low / value if value > 0.0 else math.inf


def bounds_text(figure: Figure) -> str:
    low, high = figure.bounds
    if math.isinf(high):
        return f"at least {low:.4g}"
    return f"{low:.4g} to {high:.4g}" if low else f"at most {high:.4g}"


@dataclass(frozen=True)
class Trial:
    """A named trial of a model; `solve` computes its figures."""

    group: str
    name: str
    model: str
    solve: Callable[[], Iterable[Figure]]


@dataclass(frozen=True)
class Row:
    """A case with what it yields; `error` is the message of what it raised, else None."""

    case: Trial
    figures: CaseFigures
    error: str | None
    seconds: float  # of a processor

    @property
    def judged(self) -> CaseFigures:
        """The figures that decide; the first is what the case is about."""
        return tuple(figure for figure in self.figures if figure.bounds is not None)

    @property
    def failed(self) -> list[Figure]:
        return [figure for figure in self.judged if not holds(figure)]

    @property
    def fault(self) -> str | None:
        """Why there is nothing to judge."""
        return self.error or (None if self.judged else NOTHING)

    @property
    def holds(self) -> bool:
        return self.fault is None and not self.failed

    @property
    def condition(self) -> float | None:
        """The condition number of the case's matrix; None where it has none."""
        return next((f.value for f in self.figures if f.study == CONDITION), None)

    @property
    def cost(self) -> dict[str, float]:
        return {f.quantity: f.value for f in self.figures if f.study == COST}

    @property
    def decisive(self) -> Figure | None:
        """The figure that fails by most, or else the one that the case is about."""
        return max(self.failed, key=excess, default=next(iter(self.judged), None))

    @property
    def faults(self) -> list[str]:
        """A line for each figure that does not hold, for an error, or for the lack of figures."""
        label = f"{self.case.model}, {self.case.group}, {self.case.name}"
        if self.fault:
            return [f"{label}: {self.fault}"]
        return [
            f"{label}, {f.quantity}: {f.value:.4g}, expected {bounds_text(f)}" for f in self.failed
        ]

    def as_dict(self) -> dict:
        return {
            "group": self.case.group,
            "case": self.case.name,
            "model": self.case.model,
            "holds": self.holds,
            "figures": [
                {
                    "name": figure.quantity,
                    "value": figure.value,
                    "high": figure.bounds[1],
                    "reference": figure.against,
                    "low": figure.bounds[0],
                    "holds": holds(figure),
                }
                for figure in self.judged
            ],
            "condition": self.condition,
            "cost": self.cost,
            "seconds": self.seconds,
            "error": self.error,
        }


def summary_row(group: str, name: str, model: str, *figures: Figure) -> Row:
    """A row that follows from others."""
    return Row(Trial(group, name, model, tuple), figures, None, 0.0)


def _solved(solve: Callable[[], Iterable[Figure]]) -> tuple[CaseFigures, str | None, float]:
    """Figures, the message of what was raised, and seconds of the processor."""
    start, figures, error = process_time(), (), None
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # an overflow shows in the figures
            figures = tuple(solve())
    except Exception as raised:
        error = one_line(f"{type(raised).__name__}: {raised}")
    return figures, error, process_time() - start


def rows_of(
    cases: Iterable[Trial], callback: ProgressCallback = no_progress, kept: Cache = NO_CACHE
) -> tuple[Row, ...]:
    """The rows of all cases, which processes share where that pays (`comparisons.common.tasks`):
    what solves a case can be pickled then."""
    named, rows = {str(number): case for number, case in enumerate(cases, start=1)}, []
    with tasks_here(kept=kept) as tasks:
        for key, case in named.items():
            seconds = USUAL_SECONDS.get(case.model, 0.0)
            tasks.add(key, called, _solved, case.solve, seconds=seconds)
        for key, case in named.items():
            failed = sum(not row.holds for row in rows)
            failures = f", {failed} failed" if failed else ""
            name = f"{key} of {len(named)}{failures}: {case.model}: {case.group}: {case.name}"
            callback(Step(name, len(rows) / len(named)))
            try:
                rows.append(Row(case, *tasks.result(key)))
            except ProcessEnded:
                rows.append(Row(case, (), ENDED, 0.0))
    return tuple(rows)


def answers_of(out: Path, command: str, cases: Iterable[Trial]) -> Cache:
    """Results of a command into `out` that was stopped, of the same cases by the same code."""
    names = [[case.group, case.name, case.model] for case in cases]
    key = key_of(names, versions(), program_code("analytic", "comparisons", "fem", "meshes"))
    return Cache(unfinished(out, command), key, kinds_of(Figure))


@dataclass(frozen=True, repr=False)
class Campaign(Printed):
    """All rows of a command, and the seconds that they took together."""

    command: str
    rows: tuple[Row, ...]
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

    @property
    def passed(self) -> int:
        return sum(row.holds for row in self.rows)

    def as_dict(self) -> dict:
        return {
            "schema": SCHEMA,
            "holds": self.holds,
            "faults": self.faults,
            "passed": self.passed,
            "failed": len(self.rows) - self.passed,
            "rows": [row.as_dict() for row in self.rows],
            "seconds": self.seconds,
            "versions": versions(),
            "machine": machine(),
        }

    @property
    def figures(self) -> Records:
        """The judged figures of every case as records."""
        rows = [
            {name: row.as_dict()[name] for name in ("group", "case", "model")} | figure
            for row in self.rows
            for figure in row.as_dict()["figures"]
        ]
        return Records(rows)

    def write(self, folder: Path) -> None:
        """Leave <command>.json in the folder. Raises InputError where that cannot be."""
        publish(folder, {f"{self.command}.json": as_json(finite(self.as_dict()))})

    def tables(self) -> "RenderableType":
        """All rows and the verdict."""
        from rich.console import Group

        return Group(rows_table(self.rows), *self.verdict_lines())

    def verdict_lines(self) -> "list[Text]":
        from rich.text import Text

        verdict = Text("HOLDS" if self.holds else "DOES NOT HOLD", style="bold")
        count = f"  {self.passed} of {len(self.rows)} cases hold, {self.seconds:.0f} s"
        verdict.append(count, "not bold")
        faults = [Text(f"does not hold: {line}", style="bold red") for line in self.faults]
        return [*faults, verdict]


def carry_out(
    command: str,
    cases: Iterable[Trial],
    out: Path,
    junit: Path | None,
    callback: ProgressCallback,
    concluded: Callable[[str, tuple[Row, ...], float], Campaign] = Campaign,
) -> Campaign:
    """Carry out all cases of a command, and leave <command>.json in `out`, JUnit XML in the file
    `junit`. Raises InputError where those cannot be written, and MissingLibrary where there is no
    dolfinx for cases that need it.

    concluded  makes the finished campaign of the command, its rows and the seconds"""
    check_writable(out, (f"{command}.json",))
    if junit is not None:
        check_file(junit)
    cases = tuple(cases)  # to make them may take seconds
    if any(case.model in ("finite_element", "both") for case in cases):
        check_finite_elements()
    start, kept = perf_counter(), answers_of(out, command, cases)
    campaign = concluded(command, rows_of(cases, callback, kept), perf_counter() - start)
    campaign.write(out)
    if junit is not None:
        write_whole(junit, junit_of(campaign))
    kept.discard()
    return campaign


def junit_of(campaign: Campaign) -> str:
    cases = (case for row in campaign.rows for case in _junit_cases(campaign.command, row))
    return junit_xml(campaign.command, cases, campaign.seconds)


def _junit_cases(command: str, row: Row) -> list[JunitCase]:
    name, group = f"{row.case.group}: {row.case.name}", f"{command}.{row.case.model}"
    if row.fault:
        return [JunitCase(group, name, row.fault, "failure", f"{NOTHING}: {row.fault}")]
    cases = []
    for f in row.judged:
        text = "; ".join((f"{f.value:.6g}, expected {bounds_text(f)} ({f.against})", *f.notes))
        result, label = "passed" if holds(f) else "failure", f"{name}: {f.quantity}"
        cases.append(JunitCase(group, label, text, result, f"out of bounds: {text}"))
    return cases


def rows_table(rows: Sequence[Row]) -> "Table":
    cells = []
    for row in rows:
        shown, cost = row.decisive, row.cost.get(TIMES_THE_ORDINARY)
        about = shown and f"{shown.quantity} ({shown.against})"
        cells.append(
            (
                MODEL_LABELS[row.case.model],
                f"{row.case.group}: {row.case.name}",
                "yes" if row.holds else "NO",
                row.error or about or NOTHING,
                f"{shown.value:.2g}" if shown else "",
                bounds_text(shown) if shown else "",
                "" if row.condition is None else f"{row.condition:.0e}",
                "" if cost is None else f"{cost:.1f}",
                f"{row.seconds:.1f}",
            )
        )
    filled = [k for k in range(len(COLUMNS)) if any(row[k] for row in cells)]
    shown = ([row[k] for k in filled] for row in cells)
    return plain_table(*(COLUMNS[k] for k in filled), rows=shown)
