"""Largest stresses off the grid, and how fast elements converge to the smooth contact."""

from types import SimpleNamespace

import numpy as np
import pytest

from analytic.exact.hertz import HertzContact, hertz_extremes, hertz_stress
from analytic.stress.field import friction_field, graded_depths
from analytic.stress.maxima import stress_maxima
from analytic.stress.points import stress_at
from analytic.stress_state import Extremum

UNIT = HertzContact(1.0, 1.0, np.pi / 2.0, 1.0, 2.0)


def maxima_of(x, pressure, friction, field, cells=()):
    """The largest of all by name, and in each cell."""
    by_cell = stress_maxima(x, pressure, {friction: field}, 0.3, cells=cells)[friction]
    of_all = {name: Extremum.highest(values) for name, values in by_cell.items()}
    return SimpleNamespace(**of_all, cells=by_cell)


def largest_tau1(x, pressure, friction, field):
    return maxima_of(x, pressure, friction, field).tau1


def hats(count: int) -> tuple[np.ndarray, np.ndarray]:
    """`count` pitches a half-width: the Hertz pressure weighed with each hat.

    Such means keep the load, and make every smooth functional of the pressure converge with
    order 2 in spite of the square root at the edge.
    """
    pitch = 1.0 / count
    x = np.arange(-count - 1, count + 2) * pitch

    def load_integral(t):
        t, beyond = np.clip(t, -1.0, 1.0), np.maximum(np.abs(t) - 1.0, 0.0)
        root = np.sqrt(1.0 - t * t)
        return 0.5 * (t * np.arcsin(t) + root - root**3 / 3.0) + beyond * np.pi / 4.0

    second = load_integral(x + pitch) - 2.0 * load_integral(x) + load_integral(x - pitch)
    return x, second / pitch**2


def orders(errors: list[float]) -> np.ndarray:
    return np.log2(np.abs(np.array(errors[:-1]) / np.array(errors[1:])))


@pytest.mark.parametrize("friction", [0.0, 0.1])
def test_maxima_of_the_smooth_contact_with_order_two(friction):
    exact = hertz_extremes(UNIT, friction)
    errors = {"tau1": [], "txz": [], "place": []}
    for count in (16, 32, 64):
        x, pressure = hats(count)
        levels = np.linspace(0.0, 1.5, 31)
        field = friction_field(x, pressure, (-1.5, 1.5), levels, 1).at(friction)
        maxima = maxima_of(x, pressure, friction, field)
        errors["tau1"].append(maxima.tau1.value - exact.tau1.value)
        errors["txz"].append(maxima.txz.value + exact.txz_min.value)
        errors["place"].append(np.hypot(maxima.tau1.x - exact.tau1.x, maxima.tau1.z - exact.tau1.z))
    assert np.all(np.abs(orders(errors["tau1"]) - 2.0) < 0.05)
    assert np.all(np.abs(orders(errors["txz"]) - 2.0) < 0.1)
    assert np.all(np.abs(orders(errors["place"]) - 2.0) < 0.2)
    assert abs(errors["tau1"][-1]) < 3e-5
    assert errors["place"][-1] < 3e-4


def test_frictionless_maximum_extrapolates_to_the_exact_value():
    """0.300283106 p0 at 0.786151378 a; the two finest grids leave 1e-8 by Richardson's rule."""
    values, depths = [], []
    for count in (64, 128):
        x, pressure = hats(count)
        field = friction_field(x, pressure, (-0.2, 0.2), np.linspace(0.5, 1.0, 21)).at(0.0)
        maximum = largest_tau1(x, pressure, 0.0, field)
        values.append(maximum.value)
        depths.append(maximum.z)
    assert (4.0 * values[1] - values[0]) / 3.0 == pytest.approx(0.300283106, abs=2e-9)
    assert (4.0 * depths[1] - depths[0]) / 3.0 == pytest.approx(0.786151378, abs=1e-6)


def test_field_below_the_contact_with_order_two():
    """Relative L2 error of each component where z >= a/4, and Fig. 5 and 11b at the finest."""
    levels = np.array([0.25, 0.5, 1.0, 2.0])
    errors = []
    for count in (8, 16, 32):
        x, pressure = hats(count)
        field = friction_field(x, pressure, (-2.0, 2.0), levels, 64 // count).at(0.3)
        exact = hertz_stress(UNIT, field.x, field.z[:, None], 0.3)
        both = np.array([field.stress.parts - exact.parts, exact.parts])
        errors.append(np.divide(*np.linalg.norm(both, axis=(2, 3))))
    assert np.all(np.abs(orders(errors) - 2.0) < 0.15)
    assert np.all(errors[-1] < 1e-3)


def test_nodal_pressures_lose_half_an_order_at_the_square_root():
    """Hats through the pressure itself miss load ~ h^(3/2) at the edges, and so do stresses."""
    errors = []
    for count in (64, 128, 256):
        x = np.arange(-count, count + 1) / count
        stress = stress_at(x, UNIT.pressure(x), 0.0, 0.0, 1.0)
        errors.append(float(stress.sz - hertz_stress(UNIT, 0.0, 1.0).sz))
    assert np.all(np.abs(orders(errors) - 1.5) < 0.1)


def highest_by_brute_force(x, pressure, friction, quantity):
    """Zooms on the five highest points of a fine field, each by 20 grids of 7 x 7 points."""
    levels, steps = np.linspace(0.0, 1.5, 121), 4
    field = friction_field(x, pressure, (x[0], x[-1]), levels, steps).at(friction)
    values = quantity(field.stress)
    row, column = np.unravel_index(np.argsort(-values, axis=None)[:5], values.shape)
    at_x, at_z = field.x[column], levels[row]
    reach = 6.0 * np.array([(x[1] - x[0]) / steps, levels[1]])
    across, down = (way.ravel() for way in np.meshgrid(*2 * [np.linspace(-1.0, 1.0, 7)]))
    for _ in range(20):
        grid_x = np.clip(at_x[:, None] + reach[0] * across, x[0], x[-1])
        grid_z = np.clip(at_z[:, None] + reach[1] * down, 0.0, levels[-1])
        heights = quantity(stress_at(x, pressure, friction, grid_x, grid_z))
        best = np.arange(5), np.argmax(heights, axis=1)
        at_x, at_z, reach = grid_x[best], grid_z[best], 0.6 * reach
    return heights.max()


def smooth_wavy_rough(name: str) -> tuple[np.ndarray, np.ndarray]:
    if name == "smooth":
        return hats(64)
    if name == "wavy":
        x = np.arange(-80, 81) / 64.0
        return x, UNIT.pressure(x) * (1.0 + 0.5 * np.cos(14.0 * x))
    x = 0.02 * np.arange(-60, 60)
    noise = np.random.default_rng(21).standard_normal(140)
    return x, np.maximum(np.convolve(noise, np.hanning(21), "same")[10:130], 0.0)


@pytest.mark.parametrize("friction", [0.0, 0.01, 0.05, 0.1, 0.3])
@pytest.mark.parametrize("surface", ["smooth", "wavy", "rough"])
def test_flat_ridges_under_little_friction_are_climbed_to_their_top(surface, friction):
    """A little friction draws the maximum into a ridge along x: far from the grid's best point.

    At the surface, where friction leaves kinks, the top is good to 1e-6.
    """
    x, pressure = smooth_wavy_rough(surface)
    field = friction_field(x, pressure, (x[0], x[-1]), graded_depths(1.5, 24, 0.01)).at(friction)
    maxima = maxima_of(x, pressure, friction, field)
    for extremum, quantity in (
        (maxima.tau1, lambda stress: stress.tau1),
        (maxima.txz, lambda stress: np.abs(stress.txz)),
        (maxima.von_mises, lambda stress: stress.von_mises(0.3)),
    ):
        exact = highest_by_brute_force(x, pressure, friction, quantity)
        assert extremum.value == pytest.approx(exact, rel=1e-6 if extremum.z == 0.0 else 1e-8)


def test_the_higher_peak_wins_though_the_grid_shows_the_lower_one():
    """The peak of the second contact lies between two levels, that of the first on one."""
    x = np.arange(-30, 840) * 0.05
    second = HertzContact(1.3, 1.01, 1.0, 1.0, 1.0)
    pressure = UNIT.pressure(x) + second.pressure(x - 40.0)
    field = friction_field(x, pressure, (-1.5, 41.5), np.array([0.2, 0.786, 1.4])).at(0.0)
    shown = np.unravel_index(np.argmax(field.stress.tau1), field.stress.tau1.shape)
    assert abs(field.x[shown[1]]) < 0.1
    maximum = largest_tau1(x, pressure, 0.0, field)
    assert maximum.value == pytest.approx(second.tau1_max, rel=3e-3)
    assert maximum.x == pytest.approx(40.0, abs=0.02)
    assert maximum.z == pytest.approx(second.tau1_max_depth, rel=1e-2)


def test_a_maximum_at_the_side_of_the_window_stays_inside_it():
    x, pressure = hats(32)
    field = friction_field(x, pressure, (0.5, 1.0), np.linspace(0.0, 0.5, 6)).at(0.0)
    maximum = largest_tau1(x, pressure, 0.0, field)
    assert (maximum.x, maximum.z) == pytest.approx((0.5, 0.5), abs=1e-12)
    single = friction_field(x, pressure, (0.0, 0.0), np.array([0.7])).at(0.0)
    maximum = largest_tau1(x, pressure, 0.0, single)
    assert (maximum.x, maximum.z) == (0.0, 0.7)


def test_no_pressure_has_its_maximum_at_zero():
    x = np.arange(8) * 1e-6
    field = friction_field(x, np.zeros(8), (0.0, 7e-6), np.array([0.0, 1e-6])).at(0.1)
    assert largest_tau1(x, np.zeros(8), 0.1, field).value == 0.0


def test_each_cell_of_x_has_its_own_maxima():
    """Below two contacts and a weak one between them, each as if it were searched alone."""
    x, pressure = hats(24)
    pitch = x[1] - x[0]
    nodes = pitch * np.arange(-400, 401)
    loads = np.zeros(len(nodes))
    for at, height in ((-120, 0.95), (10, 0.2), (130, 1.0)):
        loads[400 + at - len(x) // 2 : 400 + at + len(x) // 2 + 1] += height * pressure
    levels, ends = np.linspace(0.0, 1.5, 31), (-60.0 * pitch, 70.0 * pitch, 390.0 * pitch)
    window = nodes[0] + 60.0 * pitch, 330.0 * pitch
    field = friction_field(nodes, loads, window, levels, 1).at(0.1)
    maxima = maxima_of(nodes, loads, 0.1, field, cells=ends)
    for k, part in ((0, (window[0], ends[0])), (2, (ends[1], window[1]))):
        one = friction_field(nodes, loads, part, levels, 1).at(0.1)
        searched = maxima_of(nodes, loads, 0.1, one)
        for name, single in (("tau1", searched.tau1), ("txz", searched.txz)):
            assert maxima.cells[name][:, k] == pytest.approx((single.value, single.x, single.z))
    cells = maxima.cells["tau1"]
    assert cells[0].argmax() == 2 and cells[0, 1] < 0.5 * cells[0, 2] == 0.5 * maxima.tau1.value
    assert cells[0, 3] == 0.0 and np.isnan(cells[1:, 3]).all()  # beyond the window
    alone = maxima_of(nodes, loads, 0.1, field)
    best, top = ((tau1.value, tau1.x, tau1.z) for tau1 in (alone.tau1, maxima.tau1))
    assert best == pytest.approx(top, rel=1e-9) and alone.cells["tau1"].shape == (3, 1)
