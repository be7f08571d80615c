"""Stresses next to the ends of contact that hat pressures leave out.

There the pressure falls like a square root, which no hats follow: within two pitches of an end the
stress along the surface under its sliding traction is wrong by several per cent of the largest, and
by a tenth of a per cent still five pitches inside. With a curve like those of
`analytic.contact.smooth_pressure` on a patch, u from -1 to 1 along it and theta = arccos u,

    p = sum c_k sin((k + 1) theta),      I(w) = (1/pi) int p(t)/(w - t) dt = sum c_k zeta^(k+1),

zeta = 1/(w + s), s = sqrt(w - 1) sqrt(w + 1), w = u + i depth in half-lengths of the patch: the
stresses of the curve in closed form (k = 0 is `analytic.exact.hertz`), on the surface, too. Their
difference from those of the hats is what is left out.

The curve passes through the nodal values but for the last four at each end, and its ends lie where
force and moment of the hats are its own: within 0.02 pitches for Hertz's contact of 20 to 160
pitches. There the stress at the surface under traction is right to 0.2 % of the largest in place of
4 % (20 pitches to a half-width) or to 0.06 % in place of 2 % (80)."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.fft import dst

from analytic.contact.smooth_pressure import contact_ends, curves_between, nodal_values
from analytic.stress.elements import FrictionStress
from analytic.stress.periodic import ImageStress
from analytic.stress.potential import power_series, stresses
from analytic.stress.tree import LoadedLine, tree_stress
from analytic.stress_state import StressState

REACH = 8.0  # pitches from an end: beyond, hats are right to 2e-4 of the largest stress
DISTURBED = 4  # nodal values at an end that the curve leaves out
# By which share an end disturbs the inner two of them: Hertz's contact has up to 0.021 and 0.010.
# Where the curve differs by more, the pressure bends too much for it, and the hats are better.
UNLIKE = np.array([0.025, 0.012])
FEWEST = 2 * DISTURBED + 4  # touching nodes of a patch
TERMS = 512  # of a patch's series at most
ROUNDS, FARTHEST = 3, 0.25  # of the search for the ends; pitches that they move at a time


@dataclass(frozen=True)
class SmoothPatch:
    """Touching nodes from `first` to `last`, `ends` of contact (2,) [m], c_k (terms,) [Pa]."""

    first: int
    last: int
    ends: tuple[float, float]
    series: np.ndarray

    @property
    def half(self) -> float:
        return 0.5 * (self.ends[1] - self.ends[0])

    def parts(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """sx, sz, txz under p and sx under q = p (4, k) [Pa] at x, z (k,) [m], z >= 0."""
        right, left = ((x - end + 1j * z) / self.half for end in self.ends[::-1])
        s = np.sqrt(right) * np.sqrt(left)
        zeta = 1.0 / (0.5 * (right + left) + s)
        value, slope = power_series(self.series, zeta)
        # d zeta / dw = -zeta / s, which the depth outweighs at the ends
        over = z / self.half / np.where(s == 0.0, 1.0, s)
        return stresses(zeta * value, -zeta * over * (value + zeta * slope))


@dataclass(frozen=True)
class EndStress:
    """The stresses that hats at x_nodes (n,) [m] with pressures (n,) [Pa] leave out; those of three
    periods lack the other periods' `images`, and a stress `along` x [Pa], too."""

    x_nodes: np.ndarray
    pressure: np.ndarray
    patches: tuple[SmoothPatch, ...]
    images: ImageStress | None = None
    along: float = 0.0  # as of `analytic.stress.elements.FrictionStress`

    def parts(self, x: ArrayLike, z: ArrayLike) -> np.ndarray:
        """sx, sz, txz under p and sx under q = p (4, …) [Pa] at x, z >= 0 [m], but for `along`;
        without images 0 far from ends."""
        x, z = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(z, dtype=float))
        pitch, change = self.x_nodes[1] - self.x_nodes[0], np.zeros((4, *x.shape))
        for patch in self.patches:
            away = np.minimum(*(np.abs(x - end) for end in patch.ends))
            near = np.hypot(away, z) < REACH * pitch
            if near.any():
                inside, at = slice(patch.first, patch.last + 1), (x[near], z[near])
                hats = LoadedLine(self.x_nodes[inside], self.pressure[inside], pitch)
                change[:, near] += patch.parts(*at) - tree_stress(hats, *at)
        return change if self.images is None else change + self.images.parts(x, z)

    def stress(self, friction: ArrayLike, x: ArrayLike, z: ArrayLike) -> StressState:
        """Stresses [Pa] at x, z [m] under p and q = friction * p."""
        return FrictionStress.of(self.parts(x, z), self.along).at(friction)


def end_stress(x_nodes: np.ndarray, pressure: np.ndarray, gap: np.ndarray) -> EndStress:
    """Curves for hats at uniform x_nodes (n,) [m] with pressures (n,) [Pa] and gaps (n,) [m], means
    over the hats. Patches of fewer than FEWEST nodes, and those that bend too much next to an end,
    keep the stresses of their hats. The others have the ends, near those that their gaps tell, at
    which they have the hats' force and moment."""
    pitch = x_nodes[1] - x_nodes[0]
    nodal = nodal_values(pressure)
    touching, ends = contact_ends(x_nodes, pressure, gap)
    wide = np.ptp(touching, axis=1) + 1 >= FEWEST
    if not wide.any():
        return EndStress(x_nodes, pressure, ())
    (first, last), ends = touching[wide].T, ends[wide]
    count, middle = last - first + 1, 0.5 * (x_nodes[first] + x_nodes[last])
    patch, node = _runs(first, count)
    force = pitch * np.bincount(patch, pressure[node])
    moment = pitch * np.bincount(patch, pressure[node] * (x_nodes[node] - middle[patch]))
    held_by, held = _runs(first + DISTURBED, count - 2 * DISTURBED)
    terms = np.minimum(4 * (count + 1), TERMS)
    patch, order = _runs(np.ones_like(terms), terms)
    angle = np.pi * order / (terms + 1)[patch]
    across, sine, sine_of_two = np.cos(angle), np.sin(angle), np.sin(2.0 * angle)
    # an end that moves out takes two thirds of the value at the next held node with it
    grows = 2.0 / 3.0 * np.column_stack([-nodal[first + DISTURBED], nodal[last - DISTURBED]])
    for _ in range(ROUNDS):
        used = ends  # never as far in as a held node: these are two pitches or more inside
        curve = curves_between(ends, x_nodes[held], nodal[held], held_by)
        half, centre = 0.5 * np.ptp(ends, axis=1), ends.mean(axis=1)
        values = curve(centre[patch] + half[patch] * across, patch)
        own_force = np.pi * half / (terms + 1) * np.bincount(patch, values * sine)
        own_moment = 0.5 * np.pi * half**2 / (terms + 1) * np.bincount(patch, values * sine_of_two)
        own_moment += own_force * (centre - middle)
        left = np.stack([force - own_force, moment - own_moment], axis=-1)
        matrix = np.stack([grows, grows * (ends - middle[:, None])], axis=1)
        moved = np.linalg.solve(matrix, left[..., None])[..., 0]
        ends = ends + np.clip(moved, -FARTHEST * pitch, FARTHEST * pitch)
    inner = np.arange(DISTURBED - len(UNLIKE), DISTURBED)
    inner = np.stack([first[:, None] + inner, last[:, None] - inner], axis=1)
    apart = np.abs(curve(x_nodes[inner], np.arange(len(first))[:, None, None]) - nodal[inner])
    alike = np.flatnonzero(np.all(apart <= UNLIKE * nodal[inner], axis=(1, 2)))
    series = (dst(values[patch == k], type=1) / (terms[k] + 1) for k in alike)
    known = first[alike].tolist(), last[alike].tolist(), map(tuple, used[alike].tolist()), series
    return EndStress(x_nodes, pressure, tuple(map(SmoothPatch, *known)))


def _runs(first: np.ndarray, count: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Numbers of the runs (n,) that each have `count` (k,) members, and members (n,): `first` (k,)
    and the whole numbers after it."""
    run = np.repeat(np.arange(len(count)), count)
    return run, np.arange(len(run)) + (first - np.cumsum(count) + count)[run]
