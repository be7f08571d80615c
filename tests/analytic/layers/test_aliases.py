"""Sums over aliases: against one by one, layers far thinner than the hats, and their limits."""

from math import fsum

import numpy as np
import pytest

from analytic.layers import aliases
from analytic.layers.aliases import alias_sum, rounded_up
from analytic.layers.layered import LayeredBody, normal_compliance
from analytic.layers.operator import (
    LayeredSurface,
    aliases_of,
    hat_symbol,
)
from analytic.layers.tangential import TangentialLayer
from analytic.material import Material
from analytic.operators.periodic import hat_aliases

CYCLES = np.array([0.001, 0.03, 0.2, 0.37, 0.5])
NU = 0.3
BASES = ["bonded", "frictionless", Material(3e9, 0.0), Material(1e12, 0.45)]
_PIECE = 2**18


def one_by_one(cycle, pitch, body):
    """Every alias up to where the layer is a half-plane, and that one's closed sum."""
    beyond = int(3.5 * pitch / body.thickness) + 1500
    parts = []
    for first in range(1 - beyond, beyond, _PIECE):
        c = cycle + np.arange(first, min(first + _PIECE, beyond))
        k = 2.0 * np.pi * np.abs(c) / pitch
        waves = normal_compliance(body, k)
        parts.append(fsum(waves * (np.sin(np.pi * cycle) / np.pi) ** 4 / c**4))
    modulus = body.material.plane_strain_modulus
    rest = hat_aliases(np.array([cycle]), beyond)[0]
    return pitch * fsum(parts) + pitch**2 / (np.pi * modulus) * rest


@pytest.mark.parametrize("nu", [NU, 0.5 - 1e-12])
@pytest.mark.parametrize("base", BASES, ids=str)
@pytest.mark.parametrize("ratio", [0.5, 3.0, 10.0, 1000.0])
def test_symbols_are_sums_over_all_aliases(ratio, base, nu):
    body = LayeredBody(Material(210e9, nu), 1.0, base)
    expected = [one_by_one(c, ratio, body) for c in CYCLES]
    assert hat_symbol(CYCLES, ratio, body) == pytest.approx(expected, rel=1e-14)


def test_a_layer_a_million_times_thinner_than_the_hats():
    """Incompressible, where the farther aliases matter most."""
    body = LayeredBody(Material(1.0, 0.5 - 1e-12), 1.0, "bonded")
    expected = one_by_one(0.2, 1e6, body)
    assert hat_symbol(np.array([0.2]), 1e6, body)[0] == pytest.approx(expected, rel=1e-13)


@pytest.mark.parametrize("base", ["bonded", "frictionless"])
def test_thin_layers_tend_to_a_bed_of_springs(base):
    """uz = p t/M, whose hats have the products (2 + cos 2 pi c)/3; but for (t/h)^2."""
    layer = Material(210e9, NU)
    stiff = layer.youngs_modulus * (1.0 - NU) / ((1.0 + NU) * (1.0 - 2.0 * NU))
    modulus = stiff if base == "bonded" else layer.plane_strain_modulus
    bed = (2.0 + np.cos(2.0 * np.pi * CYCLES)) / (3.0 * modulus)
    body = LayeredBody(layer, 1.0, base)
    off = [np.abs(hat_symbol(CYCLES, h, body) / (h * bed) - 1.0).max() for h in (1e3, 1e4, 1e6)]
    assert 0.0 < off[1] < 1e-6
    assert 1.8 < np.log10(off[0] / off[1]) < 4.2
    assert off[2] < 1e-11


def test_thin_incompressible_layers_tend_to_a_squeezed_film():
    """uz = k^2 t^3 p/(3 G), whose hats have 4 sin^2(pi c)/h^2 for k^2; but for t/h."""
    material = Material(1.0, 0.5 - 1e-15)
    body = LayeredBody(material, 1.0, "bonded")
    off = []
    for pitch in (1e2, 1e3, 1e4):
        film = 4.0 * np.sin(np.pi * CYCLES) ** 2 / (3.0 * pitch * material.shear_modulus)
        off.append(np.abs(hat_symbol(CYCLES, pitch, body) / film - 1.0)[2:].max())
    assert 0.9 < np.log10(off[0] / off[1]) < 1.1
    assert 0.9 < np.log10(off[1] / off[2]) < 1.1
    assert off[2] < 1e-3


@pytest.mark.parametrize("ratio", [0.1, 10.0, 1e3, 1e6, 1e9])
def test_the_waves_asked_for_hardly_grow_as_the_layer_thins(ratio):
    asked = 0
    beyond = aliases_of(ratio, LayeredBody(Material(1.0, NU), 1.0, "bonded"))

    def wave(c):
        nonlocal asked
        asked += c.size
        return 1.0 / (1.0 + c)

    count = 1000
    alias_sum(wave, np.linspace(0.0, 0.5, count), beyond)
    assert asked < 7 * count + 20 * 16 * 40


@pytest.mark.parametrize("ratio", [1e3, 1e6])
@pytest.mark.parametrize("base", BASES, ids=str)
def test_operators_on_thin_layers_are_finite_and_positive(base, ratio):
    body, count = LayeredBody(Material(210e9, NU), 1.0, base), 128
    ones = np.cos(3.0 * np.arange(count))
    assert ones @ LayeredSurface(count, ratio, body).apply(ones) > 0.0
    assert np.all(np.isfinite(TangentialLayer(count, ratio, body).column))


@pytest.mark.parametrize("count", [4, 16, 32, 64, 4096])
def test_rule_adds_polynomials_over_whole_steps(count):
    places, weights = aliases._rule(count)
    steps = np.arange(count) / count
    for power in (0, 1, 5, 20, 31):
        assert weights @ (places / count) ** power == pytest.approx(np.sum(steps**power), rel=1e-13)


def test_ranges_double():
    assert [rounded_up(j) for j in (1, 4, 5, 8, 9, 3_500_000)] == [4, 4, 8, 8, 16, 4_194_304]
