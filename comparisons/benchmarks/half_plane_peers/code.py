"""What a code under comparison offers: a name, its discretisation, and a way to solve a case."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from comparisons.benchmarks.half_plane_peers.cases import Case


@dataclass(frozen=True)
class Answer:
    """Pressures (n,) [Pa] at the nodes, and the steps taken, where the code tells."""

    pressure: np.ndarray
    steps: int | None


@dataclass(frozen=True)
class Code:
    """One configuration of one code.

    name        for the table
    element     "hat", "strip" or "point": the discretisation it declares
    solve       case, tolerance and most steps to an Answer; operators it may keep from call to call
    tolerances  of the code's own stopping criterion, loosest first; a single one where it has none
    count       as `solve`, where its answers lack the steps: a slower run that counts them
    """

    name: str
    element: str
    solve: Callable[[Case, float, int], Answer]
    tolerances: tuple[float, ...] = (0.0,)
    count: Callable[[Case, float, int], int] | None = None


class AbsentError(Exception):
    """A peer is not installed; the message says how to get it."""


def decades(first: int, last: int) -> tuple[float, ...]:
    """10^first, 10^(first - 1), …, 10^last."""
    return tuple(10.0**power for power in range(first, last - 1, -1))
