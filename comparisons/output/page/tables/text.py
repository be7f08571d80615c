"""What the report's tables share: cells of text, and quantities written in one way everywhere."""

import tomllib
from collections.abc import Iterable
from functools import cache
from pathlib import Path

from comparisons.common.numbers import percent, plain
from comparisons.figures.quantity import QUANTITIES
from comparisons.studies.study import Run

REPEATED = "contact_ratio"


@cache
def wording() -> dict[str, dict]:
    """What the tables call things, by the tables of words.toml."""
    return tomllib.loads(Path(__file__).with_name("words.toml").read_text(encoding="utf-8"))


def is_shown(outcome: Run, quantity: str) -> bool:
    """Whether a figure has a row beside the contact length, which stands over Hertz's: the contact
    ratio, that over a constant, has one only where it is judged."""
    return quantity != REPEATED or quantity in outcome.problem.scene.tolerances


def listed(numbers: Iterable[float]) -> str:
    """Numbers of the scene, such as friction coefficients, separated by commas."""
    return ", ".join(map(plain, numbers))


def error_text(quantity: str, value: float, uncertainty: float | None = None) -> str:
    """A relative error in per cent, signed but for norms, in digits that are certain."""
    return percent(value, signed=not QUANTITIES[quantity].of_pair, uncertainty=uncertainty)
