"""One measure for every code: how well its pressures meet its own discrete contact conditions.

No code's figures are used but the pressures. Their displacement is computed anew, by the exact
operator of the discretisation that the code declares (`peers_operators`), and the approach is the
mean of g0 + u that the pressures weigh. The error is that of the pressures drawn straight from
node to node, whatever the code's elements.
"""

from dataclasses import dataclass

import numpy as np

from comparisons.benchmarks.half_plane_peers.cases import REFINED, Case
from comparisons.benchmarks.half_plane_peers.operators import displacements

TOLERANCE = 1e-8


@dataclass(frozen=True)
class Measure:
    """Contact conditions of one solution, dimensionless, zero when exact; `error` beside them.

    load_balance       |sum h p - P| / P
    complementarity    sum h p |g| / (P times the range of the displacements)
    penetration        largest overlap / the range of the displacements
    negative_pressure  largest tension / the largest pressure
    error              relative L2 norm of the pressures' difference from the expected ones
    """

    load_balance: float
    complementarity: float
    penetration: float
    negative_pressure: float
    error: float

    @property
    def worst(self) -> float:
        return max(
            self.load_balance, self.complementarity, self.penetration, self.negative_pressure
        )


def measure(case: Case, pressure: np.ndarray, element: str) -> Measure:
    """Of pressures (n,) [Pa] by a code with `element` "hat", "strip" or "point"."""
    if not np.all(np.isfinite(pressure)) or np.max(pressure) <= 0.0:
        return Measure(np.inf, np.inf, np.inf, np.inf, np.inf)
    initial = {"hat": case.averages, "strip": case.gaps, "point": -case.heights}[element]
    closed = case.periodic or element == "point"
    moved = displacements(pressure, element, closed)
    gap = initial + moved
    gap = gap - pressure @ gap / np.sum(pressure)
    scale = np.ptp(moved)
    load = case.pitch * np.sum(pressure)
    fine = np.arange(REFINED * case.count) / REFINED
    drawn = np.interp(fine, np.arange(case.count + 1), np.append(pressure, pressure[0]))
    return Measure(
        load_balance=abs(load / case.load - 1.0),
        complementarity=case.pitch * np.sum(np.abs(pressure * gap)) / (case.load * scale),
        penetration=max(0.0, -np.min(gap)) / scale,
        negative_pressure=max(0.0, -np.min(pressure)) / np.max(pressure),
        error=float(np.linalg.norm(drawn - case.expected) / np.linalg.norm(case.expected)),
    )
