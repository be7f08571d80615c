"""Steady conduction: manufactured solutions, Jaeger's moving band, layers, balance of heat.
Thermal stresses: free and constrained bodies, waves of temperature in a half-plane."""

import numpy as np
import pytest
from blocks import structured_block
from heat_loads import BAND, OPEN, UNIT, flux_load, reach_of_half_plane, steady, under_band
from moving_band import band_surface
from scenes import reference

from analytic.material import Material, ThermalMaterial
from fem.body.coating import Coating
from fem.body.elasticity import Support, elastic_body
from fem.body.exact_load import forces_of
from fem.body.surface import boundary_points
from fem.body.triangle import collapsed_gauss, jacobians, shapes
from fem.heat.body import thermal_body
from fem.heat.conduction import Conduction, Surroundings
from fem.heat.thermal_stress import thermal_stress
from fem.stress.stress import evaluate
from meshes.block import BlockSpec, MeshError, real_points
from meshes.build import build_block
from meshes.real_shape import bent, rounded
from meshes.thermal_layer import thermal_spec

MATERIAL = ThermalMaterial(2.0, 3.0, 0.5)
JAEGER = reference("h_heat")["jaeger"]


class Wave:
    """T = sin(a x + b z) exp(c z), its gradient and its Laplacian."""

    a, b, c = 1.3, 0.4, 0.3

    def parts(self, x, z):
        phase, swell = self.a * x + self.b * z, np.exp(self.c * z)
        return np.sin(phase) * swell, np.cos(phase) * swell

    def temperature(self, x, z):
        return self.parts(x, z)[0]

    def gradient(self, x, z):
        sine, cosine = self.parts(x, z)
        return self.a * cosine, self.b * cosine + self.c * sine

    def laplacian(self, x, z):
        sine, cosine = self.parts(x, z)
        return (self.c**2 - self.a**2 - self.b**2) * sine + 2.0 * self.b * self.c * cosine


def load_of(wave, mesh, velocity, radius, degree):
    """Nodal heat of the source in the body and of the flux through all its sides."""
    k = MATERIAL.conductivity

    def source(x, z):
        along, down = wave.gradient(x, z)
        moved = (1.0 - z / radius) * along + x / radius * down
        heat = velocity * MATERIAL.density * MATERIAL.specific_heat * moved
        return heat - k * wave.laplacian(x, z), 0.0 * x

    def flux(x, z):
        along, down = wave.gradient(x, z)
        return k * along, 0.0 * x, k * down

    return forces_of(mesh, flux, source, degree)[:, 0]


def wave_error(cells, velocity, degree, radius=np.inf):
    """L2 error of a wave: the surface takes the flux; the other sides have the temperature."""
    wave = Wave()
    mesh = structured_block(np.linspace(-1, 1, 2 * cells + 1), np.linspace(0, 1, cells + 1))
    mesh = mesh if radius == np.inf else bent(mesh, radius)
    body = thermal_body(mesh, MATERIAL, degree=degree, radius=radius)
    moving = Conduction(body, velocity, Surroundings("held", "held"))
    load = load_of(wave, mesh, velocity, radius, degree)
    rise = steady(moving, load, wave.temperature(*body.nodes.T))
    at, weight = collapsed_gauss(6)
    nodes = real_points(mesh)[mesh.triangles]
    place = np.einsum("mac,qa->mqc", nodes, shapes(at))
    area = np.abs(np.linalg.det(jacobians(nodes, at))) * weight
    value = rise[body.numbering.elements] @ shapes(at, degree).T
    return np.sqrt((area * (value - wave.temperature(place[..., 0], place[..., 1])) ** 2).sum())


@pytest.mark.parametrize("velocity", [0.0, 5.0, -40.0])
@pytest.mark.parametrize(("degree", "order"), [(1, 2.0), (2, 3.0), (3, 4.0)])
def test_manufactured_solution_on_a_block(degree, order, velocity):
    coarse, fine = (wave_error(cells, velocity, degree) for cells in (16, 32))
    assert np.log2(coarse / fine) == pytest.approx(order, abs=0.12)
    assert fine < {1: 1e-3, 2: 2e-5, 3: 2e-7}[degree]


def test_manufactured_solution_on_a_turning_disc():
    coarse, fine = (wave_error(cells, 10.0, 2, 1.6) for cells in (12, 24))
    assert np.log2(coarse / fine) == pytest.approx(3.0, abs=0.15)


def surface_under_band(peclet, layers):
    """Surface x and k T / (q l)."""
    body, _, rise = under_band(peclet, 0.05, layers=layers)
    return body.surface.x, rise[body.surface.point]


@pytest.mark.parametrize(
    "exact", JAEGER, ids=lambda row: f"Peclet number {row['Pe_Vl_over_2kappa']}"
)
def test_jaeger_s_band(exact):
    x, rise = surface_under_band(float(exact["Pe_Vl_over_2kappa"]), 2)
    largest = float(exact["max_kT_over_ql"])
    assert rise.max() == pytest.approx(largest, rel=2e-4)
    for place in (-2, -1, -0.5, 0, 0.5, 1, 1.5):
        value = float(exact[f"kT_over_ql_at_x_{place}"])
        assert np.interp(place, x, rise) == pytest.approx(value, abs=3e-3 * largest)


@pytest.mark.parametrize(("peclet", "bound"), [(100.0, 1e-3), (1000.0, 2e-3)])
def test_a_fast_band_needs_no_upwinding(peclet, bound):
    """The whole surface, with its wake and what lies ahead of the band."""
    x, rise = surface_under_band(peclet, 2)
    exact = band_surface(x, peclet)
    assert np.abs(rise - exact).max() < bound * exact.max()
    assert rise.min() > -bound * exact.max()
    coarse = np.abs(surface_under_band(peclet, 1)[1].max() / exact.max() - 1.0)
    assert coarse < 1e-3 and np.abs(rise.max() / exact.max() - 1.0) < 5e-5


def test_an_open_boundary_stands_for_the_half_plane():
    """At a twentieth of the diffusion length kappa/V, and at rest."""
    load, surface = {}, {}
    for half in (5.0, 10.0):
        spec = thermal_spec([[-1, 1]], 0.1, half_width=half, depth=half)
        body = thermal_body(build_block(spec), UNIT)
        load[half] = flux_load(body, BAND, np.ones(3))
        moving, resting = Conduction(body, -0.005, OPEN), Conduction(body, 0.0, OPEN, reach=1e3)
        point = body.surface.point[np.abs(body.surface.x) <= 1.0]
        surface[half] = [steady(heat, load[half])[point].max() for heat in (moving, resting)]
    at_rest = (np.log(1e3) + 1.0) * 2.0 / np.pi  # middle of the band: mean of ln(reach / |x|)
    moving = band_surface(np.linspace(-1, 1, 401), 0.0025).max()
    assert surface[10.0] == pytest.approx([moving, at_rest], rel=2e-4)
    assert surface[5.0] == pytest.approx(surface[10.0], rel=2e-3)


def disc(radius, reach, velocity):
    """The part of a disc that lies within `reach` of a band, its arc held."""
    half = reach * np.sqrt(1.0 - (0.5 * reach / radius) ** 2)
    length = 1.0 / velocity if velocity else np.inf
    spec = thermal_spec([[-1, 1]], 0.05, half_width=half, depth=half, length=length)
    mesh = rounded(build_block(spec), radius)
    body = thermal_body(mesh, UNIT, radius=radius)
    around = Surroundings("held", "flow" if velocity else "held")
    rise = steady(Conduction(body, velocity, around), flux_load(body, BAND, np.ones(3)))
    return body.surface.x, rise[body.surface.point]


@pytest.mark.parametrize("part", [0.3, 1.0, 1.2])
@pytest.mark.parametrize("radius", [30.0, 60.0])
def test_a_disc_at_rest(radius, part):
    reach = part * radius
    as_far = reach_of_half_plane(reach, radius)
    exact = (np.log(as_far) + 1.0) * 2.0 / np.pi  # middle of the band: mean of ln(as_far / |x|)
    highest = disc(radius, reach, 0.0)[1].max()
    assert highest == pytest.approx(exact, rel=1e-3)
    half_plane = (np.log(reach) + 1.0) * 2.0 / np.pi  # the disc is narrower
    assert highest > (1.0 + 0.05 * part) * half_plane


def turning(x, radius, velocity):
    """Surface temperature at x of a disc that turns past the band, by angular modes of any order nu
    (what enters is never warm): T / q = 1 / (beta I_nu' / I_nu), beta^2 = i w V, nu = w R."""
    step, ring, start = 0.005, 2**18, 2**16
    arc = step * (np.arange(ring) - start)
    edge = radius * np.arcsin(1.0 / radius)
    flux = np.clip((edge - np.abs(arc)) / step + 0.5, 0.0, 1.0)
    flux *= np.cos(np.clip(arc / radius, -1.0, 1.0))  # the band's is counted along x
    wave = 2.0 * np.pi * np.fft.rfftfreq(ring, step)
    wave[0] = wave[1]
    nu, z = radius * wave, radius * np.sqrt(1j * wave * velocity)
    ratio = np.zeros_like(z)  # I_{nu+1} / I_nu, by its continued fraction
    for more in range(100, 0, -1):
        ratio = 1.0 / (2.0 * (nu + more) / z + ratio)
    resistance = radius / (nu + z * ratio)
    resistance[0] = 0.0
    rise = np.fft.irfft(np.fft.rfft(flux) * resistance, ring)
    return np.interp(radius * np.arcsin(x / radius), arc, rise - rise[start - 4000])


def test_a_disc_that_turns():
    x, errors = np.array([-0.8, -0.3, 0.0, 0.45, 0.8, 0.9]), []
    for radius, velocity in ((10.0, 2.0), (10.0, 20.0), (20.0, 2.0)):
        place, rise = disc(radius, radius, velocity)
        exact = turning(x, radius, velocity)
        assert np.interp(x, place, rise) == pytest.approx(exact, abs=2e-3 * exact.max())
        errors.append(1.0 - band_surface(-x, 0.5 * velocity).max() / exact.max())
    slow, fast, flatter = errors  # of the half-plane, which is too cool by as much
    assert 0.05 < slow < 0.06 and 0.01 < fast < 0.015
    assert np.log2(slow / flatter) == pytest.approx(1.0, abs=0.2)


def leaving(conduction, temperature, load):
    """Heat [W/m] that moving material carries out at both sides, and that held nodes take."""
    body, total = conduction.body, 0.0
    sides = boundary_points(body.numbering.flat, body.mesh.spec)
    heat = body.material.density * body.material.specific_heat * conduction.velocity
    for side, sign in ((sides.right, 1.0), (sides.left, -1.0)):
        side = side[np.argsort(body.nodes[side, 1])]
        t, z = temperature[side], body.nodes[side, 1]
        simpson = np.diff(z[::2]) / 6.0 * (t[:-1:2] + 4.0 * t[1::2] + t[2::2])
        total += sign * heat * simpson.sum()
    return total, (load - conduction.matrix @ temperature)[conduction.held].sum()


@pytest.mark.parametrize("velocity", [0.0, 7.0, -200.0])
def test_heat_in_is_heat_out(velocity):
    spec = thermal_spec([[-1, 1]], 0.2, half_width=8, depth=4, length=1 / (velocity or 1e-30))
    body = thermal_body(build_block(spec), MATERIAL)
    slab = Conduction(body, velocity, Surroundings("held", "flow"))
    load = flux_load(body, BAND, np.array([1.0, 3.0, 0.5]))
    carried, taken = leaving(slab, steady(slab, load), load)
    assert load.sum() == pytest.approx(3.75, rel=1e-13)
    assert carried + taken == pytest.approx(load.sum(), rel=1e-10)
    assert (carried > 0.3 * load.sum()) == (velocity != 0.0)


def two_layers(x, velocity, coat, below, thickness):
    """Surface temperature (m,) under a unit band |x| < 1 on a coated half-plane, by Fourier's
    transform: k gamma is each layer's admittance, gamma^2 = xi^2 + i xi V / kappa."""
    nodes, weights = np.polynomial.legendre.leggauss(16)
    edges = np.linspace(0.0, np.sqrt(4000.0), 4001)  # xi = s^2: the root at 0 becomes smooth
    half = 0.5 * np.diff(edges)[:, None]
    s = (edges[:-1, None] + half * (1.0 + nodes)).ravel()
    weight, xi = (half * weights).ravel() * 2.0 * s, s**2
    first, second = (
        layer.conductivity * np.sqrt(xi**2 + 1j * xi * velocity / layer.diffusivity)
        for layer in (coat, below)
    )
    echo = (first - second) / (first + second)
    echo = echo * np.exp(-2.0 * thickness * first / coat.conductivity)
    whole = 2.0 * np.sin(xi) / xi * (1.0 + echo) / (first * (1.0 - echo))
    return np.array([(weight * whole * np.exp(1j * xi * place)).real.sum() / np.pi for place in x])


def is_exact(spec, coat, velocity, x):
    """The coated body on a mesh, and the exact temperatures at x, which it meets."""
    body = thermal_body(build_block(spec), UNIT, coating=Coating(coat, spec.interface))
    rise = steady(Conduction(body, velocity, OPEN), flux_load(body, BAND, np.ones(3)))
    exact = two_layers(x, velocity, coat, UNIT, spec.interface)
    places = np.column_stack([x, np.zeros_like(x)])
    assert body.at(places, rise) == pytest.approx(exact, abs=2e-3 * exact.max())
    return body, exact


@pytest.mark.parametrize("velocity", [0.5, -20.0])
@pytest.mark.parametrize("conductivity", [0.1, 10.0])
def test_a_coated_half_plane(velocity, conductivity):
    coat, thickness = ThermalMaterial(conductivity, 2.0, 1.0), 0.3
    spec = BlockSpec(20.0, 20.0, np.array([[-3.0, 3.0]]), 0.025, 0.2, interface=thickness)
    x = np.array([-2.0, -0.8, -0.3, 0.0, 0.45, 0.8, 2.5])
    _, exact = is_exact(spec, coat, velocity, x)
    bare = two_layers(x, velocity, UNIT, UNIT, thickness)
    assert np.abs(bare / exact - 1.0).max() > 0.1


@pytest.mark.parametrize("velocity", [-2.0, 60.0])
def test_a_thin_coating_is_meshed_where_heat_passes(velocity):
    """A hundredth of the band's half-width thick; beside it the coating has stretched elements."""
    coat, thickness = ThermalMaterial(0.1, 2.0, 1.0), 0.01
    law = {"length": 1.0 / velocity, "interface": thickness}
    spec = thermal_spec([[-1.0, 1.0]], 0.05, half_width=15.0, depth=15.0, **law)
    body, _ = is_exact(spec, coat, velocity, np.array([-0.8, -0.3, 0.0, 0.45, 0.8]))
    assert len(body.nodes) < 75_000


def test_what_is_refused():
    with pytest.raises(MeshError, match=r"thermal layers of 1e-09 m .* are too thin to mesh"):
        thermal_spec([[-1.0, 1.0]], 0.1, half_width=10.0, depth=10.0, length=-1e-9)
    body = thermal_body(structured_block(np.linspace(-1, 1, 5), np.linspace(0, 1, 3)), UNIT)
    with pytest.raises(ValueError, match="at rest its mesh ends within its reach"):
        Conduction(body, 0.0, OPEN)
    assert np.isnan(body.at(np.array([[0.0, 2.0]]), np.zeros(len(body.nodes)))).all()


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


class StressWave:
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
    wave = StressWave(m * StressWave.w)
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
