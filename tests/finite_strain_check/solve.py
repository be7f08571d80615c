"""A scene solved by finite elements of its own at finite strain, on finer and finer meshes."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.spatial import cKDTree

from tests.finite_strain_check.contact import State, SurfacePair
from tests.finite_strain_check.figures import patch_ends, shears
from tests.finite_strain_check.mesh import Triangles, interpolated, refined, strip
from tests.finite_strain_check.solid import Solid

BLOCK = 2000.0  # half-widths to the far boundary
FADE = 40.0  # um of depth to which the mesh follows the trace, and of length in which it ends
STRESSED = 0.9  # of the largest of each shear, from which elements are as fine as at the surface
OF_DEPTH = 16.0  # no elements are finer than this part of their depth
AT_ENDS = 0.125  # of the size elsewhere in contact
NOWHERE = np.full((1, 2), 1e9)  # um
SMALL = 0.03  # of the radius: half-widths from which on the roller's size matters
CIRCLE = 6.0  # half-widths to each side in which a half-plane has the roller's exact shape
# Of the radius: the side of the squares that a disc is mapped from. A sector: four across, two
# down, held at 0.30 of the radius on an arc of 138 degrees between free rays. A ring: six across,
# one down, held at 0.35, cut open opposite the contact. Opposite: four across, two down, held where
# the half-plane beyond them ends up.
SECTOR, RING, OPPOSITE = "sector", "ring", "opposite"
SUPPORTS = {SECTOR: (0.6, 4, 2), RING: (np.pi / 3.0, 6, 1), OPPOSITE: (20.0, 4, 2)}
HUB = float(np.exp(-np.pi / 3.0))  # of the ring, of the radius
COATED = 12.0  # half-widths to each side within which elements follow a coating's lower side
GROWTH = 0.25  # of elements per distance from the contact


@dataclass(frozen=True)
class Task:
    """Lengths in um, moduli in GPa, loads in kN/m.

    profile   heights of x; roller  (modulus, ratio), None where rigid; body likewise
    radius    of the roller, load  per length, friction mu
    law       of both bodies (`solid`); with `linear` these are flat and the roller a parabola
    support   of a disc, one of SUPPORTS
    coating   (modulus, ratio, thickness), bonded to the body, None where it has none; the thickness
              is the elements' size at the surface times a power of two, so that edges follow it
    cap       of the pressure [GPa]
    """

    x: np.ndarray
    height: np.ndarray
    body: tuple[float, float]
    roller: tuple[float, float] | None
    radius: float
    load: float
    friction: float = 0.0
    law: str | tuple[float, float] = "neo-hookean"
    support: str = SECTOR
    coating: tuple[float, float, float] | None = None
    cap: float = np.inf

    @property
    def modulus(self) -> float:
        """Combined plane-strain modulus E*."""
        bodies = [self.body, *([self.roller] if self.roller else [])]
        return 1.0 / sum((1.0 - v**2) / e for e, v in bodies)

    @property
    def half_width(self) -> float:
        """Half-width of the smooth contact."""
        return float(np.sqrt(4.0 * self.load * self.radius / (np.pi * self.modulus)))

    @property
    def is_disc(self) -> bool:
        """Whether the roller is a disc, else a half-plane with the circle on it.
        Friction turns a disc."""
        return self.law != "linear" and self.half_width > SMALL * self.radius

    def on_disc(self, s: np.ndarray, d: np.ndarray) -> np.ndarray:
        """Points (n, 2) of a disc's nodes from those on the squares: maps that keep angles."""
        r = self.radius
        if self.support == OPPOSITE:
            plane = s + 1j * d
            place = plane / (1.0 - 0.5j * plane / r)
            return np.stack([place.real, place.imag], axis=1)
        angle, inner = self._turned(s), r * np.exp(-self._turned(d))
        places = np.stack([inner * np.sin(angle), r - inner * np.cos(angle)], axis=1)
        flat = d == 0.0
        places[flat, 1] = 2.0 * r * np.sin(0.5 * angle[flat]) ** 2
        return places

    def _turned(self, s: np.ndarray) -> np.ndarray:
        """The angle of a length of the squares; a ring's meet opposite the contact."""
        if self.support == SECTOR:
            return s / self.radius
        return np.pi * s / (3.0 * self.square)

    @property
    def square(self) -> float:
        """Side of the squares that a disc is mapped from."""
        return SUPPORTS[self.support][0] * self.radius

    def under(self, x: np.ndarray) -> np.ndarray:
        """s of a disc's surface at x."""
        angle = np.arcsin(np.clip(x / self.radius, -1.0, 1.0))
        if self.support == OPPOSITE:
            return 2.0 * self.radius * np.tan(0.5 * angle)
        return angle / self._turned(np.ones(1))

    def constants(self, mesh: Triangles) -> tuple:
        """Young's modulus and Poisson's ratio of the body's elements."""
        if self.coating is None:
            return self.body
        coated = mesh.corners[mesh.triangles, 1].mean(axis=1) < self.coating[2]
        pairs = zip(self.coating[:2], self.body, strict=True)
        return tuple(np.where(coated, above, below) for above, below in pairs)

    def at_coating(self, place: np.ndarray) -> np.ndarray:
        """The size (n,) that elements at points (n, 2) have, so that none crosses its lower side
        within COATED half-widths of the middle."""
        if self.coating is None:
            return np.inf
        (s, d), thickness = np.abs(place).T, self.coating[2]
        beside = np.maximum(s - COATED * self.half_width, 0.0)
        return np.maximum(thickness, np.maximum(d - thickness, beside))

    def surface(self, x: np.ndarray) -> np.ndarray:
        """Height of the rough body: the trace's spline, which fades out at its ends."""
        inside = np.clip(x, self.x[0], self.x[-1])
        ends = np.clip(np.minimum(x - self.x[0], self.x[-1] - x) / FADE, 0.0, 1.0)
        return CubicSpline(self.x, self.height)(inside) * _smooth(ends)


def _smooth(t: np.ndarray) -> np.ndarray:
    return t**3 * (10.0 - 15.0 * t + 6.0 * t**2)


@dataclass(frozen=True)
class ElementSizes:
    """Elements of `fine` um in intervals (k, 2) of the surface and at spots (m, 2) of the strip,
    of a part of that at ends (n,) of patches, growing with the distance from all of them."""

    fine: float
    intervals: np.ndarray
    spots: np.ndarray
    ends: np.ndarray

    def on_surface(self, mapped: Callable[[np.ndarray], np.ndarray]) -> "ElementSizes":
        """Without spots, on the strip of another body."""
        return ElementSizes(self.fine, mapped(self.intervals), NOWHERE, mapped(self.ends))

    @cached_property
    def _near(self) -> tuple[cKDTree, cKDTree]:
        ends = np.stack([self.ends, 0.0 * self.ends], axis=1)
        return cKDTree(self.spots), cKDTree(ends)

    def __call__(self, place: np.ndarray) -> np.ndarray:
        (s, d), fine = place.T, self.fine
        first, last = self.intervals.T
        after = np.searchsorted(first, s)
        left = s - np.append(-np.inf, last)[after]
        right = np.append(first, np.inf)[after] - s
        away = np.hypot(np.maximum(np.minimum(left, right), 0.0), d)
        spot, end = (tree.query(place)[0] for tree in self._near)
        size = fine + GROWTH * np.maximum(np.minimum(away, spot) - fine, 0.0)
        size = np.maximum(size, d / OF_DEPTH)
        return np.minimum(size, AT_ENDS * fine + GROWTH * end)


def pair(task: Task, rough: Triangles, roller: Triangles | None, reach: float) -> SurfacePair:
    """Both bodies on their meshes."""
    small = task.law == "linear"
    s, d = rough.nodes.T
    deepest = d.max()
    shape = 0.0 if small else task.surface(s) * _smooth(np.clip(1.0 - d / FADE, 0.0, 1.0))
    held = (d == deepest) | (np.abs(s) == np.abs(s).max())
    constants = task.constants(rough)
    below = Solid(rough, np.stack([s, shape - d], axis=1), held, *constants, task.law)
    gap = (lambda x: x**2 / (2.0 * task.radius) - task.surface(x)) if small else None
    r = task.radius
    if roller is None:

        def above(x):
            root = np.sqrt(r**2 - x**2)
            return x**2 / (r + root), x / root, r**2 / root**3
    else:
        s, d = roller.nodes.T
        held = d == d.max()
        if task.is_disc:
            places = task.on_disc(s, d)
            if task.support == OPPOSITE:
                held |= np.abs(s) == np.abs(s).max()
        else:
            held |= np.abs(s) == np.abs(s).max()
            near = CIRCLE * task.half_width
            along = np.minimum(np.abs(s), near)
            along = along + near * np.tanh((np.abs(s) - along) / near)
            rise = np.zeros_like(along)
            if not small:
                rise = along**2 / (r + np.sqrt(r**2 - along**2))
                rise = rise * _smooth(np.clip(1.0 - 0.5 * d / near, 0.0, 1.0))
            places = np.stack([s, d + rise], axis=1)
        above = Solid(roller, places, held, *task.roller, task.law)
    middle = middle_of(places, np.flatnonzero(d == 0.0), r) if roller and task.is_disc else None
    return SurfacePair(below, above, task.load, task.friction, reach, gap, task.cap, middle)


def middle_of(places: np.ndarray, rim: np.ndarray, radius: float) -> np.ndarray:
    """(n, 2) that times displacements of nodes at `places` (n, 2) gives the displacement along x of
    the middle of the circle through the nodes of the rim: by their radial displacements."""
    rim = rim[np.argsort(places[rim, 0])]
    outward = (places[rim] - [0.0, radius]) / radius
    steps = np.append(0.0, np.cumsum(np.hypot(*np.diff(places[rim], axis=0).T)))
    weight = np.sqrt(np.gradient(steps))
    columns = np.column_stack([outward, np.ones(len(rim))]) * weight[:, None]
    middle = np.zeros_like(places)
    middle[rim] = (np.linalg.pinv(columns)[0] * weight)[:, None] * outward
    return middle


Meshes = tuple[Triangles, Triangles | None]


def meshes(task: Task, wanted: ElementSizes, coarse: Meshes | None = None) -> Meshes:
    """Meshes of both bodies, bisected from coarser ones."""
    if coarse is None:
        side = wanted.fine * 2.0 ** np.ceil(np.log2(BLOCK * task.half_width / wanted.fine))
        block = strip(side, 2, 1)
        disc = strip(task.square, *SUPPORTS[task.support][1:])
        coarse = block, (disc if task.is_disc else block) if task.roller else None
    rough, roller = coarse
    rough = refined(rough, lambda at: np.minimum(wanted(at), task.at_coating(at)))
    if roller is None:
        return rough, None
    above = wanted.on_surface(task.under if task.is_disc else lambda x: x)
    return rough, refined(roller, above)


def carried(state: State, old: SurfacePair, new: SurfacePair) -> State:
    """The state at the nodes of finer meshes."""
    pairs = zip(old.solids, new.solids, state.moved, strict=True)
    moved = [interpolated(a.mesh, b.mesh, u) for a, b, u in pairs]
    pressure = np.interp(new.x, old.x, state.pressure)
    capped = np.interp(new.x, old.x, state.capped) == 1.0
    active = (pressure > 0.0) & ~capped
    return replace(state, moved=moved, pressure=pressure, active=active, capped=capped)


def next_refinement(pair: SurfacePair, state: State, fine: float) -> ElementSizes:
    """Where a solution touches, where its patches end and where its shear is large."""
    at, margin = pair.x[state.active | state.capped], 8.0 * fine
    starts = np.concatenate([[True], np.diff(at) > 2.0 * margin])
    first, last = at[starts], at[np.append(starts[1:], True)]
    large = [shear > STRESSED * shear.max() for shear in shears(pair, state)]
    spots = pair.rough.mesh.nodes[np.logical_or(*large)]
    intervals = np.stack([first - margin, last + margin], axis=1)
    return ElementSizes(fine, intervals, spots, patch_ends(pair.x, state.pressure).ravel())


def solutions(
    task: Task,
    levels: Sequence[float],
    reach: float,
    log: Callable[[str], None] = lambda text: None,
) -> Iterator[tuple[SurfacePair, State]]:
    """Solve on meshes of each size [um] of `levels`, coarse to fine: the first covers the whole
    `reach` [um] from the middle, finer ones what the one before has in contact. Finite strain
    starts from small ones. Raises NotSettledError where there is no solution."""
    wanted = ElementSizes(levels[0], np.array([[-reach, reach]]), NOWHERE, NOWHERE[:, 0])
    mesh = meshes(task, wanted)
    now = pair(task, *mesh, reach)
    state = now.start()
    if task.law != "linear":
        small = replace(task, law="linear")
        first = pair(small, *meshes(small, wanted), reach)
        linear = first.solved(first.start(), log)
        state = replace(linear, moved=[linear.moved[0], *state.moved[1:]])
    for fine in levels:
        if fine != levels[0]:
            before, mesh = now, meshes(task, next_refinement(now, state, fine), mesh)
            now = pair(task, *mesh, reach)
            state = carried(state, before, now)
        log(f"{fine:g} um: {sum(s.count for s in now.solids)} unknowns, {len(now.x)} corners")
        if fine == levels[0] and now.middle is not None:  # held back at first
            state = replace(now, middle=None).solved(state, log)
        state = now.solved(state, log)
        yield now, state
