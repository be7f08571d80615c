"""A turned surface along its feed: the path of the tool's nose, its ridges rounded, and noise.

A tool with a round nose of radius r leaves one arc a feed f. Real ridges between neighbouring arcs
are not sharp (and a sharp one would attract an unbounded pressure), so each is rounded by an arc of
radius rho tangent to both. By the triangle of the centres the height from valley to ridge is

    h = (r + rho) - sqrt((r + rho)^2 - f^2/4),     about f^2/(8 (r + rho)).

The slope is continuous; the curvature jumps where the arcs meet, between 1/r and -1/rho, and the
spline needs several samples on each arc to follow that without ringing. f, r, rho [m]."""

from math import ceil, sqrt

import numpy as np

from analytic.numerics import check_positive
from analytic.profile import MAX_SAMPLES, MIN_SAMPLES, Profile
from analytic.surface.roughness import roughness
from analytic.surface.synthetic import check_samples, random_generator

RIDGE_PER_NOSE = 0.1  # ridge radius over nose radius where none is given
SAMPLES_PER_RIDGE = 12  # at least; the spline then passes the height by less than 1e-4 of it
SAMPLES_PER_FEED = 64  # at least
NOISE_PER_FEED = 0.1  # shortest wavelength of the noise over the feed where none is given


def turned(
    *,
    feed: float,
    nose_radius: float,
    length: float,
    ridge_radius: float | None = None,
    phase: float = 0.0,
    samples_per_feed: int | None = None,
    noise: float | None = None,
    noise_wavelength: float | None = None,
    seed: int = 0,
) -> Profile:
    """Profile of a turned surface about its mean height; a ridge stands at x = phase times feed.

    feed, nose_radius  [m] per revolution, at most the nose radius; of the tool
    length             [m] that the trace covers at least, rounded up to whole samples
    ridge_radius       [m] default a tenth of the nose radius
    phase              in feeds, from 0 up to but not including 1
    samples_per_feed   default (and at least) SAMPLES_PER_RIDGE on every ridge's arc
    noise              [m] root mean square of the Gaussian noise that is added; None: none
    noise_wavelength   [m] shortest of the noise, which has all longer ones in equal measure;
                       default a tenth of the feed, at least two sample spacings"""
    rho = RIDGE_PER_NOSE * nose_radius if ridge_radius is None else ridge_radius
    check_positive(feed=feed, nose_radius=nose_radius, length=length, ridge_radius=rho)
    if feed > nose_radius:
        raise ValueError(f"feed {feed:g} m must be at most nose_radius, {nose_radius:g} m")
    if not 0.0 <= phase < 1.0:
        raise ValueError(f"phase must be at least 0 and below 1 feed, not {phase:g}")
    fewest = max(SAMPLES_PER_FEED, ceil(SAMPLES_PER_RIDGE * (nose_radius + rho) / rho))
    per_feed = fewest if samples_per_feed is None else samples_per_feed
    if not per_feed >= fewest:
        raise ValueError(
            f"samples_per_feed must be at least {fewest} to follow ridges of {rho:g} m, "
            f"not {per_feed}"
        )
    half = 0.5 * length * per_feed / feed
    count = 2 * ceil(min(half, MAX_SAMPLES)) + 1
    check_samples(max(count, MIN_SAMPLES))
    steps = np.arange(-(count // 2), count // 2 + 1)
    x = steps * (feed / per_feed)
    height = _arcs(np.abs((x / feed - phase + 0.5) % 1.0 - 0.5) * feed, feed, nose_radius, rho)
    if noise is not None:
        shortest = NOISE_PER_FEED * feed if noise_wavelength is None else noise_wavelength
        height = height + _noise(x, noise, shortest, seed)
    elif noise_wavelength is not None:
        raise ValueError("noise_wavelength is given without noise; allowed is both or none")
    profile = Profile(x, height - np.mean(height))
    return Profile(x, profile.height - roughness(profile).mean)


def turned_height(feed: float, nose_radius: float, ridge_radius: float) -> float:
    """Height [m] from valley to ridge, h above."""
    reach = nose_radius + ridge_radius
    return 0.25 * feed**2 / (reach + sqrt((reach - 0.5 * feed) * (reach + 0.5 * feed)))


def _arcs(u: np.ndarray, feed: float, r: float, rho: float) -> np.ndarray:
    """Height [m] above the valleys at the distance u from a ridge."""
    ridge = 0.5 * feed * rho / (r + rho)  # where both arcs have the same tangent
    top = turned_height(feed, r, rho)
    v = 0.5 * feed - u
    convex = top - u**2 / (rho + np.sqrt(np.maximum(rho**2 - u**2, 0.0)))
    concave = v**2 / (r + np.sqrt(r**2 - v**2))
    return np.where(u < ridge, convex, concave)


def _noise(x: np.ndarray, rms: float, shortest: float, seed: int) -> np.ndarray:
    """Gaussian noise (n,) [m] of equal power at all wavelengths from `shortest` to the length."""
    check_positive(noise=rms, noise_wavelength=shortest)
    spacing, length = x[1] - x[0], x[-1] - x[0]
    if not 2.0 * spacing <= shortest <= length:
        raise ValueError(
            f"noise_wavelength {shortest:g} m must be from two sample spacings, "
            f"{2.0 * spacing:g} m, to the length, {length:g} m"
        )
    last = int(length / shortest * (1.0 + 1e-9))
    phase, chance = random_generator(seed).random((last, 2)).T
    waves = np.zeros((len(x) - 1) // 2 + 1, dtype=complex)
    waves[1 : last + 1] = np.sqrt(-np.log1p(-chance)) * np.exp(2j * np.pi * phase)
    period = np.fft.irfft(waves, len(x) - 1)
    return rms / np.std(period) * np.append(period, period[0])
