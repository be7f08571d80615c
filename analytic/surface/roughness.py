"""Roughness figures of the curve that is pressed: the profile's spline, not its samples.

Each stretch of the spline is a cubic, so every figure is exact up to rounding: powers of the
height by Gauss points, the mean deviation between the curve's crossings of the mean line, the
extremes at the zeros of the derivative. Nothing is filtered and no tilt is removed.

Nomenclature: z height above the mean height of the curve [m], L length [m], k wavenumber [1/m]."""

from dataclasses import dataclass, replace
from math import inf

import numpy as np
from scipy.fft import next_fast_len, rfft
from scipy.interpolate import CubicHermiteSpline, CubicSpline, PPoly

from analytic.profile import Profile

# Exact up to degree 13; the fourth power of a cubic has degree 12.
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(7)
MAX_RESAMPLED = 2**22  # 32 MB
SLOPE_SHARE = 0.99  # of its variance, that waves resolved by pressure elements have
FLAT = 64.0 * np.finfo(float).eps  # slopes below this part of max |height| / spacing are rounding


@dataclass(frozen=True)
class Roughness:
    """Figures of a profile over its whole length (definitions of ISO 4287, unfiltered)."""

    mean: float  # [m] mean height
    ra: float  # [m] mean of |z|
    rq: float  # [m] root mean square of z
    rsk: float  # skewness of z, 0 for a flat profile
    rku: float  # kurtosis
    rt: float  # [m] highest peak to deepest valley
    rms_slope: float  # root mean square of dz/dx
    max_slope: float  # largest |dz/dx|


def roughness(profile: Profile) -> Roughness:
    """Roughness figures of the profile's spline."""
    # Taking off an offset first keeps the powers free of cancellation.
    offset = float(np.mean(profile.height))
    figures = figures_of(CubicSpline(profile.x, profile.height - offset))
    return replace(figures, mean=offset + figures.mean)


def moments(profile: Profile) -> tuple[float, float, float]:
    """Mean height [m], root mean square height about it [m] and root mean square slope."""
    curve = profile.spline()
    points, weights = _gauss_points(profile.x)
    heights = curve(points)
    mean = np.sum(weights * heights)
    rq = np.sqrt(np.sum(weights * (heights - mean) ** 2))
    return float(mean), float(rq), float(np.sqrt(np.sum(weights * curve(points, 1) ** 2)))


def figures_of(curve: PPoly, level: float | None = None) -> Roughness:
    """Roughness figures of a piecewise cubic height [m], counted from `level` [m] (None: its mean).
    Rounding shows where the curve's offset is large against its heights."""
    points, weights = _gauss_points(curve.x)
    heights = curve(points)
    mean = float(np.sum(weights * heights))
    level = mean if level is None else level
    z = heights - level
    square = np.sum(weights * z**2)
    cube, fourth = np.sum(weights * z**3), np.sum(weights * z**4)
    ends = np.concatenate((curve.x[:1], crossings(curve, level), curve.x[-1:]))
    area = curve.antiderivative()(ends) - level * (ends - ends[0])  # exact between the crossings
    slope = curve.derivative(1)
    steepest = slope(np.append(curve.x, crossings(curve.derivative(2))))
    return Roughness(
        mean=mean,
        ra=float(np.sum(np.abs(np.diff(area))) / (ends[-1] - ends[0])),
        rq=float(np.sqrt(square)),
        rsk=float(cube / square**1.5) if square > 0.0 else 0.0,
        rku=float(fourth / square**2) if square > 0.0 else 0.0,
        rt=float(np.ptp(curve(turning_points(curve)))),
        rms_slope=float(np.sqrt(np.sum(weights * slope(points) ** 2))),
        max_slope=float(np.max(np.abs(steepest))),
    )


def turning_points(curve: PPoly) -> np.ndarray:
    """Points [m], ascending, that include every extreme of a piecewise cubic and both its ends."""
    return np.sort(np.append(curve.x, crossings(curve.derivative(1))))


def peaks(profile: Profile) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points (n,) [m] of the spline's inner maxima, heights (n,) [m], curvatures (n,) [1/m] > 0."""
    curve = profile.spline()
    place = np.unique(crossings(curve.derivative(1)))
    bend = curve(place, 2)
    place, bend = place[bend < 0.0], bend[bend < 0.0]
    return place, curve(place), -bend


def summits(profile: Profile) -> tuple[float, float]:
    """Standard deviation [m] of the heights of the profile's peaks, and the mean of their
    curvatures [1/m], positive; both 0 without any."""
    _, height, bend = peaks(profile)
    return (float(np.std(height)), float(bend.mean())) if len(height) else (0.0, 0.0)


def stretch_of(curve: PPoly, start: float, stop: float) -> PPoly:
    """The part of a piecewise cubic between two positions [m]."""
    inside = curve.x[(curve.x > start) & (curve.x < stop)]
    x = np.concatenate(([start], inside, [stop]))
    return CubicHermiteSpline(x, curve(x), curve(x, 1))


def shortest_wavelength(profile: Profile) -> float:
    """Wavelength [m] above which SLOPE_SHARE of the variance of the profile's slope lies.

    The spline's slope is sampled evenly (at half of a spacing that nine sample distances in ten
    exceed), its mean removed, a Hann window laid over it, and its power summed from long to
    short waves. The window spreads a wave: the result errs by up to 1/L in wavenumber, to the short
    side for a single wave. Of a profile without slope it is inf."""
    step = 0.5 * float(np.quantile(np.diff(profile.x), 0.1))
    count = next_fast_len(int(min(np.ceil(profile.length / step), MAX_RESAMPLED)), real=True)
    x = profile.x[0] + profile.length * (np.arange(count) + 0.5) / count
    slope = profile.spline()(x, 1)
    slope -= np.mean(slope)
    if np.std(slope) <= FLAT * np.max(np.abs(profile.height)) / profile.spacing:
        return inf
    window = np.sin(np.pi * (np.arange(count) + 0.5) / count) ** 2
    power = np.abs(rfft(slope * window)[1:]) ** 2
    share = np.cumsum(power) / np.sum(power)
    wavenumber = np.arange(1, len(share) + 1) / profile.length
    return float(1.0 / np.interp(SLOPE_SHARE, share, wavenumber))


def power_spectrum(profile: Profile) -> tuple[np.ndarray, np.ndarray]:
    """Wavenumbers (m,) [1/m] above 0 and the one-sided power spectral density (m,) [m^3] there. Of
    the spline at even steps, about its mean, under a Hann window. The density's integral over the
    wavenumber is the mean square height, but for the window."""
    count = next_fast_len(min(len(profile.x), MAX_RESAMPLED), real=True)
    middles = (np.arange(count) + 0.5) / count
    height = profile.spline()(profile.x[0] + profile.length * middles)
    window = np.sin(np.pi * middles) ** 2
    power = np.abs(rfft((height - height.mean()) * window)[1:]) ** 2
    density = 2.0 * power * profile.length / (count * np.sum(window**2))
    return np.arange(1, len(power) + 1) / profile.length, density


def bearing_curve(profile: Profile, count: int = 1000) -> tuple[np.ndarray, np.ndarray]:
    """Shares (count,) of the length and the heights (count,) [m] that they reach or exceed."""
    places = np.linspace(profile.x[0], profile.x[-1], max(count, 2 * len(profile.x)))
    share = (np.arange(count) + 0.5) / count
    return share, np.quantile(profile.spline()(places), 1.0 - share)


def _gauss_points(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Gauss points (m, n-1) [m] of every interval, and their weights, which add up to 1."""
    steps = np.diff(x)
    points = x[:-1] + 0.5 * (_NODES[:, None] + 1.0) * steps
    return points, 0.5 * _WEIGHTS[:, None] * steps / (x[-1] - x[0])


def crossings(piecewise: PPoly, value: float = 0.0) -> np.ndarray:
    """Points where a piecewise polynomial takes `value`, ascending, without its constant pieces."""
    if len(piecewise.c) <= 3 and value == 0.0:
        return _zeros_of_quadratics(piecewise)
    zeros = piecewise.solve(value, discontinuity=False, extrapolate=False)
    return zeros[np.isfinite(zeros)]


def _zeros_of_quadratics(piecewise: PPoly) -> np.ndarray:
    """Crossings of zero by pieces of degree 2 at most, all at once; one at a break counts twice."""
    c, b, a = [*piecewise.c[::-1], np.zeros(len(piecewise.x) - 1)][:3]
    root = np.sqrt(np.maximum(b**2 - 4.0 * a * c, 0.0))
    sum_of_one_sign = -0.5 * (b + np.copysign(root, b))
    with np.errstate(divide="ignore", invalid="ignore"):
        steps = np.stack([sum_of_one_sign / a, c / sum_of_one_sign])
    steps[:, b**2 < 4.0 * a * c] = np.nan
    inside = (steps >= 0.0) & (steps <= np.diff(piecewise.x))
    return np.sort((piecewise.x[:-1] + steps)[inside])
