"""Claims and their numbers as a reader sees them."""

from dataclasses import dataclass
from math import isfinite

from comparisons.common.model_names import LABELS
from comparisons.common.numbers import MINUS, UNKNOWN, significant
from comparisons.studies.paper.claims.claims import CONFIRMED, DENIED, UNTOLD, Judged
from comparisons.studies.paper.claims.views import Measured

KINDS = {CONFIRMED: "agree", DENIED: "differ", UNTOLD: "inconclusive"}
DIGITS = 4  # of a number with an uncertainty


@dataclass(frozen=True)
class Row:
    """A judged claim in words; `kind` names its colours, numbers are empty where there is none."""

    key: str
    figure: str
    title: str
    text: str
    measure: str
    criterion: str
    confirmed: str
    half_plane: str
    finite_element: str
    numbers: tuple[str, ...]
    besides: tuple[str, ...]
    outcome: str
    kind: str
    why: str | None


def row_of(judged: Judged) -> Row:
    claim = judged.claim
    numbers = {m: number_text(n, claim.unit) for m, n in judged.numbers.items()}
    return Row(
        key=claim.key,
        figure=claim.figure,
        title=claim.title,
        text=claim.text,
        measure=claim.measure,
        criterion=claim.criterion,
        confirmed=claim.criterion.removeprefix("Confirmed ").split(", ")[0],
        half_plane=numbers.get("half_plane", ""),
        finite_element=numbers.get("finite_element", ""),
        numbers=_by_model(numbers),
        besides=tuple(
            f"{words[0].upper()}{words[1:]}: "
            + "; ".join(_by_model({m: significant(v, 3) for m, v in values.items()}))
            for words, values in judged.besides.items()
        ),
        outcome=judged.outcome,
        kind=KINDS[judged.outcome],
        why=judged.why,
    )


def number_text(number: Measured, unit: str) -> str:
    """Value and uncertainty down to one digit beyond its first, at most DIGITS digits in all."""
    value, doubt = number.value, number.uncertainty
    if not isfinite(doubt):
        return f"{significant(value, DIGITS)} ± {UNKNOWN} {unit}".rstrip()
    shown = 3 if doubt == 0.0 else DIGITS
    places = shown - 1 - _power(value) if value else shown - 1
    if doubt > 0.0:
        places = min(places, 1 - _power(doubt))
    if round(doubt, places) == 0.0:
        return f"{significant(value, shown)} {unit}".rstrip()
    places = max(places, 0)
    text = f"{value:.{places}f} ± {doubt:.{places}f}".replace("-", MINUS)
    return f"{text} {unit}".rstrip()


def _power(value: float) -> int:
    """Of ten, of the leading digit."""
    return int(f"{abs(value):.0e}".partition("e")[2])


def summary(judged: tuple[Judged, ...]) -> str:
    """How many claims ended how."""
    counts = {kind: sum(j.outcome == kind for j in judged) for kind in KINDS}
    return (
        f"Of {len(judged)} claims that numbers can judge, {counts[CONFIRMED]} are confirmed, "
        f"{counts[DENIED]} denied; {counts[UNTOLD]} cannot be told on the stand-in profiles."
    )


def _by_model(texts: dict[str, str]) -> tuple[str, ...]:
    if len(set(texts.values())) == 1 and len(texts) > 1:
        return (f"{next(iter(texts.values()))} (both models)",)
    return tuple(f"{LABELS[model]} {text}" for model, text in texts.items())
