"""Largest stresses: Hertz's values and points, windows, smooth and kinked fields."""

from dataclasses import replace

import numpy as np
import pytest
from blocks import structured_block
from nodal_stress import nodal_stress

from analytic.exact.hertz import hertz_extremes
from analytic.material import Material
from analytic.stress_state import StressState
from fem.body.elasticity import Coating, Support, elastic_body
from fem.body.surface import straight_down
from fem.stress.maximum import NEAR, Search, maxima, maximum
from fem.stress.stress import at_nodes, nodal_stresses
from fem.stress.surface_load import SurfaceLoad


def tau1(stress):
    return stress.tau1


@pytest.mark.parametrize(
    ("edges", "friction", "depth", "place"),
    [(10, 0.0, 1e-2, 0.05), (20, 0.0, 5e-3, 0.05), (40, 0.0, 3e-3, 0.05)]
    + [(20, mu, 2e-2, 0.03) for mu in (0.1, 0.2)],
)
def test_hertzs_largest_shear_and_its_place(pressed, edges, friction, depth, place):
    case = pressed(edges)
    exact = hertz_extremes(case.hertz, friction).tau1
    highest = maximum(case.body, case.stress(friction), tau1)
    assert highest.value == pytest.approx(exact.value, rel=3e-3)
    assert highest.z == pytest.approx(exact.z, rel=depth)
    assert highest.x == pytest.approx(exact.x, abs=place)


def test_largest_orthogonal_shear(pressed):
    case = pressed(20)
    exact = hertz_extremes(case.hertz, 0.0).txz_max
    highest = maximum(case.body, case.stress(0.0), lambda stress: np.abs(stress.txz))
    assert highest.value == pytest.approx(exact.value, rel=3e-3)
    assert highest.z == pytest.approx(exact.z, rel=1.5e-2)
    assert abs(highest.x) == pytest.approx(abs(exact.x), rel=1e-2)


@pytest.fixture(scope="module")
def body():
    mesh = structured_block(np.linspace(-1, 1, 11), np.linspace(0, 1, 7), seed=6)
    return elastic_body(mesh, Material(1.0, 0.3), Support())


def field(body, value):
    return at_nodes(body, StressState(value, 0.0 * value, 0.0 * value))


def test_the_top_of_a_smooth_hill_lies_between_the_nodes(body):
    x, z = body.points.T
    hill = field(body, 2.0 - (x - 0.123) ** 2 - 2.0 * (z - 0.456) ** 2)
    highest = maximum(body, hill, lambda stress: stress.sx)
    assert (highest.value, highest.x, highest.z) == pytest.approx((2.0, 0.123, 0.456), abs=1e-6)


@pytest.fixture(scope="module")
def ridge():
    """A body with an edge of elements along x = 0, and a smooth hill with its top on it."""
    mesh = structured_block(np.linspace(-1, 1, 21), np.linspace(0, 1, 13))
    body = elastic_body(mesh, Material(1.0, 0.3), Support())
    x, z = body.points.T
    return body, np.exp(-2.0 * x**2) * np.cos(2.0 * (z - 0.46))


def test_rounding_does_not_choose_among_elements_that_share_the_top(ridge, rng):
    body, hill = ridge
    tops = []
    for _ in range(10):
        rounded = hill * (1.0 + 1e-14 * rng.standard_normal(len(hill)))
        top = maximum(body, field(body, rounded), lambda stress: stress.sx)
        tops.append((top.value, top.x, top.z))
    assert tops[0] == pytest.approx((1.0, 0.0, 0.46), abs=1e-2)
    assert np.ptp(tops, axis=0) == pytest.approx(np.zeros(3), abs=1e-8)


def test_rounding_does_not_choose_the_polynomial(body, rng):
    x, z = body.points.T
    for _ in range(20):
        hill = np.exp(-((x - rng.uniform(-0.3, 0.3)) ** 2) - 2.0 * (z - rng.uniform(0.3, 0.7)) ** 2)
        stress, tops = np.array([hill, -0.5 * hill, 0.3 * hill * (1.0 + x)]), []
        for _ in range(6):
            rounded = StressState(*(stress * (1.0 + 1e-14 * rng.standard_normal(stress.shape))))
            top = maximum(body, at_nodes(body, rounded), tau1)
            tops.append((top.value, top.x, top.z))
        assert np.ptp(tops, axis=0) == pytest.approx(np.zeros(3), abs=1e-9)


def test_a_sharp_ridge_is_not_smoothed(body):
    """A cone: its tip, on a node, is the sample's, not the lower one of a cubic."""
    x, z = body.points.T
    tip = np.argmin(np.hypot(x - 0.2, z - 0.5))
    cone = field(body, 1.0 - np.hypot(x - x[tip], z - z[tip]))
    highest = maximum(body, cone, lambda stress: stress.sx)
    assert (highest.value, highest.x, highest.z) == pytest.approx((1.0, x[tip], z[tip]), abs=2e-2)


def test_largest_at_the_surface_stays_there(body):
    x, z = body.points.T
    highest = maximum(body, field(body, np.exp(-z) - x**2), lambda stress: stress.sx)
    assert (highest.x, highest.z) == pytest.approx((0.0, 0.0), abs=1e-2)


def test_the_window_limits_the_search(body):
    x, z = body.points.T
    slope = field(body, x + z)
    highest = maximum(body, slope, lambda stress: stress.sx, (-0.5, 0.25, 0.5))
    assert highest.value == pytest.approx(0.75, abs=0.03)
    assert highest.x <= 0.25 and highest.z <= 0.5
    with pytest.raises(ValueError, match="no part of the body"):
        maximum(body, slope, lambda stress: stress.sx, (2.0, 3.0, 1.0))


def test_each_cell_of_x_has_its_own_maximum(body):
    """Sampled between the nodes where it comes near the largest; else the highest node."""
    x, z = body.points.T
    hills = sum(
        height * np.exp(-60.0 * ((x - at) ** 2 + (z - 0.5) ** 2))
        for at, height in ((-0.51, 0.9), (0.03, 1.0), (0.52, 0.3))
    )
    nodal, ends, window = field(body, hills), (-0.25, 0.25), (-0.8, 0.8, 0.9)
    cells = [*zip((-0.8, *ends), (*ends, 0.8), strict=True)]
    search = Search(nodal, lambda stress: stress.sx, (*ends, 0.9))
    [highest] = maxima(body, [search], window)
    for k, (start, stop) in enumerate(cells[:2]):
        one = maximum(body, nodal, lambda stress: stress.sx, (start, stop, 0.9))
        assert highest[:, k] == pytest.approx((one.value, one.x, one.z))
    assert highest[0, 2] < NEAR * highest[0, 1] and highest[1, 2] == pytest.approx(0.52, abs=0.06)
    assert highest[0, 3] == 0.0 and np.isnan(highest[1:, 3]).all()  # beyond the window
    whole = maximum(body, nodal, lambda stress: stress.sx, window)
    assert highest[0].max() == pytest.approx(whole.value)


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_looking_where_an_estimate_is_high_finds_what_looking_everywhere_does(pressed, friction):
    """And needs the stresses of a part of the nodes; ten elements to a half-width."""
    case, cells = pressed(10, 0.2), (-0.5, 0.2, 0.9)
    hats, window = case.compliance.hats, (-1.5, 1.5, 1.5)
    load = SurfaceLoad(case.body, hats, case.pressure, np.array([friction]), straight_down)
    for quantity in (tau1, lambda stress: np.abs(stress.txz)):
        (there,) = nodal_stresses(case.displacement(friction)[:, None], load)
        everywhere = replace(there, estimate=lambda all_of=there.values: all_of)
        (there,) = nodal_stresses(case.displacement(friction)[:, None], load)
        asked = np.zeros(len(there.poissons_ratio), dtype=bool)

        def at(node, asked=asked, of=there.at):
            asked[node] = True
            return of(node)

        search = Search(replace(there, at=at, together=None), quantity, cells)
        [largest] = maxima(case.body, [search], window)
        assert 0.0 < asked.mean() < 0.5
        [expected] = maxima(case.body, [Search(everywhere, quantity, cells)], window)
        # what else is looked for makes no difference
        searches = [Search(there, of, cells) for of in (tau1, quantity)]
        _, shared = maxima(case.body, searches, window)
        np.testing.assert_array_equal(shared, largest)
        np.testing.assert_allclose(largest, expected, rtol=1e-9, atol=1e-9)


def test_each_material_has_its_own_poissons_ratio():
    """Equal strain on both sides: the quantity differs only by Poisson's ratio."""
    mesh = structured_block(np.linspace(-1, 1, 9), np.linspace(0, 1, 5))
    coating = Coating(Material(1.0, 0.1), 0.25)
    body = elastic_body(mesh, Material(1.0, 0.4), Support(), coating=coating)
    x, z = body.nodes.T
    hats, none = np.array([-9.0, 0.0, 9.0]), np.zeros(1)
    nodal = nodal_stress(body, np.column_stack([x, z]), hats, none)
    highest = maximum(body, nodal, lambda stress: -stress.poissons_ratio)
    assert highest.value == -0.1 and highest.z < 0.25
    highest = maximum(body, nodal, lambda stress: stress.sy(stress.poissons_ratio))
    lame = 0.4 / (1.4 * 0.2)
    assert highest.value == pytest.approx(2.0 * lame) and highest.z >= 0.25


def test_an_unstressed_body_has_a_largest_value_of_zero(body):
    nothing = np.zeros(len(body.points))
    assert maximum(body, field(body, nothing), tau1).value == 0.0


@pytest.mark.parametrize(
    ("sides", "extra"), [("fixed", 0.0087), ("rollers", 0.0147), ("free", 0.0161)]
)
def test_a_block_of_100_half_widths_stands_for_a_half_plane(pressed, sides, extra):
    """Square, bonded below: what the held or free sides add to the largest shear stress."""
    case = pressed(40, 0.15, 50.0, 100.0, sides=sides)
    highest = maximum(case.body, case.stress(0.0), tau1)
    assert highest.value / case.hertz.tau1_max - 1.0 == pytest.approx(extra, abs=1.5e-3)
    assert case.pressure.max() == pytest.approx(1.0, abs=5e-4)
