"""What friction heats a scene's bodies by, as a run keeps it."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np

from comparisons.figures.figure import Figure, Findings, Part, Statement, figures_of
from comparisons.figures.quantity import Quantity
from comparisons.figures.uncertainty import Uncertainty
from comparisons.figures.verdict import Verdict, judge
from comparisons.studies.heat.half_plane_stress import HeatedStress
from comparisons.studies.heat.half_space import HeatedContact

NAME = "heat"
QUANTITIES = {
    "flash_temperature": Quantity("largest rise in the contact", "K"),
    "mean_temperature": Quantity("mean rise, by heat", "K"),
    "fraction_into_body": Quantity("heat that enters the body"),
    "tau1_heated": Quantity("largest τ1 with heat", "Pa"),
    "tau1_depth_heated": Quantity("depth of that τ1", "m"),
    "sx_heated": Quantity("largest σx of the surface with heat", "Pa"),
    "tau1_heated_without_heat": Quantity("the same without", "Pa"),
    "tau1_depth_heated_without_heat": Quantity("the same without", "m"),
    "sx_heated_without_heat": Quantity("the same without", "Pa"),
    "peclet_number": Quantity("Peclet number V a / 2κ"),
}
COMPARED = tuple(QUANTITIES)[:6]  # by both models
HEATED = ("tau1_heated", "tau1_depth_heated", "sx_heated")  # with thermal stresses


@dataclass(frozen=True)
class HeatFigure:
    """A figure of one or both models; all but their `values` and `elastic` relative."""

    quantity: str
    values: dict[str, float]
    own: dict[str, float]  # numerical uncertainty of each model's value
    scale: float  # what all that is relative is relative to [SI]
    # (half-plane - finite elements) / finite elements; None for one model
    difference: float | None = None
    # the part of it that the half-plane finds under the finite elements' pressures
    by_pressure: float | None = None
    # of each feature that the finite elements alone have: what the figure is without it, over what
    # it is with it, less 1 (`value`), and the numerical `uncertainty` of that
    effects: dict[str, dict[str, float]] = field(default_factory=dict)
    uncertainty: float | None = None  # of the difference, numerical
    tolerance: float | None = None
    # of a stress with heat, by model: what it is without
    elastic: dict[str, float] = field(default_factory=dict)

    @property
    def verdict(self) -> Verdict | None:
        """None where nothing is compared."""
        if self.difference is None:
            return None
        return judge(self.difference, self.uncertainty, self.tolerance)


@dataclass(frozen=True)
class HeatStudy:
    """Temperatures of a scene at its largest friction coefficient."""

    friction: float
    peclet: dict[str, float]
    contacts: dict[str, HeatedContact]  # by model, on the finest level
    figures: tuple[HeatFigure, ...]
    # part of the heat into the body, and flash temperature [K], by older rules' one fraction
    rules: dict[str, dict[str, float]]
    contains: dict[str, str]  # what the finite elements alone have, in words
    # by model, on the finest level; empty where thermal stresses are not asked for
    stresses: dict[str, HeatedStress] = field(repr=False)
    x: np.ndarray = field(repr=False)  # (n,) [m]
    z: np.ndarray = field(repr=False)  # (m,) [m]
    field: np.ndarray = field(repr=False)  # (2, m, n) [K] in body and roller, half-planes

    def findings(self) -> Findings:
        """Figures by model, their differences, what older rules say, and in words what the finite
        elements have."""
        at, figures = {"friction": self.friction}, []
        for name, number in self.peclet.items():
            figures += figures_of(NAME, name, {"peclet_number": number}, None, at)
        for each in self.figures:
            places = {model: self._place(each.quantity, model) for model in each.values}
            figures += figures_of_row(each, at, places)
        first = next(iter(self.contacts))
        stated = {
            each.quantity: Uncertainty({"numerical": each.own[first]}) for each in self.figures
        }
        for rule, values in self.rules.items():
            for name, value in values.items():
                figures += figures_of(NAME, rule, {name: value}, stated[name], at)
        said = [Statement("the finite elements have", text, n) for n, text in self.contains.items()]
        return Findings(tuple(figures), statements=tuple(said))

    def _place(self, quantity: str, model: str) -> tuple[float, ...] | None:
        """Where a largest value stands [m]."""
        if quantity == "flash_temperature":
            return (self.contacts[model].figures["flash_position"],)
        if quantity in ("tau1_heated", "sx_heated"):
            values = self.stresses[model].figures
            deep = (values["tau1_depth_heated"],) if quantity == "tau1_heated" else ()
            return (values[f"{quantity.removesuffix('_heated')}_position"], *deep)
        return None


def figures_of_row(
    each: HeatFigure, at: dict[str, float], places: Mapping[str, tuple[float, ...] | None]
) -> Iterator[Figure]:
    """Of one quantity: by each model, with heat and without, and their difference."""
    effects = [Part(name, e["value"], e["uncertainty"]) for name, e in each.effects.items()]
    common = {"study": NAME, "at": at, "scale": each.scale}
    for model, value in each.values.items():
        stated = Uncertainty({"numerical": each.own[model]})
        alone = each.difference is None and model == "finite_element"
        yield Figure(
            quantity=each.quantity,
            source=model,
            value=value,
            uncertainty=stated,
            parts=tuple(effects) if alone else (),
            place=places.get(model),
            **common,
        )
        if model in each.elastic:
            bare = f"{each.quantity}_without_heat"
            cold = each.elastic[model]
            yield Figure(quantity=bare, source=model, value=cold, uncertainty=stated, **common)
    if each.difference is not None:
        if each.by_pressure is not None:
            effects.append(Part("other pressures", each.by_pressure))
        yield Figure(
            quantity=each.quantity,
            source="half_plane",
            value=each.difference,
            against="finite_element",
            uncertainty=Uncertainty(each.own),
            bounds=(-each.tolerance, each.tolerance),
            parts=tuple(effects),
            **common,
        )
