"""Backward errors and condition numbers of the half-plane's algebra: direct solvers, FFT products.

Ratios as in LAPACK's own tests (`backward_error`), for the ordinary grid and for the matrices of
worst condition: many nodes, incompressible layers, coatings of high contrast.
"""

from collections.abc import Callable
from functools import partial

import numpy as np

from analytic.layers.layered import LayeredBody
from analytic.layers.operator import LayeredSurface
from analytic.material import Material
from analytic.operators.convolution import Convolution
from analytic.operators.half_plane import DenseCompliance, HalfPlane
from analytic.operators.tangential import CoupledHalfPlane
from comparisons.studies.checks import BoundedFigure, Findings, Groups
from comparisons.studies.robustness.backward_error import THRESHOLD, backward_ratio
from comparisons.studies.robustness.loaded_contact import deviation


def direct_findings(make: Callable[[], Convolution], nodes: np.ndarray) -> Findings:
    operator = make()
    rng = np.random.default_rng(1)
    right = rng.standard_normal((len(nodes), 2)) * operator.column[0]
    matrix = operator.block(nodes)
    found = operator.solve(nodes, right)
    ratio = np.inf if found is None else backward_ratio(matrix, found, right)
    figure = BoundedFigure("backward error", ratio, THRESHOLD, "LAPACK's test ratio")
    return Findings((figure,), condition=float(np.linalg.cond(matrix)))


def product_findings(make: Callable[[], Convolution], single: bool = False) -> Findings:
    """A product by FFT against one in longer numbers, row by row; `single` with 32-bit pressures.

    The ratio grows like log n at most, which THRESHOLD leaves room for.
    """
    operator = make()
    count = operator.count
    kind = np.float32 if single else float
    pressure = np.random.default_rng(2).uniform(0.0, 1.0, count).astype(kind)
    rows = np.unique(np.linspace(0, count - 1, 64).astype(int))
    distance = rows[:, None] - np.arange(count)
    matrix = np.where(distance >= 0, operator.column[abs(distance)], operator.row[abs(distance)])
    exact = matrix.astype(np.longdouble) @ pressure.astype(np.longdouble)
    norm = float(np.abs(matrix).sum(axis=1).max())
    error = np.abs(operator.apply(pressure)[rows] - exact).max()
    ratio = float(error / (norm * np.abs(pressure).max() * float(np.finfo(kind).eps)))
    reference = "LAPACK's test ratio, 32 bits" if single else "LAPACK's test ratio"
    return Findings((BoundedFigure("error of the product", ratio, THRESHOLD, reference),))


def dense_findings() -> Findings:
    """A compliance of lower rank than the number of hats must still be inverted."""
    coarse = HalfPlane(40, 4.0, 1.0).block(np.arange(40))
    offset = np.arange(160)[:, None] - (4 * np.arange(40) + 3)
    spread = np.maximum(0.0, 1.0 - np.abs(offset) / 4.0)
    operator = DenseCompliance(spread @ coarse @ spread.T)
    pressure = np.random.default_rng(3).uniform(size=160)
    displacement = operator.apply(pressure)
    again = operator.apply(operator.precondition(displacement))
    figure = deviation(again, displacement, "displacement given back", 1e-6, "the given one")
    return Findings((figure,), condition=float(np.linalg.cond(operator.matrix)))


def cases() -> Groups:
    elastomer = LayeredBody(Material(1.0, 0.5 - 1e-9), 0.02, "bonded")
    coated = LayeredBody(Material(1e6, 0.3), 1.0, Material(1.0, 0.3))
    scattered = np.flatnonzero(np.random.default_rng(4).uniform(size=1000) < 0.1)[:120]
    half_plane = partial(HalfPlane, pitch=1.0, modulus=1.0)
    soft_layer = partial(LayeredSurface, pitch=0.05, body=elastomer)
    coating = partial(LayeredSurface, pitch=1e-3, body=coated)
    sliding = partial(CoupledHalfPlane, pitch=1.0, modulus=1.0, friction_dundurs=1.0)
    direct = {
        "half-plane, 120 scattered nodes": (partial(half_plane, 1000), scattered),
        "half-plane, 240 nodes in a row": (partial(half_plane, 1000), np.arange(300, 540)),
        "incompressible layer, 240 nodes in a row": (partial(soft_layer, 400), np.arange(80, 320)),
        "stiff coating, 120 nodes in a row": (partial(coating, 400), np.arange(100, 220)),
        "sliding, mu beta = 1, 120 scattered nodes": (partial(sliding, 1000), scattered),
    }
    products = {
        "product, 4096 nodes": (partial(half_plane, 4096),),
        "product, 65536 nodes": (partial(half_plane, 65_536),),
        "product, 32 bits": (partial(half_plane, 4096), True),
        "product, incompressible layer": (partial(soft_layer, 4096),),
        "product, sliding, mu beta = 1": (partial(sliding, 4096),),
    }
    named = {name: partial(direct_findings, *given) for name, given in direct.items()}
    named |= {name: partial(product_findings, *given) for name, given in products.items()}
    named["more hats than what deforms"] = dense_findings
    return {"algebra": named}
