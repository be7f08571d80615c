"""Figures of a solved contact, in the definitions of the project."""

from typing import NamedTuple

import numpy as np
from scipy.integrate import trapezoid

from tests.finite_strain_check.contact import State, SurfacePair

INWARD = 5  # nodes from the end of a patch


class Asperity(NamedTuple):
    """One asperity in contact: undeformed ends, peak pressure, largest tau1 with its undeformed
    x and depth below the surface."""

    start: float
    end: float
    peak: float
    tau1: float
    x: float
    depth: float


class ContactFigures(NamedTuple):
    """Pressure and stresses are Cauchy's; x is undeformed, depth is below the surface.

    peak      largest pressure, force per deformed length; and its x
    length    of all patches, along x of the undeformed and of the deformed surface
    tau1      largest (s1 - s2) / 2 in the rough body, its x and depth; txz likewise
    """

    peak: float
    peak_x: float
    length: float
    deformed_length: float
    tau1: float
    tau1_x: float
    tau1_depth: float
    txz: float
    txz_x: float
    txz_depth: float
    patches: list[Asperity]


def figures(pair: SurfacePair, state: State) -> ContactFigures:
    """Figures of an equilibrium. Stresses are nodal means (`Solid.cauchy`); ends of patches are
    those of an ellipse with the pressure some nodes inside and the integral from there on, so that
    the last nodes, which oscillate, count by their mean."""
    rough, small = pair.rough, pair.gap is not None
    mesh, u, edges = rough.mesh, state.moved[0], pair.edges
    corners = np.array([*edges[:, 0], edges[-1, 2]])
    at = pair.x + (0.0 if small else u[corners, 0])
    pressure = state.pressure / pair.stretch(state)
    top = int(pressure.argmax())
    peak, peak_x = _vertex(pair.x[top - 1 : top + 2], pressure[top - 1 : top + 2])
    ends = patch_ends(pair.x, state.pressure)
    tau1, orthogonal = shears(pair, state)
    s, d = mesh.nodes.T
    first, second = tau1.argmax(), orthogonal.argmax()
    bounds = np.concatenate([[-np.inf], 0.5 * (ends[:-1, 1] + ends[1:, 0]), [np.inf]])
    owner = np.searchsorted(bounds, s) - 1
    patches = []
    for i, (start, end) in enumerate(ends):
        mine = np.flatnonzero((owner == i) & (d < 2.0 * (end - start) + 2.0))
        if not len(mine):
            continue  # a single corner of a coarse mesh
        best = mine[tau1[mine].argmax()]
        inside = (pair.x >= start) & (pair.x <= end)
        highest = pressure[inside].max() if inside.any() else 0.0
        patches.append(Asperity(start, end, highest, tau1[best], s[best], d[best]))
    lengths = (float(np.diff(e, axis=1).sum()) for e in (ends, np.interp(ends, pair.x, at)))
    return ContactFigures(
        peak, peak_x, *lengths,
        tau1[first], s[first], d[first], orthogonal[second], s[second], d[second], patches,
    )  # fmt: skip


def shears(pair: SurfacePair, state: State) -> tuple[np.ndarray, np.ndarray]:
    """tau1 and |txz| at the rough body's nodes."""
    sx, sz, txz = pair.rough.cauchy(state.moved[0])
    return np.hypot(0.5 * (sx - sz), txz), np.abs(txz)


def _vertex(x: np.ndarray, y: np.ndarray) -> tuple[float, float]:
    """Largest value of the parabola through three points, and its x."""
    c = np.polyfit(x - x[1], y, 2)
    at = -0.5 * c[1] / c[0]
    return float(np.polyval(c, at)), float(x[1] + at)


def patch_ends(x: np.ndarray, pressure: np.ndarray) -> np.ndarray:
    """(k, 2) of runs of positive pressures."""
    on = np.concatenate([[False], pressure > 0.0, [False]])
    first, last = np.flatnonzero(on[1:] & ~on[:-1]), np.flatnonzero(on[:-1] & ~on[1:]) - 1

    def end(i: int, inward: int, count: int) -> float:
        skip = min(INWARD, (count - 1) // 4)
        if skip == 0:
            return float(x[i] - 0.5 * (x[i + inward] - x[i]))
        low, high = sorted((i - inward, i + inward * skip))
        integral = trapezoid(pressure[low : high + 1], x[low : high + 1])
        at = i + inward * skip
        distance = 1.5 * integral / pressure[at]
        width = abs(x[i + inward * (count - 1)] - x[i])
        return float(x[at] - inward * distance * (1.0 - 0.2 * distance / width))

    counts = last - first + 1
    pairs = [(end(i, 1, n), end(j, -1, n)) for i, j, n in zip(first, last, counts, strict=True)]
    return np.array(pairs)
