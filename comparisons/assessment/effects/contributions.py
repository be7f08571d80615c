"""What each effect contributes, alone and jointly, on each level: differences of solutions.

With F(S) the finite elements' solution with the effects S, L the linear effects, 0 none of them:

    a linear effect i      F({i}) - F(0)
    a nonlinear effect n   F(L + n) - F(L), beside what n cannot be without; times r on a stand-in
    interaction            F(L) - F(0) - the linear contributions
    whole                  F(L) + the nonlinear contributions - F(0): the sum of all these

The scene's own finite elements do not contain F(0) + whole - F(scene).
"""

from dataclasses import dataclass
from functools import reduce
from operator import add, sub
from typing import Protocol

import numpy as np

from comparisons.assessment.effects.quantities_of_interest import QuantitiesOfInterest
from comparisons.assessment.effects.selection import LINEAR, NONLINEAR, EffectSelection
from comparisons.assessment.effects.variants import ModelVariant, strain_share
from comparisons.models.problem import Problem

COUPLED = "normal_tangential_coupling"


@dataclass(frozen=True)
class EffectContributions:
    """At one friction coefficient, on one level.

    effects        by name, as far as they apply at this friction
    interaction    of the linear effects
    not_contained  what the scene's own finite elements lack of the whole
    own            the scene's own finite elements
    """

    effects: dict[str, QuantitiesOfInterest]
    interaction: QuantitiesOfInterest
    not_contained: QuantitiesOfInterest
    own: QuantitiesOfInterest


class VariantSolutions(Protocol):
    """Solutions by variant, number of the level from 1, and friction coefficient."""

    def scene_solution(self, number: int, friction: float) -> QuantitiesOfInterest:
        """Of the scene's own finite elements."""

    def solution(self, variant: ModelVariant, number: int, friction: float) -> QuantitiesOfInterest:
        """Of a variant."""


class _RequestedVariants:
    """Notes which variants are asked for, and solves none."""

    def __init__(self) -> None:
        self.asked: dict[ModelVariant, None] = {}

    def scene_solution(self, number: int, friction: float) -> QuantitiesOfInterest:
        return QuantitiesOfInterest({}, np.zeros(0), None)

    def solution(self, variant: ModelVariant, number: int, friction: float) -> QuantitiesOfInterest:
        self.asked[variant] = None
        return self.scene_solution(number, friction)


def variants_for(problem: Problem, selection: EffectSelection) -> list[ModelVariant]:
    """The variants that `contributions_of` needs at all friction coefficients, each once; the same
    on every level."""
    requested = _RequestedVariants()
    for friction in problem.scene.friction:
        contributions_of(problem, requested, selection, friction, 1)
    return list(requested.asked)


def contributions_of(
    problem: Problem,
    solutions: VariantSolutions,
    selection: EffectSelection,
    friction: float,
    level: int,
) -> EffectContributions:
    """All contributions on a level; raises what `solutions` raises for a variant without one."""
    whole = selection.whole - ({COUPLED} if friction == 0.0 else frozenset())
    names = [name for name in LINEAR if name in whole]
    linear = frozenset(names)

    def solved(effects: frozenset[str]) -> QuantitiesOfInterest:
        shaping = friction if COUPLED in effects else None
        return solutions.solution(ModelVariant(effects, shaping), level, friction)

    nothing, jointly = solved(frozenset()), solved(linear)
    effects = {name: solved(frozenset({name})) - nothing for name in names}
    interaction = reduce(sub, effects.values(), jointly - nothing)
    nonlinear = {}
    for name in NONLINEAR:
        if name in whole:
            add_to = _flow if name == "plastic_flow" else _strain
            with_it, without, share = add_to(problem, selection, linear, friction)
            pair = (solutions.solution(each, level, friction) for each in (with_it, without))
            change = sub(*pair)
            nonlinear[name] = change if share is None else change * share
    own = solutions.scene_solution(level, friction)
    not_contained = reduce(add, nonlinear.values(), jointly) - own
    return EffectContributions(effects | nonlinear, interaction, not_contained, own)


_Pair = tuple[ModelVariant, ModelVariant, float | None]


def _flow(
    problem: Problem, selection: EffectSelection, linear: frozenset[str], friction: float
) -> _Pair:
    """Variants with and without plastic flow, which only the scene's own body has: beside what that
    contains."""
    beside = (selection.contained & linear) | ({COUPLED} if friction else frozenset())
    shaping = friction or None
    return ModelVariant(beside | {"plastic_flow"}, shaping), ModelVariant(beside, shaping), None


def _strain(
    problem: Problem, selection: EffectSelection, linear: frozenset[str], friction: float
) -> _Pair:
    """Variants with and without finite strain, beside the linear effects that it cannot be without;
    and the share of their difference that the scene's own bodies have."""
    scene, settings = problem.scene, problem.scene.finite_element
    beside = linear | {"deformed_gap"}
    beside |= {"rough_boundary"} if scene.profile is not None else frozenset()
    beside |= {COUPLED} if friction else frozenset()
    held = settings.far_field != "held" or settings.element != "P2"
    stand_in = scene.roller is not None
    if stand_in:  # of unbounded bodies: a layer's compliance does not grow with the roller's
        beside -= {"finite_size", "finite_roller"}
    # where nothing else needs the same variant, for no other friction coefficient either
    shaping = friction if friction or held or stand_in else None
    strained = ModelVariant(beside | {"finite_strain"}, shaping, stand_in, held)
    return strained, ModelVariant(beside, shaping, stand_in, held), strain_share(problem)
