"""The finite-element problems behind an error budget: one for each set of effects, on one grid.

Where the roller is elastic, finite strain is measured on a stand-in: a rigid roller on a body of
the same combined modulus. What strain adds is of second order in each body's own displacement, so
that of two bodies it is the share

    r = E*^2 (1/E1'^2 + 1/E2'^2),   1/E* = 1/E1' + 1/E2'

of what it adds in the stand-in, which carries all displacement in one body: 1/2 for equal bodies.
Of stresses in the rough body it may be that body's share of the displacement instead, E* / E1'; and
r holds to first order. Its relative uncertainty is therefore 1 - r, or the difference of the two
shares over r where that is larger.
"""

from dataclasses import dataclass, replace

from analytic.material import Material
from comparisons.assessment.effects.catalogue import with_effects
from comparisons.models.problem import Problem
from comparisons.scenes.schema.finite_element import HELD_BLOCK

STRAINED = "P2"  # elements of finite deformation


@dataclass(frozen=True)
class ModelVariant:
    """A finite-element model of the scene with other effects.

    effects    names of those that it has
    friction   the coefficient that shapes its pressures; None: they are the same for all
    stand_in   a rigid roller in place of the elastic one
    held       far boundary and elements as finite deformation takes them
    """

    effects: frozenset[str]
    friction: float | None = None
    stand_in: bool = False
    held: bool = False

    @property
    def name(self) -> str:
        """Of its file in a cache."""
        words = sorted(effect.replace("_", "-") for effect in self.effects) or ["none"]
        words += ["held"] * self.held + ["stand-in"] * self.stand_in
        at = "" if self.friction is None else f"@{self.friction:g}"
        return f"effect-{'+'.join(words)}{at}"


def problem_with(problem: Problem, variant: ModelVariant) -> Problem:
    """The problem of a variant, on the same pressure elements."""
    scene = with_effects(problem.scene, variant.effects)
    if variant.friction is not None:
        scene = replace(scene, friction=(variant.friction,))
    if variant.stand_in:
        scene = replace(scene, roller=None, body=combined_body(problem))
    if variant.held:
        settings, block = scene.finite_element, scene.finite_element.block
        if settings.far_field == "half-plane":
            block = HELD_BLOCK
        settings = replace(settings, far_field="held", block=block, element=STRAINED)
        scene = replace(scene, finite_element=settings)
    return replace(problem, scene=scene)


def combined_body(problem: Problem) -> Material:
    """The rough body's Poisson's ratio with the combined modulus of body and roller."""
    ratio = problem.scene.body.poissons_ratio
    return Material(problem.modulus * (1.0 - ratio**2), ratio)


def strain_share(problem: Problem) -> float:
    """r: what finite strain adds in the scene's bodies over what it adds in the stand-in."""
    scene = problem.scene
    if scene.roller is None:
        return 1.0
    moduli = (scene.body.plane_strain_modulus, scene.roller.plane_strain_modulus)
    return problem.modulus**2 * sum(1.0 / modulus**2 for modulus in moduli)


def strain_share_uncertainty(problem: Problem) -> float:
    """Of r, relative to it; 0 where the roller is rigid."""
    if problem.scene.roller is None:
        return 0.0
    share = strain_share(problem)
    displacement = problem.modulus / problem.scene.body.plane_strain_modulus
    return max(1.0 - share, abs(share - displacement) / share)
