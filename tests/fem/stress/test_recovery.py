"""Recovered stresses: exact for linear stresses, of high order for smooth ones; the field of a kink
against 30-digit values of hats, Hooke's law; loads on inclined faces."""

import numpy as np
import pytest
from blocks import Manufactured, graded, hooke, structured_block, widened
from scenes import reference

from analytic.material import Material
from fem.body.elasticity import Coating, Support, elastic_body
from fem.body.exact_load import forces_of
from fem.body.surface import straight_down
from fem.body.triangle import GAUSS, gradients, jacobians, reference_nodes, slopes
from fem.stress.kinks import Kinks, Weights
from fem.stress.recovery import Recovery, linear_stress, recovered_stress, stress_nodes
from fem.stress.surface_load import SurfaceLoad, normal, to_surface

MATERIAL = Material(3.0, 0.3)


def body_of(cells):
    line = np.linspace(-1, 1, cells + 1)
    mesh = structured_block(line, np.linspace(0, 1, cells // 2 + 1), seed=5)
    return elastic_body(mesh, MATERIAL, Support())


def element_stress(body, moved, at):
    """sx, sz, txz (m, q, 3) of the elements' own displacements."""
    slope = gradients(body.points[body.mesh.triangles], moved[body.elements], at)
    return linear_stress(slope, body.shear_modulus[:, None], body.lame[:, None])


def stress_of(*strain):
    return np.stack(hooke(*strain), axis=-1)


def test_stresses_of_the_degree_below_the_displacements_are_recovered_exactly(degree):
    mesh = structured_block(np.linspace(-1, 1, 9), np.linspace(0, 1, 5), seed=5)
    body = elastic_body(mesh, MATERIAL, Support(), degree=degree)
    power = degree - 1

    def field(x, z):
        return (x - 0.4 * z + 2.0) ** degree / degree, -((0.3 * x + z + 1.0) ** degree) / degree

    x, z = body.points.T
    first, second = (x - 0.4 * z + 2.0) ** power, -((0.3 * x + z + 1.0) ** power)
    exact = stress_of(MATERIAL, first, second, -0.4 * first + 0.3 * second)
    stress = recovered_stress(body, np.column_stack(field(*body.nodes.T)))
    np.testing.assert_allclose(stress, exact, atol=1e-6 if degree > 1 else 1e-12)


@pytest.mark.parametrize("thickness", [0.25, 0.5])
def test_a_jump_at_an_interface_is_kept(thickness):
    """The displacement bends there; linear stresses on both sides, one or two elements thick."""
    coating = Coating(Material(9.0, 0.2), thickness)
    mesh = structured_block(np.linspace(-1, 1, 9), np.linspace(0, 1, 5))
    body = elastic_body(mesh, MATERIAL, Support(), coating=coating)
    nodes = stress_nodes(body)
    x, z = body.points.T
    below = np.maximum(z - thickness, 0.0)
    moved = np.column_stack([x**2 + below * (x - z), x * z + below * (1.0 + 2.0 * z)])
    stress = recovered_stress(body, moved)

    material = np.zeros(len(nodes.point), dtype=bool)
    material[nodes.triangles] = body.coated[:, None]
    x, z = body.points[nodes.point].T
    coat = stress_of(coating.material, 2 * x, x, z)
    depth = z - thickness
    core = stress_of(MATERIAL, 2 * x + depth, x + 1 + 2 * z + 2 * depth, x - z - depth + z + 0 * x)
    exact = np.where(material[:, None], coat, core)
    np.testing.assert_allclose(stress, exact, atol=1e-6)
    twice = np.bincount(nodes.point)[nodes.point] == 2
    assert twice.sum() == 2 * 17 and np.all(z[twice] == thickness)


def test_stresses_far_from_a_rough_load_do_not_feel_its_roughness(rng):
    """Patches so coarse that five radii reach the load. A linear stress that leaves the surface
    free is exact; that of a hat of force 1, smooth there, is off by a small part of 1 / (pi r)."""
    hats = np.linspace(-1.0, 1.0, 33)
    rough = np.append(0.0, np.append(rng.normal(scale=1e-3, size=31), 0.0))
    line = widened(hats, graded(300.0, 0.05, 1.25))
    mesh = structured_block(line, graded(600.0, 0.05, 1.25), lambda x: np.interp(x, hats, rough))
    body = elastic_body(mesh, MATERIAL, Support())
    load = SurfaceLoad(body, hats, rng.uniform(0.5, 1.5, 31), 0.0, straight_down)
    (x, z), nu = body.nodes.T, MATERIAL.poissons_ratio
    far = np.abs(x) > 5.0  # beside the rough elements

    moved = np.column_stack([x * z, -0.5 * (x**2 + nu / (1.0 - nu) * z**2)])
    exact = np.column_stack([MATERIAL.plane_strain_modulus * z, 0.0 * z, 0.0 * z])
    error = recovered_stress(body, moved, load) - exact
    assert np.abs(error[far]).max() < 1e-10 * np.abs(exact).max()

    flat = hat(0.0)
    error = recovered_stress(body, displacement(flat, body.nodes), load) - stress(flat, body.nodes)
    assert (np.abs(error).max(axis=1) * np.pi * np.hypot(x, z))[far].max() < 0.05


def test_inner_forces_balance_the_load_and_the_support_bears_it():
    """Virtual work of the elements' stresses: the load at free points, the reactions at held."""
    body = body_of(12)
    load = np.zeros(body.mesh.points.shape)
    load[body.surface.point] = np.random.default_rng(8).normal(size=(len(body.surface.x), 2))
    load[body.held] = 0.0
    stress = element_stress(body, body.solve(load), GAUSS)
    nodes = body.points[body.mesh.triangles]
    jacobian = jacobians(nodes, GAUSS)
    slope = np.einsum("qad,mqdc->mqac", slopes(GAUSS), np.linalg.inv(jacobian))
    weight = np.abs(np.linalg.det(jacobian)) / 6.0
    sx, sz, txz = np.moveaxis(stress, -1, 0)
    tensor = np.stack([np.stack([sx, txz], axis=-1), np.stack([txz, sz], axis=-1)], axis=-1)
    force = np.zeros_like(load)
    np.add.at(force, body.mesh.triangles, np.einsum("mq,mqac,mqcd->mad", weight, slope, tensor))
    np.testing.assert_allclose(force[~body.held], load[~body.held], atol=1e-12)
    np.testing.assert_allclose(
        force[body.held].reshape(-1, 2).sum(axis=0), -load.sum(axis=0), atol=1e-11
    )


@pytest.mark.parametrize("thickness", [None, 0.5])
def test_what_is_asked_for_piece_by_piece_is_what_all_at_once_gives(rng, thickness, monkeypatch):
    """Under several friction coefficients together, against each of them alone."""
    coating = thickness and Coating(Material(9.0, 0.2), thickness)
    mesh = structured_block(np.linspace(-1, 1, 17), np.linspace(0, 1, 9), lambda x: 0.03 * x**2)
    body = elastic_body(mesh, MATERIAL, Support(), coating=coating or None)
    hats, pressure = np.linspace(-0.6, 0.6, 9), rng.uniform(0.5, 1.0, 7)
    moved = rng.normal(size=(len(body.nodes), 2, 2))

    def load(friction):
        return SurfaceLoad(body, hats, pressure, friction, lambda x: (0.1 * x, np.ones_like(x)))

    alone = np.stack(
        [recovered_stress(body, moved[:, k], load(mu)) for k, mu in enumerate((0.0, 0.4))], axis=1
    )
    monkeypatch.setattr("fem.stress.recovery.PIECE", 20)
    together = Recovery(body, moved, load(np.array([0.0, 0.4])))
    node = rng.permutation(len(together.known))
    for some in np.array_split(node[: len(node) // 2], 5):
        np.testing.assert_allclose(together.at(some), alone[some], atol=1e-9 * np.abs(alone).max())
    assert not together.known.all()
    assert not np.array_equal(alone[:, 0], alone[:, 1])


def test_the_smallest_block_still_has_stresses():
    mesh = structured_block(np.linspace(-1, 1, 3), np.array([0.0, 1.0]))
    body = elastic_body(mesh, MATERIAL, Support())
    x, z = body.points.T
    exact = stress_of(MATERIAL, 0 * x + 1, 0 * x - 2, 0 * x)
    stress = recovered_stress(body, np.column_stack([x, -2 * z]))
    np.testing.assert_allclose(stress, exact, atol=1e-7)


def test_a_smooth_solution_is_recovered_with_order():
    """Solved, not interpolated. The elements' own stresses at the nodes have order 2 as well, and
    twenty times the error; the boundary's half patches catch up with the inner ones."""
    exact = Manufactured(MATERIAL)
    errors, unrecovered = [], []
    for cells in (8, 16, 32):
        body = body_of(cells)
        moved = body.solve(forces_of(body.mesh, exact.stress, exact.body_force))
        truth = np.stack(exact.stress(*body.points.T), axis=-1)
        error = recovered_stress(body, moved) - truth
        inner = np.all(np.abs(body.points - [0.0, 0.5]) < [0.7, 0.3], axis=1)
        errors.append([np.sqrt(np.mean(error[where] ** 2)) for where in (inner, ~inner)])
        error = element_stress(body, moved, reference_nodes(2)) - truth[body.mesh.triangles]
        unrecovered.append(np.sqrt(np.mean(error[inner[body.mesh.triangles]] ** 2)))
    inner, outer = np.log2(np.divide(errors[:-1], errors[1:])).T
    assert np.all((inner > 1.8) & (inner < 2.5)), inner
    assert np.all((outer > 2.5) & (outer < 3.5)), outer
    assert errors[-1][0] < 0.1 * unrecovered[-1]
    assert errors[-1][1] < 0.1 * unrecovered[-1]


POINTS = reference("hat_stress")["points"]


def all_of(kinks, count):
    """Weights 1 of every kink for `count` patches."""
    number = len(kinks.place)
    first, start = np.zeros(count, dtype=int), number * np.arange(count + 1)
    return Weights(first, start, np.ones(start[-1]))


def as_table(weights, number):
    """Weights (n, each) of all kinks, 0 where a patch does not see them."""
    table = np.zeros((len(weights.first), number))
    for row, first, count, start in zip(
        table, weights.first, weights.count, weights.start, strict=False
    ):
        row[first : first + count] = weights.value[start : start + count]
    return table


def stress(kinks, place):
    every = np.arange(len(place))
    return kinks.stress(all_of(kinks, len(place)), every, place, every[:, None])[:, 0]


def displacement(kinks, place):
    every = np.arange(len(place))
    weights = all_of(kinks, len(place))
    moved = kinks.displacement(weights, every, place, every[:, None], MATERIAL.poissons_ratio)
    return moved[:, 0] / MATERIAL.shear_modulus


def hat(friction, tangent=1.0):
    """Three kinks: pressure 1 at the origin, 0 at a distance of 1 along the tangent."""
    bend = np.array([1.0, -2.0, 1.0])
    place = np.array([-1.0, 0.0, 1.0]) * tangent
    return Kinks(place, np.full(3, tangent, dtype=complex), bend * (-1.0 + 1j * friction))


@pytest.mark.parametrize("friction", [0.0, 0.4])
def test_three_kinks_make_a_hat(friction):
    near = [p for p in POINTS if abs(float(p["x_over_pitch"])) < 10 > float(p["z_over_pitch"])]
    assert len(near) > 20
    place, sx, sz, txz, sliding = (
        np.array([[float(p[name]) for name in names] for p in near])
        for names in (["x_over_pitch", "z_over_pitch"], ["sx"], ["sz"], ["txz"], ["sx_traction"])
    )
    exact = np.column_stack([sx + friction * sliding, sz + friction * txz, txz + friction * sx])
    np.testing.assert_allclose(stress(hat(friction), place), exact, atol=1e-13)


def test_the_displacement_has_the_kinks_stress():
    kinks = hat(0.4, np.exp(0.3j))
    place = np.random.default_rng(3).uniform([-2.0, 0.7], [2.0, 2.0], (20, 2))
    step = 1e-5

    def slope(axis):
        shift = step * np.eye(2)[axis]
        return (displacement(kinks, place + shift) - displacement(kinks, place - shift)) / (
            2 * step
        )

    (exx, uz_x), (ux_z, ezz) = slope(0).T, slope(1).T
    stresses = np.column_stack(hooke(MATERIAL, exx, ezz, ux_z + uz_x))
    np.testing.assert_allclose(stresses, stress(kinks, place), atol=1e-8)


def test_a_turned_surface_turns_stresses_and_displacements():
    turn = np.exp(0.4j)
    c, s = turn.real, turn.imag
    matrix = np.array([[c, -s], [s, c]])
    place = np.random.default_rng(4).uniform([-2.0, 0.1], [2.0, 2.0], (20, 2))
    flat, turned = hat(0.2), hat(0.2, turn)
    sx, sz, txz = stress(flat, place).T
    tensor = matrix @ np.moveaxis(np.array([[sx, txz], [txz, sz]]), -1, 0) @ matrix.T
    expected = np.column_stack([tensor[:, 0, 0], tensor[:, 1, 1], tensor[:, 0, 1]])
    np.testing.assert_allclose(stress(turned, place @ matrix.T), expected, atol=1e-13)
    moved = displacement(flat, place) @ matrix.T
    np.testing.assert_allclose(displacement(turned, place @ matrix.T), moved, atol=1e-13)


def test_sums_over_the_kinks_are_those_of_a_table():
    """Holds whichever patches share a point."""
    rng = np.random.default_rng(5)
    x = np.sort(rng.uniform(-20.0, 20.0, 30))
    kinks = Kinks(x + 0j, np.ones(30, dtype=complex), rng.normal(size=30) + 1j)
    centre = np.column_stack([rng.uniform(-30.0, 30.0, 40), rng.uniform(0.0, 9.0, 40)])
    weights = kinks.weights(centre, rng.uniform(0.2, 2.0, 40), rng.random(40) < 0.8)
    assert 0 < np.count_nonzero(weights.count) < 40
    place = np.column_stack([rng.uniform(-20.0, 20.0, 50), rng.uniform(0.1, 5.0, 50)])
    patch, point = rng.integers(0, 40, 60), rng.integers(0, 50, (60, 6))
    sums = kinks.stress(weights, patch, place, point)

    single = [
        Kinks(k[:1], k[1:2], k[2:])
        for k in np.column_stack([kinks.place, kinks.tangent, kinks.jump])
    ]
    by_kink = np.array([stress(one, place) for one in single])
    expected = np.einsum("rk,krqc->rqc", as_table(weights, 30)[patch], by_kink[:, point])
    np.testing.assert_allclose(sums, expected, atol=1e-13 * np.abs(expected).max())


def test_the_kinks_exert_the_load():
    """Along a straight surface, kinks alone: the force of the load, by length of arc."""
    rise, hats, pressure = 0.3, np.array([-0.6, -0.3, 0.1, 0.5]), np.array([2.0, 3.0])
    line = np.linspace(-1, 1, 17)
    mesh = structured_block(line, np.linspace(0, 1, 5), lambda x: -rise * x)
    body = elastic_body(mesh, Material(1.0, 0.3), Support())
    load = SurfaceLoad(body, hats, pressure, 0.25, lambda x: (0.1 + 0.0 * x, np.ones_like(x)))
    x = np.array([-0.8, -0.5, -0.2, 0.3, 0.7])
    sx, sz, txz = stress(load.kinks, np.column_stack([x, rise * x])).T
    n = normal(load.tangent(x))
    force = np.column_stack([sx * n[:, 0] + txz * n[:, 1], txz * n[:, 0] + sz * n[:, 1]])
    applied = np.interp(x, hats, [0.0, *pressure, 0.0])[:, None] * [0.1 + 0.25, 1.0 - 0.25 * 0.1]
    np.testing.assert_allclose(force, applied / np.hypot(1.0, rise), atol=1e-12)
    s_nn, s_nt = load.across(x)
    _, kinks_nn, kinks_nt = to_surface(load.tangent(x), np.column_stack([sx, sz, txz]))
    np.testing.assert_allclose([kinks_nn, kinks_nt], [s_nn, s_nt], atol=1e-12)
