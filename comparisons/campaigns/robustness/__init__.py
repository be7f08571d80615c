"""`crosscheck stability`: stiff and extreme cases of both models, the rows of rows.toml."""

import tomllib
from functools import partial
from importlib import import_module
from pathlib import Path

from comparisons.campaigns.cases import Trial


def all_cases() -> list[Trial]:
    """A row names its model, whose module has the function that solves it, and the arguments."""
    text = Path(__file__).with_name("rows.toml").read_text(encoding="utf-8")
    return [
        Trial(group, name, model, partial(getattr(module, function), **arguments))
        for model, functions in tomllib.loads(text).items()
        for module in [import_module(f"{__package__}.{model}")]
        for function, groups in functions.items()
        for group, rows in groups.items()
        for name, arguments in rows.items()
    ]
