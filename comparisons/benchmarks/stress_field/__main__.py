"""Time of subsurface stresses against direct summation, one thread, in seconds of its processor.

    python -m comparisons.benchmarks.stress_field

A field on a grid by convolution (`analytic.stress.field`) and scattered points by the tree
(`analytic.stress.tree`), both beside the sums of `comparisons.benchmarks.stress_field.direct`.

Exit status 0 only if the field takes at most 1/300 of the time of the textbook's sum over hats, the
closed form of every element at every point, and differs by no more than 1e-12 of the largest stress
from a sum that keeps each element's digits. The textbook's own error is printed beside it.
"""

import argparse
import os
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from analytic.exact.hertz import hertz_from_peak_pressure
from analytic.stress.convolution import circle
from analytic.stress.elements import FrictionStress
from analytic.stress.field import friction_field, stress_field
from analytic.stress.points import stress_at
from analytic.stress.tree import direct_stress
from analytic.stress_state import StressState
from comparisons.benchmarks.stress_field.direct import FRICTION, direct, hats, shared_nodes, strips

_BLOCK = 2**15  # values of a kernel at a time
_DIRECT_POINTS = 2048  # scattered points summed directly, the time scaled to all
_CHECKED_POINTS = 500  # whose stresses are compared
_TEXTBOOK, _OURS = "direct sum, hats", "convolution"
WANTED = 300.0  # times faster than the textbook's sum
CLOSE = 1e-12  # of the largest stress, between the field and the sum that keeps all digits
_T = TypeVar("_T")


@dataclass(frozen=True)
class Row:
    """One way, its median `seconds`, and its largest `difference` over the largest stress.

    From a sum of the same elements that keeps every digit; None for other elements.
    """

    name: str
    seconds: float
    difference: float | None = None


@dataclass(frozen=True)
class Verdict:
    """One demand on the field, and whether it holds."""

    holds: bool
    text: str


def verdicts(rows: list[Row]) -> list[Verdict]:
    """Demands on the rows of `field_rows`."""
    by_name = {row.name: row for row in rows}
    ours, textbook = by_name[_OURS], by_name[_TEXTBOOK]
    ratio = textbook.seconds / ours.seconds
    return [
        Verdict(
            ratio >= WANTED,
            f"field: {ratio:.3g} times faster than the {_TEXTBOOK}, wanted {WANTED:g}",
        ),
        Verdict(
            ours.difference is not None and ours.difference <= CLOSE,
            f"field: off by {ours.difference:.1e} of the largest stress, allowed {CLOSE:g}"
            f" (the {_TEXTBOOK}: {textbook.difference:.1e})",
        ),
    ]


def rough_load(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Nodes from -1 to 1 half-widths and Hertz's pressure with seeded noise [p0]."""
    nodes = np.linspace(-1.0, 1.0, count + 2)[1:-1]
    noise = np.random.default_rng(7).uniform(0.5, 1.5, count)
    return nodes, hertz_from_peak_pressure(1.0, 1.0, 2.0).pressure(nodes) * noise


def field_rows(elements: int, levels: int, repeats: int) -> list[Row]:
    """A field on the `elements` hats' own columns and `levels` down to a half-width."""
    nodes, load = rough_load(elements)
    depths = np.linspace(0.0, 1.0, levels)
    window = (nodes[0], nodes[-1])

    def field() -> StressState:
        return stress_field(nodes, load, FRICTION, window, depths).stress

    def every_friction() -> FrictionStress:
        return friction_field(nodes, load, window, depths).stress

    first, _ = _timed(field, 1)
    cold, found = _timed(field, 5 * repeats)
    every, _ = _timed(every_friction, 5 * repeats)
    kernels = _kernel_seconds(elements, depths * (elements + 1) / 2.0, 5 * repeats)
    x, z = (a.ravel() for a in np.meshgrid(nodes, depths))
    return [
        *_direct_rows(nodes, load, x, z, len(x), repeats),
        Row(_OURS, cold, _difference(nodes, load, x, z, _stacked(found))),
        Row("convolution, for every friction", every),
        Row("convolution, first call of the process", first),
        Row("convolution, of it the kernels", kernels),
        Row("convolution, the kernels at hand", cold - kernels),
    ]


def point_rows(elements: int, points: int, repeats: int) -> list[Row]:
    """Scattered points, as many shallow as deep, from the surface to a half-width."""
    nodes, load = rough_load(elements)
    rng = np.random.default_rng(8)
    x = rng.uniform(-1.5, 1.5, points)
    z = np.where(rng.random(points) < 0.5, rng.random(points), 10.0 ** rng.uniform(-7, 0, points))
    seconds, found = _timed(lambda: stress_at(nodes, load, FRICTION, x, z), 2 * repeats)
    few = min(points, _DIRECT_POINTS)
    return [
        *_direct_rows(nodes, load, x, z, few, repeats),
        Row("tree", seconds, _difference(nodes, load, x, z, _stacked(found))),
    ]


def _direct_rows(
    nodes: np.ndarray, load: np.ndarray, x: np.ndarray, z: np.ndarray, count: int, repeats: int
) -> list[Row]:
    """The three forms on the first `count` points, their time scaled to all."""
    rows = []
    for name, terms in (("hats", hats), ("strips", strips), ("nodes", shared_nodes)):
        seconds, found = _timed(
            lambda terms=terms: direct(terms, nodes, load, x[:count], z[:count]), repeats
        )
        off = _difference(nodes, load, x[:count], z[:count], found) if terms is not strips else None
        rows.append(Row(f"direct sum, {name}", seconds * len(x) / count, off))
    return rows


def _kernel_seconds(elements: int, depths: np.ndarray, repeats: int) -> float:
    def kernels() -> None:
        closed = circle(depths, elements, 0, elements - 1, 1, 1, "hat")
        step = max(1, _BLOCK // closed.length)
        for start in range(0, len(depths), step):
            closed.spectra(slice(start, min(start + step, len(depths))))

    return _timed(kernels, repeats)[0]


def table(title: str, rows: list[Row], quickest: str) -> str:
    """Rows as text, each with its time over that of the row named `quickest`."""
    base = next(row.seconds for row in rows if row.name == quickest)
    lines = [title, f"{'':50}  {'seconds':>9}  {'ratio':>7}  difference"]
    for row in rows:
        off = "" if row.difference is None else f"{row.difference:.1e}"
        lines.append(f"{row.name:50}  {row.seconds:9.4g}  {row.seconds / base:7.3g}  {off:>10}")
    return "\n".join(lines)


def main(arguments: list[str] | None = None) -> int:
    """Print both tables and what they show; the exit status."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--elements", type=int, default=1024)
    parser.add_argument("--levels", type=int, default=100)
    parser.add_argument("--point-elements", type=int, default=4096)
    parser.add_argument("--points", type=int, default=100_000)
    parser.add_argument("--repeats", type=int, default=3)
    given = parser.parse_args(arguments)
    rows = field_rows(given.elements, given.levels, given.repeats)
    size = f"{given.elements} x {given.levels} points from {given.elements} elements"
    print(table(f"Field of {size}", rows, _OURS))
    found = verdicts(rows)
    rows = point_rows(given.point_elements, given.points, given.repeats)
    few = min(given.points, _DIRECT_POINTS)
    size = f"{given.points} scattered points from {given.point_elements} elements"
    print("\n" + table(f"{size}; direct sums scaled from {few} of them", rows, "tree") + "\n")
    for verdict in found:
        print("holds " if verdict.holds else "FAILS ", verdict.text)
    wrong = sum(not verdict.holds for verdict in found)
    print(f"{wrong} demands fail" if wrong else "all demands hold")
    return 1 if wrong else 0


def _stacked(stress: StressState) -> np.ndarray:
    return np.array([np.ravel(getattr(stress, name)) for name in ("sx", "sz", "txz")])


def _difference(
    nodes: np.ndarray, load: np.ndarray, x: np.ndarray, z: np.ndarray, found: np.ndarray
) -> float:
    """To the sum over all elements in the form that keeps each one's digits, on some points."""
    some = np.random.default_rng(9).permutation(len(x))[:_CHECKED_POINTS]
    pitch = (nodes[-1] - nodes[0]) / (len(nodes) - 1)
    parts = direct_stress(nodes, load, pitch, x[some], z[some], "hat")
    expected = _stacked(FrictionStress(StressState(*parts[:3]), parts[3]).at(FRICTION))
    return float(np.abs(found[:, some] - expected).max() / np.abs(expected).max())


def _timed(work: Callable[[], _T], repeats: int) -> tuple[float, _T]:
    """Median seconds of this thread, which neighbours on the machine disturb least."""
    spent = []
    for _ in range(repeats):
        start = time.thread_time()
        found = work()
        spent.append(time.thread_time() - start)
    return float(np.median(spent)), found


if __name__ == "__main__":
    if os.environ.get("OMP_NUM_THREADS") != "1":
        # numpy's own threads are counted when it is imported.
        os.environ["OMP_NUM_THREADS"] = "1"
        os.execv(
            sys.executable,
            [sys.executable, "-m", "comparisons.benchmarks.stress_field", *sys.argv[1:]],
        )
    sys.exit(main())
