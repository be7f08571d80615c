"""Line, strip and triangle loads: their textbook fields by quadrature, and what leans on them."""

import json
from pathlib import Path

import numpy as np
import pytest

from analytic.exact.point_and_strip import (
    line_load_displacement,
    line_load_stress,
    strip_load_displacement,
    strip_load_stress,
    triangle_load_displacement,
    triangle_load_stress,
)
from analytic.material import Material, dundurs_constants
from analytic.operators.half_plane import HalfPlane
from analytic.stress.elements import hat_stress, strip_stress
from analytic.stress.points import stress_at

DATA = Path(__file__).parents[2] / "data"
BODY = Material(207e9, 0.3)
NAMES = ("sx", "sz", "txz")
GAUSS, WEIGHT = np.polynomial.legendre.leggauss(200)
LOADS = [
    (strip_load_stress, np.ones_like),
    (triangle_load_stress, lambda point: 1.0 - np.abs(point)),
]


def test_line_load_is_in_equilibrium_and_compatible():
    """Divergence of the stress, Laplacian of sx + sz: zero to the differences' fourth order."""
    rng = np.random.default_rng(1)
    x, z = rng.uniform(-2.0, 2.0, 50), rng.uniform(0.5, 2.0, 50)

    def at(dx: float, dz: float) -> tuple[np.ndarray, ...]:
        stress = line_load_stress(1.3, 0.7, x + dx, z + dz)
        return stress.sx, stress.txz, stress.sz

    left = []
    for step in (0.02, 0.01):
        weights = {-2: 1.0, -1: -8.0, 1: 8.0, 2: -1.0}
        along = sum(w * np.array(at(k * step, 0.0)) for k, w in weights.items()) / (12.0 * step)
        down = sum(w * np.array(at(0.0, k * step)) for k, w in weights.items()) / (12.0 * step)
        ring = [at(step, 0.0), at(-step, 0.0), at(0.0, step), at(0.0, -step)]
        mean = sum(s[0] + s[2] for s in ring) - 4.0 * (at(0, 0)[0] + at(0, 0)[2])
        force = np.abs(along[:2] + down[1:]).max()
        left.append((force, np.abs(mean / step**2).max()))
    orders = np.log2(np.array(left[0]) / np.array(left[1]))
    assert orders == pytest.approx([4.0, 2.0], abs=0.1)


def test_line_load_balances_any_arc():
    """Tractions on a half-circle carry P and Q, and no moment about the load."""
    angle = 0.5 * np.pi * (1.0 + GAUSS)
    cosine, sine = np.cos(angle), np.sin(angle)
    for radius in (1e-6, 1.0, 1e6):
        stress = line_load_stress(2.0, -0.5, radius * cosine, radius * sine)
        along = stress.sx * cosine + stress.txz * sine
        down = stress.txz * cosine + stress.sz * sine
        measure = 0.5 * np.pi * radius * WEIGHT
        assert np.sum(measure * along) == pytest.approx(0.5, rel=1e-13)
        assert np.sum(measure * down) == pytest.approx(-2.0, rel=1e-13)
        assert np.abs(cosine * down - sine * along).max() < 1e-15 / radius


@pytest.mark.parametrize(("stress", "load"), LOADS, ids=["strip", "triangle"])
def test_distributed_loads_are_sums_of_line_loads(stress, load):
    """From next to the surface to beyond the place where Gauss's points take over."""
    a, p, q = 2e-3, 3e8, 1e8
    rng = np.random.default_rng(2)
    x, z = a * rng.uniform(-5.0, 5.0, 300), a * rng.uniform(0.15, 5.0, 300)
    expected = np.zeros((3, 300))
    for start in (-1.0, 0.0):
        point = start + 0.5 * (1.0 + GAUSS)
        for at, weight in zip(point, 0.5 * a * WEIGHT * load(point), strict=True):
            part = line_load_stress(weight * p, weight * q, x - a * at, z)
            expected += [part.sx, part.sz, part.txz]
    found = stress(a, p, q, x, z)
    for name, column in zip(NAMES, expected, strict=True):
        np.testing.assert_allclose(getattr(found, name), column, rtol=0.0, atol=8e-15 * p)


@pytest.mark.parametrize(
    ("stress", "resultant"),
    [(strip_load_stress, 2.0), (triangle_load_stress, 1.0)],
    ids=["strip", "triangle"],
)
def test_far_away_each_component_keeps_its_digits(stress, resultant):
    """The resultant's own field, and of second order in a over the distance what is left of it."""
    for distance in (1e3, 1e6, 1e9):
        for slope in (1e-9, 1e-3, 0.7, 40.0):
            x = distance / np.hypot(1.0, slope)
            point = line_load_stress(resultant, 0.4 * resultant, x, slope * x)
            found = stress(1.0, 1.0, 0.4, x, slope * x)
            left = (4.0 + 2.0 * slope**2) / distance**2 + 1e-14
            for name in NAMES:
                assert getattr(found, name) == pytest.approx(getattr(point, name), rel=left, abs=0)


@pytest.mark.parametrize(
    ("textbook", "elements"),
    [(strip_load_stress, strip_stress), (triangle_load_stress, hat_stress)],
)
def test_elements_of_the_field_are_these(textbook, elements):
    """The recast formulas of the project's elements against the printed ones, anywhere."""
    rng = np.random.default_rng(3)
    x = rng.uniform(-4.0, 4.0, 1000)
    z = 10.0 ** rng.uniform(-9.0, 0.6, 1000)
    z[:20] = 0.0
    for friction in (0.0, 0.7):
        printed, recast = textbook(1.0, 1.0, friction, x, z), elements(x, z, 1.0).at(friction)
        for name in NAMES:
            here, there = getattr(printed, name), getattr(recast, name)
            np.testing.assert_allclose(here, there, rtol=0.0, atol=1e-14)


def test_a_line_of_triangles_is_the_field_of_hats():
    nodes = np.arange(6) * 1e-6
    pressure = np.array([1.0, 3.0, 2.0, 0.0, 5.0, 4.0]) * 1e8
    x, z = np.linspace(-3e-6, 8e-6, 23), np.array([[0.0], [1e-8], [2e-6]])
    found = stress_at(nodes, pressure, 0.3, x, z)
    parts = [
        triangle_load_stress(1e-6, p, 0.3 * p, x - at, z)
        for at, p in zip(nodes, pressure, strict=True)
    ]
    for name in NAMES:
        expected = sum(getattr(part, name) for part in parts)
        np.testing.assert_allclose(getattr(found, name), expected, rtol=0.0, atol=1e-14 * 5e8)


def test_surface_of_strip_and_triangle():
    x = np.array([-3.0, -1.0, -0.5, 0.0, 0.25, 1.0, 7.0])
    strip = strip_load_stress(1.0, 2.0, 0.0, x, 0.0)
    under = np.array([0.0, 1.0, 2.0, 2.0, 2.0, 1.0, 0.0])
    for name in ("sx", "sz"):
        np.testing.assert_allclose(getattr(strip, name), -under, atol=1e-15)
    assert np.isinf(strip_load_stress(1.0, 0.0, 1.0, 1.0, 0.0).sx)
    triangle = triangle_load_stress(1.0, 2.0, 0.5, x, 0.0)
    heights = np.maximum(1.0 - np.abs(x), 0.0)
    np.testing.assert_allclose(triangle.sz, -2.0 * heights, atol=1e-15)
    np.testing.assert_allclose(triangle.txz, -0.5 * heights, atol=1e-15)
    assert np.all(np.isfinite(triangle.sx))


def surface_strain(stress, x: np.ndarray) -> np.ndarray:
    """Plane strain along x at the surface, (1+nu)/E ((1-nu) sx - nu sz)."""
    nu = BODY.poissons_ratio
    return (1.0 + nu) / BODY.youngs_modulus * ((1.0 - nu) * stress.sx - nu * stress.sz)


@pytest.mark.parametrize(
    ("stress", "displacement"),
    [
        (strip_load_stress, strip_load_displacement),
        (triangle_load_stress, triangle_load_displacement),
    ],
    ids=["strip", "triangle"],
)
@pytest.mark.parametrize(("p", "q"), [(1e9, 0.0), (0.0, 1e9), (1e9, 3e8)])
def test_displacement_along_the_surface_goes_with_the_stress(stress, displacement, p, q):
    x, step = np.array([-2.5, -0.7, -0.31, 0.2, 0.6, 1.7, 5.0]), 1e-3

    def along(place: np.ndarray) -> np.ndarray:
        return displacement(1.0, p, q, place, BODY, 2.0).along

    slope = (
        8.0 * (along(x + step) - along(x - step)) - along(x + 2 * step) + along(x - 2 * step)
    ) / (12.0 * step)
    expected = surface_strain(stress(1.0, p, q, x, 0.0), x)
    np.testing.assert_allclose(slope, expected, rtol=0.0, atol=1e-9 * np.abs(expected).max())


@pytest.mark.parametrize(
    ("displacement", "load"),
    [(strip_load_displacement, np.ones_like), (triangle_load_displacement, LOADS[1][1])],
    ids=["strip", "triangle"],
)
def test_displacements_are_sums_of_line_loads(displacement, load):
    x = np.array([-40.0, -1.5, 1.2, 3.0, 900.0])
    into, along = np.zeros(5), np.zeros(5)
    for start in (-1.0, 0.0):
        point = start + 0.5 * (1.0 + GAUSS)
        for at, weight in zip(point, 0.5 * WEIGHT * load(point), strict=True):
            part = line_load_displacement(weight * 1e9, weight * 3e8, x - at, BODY, 1.0)
            into += part.into
            along += part.along
    found = displacement(1.0, 1e9, 3e8, x, BODY, 2.0)
    # the datum's constant apart
    for here, there in ((found.into, into), (found.along, along)):
        assert np.ptp(here - there) < 1e-14 * np.ptp(there)


@pytest.mark.parametrize("element", ["strip", "hat"])
def test_reference_displacements(element):
    """Influence coefficients with the datum a thousand elements away."""
    rows = json.loads((DATA / "c_influence_coefficients.json").read_text())["rows"]
    key = "Ku_datum1000" if element == "strip" else "Kh_datum1000"
    kept = [row for row in rows if key in row]
    assert len(kept) > 15
    x = np.array([float(row["offset"]) for row in kept])
    expected = np.array([float(row[key]) for row in kept])
    if element == "strip":
        found = strip_load_displacement(0.5, 1.0, 0.0, x, BODY, 1000.0).into
    else:
        found = triangle_load_displacement(1.0, 1.0, 0.0, x, BODY, 1000.0).into
    found *= BODY.plane_strain_modulus
    np.testing.assert_allclose(found, expected, rtol=1e-14, atol=1e-14)


def test_coupling_has_the_sign_and_size_of_dundurs_beta():
    """A traction in +x presses the surface in front of it down: (2 beta/E') q a unit length."""
    x = np.array([-0.5, 0.5])
    found = strip_load_displacement(1.0, 0.0, 1e9, x, BODY, 1.0).into
    beta = dundurs_constants(BODY, None)[1]
    assert np.diff(found)[0] == pytest.approx(2.0 * beta / BODY.plane_strain_modulus * 1e9)
    squeezed = strip_load_displacement(1.0, 1e9, 0.0, x, BODY, 1.0).along
    assert np.diff(squeezed)[0] == pytest.approx(-np.diff(found)[0])


class TestHalfPlaneOperator:
    """What the numerical half-plane says of one element, against these."""

    PITCH, COUNT = 0.7e-6, 65

    def unit(self, middle: int) -> np.ndarray:
        pressure = np.zeros(self.COUNT)
        pressure[middle] = 1e9
        return pressure

    def offsets(self, middle: int) -> np.ndarray:
        return (np.arange(self.COUNT) - middle) * self.PITCH

    @pytest.mark.parametrize("middle", [0, 20, 64])
    def test_strip_at_the_middle_of_each_element(self, middle):
        operator = HalfPlane(self.COUNT, self.PITCH, BODY.plane_strain_modulus, element="strip")
        found = operator.apply(self.unit(middle)) / self.PITCH
        expected = strip_load_displacement(
            0.5 * self.PITCH, 1e9, 0.0, self.offsets(middle), BODY, operator.datum
        )
        # the datum there is that of ln, here that of L: a constant apart
        assert np.ptp(found - expected.into) < 1e-12 * np.ptp(found)

    @pytest.mark.parametrize("middle", [0, 20, 64])
    def test_hat_averaged_over_each_hat(self, middle):
        operator = HalfPlane(self.COUNT, self.PITCH, BODY.plane_strain_modulus)
        found = operator.apply(self.unit(middle)) / self.PITCH
        expected = np.zeros(self.COUNT)
        for start in (-1.0, 0.0):
            share = 0.5 * (1.0 + GAUSS)
            # squared towards the node, where the displacement is not smooth
            for end, sign in ((0.0, 1.0), (1.0, -1.0)):
                place = end + sign * 0.5 * share**2
                weight = 0.5 * WEIGHT * share
                hat = 1.0 - np.abs(start + place)
                for at, w in zip(start + place, weight * hat, strict=True):
                    expected += (
                        w
                        * triangle_load_displacement(
                            self.PITCH, 1e9, 0.0, self.offsets(middle) + at * self.PITCH, BODY, 1e-3
                        ).into
                    )
        assert np.ptp(found - expected) < 1e-9 * np.ptp(found)

    def test_a_narrow_hat_is_a_line_load_of_second_order(self):
        left = []
        for refinement in (1, 2, 4):
            count, pitch = 64 * refinement + 1, self.PITCH / refinement
            operator = HalfPlane(count, pitch, BODY.plane_strain_modulus)
            pressure = np.zeros(count)
            pressure[0] = 1.0 / pitch
            at = np.array([8, 16, 64]) * refinement
            found = operator.apply(pressure)[at] / pitch
            expected = line_load_displacement(1.0, 0.0, at * pitch, BODY, 1.0).into
            left.append(np.abs(np.diff(found - expected)).max())
        assert np.log2(np.array(left[:-1]) / left[1:]) == pytest.approx([2.0, 2.0], abs=0.02)


def test_what_makes_no_sense_is_refused():
    with pytest.raises(ValueError, match="z must not be negative"):
        strip_load_stress(1.0, 1.0, 0.0, 0.0, -1.0)
    with pytest.raises(ValueError, match="infinite under the line load"):
        line_load_stress(1.0, 0.0, [1.0, 0.0], 0.0)
