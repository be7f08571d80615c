"""The largest value of a stress quantity in a body, and its position.

Nodes alone miss the point of a flat maximum by half an element. A rough estimate at all nodes says
which elements may hold it; these alone are recovered and sampled, the best of them finely. Away
from the surface a polynomial fitted to the stresses around
the best sample gives the maximum: of degree 5 to two rings of elements, next to the surface or
where that does not fit of degree 3 to one ring, which amplifies the waves of the elements. On six
Hertz contacts of quadratic elements, friction 0 to 0.3, 55 to 130 edges a half-width, the depth of
tau1 errs by 5e-4 in root mean square with two rings, by 3e-3 with one; its value by 1.2e-5, 2.6e-5.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import groupby
from operator import itemgetter

import numpy as np

from analytic.stress_state import Extremum, StressState, von_mises
from fem.body.elasticity import ElasticBody
from fem.body.triangle import monomials, shapes
from fem.stress.recovery import MaterialStress
from fem.stress.stress import NodalStress, within

Quantity = Callable[[MaterialStress], np.ndarray]
Window = tuple[float, float, float]

# By how much, of the maximum, the highest node of the element that holds it is below it, at most,
# by the rough estimate: that is off by 0.25 where five elements make a wave, by 0.02 on finer.
DOUBT = 0.5
FEW, MANY = 32, 512  # highest nodes and elements of a cell, by the estimate, that are looked at
# samples along an element's edge: of promising elements its nodes, ever more of ever better ones
*COARSE, FINE = NODES, *_ = 2, 4, 8, 16, 32
BEST = 64  # elements sampled more finely, but for those that cannot reach the highest sample:
RISE = 4.0  # of what an element's samples differ by, over their number's square; twice a parabola's
NEAR = 0.7  # of the largest value: cells whose own are below it are not sampled between the nodes
# Samples on a point that elements share differ by rounding, which must not choose the elements of
# the polynomial: it uses those around all of them.
ALIKE = 1e-8
# Largest misfit of the polynomial at its nodes, over the maximum: beyond it the sample is better.
MISFIT = 0.01
STEP = 1e-4  # of the patch's size, between values that give its slopes and bends
FLAT = 1e-6  # slope at its top, relative to the maximum, per unit of the patch's size
# Newton's steps up the polynomial, the longest, and the one that is none, in units of the patch
STEPS, LONGEST, NONE = 30, 0.25, 1e-10


@dataclass(frozen=True, eq=False)
class Search:
    """For the largest value of a `quantity`, made of the stresses (and Poisson's ratio) point by
    point, in every cell of x."""

    nodal: NodalStress
    quantity: Quantity
    cells: Sequence[float] = ()  # (k,) [m] where one cell ends and the next begins, ascending

    @cached_property
    def rough(self) -> np.ndarray:
        """The estimate at all nodes (n,)."""
        stress = self.nodal.estimate().T
        return self.quantity(MaterialStress(*stress, self.nodal.poissons_ratio))


def maximum(
    body: ElasticBody, nodal: NodalStress, quantity: Quantity, window: Window | None = None
) -> Extremum:
    """Largest value of a `quantity`. `window` (x0, x1, z1) [m] limits the search to x0 <= x <= x1
    and z <= z1. Raises ValueError if no sample lies in the window."""
    [highest] = _between_nodes(body, [(Search(nodal, quantity), window)])
    return highest


def maxima(body: ElasticBody, searches: Sequence[Search], window: Window) -> list[np.ndarray]:
    """Largest value in each cell, from left to right: value, x and z (3, k + 1) [m], of each search
    in stresses that are known together.

    Where the highest node is below NEAR of the highest of all, that node is taken; a cell without a
    node in the window has the value 0 and no x and z.
    """
    (x0, x1, z1), looks, cells = window, [], []
    found = [_at_nodes(body, search, window) for search in searches]
    for search, largest in zip(searches, found, strict=True):
        ends, value = np.clip([x0, *search.cells, x1], x0, x1), largest[0]
        for k in np.flatnonzero((value >= NEAR * value.max()) & (value > 0.0)):
            looks.append((search, (ends[k], ends[k + 1], z1)))
            cells.append(largest[:, k])
    for cell, best in zip(cells, _between_nodes(body, looks), strict=True):
        cell[:] = best.value, best.x, best.z
    return found


def _at_nodes(body: ElasticBody, search: Search, window: Window) -> np.ndarray:
    """`maxima` at the nodes alone."""
    nodal, rough, cells = search.nodal, search.rough, search.cells
    points = body.points[nodal.nodes.point]
    inside = np.flatnonzero(_inside(points, window))
    cell, top = np.searchsorted(cells, points[inside, 0]), np.full(len(cells) + 1, -np.inf)
    np.maximum.at(top, cell, rough[inside])
    high = rough[inside] >= (top - DOUBT * np.abs(top))[cell]
    inside, cell = inside[high], cell[high]
    order = np.lexsort((-rough[inside], cell))
    first = np.searchsorted(cell[order], np.arange(len(top)))
    few = order[np.arange(len(order)) - first[cell[order]] < FEW]
    node, cell = inside[few], cell[few]
    value = search.quantity(MaterialStress(*nodal.at(node).T, nodal.poissons_ratio[node]))
    largest = np.full((3, len(top)), np.nan)
    largest[0] = 0.0
    for k in np.unique(cell):
        mine = np.flatnonzero(cell == k)
        highest = mine[np.argmax(value[mine])]
        largest[:, k] = value[highest], *points[node[highest]]
    return largest


def highest_node(
    body: ElasticBody, nodal: NodalStress, across: np.ndarray, window: Window
) -> Extremum:
    """The largest von Mises stress at a node, with a stress `across` the plane (k,) [Pa] there."""
    points = body.points[nodal.nodes.point]
    rough = von_mises(StressState(*nodal.estimate().T), across)
    rough[~_inside(points, window)] = -np.inf
    node = np.argsort(-rough, kind="stable")[:MANY]
    node = node[rough[node] >= (1.0 - DOUBT) * rough[node[0]]]
    value = von_mises(StressState(*nodal.at(node).T), across[node])
    top = np.argmax(value)
    return Extremum(float(value[top]), *map(float, points[node[top]]))


def _between_nodes(
    body: ElasticBody, looks: Sequence[tuple[Search, Window | None]]
) -> list[Extremum]:
    """`maximum` of each search in its window."""
    if not looks:
        return []
    every, _ = looks[0][0].nodal.together or (looks[0][0].nodal, ...)
    triangles, points = every.nodes.triangles, body.points[every.nodes.point]

    def sampled(elements: list[np.ndarray], count: int) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """Values (r, q), -inf outside, and points (r, q, 2) in the elements (r,) of each window."""
        held, at = np.unique(np.concatenate(elements)), _lattice(count)
        place, stress = points[triangles[held]], every.at(triangles[held])
        if count > NODES:
            place = np.einsum("mac,qa->mqc", place, shapes(at))
            stress = within(body, every, held, at)
        nu = np.broadcast_to(body.poissons_ratio[held, None], place.shape[:2])
        for (search, window), mine in zip(looks, elements, strict=True):
            rows, (_, column) = np.searchsorted(held, mine), search.nodal.together or (every, ...)
            components = np.moveaxis(stress[rows][:, :, column], -1, 0)
            value, there = search.quantity(MaterialStress(*components, nu[rows])), place[rows]
            yield np.where(_inside(there, window), value, -np.inf), there

    best = []
    for search, of in groupby(looks, itemgetter(0)):
        best += _promising(points, triangles, search.rough, [window for _, window in of])
    for count in COARSE:
        values = (value for value, _ in sampled(best, count))
        best = [_able(*pair, RISE / count**2) for pair in zip(best, values, strict=True)]
    on_surface = np.zeros(len(body.points), dtype=bool)
    on_surface[body.top.point] = True
    fixed = body, points, on_surface[every.nodes.point]
    fine = zip(looks, best, sampled(best, FINE), strict=True)
    return [_top(*fixed, *look, elements, *values) for look, elements, values in fine]


def _able(elements: np.ndarray, value: np.ndarray, rise: float) -> np.ndarray:
    """Elements of these (r,) that may hold the largest value by samples (r, q), at most BEST;
    `rise` is between samples, of what an element's differ by."""
    highest = value.max(axis=1)
    lowest = value.min(axis=1, where=value > -np.inf, initial=np.inf)
    able = np.argsort(highest)[-BEST:]
    if highest.max() > -np.inf:
        able = able[~(highest[able] + rise * (highest - lowest)[able] < highest.max())]
    return np.sort(elements[able])


def _promising(
    points: np.ndarray, triangles: np.ndarray, rough: np.ndarray, windows: Sequence[Window | None]
) -> list[np.ndarray]:
    """Elements that may hold the largest value in each window, all of them in one between nodes."""
    tops = [rough[_inside(points, window)].max(initial=-np.inf) for window in windows]
    least = min(top - DOUBT * abs(top) if top > -np.inf else -np.inf for top in tops)
    some = np.flatnonzero((rough >= least)[triangles].any(axis=1))
    node = triangles[some]
    value, place, elements = rough[node], points[node], []
    for top, window in zip(tops, windows, strict=True):
        if top == -np.inf:
            elements.append(np.arange(len(triangles)))
            continue
        highest = np.where(_inside(place, window), value, -np.inf).max(axis=1)
        order = np.argsort(-highest, kind="stable")[:MANY]
        elements.append(some[order[highest[order] >= top - DOUBT * abs(top)]])
    return elements


def _top(
    body: ElasticBody,
    points: np.ndarray,
    surface: np.ndarray,
    search: Search,
    window: Window | None,
    best: np.ndarray,
    fine: np.ndarray,
    place: np.ndarray,
) -> Extremum:
    """The largest value by samples (r, q) at points (r, q, 2) in the best elements (r,). points
    (k, 2) are the nodes' [m], surface (k,) whether they are on it."""
    top = fine.max()
    if top == -np.inf:
        raise ValueError(f"no part of the body lies in the window {window}")
    high = fine >= top - ALIKE * abs(top)
    element, point = np.argwhere(high)[0]
    top_sample = Extremum(float(fine[element, point]), *map(float, place[element, point]))

    away = np.linalg.norm(place[high] - place[element, point], axis=-1)
    size = np.ptp(place[element], axis=0).max()
    sharing = np.unique(best[np.nonzero(high)[0][away < ALIKE * size]])
    nu = body.poissons_ratio[best[element]]
    nodal = search.nodal
    once = nodal.nodes.around(sharing)
    for around, degree in ((nodal.nodes.around(once), 5), (once, 3)):
        patch = np.unique(nodal.nodes.triangles[around])
        if surface[patch].any():
            continue
        smooth = _smooth_maximum(
            points[patch], nodal.at(patch), degree, nu, search.quantity, top_sample
        )
        if smooth and _inside(np.array([smooth.x, smooth.z]), window):
            return smooth
    return top_sample


def _lattice(count: int) -> np.ndarray:
    """Reference points (q, 2) with `count` steps along an edge."""
    return np.array([[i, j] for i in range(count + 1) for j in range(count + 1 - i)]) / count


def _inside(place: np.ndarray, window: Window | None) -> np.ndarray:
    """Whether points (..., 2) lie in the window."""
    x0, x1, z1 = window or (-np.inf, np.inf, np.inf)
    return (place[..., 0] >= x0) & (place[..., 0] <= x1) & (place[..., 1] <= z1)


def _smooth_maximum(
    points: np.ndarray,
    stress: np.ndarray,
    degree: int,
    nu: float,
    quantity: Quantity,
    start: Extremum,
) -> Extremum | None:
    """Largest value of the polynomials through `stress` (k, 3) at `points`; None: a misfit."""

    def of(values: np.ndarray) -> np.ndarray:
        return quantity(MaterialStress(*values.T, np.full(len(values), nu)))

    origin = np.array([start.x, start.z])
    unit = np.abs(points - origin).max()
    offset = (points - origin) / unit
    terms = monomials(offset, degree)
    if start.value == 0.0 or len(points) <= terms.shape[1]:
        return None
    fit, *_ = np.linalg.lstsq(terms, stress, rcond=None)
    misfit = of(terms @ fit) - of(stress)
    if np.abs(misfit).max() > MISFIT * abs(start.value):
        return None

    low, high, top = offset.min(axis=0), offset.max(axis=0), np.zeros(2)
    for _ in range(STEPS):
        value = of(monomials(top + STEP * _STENCIL, degree) @ fit) / abs(start.value)
        slope, bend = _derivatives(value)
        curvature, axes = np.linalg.eigh(bend)
        curvature = np.maximum(np.abs(curvature), FLAT)
        step = axes @ (axes.T @ slope / curvature)  # uphill, whichever way the polynomial bends
        step *= min(1.0, LONGEST / max(np.abs(step).max(), LONGEST))
        if np.abs(step).max() < NONE:
            break
        top = np.clip(top + step, low, high)
    if np.any((top <= low) | (top >= high)) or np.abs(slope).max() > FLAT:
        return None
    place = origin + unit * top
    return Extremum(value[4] * abs(start.value), float(place[0]), float(place[1]))


_STENCIL = np.array([[i, j] for i in (-1, 0, 1) for j in (-1, 0, 1)])


def _derivatives(value: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Slope (2,) and second derivatives (2, 2) by values (9,) on the stencil, a STEP apart."""
    v = value.reshape(3, 3)
    slope = np.array([v[2, 1] - v[0, 1], v[1, 2] - v[1, 0]]) / (2.0 * STEP)
    mixed = 0.25 * (v[2, 2] - v[2, 0] - v[0, 2] + v[0, 0])
    along = v[2, 1] + v[0, 1] - 2.0 * v[1, 1], v[1, 2] + v[1, 0] - 2.0 * v[1, 1]
    return slope, np.array([[along[0], mixed], [mixed, along[1]]]) / STEP**2
