"""What friction heats a scene's bodies by, as a run keeps it."""

from dataclasses import asdict, dataclass, field

import numpy as np

from comparisons.figures.verdict import Verdict
from comparisons.models.heat import HeatedContact
from comparisons.models.thermal_stress import HeatedStress

# of all but temperatures
UNITS = {"fraction_into_body": "", "tau1_heated": "Pa", "tau1_depth_heated": "m", "sx_heated": "Pa"}
HEATED = tuple(UNITS)[1:]  # with thermal stresses


@dataclass(frozen=True)
class HeatFigure:
    """A figure of one or both models; all but their `values` and `elastic` relative."""

    quantity: str
    values: dict[str, float]
    own: dict[str, float]  # numerical uncertainty of each model's value
    # (half-plane - finite elements) / finite elements; None for one model
    difference: float | None = None
    # the part of it that the half-plane finds under the finite elements' pressures
    by_pressure: float | None = None
    # of each feature that the finite elements alone have: what the figure is without it, over what
    # it is with it, less 1 (`value`), and the numerical `uncertainty` of that
    effects: dict[str, dict[str, float]] = field(default_factory=dict)
    uncertainty: float | None = None  # of the difference, numerical
    tolerance: float | None = None
    verdict: Verdict | None = None
    # of a stress with heat, by model: what it is without
    elastic: dict[str, float] = field(default_factory=dict)


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

    def as_dict(self) -> dict:
        """For JSON."""
        return {
            "friction": self.friction,
            "peclet": self.peclet,
            "models": {name: each.figures for name, each in self.contacts.items()},
            "figures": {figure.quantity: asdict(figure) for figure in self.figures},
            "rules": self.rules,
            "stresses": {
                n: {"heated": s.figures, "elastic": s.elastic} for n, s in self.stresses.items()
            },
            "contains": list(self.contains.values()),
        }
