"""Scenes taken apart into effects, and put together again."""

from functools import partial

import pytest

from comparisons.judging.effects.catalogue import (
    EFFECTS,
    UNKNOWN,
    contained,
    is_taken_apart,
    model_with,
    with_effects,
)

plain = partial(with_effects, names=())
SWITCHED = {
    "finite_size": {"body": {"thickness": 1e-3}},
    "coating": {"coating": {"thickness": 2e-6, "youngs_modulus": 400e9, "poissons_ratio": 0.2}},
    "exact_circle": {"finite_element": {"roller_shape": "circle"}},
    "finite_roller": {"finite_element": {"roller_body": "disc"}},
    "normal_tangential_coupling": {
        "roller": {"rigid": True},
        "load": {"friction": 0.2},
        "finite_element": {"coupled": True},
    },
    "finite_strain": {"roller": {"rigid": True}, "finite_element": {"deformation": "finite"}},
    "plastic_flow": {
        "body": {"yield_stress": 1e9, "hardening_modulus": 1e9},
        "finite_element": {"plastic": True},
    },
}


def test_every_effect_is_tried():
    assert {*SWITCHED, *UNKNOWN} == set(EFFECTS)  # which are no switches
    assert UNKNOWN == ("law_of_elasticity", "roller_support", "trace_sampling")


@pytest.mark.parametrize("name", SWITCHED)
def test_a_scene_with_one_switch_has_that_effect_alone(problem_with, name):
    """Without it, it is what the half-plane takes; it is given whatever else is there."""
    scene = problem_with(**SWITCHED[name]).scene
    assert contained(scene) == {name}
    assert is_taken_apart(scene)
    assert contained(plain(scene)) == frozenset()
    assert plain(plain(scene)) == plain(scene)
    others = {"finite_strain", "exact_circle"}
    assert contained(with_effects(scene, {name, *others})) == {name, *others}


@pytest.mark.parametrize(
    ("tables", "size"),
    [
        ({"body": {"thickness": 0.1}}, 0.1),
        ({"body": {"width": 0.1}}, 0.1),
        ({"body": {"thickness": 0.1, "width": 0.2}}, 0.1),
        ({"finite_element": {"roller_body": "disc"}, "roller": {"radius": 0.5}}, 0.5),
    ],
)
def test_what_lacks_a_size_ends_beyond_it(problem_with, tables, size):
    posed = problem_with(load={"hertz_peak_pressure": 2e8}, **tables)
    assert min(model_with(posed, frozenset()).posed(posed).unbounded) > 4.0 * size
    assert posed.unbounded[0] == 400.0 * posed.hertz.half_width


def test_a_wide_body_goes_deeper_than_its_sides_are_felt(problem_with):
    assert problem_with(body={"width": 0.1}).unbounded[1] == pytest.approx(0.3)


def test_what_both_models_have_is_no_effect(problem_with):
    scene = problem_with(roller={"rigid": True}, load={"friction": 0.2, "coupled": True}).scene
    assert contained(scene) == frozenset()
    assert plain(scene).finite_element.coupled  # as the half-plane is


def test_a_scene_that_keeps_less_than_the_half_plane_has_is_told(problem_with):
    scene = problem_with(
        roller={"rigid": True},
        load={"friction": 0.2, "coupled": True},
        finite_element={"coupled": False},
    ).scene
    assert not is_taken_apart(scene)
