"""Standard parameters against waves whose figures are known, and against the table of cut-offs."""

from math import pi, sqrt

import numpy as np
import pytest

from analytic.profile import Profile
from analytic.surface.filters import filtered
from analytic.surface.roughness import figures_of, roughness, stretch_of
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
    # Each section holds another part of the long wave, so that none is as high as the whole.
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
    # over an eighth of a wave around its crest: mean square of the cosine
    assert figures.rq == pytest.approx(
        left * AMPLITUDE * sqrt(0.5 * (1.0 + sqrt(8.0) / pi)), rel=0.05
    )
    assert figures.rq > 20.0 * np.std(left * AMPLITUDE * np.cos(np.linspace(-pi / 8, pi / 8, 999)))


def test_low_hills_do_not_part_elements():
    # a ripple of 3 % of the height crosses the mean line many times beside each of its zeros
    profile = waves((AMPLITUDE, 400e-6), (0.06 * AMPLITUDE, 9e-6))
    assert standard_roughness(profile, CUTOFF).rsm == pytest.approx(400e-6, rel=0.01)
    alone = waves((0.06 * AMPLITUDE, 9e-6))
    assert standard_roughness(alone, CUTOFF).rsm == pytest.approx(9e-6, rel=1e-6)


def test_lengths_that_hold_no_element_have_no_width():
    assert standard_roughness(smooth(length=4e-3, samples=2001), CUTOFF).rsm is None
    assert standard_roughness(waves((AMPLITUDE, 6e-3), length=4e-3), CUTOFF).rsm is None


def test_crossings_as_close_as_rounding_have_a_width():
    steep = sinusoid(wavelength=1e-3, amplitude=0.1, length=4e-3)
    assert standard_roughness(steep, 0.25e-3).rsm is None


def test_a_flat_trace_has_figures_of_zero():
    figures = standard_roughness(smooth(length=4e-3, samples=2001), CUTOFF)
    values = (figures.ra, figures.rq, figures.rsk, figures.rku, figures.rt, figures.rz, figures.rdq)
    assert values == (0.0,) * 7


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
    mirrored = standard_roughness(base.mirrored(), CUTOFF, 10e-6)
    scaled = standard_roughness(Profile(50.0 * base.x, 7.0 * base.height), 50.0 * CUTOFF, 5e-4)
    upside_down = standard_roughness(Profile(base.x, -base.height), CUTOFF, 10e-6)
    for name in ("ra", "rq", "rt", "rz"):
        wanted = getattr(figures, name)
        assert getattr(mirrored, name) == pytest.approx(wanted, rel=1e-8)
        assert getattr(upside_down, name) == pytest.approx(wanted, rel=1e-9)
        assert getattr(scaled, name) == pytest.approx(7.0 * wanted, rel=1e-8)
    assert scaled.rsm == pytest.approx(50.0 * figures.rsm, rel=1e-8)
    assert scaled.rdq == pytest.approx(7.0 / 50.0 * figures.rdq, rel=1e-8)
    assert upside_down.rsk == pytest.approx(-figures.rsk, rel=1e-8)
    assert mirrored.rsk == pytest.approx(figures.rsk, rel=1e-7)


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
    assert (
        standard_short_cutoff(waves((AMPLITUDE, 1e-4), length=0.02, samples=20001), cutoff) == short
    )


def test_samples_too_far_apart_have_no_short_cutoff():
    profile = waves((AMPLITUDE, 1e-4), samples=4001)  # 2 um
    assert standard_short_cutoff(profile, 0.8e-3) is None
    assert standard_short_cutoff(profile, 2.5e-3) == 8e-6
    assert standard_short_cutoff(profile, 2e-6) is None
