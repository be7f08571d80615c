"""One measure for every code: how well its pressures meet its own discrete contact conditions.

Only a code's pressures are used. Their displacement is computed anew, by the exact operator of the
code's discretisation and by other formulas than those of `analytic`, so that the measure does not
rest on the code that is measured. The approach is the mean of g0 + u weighted by the pressure.

    point  periodic line: every wave k of the grid sinks by p/(pi k)
    strip  uniform over a pitch, displacement at its middle
    hat    linear between nodes, displacement averaged over a hat

On a periodic line the elements see every wave with its aliases k + j n. On a free one the kernel is
-(2/pi) ln|x|, integrated over the element by Gauss quadrature, next to it in closed form. Line of
unit length, E* = 1. The constant of the displacement is arbitrary.
"""

from dataclasses import astuple, dataclass
from functools import lru_cache

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft

from comparisons.benchmarks.half_plane_peers.cases import REFINED, LineCase

TOLERANCE = 1e-8
_ALIASES = 60  # summed one by one; the others by their integral, or half their first
_GAUSS = 24  # points in each pitch: 1e-16 from a pitch's distance on
_NEAR = 4  # pitches within which the logarithm is integrated in closed form


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
    """Of pressures (n,) [Pa] by a code with `element` "hat", "strip" or "point"."""
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
    if periodic:
        return irfft(rfft(pressure) * _symbol(count, element), count)
    length = next_fast_len(2 * count, real=True)
    return irfft(rfft(pressure, length) * _transfer(count, length, element), length)[:count]


@lru_cache(maxsize=6)
def _symbol(count: int, element: str) -> np.ndarray:
    """Eigenvalues of the periodic line's circulant, 0 for the mean."""
    cycles = np.arange(1, count // 2 + 1) / count
    seen = {"hat": _hat_aliases, "strip": _strip_aliases, "point": np.reciprocal}[element](cycles)
    return np.concatenate(([0.0], seen / (np.pi * count)))


def _hat_aliases(cycles: np.ndarray) -> np.ndarray:
    """sum over j of sinc^4(c + j)/|c + j|; the tail by the midpoint rule and its correction."""
    total = sum(np.abs(cycles + j) ** -5.0 for j in range(_ALIASES, -_ALIASES - 1, -1))
    for edge in (_ALIASES + 0.5 + cycles, _ALIASES + 0.5 - cycles):
        total += edge**-4.0 / 4.0 - 5.0 * edge**-6.0 / 24.0
    return (np.sin(np.pi * cycles) / np.pi) ** 4 * total


def _strip_aliases(cycles: np.ndarray) -> np.ndarray:
    """sum over j of sinc(c + j)/|c + j|: signs alternate, the tail is Boole's summation."""
    total = np.zeros_like(cycles)
    for j in range(_ALIASES - 1, -_ALIASES, -1):
        total += (-1.0) ** j / ((cycles + j) * np.abs(cycles + j))
    for first, sign in ((_ALIASES + cycles, 1.0), (_ALIASES - cycles, -1.0)):
        tail = 0.5 * first**-2.0 + 0.5 * first**-3.0 - 0.5 * first**-5.0 + 1.5 * first**-7.0
        total += sign * (-1.0) ** _ALIASES * tail
    return np.sin(np.pi * cycles) / np.pi * total


@lru_cache(maxsize=6)
def _transfer(count: int, length: int, element: str) -> np.ndarray:
    """Transform of the circulant that holds the free line's Toeplitz matrix."""
    distance = np.arange(count, dtype=float)
    order, shape = {"hat": (4, _cubic_spline), "strip": (1, np.ones_like)}[element]
    pieces = np.arange(-order / 2, order / 2)
    point, weight = np.polynomial.legendre.leggauss(_GAUSS)
    column = np.zeros(count)
    for place in pieces[:, None] + 0.5 * (1.0 + point):
        for t, share in zip(place, 0.5 * weight * shape(place), strict=True):
            column += share * np.log(np.abs(distance - t))
    near = distance[:_NEAR, None] + np.arange(-order / 2, order / 2 + 1)
    differences = {4: (1, -4, 6, -4, 1), 1: (-1, 1)}[order]
    column[:_NEAR] = _log_integral(near, order) @ np.array(differences)
    circulant = np.zeros(length)
    circulant[:count] = column
    circulant[length - count + 1 :] = column[:0:-1]
    return rfft(circulant) * (-2.0 / (np.pi * count))


def _cubic_spline(t: np.ndarray) -> np.ndarray:
    """Two hats convolved."""
    t = np.abs(t)
    return np.where(t < 1.0, 2.0 / 3.0 - t**2 + 0.5 * t**3, (2.0 - t) ** 3 / 6.0)


def _log_integral(x: np.ndarray, order: int) -> np.ndarray:
    """ln|x| integrated `order` times, 1 or 4, but for a polynomial that differences do not see."""
    log = np.log(np.abs(np.where(x == 0.0, 1.0, x)))
    return x * (log - 1.0) if order == 1 else x**4 * (log - 25.0 / 12.0) / 24.0
