"""How far a figure from a sequence of refined grids may be from its limit.

Each level halves the element size of the one before. From the last three values f3, f2, f1
(finest last) follow the observed order p and the grid convergence index (Roache 1998, chapter 5;
order limited as in Eça and Hoekstra 2014):

    d21 = f1 - f2, d32 = f2 - f3     p = log2(d32 / d21)     U = F |d| / (2^p - 1)

with p limited to [LOWEST_ORDER, formal order] and d the larger of |d21| and |d32| / 2^formal, so
that two values which happen to agree do not pass for convergence. F is 1.25 for a monotone
sequence of an order in that range, 3 otherwise. An oscillating sequence gets its range, and a
sequence that has settled to round-off gets what is left of its differences.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

LOWEST_ORDER = 0.5
SETTLED = 1e-12  # relative differences below this are round-off
ORDER_MARGIN = 0.25  # an order this little above the formal one is still regular

Behaviour = Literal[
    "settled", "monotone", "irregular", "oscillating", "diverging", "too few levels"
]


@dataclass(frozen=True)
class Convergence:
    """A figure's limit under refinement.

    value        on the finest level, in the figure's unit
    limit        Richardson's value where the sequence is monotone, else `value`
    uncertainty  of `value`, absolute; infinite when fewer than three levels are known
    order        observed order, None where it has no meaning
    behaviour    how the last three values follow each other
    """

    value: float
    limit: float
    uncertainty: float
    order: float | None
    behaviour: Behaviour


def grid_convergence(values: Sequence[float], formal_order: float) -> Convergence:
    """Convergence of `values` (coarse to fine, each level of half the size)."""
    value = float(values[-1])
    if len(values) < 3:
        return Convergence(value, value, np.inf, None, "too few levels")
    coarse, middle, fine = (float(v) for v in values[-3:])
    last, before = fine - middle, middle - coarse
    scale = max(abs(coarse), abs(middle), abs(fine))
    if max(abs(last), abs(before)) <= SETTLED * scale:
        return Convergence(value, value, max(abs(last), abs(before)), None, "settled")
    if last * before < 0.0:
        spread = max(abs(last), abs(before))
        return Convergence(value, value, spread, None, "oscillating")
    change = max(abs(last), abs(before) / 2.0**formal_order)
    observed = np.log2(abs(before) / abs(last)) if last != 0.0 and before != 0.0 else None
    if observed is None:
        order, behaviour = LOWEST_ORDER if before == 0.0 else formal_order, "irregular"
    else:
        order = float(np.clip(observed, LOWEST_ORDER, formal_order))
        if observed <= 0.0:
            behaviour = "diverging"
        elif LOWEST_ORDER <= observed <= formal_order + ORDER_MARGIN:
            behaviour = "monotone"
        else:
            behaviour = "irregular"
    factor = 1.25 if behaviour == "monotone" else 3.0
    limit = fine + last / (2.0**order - 1.0) if behaviour == "monotone" else fine
    return Convergence(
        value,
        float(limit),
        float(factor * change / (2.0**order - 1.0)),
        None if observed is None else float(observed),
        behaviour,
    )
