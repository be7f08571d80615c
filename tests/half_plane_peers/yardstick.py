"""One measure for every code: how well its pressures meet its own discrete contact conditions.

Only a code's pressures are used. Their displacement is computed anew, by the operator of the code's
discretisation. The approach is the mean of g0 + u weighted by the pressure.

    point  periodic line: every wave k of the grid sinks by p/(pi k)
    strip  uniform over a pitch, displacement at its middle
    hat    linear between nodes, displacement averaged over a hat

Line of unit length, E* = 1. The constant of the displacement is arbitrary.
"""

from dataclasses import astuple, dataclass
from functools import lru_cache

import numpy as np
from scipy.fft import irfft, rfft
from strips import PeriodicStrips, StripHalfPlane

from analytic.operators.half_plane import HalfPlane, ModelOperator
from analytic.operators.periodic import PeriodicHalfPlane
from tests.half_plane_peers.cases import REFINED, LineCase

TOLERANCE = 1e-8


@dataclass(frozen=True)
class ContactResiduals:
    """Residuals of the contact conditions, dimensionless, zero when exact, and the error.

    load_balance       |sum h p - P| / P
    complementarity    sum h p |g| / (P times the range of the displacements)
    penetration        largest overlap / the range of the displacements
    negative_pressure  largest tension / the largest pressure
    error              relative L2 norm of the pressures' difference from the reference
    """

    load_balance: float
    complementarity: float
    penetration: float
    negative_pressure: float
    error: float

    @property
    def worst(self) -> float:
        return max(astuple(self)[:-1])


def measure(case: LineCase, pressure: np.ndarray, element: str) -> ContactResiduals:
    """Residuals of pressures (n,) [Pa] by a code with `element` "hat", "strip" or "point"."""
    if not np.all(np.isfinite(pressure)) or np.max(pressure) <= 0.0:
        return ContactResiduals(*[np.inf] * 5)
    initial = {"hat": case.hat_averages, "strip": case.gaps, "point": -case.heights}[element]
    periodic = case.periodic or element == "point"
    moved = displacements(pressure, element, periodic)
    gap = initial + moved
    gap = gap - pressure @ gap / np.sum(pressure)
    scale = np.ptp(moved)
    load = case.pitch * np.sum(pressure)
    fine = np.arange(REFINED * case.count) / REFINED
    drawn = np.interp(fine, np.arange(case.count + 1), np.append(pressure, pressure[0]))
    return ContactResiduals(
        load_balance=abs(load / case.load - 1.0),
        complementarity=case.pitch * np.sum(np.abs(pressure * gap)) / (case.load * scale),
        penetration=max(0.0, -np.min(gap)) / scale,
        negative_pressure=max(0.0, -np.min(pressure)) / np.max(pressure),
        error=float(np.linalg.norm(drawn - case.expected) / np.linalg.norm(case.expected)),
    )


def displacements(pressure: np.ndarray, element: str, periodic: bool) -> np.ndarray:
    """u (n,) [m] at the nodes, or averaged over hats, of pressures (n,) [Pa]."""
    count = len(pressure)
    if element != "point":
        return count * operator_of(count, element, periodic).apply(pressure)
    symbol = np.append(0.0, 1.0 / (np.pi * np.arange(1, count // 2 + 1)))
    return irfft(rfft(pressure) * symbol, count)


@lru_cache(maxsize=6)
def operator_of(count: int, element: str, periodic: bool) -> ModelOperator:
    """Operator of a line of unit length, E* = 1."""
    hats, strips = (PeriodicHalfPlane, PeriodicStrips) if periodic else (HalfPlane, StripHalfPlane)
    return (hats if element == "hat" else strips)(count, 1.0 / count, 1.0)
