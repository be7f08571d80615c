"""What friction heats a scene's bodies by, as a run keeps it."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np

from comparisons.figures.figure import Figure, Part
from comparisons.figures.quantity import MODELS, Quantity
from comparisons.figures.uncertainty import Uncertainty
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
WITHOUT = "_without_heat"
HEATED = ("tau1_heated", "tau1_depth_heated", "sx_heated")  # with thermal stresses


OTHER_PRESSURES = "other pressures"  # the part of a difference that these make


@dataclass(frozen=True)
class HeatRow:
    """A quantity by one or both models, from which its figures follow; all but `values`, `cold` and
    `places` relative."""

    quantity: str
    values: Mapping[str, float]
    own: Mapping[str, float]  # numerical uncertainty of each model's value
    scale: float  # what all that is relative is relative to [SI]
    # (half-plane - finite elements) / finite elements; None for one model
    difference: float | None = None
    # by the half-plane under the finite elements' pressures; of each feature that the finite
    # elements alone have, what the figure is without it, over what it is with it, less 1
    parts: tuple[Part, ...] = ()
    tolerance: float | None = None
    cold: Mapping[str, float] = field(default_factory=dict)  # of a stress, what it is without heat
    places: Mapping[str, tuple[float, ...]] = field(default_factory=dict)  # by model [m]

    def figures(self, friction: float) -> Iterator[Figure]:
        """By each model, with heat and without, and their difference."""
        common = {"study": NAME, "at": {"friction": friction}, "scale": self.scale}
        for model, value in self.values.items():
            stated = Uncertainty({"numerical": self.own[model]})
            yield Figure(
                quantity=self.quantity,
                source=model,
                value=value,
                uncertainty=stated,
                parts=self.parts if self.difference is None and model == MODELS[1] else (),
                place=self.places.get(model),
                **common,
            )
            if model in self.cold:
                bare, alone = f"{self.quantity}{WITHOUT}", self.cold[model]
                yield Figure(quantity=bare, source=model, value=alone, uncertainty=stated, **common)
        if self.difference is not None:
            yield Figure(
                quantity=self.quantity,
                source="half_plane",
                value=self.difference,
                against="finite_element",
                uncertainty=Uncertainty(self.own),
                bounds=(-self.tolerance, self.tolerance),
                parts=self.parts,
                **common,
            )


def place_of(quantity: str, values: Mapping[str, float]) -> tuple[float, ...] | None:
    """Where a largest value stands [m], by a model's figures."""
    if quantity == "flash_temperature":
        return (values["flash_position"],)
    if quantity in ("tau1_heated", "sx_heated"):
        deep = (values["tau1_depth_heated"],) if quantity == "tau1_heated" else ()
        return (values[f"{quantity.removesuffix('_heated')}_position"], *deep)
    return None


@dataclass(frozen=True)
class HeatStudy:
    """Temperatures of a scene at its largest friction coefficient, for pictures and files."""

    contacts: dict[str, HeatedContact]  # by model, on the finest level
    contains: dict[str, str]  # what the finite elements alone have, in words
    # by model, on the finest level; empty where thermal stresses are not asked for
    stresses: dict[str, HeatedStress] = field(repr=False)
    x: np.ndarray = field(repr=False)  # (n,) [m]
    z: np.ndarray = field(repr=False)  # (m,) [m]
    field: np.ndarray = field(repr=False)  # (2, m, n) [K] in body and roller, half-planes
