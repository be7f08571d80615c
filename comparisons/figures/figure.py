"""A figure says by itself what it is: of what, by whom, against whom, how sure, what is allowed.

In: what a study has found. Out: the types that every output shows, judges and stores.

Whoever makes a figure states its uncertainty; whoever shows one never makes it up. The verdict
follows by one rule from value d, uncertainty and estimates U, and bounds, and is kept nowhere: yes
where all of d +- U lies within the bounds, no where all of it is beyond, inconclusive where it
reaches across, or where U is not known."""

import math
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal, TypeVar

import numpy as np

from comparisons.common.numbers import percent, percent_as_written
from comparisons.figures.quantity import WHOLE, error_text
from comparisons.figures.uncertainty import Uncertainty

Item = TypeVar("Item")
Verdict = Literal["agree", "differ", "inconclusive", "holds", "fails"]

AGREE = {True: "agree", False: "differ", None: "inconclusive"}  # with another's figure
HOLD = {True: "holds", False: "fails", None: "inconclusive"}
FAILED, PASSED = ("differ", "fails"), ("agree", "holds")
WORST_FIRST = (*FAILED, "inconclusive", *PASSED)
# An estimate that all models have alike: nothing holds within it, and it excuses no failure.
SHARED = "trace_sampling"
SMALL = 1.0 / 3.0  # of what is not modelled: a numerical uncertainty that hardly matters


def is_within(value: float, uncertainty: float, low: float, high: float) -> bool | None:
    """Whether value +- uncertainty lies between the bounds, which belong to the inside: all of it
    (True), nothing (False), or neither (None), as where one is not finite. All in one unit."""
    first, last = value - uncertainty, value + uncertainty
    if not (math.isfinite(first) and math.isfinite(last)):
        return None
    if low <= first and last <= high:
        return True
    return False if last < low or first > high else None


def is_decided(difference: float, uncertainty: float, size: float, tolerance: float) -> bool:
    """True if it is known that a difference agrees or differs, whatever effects that change its
    reference by up to `size` in all do to it; all relative."""
    if not size < 1.0:
        return False
    moved = (1.0 + abs(difference)) * size / (1.0 - size)
    return is_within(difference, uncertainty + moved, -tolerance, tolerance) is not None


@dataclass(frozen=True)
class Part:
    """Part of a figure: an effect, the interaction, an input; over the figure's scale."""

    name: str
    value: float
    uncertainty: float | None = None
    moves_maximum: bool = False  # by itself it moves the largest value to another asperity


@dataclass(frozen=True)
class SampleSpread:
    """A figure [SI] over samples of uncertain inputs."""

    mean: float
    deviation: float  # standard
    interval: tuple[float, float]  # from the 2.5th to the 97.5th percentile
    # of its variance, by input: first, total, and the uncertainty of either; None: it varies not
    shares: Mapping[str, Mapping[str, float]] | None


@dataclass(frozen=True, repr=False)
class Figure:
    """One number with its meaning; study, quantity, source, against and at name it in a run."""

    study: str  # that found it
    quantity: str  # key of the study's QUANTITIES: label, unit, formal order
    source: str  # who says so: half_plane | finite_element | whole | hertz | a rule | an answer
    # SI; of a difference (source - reference) / scale, or the norm of that
    value: float
    at: Mapping[str, float] = field(default_factory=dict)  # {"friction": 0.1}
    against: str | None = None  # the reference of a difference; None: a value by itself
    # SI, above 0: what the uncertainty, the bounds and the value of a difference are relative to
    scale: float = 1.0
    uncertainty: Uncertainty | None = None  # None: not stated
    unknown: Mapping[str, float] = field(default_factory=dict)  # estimates of what is not modelled
    bounds: tuple[float, float] | None = None  # of what is judged, inclusive; None: not judged
    parts: tuple[Part, ...] = ()
    spread: SampleSpread | None = None
    place: tuple[float, ...] | None = None  # [m]
    levels: tuple[float, ...] = ()  # the figure on each level, coarse to fine
    notes: tuple[str, ...] = ()

    def __repr__(self) -> str:
        """Name, value, uncertainty and verdict, as far as there are any."""
        names = self.study, self.quantity, self.source, self.against and f"against {self.against}"
        at = (f"{name} {value:g}" for name, value in self.at.items())
        stated = "" if self.uncertainty is None else f" ± {100.0 * self.numerical:.2g} %"
        verdict = "" if self.verdict is None else f", {self.verdict}"
        return f"<{', '.join([*filter(None, names), *at])}: {self.value:.6g}{stated}{verdict}>"

    @property
    def key(self) -> tuple[Hashable, ...]:
        """Key that names the figure in a run."""
        at = tuple(sorted(self.at.items()))
        return self.study, self.quantity, self.source, self.against, at

    @property
    def friction(self) -> float | None:
        return self.at.get("friction")

    @property
    def relative(self) -> float:
        """The value over its scale; of a difference the value itself."""
        return self.value / self.scale if self.against is None else self.value

    @property
    def by_inputs(self) -> float:
        """Half the interval of its spread, over the scale."""
        low, high = self.spread.interval
        return 0.5 * (high - low) / self.scale

    @property
    def numerical(self) -> float:
        """Total uncertainty over the scale; infinite where it is not stated or unknown."""
        return math.inf if self.uncertainty is None else self.uncertainty.total

    @property
    def not_modelled(self) -> float:
        """Root of the sum of squares of the estimates, which are independent of each other."""
        return math.hypot(*self.unknown.values())

    @property
    def largest_unknown(self) -> str:
        """Name of the largest estimate; empty without any."""
        return max(self.unknown, key=self.unknown.get, default="")

    @property
    def total(self) -> float:
        """Uncertainty and what is not modelled."""
        return self.numerical + self.not_modelled

    @property
    def reach(self) -> float:
        """Farthest it may lie, and the least tolerance at which it holds: |value| and total, over
        the scale."""
        return abs(self.relative) + self.total

    def sized(self, unsure: float | None = None) -> str:
        """A difference ± its numerical uncertainty, or another one over the scale, in per cent and
        in the digits that are certain."""
        unsure = self.numerical if unsure is None else unsure
        size = error_text(self.value, unsure).removesuffix(" %")
        return f"{size} ± {percent(unsure)}"

    def words(self, unsure: float | None = None) -> str:
        """Difference ± uncertainty, with the verdict at its tolerance where it is judged."""
        said = self.sized(unsure)
        if self.bounds is None:
            return said
        return f"{said}, {self.verdict} at {percent_as_written(self.tolerance)}"

    @property
    def tolerance(self) -> float | None:
        """Tolerance of a figure that is judged to both sides alike."""
        return None if self.bounds is None else self.bounds[1]

    @property
    def verdict(self) -> Verdict | None:
        """Whether value +- total lies within the bounds, beyond them, or across; None: not judged.
        Two sources agree or differ; the half-plane's model error, and what is no difference, holds
        or fails."""
        if self.bounds is None:
            return None
        words = HOLD if self.against in (None, WHOLE) else AGREE
        own = math.hypot(*(size for name, size in self.unknown.items() if name != SHARED))
        if is_within(self.relative, self.numerical + own, *self.bounds) is False:
            return words[False]
        return words[is_within(self.relative, self.total, *self.bounds)]

    def part(self, name: str) -> Part | None:
        return next((part for part in self.parts if part.name == name), None)

    @property
    def is_unresolved(self) -> bool:
        """Whether the numerical uncertainty alone makes the verdict inconclusive, and is no smaller
        than what is not modelled."""
        alone = is_within(self.relative, self.numerical, *self.bounds) is None
        return alone and self.numerical >= self.not_modelled

    @property
    def is_fixed(self) -> bool:
        """True if a finer solution leaves the verdict as it is, wherever in the uncertainty its
        value comes to lie. An inconclusive one is fixed only where what is not modelled is by far
        the larger unknown: else the figure itself is worth a finer solution."""
        if self.verdict != "inconclusive":
            return True
        least = max(0.0, abs(self.relative) - self.numerical)
        most = abs(self.relative) + self.numerical
        low, high = least + self.not_modelled, most - self.not_modelled
        turns = low <= self.tolerance or high > self.tolerance
        return not turns and self.numerical <= SMALL * self.not_modelled


class Figures(tuple[Figure, ...]):
    """Figures in the order in which they are shown. Raises ValueError where two have one name."""

    def __new__(cls, figures: Iterable[Figure] = ()) -> "Figures":
        made = super().__new__(cls, figures)
        names = [figure.key for figure in made]
        if len(set(names)) < len(names):
            twice = next(name for name in names if names.count(name) > 1)
            raise ValueError(f"two figures are called {twice}")
        return made

    def of(self, **wanted: object) -> "Figures":
        """Figures whose fields (or `friction`) have the wanted values."""
        return Figures(f for f in self if all(getattr(f, n) == v for n, v in wanted.items()))

    def one(self, **wanted: object) -> Figure | None:
        """The first of these, None without any."""
        return next(iter(self.of(**wanted)), None)


def deciding(judged: Sequence[Figure]) -> Figure:
    """Figure, of those with the worst verdict, farthest outside, or nearest to, its tolerance."""
    return min(judged, key=lambda f: (WORST_FIRST.index(f.verdict), -f.reach / f.tolerance))


@dataclass(frozen=True)
class Column:
    """Values (n,) of one kind, numbers or texts, and their uncertainty (n,), absolute."""

    values: tuple
    unit: str = ""
    uncertainty: tuple[float, ...] | None = None

    @property
    def numbers(self) -> np.ndarray:
        """The values (n,) of numbers, nan where there is none."""
        return np.array(self.values, dtype=float)

    @property
    def sizes(self) -> np.ndarray:
        """The uncertainties (n,), nan where they are not stated."""
        return np.array(self.uncertainty or (np.nan,) * len(self.values), dtype=float)


@dataclass(frozen=True)
class Series:
    """Columns of one length: a curve, or a table that belongs to a source."""

    name: str
    columns: Mapping[str, Column]
    source: str = ""
    at: Mapping[str, float] = field(default_factory=dict)
    # what the run took or planned, no result: a repetition may have another one
    is_account: bool = False

    def rows(self) -> list[dict[str, object]]:
        """A dictionary by column for each row."""
        values = [list(column.values) for column in self.columns.values()]
        return [dict(zip(self.columns, row, strict=True)) for row in zip(*values, strict=True)]


@dataclass(frozen=True)
class Statement:
    """Statement of a study in words: a state, why something was skipped, a hint."""

    name: str
    text: str
    source: str = ""
    at: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Findings:
    """Findings of one study in one run."""

    figures: tuple[Figure, ...] = ()
    series: tuple[Series, ...] = ()
    statements: tuple[Statement, ...] = ()
    # arrays that its pictures are drawn from
    data: object = None

    def table(self, name: str, source: str | None = None, **at: float) -> Series | None:
        """The first series of that name, source and `at`; None without one."""
        return next((s for s in self.series if _is_called(s, name, source, at)), None)

    def said(self, name: str, source: str | None = None, **at: float) -> str | None:
        """The text of the first statement of that name, source and `at`; None without one."""
        return next((s.text for s in self.statements if _is_called(s, name, source, at)), None)


def _is_called(
    item: Series | Statement, name: str, source: str | None, at: Mapping[str, float]
) -> bool:
    there = item.name == name and source in (None, item.source)
    return there and all(item.at.get(key) == value for key, value in at.items())


def figures_of(
    study: str,
    source: str,
    values: Mapping[str, float | None],
    uncertainty: Uncertainty | None = None,
    at: Mapping[str, float] | None = None,
) -> list[Figure]:
    """Plain figures of values [SI] by quantity, as far as they are known, all as certain: relative
    to their size, or to 1 where that is 0. None is exact."""
    return [
        Figure(
            study=study,
            quantity=name,
            source=source,
            value=float(value),
            at=at or {},
            scale=abs(value) or 1.0,
            uncertainty=uncertainty or Uncertainty(),
        )
        for name, value in values.items()
        if value is not None and math.isfinite(value)
    ]


def columns_of(
    rows: Sequence[Mapping[str, object]],
    units: Mapping[str, str] = {},
    uncertainties: Mapping[str, Iterable[float]] = {},
) -> dict[str, Column]:
    """Columns by name of rows that are dictionaries, None where a row has no such name; units and
    uncertainties (n,), absolute, of those that have any."""
    return {
        name: Column(
            tuple(row.get(name) for row in rows),
            units.get(name, ""),
            tuple(uncertainties[name]) if name in uncertainties else None,
        )
        for name in dict.fromkeys(name for row in rows for name in row)
    }


def grouped(items: Iterable[Item], key: Callable[[Item], Hashable]) -> list[list[Item]]:
    """Items of equal keys together, in the order in which the keys first occur."""
    together: dict[Hashable, list[Item]] = {}
    for item in items:
        together.setdefault(key(item), []).append(item)
    return list(together.values())
