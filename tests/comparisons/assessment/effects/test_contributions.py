"""EffectContributions, interaction and whole: they add up whatever the bodies answer."""

import itertools
from dataclasses import replace

import numpy as np
import pytest

from analytic.material import Material
from comparisons.assessment.effects.contributions import contributions_of
from comparisons.assessment.effects.quantities_of_interest import (
    QuantitiesOfInterest,
    relative_sizes,
)
from comparisons.assessment.effects.selection import EffectSelection
from comparisons.assessment.effects.variants import (
    ModelVariant,
    combined_body,
    strain_share,
    strain_share_uncertainty,
)
from comparisons.assessment.effects.variants import problem_with as body_problem

LINEAR = ("deformed_gap", "exact_circle", "normal_tangential_coupling")


def selection_of(contained=(), added=()):
    return EffectSelection(frozenset(contained), frozenset(added), {}, {}, {})


def close(one: QuantitiesOfInterest, other: QuantitiesOfInterest) -> bool:
    return (
        one.figures == pytest.approx(other.figures)
        and np.allclose(one.pressure, other.pressure)
        and np.allclose(one.tau1, other.tau1)
    )


@pytest.mark.parametrize("count", range(len(LINEAR) + 1))
@pytest.mark.parametrize("strained", [False, True])
@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_effects_and_interaction_add_up_to_the_whole(
    problem_with, made_solutions, count, strained, friction
):
    problem = problem_with(roller={"rigid": True}, load={"friction": friction})
    own = ModelVariant(frozenset())
    for names in itertools.combinations(LINEAR, count):
        bodies = made_solutions(own)
        selection = selection_of(added={*names, *(["finite_strain"] if strained else [])})
        parts = contributions_of(problem, bodies, selection, friction, 1)
        total = sum(parts.effects.values(), start=parts.interaction)
        assert close(total, parts.not_contained)  # the scene's own has none of them
        expected = set(names) - ({"normal_tangential_coupling"} if friction == 0.0 else set())
        assert set(parts.effects) == expected | ({"finite_strain"} if strained else set())


def test_one_effect_does_not_interact(problem_with, made_solutions):
    problem = problem_with(roller={"rigid": True})
    parts = contributions_of(
        problem,
        made_solutions(ModelVariant(frozenset())),
        selection_of(added={"exact_circle"}),
        0.0,
        1,
    )
    assert not np.any(parts.interaction.pressure)
    assert close(parts.effects["exact_circle"], parts.not_contained)


def test_what_the_scene_has_is_split_but_not_lacking(problem_with, made_solutions):
    problem = problem_with(roller={"rigid": True}, finite_element={"gap": "displaced"})
    own = ModelVariant(frozenset({"deformed_gap"}))
    parts = contributions_of(problem, made_solutions(own), selection_of({"deformed_gap"}), 0.0, 1)
    assert set(parts.effects) == {"deformed_gap"}
    assert np.any(parts.effects["deformed_gap"].pressure)
    assert not np.any(parts.not_contained.pressure)


def test_friction_coefficients_share_bodies_that_it_does_not_press_otherwise(
    problem_with, made_solutions
):
    problem = problem_with(roller={"rigid": True}, load={"friction": [0.1, 0.3]})
    bodies = made_solutions(ModelVariant(frozenset()))
    for friction in problem.scene.friction:
        contributions_of(
            problem,
            bodies,
            selection_of(added={"exact_circle", "normal_tangential_coupling"}),
            friction,
            1,
        )
    assert {
        body.friction for body in bodies.asked if "normal_tangential_coupling" in body.effects
    } == {0.1, 0.3}
    assert {
        body.friction for body in bodies.asked if "normal_tangential_coupling" not in body.effects
    } == {None}


def test_strain_is_measured_beside_all_that_it_cannot_be_without(problem_with, made_solutions):
    wavy = {"kind": "sinusoid", "wavelength": 50e-6, "amplitude": 0.1e-6}
    problem = problem_with(roller={"rigid": True}, profile=wavy, load={"friction": 0.2})
    bodies = made_solutions(ModelVariant(frozenset()))
    contributions_of(problem, bodies, selection_of(added={"finite_strain"}), 0.2, 1)
    [strained] = {body for body in bodies.asked if "finite_strain" in body.effects}
    beside = {"deformed_gap", "rough_boundary", "normal_tangential_coupling"}
    assert strained.effects == beside | {"finite_strain"}
    assert ModelVariant(frozenset(beside), 0.2) in bodies.asked
    scene = body_problem(problem, strained).scene
    assert scene.finite_element.coupled and scene.friction == (0.2,)


class TestStandIn:
    def test_a_rigid_roller_needs_none(self, problem_with):
        problem = problem_with(roller={"rigid": True})
        assert strain_share(problem) == 1.0 and strain_share_uncertainty(problem) == 0.0

    def test_like_bodies_share_alike(self, problem_with):
        assert strain_share(problem_with()) == pytest.approx(0.5)
        assert strain_share_uncertainty(problem_with()) == pytest.approx(0.5)

    @pytest.mark.parametrize(("ratio", "share"), [(1e6, 1.0), (1e-6, 1.0), (3.0, 10.0 / 16.0)])
    def test_unlike_bodies(self, problem_with, ratio, share):
        problem = problem_with(roller={"youngs_modulus": ratio * 210e9})
        assert strain_share(problem) == pytest.approx(share, rel=1e-5)
        # a hard body under a soft roller hardly strains, whatever the contact does
        assert strain_share_uncertainty(problem) == pytest.approx(
            max(1.0 - share, abs(share - ratio / (1.0 + ratio)) / share), rel=1e-4, abs=1e-5
        )

    def test_it_has_the_pair_s_contact(self, problem_with):
        problem = problem_with(roller={"youngs_modulus": 70e9, "poissons_ratio": 0.2})
        body = combined_body(problem)
        assert body.plane_strain_modulus == pytest.approx(problem.modulus)
        assert body.poissons_ratio == 0.3
        scene = body_problem(problem, ModelVariant(frozenset(), stand_in=True)).scene
        assert scene.roller is None and scene.body == body

    def test_half_of_its_strain_is_that_of_like_bodies(self, problem_with, made_solutions):
        problem = problem_with()
        bodies = made_solutions(ModelVariant(frozenset()))
        parts = contributions_of(problem, bodies, selection_of(added={"finite_strain"}), 0.0, 1)
        beside = frozenset({"deformed_gap"})
        strained = bodies.solution(ModelVariant(beside | {"finite_strain"}, 0.0, True), 1, 0.0)
        change = strained - bodies.solution(ModelVariant(beside, 0.0, True), 1, 0.0)
        assert close(parts.effects["finite_strain"], change * 0.5)

    def test_it_is_solved_as_finite_deformation_is(self, problem_with):
        settings = {"far_field": "half-plane", "element": "P3"}
        problem = problem_with(finite_element=settings)
        scene = body_problem(problem, ModelVariant(frozenset(), held=True)).scene
        assert (scene.finite_element.far_field, scene.finite_element.element) == ("held", "P2")
        assert scene.finite_element.block == 400.0


def test_sizes_are_relative_to_the_figure_or_to_hertz(problem_with):
    problem = problem_with()
    whole = QuantitiesOfInterest({"peak_pressure": -4.0, "tau1_max_depth": 0.0}, np.ones(4), None)
    change = QuantitiesOfInterest(
        {"peak_pressure": 1.0, "tau1_max_depth": 1e-6}, 0.5 * np.ones(4), None
    )
    found = relative_sizes(change, whole, problem, None)
    assert found["peak_pressure"] == 0.25
    assert found["tau1_max_depth"] == pytest.approx(1e-6 / problem.hertz.half_width)
    assert found["pressure_l2"] == pytest.approx(0.5)
    assert relative_sizes(change * -1.0, whole, problem, None)["peak_pressure"] == -0.25


def test_bodies_have_names_of_their_own():
    bodies = [
        ModelVariant(frozenset(names), friction, stand_in)
        for names in (
            (),
            ("exact_circle",),
            ("finite_roller",),
            ("exact_circle", "finite_roller"),
            ("finite_strain",),
        )
        for friction in (None, 0.1, 0.2)
        for stand_in in (False, True)
    ]
    assert len({body.name for body in bodies}) == len(bodies)
    assert all(set(body.name) <= set("abcdefghijklmnopqrstuvwxyz+-.@0123456789") for body in bodies)


def test_a_material_of_another_modulus_is_another_body(problem_with):
    problem = problem_with()
    assert isinstance(combined_body(problem), Material)
    assert replace(problem.scene, body=combined_body(problem)) != problem.scene
