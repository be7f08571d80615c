"""One assumption of the finite elements switched off at a time, all else the same; every two
switches together, solved with finite figures or refused."""

from dataclasses import replace
from functools import lru_cache
from itertools import combinations

import numpy as np
import pytest
from scenes import STEEL as PAIRED
from scenes import changed, finite_elements, half_plane_at, problem, resolved

from comparisons.common.errors import SceneError
from comparisons.common.progress import Stages
from comparisons.models.finite_element.bodies import BodyCache, bodies_of
from comparisons.models.finite_element.level import finite_element_level
from comparisons.models.finite_element.mesh import Refinement
from comparisons.models.posing import problem_of
from comparisons.models.problem import Problem
from comparisons.models.window import window_of
from comparisons.scenes.scene import Scene

STEEL = {"youngs_modulus": 200e9, "poissons_ratio": 0.3}
RADIUS, HALF_WIDTH = 10e-3, 200e-6  # a/R = 0.02 under a rigid roller
RIGID = {
    "roller": {"radius": RADIUS, "rigid": True},
    "body": STEEL,
    "load": {"per_length": np.pi / 4.0 * 200e9 / 0.91 * HALF_WIDTH**2 / RADIUS},
}
ELASTIC = {**RIGID, "roller": {"radius": RADIUS, "youngs_modulus": 200e9, "poissons_ratio": 0.2}}


def problem_with(tables: dict, finite_element: dict, **sections: dict) -> Problem:
    return problem(changed(tables, **sections) | {"finite_element": finite_element})


def level_of(tables: dict, finite_element: dict, **sections: dict):
    problem = problem_with(tables, finite_element, **sections)
    level = finite_elements(problem, problem.pitches[1])
    assert level.solution.converged
    return problem, level


def figures(tables: dict, finite_element: dict, **sections: dict) -> np.ndarray:
    """Peak pressure and half-width, relative to Hertz."""
    problem, level = level_of(tables, finite_element, **sections)
    peak, half_width = level.solution.pressure.max(), 0.5 * level.contact_length
    return np.array([peak / problem.hertz.peak_pressure, half_width / problem.hertz.half_width])


@lru_cache
def plain(roller: str) -> np.ndarray:
    return figures({"rigid": RIGID, "elastic": ELASTIC}[roller], {})


def test_with_every_assumption_kept_it_is_hertz():
    assert plain("rigid") == pytest.approx(1.0, abs=1e-3)
    assert plain("elastic") == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize(
    ("finite_element", "peak", "half_width"),
    [
        # of second order in a/R
        ({"roller_shape": "circle"}, 2.4e-5, -8e-5),
        ({"roller_shape": "circle", "deformation": "finite"}, 1.41e-3, -5.3e-4),
    ],
)
def test_what_a_rigid_roller_changes(finite_element, peak, half_width):
    change = figures(RIGID, finite_element) - plain("rigid")
    assert change == pytest.approx(np.array([peak, half_width]), rel=0.1)


def test_an_elastic_disc_is_a_little_stiffer_than_the_half_plane_that_stands_for_it():
    change = figures(ELASTIC, {"roller_body": "disc"}) - plain("elastic")
    assert 2e-4 < change[0] < 7e-4
    assert -7e-4 < change[1] < -2e-4


def test_cubic_elements_err_less_and_linear_ones_more():
    errors = {
        element: abs(figures(RIGID, {"element": element})[0] - 1.0)
        for element in ("P1", "P2", "P3")
    }
    assert 5e-3 < errors["P1"] < 3e-2
    assert 3.0 * errors["P3"] < errors["P2"] < errors["P1"] / 50.0


def test_a_stiff_coating_narrows_the_contact():
    hard = {"thickness": 0.1 * HALF_WIDTH, "youngs_modulus": 400e9, "poissons_ratio": 0.2}
    change = figures(RIGID, {}, coating=hard) - plain("rigid")
    assert 5e-3 < change[0] < 2e-2
    assert -6e-2 < change[1] < -2e-2


@pytest.mark.parametrize("tables", [RIGID, ELASTIC], ids=["rigid", "elastic"])
def test_coupled_both_models_move_alike(tables):
    load = {"friction": 0.5, "coupled": True}
    problem, level = level_of(tables, {}, load=load)
    other = half_plane_at(problem, problem.pitches[1])

    def centroid(pressure: np.ndarray) -> float:
        return float(level.grid.x @ pressure / pressure.sum()) / problem.hertz.half_width

    shift = centroid(level.solution.pressure)
    assert abs(shift) > 0.01
    # the block's boundary holds back a little of it
    assert shift == pytest.approx(centroid(other.solution.pressure), abs=1.5e-3)


def test_a_list_of_friction_coefficients_and_a_repetition_share_one_factorisation():
    problem = problem_with(RIGID, {}, load={"friction": [0.0, 0.1, 0.2]}, stress={"points": [9, 5]})
    body_cache, refinement = BodyCache(), Refinement(problem.pitches[0])
    first, second = Stages(), Stages()
    how = replace(problem, window=None), refinement
    one, other = (finite_element_level(*how, stages, body_cache)[0.0] for stages in (first, second))
    assert "factorisation" in first.seconds and "factorisation" not in second.seconds
    assert np.array_equal(one.solution.pressure, other.solution.pressure)
    held = Refinement(problem.pitches[0], half_block=True)
    third = Stages()
    finite_element_level(how[0], held, third, body_cache=body_cache)
    assert "factorisation" in third.seconds  # another support, the same mesh
    assert third.seconds["mesh"] < 0.1 * first.seconds["mesh"]


def test_a_roller_like_the_body_that_flows_shares_its_factor():
    problem = problem_of(Scene.read("yielding"))
    half = problem.hertz.half_width
    patches, refinement = np.array([[-half, half]]), Refinement(problem.pitches[0])
    bodies = bodies_of(problem, refinement, patches, Stages(), BodyCache())
    assert bodies.roller is bodies.rough
    disc = problem.scene.unchecked({"finite_element.roller_body": "disc"})
    problem = replace(problem, scene=disc)
    bodies = bodies_of(problem, refinement, patches, Stages(), BodyCache())
    assert bodies.roller is not bodies.rough


def test_finite_rotations_leave_the_surface_at_the_edge_of_contact_without_shear():
    """At a/R = 0.18 a stress that takes rotations for strains is 1.2 times the largest there."""
    load = {"per_length": 85.0 * RIGID["load"]["per_length"]}
    tables = {**RIGID, "load": load, "stress": {"points": [41, 11]}}
    problem = problem_with(tables, {"deformation": "finite", "roller_shape": "circle"})
    level, window, hertz = finite_elements(problem, fields=True), window_of(problem), problem.hertz
    assert hertz.half_width / RADIUS == pytest.approx(0.184, abs=1e-3)
    stress = level.stress
    largest = stress.extremes["tau1"]
    assert largest.value / hertz.tau1_max == pytest.approx(1.023, abs=0.01)
    assert largest.z / hertz.half_width == pytest.approx(0.767, abs=0.02)
    at_edge = np.abs(np.abs(window.x) - hertz.half_width) < 0.1 * hertz.half_width
    assert stress.field.tau1[0, at_edge].max() < 0.15 * largest.value


BASE = {
    "roller": {"radius": 8e-3, "rigid": True},
    "body": dict(PAIRED),
    "load": {"hertz_peak_pressure": 1.5e9, "friction": 0.2},
    "stress": {"points": [11, 5]},
    "resolution": {"pitch": "20 um"},
    "finite_element": {"block": 20, "growth": 0.5},
}
SWITCHES = {
    "rough": {"profile": {"kind": "sinusoid", "wavelength": 1.2e-4, "amplitude": 2e-7}},
    "circle": {"finite_element": {"roller_shape": "circle"}},
    "elastic": {"roller": {"rigid": False, "youngs_modulus": 300e9, "poissons_ratio": 0.25}},
    "disc": {
        "roller": {"rigid": False, "youngs_modulus": 300e9, "poissons_ratio": 0.25},
        "finite_element": {"roller_body": "disc"},
    },
    "coupled": {"finite_element": {"coupled": True}},
    "finite": {"finite_element": {"deformation": "finite", "coupled": True}},
    "plastic": {
        "body": {"yield_stress": 0.8e9},
        "finite_element": {"plastic": True, "coupled": True},
    },
    "P1": {"finite_element": {"element": "P1"}},
    "P3": {"finite_element": {"element": "P3"}},
    "coated": {"coating": {"thickness": 3e-5, "youngs_modulus": 400e9, "poissons_ratio": 0.2}},
    "layer": {"body": {"thickness": 3e-4}},
    "width": {"body": {"width": 4e-3}},
    "hard": {"body": {"hardness": 1.4e9}},
}


REFUSED = {frozenset((body, element)) for body in ("finite", "plastic") for element in ("P1", "P3")}


@pytest.mark.parametrize("pair", list(combinations(SWITCHES, 2)), ids="-".join)
def test_pair(pair):
    one, other = (SWITCHES[name] for name in pair)
    tables = changed(changed(BASE, **one), **other)
    if frozenset(pair) in REFUSED:
        with pytest.raises(SceneError, match=r"made\.toml: finite_element\.\w+: .*allowed"):
            resolved(tables)
        return
    posed = problem(tables)
    level = finite_elements(posed, fields=True)
    solution = level.solution
    assert solution.converged
    assert solution.load == pytest.approx(posed.hertz.load_per_length, rel=1e-6)
    assert 0.5 < solution.pressure.max() / posed.hertz.peak_pressure < 2.5
    arrays = [solution.pressure, solution.gap, level.displacement, level.patches]
    for stress in level.field_on_mesh.stresses.values():
        arrays += [stress.sx, stress.sz, stress.txz]
    arrays += [*level.field_on_mesh.others.values(), level.field_on_mesh.poissons_ratio]
    assert all(np.isfinite(values).all() for values in arrays)
