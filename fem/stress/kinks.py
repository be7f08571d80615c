"""The exact stress around kinks in a traction, which polynomials cannot follow.

A piecewise-linear pressure has a kink at every node, near which the stress varies as w ln w, with
an unbounded second derivative. The fields here have such a kink and no other load nearby, so that a
displacement minus these fields is smooth: its stresses can be recovered (`fem.stress.recovery`) and
interpolated (`fem.stress.stress`). Weights limit each kink to the elements around it.

Nomenclature
    w            place relative to the kink, along the surface + i times into the body [m]
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

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

# Reach of the weights in root mean square radii of a patch or an element. At 5 the errors in the
# first layers of elements are within a fifth of those with unlimited reach.
REACH = 5.0
PAIRS = 2**17  # of patches and kinks summed at once, within the processor's cache

Field = Callable[[np.ndarray, np.ndarray], list[np.ndarray]]


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
    """Places in ascending x (k,) as x + i z [m], unit tangents towards +x, jumps f [Pa/m]: (k,), or
    (k, c) for c loads at once, whose sums have a further axis before the components."""

    place: np.ndarray
    tangent: np.ndarray
    jump: np.ndarray

    def weights(self, centre: np.ndarray, radius: np.ndarray, seen: np.ndarray) -> Weights:
        """Weights for patches around `centre` (n, 2) [m] of a `radius` (n,) [m]. `seen` (n,) marks
        the patches that kinks can reach: those of the material at the surface."""
        centre, reach = centre[:, 0] + 1j * centre[:, 1], REACH * radius * seen
        below = np.maximum(0.0, centre.imag - self.place.imag.max(initial=-np.inf))
        across = np.sqrt(np.maximum(0.0, reach**2 - below**2))
        first = np.searchsorted(self.place.real, centre.real - across)
        count = np.searchsorted(self.place.real, centre.real + across) - first
        row, place = runs(count)
        kink = first[row] + place
        distance = np.abs(centre[row] - self.place[kink]) / reach[row]
        weight = np.maximum(0.0, 1.0 - distance**4) ** 2
        return Weights(first, np.concatenate([[0], np.cumsum(count)]), weight)

    def _stress(self, kink: np.ndarray, where: np.ndarray) -> list[np.ndarray]:
        """sx + sz and sz - sx + 2 i txz [Pa] of each of the kinks (r,) at places (r,) [m]."""
        w, log, jump, tangent = self._around(kink, where)
        steep = w * log
        turned = 2.0 / np.pi * (w.imag * (log + 1.0) * jump + jump.imag * steep)
        return [-2.0 / np.pi * (jump * steep).imag, turned / tangent**2]

    def _displacement(self, kink: np.ndarray, where: np.ndarray, nu: float) -> list[np.ndarray]:
        """G (u_x + i u_z) [N/m] of each of the kinks (r,) at places (r,) [m]."""
        w, log, jump, tangent = self._around(kink, where)
        integral = 0.5 * w**2 * (log - 0.5)
        both = 1j * tangent * ((3.0 - 4.0 * nu) * integral + integral.conj()) / (4.0 * np.pi)
        steep = tangent * w.imag * (w * log).conj() / (2.0 * np.pi)
        return [jump * both - jump.conj() * steep]

    def _around(self, kink: np.ndarray, where: np.ndarray) -> tuple[np.ndarray, ...]:
        """w, ln w (0 at the kink), f and the tangent; the logarithm's branch cut points out."""
        tangent, jump = self.tangent[kink], self.jump[kink]
        w = (where - self.place[kink]) / tangent
        log, square = np.empty_like(w), w.real**2 + w.imag**2  # thrice as fast as numpy's complex
        log.real = 0.5 * np.log(np.where(square == 0.0, 1.0, square))
        log.imag = np.where(square == 0.0, 0.0, 0.5 * np.pi - np.arctan2(w.real, w.imag))
        single = len(w), *(1,) * (jump.ndim - 1)
        return w.reshape(single), log.reshape(single), jump, tangent.reshape(single)

    def stress(
        self, weights: Weights, patch: np.ndarray, place: np.ndarray, point: np.ndarray
    ) -> np.ndarray:
        """sx, sz, txz (r, q, …, 3) [Pa] of the kinks, weighted as for each `patch`. patch (r,) rows
        of the weights, place (n, 2) [m], point (r, q) numbers of places."""
        total, turned = _weighted(self._stress, weights, patch, place, point)
        total, turned = 0.5 * total, 0.5 * turned
        return np.stack([total - turned.real, total + turned.real, turned.imag], axis=-1)

    def displacement(
        self, weights: Weights, patch: np.ndarray, place: np.ndarray, point: np.ndarray, nu: float
    ) -> np.ndarray:
        """G (u_x, u_z) (r, q, …, 2) [N/m] of the kinks, with other arguments as of `stress`."""
        field = partial(self._displacement, nu=nu)
        (moved,) = _weighted(field, weights, patch, place, point)
        return np.stack([moved.real, moved.imag], axis=-1)


def _weighted(
    field: Field, weights: Weights, patch: np.ndarray, place: np.ndarray, point: np.ndarray
) -> list[np.ndarray]:
    """Sums (r, q, …) over the kinks of a field's values at `place`[point], weighted by patch. The
    field is computed once for each pair of a place and a kink."""
    shape, alone = point.shape, point.size == len(place)  # whether no place is shared
    if alone:
        patch, point = np.repeat(patch, shape[1]), point.reshape(-1, 1)
    near = np.flatnonzero(weights.count[patch])
    first, count = weights.first[patch[near]], weights.count[patch[near]]
    point, start = point[near], weights.start[patch[near]]
    where = place @ [1.0, 1j]
    if not alone:
        values, begin = _tables(field, where, point, first, count)
    sums: list[np.ndarray] = []
    for part in _parts(count):
        row, number = runs(count[part])
        if alone:
            found = field(first[part][row] + number, where[point[part, 0]][row])
            shares = [value[:, None] for value in found]
        else:
            shares = [value[begin[part][row] + number[:, None]] for value in values]
        weight, begins = weights.value[start[part][row] + number], np.flatnonzero(number == 0)
        if not sums:
            sums = [np.zeros((len(patch), *v.shape[1:]), dtype=v.dtype) for v in shares]
        for total, share in zip(sums, shares, strict=True):
            share *= weight.reshape(-1, *(1,) * (share.ndim - 1))
            total[near[part]] = np.add.reduceat(share, begins)
    return [total.reshape(*shape, *total.shape[2:]) for total in sums]


def _tables(
    field: Field, where: np.ndarray, point: np.ndarray, first: np.ndarray, count: np.ndarray
) -> tuple[list[np.ndarray], np.ndarray]:
    """Values of a field of all kinks near each of the places (n,), and where among them those of
    the patches (r,) begin at their points (r, q)."""
    low, high = np.full(len(where), np.iinfo(int).max), np.zeros(len(where), dtype=int)
    np.minimum.at(low, point, first[:, None])
    np.maximum.at(high, point, (first + count)[:, None])
    span, tables = np.maximum(high - low, 0), []
    for part in _parts(span):
        row, number = runs(span[part])
        tables.append(field(low[part][row] + number, where[part][row]))
    values = [np.concatenate(each) for each in zip(*tables, strict=True)]
    return values, (np.cumsum(span) - span)[point] + first[:, None] - low[point]


def _parts(count: np.ndarray) -> list[np.ndarray]:
    """Numbers of runs of lengths `count` (n,), in groups of neighbours with about PAIRS entries."""
    several = np.flatnonzero(np.diff(np.cumsum(count) // PAIRS)) + 1
    return np.split(np.arange(len(count)), several)


def runs(count: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Run of each entry, and its number within the run, for runs of lengths `count` (n,)."""
    row = np.repeat(np.arange(len(count)), count)
    return row, np.arange(len(row)) - (np.cumsum(count) - count)[row]
