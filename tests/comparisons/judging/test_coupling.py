"""Changes by friction that moves the surfaces of unlike bodies, against the sliding cylinder; of
like ones, half-planes move alike, layers and coats do not."""

from dataclasses import replace
from unittest.mock import patch

import numpy as np
import pytest
import scenes
from scenes import STEEL, STEEL_PAIR, changed, finite_elements, half_plane_at, problem, run_of

from comparisons.common.progress import no_progress
from comparisons.figures.quantity import QUANTITIES
from comparisons.judging import coupling
from comparisons.judging.coupling import BEYOND_THE_END, SHIFT, Coupling, coupling_of
from comparisons.judging.effects.catalogue import estimates
from comparisons.judging.effects.estimates import Shown
from comparisons.judging.effects.selection import select_effects
from comparisons.judging.rule import relative_l2
from comparisons.judging.study import WHY_NOT, Case, Run
from comparisons.models.level import Level, Solution
from comparisons.models.problem import Problem

TABLE = scenes.reference("f_rounded_punch_and_sliding")["sliding_cylinder"]
REFERENCES = [
    {n: float(v) for n, v in row.items() if n != "beta" and isinstance(v, str)} for row in TABLE
]
RIGID = scenes.RIGID_PAIR | {
    "title": "Rigid roller",
    "load": {"per_length": 1e6, "friction": [0.0, 0.1, 0.3]},
    "stress": {"points": [60, 20]},
}
STRONG = RIGID | {"body": {"youngs_modulus": 210e9, "poissons_ratio": 0.0}}  # beta = 1/2
ALIKE = RIGID | STEEL_PAIR
WAVY = RIGID | {
    "profile": {"kind": "sinusoid", "wavelength": 50e-6, "amplitude": 0.2e-6},
    "body": {**STEEL, "hardness": 4e9},
    "load": {"hertz_peak_pressure": 1e9, "friction": 0.3},
}


def problem_of(tables: dict, **load):
    return scenes.problem(changed(tables, load=load))


def solved(tables: dict, **load) -> Run:
    return run_of(tables, "half_plane", load=load)


def half_plane_of(problem) -> Solution:
    levels = (half_plane_at(problem, pitch) for pitch in problem.pitches)
    return Solution("half_plane", tuple(levels))


def change_of(problem: Problem, levels: Solution) -> Coupling:
    """Changes by coupling in a solved half-plane."""
    return coupling_of(Case(replace(problem, window=None), {"half_plane": levels}), no_progress)


def estimate(problem, couplings_of) -> dict | None:
    """How much friction may change by moving the surfaces, by quantity."""
    every = estimates(problem, Shown(*2 * [problem.hertz.peak_pressure], couplings_of))
    return every.get("normal_tangential_coupling")


def plain(outcome: Run, friction: float) -> dict[str, float]:
    """The half-plane's figures at a friction coefficient, as it was solved."""
    known = outcome.figures.of(study="contact", source="half_plane", friction=friction)
    return {figure.quantity: figure.value for figure in known}


def change(outcome: Run, friction: float) -> dict[str, list[float | None]]:
    """The figure with coupling and its change, by quantity."""
    known = outcome.figures.of(study=coupling.NAME, friction=friction)
    pairs = {figure.quantity: [None, None] for figure in known}
    for figure in known:
        pairs[figure.quantity][figure.against is not None] = figure.value
    return pairs


@pytest.fixture
def rigid() -> Run:
    """Three friction coefficients, with a field."""
    return solved(RIGID)


@pytest.fixture
def rigid_coupled() -> Run:
    return solved(RIGID, friction=0.3, coupled=True)


@pytest.fixture(scope="module")
def wavy():
    """A rough problem, and the half-plane's levels."""
    problem = problem_of(WAVY)
    return problem, half_plane_of(problem)


class TestFigures:
    @pytest.mark.parametrize("number", [1, 2])
    def test_changes_are_those_of_the_exact_sliding_cylinder(self, rigid, number):
        """Rigid on nu = 0.3: beta = 2/7, mu = 0.1 and 0.3."""
        row, hertz = REFERENCES[number - 1], rigid.problem.hertz
        moved = change(rigid, row["mu"])
        assert TABLE[number - 1]["beta"] == "2/7"
        wider = row["ahalf_over_aHertz_same_load"]
        peak = row["peak_over_p0Hertz_same_load"]
        shift = row["load_line_x_over_ahalf"] * wider
        pressure, length = moved["peak_pressure"], moved["contact_length"]
        assert pressure[1] == pytest.approx(peak - 1.0, abs=2e-5)
        assert pressure[0] / hertz.peak_pressure == pytest.approx(peak, rel=2e-5)
        assert length[0] / hertz.half_width == pytest.approx(2.0 * wider, rel=1e-3)
        assert moved[SHIFT][1] == pytest.approx(shift, rel=1e-3)
        assert moved[SHIFT][0] == pytest.approx(shift * hertz.half_width, rel=1e-3)
        said = rigid.findings[coupling.NAME].said("converged", friction=row["mu"])
        assert said == "yes"

    def test_the_model_s_own_figures_stay_without_it(self, rigid):
        names = ("peak_pressure", "contact_length", "peak_position")
        first, *others = (plain(rigid, mu) for mu in rigid.problem.scene.load.friction)
        assert all(other[name] == first[name] for other in others for name in names)
        hertz = rigid.problem.hertz.peak_pressure
        assert first["peak_pressure"] == pytest.approx(hertz, rel=1e-4)

    def test_no_friction_no_change(self, rigid):
        assert change(rigid, 0.0) == {}
        assert rigid.findings[coupling.NAME].said(WHY_NOT, friction=0.0) == "there is no friction"
        assert "coupling" not in rigid.plan.skipped

    def test_stresses_are_compared_too(self, rigid):
        moved = change(rigid, 0.3)
        # on the surface tau1 = mu p where sx + p is what the coupling changes most
        assert -0.05 < moved["tau1_max"][1] < -0.005

    def test_a_figure_that_is_zero_without_changes_over_that_of_hertz(self, rigid):
        """At friction 0.3 the largest shear stands on the surface, by a touch of the pressure."""
        problem = rigid.problem
        still = {"tau1_max_depth": 0.0, "contact_length": 0.0, "peak_pressure": 2.0}
        moved = {"tau1_max_depth": 3e-5, "contact_length": 0.0, "peak_pressure": 3.0}
        answers, case = iter([moved, still]), rigid.solved.case(0.3)
        with patch.object(coupling, "values_of", lambda *_: next(answers)):
            added = coupling_of(case, no_progress)
        share = 3e-5 / QUANTITIES["tau1_max_depth"].scale(problem.hertz)
        assert added.figures["tau1_max_depth"] == 3e-5
        changes = {"tau1_max_depth": share, "contact_length": 0.0, "peak_pressure": 0.5}
        assert {name: added.changes[name] for name in changes} == pytest.approx(changes)
        effect = estimate(problem, (added,))
        assert effect["peak_pressure"] == pytest.approx(0.5)
        assert effect["tau1_max_depth"] == pytest.approx(share)

    @pytest.mark.parametrize(("friction", "why"), [(0.0, "no friction"), (0.3, "equal constants")])
    def test_equal_materials_skip_it(self, friction, why):
        outcome = solved(ALIKE, friction=friction)
        assert why in outcome.plan.skipped["coupling"]
        assert coupling.NAME not in outcome.findings

    def test_softer_roller_moves_the_contact_the_other_way(self):
        one = solved(RIGID, friction=0.3)
        soft = {"radius": 8e-3, "youngs_modulus": 3e9, "poissons_ratio": 0.3}
        swapped = RIGID | {"roller": soft, "load": {"hertz_peak_pressure": 5e7}}
        other = solved(swapped, friction=0.3)
        first, second = (change(outcome, 0.3)[SHIFT][0] for outcome in (one, other))
        assert first < 0.0 < second and other.problem.dundurs_beta < 0.0


class TestSwitch:
    def test_coupled_answer_is_the_exact_one(self, rigid_coupled):
        row = REFERENCES[1]
        a = rigid_coupled.problem.hertz.half_width * row["ahalf_over_aHertz_same_load"]
        [edges] = rigid_coupled.runs["half_plane"].finest.patches
        exact = -row["b_trailing_over_ahalf"], row["c_leading_over_ahalf"]
        assert edges / a == pytest.approx(exact, rel=1e-3)

    def test_both_ways_round_tell_the_same_change(self, rigid, rigid_coupled):
        one, other = (change(outcome, 0.3) for outcome in (rigid, rigid_coupled))
        for name in ("peak_pressure", SHIFT, "pressure_l2", "tau1_max"):
            assert one[name][1] == pytest.approx(other[name][1], rel=0.03)

    def test_strong_coupling_finds_its_extent(self):
        """mu beta = 0.75 reaches beyond 1.5 Hertz half-widths, where the other answer ends."""
        shift = np.arctan(0.75) / np.pi
        half = 1.0 / np.sqrt(1.0 - 4.0 * shift**2)
        outcome, other = (solved(STRONG, friction=1.5, coupled=way) for way in (True, False))
        a = outcome.problem.hertz.half_width
        [edges] = outcome.runs["half_plane"].finest.patches / a
        expected = np.array([-1.0 - 2.0 * shift, 1.0 - 2.0 * shift]) * half
        assert edges == pytest.approx(expected, abs=5e-3)
        assert other.problem.extent[0] / a == pytest.approx(-1.5) and edges[0] < -1.5
        length, _ = change(other, 1.5)["contact_length"]
        assert length / a == pytest.approx(2.0 * half, rel=2e-3)

    def test_equal_materials_are_the_same_either_way(self):
        one, other = (plain(solved(ALIKE, friction=0.3, coupled=way), 0.3) for way in (False, True))
        assert one == other


class TestRoughBody:
    @staticmethod
    def cut(problem, start: float, stop: float):
        """The problem on a trace that ends there [m]."""
        trace = problem.surface.profile
        kept = (trace.x >= start) & (trace.x <= stop)
        short = replace(trace, x=trace.x[kept], height=trace.height[kept])
        return replace(problem, surface=replace(problem.surface, profile=short))

    def test_change_under_a_hardness(self, wavy):
        result = change_of(*wavy)
        assert result.converged
        assert result.figures["peak_pressure"] <= 4e9
        assert result.figures[SHIFT] < 0.0

    def test_a_trace_that_ends_on_one_side_changes_nothing(self, wavy):
        """The grid is extended where there is a trace, here behind the contact only."""
        problem, levels = wavy
        one = change_of(problem, levels)
        ended = self.cut(problem, -np.inf, levels.finest.grid.x[-1] + 2e-6)
        other = change_of(ended, levels)
        for name, change in one.changes.items():
            assert other.changes[name] == pytest.approx(change, abs=1e-7)

    def test_a_contact_that_goes_far_is_followed(self, monkeypatch):
        """The first stretches are too short for it."""
        problem = problem_of(STRONG, friction=1.5)
        levels = half_plane_of(problem)
        expected = change_of(problem, levels)
        stretched = coupling._stretched
        monkeypatch.setattr(
            coupling, "_stretched", lambda p, g, more: stretched(p, g, 1 + more // 64)
        )
        result = change_of(problem, levels)
        for name, change in expected.changes.items():
            assert result.changes[name] == pytest.approx(change, abs=1e-7)

    def test_there_is_no_change_where_the_trace_ends(self, wavy):
        """Just beyond the contact at rest."""
        problem, levels = wavy
        level = levels.finest
        edge = level.patches[0, 0] - 0.5e-6
        ended = self.cut(problem, edge, -edge)
        trace, pitch = ended.surface.profile, level.grid.pitch
        first, last = int(np.ceil(trace.x[0] / pitch)), int(np.floor(trace.x[-1] / pitch))
        grid = replace(level.grid, first=first + 1, last=last - 1)
        inside = slice(grid.first - level.grid.first, grid.last - level.grid.first + 1)
        solution = replace(level.solution, pressure=level.solution.pressure[inside])
        ending = replace(levels, levels=(replace(level, grid=grid, solution=solution),))
        result = change_of(ended, ending)
        assert result.changes == {} and result.why == BEYOND_THE_END


class TestEstimate:
    def test_measured_changes_take_the_place_of_the_estimate(self, rigid):
        effect = estimate(rigid.problem, rigid.data("coupling"))
        last = rigid.data("coupling")[2].changes
        for name in ("peak_pressure", "contact_length", "tau1_max_depth"):
            assert effect[name] == abs(last[name])

    def test_what_was_not_measured_is_estimated(self, rigid):
        effect = estimate(rigid.problem, ())
        size = 0.3 * rigid.problem.dundurs_beta
        assert effect["tau1_max"] == pytest.approx(0.8 * size)
        known = rigid.data("coupling")
        without = tuple(replace(coupled, changes={}, why=BEYOND_THE_END) for coupled in known)
        assert estimate(rigid.problem, without) == effect

    def test_what_both_models_contain_is_not_missing(self, rigid_coupled):
        assert estimate(rigid_coupled.problem, rigid_coupled.data("coupling")) is None

    def test_equal_materials_have_no_such_effect(self, wavy_outcome):
        assert wavy_outcome.problem.dundurs_beta == 0.0
        assert estimate(wavy_outcome.problem, ()) is None


HALF_WIDTH = 216e-6  # of the smooth contact
BODIES = {
    "thin layer": {"body": STEEL | {"thickness": 0.3 * HALF_WIDTH}},
    "thick layer": {"body": STEEL | {"thickness": 4.0 * HALF_WIDTH}},
    "hard coating": {
        "coating": {"thickness": 20e-6, "youngs_modulus": 400e9, "poissons_ratio": 0.22}
    },
    "soft coating": {"coating": {"thickness": 20e-6, "youngs_modulus": 5e9, "poissons_ratio": 0.4}},
}


def like_bodies(tables: dict, **finite_element: object) -> tuple[Problem, Level]:
    """Like bodies under friction, on one level."""
    made = {
        "roller": {"radius": 8.2e-3, **STEEL},
        "body": STEEL,
        "load": {"hertz_peak_pressure": 1.5e9, "friction": 0.3},
        "finite_element": finite_element,
        "resolution": {"pitch": HALF_WIDTH / 20.0},
    } | tables
    posed = problem(made)
    return posed, finite_elements(posed)


def test_like_half_planes_are_moved_alike():
    _, still = like_bodies({})
    _, moved = like_bodies({}, coupled=True)
    apart = np.abs(moved.solution.pressure - still.solution.pressure).max()
    assert moved.solution.converged and apart < 1e-9 * still.solution.pressure.max()


@pytest.mark.parametrize("name", BODIES)
def test_what_layers_and_coats_are_moved_otherwise_is_not_passed_over(name):
    posed, still = like_bodies(BODIES[name])
    _, moved = like_bodies(BODIES[name], coupled=True)
    assert relative_l2(moved.solution.pressure, still.solution.pressure) > 0.003
    selection = select_effects(posed, Shown(*2 * [posed.hertz.peak_pressure]))
    assert "normal_tangential_coupling" in selection.added
