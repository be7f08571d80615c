"""All stiff and extreme cases, as `crosscheck stability` runs them: the rows of rows.toml."""

import tomllib
from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path
from time import perf_counter

from comparisons.campaigns.checks import (
    CheckedCase,
    CheckedStudy,
    check_places,
    run_cases,
    write_study,
)
from comparisons.campaigns.robustness import (
    algebra,
    bodies,
    friction,
    layers,
    rough,
    scenes,
    smooth,
)
from comparisons.common.progress import ProgressCallback, no_progress

MODULES = (smooth, rough, friction, layers, algebra, bodies, scenes)


def all_cases() -> list[CheckedCase]:
    text = Path(__file__).with_name("rows.toml").read_text(encoding="utf-8")
    named = {module.__name__.rpartition(".")[2]: module for module in MODULES}
    return [
        CheckedCase(group, name, model, partial(getattr(named[module], function), **given))
        for model, modules in tomllib.loads(text).items()
        for module, functions in modules.items()
        for function, groups in functions.items()
        for group, rows in groups.items()
        for name, given in rows.items()
    ]


def run_robustness(
    out: Path,
    junit: Path | None = None,
    callback: ProgressCallback = no_progress,
    cases: Callable[[], Iterable[CheckedCase]] = all_cases,
) -> CheckedStudy:
    """Run all cases; leave stability.json in `out`, JUnit XML in the file `junit`. Raises
    InputError where those cannot be written."""
    check_places("stability", out, junit)
    start = perf_counter()
    rows = run_cases(cases(), callback)
    study = CheckedStudy("stability", rows, perf_counter() - start)
    write_study(study, out, junit)
    return study
