"""Figures with an exact answer: coverage of their stated uncertainties, and orders of convergence.

Of one contact the error varies with where the edge falls between two nodes; the root mean square
over contacts with different numbers of elements falls like a power of the element size."""

from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from functools import cached_property, partial

import numpy as np

from comparisons.campaigns.checks import (
    BoundedFigure,
    CaseFindings,
    CheckedCase,
    CheckedRow,
    CheckedStudy,
    order_figure,
    run_case,
)
from comparisons.figures.uncertainty import COVERAGE, Uncertainty

LEAST_COVERAGE = COVERAGE
# Median of stated uncertainty over true error, of all figures and of rough contacts: with few
# elements to an asperity the first level is not yet of the order that the others show.
MOST_OVERESTIMATION, MOST_ROUGH = 5.0, 15.0
FEWEST, FEWEST_ROUGH = 400, 150  # informative figures, in all and of rough contacts
ROUND_OFF = 1e-10  # relative; the tables of references have as many digits
# Largest relative error of a figure on the third level, three to five times what is met.
CEILINGS = {
    "peak_pressure": 1e-3,
    "contact_length": 5e-3,
    "tau1_max": 1e-2,
    "tau1_max_depth": 5e-2,
    "txz_max_abs": 5e-3,
    "mean_gap": 1e-3,
}
# Times these: rough contacts have fewer elements to a patch; a model error is made of two figures.
ROUGH_FACTOR, MODEL_ERROR_FACTOR = 4.0, 2.0
PARTS = ("iteration", "discretisation", "domain")  # of an uncertainty
FIGURE, MODEL_ERROR = "figure", "model error"  # what a run's two tables are made of
# Expected order and how far the observed one may lie from it, both ways. Hertz's contact: the
# figures of smooth fields have order 2, of the edge's place 1, of the pressure in L2 1, by the
# square root at the edge; of stresses the coarsest level is better than that, for next to the edge
# they are those of a curve and not of hats (1.4 and 1.5 in 24 contacts). Another choice of 18
# contacts was seen to change the orders by up to 0.4.
PRESSURE = "pressure in L2"
ORDERS = {
    ("half_plane", "peak_pressure"): (2.0, 0.5),
    ("half_plane", "contact_length"): (1.0, 0.4),
    ("half_plane", "tau1_max"): (2.0, 0.7),
    ("half_plane", "txz_max_abs"): (2.0, 0.7),
    ("half_plane", PRESSURE): (1.0, 0.15),
    ("finite_element", "peak_pressure"): (2.0, 0.5),
    ("finite_element", "contact_length"): (1.0, 0.5),
    ("finite_element", "txz_max_abs"): (2.0, 0.6),
    ("finite_element", PRESSURE): (1.0, 0.2),
}
# Fields of the pairs by which their coverage is shown.
GROUPS = (("table", "model", "quantity"), ("table", "kind"))
FEWEST_CONTACTS = 16  # for an observed order


@dataclass(frozen=True)
class Pair:
    """One figure of one model against its exact value, or one model error of the half-plane."""

    case: str
    source: str
    kind: str  # of the case: Hertz | surface | sliding | hardness | layer | wave | punch | rough
    model: str
    quantity: str
    levels: tuple[float, ...]  # figures on all levels, coarse to fine [SI]
    exact: float  # [SI]
    # [SI] what errors are relative to: the figure, or the smooth contact's where that vanishes
    scale: float
    uncertainty: Uncertainty  # as stated, relative to `scale`
    converged: bool  # all levels met their contact conditions
    # FIGURE or MODEL_ERROR, whose values are relative to the whole model's figure
    table: str = FIGURE

    @property
    def errors(self) -> list[float]:
        """True errors of all levels, relative, with their signs."""
        return [(value - self.exact) / self.scale for value in self.levels]

    @property
    def error(self) -> float:
        """The same of the finest level."""
        return self.errors[-1]

    @property
    def informative(self) -> bool:
        """Whether the error is more than rounding, which any uncertainty would cover."""
        return bool(abs(self.error) > ROUND_OFF)

    @property
    def covered(self) -> bool:
        return bool(abs(self.error) <= max(self.uncertainty.total, ROUND_OFF))

    @property
    def overestimation(self) -> float | None:
        """Stated uncertainty over true error; None where the error is rounding."""
        return self.uncertainty.total / abs(self.error) if self.informative else None

    @property
    def figure(self) -> BoundedFigure:
        """Its error, infinite if not converged, below a ceiling, whatever uncertainty is stated."""
        ceiling = CEILINGS[self.quantity]
        if self.kind == "rough":
            ceiling *= ROUGH_FACTOR
        if self.table == MODEL_ERROR:
            ceiling *= MODEL_ERROR_FACTOR
        ratio = "rounding" if self.overestimation is None else f"{self.overestimation:.3g}"
        note = (
            f"value {self.levels[-1]:.12g}, exact {self.exact:.12g}, relative error "
            f"{self.error:.3e}, stated uncertainty {self.uncertainty.total:.3e}, "
            f"{'covered' if self.covered else 'NOT covered'}, overestimation ratio {ratio}, "
            + (self.uncertainty.convergence.behaviour if self.converged else "not converged")
        )
        error = abs(self.error) if self.converged else np.inf
        name = self.quantity if self.table == FIGURE else f"{self.table}, {self.quantity}"
        return BoundedFigure(name, error, ceiling, self.source, note=note)

    def as_dict(self) -> dict:
        stated = self.uncertainty
        return asdict(self) | {
            "error": self.error,
            "uncertainty": {name: stated.parts[name] for name in PARTS} | {"total": stated.total},
            "covered": self.covered,
            "overestimation_ratio": self.overestimation,
            "behaviour": stated.convergence.behaviour,
            "order": stated.convergence.order,
            "close": self.figure.holds,
        }


@dataclass(frozen=True)
class ExactFindings(CaseFindings):
    """CaseFindings of a case with an exact answer."""

    pairs: tuple[Pair, ...] = ()
    # relative L2 errors of the pressures on all levels, where these are known
    pressure_errors: tuple[float, ...] | None = None

    @classmethod
    def of(
        cls, pairs: Sequence[Pair], pressure_errors: tuple[float, ...] | None = None
    ) -> "ExactFindings":
        figures = tuple(pair.figure for pair in pairs)
        return cls(figures, pairs=tuple(pairs), pressure_errors=pressure_errors)


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


def coverage_cases(
    pairs: Iterable[Pair], fewest: int = FEWEST, fewest_rough: int = FEWEST_ROUGH
) -> list[CheckedCase]:
    """Enough informative figures, covered often enough, by uncertainties that are not too large:
    of all contacts, and of the rough ones."""
    pairs = list(pairs)
    groups = [("all figures", pairs, MOST_OVERESTIMATION, fewest)]
    rough = [pair for pair in pairs if pair.kind == "rough"]
    if rough or fewest_rough:
        groups.append(("rough contacts", rough, MOST_ROUGH, fewest_rough))
    return [
        CheckedCase("coverage", name, "both", partial(_covered, coverage(group), most, least))
        for name, group, most, least in groups
    ]


def _covered(found: Coverage, most: float, fewest: int) -> CaseFindings:
    ratio, uncertainties = found.median_overestimation, "the stated uncertainties"
    return CaseFindings(
        (
            BoundedFigure("share covered", found.covered, 1.0, uncertainties, LEAST_COVERAGE),
            BoundedFigure("median overestimation ratio", ratio, most, uncertainties),
            BoundedFigure(
                "informative figures", found.informative, np.inf, "exact answers", fewest
            ),
        )
    )


def observed_order(errors: Sequence[Sequence[float]]) -> float:
    """Mean order from the first to the last level of errors (cases, levels)."""
    square = np.sqrt(np.mean(np.square(errors), axis=0))
    return float(np.log2(square[0] / square[-1]) / (len(square) - 1))


def order_cases(rows: Iterable[CheckedRow]) -> list[CheckedCase]:
    """Orders of the figures of Hertz's contact and of all pressures, where there are enough."""
    errors: dict[tuple[str, str], list[Sequence[float]]] = {key: [] for key in ORDERS}
    for row in rows:
        if not isinstance(row.findings, ExactFindings):
            continue
        if row.findings.pressure_errors:
            errors[row.case.model, PRESSURE].append(row.findings.pressure_errors)
        for pair in row.findings.pairs:
            if pair.kind == "Hertz" and (pair.model, pair.quantity) in ORDERS:
                errors[pair.model, pair.quantity].append(pair.errors)
    cases = []
    for (model, name), found in errors.items():
        if len(found) >= FEWEST_CONTACTS:
            order = observed_order(found), *ORDERS[model, name]
            figures = (order_figure("observed order", *order, "the exact contacts"),)
            words = f"{name}, {len(found)} contacts"
            cases.append(CheckedCase("order", words, model, partial(CaseFindings, figures)))
    return cases


@dataclass(frozen=True)
class Verification(CheckedStudy):
    """The rows of `verify`, with the pairs of stated uncertainty and true error among them."""

    @cached_property
    def pairs(self) -> tuple[Pair, ...]:
        found = (row.findings for row in self.rows)
        return tuple(p for each in found if isinstance(each, ExactFindings) for p in each.pairs)

    @cached_property
    def coverage(self) -> Coverage:
        return coverage(self.pairs)

    def groups(self, *names: str) -> dict[tuple[str, ...], Coverage]:
        """Coverage by the named fields of the pairs, in order of appearance."""
        named: dict[tuple[str, ...], list[Pair]] = {}
        for pair in self.pairs:
            named.setdefault(tuple(getattr(pair, name) for name in names), []).append(pair)
        return {group: coverage(pairs) for group, pairs in named.items()}

    def as_dict(self) -> dict:
        return super().as_dict() | {
            "coverage": asdict(self.coverage),
            "groups": [
                {**dict(zip(names, group, strict=True)), **asdict(found)}
                for names in GROUPS
                for group, found in self.groups(*names).items()
            ],
            "pairs": [pair.as_dict() for pair in self.pairs],
        }


def verification(
    rows: tuple[CheckedRow, ...], seconds: float, fewest: int, fewest_rough: int
) -> Verification:
    """All rows, with those of the coverage by the stated uncertainties."""
    pairs = Verification("verify", rows, seconds).pairs
    covered = (run_case(case) for case in coverage_cases(pairs, fewest, fewest_rough))
    return Verification("verify", (*rows, *covered), seconds)
