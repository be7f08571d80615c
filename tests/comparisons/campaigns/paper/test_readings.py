"""The numbers that judge the paper's claims, on fields made for it."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scenes import QUICK, problem

from analytic.contact.problem import ContactSolution, Residuals
from analytic.exact.hertz import HertzContact, hertz_stress
from analytic.grid import HatGrid
from analytic.stress.points import stress_at
from analytic.stress_state import Extremum, StressState
from comparisons.campaigns.paper import readings as r
from comparisons.campaigns.paper.readings import (
    agreement_depth,
    joining_level,
    share_joined,
    top_of_zone,
    zone,
)
from comparisons.common.progress import Stages
from comparisons.models.half_plane import half_plane_level
from comparisons.models.level import Level, StressResult
from comparisons.models.window import Window, window_of

A, P0 = 0.5e-3, 4e9
HERTZ = HertzContact(A, P0, 0.5 * np.pi * A * P0, 8e-3, 128e9)
WINDOW = Window(np.linspace(-1.5, 1.5, 121) * A, np.linspace(0.0, 1.0, 101) ** 2 * A, 1.5 * A)


class TestZones:
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

    def test_a_path_may_go_over_corners(self):
        field = np.array([[5.0, 0.0], [0.0, 5.0]])
        assert zone(field, 5.0, (0, 0)).tolist() == [[True, False], [False, True]]


def hertz_level(pitch: float, fields: dict, wave: float = 0.0) -> Level:
    """Hertz's pressure on hats, with a `wave`, relative, from one hat to the next; `fields` by
    friction, stresses [Pa] or a shear field [p0] (m, k)."""
    grid = HatGrid.within(-1.5 * A, 1.5 * A, pitch)
    pressure = HERTZ.pressure(grid.x) * (1.0 + wave * (-1.0) ** np.arange(grid.count))
    gap, nothing = np.where(pressure > 0.0, 0.0, 1e-6), Residuals(0.0, 0.0, 0.0, 0.0, 0.0)
    solution = ContactSolution(pressure, gap, 0.0, HERTZ.load_per_length, nothing, {}, True)
    stresses = []
    for friction, field in fields.items():
        if not isinstance(field, StressState):
            field = StressState(np.zeros_like(field), np.zeros_like(field), field * P0)
        extremes = {"tau1": Extremum(-0.4 * P0, 0.1 * A, 0.6 * A)}
        stresses.append(StressResult(friction, extremes, field))
    return Level(
        grid=grid,
        solution=solution,
        displacement=np.zeros(grid.count),
        patches=np.array([[-A, A]]),
        seconds={},
        unknowns=grid.count,
        stresses=tuple(stresses),
    )


def view_of(
    fields=None, every: int = 1, wave: float = 0.0, model: str = "half_plane"
) -> r.LevelView:
    surface = SimpleNamespace(info=SimpleNamespace(spacing=A / 16.0))
    problem = SimpleNamespace(hertz=HERTZ, surface=surface)
    return r.LevelView(model, problem, hertz_level(A / 64.0, fields or {}, wave), WINDOW, every)


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
        assert view.depth_of_agreement() == 0.0
        assert view.reach_against_smooth(r.HALF) == pytest.approx(0.0, abs=1e-12)
        assert view.open_to_surface(0.0) == pytest.approx(0.0, abs=1e-9)
        assert view.contact_ratio() == pytest.approx(1.0)
        assert view.carried_load() == pytest.approx(1.0, abs=2e-3)

    @pytest.mark.parametrize("depth", [0.05, 0.3, 0.7])
    def test_a_hill_moves_the_depth_of_agreement_below_itself(self, depth):
        view = view_of({0.0: smooth_tau1() + asperity(0.2, depth, 0.4)})
        agrees = view.depth_of_agreement()
        assert depth < agrees < 2.5 * depth + 0.02
        assert (agrees <= 0.5) == (depth < 0.2)

    def test_hills_count_where_they_exceed_twice_the_maximum(self):
        view = view_of({0.0: np.maximum(smooth_tau1(), asperity(0.2, 0.0196, 0.7))})
        assert view.largest_near() == pytest.approx(0.7 / view.smooth_maximum, rel=2e-2)
        assert view.depth_of_largest_near() == pytest.approx(0.0196, abs=1e-9)
        assert view.sheared_beyond(2.0) == 1.0
        assert view.sheared_beyond(2.5) == 0.0
        assert view.x[view._asperity()[1]] == pytest.approx(0.2, abs=0.02)

    def test_a_ridge_draws_the_hertz_zone_to_the_surface(self):
        ridge = np.where(np.abs(WINDOW.x / A) < 0.1, 0.2, 0.0) * np.ones((len(WINDOW.z), 1))
        ridge[WINDOW.z < 0.01 * A] = 0.0
        view = view_of({0.0: np.maximum(smooth_tau1(), ridge)})
        assert view.reach_against_smooth(r.HALF) > 0.05
        assert view.reach_against_smooth(0.8) == pytest.approx(0.0, abs=1e-12)

    def test_zones_open_and_merge_where_a_ridge_joins_them(self):
        apart = np.maximum(smooth_tau1(), asperity(0.2, 0.01, 0.5, 0.2))
        ridge = np.where(np.abs(WINDOW.x / A - 0.2) < 0.05, 0.2, 0.0) * np.ones((len(WINDOW.z), 1))
        view = view_of({0.0: apart, 0.1: np.maximum(apart, ridge)})
        assert view.joined_share(0.1) == pytest.approx(1.0)
        assert view.joined_share(0.0) < 0.7
        assert view.open_to_surface(0.1) == pytest.approx(0.2 / view.smooth_maximum)
        assert view.open_to_surface(0.0) < 0.5
        assert view.low_layer() < 0.5

    def test_a_sheared_layer_has_a_zone_below_it_until_the_shear_reaches_down(self):
        layer = 0.3 * np.exp(-((WINDOW.z / (0.02 * A)) ** 2))[:, None] + 0.0 * WINDOW.x
        view = view_of({0.0: np.maximum(smooth_tau1(), layer), 0.1: smooth_tau1() + 0.5})
        assert view.zone_ratio(0.0) < 0.4 and view.zone_ratio(0.1) > 0.9
        assert 0.0 < view.zone_end("start") < 0.04 < view.zone_end("stop") < 0.6

    def test_long_waves_bridge_the_zone_and_friction_shorter_ones(self):
        """As the map of the quiescent zone in docs/figures.md shows of rough scenes."""
        posed = problem(QUICK)
        window = window_of(posed)
        level = half_plane_level(posed, posed.pitches[0], window, Stages())
        view = r.LevelView("half_plane", posed, level, window)
        waves = [view.bridging_wavelength(mu) for mu in (0.0, 0.1, 0.3)]
        assert waves[:2] == pytest.approx([0.362, 0.342], abs=0.01)
        assert waves[2] == r.WAVES[0]  # every wave

    def test_edge_ratio_follows_the_shear_there(self):
        view = view_of({0.0: smooth_tau1(), 0.1: 1.25 * smooth_tau1()})
        assert view.edge_ratio() == pytest.approx(1.25)

    def test_pressures_beyond_a_limit(self):
        view = view_of({0.0: smooth_tau1()})
        assert view.peak_pressure() == pytest.approx(1.0)
        assert (view.pressed_beyond(0.9), view.pressed_beyond(1.1)) == (1.0, 0.0)

    def test_every_second_point_keeps_the_middle(self):
        view = view_of({0.0: smooth_tau1()}, every=2)
        assert np.min(np.abs(view.x)) == 0.0 and view.z[0] == 0.0
        assert view.stress(0.0).tau1.shape == (len(view.z), len(view.x)) == (51, 61)

    def test_extremes_are_in_units_of_the_smooth_contact(self):
        view = view_of({0.0: smooth_tau1()})
        assert view.largest("tau1") == pytest.approx(0.4)
        assert view.largest_over_smooth() == pytest.approx(0.4 / 0.300283, rel=1e-5)
        assert view.depth_of_largest() == pytest.approx(0.6)

    def test_section_agreement_looks_below_the_peak_alone(self):
        hills = asperity(0.2, 0.02, 0.7) + asperity(-0.8, 0.6, 0.4)
        view = view_of({0.0: smooth_tau1() + hills})
        assert 0.02 < view.section_agreement() < 0.1
        assert view.depth_of_agreement() > 0.6

    def test_contact_ratio_adds_the_patches_and_the_load_the_pressures(self):
        view = view_of()
        two = replace(view.level, patches=np.array([[-0.5 * A, 0.0], [0.25 * A, 0.5 * A]]))
        assert replace(view, level=two).contact_ratio() == pytest.approx(0.375)
        solution = replace(view.level.solution, pressure=1.02 * view.level.solution.pressure)
        loaded = replace(view, level=replace(two, solution=solution))
        assert loaded.carried_load() == pytest.approx(1.02, abs=3e-3)


class TestErrors:
    """Errors against exact stresses are none on those, and what was put into them elsewhere."""

    def exact(self, x: float = 0.0, shift: float = 0.0, z: float = 0.25) -> StressState:
        exact = hertz_stress(HERTZ, WINDOW.x, WINDOW.z[:, None])
        here = (np.abs(WINDOW.x / A - x) < 0.01) & (np.abs(WINDOW.z[:, None] / A - z) < 1e-4)
        return StressState(exact.sx + shift * P0 * here, exact.sz, exact.txz)

    def test_on_the_axis(self):
        assert view_of({0.0: self.exact()}).axis_error() == pytest.approx(0.0, abs=1e-12)
        assert view_of({0.0: self.exact(0.0, 0.03)}).axis_error() == pytest.approx(0.03)
        assert view_of({0.0: self.exact(0.5, 0.03)}).axis_error() == pytest.approx(0.0, abs=1e-12)

    def test_below_the_sampling_interval_only_what_lies_there_counts(self):
        for z in (0.0225, 0.25):
            view = view_of({0.0: self.exact(0.0, 0.03, z)}, model="finite_element")
            assert view.axis_error() == pytest.approx(0.03)
            assert view.error_below_sampling() == pytest.approx(0.0, abs=1e-12)
        shallow = self.exact()
        shallow.sz[1] += 0.02 * P0
        view = view_of({0.0: shallow}, model="finite_element")
        assert view.error_below_sampling() == pytest.approx(0.02)

    def test_strips_are_right_on_the_axis_of_smooth_pressures_alone(self):
        smooth, rough = view_of(), view_of(wave=0.1)
        assert smooth.error_below_sampling() < 1e-3
        grid, z = rough.level.grid, np.geomspace(0.02, 1.0, 8) * A / 64.0
        strips = stress_at(grid.x, rough.level.solution.pressure, 0.0, 0.0, z, "strip")
        exact = hertz_stress(HERTZ, 0.0, z)
        worst = max(np.abs(strips.sx - exact.sx).max(), np.abs(strips.sz - exact.sz).max())
        assert rough.error_below_sampling() == pytest.approx(worst / P0, rel=1e-9)
        assert worst > 0.05 * P0

    def test_strips_on_sampled_pressures(self):
        """Next to their edges half the step from one to the next."""
        smooth = view_of()
        largest, mean = (smooth.error_on_rough_surface("strip", size) for size in (True, False))
        step = np.diff(HERTZ.pressure(np.arange(0.0, r.EDGE, 1.0 / 16.0) * A)) / P0
        assert largest == pytest.approx(0.5 * np.abs(step).max(), rel=0.25)
        assert mean < 0.3 * largest
        assert smooth.error_on_rough_surface("hat", True) < 0.3 * largest
        # sampled each fourth, the wave looks like a larger pressure: that is what is seen
        assert view_of(wave=0.2).error_on_rough_surface("hat", True) > 0.15
