"""Thermal stresses: free and constrained bodies, waves of temperature in a half-plane."""

import numpy as np
import pytest
from blocks import structured_block

from analytic.material import Material
from fem.body.coating import Coating
from fem.body.elasticity import Support, elastic_body
from fem.heat.thermal_stress import thermal_stress
from fem.stress.stress import evaluate
from meshes.block import BlockSpec
from meshes.build import build_block

STEEL = Material(207e9, 0.3)
ALPHA = 12e-6


def test_an_even_temperature_leaves_a_free_body_without_stress():
    mesh = structured_block(np.linspace(-1, 1, 9), np.linspace(0, 1, 5), seed=3)
    body = elastic_body(mesh, STEEL, Support("frictionless", "free"))
    stress, across = thermal_stress(body, ALPHA, np.full(len(mesh.points), 50.0))
    scale = STEEL.youngs_modulus * ALPHA * 50.0
    assert stress.values == pytest.approx(0.0, abs=1e-10 * scale)
    assert across == pytest.approx(-scale, rel=1e-10)


def test_a_body_held_at_its_sides():
    """sx = sy = -E alpha T / (1 - nu) under any temperature of the depth, in each material."""
    z = np.linspace(0, 1, 21)
    mesh = structured_block(np.linspace(-1, 1, 9), z)
    coat = Material(80e9, 0.2)
    body = elastic_body(mesh, STEEL, Support("frictionless", "rollers"), coating=Coating(coat, 0.2))
    alpha = np.where(body.coated, 3.0 * ALPHA, ALPHA)
    temperature = 30.0 + 20.0 * mesh.points[:, 1] ** 2
    stress, across = thermal_stress(body, alpha, temperature)
    constant = np.empty(len(stress.nodes.point))
    of_steel, of_coat = (
        m.youngs_modulus * a / (1.0 - m.poissons_ratio)
        for m, a in ((STEEL, ALPHA), (coat, 3.0 * ALPHA))
    )
    constant[stress.nodes.triangles] = np.where(body.coated, of_coat, of_steel)[:, None]
    exact = -constant * temperature[stress.nodes.point]
    sx, sz, txz = stress.values.T
    assert sx == pytest.approx(exact, rel=3e-3) and across == pytest.approx(exact, rel=3e-3)
    assert np.abs([sz, txz]).max() < 3e-3 * np.abs(exact).max()


class Wave:
    """T = cos(w x) exp(-m z) in a half-plane z > 0 with a free surface: the potential psi of
    displacement with (m^2 - w^2) psi = (1 + nu)/(1 - nu) alpha T, and Airy's function (a + b z)
    exp(-w z) cos(w x), which takes its tractions off the surface."""

    w = np.pi

    def __init__(self, m):
        self.m = m

    def temperature(self, x, z):
        return np.cos(self.w * x) * np.exp(-self.m * z)

    def stress(self, x, z):
        w, m, nu = self.w, self.m, STEEL.poissons_ratio
        if m == w:  # T is harmonic: no stress in the plane
            return np.zeros((3, *x.shape))
        scale = STEEL.youngs_modulus * ALPHA / ((1.0 - nu) * (m**2 - w**2))  # 2 G psi / T
        b = scale * (w - m)
        even, odd, heat = np.cos(w * x), np.sin(w * x), scale * np.exp(-m * z)
        airy, decay = scale + b * z, np.exp(-w * z)
        sx = -heat * m**2 * even + (w**2 * airy - 2.0 * w * b) * decay * even
        sz = heat * w**2 * even - w**2 * airy * decay * even
        txz = heat * w * m * odd + w * (b - w * airy) * decay * odd
        return np.stack([sx, sz, txz])


@pytest.mark.parametrize("m", [1.3, 1.0, 4.0])
def test_a_wave_of_temperature_in_a_half_plane(m):
    wave = Wave(m * Wave.w)
    x, z = np.meshgrid(np.linspace(-0.8, 0.8, 7), [0.0, 0.02, 0.1, 0.4, 1.0], indexing="ij")
    exact, errors = wave.stress(x, z), []
    scale = STEEL.youngs_modulus * ALPHA
    for size in (0.1, 0.05):
        spec = BlockSpec(1.0, 6.0, np.array([[-1.0, 1.0]]), size, 0.1)
        body = elastic_body(build_block(spec), STEEL, Support("bonded", "rollers"))
        temperature = wave.temperature(*body.points.T)
        nodal, _ = thermal_stress(body, ALPHA, temperature)
        stress = evaluate(body, nodal, x, z)
        errors.append(np.abs(np.stack([stress.sx, stress.sz, stress.txz]) - exact).max() / scale)
    assert errors[1] < 0.02 and np.log2(errors[0] / errors[1]) > 2.0
    if m != 1.0:
        assert np.abs(exact).max() > 0.15 * scale
