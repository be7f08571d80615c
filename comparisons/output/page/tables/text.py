"""What the report's tables call things."""

import tomllib
from functools import cache
from pathlib import Path


@cache
def wording() -> dict[str, dict]:
    """What the tables call things, by the tables of words.toml."""
    return tomllib.loads(Path(__file__).with_name("words.toml").read_text(encoding="utf-8"))
