"""All stiff and extreme cases, as `crosscheck stability` runs them: the rows of rows.toml."""

import tomllib
from collections.abc import Callable, Iterable
from functools import partial
from importlib import import_module
from pathlib import Path

from comparisons.campaigns.cases import Campaign, Case, carry_out
from comparisons.common.progress import ProgressCallback, no_progress


def all_cases() -> list[Case]:
    text = Path(__file__).with_name("rows.toml").read_text(encoding="utf-8")
    return [
        Case(group, name, model, partial(getattr(_module(module), function), **arguments))
        for model, modules in tomllib.loads(text).items()
        for module, functions in modules.items()
        for function, groups in functions.items()
        for group, rows in groups.items()
        for name, arguments in rows.items()
    ]


def _module(name: str) -> object:
    return import_module(f"{__package__}.{name}")


def run_robustness(
    out: Path,
    junit: Path | None = None,
    callback: ProgressCallback = no_progress,
    cases: Callable[[], Iterable[Case]] = all_cases,
) -> Campaign:
    """Run all cases; leave stability.json in `out`, JUnit XML in the file `junit`. Raises
    InputError where those cannot be written."""
    return carry_out("stability", tuple(cases()), out, junit, callback)
