"""The exact stress around kinks in a traction, which polynomials cannot follow.

A piecewise-linear pressure has a kink at every node, near which the stress varies as w ln w, with
an unbounded second derivative. The fields here have such a kink and no other load nearby, so that a
displacement minus these fields is smooth: its stresses can be recovered (`fem.stress.recovery`) and
interpolated (`fem.stress.stress`). Weights limit each kink to the elements around it.

Nomenclature
    w            point relative to the kink, along the surface + i times into the body [m]
    f            jump of the slope of s_nn - i s_nt [Pa/m] along the surface
    L, I         w ln w and its integral w^2 (ln w - 1/2) / 2; both vanish at the kink
    s_tt, s_nn, s_nt   stresses along the surface, across it, shear
    G, nu        shear modulus [Pa], Poisson's ratio

Traction on the boundary s_nn - i s_nt = f max(0, -w); with potentials Phi = i f L / (2 pi) and
Psi = -Phi - w Phi' + i conj(f) L / (2 pi) in Muskhelishvili's equations (Some Basic Problems of
the Mathematical Theory of Elasticity, 1953, section 32)

    s_tt + s_nn = -2/pi Im(f L)
    s_nn - s_tt + 2 i s_nt = 2/pi (Im(w) f (ln w + 1) + Im(f) L)
    2 G u = (i f ((3 - 4 nu) I + conj(I)) - 2 Im(w) conj(f L)) / (2 pi)
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from fem.solver.compilation import c_function

# Reach of the weights in root mean square radii of a patch or an element. At 5 the errors in the
# first layers of elements are within a fifth of those with unlimited reach.
REACH = 5.0
SOURCE = Path(__file__).with_suffix(".c")  # of the sums: in numpy they took five times as long


@dataclass(frozen=True)
class Weights:
    """Weights of the kinks near n patches, each a run of neighbouring kinks."""

    first: np.ndarray  # (n,) number of a patch's first kink
    start: np.ndarray  # (n + 1,) where in `value` the weights of a patch begin
    value: np.ndarray

    @property
    def count(self) -> np.ndarray:
        """Number (n,) of the kinks near each patch."""
        return np.diff(self.start)


@dataclass(frozen=True)
class Kinks:
    """Points in ascending x (k,) as x + i z [m], unit tangents towards +x, jumps f [Pa/m]: (k,), or
    (k, c) for c loads at once, whose sums have a further axis before the components."""

    place: np.ndarray
    tangent: np.ndarray
    jump: np.ndarray

    def weights(self, centre: np.ndarray, radius: np.ndarray, seen: np.ndarray) -> Weights:
        """Weights for patches around `centre` (n, 2) [m] of a `radius` (n,) [m]. `seen` (n,) marks
        the patches that kinks can reach: those of the material at the surface.

        They reach no farther than the first kink from the last one. From farther away they are one
        force, whose stress is smooth on elements that grow with the distance. On a rough surface
        each kink has its own tangent, as if the surface went on along it: the fields cancel nearby,
        their sum grows with the distance, and coarse elements do not follow it."""
        x, centre = self.place.real, centre[:, 0] + 1j * centre[:, 1]
        width = np.sum(x[-1:] - x[:1])  # 0 without kinks
        reach = np.minimum(REACH * radius, width) * seen
        below = np.maximum(0.0, centre.imag - self.place.imag.max(initial=-np.inf))
        across = np.sqrt(np.maximum(0.0, reach**2 - below**2))
        first = np.searchsorted(x, centre.real - across)
        count = np.searchsorted(x, centre.real + across) - first
        row, place = runs(count)
        kink = first[row] + place
        distance = np.abs(centre[row] - self.place[kink]) / reach[row]
        weight = np.maximum(0.0, 1.0 - distance**4) ** 2
        return Weights(first, np.concatenate([[0], np.cumsum(count)]), weight)

    def stress(
        self, weights: Weights, patch: np.ndarray, place: np.ndarray, point: np.ndarray
    ) -> np.ndarray:
        """sx, sz, txz (r, q, …, 3) [Pa] of the kinks, weighted as for each `patch`. patch (r,) rows
        of the weights, place (n, 2) [m], point (r, q) numbers of places."""
        return self._weighted(3, 0.0, weights, patch, place, point)

    def displacement(
        self, weights: Weights, patch: np.ndarray, place: np.ndarray, point: np.ndarray, nu: float
    ) -> np.ndarray:
        """G (u_x, u_z) (r, q, …, 2) [N/m] of the kinks, with other arguments as of `stress`."""
        return self._weighted(2, nu, weights, patch, place, point)

    def _weighted(
        self,
        columns: int,
        nu: float,
        weights: Weights,
        patch: np.ndarray,
        place: np.ndarray,
        point: np.ndarray,
    ) -> np.ndarray:
        """Sums (r, q, …, columns) over the kinks of their stress (3) or displacement (2)."""
        near, single = np.flatnonzero(weights.count[patch]), (*self.jump.shape[1:], columns)
        total, count = np.zeros((*point.shape, *single)), len(near) * point.shape[1]
        if count:
            sums = np.zeros((len(near), *total.shape[1:]))
            sizes = len(near), point.shape[1], len(place), self.jump[0].size, columns, nu
            of_rows = patch[near], point[near], place, weights.first, weights.start, weights.value
            begin, order = np.zeros(len(place) + 1, dtype=np.int64), np.empty(count, dtype=np.int64)
            room = begin, order, np.empty((len(self.place), *single)), sums
            kinks = (
                array.astype(complex).view(float) for array in (self.place, self.tangent, self.jump)
            )
            c_function(SOURCE, "add_up")(*sizes, *of_rows, *kinks, *room)
            total[near] = sums
        return total


def runs(count: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Run of each entry, and its number within the run, for runs of lengths `count` (n,)."""
    row = np.repeat(np.arange(len(count)), count)
    return row, np.arange(len(row)) - (np.cumsum(count) - count)[row]
