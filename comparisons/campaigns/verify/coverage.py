"""Figures with an exact value: coverage of their stated uncertainties, and orders of convergence.

In: rows of cases that yield figures with exact values, and whether both are close (`compared`).
Out: rows of what must hold of all of them together.

Of one contact the error varies with where the edge falls between two nodes; the root mean square
over contacts with different numbers of elements falls like a power of the element size."""

import tomllib
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from comparisons.campaigns.cases import CaseFigures, Row, bounded, holds, order_figure, summary_row
from comparisons.figures.figure import Figure, Part
from comparisons.figures.uncertainty import COVERAGE
from comparisons.judging import contact
from comparisons.judging.study import MODEL_ERROR

LEAST_COVERAGE = COVERAGE
# Median of stated uncertainty over true error, of all figures and of rough contacts: with few
# elements to an asperity the first level is not yet of the order that the others show.
MOST_OVERESTIMATION, MOST_ROUGH = 5.0, 15.0
FEWEST, FEWEST_ROUGH = 400, 150  # informative figures, in all and of rough contacts
ROUND_OFF = 1e-10  # relative; the tables of references have as many digits
BOUNDS = tomllib.loads(Path(__file__).with_name("bounds.toml").read_text(encoding="utf-8"))
CEILINGS: dict[str, float] = BOUNDS["ceilings"]
# Times these: rough contacts have fewer elements to a patch; a model error is made of two figures.
ROUGH_FACTOR, MODEL_ERROR_FACTOR = 4.0, 2.0
PARTS = ("iteration", "discretisation", "domain")  # of an uncertainty
EXACT = "exact"  # the source of exact values
TABLES = {contact.NAME: "figure", MODEL_ERROR: "model error"}  # words for a run's two tables
NOT_CONVERGED = "not converged"  # note of a figure: a level did not meet its contact conditions
PRESSURE = "pressure in L2"
ORDERS = {(model, q): order for model, of in BOUNDS["orders"].items() for q, order in of.items()}
# Fields of the pairs by which their coverage is shown.
GROUPS = (("table", "model", "quantity"), ("table", "kind"))
FEWEST_CONTACTS = 16  # for an observed order


def compared(
    figure: Figure, exact: float, reference: str, kind: str, converged: bool = True
) -> CaseFigures:
    """The figure of a case of that kind, with its exact value by a reference [SI]; and its error,
    which must be below a ceiling whatever uncertainty is stated, infinite if not converged."""
    notes = (reference,) if converged else (reference, NOT_CONVERGED)
    figure = replace(figure, parts=(Part(EXACT, float(exact)),), notes=notes)
    return figure, Pair(kind, "", figure).closeness


@dataclass(frozen=True)
class Pair:
    """A figure of one model, or one model error of the half-plane, beside its exact value."""

    # kind, case: Hertz | surface | sliding | hardness | layer | wave | punch | rough, and its name
    kind: str
    case: str
    figure: Figure  # with its levels, its uncertainty as stated, and what `compared` adds

    @property
    def exact(self) -> float:
        return self.figure.part(EXACT).value

    @property
    def reference(self) -> str:
        return self.figure.notes[0]

    @property
    def converged(self) -> bool:
        return NOT_CONVERGED not in self.figure.notes

    @property
    def model(self) -> str:
        return self.figure.source

    @property
    def quantity(self) -> str:
        return self.figure.quantity

    @property
    def table(self) -> str:
        return TABLES[self.figure.study]

    @property
    def errors(self) -> list[float]:
        """True errors of all levels, relative to the figure's scale, with their signs."""
        return [(value - self.exact) / self.figure.scale for value in self.figure.levels]

    @property
    def error(self) -> float:
        """Error of the finest level."""
        return self.errors[-1]

    @property
    def informative(self) -> bool:
        """Whether the error is more than rounding, which any uncertainty would cover."""
        return bool(abs(self.error) > ROUND_OFF)

    @property
    def covered(self) -> bool:
        return bool(abs(self.error) <= max(self.figure.numerical, ROUND_OFF))

    @property
    def overestimation(self) -> float | None:
        """Stated uncertainty over true error; None where the error is rounding."""
        return self.figure.numerical / abs(self.error) if self.informative else None

    @property
    def closeness(self) -> Figure:
        """The error below its ceiling."""
        figure, is_error = self.figure, self.figure.study == MODEL_ERROR
        ceiling = CEILINGS[self.quantity] * (ROUGH_FACTOR if self.kind == "rough" else 1.0)
        ceiling *= MODEL_ERROR_FACTOR if is_error else 1.0
        ratio = "rounding" if self.overestimation is None else f"{self.overestimation:.3g}"
        note = (
            f"value {figure.value:.12g}, exact {self.exact:.12g}, relative error "
            f"{self.error:.3e}, stated uncertainty {figure.numerical:.3e}, "
            f"{'covered' if self.covered else 'NOT covered'}, overestimation ratio {ratio}, "
            + (figure.uncertainty.convergence.behaviour if self.converged else NOT_CONVERGED)
        )
        error = abs(self.error) if self.converged else np.inf
        name = f"{self.table}, {self.quantity}" if is_error else self.quantity
        return bounded(name, error, ceiling, self.reference, note=note)

    def as_dict(self) -> dict:
        stated = self.figure.uncertainty
        names = "case", "kind", "table", "model", "quantity", "exact", "error", "covered"
        return {name: getattr(self, name) for name in names} | {
            "source": self.reference,
            "converged": self.converged,
            "levels": self.figure.levels,
            "scale": self.figure.scale,
            "uncertainty": {"total": stated.total} | {k: stated.parts.get(k, 0.0) for k in PARTS},
            "overestimation_ratio": self.overestimation,
            "behaviour": stated.convergence.behaviour,
            "order": stated.convergence.order,
            "close": holds(self.closeness),
        }


def pairs_of(row: Row) -> list[Pair]:
    """The figures of a row that have an exact value."""
    case = row.case.group, row.case.name
    return [Pair(*case, figure) for figure in row.figures if figure.part(EXACT)]


@dataclass(frozen=True)
class Coverage:
    """Coverage of the true errors of some pairs by their stated uncertainties."""

    count: int
    informative: int  # pairs whose error is more than rounding; the rest counts only these
    covered: float  # share of them; NaN, as are the next two, if there are none
    median_overestimation: float  # of their overestimation ratios
    overestimation_quantile: float  # 90 % quantile


def coverage(pairs: Iterable[Pair]) -> Coverage:
    pairs = list(pairs)
    informative = [pair for pair in pairs if pair.informative]
    if not informative:
        return Coverage(len(pairs), 0, np.nan, np.nan, np.nan)
    ratios = [pair.overestimation for pair in informative]
    share = float(np.mean([pair.covered for pair in informative]))
    median, high = float(np.median(ratios)), float(np.quantile(ratios, 0.9))
    return Coverage(len(pairs), len(informative), share, median, high)


def coverage_rows(pairs: Sequence[Pair], fewest: int, fewest_rough: int) -> Iterator[Row]:
    """Enough informative figures, covered often enough, by uncertainties that are not too large:
    of all contacts, and of the rough ones."""
    yield _coverage_row("all figures", pairs, MOST_OVERESTIMATION, fewest)
    rough = [pair for pair in pairs if pair.kind == "rough"]
    if rough or fewest_rough:
        yield _coverage_row("rough contacts", rough, MOST_ROUGH, fewest_rough)


def _coverage_row(name: str, pairs: Sequence[Pair], most: float, fewest: int) -> Row:
    shown, stated = coverage(pairs), "the stated uncertainties"
    ratio, count = shown.median_overestimation, shown.informative
    return summary_row(
        *("coverage", name, "both"),
        bounded("share covered", shown.covered, 1.0, stated, LEAST_COVERAGE),
        bounded("median overestimation ratio", ratio, most, stated),
        bounded("informative figures", count, np.inf, "exact answers", fewest),
    )


def observed_order(errors: Sequence[Sequence[float]]) -> float:
    """Mean order from the first to the last level of errors (cases, levels)."""
    square = np.sqrt(np.mean(np.square(errors), axis=0))
    return float(np.log2(square[0] / square[-1]) / (len(square) - 1))


def order_rows(rows: Iterable[Row]) -> Iterator[Row]:
    """Orders of the figures of Hertz's contact and of all pressures, where there are enough."""
    errors: dict[tuple[str, str], list[Sequence[float]]] = {key: [] for key in ORDERS}
    for row in rows:
        for figure in row.figures:
            if figure.quantity == PRESSURE:
                errors[figure.source, PRESSURE].append(figure.levels)
        for pair in pairs_of(row):
            if pair.kind == "Hertz" and (pair.model, pair.quantity) in ORDERS:
                errors[pair.model, pair.quantity].append(pair.errors)
    for (model, quantity), of_contacts in errors.items():
        if len(of_contacts) >= FEWEST_CONTACTS:
            order = observed_order(of_contacts), *ORDERS[model, quantity]
            figure = order_figure("observed order", *order, "the exact contacts")
            name = f"{quantity}, {len(of_contacts)} contacts"
            yield summary_row("order", name, model, figure)
