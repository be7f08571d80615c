"""Temperatures in time: C dT/dt + A T = f(t), by Alexander's L-stable method of order 3.

Three stages Y_i of one matrix (1977, SIAM J. Numer. Anal. 14, 1006-1021, theorem 5), the last of
which is the new state: what oscillates too fast for the step s is damped at once. With d the root
of d^3 - 3 d^2 + 3/2 d - 1/6 in (1/6, 1/2), and a, c of the table below,

    (C + d s A) Y_i = C B_i + d s f(t + c_i s),   B_i = T + sum_{j<i} a_ij/d (Y_j - B_j)

One factorisation serves all steps of one size. C may be singular, as with two bodies in contact.
After a flux begins at once, with 16 steps to each doubling of the time, the surface's temperature
is right to 1e-4.
"""

from collections.abc import Callable, Iterator

import numpy as np
from scipy.sparse import csr_matrix

from fem.solver.mumps import Factor

DIAGONAL = 0.43586652150845899942
LAST = 0.25 * np.polyval([-6, 16, -1], DIAGONAL), 0.25 * np.polyval([6, -20, 5], DIAGONAL)
WEIGHTS = ((), (0.5 * (1.0 - DIAGONAL),), LAST)  # a, below the diagonal
SAME_STEP = 1e-9  # relative difference of steps that share a factor


def march(
    capacity: csr_matrix,
    matrix: csr_matrix,
    held: np.ndarray,
    load: Callable[[float], np.ndarray],
    times: np.ndarray,
    start: np.ndarray,
    symmetric: bool = False,
) -> Iterator[np.ndarray]:
    """Temperatures (n,) [K] at each of the ascending `times` (k,) [s], the `start` (n,) first.
    `load` gives the nodal heat (n,) [W/m] at a time; `held` (n,) components keep their start.
    Raises ValueError if the times do not ascend, FemError if the system cannot be factored."""
    if not np.all(np.diff(times) > 0.0):
        raise ValueError("times must ascend")
    free, state = ~held, np.array(start, dtype=float)
    kept = matrix[free][:, held] @ state[held]
    inner, stored = matrix[free][:, free], capacity[free][:, free]
    part, factor, before = state[free], None, 0.0
    yield state.copy()
    for begin, step in zip(times[:-1], np.diff(times), strict=True):
        weight = DIAGONAL * step
        if factor is None or abs(step - before) > SAME_STEP * step:
            factor, before = Factor((stored + weight * inner).tocsr(), symmetric), step
        rates: list[np.ndarray] = []
        for row in WEIGHTS:
            base = part + sum(a * rate for a, rate in zip(row, rates, strict=True))
            now = begin + step * (DIAGONAL + sum(row))
            heat = weight * (load(now)[free] - kept)
            stage = factor.solve(stored @ base + heat)
            rates.append((stage - base) / DIAGONAL)
        part = stage
        state[free] = part
        yield state.copy()
