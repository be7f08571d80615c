"""A layer under one wave, against Airy's stress function fitted to its conditions in 80 digits."""

from decimal import Decimal, localcontext

import numpy as np
import pytest
from exact_stresses import wave_stress
from layer_stresses import BASES, LAYER, coupling_compliance

from analytic.layers.layered import LayeredBody, added, normal_compliance
from analytic.material import Material, dundurs_constants

THICKNESS = 0.7e-3
BASES = BASES | {"far stiffer": Material(1e18, 0.2), "far softer": Material(1e6, 0.4)}


def mode(k, z, rising, times_depth, material):
    """sz, txz, uz, ux, sx of phi = z^j exp(+-kz) cos kx, by differentiation of phi."""
    shear, nu = (Decimal(v) for v in (material.shear_modulus, material.poissons_ratio))
    s = k if rising else -k
    f = [s**n * (s * z).exp() for n in range(4)]
    if times_depth:
        f = [z * f[0], *(z * f[n] + n * s ** (n - 1) * (s * z).exp() for n in (1, 2, 3))]
    sx, sz, txz = f[2], -(k**2) * f[0], k * f[1]
    ux = ((1 - nu) * sx - nu * sz) / (2 * shear * k)
    bend = ((1 - nu) * f[3] + nu * k**2 * f[1]) / (2 * shear * k)
    return sz, txz, (bend - txz / shear) / k, ux, sx


def solved(matrix, right):
    """Gaussian elimination with row exchanges."""
    rows = [[*row, value] for row, value in zip(matrix, right, strict=True)]
    for i in range(len(rows)):
        pivot = max(range(i, len(rows)), key=lambda r: abs(rows[r][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        rows[i] = [value / rows[i][i] for value in rows[i]]
        for r in range(len(rows)):
            if r != i:
                rows[r] = [a - rows[r][i] * b for a, b in zip(rows[r], rows[i], strict=True)]
    return [row[-1] for row in rows]


def exact(body, k, depths):
    """uz, ux of the surface and sx, sz, txz at the depths, in floats, under p and under q."""
    with localcontext() as context:
        context.prec = 80 + int(k * body.thickness)
        k, t = Decimal(k), Decimal(body.thickness)
        kinds = [(False, 0), (False, 1), (True, 0), (True, 1)]
        top = [mode(k, Decimal(0), *kind, body.material) for kind in kinds]
        bottom = [mode(k, t, *kind, body.material) for kind in kinds]
        below = [] if body.rigid else [mode(k, t, *kind, body.base) for kind in kinds[:2]]
        matrix = [[m[i] for m in top] + [Decimal(0)] * len(below) for i in (0, 1)]
        held = {"bonded": (2, 3), "frictionless": (2, 1)}.get(
            body.base if body.rigid else "", (0, 1, 2, 3)
        )
        matrix += [[m[i] for m in bottom] + [-m[i] for m in below] for i in held]
        at = [[mode(k, Decimal(z), *kind, body.material) for kind in kinds] for z in depths]

        def under(pressure, traction):
            right = [Decimal(-pressure), Decimal(-traction)] + [Decimal(0)] * len(held)
            shares = solved(matrix, right)[:4]

            def summed(modes, component):
                return float(sum(s * m[component] for s, m in zip(shares, modes, strict=True)))

            stress = [[summed(modes, component) for modes in at] for component in (4, 0, 1)]
            return summed(top, 2), summed(top, 3), np.array(stress)

        return under(1, 0), under(0, 1)


@pytest.mark.parametrize("w", [1e-8, 1e-4, 0.03, 0.4999, 0.5001, 1.0, 4.0, 30.0])
@pytest.mark.parametrize("nu", [0.0, 0.3, 0.499999])
@pytest.mark.parametrize("base", BASES)
def test_displacements_and_stresses_solve_the_boundary_value_problem(base, nu, w):
    body = LayeredBody(Material(LAYER.youngs_modulus, nu), THICKNESS, BASES[base])
    k, depths = w / THICKNESS, THICKNESS * np.array([0.0, 1e-3, 0.3, 0.9, 1.0])
    stresses = wave_stress(body, k, depths)
    sliding = coupling_compliance(body, k)
    scale = 1.0 / (body.material.shear_modulus * k)
    under_p, under_q = exact(body, k, depths)
    assert normal_compliance(body, k) == pytest.approx(under_p[0], rel=4e-15, abs=0.0)
    for state, coupled, stress in (
        (stresses[0], under_p[1], under_p[2]),
        (stresses[1], under_q[0], under_q[2]),
    ):
        assert sliding == pytest.approx(coupled, rel=4e-15, abs=1e-15 * scale)
        rounding = 2e-12 if base == "far softer" else 4e-15
        assert state.parts == pytest.approx(stress, abs=rounding * max(1.0, np.abs(stress).max()))


@pytest.mark.parametrize("base", BASES)
def test_short_waves_see_a_half_plane_and_nothing_overflows(base):
    body = LayeredBody(LAYER, THICKNESS, BASES[base])
    k = np.array([40.0, 1e4, 1e8]) / THICKNESS
    half_plane = 2.0 / (LAYER.plane_strain_modulus * k)
    assert normal_compliance(body, k) == pytest.approx(half_plane, rel=1e-14)
    coupling = -(1.0 - 2.0 * 0.3) / (2.0 * LAYER.shear_modulus * k)
    assert coupling_compliance(body, k) == pytest.approx(coupling, rel=1e-14)
    for stress in wave_stress(body, k, THICKNESS):
        assert np.all(np.abs(stress.parts) < 1e-14)


def test_long_waves_press_an_evenly_compressed_layer():
    """t/M, M the modulus at hindered (bonded) or free (frictionless) widening."""
    nu = LAYER.poissons_ratio
    bonded = LAYER.youngs_modulus * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu))
    for base, modulus in (("bonded", bonded), ("frictionless", LAYER.plane_strain_modulus)):
        body = LayeredBody(LAYER, THICKNESS, base)
        for k in (0.0, 1e-9 / THICKNESS):
            normal = normal_compliance(body, k)
            assert normal == pytest.approx(THICKNESS / modulus, rel=1e-14)


def test_thin_incompressible_layer_gives_way_as_the_square_of_the_wavenumber():
    """Lubrication flow in the solid: uz = p k^2 t^3/(3 G), short of nu = 1/2 by (1 - 2 nu)."""
    material = Material(1.0, 0.5 - 1e-14)
    body = LayeredBody(material, 1.0, "bonded")
    k = np.array([1e-5, 1e-4, 1e-3])
    expected = k**2 / (3.0 * material.shear_modulus)
    assert normal_compliance(body, k) == pytest.approx(expected, rel=1e-3)


@pytest.mark.parametrize("nu", [0.0, 0.2, 0.45])
def test_a_layer_on_a_half_plane_of_its_own_material_is_a_half_plane(nu):
    material = Material(70e9, nu)
    body = LayeredBody(material, THICKNESS, material)
    k = np.array([1e-8, 1e-3, 0.3, 1.0, 5.0]) / THICKNESS
    modulus = material.plane_strain_modulus
    assert normal_compliance(body, k) == pytest.approx(2.0 / (modulus * k), rel=1e-14)
    for part in added(body.contrast, k * THICKNESS):
        assert np.all(np.abs(part) < 1e-15)


@pytest.mark.parametrize("ratio", [1e6, 1e12])
def test_a_stiff_half_plane_tends_to_a_rigid_base(ratio):
    rigid = LayeredBody(LAYER, THICKNESS, "bonded")
    stiff = LayeredBody(LAYER, THICKNESS, Material(ratio * LAYER.youngs_modulus, 0.3))
    k = np.array([0.01, 0.3, 3.0]) / THICKNESS
    difference = normal_compliance(stiff, k) / normal_compliance(rigid, k) - 1.0
    assert np.all((difference > 0.0) & (difference < 2e4 / ratio))


def test_stresses_depend_on_dundurs_constants_alone():
    """Two pairs of the same alpha and beta, found from g and e2 of the other pair."""
    first = LayeredBody(Material(1.0, 0.3), 1.0, Material(2.5, 0.2))
    alpha, beta = dundurs_constants(first.material, first.base)
    e = 1.0 - 2.0 * 0.35
    ground = (1.0 + e) * (1.0 - alpha) / (1.0 + alpha)  # g (1 + e2)
    weighted = e - beta * (1.0 + e + ground)  # g e2
    softness, nu = ground - weighted, 0.5 * (1.0 - weighted / (ground - weighted))
    layer = Material(1.0, 0.35)
    base = Material(2.0 * (1.0 + nu) * layer.shear_modulus / softness, nu)
    assert dundurs_constants(layer, base) == pytest.approx((alpha, beta), rel=1e-13)
    k, z = np.array([[0.1], [1.0], [3.0]]), np.array([0.0, 0.4, 1.0])
    second = LayeredBody(layer, 1.0, base)
    for a, b in zip(wave_stress(first, k, z), wave_stress(second, k, z), strict=True):
        assert a.parts == pytest.approx(b.parts, abs=1e-13)


@pytest.mark.parametrize(
    ("thickness", "base", "message"),
    [(0.0, "bonded", "thickness"), (np.nan, "bonded", "thickness"), (1.0, "glued", "base")],
)
def test_impossible_layers_are_refused(thickness, base, message):
    with pytest.raises(ValueError, match=message):
        LayeredBody(LAYER, thickness, base)
