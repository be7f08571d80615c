"""Rough sphere (Greenwood and Tripp 1967) and rough cylinder: summits on a body that gives way.

Every point bears as a nominally flat surface there (`analytic.statistics.nominally_flat`), and its
pressure sinks the bulk as an elastic half-space: a compact nonlinear integral equation, solved by
Newton's method.

    R radius of the body [m]     r  distance from its centre or axis [m]   P load [N] or [N/m]
    rho = r / sqrt(2 R s)        p* = p / (E* sqrt(s / 8R)) = m F_3/2(h)   h = d + rho^2 + w
    m = (8/3) eta s sqrt(2 R beta)
    sphere    T = 2P/(s E* sqrt(2 R s)) = integral 2 pi rho p* drho,  w = (1/2pi) integral p*/|.| dA
              smooth: a = (3T/16)^(1/3), peak (8/pi) a
    cylinder  T = 2P/(s E*) = integral p* drho over both sides,  w = -(1/pi) integral p* ln|.| drho
              smooth: a = sqrt(T/pi), peak 2 a

The cylinder's d has the log kernel's datum, sqrt(2 R s); its h has none."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.polynomial.legendre import leggauss, legvander
from scipy.optimize import brentq

from analytic.numerics import check_positive
from analytic.statistics.nominally_flat import Summits, tail_integral

Shape = Literal["sphere", "cylinder"]

# And four more for every sqrt(2 R s) of the smooth contact, whose edge is sharper.
NODES = {"sphere": 150, "cylinder": 80}
BEYOND = 3.5  # beyond the smooth contact, where h exceeds 10 and nothing bears
WIDEST = 200.0  # sqrt(2 R s)
FARTHEST = 1e5  # below the mean plane that the search of a start may go
LARGEST_STEP = 1.0  # of Newton's method, in h or its half where that is more
STEPS, SETTLED = 200, 1e-12


@dataclass(frozen=True)
class RoughContact:
    """Dimensionless, or in SI: `pressure` (n,) at `rho` (n,) >= 0, separations `h` (n,) over s."""

    smooth: tuple[float, float]  # half-width or radius, and peak pressure, of the smooth body
    rho: np.ndarray
    steps: np.ndarray  # (n,) weights of integrals over rho
    h: np.ndarray
    pressure: np.ndarray
    # of the smooth contact with the same mean |r| of pressure on a central line: (3 pi/4) <rho>
    effective_width: float
    mean_real_pressure: float  # load over real area, in E* sqrt(s / beta) or [Pa]
    d: float  # of the module, dimensionless


def rough_cylinder(load: float, radius: float, modulus: float, summits: Summits) -> RoughContact:
    """Line contact in SI under P [N/m] of R [m], E* [Pa]; raises as `rough_contact` does."""
    check_positive(load=load, radius=radius, modulus=modulus)
    s = summits.deviation
    unit = rough_contact("cylinder", 2.0 * load / (s * modulus), bearing_of(summits, radius))
    length = float(np.sqrt(2.0 * radius * s))
    stress = modulus * float(np.sqrt(s / (8.0 * radius)))
    return replace(
        unit,
        smooth=(length * unit.smooth[0], stress * unit.smooth[1]),
        rho=length * unit.rho,
        steps=length * unit.steps,
        pressure=stress * unit.pressure,
        effective_width=length * unit.effective_width,
        mean_real_pressure=modulus * float(np.sqrt(s / summits.radius)) * unit.mean_real_pressure,
    )


def bearing_of(summits: Summits, radius: float) -> float:
    """m of a body of radius R [m] with these summits."""
    root = np.sqrt(2.0 * radius * summits.radius)
    return float(8.0 / 3.0 * summits.density * summits.deviation * root)


def smooth_contact(shape: Shape, load: float) -> tuple[float, float]:
    """Hertz's radius or half-width and peak pressure, dimensionless."""
    if shape == "sphere":
        a = float(np.cbrt(3.0 * load / 16.0))
        return a, 8.0 / np.pi * a
    a = float(np.sqrt(load / np.pi))
    return a, 2.0 * a


def rough_contact(shape: Shape, load: float, bearing: float) -> RoughContact:
    """Solve for T = `load` and m = `bearing`. Raises ValueError unless both are positive and the
    smooth contact is at most WIDEST, and ArithmeticError where Newton's method fails."""
    check_positive(load=load, bearing=bearing)
    a, peak = smooth_contact(shape, load)
    if a > WIDEST:
        raise ValueError(
            f"the roughness hardly shows: the smooth contact is {a:.3g} times sqrt(2 R s) wide; "
            f"allowed is up to {WIDEST:g}"
        )
    reach, nodes = a + BEYOND, NODES[shape] + int(4.0 * a)
    bulk = (_sphere if shape == "sphere" else _cylinder)(reach, nodes)
    smooth = peak * np.sqrt(np.maximum(1.0 - (bulk.rho / a) ** 2, 0.0))
    sunk = bulk.rho**2 + bulk.deflection @ smooth

    def excess(d: float) -> float:
        return np.log(bearing / load * (bulk.weights @ tail_integral(1.5, d + sunk)))

    d = brentq(excess, -FARTHEST - sunk.min(), 30.0 - sunk.min(), xtol=1e-3)
    *h, d = _newton(bulk, np.append(sunk + d, d), load, bearing)
    x, steps = leggauss(nodes)
    rho, steps = np.append(0.0, 0.5 * reach * (1.0 + x)), np.append(0.0, 0.5 * reach * steps)
    h = bulk.interpolated(np.array(h), rho)
    pressure = bearing * tail_integral(1.5, h)
    along = steps * pressure
    measure = steps * (2.0 * np.pi * rho if shape == "sphere" else 2.0)
    real = float(measure @ tail_integral(1.0, h))
    return RoughContact(
        *((a, peak), rho, steps, h, pressure),
        effective_width=float(0.75 * np.pi * (along @ rho) / along.sum()),
        mean_real_pressure=4.0 / (3.0 * np.pi) * load / bearing / real,
        d=float(d),
    )


def _newton(bulk: "_Bulk", unknown: np.ndarray, load: float, bearing: float) -> np.ndarray:
    """Separations at the nodes, and d (n + 1,), from some nearby."""
    n = len(unknown) - 1
    matrix = np.zeros((n + 1, n + 1))
    for _ in range(STEPS):
        h = unknown[:n]
        pressure, slope = bearing * tail_integral(1.5, h), -1.5 * bearing * tail_integral(0.5, h)
        carried = bulk.weights @ pressure
        apart = h - unknown[n] - bulk.rho**2 - bulk.deflection @ pressure
        matrix[:n, :n] = np.eye(n) - bulk.deflection * slope
        matrix[:n, n] = -1.0
        matrix[n, :n] = bulk.weights * slope / carried
        step = np.linalg.solve(matrix, -np.append(apart, np.log(carried / load)))
        size, most = np.abs(step[:n]).max(), max(LARGEST_STEP, 0.5 * np.abs(h).max())
        unknown = unknown + step * min(1.0, most / size)
        if size < SETTLED * (1.0 + np.abs(unknown).max()):
            return unknown
    raise ArithmeticError(f"no rough contact found at T = {load:g}, m = {bearing:g}")


@dataclass(frozen=True)
class _Bulk:
    """Nodes `rho` (n,) >= 0 within a reach, `weights` of integrals over the area or both sides, and
    `deflection` (n, n) from pressures that vanish there; `interpolated` takes values at the nodes
    to those at other points."""

    rho: np.ndarray
    weights: np.ndarray
    deflection: np.ndarray
    interpolated: Callable[[np.ndarray, np.ndarray], np.ndarray]


def _cylinder(reach: float, nodes: int) -> _Bulk:
    """Bulk of a cylinder. With rho = L cos t, ln|cos t - cos u| = -ln 2 - sum (2/k) cos kt cos ku:
    in the cosines of p* L sin t, smooth as p* is zero at its ends, the log kernel is diagonal. By
    symmetry the nodes of 0 < t < pi/2 and the even k are all."""
    t = 0.5 * np.pi * (np.arange(nodes) + 0.5) / nodes
    even = 2.0 * np.arange(nodes)
    cosines = np.cos(np.outer(t, even))
    weights = np.pi / nodes * reach * np.sin(t)
    factor = np.append(-np.log(0.5 * reach), 2.0 / even[1:]) / np.pi

    def interpolated(values: np.ndarray, rho: np.ndarray) -> np.ndarray:
        share = cosines.T @ values * np.where(even == 0.0, 1.0, 2.0) / nodes
        return np.cos(np.outer(np.arccos(rho / reach), even)) @ share

    return _Bulk(reach * np.cos(t), weights, (cosines * factor) @ cosines.T * weights, interpolated)


def _sphere(reach: float, nodes: int) -> _Bulk:
    """Polynomials in rho^2, and Copson's two steps (Sneddon 1966, section 3.2):

    g(t) = integral over v > 0 of p*(sqrt(t^2 + v^2)),   w = (2/pi) integral over 0 .. pi/2 of
    g(rho sin u), both by Gauss' rule."""
    x, gauss = leggauss(nodes)
    rho, u, share = reach * np.sqrt(0.5 * (1.0 + x)), 0.5 * (1.0 + x), 0.5 * gauss

    def basis(square: np.ndarray) -> np.ndarray:
        """Legendre polynomials (…, n) of rho^2."""
        return legvander(2.0 * square / reach**2 - 1.0, nodes - 1)

    to_basis = (np.arange(nodes)[:, None] + 0.5) * basis(rho**2).T * gauss
    height = np.sqrt((reach - rho) * (reach + rho))[:, None]
    line = height * np.einsum("j,ijk->ik", share, basis(rho[:, None] ** 2 + (height * u) ** 2))
    arc = np.einsum("j,ijk->ik", share, basis((rho[:, None] * np.sin(0.5 * np.pi * u)) ** 2))

    def interpolated(values: np.ndarray, rho: np.ndarray) -> np.ndarray:
        return basis(rho**2) @ (to_basis @ values)

    deflection = (arc @ to_basis) @ (line @ to_basis)
    return _Bulk(rho, 0.5 * np.pi * reach**2 * gauss, deflection, interpolated)
