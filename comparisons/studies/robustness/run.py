"""All stiff and extreme cases, as `crosscheck stability` runs them."""

from collections.abc import Callable, Iterable
from pathlib import Path
from time import perf_counter

from comparisons.common.progress import ProgressCallback, no_progress
from comparisons.studies.checks import (
    CheckedCase,
    CheckedStudy,
    check_places,
    named_cases,
    run_cases,
    write_study,
)
from comparisons.studies.robustness.cases import algebra, friction, layers, rough, smooth
from comparisons.studies.robustness.finite_element import extremes, scenes, stiffness


def all_cases() -> list[CheckedCase]:
    """Every case; cheap ones first."""
    analytic = (smooth, rough, friction, layers, algebra)
    finite_elements = (stiffness, scenes, extremes)
    groups = [("half_plane", module.cases()) for module in analytic]
    groups += [("finite_element", module.cases()) for module in finite_elements]
    return [case for model, given in groups for case in named_cases(model, given)]


def run_robustness(
    out: Path,
    junit: Path | None = None,
    callback: ProgressCallback = no_progress,
    cases: Callable[[], Iterable[CheckedCase]] = all_cases,
) -> CheckedStudy:
    """Run all cases; leave stability.json in `out`, JUnit XML in the file `junit`.

    Raises InputError where those cannot be written.
    """
    check_places("stability", out, junit)
    start = perf_counter()
    rows = run_cases(cases(), callback)
    study = CheckedStudy("stability", rows, perf_counter() - start)
    write_study(study, out, junit)
    return study
