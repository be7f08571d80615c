"""Stresses against Hertz's exact field, exact tractions at the surface, and evaluation."""

import numpy as np
import pytest
from blocks import graded, structured_block, widened
from layer_stresses import layer_field
from nodal_stress import displacement_under, nodal_stress
from scenes import hat_nodes
from scipy.integrate import trapezoid
from scipy.interpolate import CubicSpline

from analytic.layers.layered import LayeredBody
from analytic.material import Material
from analytic.stress.points import stress_at
from analytic.stress_state import StressState
from fem.body.elasticity import Coating, Support, elastic_body
from fem.body.exact_load import forces_of
from fem.compliance.operator import FiniteElementCompliance
from fem.stress.stress import at_nodes, evaluate, nodal_stresses, within
from fem.stress.surface_load import SurfaceLoad
from meshes.block import BlockSpec
from meshes.build import build_block
from meshes.real_shape import roughen

MATERIAL = Material(1.0, 0.3)
NEAR, DEEP = (0.0, 0.15), (0.15, 2.0)


def parts(stress: StressState) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    return stress.sx, stress.sz, stress.txz


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_stresses_are_hertzs(pressed, friction):
    case = pressed(20)
    assert case.error(friction, *DEEP) < 1e-3
    assert case.error(friction, *NEAR) < 1.1e-2


def layer_errors(edges, friction, pressure_of, pitch=1.0, shift=0.0):
    """Relative rms errors of the three stresses on layers as deep as a surface edge.

    Against the exact stresses of the same hats, `pitch` edges wide and `shift` edges beside the
    vertices; at 0, 1, 2 and 6 edges below the surface.
    """
    spec = BlockSpec(4000.0, 4000.0, np.array([[-1.4, 1.4]]), 1.0 / edges, 0.2)
    body = elastic_body(build_block(spec), MATERIAL, Support())
    reach = int(edges / pitch) + 4
    x = (pitch * np.arange(-reach, reach + 1) + shift) / edges
    pressure = pressure_of(x)
    operator = FiniteElementCompliance(body, hat_nodes(x[0], x[1] - x[0], len(x)))
    moved = operator.displacement(pressure, friction)
    nodal = nodal_stress(body, moved, operator.hats, pressure, friction)
    errors = []
    for layer in (0.0, 1.0, 2.0, 6.0):
        depths = (layer + np.linspace(0.05, 0.95, 6)) / edges
        at = np.meshgrid(np.linspace(-1.05, 1.05, 401) + 1e-4, depths)
        exact = np.stack(parts(stress_at(x, pressure, friction, *at)))
        off = np.stack(parts(evaluate(body, nodal, *at))) - exact
        errors.append(np.sqrt(np.mean(off**2) / np.mean(exact**2)))
    return np.array(errors)


def asperities(x):
    heights = np.random.default_rng(1).normal(size=12)
    smooth = CubicSpline(np.linspace(-1, 1, 12), heights)(x)
    return np.where(np.abs(x) <= 1.0, np.maximum(0.0, smooth), 0.0)


def ellipse(x):
    return np.sqrt(np.maximum(0.0, 1.0 - x**2))


@pytest.mark.parametrize(
    ("pressure", "most"), [(ellipse, [8e-4, 5e-4]), (asperities, [4.5e-3, 2.2e-3])]
)
@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_stresses_next_to_the_surface_are_as_good_as_below(pressure, most, friction):
    """Nodal values of quadratic elements alone, even exact ones, leave three times as much in the
    first layer: what is between them is the kinks'."""
    coarse, fine = (layer_errors(edges, friction, pressure) for edges in (20, 40))
    for errors, bound in zip((coarse, fine), most, strict=True):
        first, second, third, deep = errors
        assert 0.2 * bound < first < bound
        assert 0.5 * second < first < 1.6 * third
        assert 0.1 * first < deep
    orders = np.log2(coarse / fine)[:3]
    assert np.all((orders > 0.3) & (orders < 1.5)), orders


@pytest.mark.parametrize(("pitch", "shift"), [(1.0, 0.37), (2.0, 0.0), (3.0, 0.2)])
def test_kinks_may_stand_anywhere_between_the_vertices(pitch, shift):
    first, _, third, _ = layer_errors(20, 0.3, asperities, pitch, shift)
    assert 2e-3 < first < 5.5e-3
    assert first < 2.1 * third


def on_waves(pressure, degree, edges_per_hat):
    """Stresses at 0 to 1 and at 2 to 3 pitches below a wavy surface of slope 0.1, friction 0.3."""
    number, reach = 20, 12.0

    def height(x):
        return (
            0.1 / reach * np.cos(reach * x + 0.7) * np.exp(-20.0 * np.maximum(0, abs(x) - 1.2) ** 2)
        )

    def direction(x):
        return 0.05 * x, np.ones_like(x)

    edge = 1.0 / number / edges_per_hat
    spec = BlockSpec(200.0, 200.0, np.array([[-1.4, 1.4]]), edge, 0.2)
    body = elastic_body(roughen(build_block(spec), height), MATERIAL, Support(), degree=degree)
    x = np.arange(-number - 4, number + 5) / number
    hats = hat_nodes(x[0], x[1] - x[0], len(x))
    moved = displacement_under(body, hats, pressure(x), 0.3, direction)
    nodal = nodal_stress(body, moved, hats, pressure(x), 0.3, direction)
    stresses = []
    for layer in (0.0, 2.0):
        depths = (layer + np.linspace(0.1, 0.9, 5)) / number
        at_x, depth = np.meshgrid(np.linspace(-1.05, 1.05, 1001) + 1e-4, depths)
        stresses.append(np.stack(parts(evaluate(body, nodal, at_x, depth - height(at_x)))))
    return np.array(stresses)


def test_stresses_next_to_a_wavy_surface():
    """Ten edges to a wave; against cubic elements a third as long under the same hats."""
    truth = on_waves(asperities, 3, 3)
    size = np.sqrt(np.nanmean(truth**2, axis=(1, 2, 3)))
    for degree, most in ((2, 7e-3), (3, 3e-3)):
        off = on_waves(asperities, degree, 1) - truth
        first, third = np.sqrt(np.nanmean(off**2, axis=(1, 2, 3))) / size
        assert 0.5 * most < first < most
        assert 0.7 * third < first < 2.5 * third


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_the_errors_fall_with_the_elements(pressed, friction):
    """First order where the pressure's square-root edge rules, second below it."""
    coarse, fine = pressed(10, 0.2), pressed(20, 0.1)
    near = np.log2(coarse.error(friction, *NEAR) / fine.error(friction, *NEAR))
    deep = np.log2(coarse.error(friction, *DEEP) / fine.error(friction, *DEEP))
    assert 0.5 < near < 1.3
    assert 1.5 < deep < 2.4


@pytest.fixture(scope="module")
def coated():
    """A coating three times as stiff on a large block under an ellipse of pressure."""
    edge, thickness = 0.05, 0.25
    beyond = graded(1000.0, edge, 1.2)
    down = np.concatenate([edge * np.arange(5), thickness + beyond])
    mesh = structured_block(widened(edge * np.arange(-28, 29), beyond), down)
    coating = Coating(Material(3.0, 0.2), thickness)
    body = elastic_body(mesh, MATERIAL, Support(), coating=coating)
    x = edge * np.arange(-24, 25)
    operator = FiniteElementCompliance(body, hat_nodes(x[0], edge, len(x)))
    moved = operator.displacement(ellipse(x), 0.3)
    return body, x, nodal_stress(body, moved, operator.hats, ellipse(x), 0.3)


def test_stresses_in_a_coating_are_the_exact_ones_up_to_its_interface(coated):
    body, x, nodal = coated
    coating, edge = body.coating, x[1] - x[0]
    z = np.array([0.2, 0.5, 0.8, 4.2, 4.5, 4.8, 4.999]) * edge
    layered = LayeredBody(coating.material, coating.thickness, MATERIAL)
    exact = layer_field(layered, x, ellipse(x), (-1.1, 1.1), z, 4).at(0.3)
    state = evaluate(body, nodal, *np.meshgrid(exact.x, z))
    off = np.stack(parts(state)) - np.stack(parts(exact.stress))
    size = np.sqrt(np.mean(np.stack(parts(exact.stress)) ** 2))
    first, last = (np.sqrt(np.mean(off[:, rows] ** 2)) / size for rows in (slice(3), slice(3, 7)))
    assert 1e-3 < first < 2.5e-3
    assert 1e-3 < last < 2.5e-3


def test_poissons_ratio_is_that_of_each_side_of_an_interface(coated):
    body, _, nodal = coated
    point, nu = nodal.nodes.point, nodal.stress.poissons_ratio
    on = np.flatnonzero(np.bincount(point) == 2)
    on = on[np.abs(body.points[on, 0]) < 1.0]
    sides = []
    for ratio in (0.2, 0.3):
        node = np.full(len(body.points), -1)
        node[point[nu == ratio]] = np.flatnonzero(nu == ratio)
        sides.append(nodal.values[node[on]])
    sx, sz, txz = np.abs(sides[0] - sides[1]).T
    assert len(on) > 70
    # what must be continuous is, and what may jump does
    assert sz.max() < 0.05 and txz.max() < 0.05
    assert sx.max() > 0.5


def test_kinks_are_not_seen_across_an_interface():
    """Right below a coating one element thick stresses are quadratic between the nodes."""
    coating = Coating(Material(3.0, 0.2), 0.25)
    mesh = structured_block(np.linspace(-1, 1, 9), np.linspace(0, 1, 5))
    body = elastic_body(mesh, MATERIAL, Support(), coating=coating)
    hats, pressure = np.array([-0.25, 0.0, 0.25]), np.ones(1)
    moved = FiniteElementCompliance(body, hats).displacement(pressure, 0.3)
    nodal = nodal_stress(body, moved, hats, pressure, 0.3)
    there = np.arange(len(mesh.triangles)), np.array([[0.2, 0.3]])
    off = within(body, nodal, *there) - within(body, at_nodes(body, nodal.stress), *there)
    assert not off[~body.coated].any()
    assert np.abs(off[body.coated]).max() > 0.01


def test_tractions_at_a_flat_surface_are_exact(pressed):
    case = pressed(20)
    x = np.linspace(-2.0, 2.0, 4001)
    _, sz, txz = parts(evaluate(case.body, case.stress(0.3), x, 0.0 * x))
    np.testing.assert_allclose(sz, -case.pressure_at(x), atol=1e-12)
    np.testing.assert_allclose(txz, -0.3 * case.pressure_at(x), atol=1e-12)


def test_stress_along_the_surface_is_minus_the_pressure_without_friction(pressed):
    """Under any normal pressure on a half-plane sx = sz at the surface (Johnson 1985, eq. 2.22)."""
    case = pressed(40)
    x = np.linspace(-0.9, 0.9, 721)
    sx, sz, _ = parts(evaluate(case.body, case.stress(0.0), x, 0.0 * x))
    assert np.abs(sx - sz).max() < 2e-2
    assert np.sqrt(np.mean((sx - sz) ** 2)) < 5e-3


def test_friction_superposes(pressed):
    case = pressed(10)
    none, some, more = (case.stress(friction).stress for friction in (0.0, 0.2, 0.5))
    for part in ("sx", "sz", "txz"):
        base = getattr(none, part)
        expected = base + 2.5 * (getattr(some, part) - base)
        np.testing.assert_allclose(getattr(more, part), expected, atol=1e-9)


def test_every_level_bears_the_whole_load(pressed):
    """Integral of sz and txz over a horizontal cut; what passes beyond the cut is far smaller."""
    case, friction = pressed(20), 0.3
    x = np.sinh(np.linspace(-7.5, 7.5, 6001))
    for depth in (0.2, 1.0, 5.0):
        _, sz, txz = parts(evaluate(case.body, case.stress(friction), x, depth + 0.0 * x))
        load = case.hertz.load_per_length
        assert -trapezoid(sz, x) == pytest.approx(load, rel=4e-3)
        assert -trapezoid(txz, x) == pytest.approx(friction * load, rel=5e-3)


def hydrostatic(height, slope, cells):
    """A rough block under sz = -1 and confined sides: sx = sz nu/(1-nu) everywhere, txz = 0."""
    line = np.linspace(-1, 1, cells + 1)
    mesh = structured_block(line, np.linspace(0, 1, cells // 2 + 1), height)
    body = elastic_body(mesh, MATERIAL, Support("frictionless", "rollers"))
    ratio = MATERIAL.poissons_ratio / (1.0 - MATERIAL.poissons_ratio)
    moved = body.solve(forces_of(mesh, lambda x, z: (-ratio + 0 * x, -1.0, 0.0)))
    hats, pressure = np.array([-9.0, -8.0, 8.0, 9.0]), np.ones(2)
    nodal = nodal_stress(
        body, moved, hats, pressure, direction=lambda x: (ratio * slope(x), np.ones_like(x))
    ).stress
    return max(
        np.abs(nodal.sx + ratio).max(), np.abs(nodal.sz + 1.0).max(), np.abs(nodal.txz).max()
    )


def test_uniform_stress_under_a_rough_surface():
    """Exact but for the shape of quadratic edges, off by the third order."""
    assert hydrostatic(None, np.zeros_like, 8) < 1e-8
    wave = lambda x: 0.05 * np.cos(3 * x), lambda x: -0.15 * np.sin(3 * x)
    errors = [hydrostatic(*wave, cells) for cells in (16, 32, 64)]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert 1e-6 < errors[-1] < 1e-4
    assert np.all(np.abs(orders - 3.0) < 0.3), orders


def test_a_tilted_pressure_and_its_friction_act_on_the_inclined_face():
    """Traction vector of the nodal stresses on the face equals the force that was applied."""
    line = np.linspace(-1, 1, 65)
    mesh = structured_block(line, np.linspace(0, 1, 17), lambda x: 0.2 * x)
    body = elastic_body(mesh, MATERIAL, Support())

    def direction(x):
        return 0.1 + 0.0 * x, np.ones_like(x)

    hats = hat_nodes(-0.5, 1 / 16, 17)
    node = hats[1:-1]
    pressure = 1.0 - node**2
    moved = displacement_under(body, hats, pressure, 0.25, direction)
    nodal = nodal_stress(body, moved, hats, pressure, 0.25, direction).stress
    at, x = body.surface.point, body.surface.x
    inside = np.abs(x) < 0.49
    normal = np.array([-0.2, -1.0])  # out of the body, times the face's length per x
    along = nodal.sx[at] * normal[0] + nodal.txz[at] * normal[1]
    force = np.column_stack([along, nodal.txz[at] * normal[0] + nodal.sz[at] * normal[1]])
    expected = np.interp(x, node, pressure)[:, None] * [0.1 + 0.25, 1.0 - 0.25 * 0.1]
    np.testing.assert_allclose(force[inside], expected[inside], atol=1e-12)


def test_evaluation_is_quadratic_and_keeps_shapes():
    mesh = structured_block(np.linspace(-1, 1, 7), np.linspace(0, 1, 4), seed=4)
    body = elastic_body(mesh, MATERIAL, Support())
    x, z = body.points.T
    nodal = at_nodes(body, StressState(x**2, x * z - 1, z**2 + x))
    where = np.array([[-1.0, 0.3, 1.0], [0.0, 0.5, 2.0]]), np.array([[0.0, 0.3, 1.0]])
    sx, sz, txz = parts(evaluate(body, nodal, *where))
    a, b = np.broadcast_arrays(*where)
    inside = a <= 1.0
    np.testing.assert_array_equal(np.isnan(sx), ~inside)
    np.testing.assert_allclose(sx[inside], (a**2)[inside], atol=1e-12)
    np.testing.assert_allclose(sz[inside], (a * b - 1)[inside], atol=1e-12)
    np.testing.assert_allclose(txz[inside], (b**2 + a)[inside], atol=1e-12)
    assert evaluate(body, nodal, 0.25, 0.5).sx == pytest.approx(0.0625)


def test_a_traction_of_its_own_is_as_good_as_one_that_goes_with_the_pressure():
    """Along a rough boundary, where it turns with the direction of the pressure."""
    spec = BlockSpec(40.0, 40.0, np.array([[-1.4, 1.4]]), 0.1, 0.3)
    mesh = roughen(build_block(spec), lambda x: 0.03 * np.exp(-(x**2)))
    body = elastic_body(mesh, MATERIAL, Support())
    x = np.linspace(-1.0, 1.0, 21)

    def direction(x):
        return 0.1 * x, np.ones_like(x)

    hats = hat_nodes(x[0], x[1] - x[0], len(x))
    pressure, whole = ellipse(x), []
    moved = displacement_under(body, hats, pressure, 0.3, direction)
    for friction, traction in ((0.3, None), (0.0, 0.3 * pressure)):
        shares = np.array([friction])
        load = SurfaceLoad(body, hats, pressure, shares, direction, traction=traction)
        whole.append(nodal_stresses(moved[:, None], load)[0].values)
    one, other = whole
    np.testing.assert_allclose(one, other, atol=1e-9 * np.abs(one).max())
