"""Computed profiles: smooth, sinusoid, self-affine, ground texture (turned: see `turned`).

Every profile is centred on x = 0 and, for a given seed, the same everywhere (numpy's PCG64).
Lengths are in m. Parameters that make no sense raise ValueError with one line.

Nomenclature: k wavenumber [1/m], H Hurst exponent, C power spectral density of the height."""

from math import ceil, exp, floor

import numpy as np

from analytic.numerics import check_positive
from analytic.profile import MAX_SAMPLES, MIN_SAMPLES, Profile
from analytic.surface.roughness import moments

SAMPLES_PER_WAVELENGTH = 64  # leaves 3e-7 of the amplitude between the spline and the cosine
MAX_ONE_SIDEDNESS = 2.0  # there a single valley already holds most of the variance


def smooth(*, length: float, samples: int = MIN_SAMPLES + 1) -> Profile:
    """A flat profile: height 0 over `length`."""
    check_positive(length=length)
    check_samples(samples)
    return Profile(np.linspace(-0.5 * length, 0.5 * length, samples), np.zeros(samples))


def sinusoid(
    *,
    wavelength: float,
    amplitude: float,
    length: float,
    samples_per_wavelength: int = SAMPLES_PER_WAVELENGTH,
) -> Profile:
    """height = amplitude cos(2 pi x / wavelength): a crest at x = 0, 2 amplitude peak to valley.
    The trace covers at least `length`, rounded up so that its ends lie as far left as right."""
    check_positive(wavelength=wavelength, amplitude=amplitude, length=length)
    if samples_per_wavelength < MIN_SAMPLES:
        raise ValueError(
            f"samples_per_wavelength must be at least {MIN_SAMPLES}, not {samples_per_wavelength}"
        )
    half = 0.5 * length * samples_per_wavelength / wavelength
    check_samples(2 * ceil(min(half, MAX_SAMPLES)) + 1)
    steps = np.arange(-ceil(half), ceil(half) + 1)
    phase = 2.0 * np.pi * steps / samples_per_wavelength
    return Profile(steps * (wavelength / samples_per_wavelength), amplitude * np.cos(phase))


def self_affine(
    *,
    hurst: float,
    samples: int,
    length: float,
    seed: int,
    rms_slope: float | None = None,
    rms_height: float | None = None,
    shortest_wavelength: float | None = None,
    longest_wavelength: float | None = None,
) -> Profile:
    """Gaussian self-affine profile, C(k) ~ k^(-1-2H) between the cut-offs and nothing beyond.

    hurst                H, 0 < H <= 1
    rms_slope, rms_height [m]  exactly one of them: root mean square of the slope, or of the
                         height about its mean, of the spline over the whole trace
    samples, length      the trace: evenly spaced, both ends included
    shortest_wavelength  default 4 sample spacings, at least 2
    longest_wavelength   default (and at most) the length

    The trace is one whole period: only waves that fit into `length` a whole number of times occur,
    and the last sample repeats the first. Phases are uniform, amplitudes Rayleigh distributed,
    drawn from the long waves to the short: more samples of one seed resolve the same surface."""
    check_positive(length=length)
    check_samples(samples)
    if not 0.0 < hurst <= 1.0:
        raise ValueError(f"hurst must lie above 0 and be at most 1, not {hurst:g}")
    if (rms_slope is None) == (rms_height is None):
        raise ValueError("give exactly one of rms_slope and rms_height")
    wanted = {"rms_slope": rms_slope} if rms_height is None else {"rms_height": rms_height}
    check_positive(**wanted)
    spacing = length / (samples - 1)
    shortest = 4.0 * spacing if shortest_wavelength is None else shortest_wavelength
    longest = length if longest_wavelength is None else longest_wavelength
    _check_wavelengths(shortest, longest, spacing, length)
    first, last = ceil(_whole(length / longest)), floor(_whole(length / shortest))
    if first > last:
        raise ValueError(
            f"no wave that fits {length:g} m a whole number of times lies between "
            f"shortest_wavelength {shortest:g} m and longest_wavelength {longest:g} m"
        )
    order = np.arange(1, last + 1)
    phase, chance = random_generator(seed).random((last, 2)).T
    amplitude = np.where(order >= first, (order / first) ** (-0.5 - hurst), 0.0)
    waves = np.zeros((samples - 1) // 2 + 1, dtype=complex)
    waves[order] = amplitude * np.sqrt(-np.log1p(-chance)) * np.exp(2j * np.pi * phase)
    period = np.fft.irfft(waves, samples - 1)
    trace = smooth(length=length, samples=samples)
    raw = Profile(trace.x, np.append(period, period[0]) / np.std(period))
    mean, rq, slope = moments(raw)
    factor = rms_slope / slope if rms_height is None else rms_height / rq
    return Profile(raw.x, factor * (raw.height - mean))


def ground_texture(
    *,
    rms_height: float,
    samples: int,
    length: float,
    seed: int,
    roll_off_wavelength: float,
    shortest_wavelength: float,
    longest_wavelength: float,
    decay: float = 1.25,
    one_sidedness: float = 0.3,
) -> Profile:
    """Ground surface across the lay: blunt peaks, deep valleys, mean and tilt removed.

    A Gaussian trace g of unit variance has wave amplitudes that are level from
    `longest_wavelength` to `roll_off_wavelength` and fall as k^-decay down to
    `shortest_wavelength`; z = -exp(one_sidedness g) then stretches its valleys and blunts its
    peaks (skewness about -3 one_sidedness; 0.3 is usual for grinding). The trace is cut out of
    a period at least half as long again, so that its ends are independent; the least-squares
    line is taken off, and the samples (not the spline) scaled to `rms_height` [m].
    samples, length   the trace: evenly spaced, both ends included"""
    check_positive(
        rms_height=rms_height,
        length=length,
        roll_off_wavelength=roll_off_wavelength,
        decay=decay,
        one_sidedness=one_sidedness,
    )
    if one_sidedness > MAX_ONE_SIDEDNESS:
        raise ValueError(f"one_sidedness must be at most {MAX_ONE_SIDEDNESS:g}")
    check_samples(samples)
    spacing = length / (samples - 1)
    period = 1 << (ceil(1.5 * samples) - 1).bit_length()
    _check_wavelengths(shortest_wavelength, longest_wavelength, spacing, period * spacing)
    if not shortest_wavelength <= roll_off_wavelength <= longest_wavelength:
        raise ValueError(
            f"roll_off_wavelength must lie between shortest_wavelength "
            f"{shortest_wavelength:g} m and longest_wavelength {longest_wavelength:g} m, "
            f"not at {roll_off_wavelength:g} m"
        )
    wavenumber = np.fft.rfftfreq(period, spacing)
    inside = (wavenumber >= 1.0 / longest_wavelength) & (wavenumber <= 1.0 / shortest_wavelength)
    if not np.any(inside):
        raise ValueError(
            f"no wave of the period {period * spacing:g} m lies between shortest_wavelength "
            f"{shortest_wavelength:g} m and longest_wavelength {longest_wavelength:g} m"
        )
    level = np.maximum(wavenumber * roll_off_wavelength, 1.0) ** -decay
    generator = random_generator(seed)
    phase = generator.uniform(0.0, 2.0 * np.pi, len(wavenumber))
    chance = generator.uniform(size=len(wavenumber))
    waves = np.where(inside, level, 0.0) * np.sqrt(-np.log1p(-chance)) * np.exp(1j * phase)
    gaussian = np.fft.irfft(waves, period)[:samples]
    gaussian = (gaussian - np.mean(gaussian)) / np.std(gaussian)
    z = exp(0.5 * one_sidedness**2) - np.exp(one_sidedness * gaussian)
    u = np.linspace(-1.0, 1.0, samples)
    z = z - np.mean(z)
    z = z - u * (np.dot(u, z) / np.dot(u, u))
    return Profile(0.5 * length * u, z * (rms_height / np.std(z)))


def same_spectrum(profile: Profile, seed: int) -> Profile:
    """A Gaussian profile with the power spectrum of another, as many samples and its rms height.
    The other's waves under a Hann window, with new phases and Rayleigh distributed amplitudes. It
    is one whole period about x = 0, the last sample repeats the first."""
    count = len(profile.x) - 1
    x = np.linspace(profile.x[0], profile.x[-1], count + 1)
    height = profile.spline()(x[:-1])
    window = np.sin(np.pi * np.arange(count) / count) ** 2
    waves = np.fft.rfft((height - np.average(height, weights=window)) * window)
    phase, chance = random_generator(seed).random((2, len(waves)))
    waves = np.abs(waves) * np.sqrt(-np.log1p(-chance)) * np.exp(2j * np.pi * phase)
    waves[0] = 0.0
    period = np.fft.irfft(waves, count)
    period *= np.std(height) / np.std(period)
    return Profile(x - 0.5 * (x[0] + x[-1]), np.append(period, period[0]))


def random_generator(seed: int) -> np.random.Generator:
    """Random numbers that are the same everywhere; ValueError unless `seed` is whole, 0 or more."""
    if not isinstance(seed, int | np.integer) or isinstance(seed, bool) or seed < 0:
        raise ValueError(f"seed must be a whole number of at least 0, not {seed!r}")
    return np.random.default_rng(seed)


def check_samples(samples: int) -> None:
    """Raises ValueError for a number of samples that no profile has."""
    if not isinstance(samples, int | np.integer) or not MIN_SAMPLES <= samples <= MAX_SAMPLES:
        raise ValueError(
            f"the trace would have {samples!r} samples; "
            f"allowed is a whole number from {MIN_SAMPLES} to {MAX_SAMPLES}"
        )


def _check_wavelengths(shortest: float, longest: float, spacing: float, period: float) -> None:
    check_positive(shortest_wavelength=shortest, longest_wavelength=longest)
    if _whole(shortest / spacing) < 2.0:
        raise ValueError(
            f"shortest_wavelength {shortest:g} m is below two sample spacings of {spacing:g} m"
        )
    if not shortest < longest:
        raise ValueError(
            f"shortest_wavelength {shortest:g} m must be below longest_wavelength {longest:g} m"
        )
    if _whole(longest / period) > 1.0:
        raise ValueError(
            f"longest_wavelength {longest:g} m does not fit the trace; allowed is at most "
            f"{period:g} m"
        )


def _whole(ratio: float) -> float:
    """The ratio, taken as whole where only rounding keeps it from being so."""
    return round(ratio) if abs(ratio - round(ratio)) < 1e-9 * abs(ratio) else ratio
