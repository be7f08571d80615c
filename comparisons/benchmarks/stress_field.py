"""Time of subsurface stresses against direct summation, on one thread.

    python -m comparisons.benchmarks.stress_field

A field on a grid by convolution (`analytic.stress.field`) beside a direct sum, which does not use
that points lie on a grid: per point and hat the closed form at its three nodes, 3 arctan2, 3 log.

Exit status 0 only if the field takes at most 1/300 of the time of the direct sum, and differs by at
most 1e-12 of the largest stress from a sum that keeps each element's digits. The error of the
direct sum itself is printed beside it.
"""

import argparse
from functools import partial
from typing import NamedTuple

import numpy as np

from analytic.exact.hertz import hertz_from_peak_pressure
from analytic.stress.elements import FrictionStress
from analytic.stress.field import stress_field
from analytic.stress.tree import LoadedLine, direct_stress
from analytic.stress_state import StressState
from comparisons.benchmarks import harness

FRICTION = 0.1
WANTED = 300.0  # times faster than the direct sum
CLOSE = 1e-12  # of the largest stress, between the field and the sum that keeps all digits
PAIRS = 2**15  # of point and element at a time, which stay in the cache
CHECKED_POINTS = 500  # of the field, whose stresses are compared


class StressTime(NamedTuple):
    """One way, its median processor time [s], and its largest difference over the largest stress
    from a sum that keeps every digit; None where it is not measured."""

    name: str
    seconds: float
    difference: float | None = None


def rough_line(count: int) -> LoadedLine:
    """Hats from -1 to 1 half-widths under Hertz's pressure with seeded noise [p0]."""
    nodes = np.linspace(-1.0, 1.0, count + 2)[1:-1]
    noise = np.random.default_rng(7).uniform(0.5, 1.5, count)
    load = hertz_from_peak_pressure(1.0, 1.0, 2.0).pressure(nodes) * noise
    return LoadedLine(nodes, load, (nodes[-1] - nodes[0]) / (count - 1), "hat")


def direct(line: LoadedLine, x: np.ndarray, z: np.ndarray) -> np.ndarray:
    """sx, sz, txz (3, points) under p and q = FRICTION p."""
    parts = np.empty((4, x.size))
    step = max(1, PAIRS // len(line.nodes))
    with np.errstate(divide="ignore", invalid="ignore"):
        for start in range(0, x.size, step):
            here = slice(start, start + step)
            parts[:, here] = _sums(x[here, None], z[here, None], line)
    return _stacked(_with_friction(parts))


def _sums(x: np.ndarray, z: np.ndarray, line: LoadedLine) -> np.ndarray:
    """(4, points): sx, sz, txz under p and sx under q = p; x, z (points, 1)."""
    offsets = [x - (line.nodes + shift) for shift in (-line.pitch, 0.0, line.pitch)]
    angles = [np.arctan2(z, y) for y in offsets]
    # r = 0 only on a node of the surface, where y ln r and z ln r are zero
    logs = [0.5 * np.log(np.maximum(y * y + z * z, 1e-300)) for y in offsets]
    angle, log = _bent(angles), _bent(logs)
    angle_moment = _bent([y * a for y, a in zip(offsets, angles, strict=True)])
    log_moment = _bent([y * a for y, a in zip(offsets, logs, strict=True)])
    sums = [
        (angle_moment + 2.0 * z * log) @ line.load,
        angle_moment @ line.load,
        -(z * angle) @ line.load,
        (3.0 * z * angle - 2.0 * log_moment) @ line.load,
    ]
    return np.array(sums) / (np.pi * line.pitch)


def _bent(at: list[np.ndarray]) -> np.ndarray:
    return at[0] - 2.0 * at[1] + at[2]


def field_times(elements: int, levels: int, repeats: int) -> list[StressTime]:
    """A field on the `elements` hats' own columns and `levels` down to a half-width."""
    line = rough_line(elements)
    depths = np.linspace(0.0, 1.0, levels)
    window = (line.nodes[0], line.nodes[-1])
    field = partial(stress_field, line.nodes, line.load, FRICTION, window, depths)
    first, _ = harness.timed(field, 1)
    seconds, found = harness.timed(field, 5 * repeats)
    x, z = (a.ravel() for a in np.meshgrid(line.nodes, depths))
    summing, summed = harness.timed(partial(direct, line, x, z), repeats)
    return [
        StressTime("direct sum", summing, _difference(line, x, z, summed)),
        StressTime("convolution", seconds, _difference(line, x, z, _stacked(found.stress))),
        StressTime("convolution, first call of the process", first),
    ]


def _difference(line: LoadedLine, x: np.ndarray, z: np.ndarray, found: np.ndarray) -> float:
    """To the sum over all elements in the form that keeps each one's digits, on some points."""
    some = np.random.default_rng(9).permutation(len(x))[:CHECKED_POINTS]
    expected = _stacked(_with_friction(direct_stress(line, x[some], z[some])))
    return float(np.abs(found[:, some] - expected).max() / np.abs(expected).max())


def _with_friction(parts: np.ndarray) -> StressState:
    return FrictionStress(StressState(*parts[:3]), parts[3]).at(FRICTION)


def _stacked(stress: StressState) -> np.ndarray:
    return np.array([np.ravel(getattr(stress, name)) for name in ("sx", "sz", "txz")])


def demands(rows: list[StressTime]) -> list[harness.Demand]:
    """Demands on the rows of `field_times`."""
    by_name = {row.name: row for row in rows}
    ours, sums = by_name["convolution"], by_name["direct sum"]
    ratio, off = sums.seconds / ours.seconds, ours.difference
    faster = f"field: {ratio:.3g} times faster than the {sums.name}, wanted {WANTED:g}"
    exact = f"field: off by {off:.1e} of the largest stress, allowed {CLOSE:g}"
    exact += f" ({sums.name}: {sums.difference:.1e})"
    return [harness.Demand(ratio >= WANTED, faster), harness.Demand(off <= CLOSE, exact)]


def main(arguments: list[str] | None = None) -> int:
    """Print the times and the demands; the exit status."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--elements", type=int, default=1024)
    parser.add_argument("--levels", type=int, default=100)
    parser.add_argument("--repeats", type=int, default=3)
    given = parser.parse_args(arguments)
    rows = field_times(given.elements, given.levels, given.repeats)
    ours = next(row.seconds for row in rows if row.name == "convolution")
    harness.print_table(
        f"{given.elements} x {given.levels} points from {given.elements} elements",
        ("way", "seconds", "ratio", "difference"),
        [
            (name, f"{seconds:.4g}", f"{seconds / ours:.3g}", "" if off is None else f"{off:.1e}")
            for name, seconds, off in rows
        ],
    )
    return harness.print_demands(demands(rows))


if __name__ == "__main__":
    harness.run_on_one_thread(main)
