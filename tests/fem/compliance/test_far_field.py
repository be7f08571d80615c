"""Blocks of any size as the half-plane: displacements, pressures and stresses, datum included."""

from functools import cache

import numpy as np
import pytest
from blocks import SumOfBodies, hooke
from scenes import hat_nodes

from analytic.contact.defect_correction import solve_with_model
from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import solve_contact
from analytic.exact.hertz import hertz_from_load
from analytic.grid import HatGrid
from analytic.material import Material, combined_modulus
from analytic.operators.half_plane import HalfPlane
from analytic.operators.tangential import CoupledHalfPlane
from fem.body.elasticity import Coating, elastic_body
from fem.body.support import Support
from fem.compliance.far_field import FarField, multipoles
from fem.compliance.operator import FiniteElementCompliance
from fem.stress.maximum import maximum
from meshes.block import BlockSpec
from meshes.build import build_block

NU = 0.3
MATERIAL = Material(1.0 - NU**2, NU)  # plane-strain modulus 1
HELD = Support("bonded", "fixed")
HERTZ = hertz_from_load(np.pi / 2.0, 0.5, 1.0)  # half-width 1, peak pressure 1


@cache
def flat_block(size: float, edges: int, growth: float = 0.2):
    return build_block(BlockSpec(size, size, np.array([[-1.4, 1.4]]), 1.0 / edges, growth))


def compliance(mesh, hats, material=MATERIAL, support=HELD, degree=2, far=True):
    body = elastic_body(mesh, material, support, degree=degree)
    return FiniteElementCompliance(
        body, hats, far=FarField(body, hats[0], hats[-1]) if far else None
    )


def field(place, datum=2.0, shear=0.7):
    """The first multipoles' displacements (2, n, 2): unit forces in x and in z on the origin."""
    unit = multipoles(place, 3, datum, NU) / (2.0 * shear)
    return unit[[0, 3]]


def test_first_terms_are_line_loads_of_the_half_plane():
    """Radial stress -2 P cos(theta) / (pi r), no other (Johnson 1985, eqs. 2.15 and 2.20)."""
    shear, step = 0.7, 1e-4
    angle = np.linspace(0.1, np.pi - 0.1, 9)
    place = 1.7 * np.exp(1j * angle)
    along_x = (field(place + step) - field(place - step)) / (2 * step)
    along_z = (field(place + 1j * step) - field(place - 1j * step)) / (2 * step)
    material = Material(2.0 * shear * (1.0 + NU), NU)
    sx, sz, txz = hooke(
        material, along_x[..., 0], along_z[..., 1], along_x[..., 1] + along_z[..., 0]
    )
    radial = -2.0 / (np.pi * 1.7) * np.array([np.cos(angle), np.sin(angle)])
    np.testing.assert_allclose(sx, radial * np.cos(angle) ** 2, atol=1e-7)
    np.testing.assert_allclose(sz, radial * np.sin(angle) ** 2, atol=1e-7)
    np.testing.assert_allclose(txz, radial * np.cos(angle) * np.sin(angle), atol=1e-7)


def test_datum_and_symmetry_of_line_loads():
    """u_z = -2 P / (pi E') ln(r / L) at the surface, u_x = 0 below the load."""
    shear = 0.7
    modulus = 2.0 * shear / (1.0 - NU)
    x = np.array([-3.0, -0.5, 0.5, 3.0])
    expected = -2.0 / (np.pi * modulus) * np.log(np.abs(x) / 2.0)
    np.testing.assert_allclose(field(x + 0j)[1, :, 1], expected, atol=1e-14)
    np.testing.assert_allclose(field(x + 0j)[0, :, 0], expected, atol=1e-14)
    below = field(1j * np.array([0.3, 1.0, 8.0]))
    np.testing.assert_allclose(below[1, :, 0], 0.0, atol=1e-15)
    np.testing.assert_allclose(below[0, :, 1], 0.0, atol=1e-15)


@pytest.mark.parametrize("away", [0.25, 0.5])
def test_series_of_a_load_off_the_centre_converges_with_its_distance(away):
    place = np.exp(1j * np.linspace(0.0, np.pi, 33))
    exact = field(place - away)
    errors = []
    for terms in (6, 12):
        unit = multipoles(place, terms, 2.0, NU).reshape(2, terms, len(place), 2) / 1.4
        series = np.einsum("k,aknc->anc", away ** np.arange(terms), unit)
        errors.append(np.abs(series - exact).max())
    assert errors[0] < 1.5 * away**6
    rate = (errors[1] / errors[0]) ** (1 / 6)
    assert rate == pytest.approx(away, rel=0.15)


@pytest.mark.parametrize("size", [4.0, 20.0])
def test_compliance_is_the_half_planes_datum_and_all(size):
    """Errors of order 4, in the displacement under sliding traction too
    (`analytic.operators.tangential`)."""
    count, pitch = 21, 0.1
    hats = hat_nodes(-1.0, pitch, count)
    every = np.arange(count)
    exact = HalfPlane(count, pitch, 1.0).block(every)
    ratio = (1.0 - 2.0 * NU) / (2.0 * (1.0 - NU))
    skew = CoupledHalfPlane(count, pitch, 1.0, ratio).block(every) - exact
    errors = []
    for edges, growth in ((20, 0.2), (40, 0.1)):
        operator = compliance(flat_block(size, edges, growth), hats)
        normal = operator.matrix()
        dragged = operator.matrix(1.0) - normal
        errors.append(
            [
                np.abs(normal - exact).max() / np.abs(exact).max(),
                np.abs(dragged - skew).max() / np.abs(skew).max(),
            ]
        )
    errors = np.array(errors)
    assert np.all(errors[0] < [2.2e-3, 1.1e-2])
    orders = np.log2(errors[0] / errors[1])
    assert np.all((orders > 3.0) & (orders < 4.5)), orders


def test_other_degrees_have_it_too():
    hats = hat_nodes(-1.0, 0.1, 21)
    exact = HalfPlane(21, 0.1, 1.0).block(np.arange(21))
    for degree, bound in ((1, 6e-2), (3, 1e-4)):
        matrix = compliance(flat_block(10.0, 20), hats, degree=degree).matrix()
        assert np.abs(matrix - exact).max() < bound * np.abs(exact).max()


def test_compliance_is_symmetric_and_what_that_took_is_below_the_mesh_error():
    """Of the operator on pressures and tractions; the mean with the transpose changes it by less
    than a hundredth of its error, and the less the finer the mesh."""
    hats = hat_nodes(-1.0, 0.1, 21)
    exact = HalfPlane(21, 0.1, 1.0).block(np.arange(21))
    skewness, errors = [], []
    for edges, growth in ((20, 0.2), (40, 0.1)):
        operator = compliance(flat_block(4.0, edges, growth), hats)
        matrix = operator.matrix()
        np.testing.assert_allclose(matrix, matrix.T, atol=1e-12 * np.abs(matrix).max())
        assert np.linalg.eigvalsh(matrix).min() > 0.0
        forces = np.hstack([operator.normal.toarray(), operator.tangential.toarray()])
        far = operator.far
        added = forces.T @ far.lifted @ far.moments @ forces
        skewness.append(np.abs(added - added.T).max())
        errors.append(np.abs(matrix - exact).max())
        mean = forces.T @ far.symmetric(forces)
        np.testing.assert_allclose(mean, 0.5 * (added + added.T), atol=1e-13)
        pressed = operator.normal.T @ far.symmetric(operator.normal.toarray())
        np.testing.assert_allclose(pressed, mean[:21, :21], atol=1e-13)
    assert skewness[0] < 0.01 * errors[0]
    assert skewness[1] < 0.01 * errors[1]
    assert 2.0 < np.log2(skewness[0] / skewness[1]) < 7.0


def test_displacement_and_application_are_the_same_but_for_that():
    hats = hat_nodes(-0.7, 0.05, 33)  # off the middle of the block
    operator = compliance(flat_block(10.0, 20), hats)
    pressure = np.random.default_rng(2).uniform(size=33)
    operator.apply(pressure, 0.4)  # with the moments of the far field
    before = operator.body.factor.solves
    applied = operator.apply(pressure, 0.4)
    assert operator.body.factor.solves == before + 1
    moved = operator.weighted(operator.displacement(pressure, 0.4))
    np.testing.assert_allclose(applied, moved, rtol=1e-5)
    np.testing.assert_allclose(applied, operator.matrix(0.4) @ pressure, rtol=1e-10)


@pytest.fixture
def case(pressed):
    """Hertz's contact on a block of some half-widths, whose boundary may be held further in."""

    def of(size, within=np.inf, far=True):
        block = {"half_width": size, "depth": size, "sides": "fixed", "within": (within, within)}
        return pressed(20, far=far, **block)

    return of


def largest_shear(case):
    return maximum(case.body, case.stress(0.0), lambda s: s.tau1, (-2.0, 2.0, 2.0)).value


@pytest.mark.parametrize("size", [4.0, 10.0, 20.0])
def test_stresses_of_small_blocks_are_hertzs(case, size):
    """As near as on a block of 400 half-widths; held, one of 10 errs by 8 % in tau1."""
    assert largest_shear(case(size)) == pytest.approx(HERTZ.tau1_max, rel=1e-3)
    assert largest_shear(case(size, far=False)) > 1.03 * HERTZ.tau1_max
    assert all(case(size).error(friction, 0.15, 2.0) < 8e-4 for friction in (0.0, 0.3))


def test_pressure_and_approach_do_not_depend_on_the_blocks_size(case):
    """One mesh, its outer part held further in: what differs is the boundary's place alone."""
    whole = case(400.0)
    for within in (5.0, 10.0, 40.0):
        part = case(400.0, within)
        assert part.pressure.max() == pytest.approx(whole.pressure.max(), rel=2e-5)
        np.testing.assert_allclose(part.pressure, whole.pressure, atol=1e-4)
        assert part.approach == pytest.approx(whole.approach, rel=5e-4)
    held = case(400.0, far=False)
    assert whole.pressure.max() == pytest.approx(held.pressure.max(), rel=1e-5)


def test_approach_has_the_half_planes_datum(case):
    small = case(10.0)
    operator = HalfPlane(len(small.x), small.weights[0], 1.0)
    load = Constraints(load=HERTZ.load_per_length)
    expected = solve_contact(operator, small.gap, small.weights, load)
    assert small.approach == pytest.approx(expected.approach, rel=1e-4)
    assert small.compliance.far.datum == pytest.approx(operator.datum)


def test_two_bodies_of_different_blocks_add_up():
    soft, hard = Material(1.1, 0.2), Material(3.0, 0.45)
    modulus = combined_modulus(soft, hard)
    hertz = hertz_from_load(np.pi / 2.0 * modulus, 0.5, modulus)  # half-width 1
    grid = HatGrid.within(-1.2, 1.2, 0.05)
    hats = hat_nodes(grid.x[0], grid.pitch, grid.count)
    bodies = (
        compliance(flat_block(10.0, 20), hats, soft),
        compliance(flat_block(20.0, 20), hats, hard),
    )
    model = HalfPlane(grid.count, grid.pitch, modulus)
    solution = solve_with_model(
        SumOfBodies(*bodies),
        model,
        grid.hat_integrals(np.square),
        grid.weights,
        Constraints(load=hertz.load_per_length),
    )
    assert solution.converged
    assert solution.pressure.max() == pytest.approx(hertz.peak_pressure, rel=1e-3)
    exact = model.apply(solution.pressure)
    np.testing.assert_allclose(SumOfBodies(*bodies).apply(solution.pressure), exact, rtol=3e-4)


def test_bodies_that_cannot_have_it_are_refused():
    mesh = flat_block(4.0, 20)
    for support in (Support("bonded", "rollers"), Support("frictionless", "fixed")):
        with pytest.raises(ValueError, match="bonded and sides are fixed"):
            FarField(elastic_body(mesh, MATERIAL, support), -1.0, 1.0)
    body = elastic_body(mesh, MATERIAL, HELD)
    with pytest.raises(ValueError, match=r"0\.525 of the distance .* at most 0\.5"):
        FarField(body, -2.1, 2.1)
    body.coating = Coating(MATERIAL, 0.1)
    with pytest.raises(ValueError, match="of one material"):
        FarField(body, -1.0, 1.0)
