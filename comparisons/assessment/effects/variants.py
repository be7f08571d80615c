"""The finite-element problems behind a budget: one for each set of effects, on the same pressures.

Where the roller is elastic, finite strain is measured on a stand-in: a rigid roller on a body of
the same combined modulus. What strain adds is of second order in each body's own displacement, so
that of two bodies it is the share

    r = E*^2 (1/E1'^2 + 1/E2'^2),   1/E* = 1/E1' + 1/E2'

of what it adds in the stand-in, which carries all displacement in one body: 1/2 for like ones. Of
stresses, which are the rough body's own, it may be that body's share of the displacement instead,
E* / E1'; and r holds to first order. So it is believed to 1 - r of itself, or to the difference of
the two shares.
"""

from dataclasses import dataclass, replace

from analytic.material import Material
from comparisons.assessment.effects.catalogue import with_effects
from comparisons.models.problem import Problem
from comparisons.scenes.schema.finite_element import HELD_BLOCK

STRAINED = "P2"  # elements that finite deformation is solved by


@dataclass(frozen=True)
class Body:
    """What to solve.

    effects    names
    friction   the coefficient that shapes its pressures; None: they are the same for all
    stand_in   with the rigid roller in place of the elastic one
    held       far boundary and elements as finite deformation takes them
    """

    effects: frozenset[str]
    friction: float | None = None
    stand_in: bool = False
    held: bool = False

    @property
    def name(self) -> str:
        """Of files, one to a body."""
        words = sorted(effect.replace("_", "-") for effect in self.effects) or ["none"]
        words += ["held"] * self.held + ["stand-in"] * self.stand_in
        return (
            "effect-" + "+".join(words) + ("" if self.friction is None else f"@{self.friction:g}")
        )


def problem_with(problem: Problem, body: Body) -> Problem:
    """The scene's problem with a body's effects, on the same grids of pressures."""
    scene = with_effects(problem.scene, body.effects)
    if body.friction is not None:
        scene = replace(scene, friction=(body.friction,))
    if body.stand_in:
        scene = replace(scene, roller=None, body=combined_body(problem))
    if body.held:
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
    """r: of what finite strain adds in the stand-in, what it adds in the scene's two bodies."""
    scene = problem.scene
    if scene.roller is None:
        return 1.0
    moduli = (scene.body.plane_strain_modulus, scene.roller.plane_strain_modulus)
    return problem.modulus**2 * sum(1.0 / modulus**2 for modulus in moduli)


def strain_doubt(problem: Problem) -> float:
    """How far r may be off, relative to it; 0 where the scene is its own stand-in."""
    if problem.scene.roller is None:
        return 0.0
    share = strain_share(problem)
    displacement = problem.modulus / problem.scene.body.plane_strain_modulus
    return max(1.0 - share, abs(share - displacement) / share)
