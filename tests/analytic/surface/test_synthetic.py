"""Computed profiles: exact shapes, spectra as ordered, the same again from the same seed."""

import numpy as np
import pytest
from scenes import PROFILES
from scipy.ndimage import gaussian_filter1d
from text_profiles import GROUND, read_profile

from analytic.profile import MAX_SAMPLES, surface
from analytic.surface.roughness import roughness, shortest_wavelength
from analytic.surface.synthetic import ground_texture, same_spectrum, self_affine, sinusoid, smooth

FRACTAL = {"hurst": 0.7, "samples": 1025, "length": 1e-3, "seed": 1, "rms_slope": 0.05}
WAVE = {"wavelength": 50e-6, "amplitude": 0.2e-6, "length": 1e-3}
MAKERS = {smooth: {"length": 1e-3}, sinusoid: WAVE, self_affine: FRACTAL, ground_texture: GROUND}


def waves(profile):
    """Complex amplitudes of a profile whose last sample repeats its first."""
    period = profile.height[:-1]
    return np.fft.rfft(period) / len(period)


@pytest.mark.parametrize("maker", MAKERS)
def test_profiles_are_centred_and_repeatable(maker):
    profile, again = maker(**MAKERS[maker]), maker(**MAKERS[maker])
    assert profile.x[0] == pytest.approx(-profile.x[-1], rel=1e-15)
    assert profile.length == pytest.approx(MAKERS[maker]["length"], rel=1e-12)
    np.testing.assert_array_equal(profile.x, again.x)
    np.testing.assert_array_equal(profile.height, again.height)


def test_smooth_is_flat():
    profile = smooth(length=2e-3, samples=12)
    assert np.all(profile.height == 0.0)
    np.testing.assert_allclose(profile.x, np.linspace(-1e-3, 1e-3, 12), atol=1e-18)


def test_sinusoid_has_its_crest_in_the_middle():
    profile = sinusoid(**WAVE)
    height = surface(profile)
    k = 2 * np.pi / WAVE["wavelength"]
    assert height(0.0) == WAVE["amplitude"]
    assert height(0.5 * WAVE["wavelength"]) == pytest.approx(-WAVE["amplitude"], rel=1e-12)
    # Away from the ends the spline is as near to the cosine as 64 samples a wave allow.
    x = np.linspace(-0.4e-3, 0.4e-3, 5001)
    error = np.abs(height(x) - WAVE["amplitude"] * np.cos(k * x))
    assert 1e-8 < np.max(error) / WAVE["amplitude"] < 3e-7
    slope_error = np.abs(height(x, 1) + WAVE["amplitude"] * k * np.sin(k * x))
    assert np.max(slope_error) / (WAVE["amplitude"] * k) < 1e-5


def test_sinusoid_covers_the_length_evenly_left_and_right():
    profile = sinusoid(wavelength=3e-6, amplitude=1e-8, length=10e-6, samples_per_wavelength=20)
    assert 10e-6 <= profile.length < 10e-6 + 2 * profile.spacing
    np.testing.assert_allclose(profile.x, -profile.x[::-1], atol=1e-20)
    np.testing.assert_allclose(profile.height, profile.height[::-1], atol=1e-20)


@pytest.mark.parametrize("samples", [257, 256, 1000])
@pytest.mark.parametrize("wanted", [{"rms_slope": 0.05}, {"rms_height": 3e-7}])
def test_self_affine_curve_has_the_rms_that_was_asked(samples, wanted):
    profile = self_affine(hurst=0.6, samples=samples, length=1e-3, seed=9, **wanted)
    figures = roughness(profile)
    (name, value) = next(iter(wanted.items()))
    figure = {"rms_slope": figures.rms_slope, "rms_height": figures.rq}[name]
    assert figure == pytest.approx(value, rel=1e-9)
    assert abs(figures.mean) < 1e-12 * figures.rq
    assert len(profile.x) == samples


def test_self_affine_has_waves_between_its_cut_offs_only():
    cut_offs = {"shortest_wavelength": 8e-6, "longest_wavelength": 100e-6}
    profile = self_affine(**FRACTAL, **cut_offs)
    power = np.abs(waves(profile)) ** 2
    order = np.arange(len(power))
    inside = (order >= 10) & (order <= 125)
    assert np.all(power[inside] > 0.0)
    assert np.max(power[1:][~inside[1:]]) < 1e-28 * np.max(power)
    assert profile.height[-1] == profile.height[0]


def test_default_cut_offs_are_four_samples_and_the_length():
    power = np.abs(waves(self_affine(**FRACTAL))) ** 2
    assert power[1] > 1e-6 * np.sum(power)
    assert power[256] > 0.0 and np.max(power[257:]) < 1e-28 * np.max(power)


@pytest.mark.parametrize("hurst", [0.3, 0.8, 1.0])
def test_self_affine_spectrum_falls_as_its_hurst_exponent_says(hurst):
    profiles = [self_affine(**(FRACTAL | {"hurst": hurst, "seed": seed})) for seed in range(100)]
    power = np.mean([np.abs(waves(p)[1:257]) ** 2 / np.var(p.height) for p in profiles], axis=0)
    order = np.arange(1, 257)
    # Scaling each trace to one rms couples it to its few longest waves: fit beyond these.
    slope = np.polyfit(np.log(order[8:]), np.log(power[8:]), 1)[0]
    assert slope == pytest.approx(-1.0 - 2.0 * hurst, abs=0.05)


def test_self_affine_waves_are_gaussian():
    profiles = [self_affine(**(FRACTAL | {"seed": seed})) for seed in range(40)]
    wave = np.concatenate([waves(p)[16:257] / np.arange(16, 257) ** -1.2 for p in profiles])
    intensity = np.abs(wave) ** 2 / np.mean(np.abs(wave) ** 2)
    # Exponentially distributed intensity: Rayleigh amplitude; 9640 waves leave 3 % of scatter.
    assert np.mean(intensity**2) == pytest.approx(2.0, rel=0.15)
    assert np.mean(intensity > np.log(2.0)) == pytest.approx(0.5, abs=0.02)
    phase = wave / np.abs(wave)
    assert abs(np.mean(phase)) < 0.03 and abs(np.mean(phase**2)) < 0.03


def test_seeds_differ():
    first, second = (self_affine(**(FRACTAL | {"seed": seed})) for seed in (1, 2))
    assert abs(np.corrcoef(first.height, second.height)[0, 1]) < 0.9
    other = ground_texture(**(GROUND | {"seed": 2}))
    assert abs(np.corrcoef(ground_texture(**GROUND).height, other.height)[0, 1]) < 0.9


def test_more_samples_resolve_the_same_self_affine_surface():
    cut_offs = {"shortest_wavelength": 20e-6, "longest_wavelength": 200e-6}
    coarse = self_affine(**FRACTAL, **cut_offs)
    fine = self_affine(**(FRACTAL | {"samples": 4097}), **cut_offs)
    scatter = np.std(coarse.height)
    np.testing.assert_allclose(fine.height[::4], coarse.height, rtol=0.0, atol=2e-4 * scatter)


def test_a_shorter_cut_off_adds_waves_and_keeps_the_others():
    long, short = (
        waves(self_affine(**FRACTAL, shortest_wavelength=cut_off)) for cut_off in (20e-6, 5e-6)
    )
    ratio = short[1:51] / long[1:51]
    np.testing.assert_allclose(ratio, ratio[0].real, rtol=1e-9)
    assert 0.0 < ratio[0].real < 1.0  # one rms slope, shared with the added waves


def test_self_affine_scales_with_its_units():
    base = self_affine(**FRACTAL)
    scaled = self_affine(**(FRACTAL | {"length": 1.0}))
    np.testing.assert_allclose(scaled.height, 1e3 * base.height, rtol=1e-9, atol=1e-12)


def test_ground_texture_repeats_the_unrun_profile_of_the_project():
    shipped = read_profile(PROFILES / "ground_unrun.csv", x_scale=1e-6, height_scale=1e-6).profile
    made = ground_texture(**GROUND)
    np.testing.assert_allclose(made.x, shipped.x - 1118e-6, atol=1e-15)
    decimals = np.round(1e6 * made.height, 5)
    np.testing.assert_array_equal(decimals, np.round(1e6 * shipped.height, 5))


def test_ground_texture_smoothed_repeats_the_polished_profile_of_the_project():
    path = PROFILES / "ground_polished.csv"
    shipped = read_profile(path, x_scale=1e-6, height_scale=1e-6).profile
    ground = ground_texture(**(GROUND | {"seed": 5, "rms_height": 0.47e-6}))
    polished = 0.45 * gaussian_filter1d(ground.height, 5.0, mode="nearest")
    polished -= np.mean(polished)
    np.testing.assert_array_equal(np.round(1e6 * polished, 5), np.round(1e6 * shipped.height, 5))


def test_ground_texture_is_level_deep_valleyed_and_of_the_asked_height():
    for seed in range(5):
        profile = ground_texture(**(GROUND | {"seed": seed}))
        height = profile.height
        assert np.std(height) == pytest.approx(GROUND["rms_height"], rel=1e-12)
        assert abs(np.mean(height)) < 1e-12 * np.std(height)
        assert abs(np.dot(profile.x, height)) < 1e-12 * np.std(height) * np.sum(np.abs(profile.x))
        assert -1.6 < roughness(profile).rsk < -0.4
        # exp() bends the waves, so that a little of the slope lies below their cut-off.
        assert 8e-6 < shortest_wavelength(profile) < 11e-6


def test_one_sidedness_is_the_skewness_by_a_third():
    def skewness(one_sidedness):
        figures = [
            roughness(ground_texture(**(GROUND | {"seed": s, "one_sidedness": one_sidedness}))).rsk
            for s in range(20)
        ]
        return np.mean(figures)

    assert skewness(0.3) - skewness(1e-3) == pytest.approx(-0.9, abs=0.1)


@pytest.mark.parametrize(
    ("maker", "changes", "words"),
    [
        (smooth, {"length": 0.0}, "length must be positive"),
        (sinusoid, {"wavelength": 0.0}, "wavelength must be positive"),
        (sinusoid, {"samples_per_wavelength": 7}, "samples_per_wavelength must be at least 8"),
        (sinusoid, {"length": 1e-6}, "samples; allowed is a whole number from 8"),
        (sinusoid, {"length": 1e6}, f"to {MAX_SAMPLES}"),
        (self_affine, {"hurst": 0.0}, "hurst must lie above 0 and be at most 1"),
        (self_affine, {"hurst": 1.01}, "hurst must lie above 0 and be at most 1"),
        (self_affine, {"rms_height": 1e-6}, "exactly one of rms_slope and rms_height"),
        (self_affine, {"rms_slope": None}, "exactly one of rms_slope and rms_height"),
        (self_affine, {"seed": -1}, "seed must be a whole number of at least 0"),
        (self_affine, {"shortest_wavelength": 1.9e-6}, "below two sample spacings"),
        (self_affine, {"longest_wavelength": 3e-6}, "must be below longest_wavelength"),
        (self_affine, {"longest_wavelength": 2e-3}, "longest_wavelength 0.002 m does not fit"),
        (
            self_affine,
            {"shortest_wavelength": 0.6e-3, "longest_wavelength": 0.9e-3},
            "no wave that fits",
        ),
        (ground_texture, {"rms_height": 0.0}, "rms_height must be positive"),
        (ground_texture, {"roll_off_wavelength": 5e-6}, "roll_off_wavelength must lie between"),
        (ground_texture, {"decay": -1.0}, "decay must be positive"),
        (ground_texture, {"one_sidedness": 3.0}, "one_sidedness must be at most 2"),
    ],
)
def test_parameters_that_make_no_sense(maker, changes, words):
    with pytest.raises(ValueError, match=words):
        maker(**(MAKERS[maker] | changes))


def test_random_traces_have_the_spectrum_of_another():
    """Root mean square height exactly; slope and curvature on average, phases anew."""
    trace = ground_texture(
        rms_height=0.4e-6, samples=4001, length=4e-3, seed=5, roll_off_wavelength=60e-6,
        shortest_wavelength=12e-6, longest_wavelength=300e-6, one_sidedness=0.4,
    )  # fmt: skip
    traces, expected = [same_spectrum(trace, seed) for seed in range(20)], roughness(trace)
    assert np.std(traces[0].height) == pytest.approx(np.std(trace.height), rel=1e-3)
    slopes = [roughness(one).rms_slope for one in traces]
    assert np.mean(slopes) == pytest.approx(expected.rms_slope, rel=0.03)
    bends = [np.std(one.spline()(one.x, 2)) for one in traces]
    assert np.mean(bends) == pytest.approx(np.std(trace.spline()(trace.x, 2)), rel=0.05)
    skewness = [roughness(one).rsk for one in traces]
    assert abs(np.mean(skewness)) < 0.1 and expected.rsk < -0.6  # Gaussian, as the other is not
    assert abs(np.corrcoef(traces[0].height, traces[1].height)[0, 1]) < 0.2
    assert np.array_equal(traces[3].height, same_spectrum(trace, 3).height)
