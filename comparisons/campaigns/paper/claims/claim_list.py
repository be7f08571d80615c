"""The claims that numbers can judge, the paper's of claims.toml and Seireg's of book.toml; and the
scenes that stand for the paper's surfaces."""

import tomllib
from collections.abc import Mapping
from pathlib import Path
from types import ModuleType

from comparisons.campaigns.paper.claims import book, readings
from comparisons.campaigns.paper.claims.judgement import THEORY, Claim, Reading

# The scenes that stand for the paper's surfaces, its figures of them, and their names.
SMOOTH, UNRUN, RUN_IN, POLISHED = "smooth", "ground-unrun", "ground-run-in", "ground-polished"
SCENES = (SMOOTH, UNRUN, RUN_IN, POLISHED)
FIGURES = {SMOOTH: "6", UNRUN: "8", RUN_IN: "9", POLISHED: "10"}
SURFACES = {
    SMOOTH: "smooth surface",
    UNRUN: "unrun ground surface",
    RUN_IN: "run-in ground surface",
    POLISHED: "polished ground surface",
}


def claims() -> tuple[Claim, ...]:
    """The paper's, in the order of its figures."""
    tables = _tables("claims.toml")
    listed = [_claim(table, readings) for table in tables["claim"]]
    for scene in (UNRUN, RUN_IN, POLISHED):
        short = scene.removeprefix("ground-")
        words = {"figure": FIGURES[scene], "surface": SURFACES[scene], "short": short}
        words["words"] = short.replace("-", " ")
        for table in tables["rough_surface"]:
            said = {name: _filled(value, words) for name, value in table.items()}
            listed.append(_claim(said | {"scene": scene}, readings))
    return tuple(sorted(listed, key=lambda claim: int(claim.figure.partition("(")[0])))


def book_claims() -> tuple[Claim, ...]:
    """Seireg's, whose numbers are of the theory alone."""
    by_theory = {"scene": "", "models": [THEORY], "exact": True}
    return tuple(_claim(table | by_theory, book) for table in _tables("book.toml")["claim"])


def _tables(name: str) -> dict:
    return tomllib.loads(Path(__file__).with_name(name).read_text(encoding="utf-8"))


def _filled(value: object, words: Mapping[str, str]) -> object:
    """`words` stand for names in braces."""
    return value.format(**words) if isinstance(value, str) else value


def _claim(table: dict, module: ModuleType) -> Claim:
    """A claim by its table, with readings of a module."""
    fields = {name: tuple(v) if isinstance(v, list) else v for name, v in table.items()}
    fields["besides"] = tuple(
        (words, _reading(module, *how)) for words, how in table.get("besides", {}).items()
    )
    return Claim(**fields | {"reading": _reading(module, *table["reading"])})


def _reading(module: ModuleType, name: str, *arguments: float | str) -> Reading:
    """A function of a view and arguments; of a theory of the arguments alone."""
    function = getattr(module, name)
    if module is book:
        return lambda _: function(*arguments)
    return lambda view: function(view, *arguments)
