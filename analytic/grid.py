"""The grid of pressure hats under a roller, and the initial gap averaged over them."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Literal

import numpy as np

GAUSS_POINTS, GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(4)

# Part of the radius beyond which a circle continues as a straight line of slope 2.
STEEPEST = 2.0 / np.sqrt(5.0)


@dataclass(frozen=True)
class HatGrid:
    """Hats at x_i = i * pitch for first <= i <= last, whole numbers: grids of halved pitch nest.
    pitch [m]; `x` (n,) [m]; `weights` (n,) [m], the area under each hat of height 1. On a
    `periodic` line the hat after the last is the first."""

    pitch: float
    first: int
    last: int
    periodic: bool = False

    @classmethod
    def within(cls, start: float, stop: float, pitch: float) -> "HatGrid":
        """Largest grid whose hats, with their feet, lie in start <= x <= stop [m]."""
        slack = 1e-9  # of a pitch: an end that is a multiple but for round-off counts as one
        first = int(np.ceil(start / pitch - slack)) + 1
        last = int(np.floor(stop / pitch + slack)) - 1
        if last - first < 2:
            raise ValueError(
                f"{stop - start:g} m hold fewer than three pressure elements of {pitch:g} m"
            )
        return cls(pitch, first, last)

    @classmethod
    def around(cls, period: float, count: int) -> "HatGrid":
        """`count` hats, an even number, on a periodic line, from -period/2 [m] on."""
        return cls(period / count, -(count // 2), count // 2 - 1, periodic=True)

    @property
    def count(self) -> int:
        return self.last - self.first + 1

    @property
    def period(self) -> float:
        """[m] of a periodic line."""
        return self.count * self.pitch

    @property
    def hats(self) -> np.ndarray:
        """Nodes [m] with the feet of the outer two hats (n + 2,); of a periodic line (n + 1,), the
        last the first."""
        x = self.x
        before = [] if self.periodic else [x[0] - self.pitch]
        return np.concatenate([before, x, [x[-1] + self.pitch]])

    def unfolded(self, values: np.ndarray) -> np.ndarray:
        """Values (n,) as they stand on three periods (3n,); those on a free line as they are."""
        return np.tile(values, 3) if self.periodic else values

    @property
    def unfolded_x(self) -> np.ndarray:
        """Positions [m] of `unfolded`: the grid's own in the middle."""
        beside = self.count if self.periodic else 0
        return np.arange(self.first - beside, self.last + beside + 1) * self.pitch

    @property
    def x(self) -> np.ndarray:
        return np.arange(self.first, self.last + 1) * self.pitch

    @property
    def weights(self) -> np.ndarray:
        return np.full(self.count, self.pitch)

    def hat_integrals(
        self, function: Callable[[np.ndarray], np.ndarray], knots: np.ndarray | None = None
    ) -> np.ndarray:
        """Integrals of phi_i f dx (n,), exact for polynomials f of degree 6 between `knots`."""
        nodes = np.arange(self.first - 1, self.last + 2) * self.pitch
        breaks = nodes
        if knots is not None:
            inside = knots[(knots > nodes[0]) & (knots < nodes[-1])]
            breaks = np.union1d(nodes, inside)
        width, pitch = np.diff(breaks), np.diff(nodes)
        middle = 0.5 * (breaks[1:] + breaks[:-1])
        cell = np.clip(np.searchsorted(nodes, middle) - 1, 0, len(pitch) - 1)
        total = np.zeros(len(nodes))
        for point, weight in zip(GAUSS_POINTS, GAUSS_WEIGHTS, strict=True):
            place = middle + 0.5 * point * width
            value = 0.5 * weight * width * function(place)
            share = (place - nodes[cell]) / pitch[cell]
            total += np.bincount(cell, (1.0 - share) * value, minlength=len(nodes))
            total += np.bincount(cell + 1, share * value, minlength=len(nodes))
        return total[1:-1]


def roller_gap(
    radius: float,
    height: Callable[[np.ndarray], np.ndarray] | None = None,
    shape: Literal["parabola", "circle"] = "parabola",
) -> Callable[[np.ndarray], np.ndarray]:
    """Initial gap g0(x) [m] of a roller over heights z(x) [m]; flat if None.

    shape  x^2 / 2R, or R - sqrt(R^2 - x^2), straight on beyond |x| = STEEPEST R

    The constant of the gap is arbitrary: the approach absorbs it. The result can be pickled where
    `height` can."""
    return partial(_roller_gap, radius, height, shape)


def _roller_gap(
    radius: float, height: Callable[[np.ndarray], np.ndarray] | None, shape: str, x: np.ndarray
) -> np.ndarray:
    sagitta = x**2 / (2.0 * radius)
    if shape == "circle":
        inside = np.clip(x, -STEEPEST * radius, STEEPEST * radius)
        below = np.sqrt(radius**2 - inside**2)
        # without the difference of nearly equal numbers
        sagitta = inside**2 / (radius + below) + inside / below * (x - inside)
    return sagitta if height is None else sagitta - height(x)


def restricted(values: np.ndarray, periodic: bool) -> np.ndarray:
    """Integrals over the coarse hats (n // 2,) from those over the fine ones (n,)."""
    half, odd = divmod(len(values), 2)
    coarse = values[1::2] + 0.5 * values[0 : 2 * half : 2]
    coarse[:-1] += 0.5 * values[2 : 2 * half : 2]
    # an even count leaves the last coarse hat half a fine one short: a copy stands for it
    coarse[-1] += 0.5 * (values[-1] if odd or not periodic else values[0])
    return coarse
