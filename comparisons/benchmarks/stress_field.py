"""Time of subsurface stresses against direct summation, on one thread.

    python -m comparisons.benchmarks.stress_field

A field on a grid by convolution (`analytic.stress.field`) and scattered points by the tree
(`analytic.stress.tree`), beside three direct sums, none of which uses that points may lie on a
grid:

    hats          per point and element the closed form at its three nodes: 3 arctan2, 3 log
    strips        Bailey and Sayles 1991, eq. (1) and (2), as published: 2 arctan2, 2 hypot, 1 log,
                  sines and cosines of both angles; of other elements, so its result differs
    shared nodes  hats again, angle and logarithm once a node, weighted with the load's change of
                  slope there: what superposition on a uniform line leaves

Exit status 0 only if the field takes at most 1/300 of the time of the sum over hats, and differs by
at most 1e-12 of the largest stress from a sum that keeps each element's digits. The error of the
sum over hats itself is printed beside it.
"""

import argparse
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np

from analytic.exact.hertz import hertz_from_peak_pressure
from analytic.stress.elements import FrictionStress
from analytic.stress.field import friction_field, stress_field
from analytic.stress.points import stress_at
from analytic.stress.tree import LoadedLine, direct_stress
from analytic.stress_state import StressState
from comparisons.benchmarks.harness import (
    Demand,
    print_demands,
    print_table,
    run_on_one_thread,
    timed,
)

FRICTION = 0.1
WANTED = 300.0  # times faster than the sum over hats
CLOSE = 1e-12  # of the largest stress, between the field and the sum that keeps all digits
PAIRS = 2**15  # of point and element at a time, which stay in the cache
DIRECT_POINTS = 2048  # scattered points summed directly, the time scaled to all
CHECKED_POINTS = 500  # whose stresses are compared
COLUMNS = ("way", "seconds", "ratio", "difference")


class StressTime(NamedTuple):
    """One way, its median processor time [s], and its largest difference over the largest stress
    from a sum of the same elements that keeps every digit; None for other elements."""

    name: str
    seconds: float
    difference: float | None = None


class Line(NamedTuple):
    """Nodes (n,) of equal pitch and the pressure (n,) on them."""

    nodes: np.ndarray
    pressure: np.ndarray

    @property
    def pitch(self) -> float:
        return (self.nodes[-1] - self.nodes[0]) / (len(self.nodes) - 1)


def rough_line(count: int) -> Line:
    """Nodes from -1 to 1 half-widths and Hertz's pressure with seeded noise [p0]."""
    nodes = np.linspace(-1.0, 1.0, count + 2)[1:-1]
    noise = np.random.default_rng(7).uniform(0.5, 1.5, count)
    return Line(nodes, hertz_from_peak_pressure(1.0, 1.0, 2.0).pressure(nodes) * noise)


def direct(
    terms: Callable[[np.ndarray, np.ndarray, Line], np.ndarray],
    line: Line,
    x: np.ndarray,
    z: np.ndarray,
) -> np.ndarray:
    """sx, sz, txz (3, points) under p and q = FRICTION p by one of the three forms below."""
    parts = np.empty((4, x.size))
    step = max(1, PAIRS // len(line.nodes))
    with np.errstate(divide="ignore", invalid="ignore"):
        for start in range(0, x.size, step):
            here = slice(start, start + step)
            parts[:, here] = terms(x[here, None], z[here, None], line)
    return _stacked(_with_friction(parts))


def hats(x: np.ndarray, z: np.ndarray, line: Line) -> np.ndarray:
    """(4, points): sx, sz, txz under p and sx under q = p; x, z (points, 1)."""
    offsets = [x - (line.nodes + shift) for shift in (-line.pitch, 0.0, line.pitch)]
    angles = [np.arctan2(z, y) for y in offsets]
    # r = 0 only on a node of the surface, where y ln r and z ln r are zero
    logs = [0.5 * np.log(np.maximum(y * y + z * z, 1e-300)) for y in offsets]
    angle, log = _bent(angles), _bent(logs)
    angle_moment = _bent([y * a for y, a in zip(offsets, angles, strict=True)])
    log_moment = _bent([y * a for y, a in zip(offsets, logs, strict=True)])
    sums = [
        (angle_moment + 2.0 * z * log) @ line.pressure,
        angle_moment @ line.pressure,
        -(z * angle) @ line.pressure,
        (3.0 * z * angle - 2.0 * log_moment) @ line.pressure,
    ]
    return np.array(sums) / (np.pi * line.pitch)


def _bent(at: list[np.ndarray]) -> np.ndarray:
    return at[0] - 2.0 * at[1] + at[2]


def strips(x: np.ndarray, z: np.ndarray, line: Line) -> np.ndarray:
    """As `hats`, for uniform strips."""
    right, left = (x - (line.nodes + shift) for shift in (0.5 * line.pitch, -0.5 * line.pitch))
    t1, t2 = np.arctan2(z, right), np.arctan2(z, left)
    turn = 2.0 * (t1 - t2)
    sines = np.sin(2.0 * t1) - np.sin(2.0 * t2)
    cosines = np.cos(2.0 * t1) - np.cos(2.0 * t2)
    log = 4.0 * np.log(np.hypot(right, z) / np.hypot(left, z))
    sums = [kernel @ line.pressure for kernel in (-(turn + sines), -(turn - sines), cosines)]
    return np.array([*sums, (log - cosines) @ line.pressure]) / (2.0 * np.pi)


def shared_nodes(x: np.ndarray, z: np.ndarray, line: Line) -> np.ndarray:
    """As `hats`, with each node's angle and logarithm taken once."""
    nodes, pitch = line.nodes, line.pitch
    ends = np.concatenate([[nodes[0] - pitch], nodes, [nodes[-1] + pitch]])
    bend = np.convolve(line.pressure, [1.0, -2.0, 1.0]) / (np.pi * pitch)
    y = x - ends
    angle, log = np.arctan2(z, y), 0.5 * np.log(np.maximum(y * y + z * z, 1e-300))
    z = z[:, 0]
    sz, turn = (y * angle) @ bend, z * (angle @ bend)
    return np.array([sz + 2.0 * z * (log @ bend), sz, -turn, 3.0 * turn - 2.0 * ((y * log) @ bend)])


def field_times(elements: int, levels: int, repeats: int) -> list[StressTime]:
    """A field on the `elements` hats' own columns and `levels` down to a half-width."""
    line = rough_line(elements)
    depths = np.linspace(0.0, 1.0, levels)
    window = (line.nodes[0], line.nodes[-1])
    field = partial(stress_field, *line, FRICTION, window, depths)
    every_friction = partial(friction_field, *line, window, depths)
    first, _ = timed(field, 1)
    cold, found = timed(field, 5 * repeats)
    x, z = (a.ravel() for a in np.meshgrid(line.nodes, depths))
    return [
        *_direct_times(line, x, z, len(x), repeats),
        StressTime("convolution", cold, _difference(line, x, z, _stacked(found.stress))),
        StressTime("convolution, for every friction", timed(every_friction, 5 * repeats)[0]),
        StressTime("convolution, first call of the process", first),
    ]


def point_times(elements: int, points: int, repeats: int) -> list[StressTime]:
    """Scattered points, as many shallow as deep, from the surface to a half-width."""
    line = rough_line(elements)
    rng = np.random.default_rng(8)
    x = rng.uniform(-1.5, 1.5, points)
    z = np.where(rng.random(points) < 0.5, rng.random(points), 10.0 ** rng.uniform(-7, 0, points))
    seconds, found = timed(lambda: stress_at(*line, FRICTION, x, z), 2 * repeats)
    return [
        *_direct_times(line, x, z, min(points, DIRECT_POINTS), repeats),
        StressTime("tree", seconds, _difference(line, x, z, _stacked(found))),
    ]


def _direct_times(
    line: Line, x: np.ndarray, z: np.ndarray, count: int, repeats: int
) -> list[StressTime]:
    """The three forms on the first `count` points, their time scaled to all."""
    rows, few = [], slice(count)
    for name, terms in (("hats", hats), ("strips", strips), ("shared nodes", shared_nodes)):
        seconds, found = timed(partial(direct, terms, line, x[few], z[few]), repeats)
        off = None if terms is strips else _difference(line, x[few], z[few], found)
        rows.append(StressTime(f"direct sum, {name}", seconds * len(x) / count, off))
    return rows


def _difference(line: Line, x: np.ndarray, z: np.ndarray, found: np.ndarray) -> float:
    """To the sum over all elements in the form that keeps each one's digits, on some points."""
    some = np.random.default_rng(9).permutation(len(x))[:CHECKED_POINTS]
    parts = direct_stress(LoadedLine(*line, line.pitch, "hat"), x[some], z[some])
    expected = _stacked(_with_friction(parts))
    return float(np.abs(found[:, some] - expected).max() / np.abs(expected).max())


def _with_friction(parts: np.ndarray) -> StressState:
    return FrictionStress(StressState(*parts[:3]), parts[3]).at(FRICTION)


def _stacked(stress: StressState) -> np.ndarray:
    return np.array([np.ravel(getattr(stress, name)) for name in ("sx", "sz", "txz")])


def demands(rows: list[StressTime]) -> list[Demand]:
    """Demands on the rows of `field_times`."""
    by_name = {row.name: row for row in rows}
    ours, sums = by_name["convolution"], by_name["direct sum, hats"]
    ratio, off = sums.seconds / ours.seconds, ours.difference
    faster = f"field: {ratio:.3g} times faster than the {sums.name}, wanted {WANTED:g}"
    exact = f"field: off by {off:.1e} of the largest stress, allowed {CLOSE:g}"
    exact += f" ({sums.name}: {sums.difference:.1e})"
    return [Demand(ratio >= WANTED, faster), Demand(off <= CLOSE, exact)]


def main(arguments: list[str] | None = None) -> int:
    """Print both tables and the demands; the exit status."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--elements", type=int, default=1024)
    parser.add_argument("--levels", type=int, default=100)
    parser.add_argument("--point-elements", type=int, default=4096)
    parser.add_argument("--points", type=int, default=100_000)
    parser.add_argument("--repeats", type=int, default=3)
    given = parser.parse_args(arguments)
    field = field_times(given.elements, given.levels, given.repeats)
    size = f"{given.elements} x {given.levels} points from {given.elements} elements"
    print_table(f"Field of {size}", COLUMNS, _cells(field, "convolution"))
    points = point_times(given.point_elements, given.points, given.repeats)
    size = f"{given.points} scattered points from {given.point_elements} elements"
    print_table(size, COLUMNS, _cells(points, "tree"))
    return print_demands(demands(field))


def _cells(rows: list[StressTime], ours: str) -> list[tuple[str, ...]]:
    """Each with its time over that of the row named `ours`."""
    base = next(row.seconds for row in rows if row.name == ours)
    return [
        (name, f"{seconds:.4g}", f"{seconds / base:.3g}", "" if off is None else f"{off:.1e}")
        for name, seconds, off in rows
    ]


if __name__ == "__main__":
    run_on_one_thread(main)
