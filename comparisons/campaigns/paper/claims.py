"""What the sources claim, and how a number judges it: confirmed, denied, or inconclusive.

In: claims.toml, the paper's claims, and book.toml, Seireg's; runs of the scenes that stand for the
paper's surfaces. Out: claims with their numbers and outcomes.

A number confirms a claim where its whole uncertainty lies inside the claim's bounds, and denies it
where it lies outside of them (of wider bounds where the paper gives words and no number). The
outcome is inconclusive unless all models that can measure the claim say the same, and wherever the
stand-in profile was made to show what the claim says."""

import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from math import inf
from operator import methodcaller
from pathlib import Path

from comparisons.campaigns.paper import book
from comparisons.campaigns.paper.readings import SLIDING, LevelView
from comparisons.common.numbers import finite, plain
from comparisons.figures.convergence import grid_convergence
from comparisons.figures.figure import Figure, is_within
from comparisons.figures.quantity import LABELS, MODELS
from comparisons.figures.uncertainty import Uncertainty, iteration
from comparisons.studies.contact import by_repetition
from comparisons.studies.study import MODEL_ERROR, Run

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
CONFIRMED, DENIED, INCONCLUSIVE = "confirmed", "denied", "inconclusive"
OUTCOMES = {CONFIRMED: "agree", DENIED: "differ", INCONCLUSIVE: "inconclusive"}  # their colours
THEORY = "theory"  # what judges a claim that neither model solves
ORDER = 1.0  # formal, of what is read: with it a regular sequence gets the widest margin
IN_JSON = ("key", "figure", "title", "text", "measure", "scene")  # fields of a claim, as they are
NOT_CONVERGED = "not converged"  # note of a number

Bounds = tuple[float, float]
# By one of the view's methods; None: of a theory, which has no level.
Reading = Callable[[LevelView | None], float]


@dataclass(frozen=True)
class Claim:
    """One claim."""

    key: str  # for paper.json
    figure: str  # of the paper that shows it, with its letter
    title: str  # in a few words
    text: str  # what the paper says, in words of this project
    measure: str  # how the number is found
    scene: str  # whose stresses it is about
    reading: Reading  # of the number
    confirms: Bounds  # bounds of the number inside which the claim holds
    unit: str = ""  # "" | "a" | "p₀"
    allows: Bounds | None = None  # wider bounds, outside of which it is denied; None: the same
    ambiguity: str | None = None  # why a number between the two is inconclusive
    # what the stand-in profile was made to show, so that it proves nothing
    tuned: str | None = None
    models: tuple[str, ...] = MODELS  # that can measure it
    exact: bool = False  # the number is an error against an exact value
    besides: tuple[tuple[str, Reading], ...] = ()  # further numbers, by what they are
    # the compared one whose model error bears on the number; None: no figure of a real contact
    quantity: str | None = None
    slides: bool = False  # the number is one of the sliding contact

    @property
    def criterion(self) -> str:
        """What would confirm the claim, and what deny it."""
        confirmed = f"Confirmed {_range(self.confirms, self.unit)}"
        if self.allows is None:
            return f"{confirmed}, else denied."
        return f"{confirmed}, denied unless {_range(self.allows, self.unit)}."


def _range(bounds: Bounds, unit: str) -> str:
    low, high = bounds
    if high == inf:
        return f"from {plain(low)} {unit}".rstrip() + " on"
    return f"from {plain(low)} to {plain(high)} {unit}".rstrip()


@dataclass(frozen=True)
class JudgedClaim:
    """A claim with its outcome."""

    claim: Claim
    numbers: Mapping[str, Figure]  # by model, in the claim's unit, with its bounds
    besides: Mapping[str, Mapping[str, float]]  # by what they are, then by model
    outcome: str  # one of OUTCOMES
    why: str | None = None  # why it is inconclusive; None where it is not
    # of the half-plane in the quantity of the claim's figure; None where there is none
    model_error: Figure | None = None

    def as_dict(self) -> dict:
        """For paper.json: None stands for what is infinite."""
        claim, error = self.claim, self.model_error
        content = {name: getattr(claim, name) for name in IN_JSON} | {
            "unit": {"p₀": "p0"}.get(claim.unit, claim.unit),
            "confirmed_within": claim.confirms,
            "denied_outside": claim.allows or claim.confirms,
            "criterion": claim.criterion,
            "numbers": {
                model: {
                    "value": number.value,
                    "uncertainty": number.numerical,
                    "converged": NOT_CONVERGED not in number.notes,
                }
                for model, number in self.numbers.items()
            },
            "besides": self.besides,
            "outcome": self.outcome,
            "why": self.why,
            "model_error": error
            and {
                "quantity": error.quantity,
                "value": error.value,
                "uncertainty": error.numerical,
                "not_modelled": error.unknown,
            },
        }
        return finite(content)


def claims() -> tuple[Claim, ...]:
    """The paper's, in the order of its figures."""
    tables = _tables("claims.toml")
    listed = [_claim(table, methodcaller) for table in tables["claim"]]
    for scene in (UNRUN, RUN_IN, POLISHED):
        short = scene.removeprefix("ground-")
        words = {"figure": FIGURES[scene], "surface": SURFACES[scene], "short": short}
        words["words"] = short.replace("-", " ")
        for table in tables["rough_surface"]:
            texts = {n: text.format(**words) for n, text in table.items() if isinstance(text, str)}
            listed.append(_claim(table | texts | {"scene": scene}, methodcaller))
    return tuple(sorted(listed, key=lambda claim: int(claim.figure.partition("(")[0])))


def book_claims() -> tuple[Claim, ...]:
    """Seireg's, whose numbers are of the theory alone."""
    by_theory = {"scene": "", "models": [THEORY], "exact": True}
    return tuple(_claim(table | by_theory, _theory) for table in _tables("book.toml")["claim"])


def _tables(name: str) -> dict:
    return tomllib.loads(Path(__file__).with_name(name).read_text(encoding="utf-8"))


def _claim(table: dict, reading: Callable[..., Reading]) -> Claim:
    """A claim by its table; `reading` of a name and arguments."""
    fields = {name: tuple(v) if isinstance(v, list) else v for name, v in table.items()}
    besides = table.get("besides", {}).items()
    fields["besides"] = tuple((words, reading(*how)) for words, how in besides)
    return Claim(**fields | {"reading": reading(*table["reading"])})


def _theory(name: str, *arguments: float | str) -> Reading:
    return lambda _: getattr(book, name)(*arguments)


def judge(claim: Claim, run: Run | None) -> JudgedClaim:
    """Measure a claim on the run of its scene by every model that can, and judge it; None: by the
    theory alone."""
    numbers = {model: measured(claim, run, model) for model in claim.models}
    finest = {model: None if run is None else views_of(run, model)[-1] for model in claim.models}
    besides = {
        words: {model: reading(view) for model, view in finest.items()}
        for words, reading in claim.besides
    }
    friction = SLIDING if claim.slides else 0.0
    wanted = {"study": MODEL_ERROR, "quantity": claim.quantity, "friction": friction}
    error = None if run is None else run.figures.one(**wanted)
    return JudgedClaim(claim, numbers, besides, *judgement(claim, numbers), error)


def views_of(run: Run, model: str) -> list[LevelView]:
    levels = run.runs[model].levels
    return [LevelView(model, run.problem, level, run.window) for level in levels]


def measured(claim: Claim, run: Run | None, model: str) -> Figure:
    """A claim's number on the finest level of a model, with its uncertainty from all levels.

    Discretisation, far boundary and iteration as for a run's figures; besides, what reading only
    every second row and column of the window changes. An error against an exact value has no
    uncertainty of its own, nor has what a theory says."""
    number = partial(Figure, "paper", claim.key, model, bounds=claim.confirms)
    if run is None:
        return number(claim.reading(None), uncertainty=Uncertainty())
    views, levels = views_of(run, model), run.runs[model].levels
    values = [claim.reading(view) for view in views]
    notes = () if all(level.solution.converged for level in levels) else (NOT_CONVERGED,)
    if claim.exact:
        return number(values[-1], uncertainty=Uncertainty(), notes=notes)
    repeated = by_repetition(
        run.runs[model], lambda level: {"": claim.reading(replace(views[-1], level=level))}
    )
    parts = {
        "discretisation": grid_convergence(values, ORDER).uncertainty,
        "iteration": iteration(levels[-1]) * abs(values[-1]),
        "reading": abs(claim.reading(replace(views[-1], every=2)) - values[-1]),
        **dict(zip(("domain", "increments"), repeated[""], strict=True)),
    }
    return number(values[-1], uncertainty=Uncertainty(parts), notes=notes)


def judgement(claim: Claim, numbers: Mapping[str, Figure]) -> tuple[str, str | None]:
    """Outcome by the numbers of each model, and why it is inconclusive."""

    def named(*models: str) -> str:
        return " and the ".join(LABELS[model] for model in models)

    unsolved = [model for model, number in numbers.items() if NOT_CONVERGED in number.notes]
    if unsolved:
        return INCONCLUSIVE, f"the contact of the {named(*unsolved)} did not converge"
    places = {model: _place(claim, number) for model, number in numbers.items()}
    unclear = [model for model, place in places.items() if place == "on a bound"]
    if unclear:
        why = f"the numerical uncertainty of the {named(*unclear)} reaches over a bound"
        return INCONCLUSIVE, why
    if len(set(places.values())) > 1:
        return INCONCLUSIVE, "the two models do not say the same"
    (place,) = set(places.values())
    if place == "between":
        return INCONCLUSIVE, claim.ambiguity
    if place == "outside":
        return DENIED, None
    if claim.tuned:
        made = f"the stand-in profile was made to show {claim.tuned}"
        return INCONCLUSIVE, f"{made}, so that the number is met proves nothing"
    return CONFIRMED, None


def _place(claim: Claim, number: Figure) -> str:
    """Where a number with its uncertainty lies: inside | outside | between | on a bound."""
    inner, outer = (
        is_within(number.value, number.numerical, *bounds)
        for bounds in (claim.confirms, claim.allows or claim.confirms)
    )
    if inner:
        return "inside"
    if outer is False:
        return "outside"
    return "between" if outer and inner is False else "on a bound"
