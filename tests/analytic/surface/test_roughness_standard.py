"""Standard parameters against waves whose figures are known, and against the table of cut-offs.
Roughness figures against integrals done by hand. The Gaussian filter against its transmission,
brute-force integrals and scipy's own."""

from math import inf, pi, sqrt

import numpy as np
import pytest
from scenes import MEASURED, PROFILES
from scipy.ndimage import gaussian_filter1d
from text_profiles import mirrored, read_profile

import analytic.surface.filters as module
from analytic.profile import Profile
from analytic.surface.filters import ALPHA, check_cutoff, filtered, mean_line
from analytic.surface.roughness import (
    bearing_curve,
    figures_of,
    power_spectrum,
    roughness,
    shortest_wavelength,
    stretch_of,
    summits,
)
from analytic.surface.roughness_standard import (
    standard_cutoff,
    standard_roughness,
    standard_short_cutoff,
)
from analytic.surface.synthetic import self_affine, sinusoid, smooth

CUTOFF = 0.8e-3
AMPLITUDE = 1e-6
FINE = sinusoid(wavelength=50e-6, amplitude=AMPLITUDE, length=6e-3)


def transmission(wavelength: float, cutoff: float) -> float:
    """Part of a wave's amplitude that the mean line holds (ISO 16610-21:2011, eq. 2)."""
    return 2.0 ** -((cutoff / wavelength) ** 2)


def waves(*sizes: tuple[float, float], length: float = 8e-3, samples: int = 16001) -> Profile:
    """Sum of cosines, each an amplitude and a wavelength [m]."""
    x = np.linspace(-0.5 * length, 0.5 * length, samples)
    return Profile(x, sum(a * np.cos(2.0 * pi * x / w) for a, w in sizes))


def test_a_fine_wave_has_its_exact_figures():
    figures = standard_roughness(FINE, CUTOFF)
    assert (figures.sections, figures.cutoff, figures.short_cutoff) == (5, CUTOFF, None)
    assert figures.start == pytest.approx(-2e-3, rel=1e-9)
    assert figures.ra == pytest.approx(2.0 / pi * AMPLITUDE, rel=1e-6)
    assert figures.rq == pytest.approx(AMPLITUDE / sqrt(2.0), rel=1e-6)
    assert figures.rsk == pytest.approx(0.0, abs=1e-9)
    assert figures.rku == pytest.approx(1.5, rel=1e-9)
    assert figures.rt == pytest.approx(2.0 * AMPLITUDE, rel=1e-6)
    assert figures.rz == pytest.approx(2.0 * AMPLITUDE, rel=1e-6)
    assert figures.rdq == pytest.approx(2.0 * pi / 50e-6 * AMPLITUDE / sqrt(2.0), rel=1e-5)
    assert figures.rsm == pytest.approx(50e-6, rel=1e-9)


@pytest.mark.parametrize("wavelength", [100e-6, 400e-6, 800e-6, 1.6e-3])
def test_a_wave_is_as_rough_as_its_transmission_lets_it_be(wavelength):
    left = 1.0 - transmission(wavelength, CUTOFF)
    figures = standard_roughness(waves((AMPLITUDE, wavelength)), CUTOFF)
    assert figures.rq == pytest.approx(left * AMPLITUDE / sqrt(2.0), rel=2e-5)
    assert figures.rsm == pytest.approx(wavelength, rel=1e-6)


def test_the_short_cutoff_halves_a_wave_of_its_length():
    figures = standard_roughness(FINE, CUTOFF, 50e-6)
    assert figures.rt == pytest.approx(AMPLITUDE, rel=1e-5)
    assert figures.rku == pytest.approx(1.5, rel=1e-6)


def test_two_waves_add_their_squares():
    profile = waves((AMPLITUDE, 40e-6), (3.0 * AMPLITUDE, 2e-3))
    figures = standard_roughness(profile, CUTOFF)
    left = 3.0 * (1.0 - transmission(2e-3, CUTOFF))
    assert figures.rq == pytest.approx(AMPLITUDE * sqrt(0.5 * (1.0 + left**2)), rel=1e-5)
    # Each section holds another part of the long wave, so that none is as high as all of them.
    assert 2.0 * AMPLITUDE < figures.rz < figures.rt
    assert figures.rt == pytest.approx(2.0 * AMPLITUDE * (1.0 + left), rel=1e-3)


def test_rz_is_the_mean_over_the_sections():
    """A wave that grows by its amplitude a section: 1.5 to 5.5 of it where the sections end."""
    x = np.linspace(-3e-3, 3e-3, 12001)
    growing = AMPLITUDE * (3.0 + x / CUTOFF) * np.cos(2.0 * pi * x / 10e-6)
    figures = standard_roughness(Profile(x, growing), CUTOFF)
    assert figures.rz == pytest.approx(2.0 * 3.5 * AMPLITUDE, rel=0.01)
    assert figures.rt == pytest.approx(2.0 * 5.5 * AMPLITUDE, rel=0.01)


def test_heights_count_from_the_line_of_the_filter():
    """Not from the mean of the stretch: that of an eighth of a wave is not zero."""
    profile = waves((AMPLITUDE, 6.4e-3), length=1.6e-3, samples=3201)
    figures = standard_roughness(profile, CUTOFF)
    assert figures.sections == 1
    left = 1.0 - transmission(6.4e-3, CUTOFF)
    cosine = sqrt(0.5 * (1.0 + sqrt(8.0) / pi))  # root mean square over an eighth about its crest
    assert figures.rq == pytest.approx(left * AMPLITUDE * cosine, rel=0.05)
    assert figures.rq > 20.0 * np.std(left * AMPLITUDE * np.cos(np.linspace(-pi / 8, pi / 8, 999)))


def test_low_hills_do_not_part_elements():
    # a ripple of 3 % of the height crosses the mean line many times beside each of its zeros
    profile = waves((AMPLITUDE, 400e-6), (0.06 * AMPLITUDE, 9e-6))
    assert standard_roughness(profile, CUTOFF).rsm == pytest.approx(400e-6, rel=0.01)
    alone = waves((0.06 * AMPLITUDE, 9e-6))
    assert standard_roughness(alone, CUTOFF).rsm == pytest.approx(9e-6, rel=1e-6)


def test_lengths_that_hold_no_element_have_no_width():
    assert standard_roughness(waves((AMPLITUDE, 6e-3), length=4e-3), CUTOFF).rsm is None


def test_crossings_as_close_as_rounding_have_a_width():
    steep = sinusoid(wavelength=1e-3, amplitude=0.1, length=4e-3)
    assert standard_roughness(steep, 0.25e-3).rsm is None


def test_a_flat_trace_has_figures_of_zero():
    figures = standard_roughness(smooth(length=4e-3, samples=2001), CUTOFF)
    values = (figures.ra, figures.rq, figures.rsk, figures.rku, figures.rt, figures.rz, figures.rdq)
    assert values == (0.0,) * 7 and figures.rsm is None


@pytest.mark.parametrize(
    ("length", "sections"), [(1.6e-3, 1), (2.3e-3, 1), (2.4e-3, 2), (4.8e-3, 5), (16e-3, 5)]
)
def test_whole_sections_lie_in_the_middle(length, sections):
    figures = standard_roughness(waves((AMPLITUDE, 50e-6), length=length), CUTOFF)
    assert figures.sections == sections
    assert figures.start == pytest.approx(-0.5 * sections * CUTOFF, rel=1e-9)


@pytest.mark.parametrize("short", [None, 20e-6])
def test_what_lies_beyond_the_filters_reach_does_not_count(short):
    whole = self_affine(hurst=0.8, samples=8001, length=16e-3, seed=4, rms_height=1e-6)
    figures = standard_roughness(whole, CUTOFF, short)
    curve = filtered(whole, CUTOFF, short).spline()
    wanted = figures_of(stretch_of(curve, -2.5 * CUTOFF, 2.5 * CUTOFF), level=0.0)
    assert figures.ra == pytest.approx(wanted.ra, rel=1e-7)
    assert figures.rt == pytest.approx(wanted.rt, rel=1e-7)
    assert figures.rdq == pytest.approx(wanted.rms_slope, rel=1e-7)
    far = np.where(np.abs(whole.x) > 3.0e-3 + 5.0 * CUTOFF, 1e-3, 0.0)
    assert standard_roughness(Profile(whole.x, whole.height + far), CUTOFF, short) == figures


def test_scales_and_mirrors():
    base = self_affine(hurst=0.8, samples=4001, length=8e-3, seed=3, rms_height=1e-6)
    figures = standard_roughness(base, CUTOFF, 10e-6)
    other_way = standard_roughness(mirrored(base), CUTOFF, 10e-6)
    scaled = standard_roughness(Profile(50.0 * base.x, 7.0 * base.height), 50.0 * CUTOFF, 5e-4)
    upside_down = standard_roughness(Profile(base.x, -base.height), CUTOFF, 10e-6)
    for name in ("ra", "rq", "rt", "rz"):
        wanted = getattr(figures, name)
        assert getattr(other_way, name) == pytest.approx(wanted, rel=1e-8)
        assert getattr(upside_down, name) == pytest.approx(wanted, rel=1e-9)
        assert getattr(scaled, name) == pytest.approx(7.0 * wanted, rel=1e-8)
    assert scaled.rsm == pytest.approx(50.0 * figures.rsm, rel=1e-8)
    assert scaled.rdq == pytest.approx(7.0 / 50.0 * figures.rdq, rel=1e-8)
    assert upside_down.rsk == pytest.approx(-figures.rsk, rel=1e-8)
    assert other_way.rsk == pytest.approx(figures.rsk, rel=1e-7)


def test_waviness_and_tilt_do_not_count():
    base = waves((AMPLITUDE, 50e-6))
    bent = Profile(base.x, base.height + 0.02 * base.x + 3e-5 * np.cos(base.x / 4e-3))
    figures, wanted = standard_roughness(bent, CUTOFF), standard_roughness(base, CUTOFF)
    assert figures.ra == pytest.approx(wanted.ra, rel=1e-2)
    assert roughness(bent).ra > 30.0 * wanted.ra


# Ra [um] of the roughness, and the cut-off [mm] of ISO 4288's table 1 for it
@pytest.mark.parametrize(
    ("ra", "cutoff"),
    [(0.019, 0.08), (0.021, 0.25), (0.099, 0.25), (0.101, 0.8), (1.99, 0.8), (2.1, 2.5), (11, 8.0)],
)
def test_automatic_cutoff_is_that_of_the_table(ra, cutoff):
    profile = waves((0.5 * pi * ra * 1e-6, 20e-6), length=17e-3, samples=9001)
    assert standard_cutoff(profile) == pytest.approx(1e-3 * cutoff, rel=1e-12)


@pytest.mark.parametrize(
    ("profile", "words"),
    [
        (waves((AMPLITUDE, 8e-6), length=1.5e-3), r"too short for the .* cut-off of 0\.8 mm"),
        (waves((AMPLITUDE, 8e-6), length=1.5e-4), r"too short for the .* cut-off of 0\.08 mm"),
        (waves((200e-6, 80e-6), length=17e-3), "no cut-off of the standard .* suits the trace"),
        (smooth(length=10.0, samples=100), "no cut-off of the standard"),
    ],
)
def test_automatic_cutoff_needs_the_length_that_it_asks_for(profile, words):
    with pytest.raises(ValueError, match=words):
        standard_cutoff(profile)


def test_samples_too_far_apart_for_a_cutoff_take_the_next():
    coarse = waves((0.01e-6, 0.4e-3), length=8e-3, samples=161)  # 50 um
    assert standard_cutoff(coarse) == 0.25e-3


@pytest.mark.parametrize(
    ("cutoff", "short"), [(0.08e-3, 2.5e-6), (0.8e-3, 2.5e-6), (1e-3, 8e-6), (8e-3, 25e-6)]
)
def test_short_cutoff_belongs_to_the_cutoff(cutoff, short):
    profile = waves((AMPLITUDE, 1e-4), length=0.02, samples=20001)
    assert standard_short_cutoff(profile, cutoff) == short


def test_samples_too_far_apart_have_no_short_cutoff():
    profile = waves((AMPLITUDE, 1e-4), samples=4001)  # 2 um
    assert standard_short_cutoff(profile, 0.8e-3) is None
    assert standard_short_cutoff(profile, 2.5e-3) == 8e-6
    assert standard_short_cutoff(profile, 2e-6) is None


UNEVEN = np.array([-1.0, -0.9, -0.35, -0.3, 0.1, 0.55, 0.6, 0.98, 1.0])
RQ = sqrt(4 / 45)  # of the parabola


def as_array(figures):
    return np.array([getattr(figures, name) for name in figures.__dataclass_fields__])


@pytest.mark.parametrize(
    ("power", "exact"),
    [
        (1, [0.0, 1 / 2, 1 / sqrt(3), 0.0, 9 / 5, 2.0, 1.0, 1.0]),
        (2, [1 / 3, 4 / (9 * sqrt(3)), RQ, 16 / 945 / RQ**3, 16 / 945 / RQ**4, 1, sqrt(4 / 3), 2]),
        (3, [0.0, 1 / 4, 1 / sqrt(7), 0.0, 49 / 13, 2.0, 3 / sqrt(5), 3.0]),
    ],
)
def test_powers_are_exact(power, exact):
    figures = as_array(roughness(Profile(UNEVEN, UNEVEN**power)))
    np.testing.assert_allclose(figures, exact, rtol=1e-12, atol=1e-13)


def test_extremes_between_the_samples_count():
    # z = x^3 - 0.12 x has its turning points at x = -0.2 and 0.2, away from all samples.
    figures = roughness(Profile(UNEVEN, UNEVEN**3 - 0.48 * UNEVEN**2))
    assert figures.max_slope == pytest.approx(3.96, rel=1e-12)
    inner = roughness(Profile(0.3 * UNEVEN, (0.3 * UNEVEN) ** 3 - 0.12 * 0.3 * UNEVEN))
    assert inner.rt == pytest.approx(2 * 0.016, rel=1e-12)
    assert inner.max_slope == pytest.approx(0.15, rel=1e-12)
    flat_middle = roughness(Profile(UNEVEN, UNEVEN - UNEVEN**3 / 3))
    assert flat_middle.max_slope == pytest.approx(1.0, rel=1e-12)


def test_sinusoid():
    amplitude, wavelength = 0.2e-6, 10e-6
    figures = roughness(sinusoid(wavelength=wavelength, amplitude=amplitude, length=8 * wavelength))
    k = 2 * pi / wavelength
    assert abs(figures.mean) < 1e-7 * amplitude
    assert abs(figures.rsk) < 1e-6
    exact = [2 / pi * amplitude, amplitude / sqrt(2), 1.5, 2 * amplitude]
    np.testing.assert_allclose([figures.ra, figures.rq, figures.rku, figures.rt], exact, rtol=1e-6)
    slopes = [k * amplitude / sqrt(2), k * amplitude]
    np.testing.assert_allclose([figures.rms_slope, figures.max_slope], slopes, rtol=1e-5)


def test_the_spline_reaches_the_sinusoid_at_fourth_order():
    errors = []
    for samples in (16, 32, 64, 128):
        wave = sinusoid(wavelength=1.0, amplitude=1.0, length=16.0, samples_per_wavelength=samples)
        # Whole waves off the ends, where the not-a-knot conditions would dominate.
        inside = np.abs(wave.x) < 6.0 + 1e-9
        figures = roughness(Profile(wave.x[inside], wave.height[inside]))
        errors.append(abs(figures.rq - 1 / sqrt(2)))
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all(np.abs(orders - 4.0) < 0.5), orders


@pytest.mark.parametrize("scale", [1e-12, 1e-6, 1.0])
@pytest.mark.parametrize("stretch", [1e-6, 1e3])
def test_units_do_not_matter(scale, stretch):
    base = self_affine(hurst=0.8, samples=400, length=1.0, seed=5, rms_height=1.0)
    wanted = as_array(roughness(base))
    figures = as_array(roughness(Profile(stretch * base.x, scale * base.height)))
    figures[[0, 1, 2, 5]] /= scale
    figures[6:] /= scale / stretch
    np.testing.assert_allclose(figures, wanted, rtol=1e-9, atol=1e-12)


def test_offset_and_mirror_change_only_what_they_should():
    base = self_affine(hurst=0.8, samples=400, length=1e-3, seed=5, rms_height=1e-7)
    wanted = roughness(base)
    lifted = roughness(Profile(base.x, base.height + 1e-3))
    assert lifted.mean == pytest.approx(1e-3 + wanted.mean, rel=1e-12)
    np.testing.assert_allclose(as_array(lifted)[1:], as_array(wanted)[1:], rtol=1e-8)
    other_way = as_array(roughness(mirrored(base)))
    np.testing.assert_allclose(other_way[1:], as_array(wanted)[1:], rtol=1e-9)
    upside_down = roughness(Profile(base.x, -base.height))
    assert upside_down.rsk == pytest.approx(-wanted.rsk, rel=1e-9)


def test_flat_profile_has_no_roughness():
    figures = roughness(Profile(UNEVEN, np.full(len(UNEVEN), 2.5)))
    assert figures.mean == 2.5
    assert np.all(as_array(figures)[1:] == 0.0)


@pytest.mark.parametrize("waves", [4, 30])
def test_shortest_wavelength_of_a_sinusoid_is_its_own(waves):
    wavelength = 12e-6
    wave = sinusoid(wavelength=wavelength, amplitude=1e-7, length=waves * wavelength)
    length = shortest_wavelength(wave)
    # The window spreads a single wave by one wave number step towards short waves.
    assert wavelength / (1.0 + 1.0 / waves) <= length <= wavelength * (1.0 + 1e-9)


@pytest.mark.parametrize(("share", "waves"), [(0.02, 100.0), (0.005, 20.0)])
def test_waves_count_from_a_hundredth_of_the_slopes_variance_on(share, waves):
    x = np.linspace(0.0, 1.0, 4001)
    short = np.sqrt(share / (1.0 - share)) * np.sin(2 * pi * 100 * x) / 100
    profile = Profile(x, np.sin(2 * pi * 20 * x) / 20 + short)
    assert 1 / shortest_wavelength(profile) == pytest.approx(waves, abs=1.5)


@pytest.mark.parametrize("cut_off", [5e-6, 20e-6])
def test_shortest_wavelength_of_a_self_affine_profile_is_its_cut_off(cut_off):
    how = {"hurst": 0.8, "samples": 4001, "length": 2e-3, "rms_slope": 0.05}
    profiles = [self_affine(**how, seed=seed, shortest_wavelength=cut_off) for seed in range(6)]
    lengths = [shortest_wavelength(profile) for profile in profiles]
    # Slope power ~ k^(1 - 2H): 99 % of it lies below 0.975 of the cut-off wave number.
    assert np.mean(lengths) == pytest.approx(cut_off / 0.975, rel=0.02)
    assert np.all(np.abs(np.array(lengths) / cut_off - 1.0) < 0.1)


def test_shortest_wavelength_on_uneven_samples_and_other_units():
    x = np.cumsum(np.random.default_rng(4).uniform(0.5, 1.5, 3000))
    x = x / x[-1]
    profile = Profile(x, np.sin(2 * pi * 40 * x))
    length = shortest_wavelength(profile)
    assert 1 / 41 <= length <= 1 / 39.9
    scaled = Profile(1e-3 * x, 1e-9 * profile.height + 1e-4)
    assert shortest_wavelength(scaled) == pytest.approx(1e-3 * length, rel=1e-6)
    assert shortest_wavelength(mirrored(profile)) == pytest.approx(length, rel=1e-9)


def test_tilt_has_no_wavelength():
    x = np.linspace(0.0, 1e-3, 500)
    for height in (np.zeros(500), np.full(500, 1e-3), 0.01 * x + 1e-6):
        assert shortest_wavelength(Profile(x, height)) == inf
    wave = 1e-7 * np.sin(2 * pi * 25 * x / 1e-3)
    tilted = shortest_wavelength(Profile(x, wave + 0.1 * x))
    assert tilted == pytest.approx(shortest_wavelength(Profile(x, wave)), rel=1e-6)


# Ra, Rq [um], skewness, rms slope, shortest wavelength [um] as PROVENANCE.md states them.
STATED = {
    "ground_unrun": (0.364, 0.461, -0.88, 0.067, 10.0),
    "ground_run_in": (0.196, 0.282, -2.44, 0.043, None),
    "ground_polished": (0.145, 0.188, -0.94, 0.015, None),
}


@pytest.mark.parametrize("name", STATED)
def test_profiles_of_the_project_have_their_stated_figures(name):
    profile = read_profile(PROFILES / f"{name}.csv", x_scale=1e-6, height_scale=1e-6).profile
    figures = roughness(profile)
    ra, rq, rsk, slope, cut_off = STATED[name]
    np.testing.assert_allclose([1e6 * figures.ra, 1e6 * figures.rq], [ra, rq], atol=0.5e-3)
    assert figures.rsk == pytest.approx(rsk, abs=0.005)
    assert figures.rms_slope == pytest.approx(slope, abs=0.5e-3)
    if cut_off is not None:
        assert 1e6 * shortest_wavelength(profile) == pytest.approx(cut_off, rel=0.05)


# Ra, Rq, Rt [um] of the samples, and their finite-difference rms slope.
SAMPLED = {
    "real_stylus_mitutoyo": (3.30584, 3.968897, 22.23523, 0.155932),
    "real_confocal_lay_row": (0.013935, 0.017138, 0.08388, 0.003732),
    "real_stylus_dektak": (0.081254, 0.094243, 0.45642, 0.00946),
}


@pytest.mark.parametrize("name", SAMPLED)
def test_measured_profiles_have_their_certified_figures(name):
    path = MEASURED / f"{name}.csv"
    if not path.exists():
        pytest.skip(f"measured profile {name}.csv is not beside the repository")
    profile = read_profile(path, x_scale=1e-6, height_scale=1e-6).profile
    figures = roughness(profile)
    ra, rq, rt, slope = SAMPLED[name]
    np.testing.assert_allclose([1e6 * figures.ra, 1e6 * figures.rq], [ra, rq], rtol=2e-3)
    assert rt * (1 - 1e-6) <= 1e6 * figures.rt <= 1.01 * rt  # the spline may overshoot a little
    # Finite differences average the slope over a spacing, and so fall short of the spline's.
    assert slope <= figures.rms_slope <= 1.06 * slope
    spacing = profile.spacing
    assert 2.0 * spacing * 0.9 <= shortest_wavelength(profile) <= 20.0 * spacing


def test_summits_of_two_waves():
    """cos x + cos(x/2)/10: summits alternate between 1.1 and 0.9, near enough to their x."""
    x = np.linspace(-2.0 * np.pi, 14.0 * np.pi, 6401)
    profile = Profile(x, np.cos(x) + 0.1 * np.cos(0.5 * x))
    spread, curvature = summits(profile)
    assert spread == pytest.approx(0.1, rel=0.02)
    assert curvature == pytest.approx(1.0, rel=1e-2)
    assert summits(Profile(x, 0.1 * x)) == (0.0, 0.0)


def test_a_power_spectrum_holds_the_mean_square_height():
    profile = self_affine(hurst=0.8, samples=4096, length=1e-3, rms_height=1e-6, seed=3)
    wavenumber, density = power_spectrum(profile)
    assert np.sum(density) * wavenumber[0] == pytest.approx(1e-12, rel=0.15)
    x = 1e-6 * np.arange(2000)
    wave = Profile(x, 2e-7 * np.sin(2.0 * np.pi * 20.0 * x / x[-1]))
    wavenumber, density = power_spectrum(wave)
    assert wavenumber[np.argmax(density)] == pytest.approx(20.0 / x[-1], rel=1e-9)
    assert np.sum(density) * wavenumber[0] == pytest.approx(2e-14, rel=1e-3)


def test_a_bearing_curve_is_that_of_a_wave():
    """The share c of a sine is as high as cos(pi c)."""
    x = np.linspace(0.0, 1.0, 2001)
    share, height = bearing_curve(Profile(x, np.sin(2.0 * np.pi * 20.0 * x)))
    np.testing.assert_allclose(height, np.cos(np.pi * share), atol=3e-3)


LENGTH, OF_FILTER = 40.0, 1.0
X = np.linspace(0.0, LENGTH, 40 * 64 + 1)
ROUGH = self_affine(hurst=0.8, samples=1001, length=1e-2, seed=8, rms_height=1e-6)


def wave(x: np.ndarray, wavelength: float) -> np.ndarray:
    return np.cos(2.0 * pi * x / wavelength + 0.3)


def inside(x: np.ndarray, margin: float = 2.0 * OF_FILTER) -> np.ndarray:
    return (x > x[0] + margin) & (x < x[-1] - margin)


def least_squares_line(profile: Profile, cutoff: float, place: float) -> float:
    """The line fitted to the spline with the weighting function, at `place`, by a fine sum."""
    t = np.linspace(profile.x[0], profile.x[-1], 200_001)
    weight = np.exp(-pi * ((t - place) / (ALPHA * cutoff)) ** 2)
    weight[[0, -1]] *= 0.5
    basis = np.stack((np.ones_like(t), (t - place) / cutoff))
    return np.linalg.solve((basis * weight) @ basis.T, (basis * weight) @ profile.spline()(t))[0]


@pytest.mark.parametrize("wavelength", [0.25, 0.5, 1.0, 2.0, 4.0])
def test_waves_pass_as_the_standard_says(wavelength):
    share = transmission(wavelength, OF_FILTER)
    assert share == pytest.approx(np.exp(-pi * (ALPHA * OF_FILTER / wavelength) ** 2), rel=1e-13)
    line = mean_line(Profile(X, wave(X, wavelength)), OF_FILTER)
    # no part of it out of phase, or the difference would show it
    assert np.max(np.abs(line - share * wave(X, wavelength))[inside(X)]) < 2e-7


def test_both_cutoffs_leave_the_waves_between():
    waves = {0.125: 1.0, 0.5: 0.3, 8.0: 2.0}
    x = np.linspace(0.0, LENGTH, 40 * 256 + 1)
    profile = Profile(x, sum(a * wave(x, w) for w, a in waves.items()))
    height = filtered(profile, 2.0, 0.1).height
    wanted = sum(
        a * transmission(w, 0.1) * (1.0 - transmission(w, 2.0)) * wave(x, w)
        for w, a in waves.items()
    )
    assert np.max(np.abs(height - wanted)[inside(x, 4.0)]) < 2e-6


def test_uneven_samples_change_nothing():
    x = np.concatenate(([0.0], np.cumsum(np.random.default_rng(1).uniform(0.2, 1.8, 4000))))
    x *= LENGTH / x[-1]
    line = mean_line(Profile(x, wave(x, OF_FILTER)), OF_FILTER)
    assert np.max(np.abs(line - 0.5 * wave(x, OF_FILTER))[inside(x)]) < 1e-6


@pytest.mark.parametrize("sample", [0, 1, 3, 10, 32, 320, 640])
def test_up_to_the_ends_it_is_the_line_fitted_with_the_same_weights(sample):
    x = X[:641]
    profile = Profile(x, wave(x, 1.5) + 0.3 * wave(x, 0.4))
    line = mean_line(profile, OF_FILTER)[sample]
    assert line == pytest.approx(least_squares_line(profile, OF_FILTER, x[sample]), abs=5e-6)


def test_short_cutoff_at_its_bound_is_integrated_too():
    x = np.linspace(0.0, 1.0, 101)
    profile = Profile(x, np.random.default_rng(2).standard_normal(101))
    line = mean_line(profile, 0.02)
    for sample in (1, 5, 50, 99):
        wanted = least_squares_line(profile, 0.02, x[sample])
        assert line[sample] == pytest.approx(wanted, abs=5e-5)


def test_a_straight_line_is_no_roughness():
    for x in (X, X**1.1):
        line = Profile(x, 3.0 + 0.2 * x)
        assert np.max(np.abs(filtered(line, OF_FILTER).height)) < 1e-11


@pytest.mark.parametrize("cutoff", [1e-4, 8e-4])
def test_agrees_with_the_filter_of_scipy(cutoff):
    pitch = ROUGH.spacing
    sigma = ALPHA * cutoff / np.sqrt(2.0 * pi) / pitch
    theirs = gaussian_filter1d(ROUGH.height, sigma, truncate=12.0)
    ours = mean_line(ROUGH, cutoff)
    middle = inside(ROUGH.x, 2.0 * cutoff)
    assert np.max(np.abs(ours - theirs)[middle]) < 2e-4 * np.std(theirs)


def test_filters_scale_and_mirror():
    line = mean_line(ROUGH, 5e-4)
    scaled = mean_line(Profile(1e3 * ROUGH.x, 1e-6 * ROUGH.height), 0.5)
    np.testing.assert_allclose(scaled, 1e-6 * line, rtol=0.0, atol=1e-12 * 1e-12)
    other_way = mean_line(mirrored(ROUGH), 5e-4)[::-1]
    np.testing.assert_allclose(other_way, line, rtol=0.0, atol=1e-11 * np.max(np.abs(line)))
    lifted = mean_line(Profile(ROUGH.x, ROUGH.height + 1.0), 5e-4)
    np.testing.assert_allclose(lifted - 1.0, line, rtol=0.0, atol=1e-14)


def test_error_of_the_grid_falls_with_its_step(monkeypatch):
    """Quintic spline between points of the grid: sixth order."""
    x = X + 0.002 * np.sin(40.0 * X)  # no even samples
    profile = Profile(x, wave(x, OF_FILTER))
    monkeypatch.setattr(module, "STEPS_PER_SPACING", 1e-9)
    errors = []
    for steps in (8, 11, 16):
        monkeypatch.setattr(module, "STEPS_PER_CUTOFF", steps)
        line = mean_line(profile, OF_FILTER)
        errors.append(np.max(np.abs(line - 0.5 * wave(x, OF_FILTER))[inside(x)]))
    orders = np.log2(np.array(errors[:-1]) / errors[1:]) / np.log2([11 / 8, 16 / 11])
    assert np.all(np.abs(orders - 6.0) < 0.8), (errors, orders)


@pytest.mark.parametrize("cutoff", [0.0, 1.9e-5, 5.1e-3, np.nan])
def test_cutoffs_that_do_not_suit_are_refused(cutoff):
    with pytest.raises(ValueError, match=r"spacings, 2e-05 m, to half of its length, 0\.005 m"):
        mean_line(ROUGH, cutoff)


@pytest.mark.parametrize("bound", [2e-5, 5e-3])
def test_bounds_themselves_are_allowed(bound):
    check_cutoff(ROUGH, bound)


def test_cutoffs_in_the_wrong_order_are_refused():
    with pytest.raises(ValueError, match=r"short cut-off of 0\.001 m must lie below .* 0\.0005 m"):
        filtered(ROUGH, 5e-4, 1e-3)


def test_without_a_cutoff_nothing_changes():
    assert filtered(ROUGH) is ROUGH
