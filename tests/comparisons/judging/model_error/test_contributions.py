"""Contributions, interaction and whole: they add up whatever the bodies answer."""

import itertools
from collections.abc import Iterable
from functools import reduce
from operator import sub

import numpy as np
import pytest

from comparisons.judging.effects.catalogue import model_with
from comparisons.judging.effects.selection import EffectSelection
from comparisons.judging.model_error.model_error import Solutions, split_variants
from comparisons.judging.rule import QuantitiesOfInterest
from comparisons.judging.study import Case

COUPLED = "normal_tangential_coupling"
SINGLE = ("finite_roller", "exact_circle", COUPLED, "finite_strain")
PLAIN, CIRCLE = "effect-none", "effect-exact-circle"  # names of models
WAVY = {"kind": "sinusoid", "wavelength": 50e-6, "amplitude": 0.1e-6}


def selection_of(contained: Iterable[str] = (), added: Iterable[str] = ()) -> EffectSelection:
    return EffectSelection(frozenset(contained), frozenset(added), {}, {})


def is_nothing(difference: QuantitiesOfInterest) -> bool:
    return all(np.allclose(values, 0.0) for values in difference.figures.values())


def what_is_left(parts: Solutions) -> QuantitiesOfInterest:
    """Rest of what the scene's own elements lack, without the effects and their interaction."""
    effects = (change for [change] in parts.effects.values())
    return reduce(sub, effects, parts.missing[0] - parts.interaction[0])


def drawn(name: str) -> QuantitiesOfInterest:
    """A solution drawn at random, the same for each model of the name."""
    rng = np.random.default_rng(abs(hash(name)))
    figures = {"peak_pressure": rng.normal(size=3), "contact_length": rng.normal(size=1)}
    return QuantitiesOfInterest(figures)


def split_by(problem, friction=0.0, contained=(), added=(), scene=PLAIN, without=()):
    """The variants, and solutions of all but those `without` on one level; the scene's own finite
    elements are the model of the name `scene`."""
    split = split_variants(problem, selection_of(contained, added), friction)
    names = {None: scene} | {variant: variant.name for variant in split.all}
    level = {one: drawn(name) for one, name in names.items() if name not in without}
    return split, Solutions(Case(problem), split, (), (level,), 1)


@pytest.mark.parametrize("count", range(1, len(SINGLE) + 1))
@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_effects_and_interaction_add_up_to_the_whole(problem_with, count, friction):
    problem = problem_with(load={"friction": friction})
    for names in itertools.combinations(SINGLE, count):
        _, parts = split_by(problem, friction, added=names)
        assert is_nothing(what_is_left(parts))  # the scene's own has none of them
        assert set(parts.effects) == set(names) - ({COUPLED} if friction == 0.0 else set())


@pytest.mark.parametrize("name", ["exact_circle", "finite_strain"])
def test_one_effect_does_not_interact(problem_with, name):
    split, parts = split_by(problem_with(), added={name})
    assert is_nothing(parts.interaction[0])
    assert is_nothing(parts.effects[name][0] - parts.missing[0])
    assert len(split.all) == 2


def test_what_the_scene_has_is_split_but_not_lacking(problem_with):
    problem = problem_with(finite_element={"roller_shape": "circle"})
    _, parts = split_by(problem, contained={"exact_circle"}, scene=CIRCLE)
    assert set(parts.effects) == {"exact_circle"}
    assert not is_nothing(parts.effects["exact_circle"][0])
    assert is_nothing(parts.missing[0])


def test_frictions_share_bodies_that_it_does_not_press_otherwise(problem_with):
    problem = problem_with(roller={"rigid": True}, load={"friction": [0.1, 0.3]})
    selection = selection_of(added={"exact_circle", COUPLED})
    asked = {pressed for mu in (0.1, 0.3) for pressed in split_variants(problem, selection, mu).all}
    coupled, others = (
        [v for v in asked if (COUPLED in v.effects) == is_it] for is_it in (True, False)
    )
    posed = sorted(variant.posed(problem).scene.load.friction for variant in coupled)
    assert posed == [(0.1,), (0.1,), (0.3,), (0.3,)]
    assert {variant.posed(problem).scene.load.friction for variant in others} == {(0.1, 0.3)}


class TestFiniteDeformation:
    """Measured with friction where there is any, and on the trace as boundary."""

    def test_it_is_the_only_effect_that_is_solved(self, problem_with):
        problem = problem_with(roller={"rigid": True}, profile=WAVY, load={"friction": 0.2})
        split, parts = split_by(problem, 0.2, added={"finite_strain"})
        assert set(parts.effects) == {"finite_strain"}
        assert split.whole == model_with(problem, frozenset({"finite_strain", COUPLED}), 0.2)
        assert {variant.name for variant in split.all} == {split.whole.name, PLAIN}
        strained = split.whole.posed(problem)
        assert strained.scene.finite_element.coupled and strained.scene.load.friction == (0.2,)
        assert strained.rough_boundary

    def test_coupling_that_matters_is_no_part_of_it(self, problem_with):
        problem = problem_with(roller={"rigid": True}, load={"friction": 0.2})
        added = {"finite_strain", COUPLED}
        split, parts = split_by(problem, 0.2, added=added)
        coupled = model_with(problem, frozenset({COUPLED}), 0.2)
        assert split.pairs[COUPLED] == (coupled, model_with(problem, frozenset()))
        assert split.pairs["finite_strain"] == (split.whole, coupled)
        assert is_nothing(parts.interaction[0])

    @pytest.mark.parametrize("name", ["finite_strain", "plastic_flow"])
    def test_all_bodies_are_solved_as_it_is(self, problem_with, name):
        problem = problem_with(body={"yield_stress": 1e9}, finite_element={"element": "P3"})
        split = split_variants(problem, selection_of(added={name}), 0.0)
        linear = split_variants(problem, selection_of(added={"exact_circle"}), 0.0)
        assert split.of_scene == split.nothing and linear.of_scene is None
        for made, element in ((split, "P2"), (linear, "P3")):
            scenes = [variant.posed(problem).scene for variant in made.all]
            assert {scene.finite_element.element for scene in scenes} == {element}


class TestWithoutSolution:
    ADDED = ("exact_circle", "finite_roller", "finite_strain")

    def test_of_an_effect_by_itself_the_interaction_has_it(self, problem_with):
        _, parts = split_by(problem_with(), added=self.ADDED, without=(CIRCLE,))
        assert set(parts.effects) == {"finite_roller", "finite_strain"}
        assert is_nothing(what_is_left(parts))

    def test_of_none_the_whole_stays(self, problem_with):
        how = {"scene": CIRCLE, "without": (PLAIN,)}
        split, parts = split_by(problem_with(), added=self.ADDED, **how)
        assert parts.effects == {} and split.nothing not in parts.history[0]
        assert not is_nothing(parts.missing[0])


def test_bodies_have_names_of_their_own(problem_with):
    circle, roller, strain = ({n} for n in ("exact_circle", "finite_roller", "finite_strain"))
    bodies = [
        model_with(problem_with(), frozenset(names), friction, quadratic)
        for names in (set(), circle, roller, circle | roller, strain)
        for friction in (None, 0.1, 0.2)
        for quadratic in (False, True)
    ]
    assert len({body.name for body in bodies}) == len(bodies)
    assert all(set(body.name) <= set("abcdefghijklmnopqrstuvwxyz+-.@0123456789") for body in bodies)
