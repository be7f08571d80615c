"""Claims and their numbers in words, for the page and as a table for the terminal."""

from math import isfinite
from typing import TYPE_CHECKING

from comparisons.campaigns.paper.claims.judgement import (
    CONFIRMED,
    DENIED,
    INCONCLUSIVE,
    THEORY,
    JudgedClaim,
)
from comparisons.common.numbers import MINUS, UNKNOWN, percent, significant
from comparisons.figures.figure import Figure
from comparisons.figures.quantity import LABELS, MODELS, error_text, label
from comparisons.output.terminal import PLAIN, STYLES, plain_table
from comparisons.studies.model_error.catalogue import EFFECTS

if TYPE_CHECKING:
    from rich.console import RenderableType

    from comparisons.campaigns.paper.reproduce import Paper

KINDS = {CONFIRMED: "agree", DENIED: "differ", INCONCLUSIVE: "inconclusive"}
DIGITS = 4  # of a number with an uncertainty


def claim_row(judged: JudgedClaim) -> dict:
    """A judged claim in words: number with uncertainty by model, the same as lines that name their
    model, further numbers as lines, and the kind that names its colours."""
    claim = judged.claim
    by_model = {model: number_text(n, claim.unit) for model, n in judged.numbers.items()}
    besides = {
        f"{words[0].upper()}{words[1:]}": _lines({m: significant(v, 3) for m, v in values.items()})
        for words, values in judged.besides.items()
    }
    return {
        "claim": claim,
        "confirmed": claim.criterion.removeprefix("Confirmed ").split(", ")[0],
        "by_model": by_model,
        "numbers": _lines(by_model),
        "besides": [f"{words}: {'; '.join(lines)}" for words, lines in besides.items()],
        "outcome": judged.outcome,
        "kind": KINDS[judged.outcome],
        "why": judged.why,
        "model_error": judged.model_error and model_error_text(judged.model_error),
    }


def model_error_text(error: Figure) -> str:
    """What was computed, with its uncertainty, and the most that was not."""
    size = error_text(error.quantity, error.value, error.numerical)
    text = f"{label(error.quantity)} {size} ± {percent(error.numerical)}"
    if error.unknown:
        most = EFFECTS[max(error.unknown, key=error.unknown.get)].label
        left = percent(error.not_modelled)
        text += f"; not modelled, by estimate: at most {left}, {most} most"
    return text


def number_text(number: Figure, unit: str) -> str:
    """Value and uncertainty down to one digit beyond its first, at most DIGITS digits in all."""
    value, uncertainty = number.value, number.numerical
    if not isfinite(uncertainty):
        return f"{significant(value, DIGITS)} ± {UNKNOWN} {unit}".rstrip()
    shown = 3 if uncertainty == 0.0 else DIGITS
    places = shown - 1 - _power(value) if value else shown - 1
    if uncertainty > 0.0:
        places = min(places, 1 - _power(uncertainty))
    if round(uncertainty, places) == 0.0:
        return f"{significant(value, shown)} {unit}".rstrip()
    places = max(places, 0)
    text = f"{value:.{places}f} ± {uncertainty:.{places}f}".replace("-", MINUS)
    return f"{text} {unit}".rstrip()


def summary(judged: tuple[JudgedClaim, ...]) -> str:
    counts = {kind: sum(j.outcome == kind for j in judged) for kind in KINDS}
    return (
        f"Of {len(judged)} claims that numbers can judge, {counts[CONFIRMED]} are confirmed and "
        f"{counts[DENIED]} denied; {counts[INCONCLUSIVE]} are inconclusive on the stand-in "
        "profiles."
    )


def paper_table(paper: "Paper") -> "RenderableType":
    from rich.console import Group
    from rich.text import Text

    models = (*MODELS, THEORY)
    table = plain_table("claim", "figure", numbers=[LABELS.get(m, m) for m in models])
    table.add_column("outcome")
    for row in map(claim_row, paper.judged):
        claim, numbers = row["claim"], (row["by_model"].get(m, "") for m in models)
        cells = (claim.title, claim.figure, *numbers)
        plain = [cell.replace("±", "+-").translate(PLAIN) for cell in cells]
        table.add_row(*plain, Text(row["outcome"], style=STYLES[row["kind"]]))
    return Group(
        table, "", summary(paper.judged), f"figures and claims {paper.directory / 'paper.html'}"
    )


def _power(value: float) -> int:
    return int(f"{abs(value):.0e}".partition("e")[2])


def _lines(texts: dict[str, str]) -> tuple[str, ...]:
    """A line a model, or one for both where they say the same."""
    if len(set(texts.values())) == 1 and len(texts) > 1:
        return (f"{next(iter(texts.values()))} (both models)",)
    return tuple(f"{LABELS.get(model, model)} {text}" for model, text in texts.items())
