"""Carry out the stiff and extreme cases, and keep what they gave."""

import json
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from time import perf_counter

from comparisons.common.errors import ExitStatus
from comparisons.common.files import check_writable, write_whole
from comparisons.common.mpi import is_first
from comparisons.common.progress import ProgressCallback, Step, no_progress
from comparisons.studies.robustness.row import Case, Row, carried_out

SCHEMA = 1
FILE = "stability.json"
# In this order: cheap ones first. What a module's cases need is imported with it.
MODULES = (
    "cases.smooth",
    "cases.profiles",
    "cases.rough",
    "cases.units",
    "cases.friction",
    "cases.layers",
    "cases.stresses",
    "cases.algebra",
    "finite_element.algebra",
    "finite_element.scene_ends",
    "finite_element.layers",
    "finite_element.extremes",
    "cases.rounding",
)


@dataclass(frozen=True)
class Stability:
    """All rows, the seconds they took together, and the folder that holds them."""

    rows: tuple[Row, ...]
    seconds: float
    directory: Path

    @property
    def exit_status(self) -> ExitStatus:
        held = bool(self.rows) and all(row.passed for row in self.rows)
        return ExitStatus.DONE if held else ExitStatus.OUTSIDE_TOLERANCE

    def as_dict(self) -> dict:
        passed = sum(row.passed for row in self.rows)
        return {
            "schema": SCHEMA,
            "rows": [row.as_dict() for row in self.rows],
            "passed": passed,
            "failed": len(self.rows) - passed,
            "seconds": self.seconds,
        }


def all_cases() -> tuple[Case, ...]:
    """Every case, in the order they are run in."""
    modules = (import_module(f"comparisons.studies.robustness.{name}") for name in MODULES)
    return tuple(case for module in modules for case in module.cases())


def run_stability(
    out: Path,
    callback: ProgressCallback = no_progress,
    cases: Callable[[], Iterable[Case]] = all_cases,
) -> Stability:
    """Carry out all cases, write stability.json into `out` and return the rows."""
    check_writable(out)
    start = perf_counter()
    chosen, rows = tuple(cases()), []
    for number, case in enumerate(chosen, start=1):
        failed = sum(not row.passed for row in rows)
        said = f", {failed} failed" if failed else ""
        name = f"{number} of {len(chosen)}{said}: {case.model}: {case.group}: {case.name}"
        callback(Step(name, (number - 1) / len(chosen)))
        rows.append(carried_out(case))
    result = Stability(tuple(rows), perf_counter() - start, out)
    if is_first():
        _write(result)
    return result


def _write(result: Stability) -> None:
    """stability.json, whole or not at all; other files of the folder stay as they are."""
    result.directory.mkdir(parents=True, exist_ok=True)
    text = json.dumps(result.as_dict(), indent=2, ensure_ascii=False, allow_nan=False)
    write_whole(result.directory / FILE, text + "\n")
