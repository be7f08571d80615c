"""A body that yields, through a scene: what flow does to the contact and what it leaves behind."""

from types import SimpleNamespace

import meshio
import numpy as np
import pytest
from scenes import STEEL, changed, finite_elements, problem, resolved

from comparisons.common.errors import ExitStatus, SolverError
from comparisons.common.numbers import decimal, significant
from comparisons.figures.quantity import MODELS
from comparisons.figures.uncertainty import length_resolution
from comparisons.judging.rule import judged, values_of
from comparisons.models.finite_element.loaded import refuse_cut_off
from comparisons.models.finite_element.mesh import Refinement, expected, flow_increments
from comparisons.models.level import flowing_contact
from comparisons.models.posing import problem_of
from comparisons.output.page.pictures.stresses import plastic_strain_pictures
from comparisons.runs.run import run
from comparisons.scenes.scene import Scene
from fem.solver.mumps import FemError

pytestmark = pytest.mark.usefixtures("undrawn")

YIELD_STRESS = 1e9
TABLES = {
    "roller": {"radius": 10e-3, "rigid": True},
    "body": {**STEEL, "yield_stress": YIELD_STRESS, "hardening_modulus": 10e9, "hardness": 2e9},
    "load": {"hertz_peak_pressure": 2.4e9},
    "stress": {"depth": 2.0, "points": [21, 11]},
    "resolution": {"pitch": "40 um", "levels": 2},
    "finite_element": {"plastic": True, "block": 40},
    "budget": {"time": 1e-6},
}


@pytest.fixture(scope="module")
def outcome(tmp_path_factory):
    return run(resolved(TABLES), tmp_path_factory.mktemp("yielding") / "out", MODELS)


@pytest.fixture(scope="module")
def mesh(outcome):
    return meshio.read(outcome.directory / "finite_element" / "stress.vtu")


def test_flow_and_not_the_hardness_limits_the_pressure(outcome):
    """The half-plane is capped at 2 GPa; the body flows from 1.79 Y on and bears more."""
    half_plane, finite_element = (outcome.runs[name].finest.solution for name in MODELS)
    assert half_plane.pressure.max() == pytest.approx(2e9)
    assert 2.05e9 < finite_element.pressure.max() < 2.25e9
    assert outcome.exit_status != ExitStatus.NOT_CONVERGED


def test_equivalent_stress_stays_at_what_the_metal_bears(outcome, mesh):
    strain = mesh.point_data["equivalent_plastic_strain"]
    bears = YIELD_STRESS + 10e9 * strain
    assert 1e-3 < strain.max() < 2e-2
    # nodal means lie a little beside what holds at the points of the elements
    assert (mesh.point_data["von_mises"] / bears).max() < 1.15
    wanted = {"quantity": "von_mises_max", "source": "finite_element"}
    assert outcome.figures.one(study="contact", **wanted).value < 1.15 * bears.max()


def test_the_page_shows_where_it_flows(outcome, mesh):
    [picture] = plastic_strain_pictures(outcome)
    strain, a = mesh.point_data["equivalent_plastic_strain"], outcome.problem.hertz.half_width
    x, z, _ = mesh.points[strain.argmax()] / a
    largest = significant(100.0 * strain.max(), 3)
    assert f"finite elements: largest {largest} %" in picture.alternative
    assert f"at x = {decimal(x)} a, z = {significant(z, 2)} a" in picture.alternative


def test_what_is_left_is_small_and_not_nothing(mesh):
    residual = mesh.point_data["residual_von_mises"]
    assert 0.02 * YIELD_STRESS < residual.max() < YIELD_STRESS
    surface = np.abs(mesh.points[:, 1]) < 1e-12
    # the roller is gone: nothing presses on the surface
    assert np.abs(mesh.point_data["residual_sz"][surface]).max() < 0.1 * YIELD_STRESS


def test_expected_increments_follow_the_edges_of_patches():
    """But no further than Hertz's contact; an edge comes from the middle of its patch, early
    those of the widest alone."""
    posed = problem(TABLES)
    a = posed.hertz.half_width

    def increments(hats, width, travel=1.0):
        refinement = Refinement(a / hats, travel=travel)
        return flow_increments(posed, refinement, width * a * np.array([[-0.5, 0.5]]))

    assert increments(40, 1.0) == pytest.approx(20.0)
    assert increments(80, 1.0) == pytest.approx(40.0)
    assert increments(80, 1.0, travel=2.0) == pytest.approx(20.0)
    assert increments(80, 100.0) == pytest.approx(80.0)
    assert increments(80, 1e-3) == 4.0
    narrow = np.array([[-9.0, -8.0], [-0.1, 0.1]]) * a  # 20 hats from the middle, and 4
    assert flow_increments(posed, Refinement(a / 40), narrow) == pytest.approx(0.5 * (20.0 + 12.0))
    equal = np.array([[-1.0, 0.0], [0.0, 1.0]]) * a
    assert flow_increments(posed, Refinement(a / 40), equal) == pytest.approx(20.0)


def test_increments_have_an_uncertainty_of_their_own(outcome):
    """It covers what shorter ones change, and the total contains it."""
    posed, elements = outcome.problem, outcome.runs["finite_element"]
    pitch = elements.finest.grid.pitch
    level = finite_elements(posed, pitch, fields=True, travel=0.25)
    stated = judged(elements, posed)
    reached = values_of(elements.finest, posed)
    edge = length_resolution(pitch, 1) / elements.finest.contact_length
    moved_to = values_of(level, posed)
    # the depth of the maximum jumps on so coarse a mesh
    for name in ("peak_pressure", "contact_length", "tau1_max", "txz_max_abs"):
        moved = abs(moved_to[name] - reached[name]) / abs(reached[name])
        read = edge if name == "contact_length" else 0.0
        by_increments = stated[name].uncertainty.parts["increments"]
        assert moved <= by_increments + read < stated[name].total, name
    assert 1e-3 < stated["peak_pressure"].uncertainty.parts["increments"] < 0.02
    shown = outcome.figures.one(source="finite_element", quantity="peak_pressure")
    assert shown.uncertainty == stated["peak_pressure"].uncertainty


def test_a_load_that_cannot_be_reached_ends_with_what_may_help(tmp_path, monkeypatch):
    monkeypatch.setattr("fem.nonlinear.newton.MOST_LINEAR_CONTACTS", 1)
    monkeypatch.setattr("fem.nonlinear.press_plastic.MOST_SINKING", 0)
    scene = resolved(TABLES)
    with pytest.raises(SolverError, match=r"made\.toml: .*a lighter load, a higher body\.yield"):
        run(scene, tmp_path / "out", ("finite_element",))
    assert list(tmp_path.iterdir()) == []


def deep(friction=0.0):
    """Without the half-plane's hardness, at four times the load of first yield and coarse."""
    body = {name: value for name, value in TABLES["body"].items() if name != "hardness"}
    return changed(
        TABLES | {"body": body},
        load={"hertz_peak_pressure": 7e9, "friction": friction},
        resolution={"pitch": "180 um"},
        finite_element={"coupled": friction > 0.0},
    )


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_contact_spreads_beyond_one_and_a_half_half_widths(friction):
    """Contact spreads as far as flow takes it: pressures end before the grid does."""
    posed = problem(deep(friction))
    level, a = finite_elements(posed, travel=4.0), posed.hertz.half_width
    assert level.contact_length > 3.1 * a
    assert not level.solution.pressure[[0, -1]].any()
    assert level.solution.pressure.max() < 4.0 * YIELD_STRESS


def test_contact_that_leaves_the_grid_is_refused(outcome):
    """The grid is wide enough for what the surface bears when it is sheared off: no scene leaves
    it, and a change that did would be said."""
    level = outcome.runs["finite_element"].finest
    contact = SimpleNamespace(problem=outcome.problem, grid=level.grid, solution=level.solution)
    refuse_cut_off(contact, level.solution.pressure, "here")
    with pytest.raises(FemError, match="contact here reaches beyond the pressure elements"):
        refuse_cut_off(contact, level.solution.pressure + 1.0, "here")


def test_the_shipped_scene_is_solved_below_its_elastic_roller():
    """Its pressure elements reach beyond the fine mesh; a third beyond first flow the body bears
    less than Hertz's peak, on a longer contact."""
    posed = problem_of(Scene.read("yielding"))
    # on the second of its levels; the third costs six times as much
    level, hertz = finite_elements(posed, posed.pitches[1]), 2.4e9
    assert level.solution.converged
    assert 0.9 * hertz < level.solution.pressure.max() < 0.94 * hertz
    assert 855e-6 < level.contact_length < 875e-6


TURNED = {
    "roller": {"radius": 3e-3, **STEEL},
    "body": {
        "youngs_modulus": 70e9,
        "poissons_ratio": 0.33,
        "yield_stress": 280e6,
        "hardening_modulus": 1e9,
    },
    "profile": {"kind": "turned", "feed": 4e-5, "nose_radius": 4e-4, "length": 1e-3},
    "load": {"hertz_peak_pressure": 0.4e9, "friction": 0.1},
    "finite_element": {"plastic": True},
}


def test_a_turned_metal_flows_below_an_elastic_roller():
    """Beside its refined ranges hats are denser than nodes: the roller's compliance is singular
    there. Load and contact conditions hold far below what Newton's method may leave. What the level
    was expected to take is what a plan says of it."""
    posed = problem(TURNED)
    level = finite_elements(posed, travel=4.0)
    solution = level.solution
    assert solution.converged and solution.residuals.worst < 1e-11
    cost = expected(posed, Refinement(posed.pitches[0], travel=4.0), flowing_contact(posed))
    assert (level.expected_seconds, level.expected_memory) == (cost.seconds, cost.memory)
    assert 2.5 * 280e6 < solution.pressure.max() < 3.7 * 280e6
