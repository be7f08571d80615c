"""Heated half-spaces and slabs against reference values of 30 digits."""

import numpy as np
import pytest
from scenes import reference

from analytic.heat import transient
from analytic.material import ThermalMaterial

REFERENCE = reference("h_heat")
UNIT = ThermalMaterial(1.0, 1.0, 1.0)
STEEL = ThermalMaterial(46.0, 7850.0, 460.0)
EXACT = 1e-13


def test_step_on_a_half_space():
    for row in REFERENCE["step_semi_infinite"]:
        depth = float(row["y_over_sqrt_kappa_t"])
        rise = transient.step_half_space(depth, 1.0, 1.0)
        assert rise == pytest.approx(float(row["exact"]), rel=EXACT)


def test_step_on_a_slab():
    for row in REFERENCE["step_slab"]:
        late, place = float(row["t_over_tL"]), float(row["y_over_L"])
        rise = transient.step_slab(place, late / 12.0, 1.0, 1.0)
        assert rise == pytest.approx(float(row["exact"]), rel=1e-13)


def test_constant_flux():
    for row in REFERENCE["constant_flux"]:
        time = float(row["t_over_tL"]) / 12.0
        half_space = transient.flux_half_space(0.0, time, 1.0, UNIT)
        assert half_space == pytest.approx(float(row["semi_infinite_exact"]), rel=EXACT)
        slab = transient.flux_slab(0.0, time, 1.0, 1.0, UNIT)
        assert slab == pytest.approx(float(row["slab_insulated_exact"]), rel=EXACT)


def test_pulse():
    for row in REFERENCE["pulse"]:
        duration, time = (float(row[f"{t}_over_tL"]) / 12.0 for t in ("t0", "t"))
        rise = transient.pulse(0.0, time, duration, 1.0, UNIT)
        assert rise == pytest.approx(float(row["semi_infinite"]), rel=EXACT)
        rise = transient.pulse(0.0, time, duration, 1.0, UNIT, thickness=1.0)
        assert rise == pytest.approx(float(row["slab_insulated"]), rel=EXACT)


@pytest.mark.parametrize("place", [0.0, 0.3, 1.0])
def test_images_and_series_meet(place):
    below, above = 0.3 - 1e-14, 0.3 + 1e-14
    for function in (
        lambda tau: transient.step_slab(place, tau, 1.0, 1.0),
        lambda tau: transient.flux_slab(place, tau, 1.0, 1.0, UNIT),
    ):
        assert function(below) == pytest.approx(function(above), rel=EXACT)


def test_slab_keeps_the_heat_that_enters():
    """The mean rise of an insulated slab is q t / (rho c L), in SI."""
    thickness, flux = 2e-3, 5e6
    depth, weight = np.polynomial.legendre.leggauss(40)
    for time in (2e-3, 0.05, 2.0):
        places = 0.5 * thickness * (1.0 + depth)
        rise = transient.flux_slab(places, time, thickness, flux, STEEL)
        mean = flux * time / (STEEL.density * STEEL.specific_heat * thickness)
        assert 0.5 * rise @ weight == pytest.approx(mean, rel=1e-8)
