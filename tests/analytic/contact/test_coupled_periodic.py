"""Sliding contact of periodic waves: the turned wave when closed, mirrors when open."""

import numpy as np
import pytest

from analytic.contact.coupled import solve_coupled
from analytic.contact.equilibrium import Constraints
from analytic.operators.periodic import PeriodicHalfPlane
from analytic.operators.tangential import CoupledPair, TangentialHalfPlane


class TestPeriodic:
    COUNT, LENGTH, HEIGHT = 256, 50e-6, 0.1e-6

    def wave(self, modulus, friction_dundurs, mean_pressure, count=COUNT):
        """A wavy body, crest at x = 0, under a flat that slides."""
        pitch = self.LENGTH / count
        x = pitch * np.arange(count)
        pair = CoupledPair(
            PeriodicHalfPlane(count, pitch, modulus),
            TangentialHalfPlane(count, pitch, modulus, 0.5, periodic=True),
            friction_dundurs / 0.5,
        )
        k = 2.0 * np.pi / self.LENGTH
        # the hat's average of a wave
        gap = -self.HEIGHT * np.cos(k * x) * pitch * np.sinc(1.0 / count) ** 2
        load = mean_pressure * self.LENGTH
        weights = np.full(count, pitch)
        return x, solve_coupled(pair, gap, weights, Constraints(load=load))

    @pytest.mark.parametrize("friction_dundurs", [0.3, -0.75])
    def test_closed_contact_is_a_turned_wave(self, roller, friction_dundurs):
        """The wave of p sinks by 2 (1 - i mu beta)/(E* k) of itself."""
        k = 2.0 * np.pi / self.LENGTH
        amplitude = 0.5 * roller.modulus * k * self.HEIGHT / np.hypot(1.0, friction_dundurs)
        x, found = self.wave(roller.modulus, friction_dundurs, 1.5 * amplitude)
        exact = 1.5 * amplitude + amplitude * np.cos(k * x + np.arctan(friction_dundurs))
        assert found.converged and np.all(found.pressure > 0.0)
        assert found.pressure == pytest.approx(exact, abs=1e-4 * amplitude)
        errors = []
        for count in (32, 64, 128):
            x, found = self.wave(roller.modulus, friction_dundurs, 1.5 * amplitude, count)
            exact = 1.5 * amplitude + amplitude * np.cos(k * x + np.arctan(friction_dundurs))
            errors.append(np.abs(found.pressure - exact).max())
        orders = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
        assert orders == pytest.approx(2.0, abs=0.1)

    def test_open_contact_mirrors_and_moves_back(self, roller):
        mean = 0.1 * roller.modulus * np.pi * self.HEIGHT / self.LENGTH
        x, forth = self.wave(roller.modulus, 0.5, mean)
        back = self.wave(roller.modulus, -0.5, mean)[1]
        assert forth.converged and np.count_nonzero(forth.pressure == 0.0) > 50
        mirrored = np.roll(back.pressure[::-1], 1)
        assert forth.pressure == pytest.approx(mirrored, abs=1e-8 * forth.pressure.max())
        k = 2.0 * np.pi / self.LENGTH
        assert np.sum(forth.pressure * np.sin(k * x)) < 0.0
