"""Backward errors and condition numbers of the half-plane's algebra: direct solvers, FFT products.

Ratios as in LAPACK's own tests (`backward_error`), for the ordinary grid and for the matrices of
worst condition: many nodes, incompressible layers, coatings of high contrast."""

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from analytic.layers.layered import LayeredBody
from analytic.layers.operator import LayeredSurface
from analytic.material import Material
from analytic.operators.convolution import Convolution
from analytic.operators.half_plane import HalfPlane
from analytic.operators.tangential import CoupledHalfPlane
from comparisons.campaigns.cases import CONDITION, CaseFigures, account, bounded
from comparisons.campaigns.robustness.backward_error import THRESHOLD, backward_ratio

ELASTOMER = LayeredBody(Material(1.0, 0.5 - 1e-9), 0.02, "bonded")
COATED = LayeredBody(Material(1e6, 0.3), 1.0, Material(1.0, 0.3))
OPERATORS: dict[str, Callable[[int], Convolution]] = {
    "half-plane": partial(HalfPlane, pitch=1.0, modulus=1.0),
    "elastomer": partial(LayeredSurface, pitch=0.05, body=ELASTOMER),
    "stiff coating": partial(LayeredSurface, pitch=1e-3, body=COATED),
    "sliding": partial(CoupledHalfPlane, pitch=1.0, modulus=1.0, friction_dundurs=1.0),
}


def direct_findings(operator: str, count: int, nodes: Sequence[int] | None = None) -> CaseFigures:
    """Nodes from the first to the second of `nodes`, or 120 scattered ones."""
    made, rng = OPERATORS[operator](count), np.random.default_rng(1)
    scattered = np.flatnonzero(np.random.default_rng(4).uniform(size=1000) < 0.1)[:120]
    nodes = np.arange(*nodes) if nodes else scattered
    right = rng.standard_normal((len(nodes), 2)) * made.column[0]
    matrix = made.block(nodes)
    solution = made.solve(nodes, right)
    ratio = np.inf if solution is None else backward_ratio(matrix, solution, right)
    figure = bounded("backward error", ratio, THRESHOLD, "LAPACK's test ratio")
    return figure, account(CONDITION, "dense", np.linalg.cond(matrix))


def product_findings(operator: str, count: int, single: bool = False) -> CaseFigures:
    """A product by FFT against one in longer numbers, row by row; `single` with 32-bit pressures.
    The ratio grows like log n at most, which THRESHOLD leaves room for."""
    made = OPERATORS[operator](count)
    kind = np.float32 if single else float
    pressure = np.random.default_rng(2).uniform(0.0, 1.0, count).astype(kind)
    rows = np.unique(np.linspace(0, count - 1, 64).astype(int))
    distance = rows[:, None] - np.arange(count)
    matrix = np.where(distance >= 0, made.column[abs(distance)], made.row[abs(distance)])
    exact = matrix.astype(np.longdouble) @ pressure.astype(np.longdouble)
    norm = float(np.abs(matrix).sum(axis=1).max())
    error = np.abs(made.apply(pressure)[rows] - exact).max()
    ratio = float(error / (norm * np.abs(pressure).max() * float(np.finfo(kind).eps)))
    reference = "LAPACK's test ratio, 32 bits" if single else "LAPACK's test ratio"
    return (bounded("error of the product", ratio, THRESHOLD, reference),)
