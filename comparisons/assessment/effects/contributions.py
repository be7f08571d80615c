"""The effects one by one and together, on each level: differences of answers.

With F(S) the finite elements' answer with the effects S, L the linear effects and 0 none of them:

    part of a linear effect i     F({i}) - F(0)
    part of a nonlinear one       F(L + n) - F(L), on bodies as it takes them; times r on a stand-in
    interaction                   F(L) - F(0) - the linear parts
    whole                         F(L) + the nonlinear parts - F(0): the sum of all these

and what is still to be added to the scene's own finite elements is F(0) + whole - F(scene).
"""

from dataclasses import dataclass
from functools import reduce
from operator import add
from typing import Protocol

import numpy as np

from comparisons.assessment.effects.quantities_of_interest import QuantitiesOfInterest
from comparisons.assessment.effects.selection import NONLINEAR, Choice
from comparisons.assessment.effects.variants import Body, strain_share
from comparisons.models.problem import Problem

COUPLED = "normal_tangential_coupling"


@dataclass(frozen=True)
class EffectContributions:
    """At one friction coefficient, on one level.

    effects      by name, as far as they apply at this friction
    interaction  of the linear effects
    lacking      what the scene's own finite elements lack of the whole
    own          the scene's own finite elements
    """

    effects: dict[str, QuantitiesOfInterest]
    interaction: QuantitiesOfInterest
    lacking: QuantitiesOfInterest
    own: QuantitiesOfInterest


class Bodies(Protocol):
    """Who answers."""

    def own_answer(self, number: int, friction: float) -> QuantitiesOfInterest:
        """Of the scene's own finite elements on a level."""

    def answer(self, body: Body, number: int, friction: float) -> QuantitiesOfInterest:
        """Of a body on a level."""


class _Listed:
    """Nothing but a list of who is asked."""

    def __init__(self) -> None:
        self.asked: dict[Body, None] = {}

    def own_answer(self, number: int, friction: float) -> QuantitiesOfInterest:
        return QuantitiesOfInterest({}, np.zeros(0), None)

    def answer(self, body: Body, number: int, friction: float) -> QuantitiesOfInterest:
        self.asked[body] = None
        return self.own_answer(number, friction)


def bodies_for(problem: Problem, choice: Choice) -> list[Body]:
    """The bodies that `parts_of` asks at all friction coefficients, each once, on any level."""
    listed = _Listed()
    for friction in problem.scene.friction:
        parts_of(problem, listed, choice, friction, 1)
    return list(listed.asked)


def parts_of(
    problem: Problem, bodies: Bodies, choice: Choice, friction: float, level: int
) -> EffectContributions:
    """All parts on a level; raises what `bodies` raises where a body has no answer."""
    whole = choice.whole - ({COUPLED} if friction == 0.0 else frozenset())
    linear = frozenset(name for name in whole if name not in NONLINEAR)
    nothing = _solved(bodies, frozenset(), friction, level)
    together = _solved(bodies, linear, friction, level)
    effects = {
        name: _solved(bodies, frozenset({name}), friction, level) - nothing
        for name in sorted(linear)
    }
    interaction = reduce(lambda left, part: left - part, effects.values(), together - nothing)
    nonlinear = {
        name: _nonlinear(problem, bodies, choice, linear, name, friction, level)
        for name in NONLINEAR
        if name in whole
    }
    own = bodies.own_answer(level, friction)
    lacking = reduce(add, nonlinear.values(), together) - own
    return EffectContributions(effects | nonlinear, interaction, lacking, own)


def _solved(
    bodies: Bodies, effects: frozenset[str], friction: float, level: int
) -> QuantitiesOfInterest:
    shaping = friction if COUPLED in effects and friction else None
    return bodies.answer(Body(effects, shaping), level, friction)


def _nonlinear(
    problem: Problem,
    bodies: Bodies,
    choice: Choice,
    linear: frozenset[str],
    name: str,
    friction: float,
    level: int,
) -> QuantitiesOfInterest:
    """What the nonlinear effect adds to linear bodies that have what it cannot be without."""
    if name == "plastic_flow":  # the scene's own: nothing else has a yield stress
        beside = (choice.contained & linear) | ({COUPLED} if friction else frozenset())
        shaping = friction or None
        flowing = bodies.answer(Body(beside | {name}, shaping), level, friction)
        return flowing - bodies.answer(Body(beside, shaping), level, friction)
    scene = problem.scene
    beside = linear | {"deformed_gap"}
    beside |= {"rough_boundary"} if scene.profile is not None else frozenset()
    beside |= {COUPLED} if friction else frozenset()
    settings = scene.finite_element
    held = settings.far_field != "held" or settings.element != "P2"
    stand_in = scene.roller is not None
    # where nothing else asks for the same body, for no other friction coefficient either
    shaping = friction if friction or held or stand_in else None
    if stand_in:  # of unbounded bodies: a layer's compliance does not grow with the roller's
        beside -= {"finite_size", "finite_roller"}
    strained = Body(beside | {name}, shaping, stand_in, held)
    small = Body(beside, shaping, stand_in, held)
    change = bodies.answer(strained, level, friction) - bodies.answer(small, level, friction)
    return change * strain_share(problem)
