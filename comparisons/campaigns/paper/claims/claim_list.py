"""The paper's claims that numbers can judge, as `claims.toml` states them, and its surfaces."""

import tomllib
from pathlib import Path

from comparisons.campaigns.paper.claims import readings, waves
from comparisons.campaigns.paper.claims.judgement import Claim
from comparisons.campaigns.paper.claims.readings import Reading

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
    tables = tomllib.loads(Path(__file__).with_name("claims.toml").read_text(encoding="utf-8"))
    found = [_claim(table, {}) for table in tables["claim"]]
    for scene in (UNRUN, RUN_IN, POLISHED):
        short = scene.removeprefix("ground-")
        words = {"figure": FIGURES[scene], "surface": SURFACES[scene], "short": short}
        words["words"] = short.replace("-", " ")
        found += [_claim(table | {"scene": scene}, words) for table in tables["rough_surface"]]
    return tuple(sorted(found, key=lambda claim: int(claim.figure.partition("(")[0])))


def _claim(table: dict, words: dict[str, str]) -> Claim:
    """A claim by its table in claims.toml; `words` stand for names in braces."""
    fields = {
        name: value.format(**words) if isinstance(value, str) else value
        for name, value in table.items()
    }
    fields |= {name: tuple(value) for name, value in fields.items() if isinstance(value, list)}
    besides = tuple((name, _reading(*each)) for name, each in fields.get("besides", {}).items())
    return Claim(**fields | {"reading": _reading(*fields["reading"]), "besides": besides})


def _reading(name: str, *given: float | str | bool) -> Reading:
    function = getattr(readings, name, None) or getattr(waves, name)
    return function(*given) if given else function
