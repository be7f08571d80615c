"""What a race of finite-element codes has shown: their times at equal error.

One ladder of one configuration is a curve of time over error. An error counts as reached from the
first mesh on after which no finer one exceeds it, so that a change of sign on the way is no merit.
Between meshes times are interpolated in logarithms of both; below the finest mesh's error a curve
has no time, above the coarsest mesh's it keeps that mesh's. A code's time is that of its best
curve.
"""

import math
import statistics
from collections.abc import Sequence
from dataclasses import dataclass

from comparisons.benchmarks.finite_element_peers.race import Point

TARGETS = {"pressure": (1e-1, 3e-2, 1e-2, 3e-3), "peak": (1e-2, 3e-3, 1e-3)}


@dataclass(frozen=True)
class Verdict:
    """Times of ours and one peer at one error, None where it is not reached.

    solve, whole  (ours, peer) [s], as in `Point`
    """

    case: str
    error: str
    target: float
    peer: str
    solve: tuple[float | None, float | None]
    whole: tuple[float | None, float | None]

    @property
    def ratio(self) -> float | None:
        """Time of the peer's solution over ours, where both reach the error."""
        return _ratio(self.solve)

    @property
    def whole_ratio(self) -> float | None:
        """The same of whole processes."""
        return _ratio(self.whole)

    @property
    def holds(self) -> bool:
        """Whether ours reaches the error where the peer does, and no later."""
        ours, peer = self.solve
        return peer is None or (ours is not None and ours <= peer)


def _ratio(times: tuple[float | None, float | None]) -> float | None:
    ours, peer = times
    return None if ours is None or peer is None else peer / ours


def time_at(curve: Sequence[tuple[float, float]], target: float) -> float | None:
    """Time at an error from (error, time) of a ladder, coarse to fine; None if not reached."""
    reached = [
        (max(error for error, _ in curve[rung:]), time) for rung, (_, time) in enumerate(curve)
    ]
    before = None
    for error, time in reached:
        if error <= target:
            if before is None or before[0] <= error:
                return time
            share = math.log(before[0] / target) / math.log(before[0] / error)
            return before[1] * (time / before[1]) ** share
        before = error, time
    return None


def best_time(points: Sequence[Point], error: str, target: float, what: str) -> float | None:
    """Least time `what`, "solve" or "whole", of all curves of one code at an error."""
    curves: dict[tuple[str, float], list[Point]] = {}
    for point in sorted(points, key=lambda point: point.edges):
        curves.setdefault((point.how, point.growth), []).append(point)
    times = [
        time_at([(point.errors[error], getattr(point, what)) for point in curve], target)
        for curve in curves.values()
    ]
    return min((time for time in times if time is not None), default=None)


def verdicts(case: str, points: Sequence[Point], ours: str) -> list[Verdict]:
    """Ours beside each peer on one case, at every error of TARGETS that one of them reaches."""
    of = {
        name: [p for p in points if p.code == name]
        for name in dict.fromkeys(p.code for p in points)
    }
    found = []
    for peer in of:
        if peer == ours:
            continue
        for error, targets in TARGETS.items():
            for target in targets:
                solve, whole = (
                    tuple(best_time(of.get(name, []), error, target, what) for name in (ours, peer))
                    for what in ("solve", "whole")
                )
                if solve != (None, None):
                    found.append(Verdict(case, error, target, peer, solve, whole))
    return found


def medians(found: Sequence[Verdict]) -> dict[str, tuple[float, float]]:
    """By peer, the median ratios of solutions and of whole processes where both reach the error."""
    table = {}
    for peer in dict.fromkeys(verdict.peer for verdict in found):
        both = [v for v in found if v.peer == peer and v.ratio is not None]
        if both:
            table[peer] = (
                statistics.median(v.ratio for v in both),
                statistics.median(v.whole_ratio for v in both),
            )
    return table
