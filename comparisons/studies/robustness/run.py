"""All stiff and extreme cases, as `crosscheck stability` runs them."""

from collections.abc import Callable, Iterable
from importlib import import_module
from pathlib import Path
from time import perf_counter

from comparisons.common.progress import ProgressCallback, no_progress
from comparisons.studies.checks import (
    CheckedCase,
    CheckedStudy,
    check_places,
    run_cases,
    write_study,
)

# In this order: cheap ones first. What a module's cases need is imported with it.
MODULES = (
    "cases.smooth",
    "cases.rough",
    "cases.friction",
    "cases.layers",
    "cases.stresses",
    "cases.algebra",
    "finite_element.stiffness",
    "finite_element.scenes",
    "finite_element.extremes",
    "cases.rounding",
)


def all_cases() -> list[CheckedCase]:
    """Every case, in the order they are run in."""
    modules = (import_module(f"comparisons.studies.robustness.{name}") for name in MODULES)
    return [case for module in modules for case in module.cases()]


def run_robustness(
    out: Path,
    junit: Path | None = None,
    callback: ProgressCallback = no_progress,
    cases: Callable[[], Iterable[CheckedCase]] = all_cases,
) -> CheckedStudy:
    """Run all cases; leave stability.json in `out`, JUnit XML in the file `junit`.

    Raises InputError where those cannot be written.
    """
    check_places(out, junit)
    start = perf_counter()
    rows = run_cases(cases(), callback)
    study = CheckedStudy("stability", rows, perf_counter() - start)
    write_study(study, out, junit)
    return study
