"""What is read of the passes on one level of refinement, of either kind."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Passes:
    """What is read of the passes (m,)."""

    flow: np.ndarray  # largest equivalent plastic strain that a pass adds, to and fro
    net: np.ndarray  # largest equivalent of the change of plastic strain by a pass
    # energies of a pass as of `fem.nonlinear.energy` [J/m]; of an endless body over the length
    # travelled [J/m^2]
    work: np.ndarray
    stored: np.ndarray
    plastic_work: np.ndarray
    flowed: np.ndarray
    residual: np.ndarray  # [Pa] largest compression sx without the roller, negative
    residual_depth: np.ndarray  # [m]
    peak: np.ndarray  # [Pa] largest pressure, mean over neighbouring hats
    length: np.ndarray  # [m] in contact

    @staticmethod
    def of(rows: Sequence[dict[str, float]]) -> "Passes":
        return Passes(**{name: np.array([row[name] for row in rows]) for name in rows[0]})

    @property
    def balance(self) -> np.ndarray:
        """Work less what flow took and what is stored, over the plastic work of the first pass."""
        return (self.work - self.stored - self.plastic_work) / (self.plastic_work[0] or 1.0)


@dataclass(frozen=True)
class CycledLevel:
    """The passes on one level."""

    pitch: float  # of the pressure elements [m]
    unknowns: int
    seconds: float  # of the processor
    passes: Passes
    x: np.ndarray  # (n,) [m] of the pressure elements
    pressure: np.ndarray  # (2, n) [Pa] in the first pass and in the last
    # (2, n) [m] mean displacements into the body that the first pass leaves and all; 0 of an
    # endless body
    lowering: np.ndarray
    height: np.ndarray  # (n,) [m] mean heights before
    z: np.ndarray  # (j,) [m] depths of the profile
    profile: np.ndarray  # (2, j, 2) [Pa] sx and sy there, after the first pass and after all
    # p0/k that the residual stresses left carry without flow, of an endless body; else nan
    carried: float = np.nan
