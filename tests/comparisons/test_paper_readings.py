"""The numbers that judge the paper's claims, on fields made for it."""

from types import SimpleNamespace

import numpy as np
import pytest

from analytic.contact import ContactSolution, Residuals
from analytic.exact.hertz import HertzContact, hertz_stress
from analytic.gap import HatGrid
from analytic.plane_stress import PlaneStress
from comparisons.level import Level, StressResult, Window
from comparisons.paper import readings as r
from comparisons.paper.measures import (
    agreement_depth,
    joining_level,
    share_joined,
    top_of_zone,
    valley,
    zone,
)
from comparisons.paper.views import View

A, P0 = 0.5e-3, 4e9
HERTZ = HertzContact(A, P0, 0.5 * np.pi * A * P0, 8e-3, 128e9)
WINDOW = Window(np.linspace(-1.5, 1.5, 121) * A, np.linspace(0.0, 1.0, 101) ** 2 * A, 1.5 * A)


class TestMeasures:
    Z = np.array([0.0, 1.0, 2.0, 4.0])

    def test_agreement_begins_where_the_largest_difference_falls_to_the_tolerance(self):
        difference = np.array([[3.0, 0.0], [-2.0, 1.0], [0.5, -1.0], [0.0, 0.0]])
        assert agreement_depth(self.Z, difference, 1.5) == pytest.approx(1.5)
        assert agreement_depth(self.Z, difference, 0.5) == pytest.approx(3.0)
        assert agreement_depth(self.Z, difference, 3.0) == 0.0
        assert agreement_depth(self.Z, difference + 9.0, 1.0) == 4.0

    # two hills, the right one joined with the upper edge by a ridge of 3
    FIELD = np.array(
        [
            [0.0, 0.0, 0.0, 3.0, 0.0],
            [6.0, 1.0, 0.0, 4.0, 0.0],
            [5.0, 1.0, 2.0, 3.0, 0.0],
            [1.0, 1.0, 2.0, 7.0, 8.0],
        ]
    )

    def test_hills_are_joined_at_the_highest_level_of_a_path_between_them(self):
        top = np.zeros(self.FIELD.shape, dtype=bool)
        top[0] = True
        left = np.zeros(self.FIELD.shape, dtype=bool)
        left[1, 0] = True
        assert joining_level(self.FIELD, (3, 4), top) == pytest.approx(3.0)
        assert joining_level(self.FIELD, (3, 4), left) == pytest.approx(1.0)

    def test_a_zone_has_a_top_between_the_rows(self):
        assert zone(self.FIELD, 3.0, (3, 4)).sum() == 5
        # 7 at depth 4 falls to 3 at depth 2
        assert top_of_zone(self.Z, self.FIELD, 3.5, (3, 4)) == pytest.approx(2.25)
        assert top_of_zone(self.Z, self.FIELD, 3.0, (3, 4)) == 0.0
        assert top_of_zone(self.Z, self.FIELD, 9.0, (3, 4)) == 4.0

    def test_share_of_area_that_is_joined(self):
        part = np.zeros(self.FIELD.shape, dtype=bool)
        part[:2] = True
        weights = np.array([[1.0], [2.0], [1.0], [1.0]])
        # above 3: one at the top (1), two in the second row (2 each); the left hill is apart
        assert share_joined(self.FIELD, weights, 3.0, (3, 4), part) == pytest.approx(3.0 / 5.0)
        assert share_joined(self.FIELD, weights, 9.0, (3, 4), part) == 0.0

    def test_valley_between_two_places(self):
        column = np.array([0.0, 4.0, 1.0, 2.0, 5.0])
        assert valley(column, 1, 4) == valley(column, 4, 1) == 0.25
        assert valley(column, 3, 4) == 1.0


def hertz_level(pitch: float, fields) -> Level:
    """Hertz's pressure on hats; `fields` by friction, of any shear field [p0] (m, k)."""
    grid = HatGrid.within(-1.5 * A, 1.5 * A, pitch)
    pressure = HERTZ.pressure(grid.x)
    solution = ContactSolution(
        pressure=pressure,
        gap=np.where(pressure > 0.0, 0.0, 1e-6),
        approach=0.0,
        load=HERTZ.load_per_length,
        residuals=Residuals(0.0, 0.0, 0.0, 0.0, 0.0),
        converged=True,
        iterations={},
    )
    stresses = tuple(
        StressResult(mu, {}, PlaneStress(np.zeros_like(f), np.zeros_like(f), f * P0))
        for mu, f in fields.items()
    )
    return Level(
        grid=grid,
        solution=solution,
        displacement=np.zeros(grid.count),
        patches=np.array([[-A, A]]),
        seconds={},
        unknowns=grid.count,
        stresses=stresses,
    )


def view_of(fields, every: int = 1) -> View:
    return View(
        "half_plane",
        SimpleNamespace(hertz=HERTZ),
        hertz_level(A / 64.0, fields),
        WINDOW,
        every,
    )


def smooth_tau1(friction: float = 0.0) -> np.ndarray:
    return hertz_stress(HERTZ, WINDOW.x, WINDOW.z[:, None], friction).tau1 / P0


def asperity(x: float, depth: float, height: float, width: float = 0.06) -> np.ndarray:
    """A hill of shear [p0] below x/a."""
    along = (WINDOW.x / A - x) / width
    down = (WINDOW.z[:, None] / A - depth) / (0.5 * depth + 1e-3)
    return height * np.exp(-(along**2) - down**2)


class TestReadings:
    """Each number on the smooth field, and with hills of shear put into it."""

    def test_smooth_field_agrees_everywhere_and_is_quiet_at_the_surface(self):
        view = view_of({0.0: smooth_tau1()})
        assert r.depth_of_agreement(view) == 0.0
        assert r.reach_against_smooth(r.HALF)(view) == pytest.approx(0.0, abs=1e-12)
        assert r.open_to_surface(0.0)(view) == pytest.approx(0.0, abs=1e-9)
        assert r.contact_ratio(view) == pytest.approx(1.0)
        assert r.carried(view) == pytest.approx(1.0, abs=2e-3)

    @pytest.mark.parametrize("depth", [0.05, 0.3, 0.7])
    def test_a_hill_moves_the_depth_of_agreement_below_itself(self, depth):
        view = view_of({0.0: smooth_tau1() + asperity(0.2, depth, 0.4)})
        found = r.depth_of_agreement(view)
        assert depth < found < 2.5 * depth + 0.02
        assert (found <= 0.5) == (depth < 0.2)

    def test_hills_count_where_they_exceed_twice_the_maximum(self):
        view = view_of({0.0: np.maximum(smooth_tau1(), asperity(0.2, 0.02, 0.7))})
        assert r.largest_near(view) == pytest.approx(0.7 / view.smooth_maximum, rel=2e-2)
        assert r.depth_of_largest_near(view) == pytest.approx(0.02, abs=3e-3)
        assert r.sheared_beyond(2.0)(view) == 1.0
        assert r.sheared_beyond(2.5)(view) == 0.0
        assert view.x[r.peak_column(view)] == pytest.approx(0.2, abs=0.02)

    def test_a_ridge_draws_the_hertz_zone_to_the_surface(self):
        ridge = np.where(np.abs(WINDOW.x / A) < 0.1, 0.2, 0.0) * np.ones((len(WINDOW.z), 1))
        ridge[WINDOW.z < 0.01 * A] = 0.0
        view = view_of({0.0: np.maximum(smooth_tau1(), ridge)})
        assert r.reach_against_smooth(r.HALF)(view) > 0.05
        assert r.reach_against_smooth(r.CORE)(view) == pytest.approx(0.0, abs=1e-12)

    def test_zones_open_and_merge_where_a_ridge_joins_them(self):
        apart = np.maximum(smooth_tau1(), asperity(0.2, 0.01, 0.5, 0.2))
        ridge = np.where(np.abs(WINDOW.x / A - 0.2) < 0.05, 0.2, 0.0) * np.ones((len(WINDOW.z), 1))
        view = view_of({0.0: apart, 0.1: np.maximum(apart, ridge)})
        assert r.joined(0.1)(view) == pytest.approx(1.0)
        assert r.joined(0.0)(view) < 0.7
        assert r.open_to_surface(0.1)(view) == pytest.approx(0.2 / view.smooth_maximum)
        assert r.open_to_surface(0.0)(view) < 0.5
        assert r.low_layer(view) < 0.5

    def test_edge_ratio_follows_the_shear_there(self):
        view = view_of({0.0: smooth_tau1(), 0.1: 1.25 * smooth_tau1()})
        assert r.edge_ratio(view) == pytest.approx(1.25)

    def test_pressures_beyond_a_limit(self):
        view = view_of({0.0: smooth_tau1()})
        assert r.peak_pressure(view) == pytest.approx(1.0)
        assert (r.pressed_beyond(0.9)(view), r.pressed_beyond(1.1)(view)) == (1.0, 0.0)

    def test_every_second_point_keeps_the_middle(self):
        view = view_of({0.0: smooth_tau1()}, every=2)
        assert np.min(np.abs(view.x)) == 0.0 and view.z[0] == 0.0
        assert view.stress(0.0).tau1.shape == (len(view.z), len(view.x)) == (51, 61)
