"""Observed orders of convergence, of many contacts together.

Of one contact the error goes to and fro with where the edge falls between two nodes; the root mean
square over contacts with different numbers of elements falls like a power of the element size.
"""

from collections.abc import Iterable, Sequence

import numpy as np

from comparisons.studies.verify.checks import Check, order_check
from comparisons.studies.verify.pairs import Pair, Solved

# ExpectedCost order and how far the observed one may lie from it, both ways. Hertz's contact: the
# figures of smooth fields have order 2, of the edge's place 1, of the pressure in L2 1, by the
# square root at the edge. Another choice of 18 contacts was seen to change the orders by up to 0.4.
EXPECTED = {
    ("half_plane", "peak_pressure"): (2.0, 0.5),
    ("half_plane", "contact_length"): (1.0, 0.4),
    ("half_plane", "tau1_max"): (2.0, 0.5),
    ("half_plane", "txz_max_abs"): (2.0, 0.5),
    ("finite_element", "peak_pressure"): (2.0, 0.5),
    ("finite_element", "contact_length"): (1.0, 0.5),
    ("finite_element", "txz_max_abs"): (2.0, 0.6),
}
PRESSURE_ORDER = {"half_plane": (1.0, 0.15), "finite_element": (1.0, 0.2)}
FEWEST = 16  # contacts, for a mean that says something
REFERENCE = "Hertz 1882; Smith and Liu 1953"


def observed_order(errors: Sequence[Sequence[float]]) -> float:
    """Mean order from the first to the last level of errors (cases, levels)."""
    square = np.sqrt(np.mean(np.square(errors), axis=0))
    return float(np.log2(square[0] / square[-1]) / (len(square) - 1))


def figure_orders(pairs: Iterable[Pair]) -> list[Check]:
    """Of the figures of Hertz's contact, where there are enough of them."""
    pairs, found = list(pairs), []
    for (model, quantity), (expected, margin) in EXPECTED.items():
        errors = [
            [(value - pair.exact) / pair.scale for value in pair.levels]
            for pair in pairs
            if (pair.kind, pair.model, pair.quantity) == ("Hertz", model, quantity)
        ]
        if len(errors) >= FEWEST:
            name = f"{model}, {quantity}, {len(errors)} contacts"
            order = observed_order(errors)
            found.append(order_check("order", name, REFERENCE, order, expected, margin))
    return found


def pressure_orders(solved: Iterable[tuple[str, Solved]]) -> list[Check]:
    """Of the pressures' L2 errors, by model."""
    solved, found = list(solved), []
    for model, (expected, margin) in PRESSURE_ORDER.items():
        errors = [s.pressure_errors for m, s in solved if m == model and s.pressure_errors]
        if len(errors) >= FEWEST:
            name = f"{model}, pressure in L2, {len(errors)} contacts"
            order = observed_order(errors)
            found.append(order_check("order", name, "the exact pressure", order, expected, margin))
    return found
