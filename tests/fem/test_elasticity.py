"""Patch tests, the order of a manufactured solution, supports and scaling of the elastic body."""

import numpy as np
import pytest

from analytic.material import Material
from fem.elasticity import ElasticBody, Support, elastic_body
from fem.mumps import FemError

MATERIAL = Material(3.0, 0.3)


def wavy(x):
    return 0.03 * np.cos(2.0 * x + 0.3)


@pytest.fixture(scope="module")
def small(structured_block):
    def make(height=None, cells=6):
        return structured_block(
            np.linspace(-1, 1, cells + 1), np.linspace(0, 1, cells // 2 + 1), height, 7
        )

    return make


def stress_of(material, exx, ezz, gxz):
    nu, modulus = material.poissons_ratio, material.youngs_modulus
    factor = modulus / ((1 + nu) * (1 - 2 * nu))
    return (
        factor * ((1 - nu) * exx + nu * ezz),
        factor * ((1 - nu) * ezz + nu * exx),
        material.shear_modulus * gxz,
    )


@pytest.mark.parametrize("height", [None, wavy], ids=["straight", "curved"])
@pytest.mark.parametrize(
    ("support", "strain"),
    [
        (Support("bonded", "free"), (0.0, -1e-3, 2e-3)),
        (Support("frictionless", "free"), (4e-4, -1e-3, 0.0)),
        (Support("frictionless", "rollers"), (0.0, -1e-3, 0.0)),
    ],
    ids=["shear", "stretch", "confined"],
)
def test_constant_strain_is_reproduced_exactly(small, exact_forces, height, support, strain):
    mesh = small(height)
    body = elastic_body(mesh, MATERIAL, support)
    exx, ezz, gxz = strain
    x, z = body.points.T
    exact = np.column_stack([exx * x + gxz * (z - 1.0), ezz * (z - 1.0)])
    sx, sz, txz = stress_of(MATERIAL, exx, ezz, gxz)
    moved = body.solve(exact_forces(mesh, lambda x, z: (sx + 0 * x, sz, txz)))
    np.testing.assert_allclose(moved, exact, atol=1e-13 * np.abs(exact).max() * 100)


@pytest.mark.parametrize("height", [None, wavy], ids=["straight", "curved"])
def test_a_smooth_solution_converges_with_order_three(small, exact_forces, manufactured, height):
    exact = manufactured(MATERIAL)
    errors = []
    for cells in (8, 16, 32):
        mesh = small(height, cells)
        body = elastic_body(mesh, MATERIAL, Support())
        moved = body.solve(exact_forces(mesh, exact.stress, exact.body_force))
        errors.append(l2_error(body, moved, exact.displacement))
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert errors[-1] < 1e-5
    assert np.all(np.abs(orders - 3.0) < 0.15), orders


def l2_error(body: ElasticBody, moved, displacement) -> float:
    """Error between the elements' polynomials and the exact solution, not at the nodes only."""
    from fem.triangle import jacobians, shapes

    line, weight = np.polynomial.legendre.leggauss(5)
    line, weight = 0.5 * (line + 1), 0.5 * weight
    at = np.array([[r, s * (1 - r)] for r in line for s in line])
    weight = np.array([w * v * (1 - r) for r, w in zip(line, weight, strict=True) for v in weight])
    nodes = body.points[body.mesh.triangles]
    place = np.einsum("mac,qa->mqc", nodes, shapes(at))
    value = np.einsum("mac,qa->mqc", moved[body.mesh.triangles], shapes(at))
    exact = np.stack(displacement(place[..., 0], place[..., 1]), axis=-1)
    volume = np.abs(np.linalg.det(jacobians(nodes, at))) * weight
    return float(np.sqrt(np.sum(volume[..., None] * (value - exact) ** 2)))


def pressed(body: ElasticBody) -> np.ndarray:
    """A load that pushes down on a few surface nodes, unevenly."""
    load = np.zeros(body.mesh.points.shape)
    load[body.surface.point[3:8], 1] = [1.0, 2.0, 0.5, 3.0, 1.0]
    return load


def test_points_keep_their_own_numbers(small):
    """The pressed points move most, and nothing depends on how points are numbered."""
    mesh = small()
    body = elastic_body(mesh, MATERIAL, Support())
    moved = body.solve(pressed(body))
    order = np.random.default_rng(2).permutation(len(mesh.points))
    rank = np.argsort(order)
    from dataclasses import replace

    shuffled = replace(
        mesh, points=mesh.points[order], triangles=rank[mesh.triangles], shift=mesh.shift[order]
    )
    again = elastic_body(shuffled, MATERIAL, Support())
    np.testing.assert_allclose(again.solve(pressed(body)[order]), moved[order], atol=1e-13)
    assert np.argmax(moved[:, 1]) in body.surface.point[3:8]


def test_displacement_scales_with_load_and_inversely_with_the_modulus(small):
    mesh = small()
    soft = elastic_body(mesh, Material(1e-3, 0.3), Support())
    hard = elastic_body(mesh, Material(2e12, 0.3), Support())
    moved = soft.solve(pressed(soft))
    np.testing.assert_allclose(hard.solve(5.0 * pressed(hard)) * 2e15, 5.0 * moved, rtol=1e-12)


@pytest.mark.parametrize("size", [1e-9, 1e6])
def test_displacement_does_not_depend_on_the_unit_of_length(structured_block, size):
    line = np.linspace(-1, 1, 7)
    one = elastic_body(structured_block(line, line[3:], wavy), MATERIAL, Support())
    other = elastic_body(
        structured_block(size * line, size * line[3:], lambda x: size * wavy(x / size)),
        MATERIAL,
        Support(),
    )
    np.testing.assert_allclose(
        other.solve(pressed(one)), one.solve(pressed(one)), rtol=1e-9, atol=1e-12
    )


def test_many_loads_at_once_are_the_loads_one_by_one(small):
    body = elastic_body(small(), MATERIAL, Support())
    load = np.random.default_rng(1).normal(size=(3, *body.mesh.points.shape))
    together = body.solve(load)
    for one, moved in zip(load, together, strict=True):
        np.testing.assert_allclose(body.solve(one), moved, rtol=1e-11, atol=1e-14)
    assert body.factor.solves == 6


def test_supports_hold_what_they_say(small):
    load = pressed(elastic_body(small(), MATERIAL, Support()))
    for base in ("bonded", "frictionless"):
        for sides in ("free", "rollers", "fixed"):
            body = elastic_body(small(), MATERIAL, Support(base, sides))
            moved = body.solve(load)
            assert np.all(moved[body.sides.bottom, 1] == 0.0)
            assert (base == "frictionless") == (np.abs(moved[body.sides.bottom, 0]).max() > 0.0)
            flank = np.union1d(body.sides.left, body.sides.right)
            flank = np.setdiff1d(flank, body.sides.bottom)
            assert (sides == "free") == (np.abs(moved[flank, 0]).min() > 0.0)
            assert (sides != "fixed") == (np.abs(moved[flank, 1]).min() > 0.0)


def test_a_body_held_within_is_the_smaller_body(structured_block):
    """The middle of a block, held at half its extent, is a block of half its size."""
    line = np.linspace(-2.0, 2.0, 17)
    large = structured_block(line, np.linspace(0.0, 2.0, 9))
    small = structured_block(line[4:13], np.linspace(0.0, 1.0, 5))
    held = elastic_body(large, MATERIAL, Support("bonded", "fixed", within=(0.99, 0.99)))
    alone = elastic_body(small, MATERIAL, Support("bonded", "fixed"))
    places = {tuple(p): i for i, p in enumerate(np.round(large.points, 9))}
    same = np.array([places[tuple(p)] for p in np.round(small.points, 9)])
    load = np.random.default_rng(3).normal(size=small.points.shape)
    wider = np.zeros(large.points.shape)
    wider[same] = load
    moved = held.solve(wider)
    np.testing.assert_allclose(moved[same], alone.solve(load), atol=1e-12)
    assert not np.any(np.delete(moved, same, axis=0))
    with pytest.raises(ValueError, match="within"):
        Support(within=(0.0, 1.0))


def test_a_body_that_can_slide_refuses_a_net_horizontal_load(small):
    body = elastic_body(small(), MATERIAL, Support("frictionless", "free"))
    load = pressed(body)
    load[body.surface.point[4], 0] = 0.1
    with pytest.raises(ValueError, match="cannot bear a horizontal load"):
        body.solve(load)
    load[body.surface.point[6], 0] = -0.1
    assert np.abs(body.solve(load)).max() > 0.0
    load[body.surface.point[6], 0] = 0.0
    held = elastic_body(small(), MATERIAL, Support("frictionless", "rollers"))
    assert np.abs(held.solve(load)).max() > 0.0


def test_unknown_supports_are_refused():
    with pytest.raises(ValueError, match="'glued'"):
        Support("glued")
    with pytest.raises(ValueError, match="'loose'"):
        Support("bonded", "loose")


def test_roughness_that_turns_elements_over_is_refused(structured_block):
    line = np.linspace(-1, 1, 9)
    mesh = structured_block(line, np.linspace(0, 0.1, 3), lambda x: -0.2 * np.cos(9 * x))
    with pytest.raises(FemError, match=r"\d+ elements of the mesh are turned over"):
        elastic_body(mesh, MATERIAL, Support())
