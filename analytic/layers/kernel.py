"""Displacements of a layered body between two hats on a free line, without a period.

    h   pitch [m]               C    compliance of a wave k [m/Pa]      d   distance [pitches]
    t   thickness [m]           w    k t                                s   depth [m]
    G   of the layer [Pa]       m    2 G k C; m -> 1 + e at the surface, m0 where k = 0

    T(d) = (h^2/pi) int_0^inf C sinc^4(k h/2 pi) cos(k h d) dk

At large k the layer is a half-plane, at small k what it lies on is one, or nothing moves:

    2 G C = (1+e)/k + (m0 - 1 - e) e^-ks/k + t f(w),      f finite at 0, falling like e^-2w

The first two terms have closed forms, -ln|x| and -ln sqrt(x^2 + s^2) averaged over the hats, and
where m0 is not zero a datum; for uz under tractions, which is odd, angles take their place, pi/2
sign x and atan x/s. f is integrated numerically, on panels that halve towards w = 0 where a stiff
or soft layer has scales of its own. From two pitches on the path is turned into the complex plane,
where e^ikx decays and f has no poles. All but ln|x| is smooth, interpolated on doubling steps."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from analytic.layers.layered import Contrast, coupling, normal
from analytic.operators.elements import hat_galerkin
from analytic.operators.tangential import hat_sign

_ORDER = 24  # points of a panel, and of an interval of d; their errors stay below rounding
_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(_ORDER)
_FEW, _FEW_WEIGHTS = np.polynomial.legendre.leggauss(12)  # of a smooth function on half a hat
_HIGHEST = 32.0  # w beyond which e^-2w is nothing
_FADED = 1e6  # w (h/t)^(4/3) beyond which the integral of sinc^4 alone is below 1e-17
_TURN = np.exp(1j * np.pi / 6.0)  # of the path; the poles of f lie beyond 50 degrees
_SWING = 12.0  # phase of a cosine on one panel [rad]


@dataclass(frozen=True)
class _Response:
    """m/w of a load and a displacement: `share`(w), its m at the `surface` and in the `base`."""

    share: Callable[[np.ndarray], np.ndarray]
    surface: float
    base: float
    odd: bool  # the integral is over sin(k h d), and ln|x| is replaced by its conjugate, an angle
    finest: float  # w below which nothing of a scale of its own is left


def hat_compliance(count: int, ratio: float, layer: Contrast, log_datum: float = 0.0) -> np.ndarray:
    """2 pi G T(d) / h^2 of uz under pressures at d = 0 … count - 1, (count,).

    ratio      h/t
    log_datum  ln(L/h) of the datum L; without effect on a rigid base"""
    surface, base = 1.0 + layer.e, layer.softness * (1.0 + layer.base_e)
    response = _Response(lambda w: normal(layer, w), surface, base, False, finest_scale(layer))
    smooth = _by_intervals(count, ratio, response)
    return smooth - surface * hat_galerkin(np.arange(float(count))) + base * log_datum


def hat_coupling(count: int, ratio: float, layer: Contrast) -> np.ndarray:
    """2 pi G T(d) / h^2 of uz under tractions in +x at d = 0 … count - 1, (count,), odd in d."""
    base = 0.5 * (1.0 - layer.e) if layer.slides else -layer.softness * layer.base_e
    response = _Response(
        lambda w: coupling(layer, w) / w, -layer.e, base, True, finest_scale(layer)
    )
    smooth = _by_intervals(count, ratio, response)
    return 0.5 * np.pi * layer.e * hat_sign(np.arange(float(count))) - smooth


def _by_intervals(count: int, ratio: float, response: _Response) -> np.ndarray:
    """`_smooth` at distances 0 … count - 1."""
    distance, smooth = np.arange(float(count)), np.empty(count)
    lower, upper = 0.0, max(2.0, 1.0 / ratio)
    while lower < count:
        here = slice(int(np.ceil(lower)), int(np.ceil(min(upper, count))))
        smooth[here] = _interpolated(distance[here], lower, upper, ratio, response)
        lower, upper = upper, 2.0 * upper
    return smooth


def _interpolated(
    distance: np.ndarray, lower: float, upper: float, ratio: float, response: _Response
) -> np.ndarray:
    """`_smooth` at distances within an interval, by Chebyshev's points where they are fewer."""
    if len(distance) <= _ORDER:
        return _smooth(distance, ratio, response, near=lower == 0.0)
    cosines = np.cos(np.pi * (np.arange(_ORDER) + 0.5) / _ORDER)
    places = 0.5 * (lower + upper) + 0.5 * (upper - lower) * cosines
    values = _smooth(places, ratio, response, near=lower == 0.0)
    series = np.polynomial.chebyshev.chebfit(cosines, values, _ORDER - 1)
    return np.polynomial.chebyshev.chebval(
        (2.0 * distance - lower - upper) / (upper - lower), series
    )


def _smooth(distance: np.ndarray, ratio: float, response: _Response, near: bool) -> np.ndarray:
    """All but the singular term and the datum, on the real path or the turned one."""
    gain = response.base - response.surface
    depth = max(2.0, 3.0 * ratio)  # s/t; no less than three pitches
    reach = 2.0 * ratio * (np.max(distance, initial=0.0) + 2.0)
    # on the turned path the factor e^ikx ends the integral early
    finest = min(response.finest / depth, 2.0 / reach)
    # f hardly exceeds the sum of m: hats much wider than the layer leave nothing of the rest
    highest = min(_HIGHEST, _FADED / ratio ** (4.0 / 3.0)) if near else _HIGHEST
    w, weights = wave_panels(highest, reach if near else 0.0, finest)
    if not near:
        w, weights = _TURN * w, _TURN * weights
    known = (response.surface + gain * np.exp(-depth * w)) / w
    weights = weights * (response.share(w) - known)
    if near:
        weights = weights * np.sinc(w * ratio / (2.0 * np.pi)) ** 4
        turn = np.sin if response.odd else np.cos
        integral = turn(ratio * np.outer(distance, w)) @ weights
    else:
        phase = 1j * ratio * w
        weights = weights * (np.expm1(phase) / phase) ** 4  # e^2ikh sinc^4
        integral = np.exp(np.outer(distance - 2.0, phase)) @ weights
        integral = integral.imag if response.odd else integral.real
    return integral + gain * _mean_of_depth(distance, depth / ratio, response.odd)


def finest_scale(layer: Contrast) -> float:
    """w up to which one panel is enough: a soft base brings poles at about -G2/G."""
    return 0.5 / max(1.0, layer.softness)


def wave_panels(highest: float, reach: float, finest: float) -> tuple[np.ndarray, np.ndarray]:
    """Gauss points and weights on 0 <= w <= highest, dense enough for cos(reach w / 2).
    The panels halve towards w = 0 until one reaches from there to no more than `finest`."""
    halvings = np.ceil(np.log2(highest / finest))
    edges = np.append(0.0, highest * 0.5 ** np.arange(halvings, -1.0, -1.0))
    pieces = np.maximum(1, np.ceil(0.5 * reach * np.diff(edges) / _SWING)).astype(int)
    first = np.repeat(edges[:-1], pieces)
    width = np.repeat(np.diff(edges) / pieces, pieces)
    within = np.arange(len(first)) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    start = (first + within * width)[:, None]
    points = start + 0.5 * (1.0 + _POINTS) * width[:, None]
    return points.ravel(), (0.5 * width[:, None] * _WEIGHTS).ravel()


def _mean_of_depth(distance: np.ndarray, depth: float, odd: bool) -> np.ndarray:
    """int e^-ks cos kx dk/k, that is -ln sqrt(d^2 + depth^2), or with the sine atan(d/depth).
    Averaged over two hats; all in pitches, depth >= 3."""
    place = np.concatenate([0.5 * (1.0 + _FEW), 1.5 + 0.5 * _FEW])
    spline = np.where(place < 1.0, 4.0 - 6.0 * place**2 + 3.0 * place**3, (2.0 - place) ** 3) / 6.0
    share = np.tile(0.5 * np.tile(_FEW_WEIGHTS, 2) * spline, 2)
    both = distance[:, None] + np.concatenate([-place, place])
    return (np.arctan(both / depth) if odd else -np.log(np.hypot(both, depth))) @ share
