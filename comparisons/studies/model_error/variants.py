"""The finite-element problems behind an error budget: one for each set of effects, on one grid."""

from dataclasses import dataclass, replace

from comparisons.models.problem import Problem
from comparisons.studies.model_error.catalogue import with_effects

STRAINED = "P2"  # elements of finite deformation


@dataclass(frozen=True)
class ModelVariant:
    """A finite-element model of the scene with other effects."""

    effects: frozenset[str]  # names of those that it has
    # the coefficient that shapes its pressures; None: they are the same for all
    friction: float | None = None
    quadratic: bool = False  # its elements are those that finite deformation takes

    @property
    def name(self) -> str:
        """Of its file in a cache."""
        words = sorted(effect.replace("_", "-") for effect in self.effects) or ["none"]
        words += ["quadratic"] * self.quadratic
        at = "" if self.friction is None else f"@{self.friction:g}"
        return f"effect-{'+'.join(words)}{at}"


def problem_with(problem: Problem, variant: ModelVariant) -> Problem:
    """The problem of a variant, on the same pressure elements."""
    scene = with_effects(problem.scene, variant.effects)
    if variant.friction is not None:
        scene = scene.unchecked({"load.friction": (variant.friction,)})
    if variant.quadratic:
        scene = scene.unchecked({"finite_element.element": STRAINED})
    return replace(problem, scene=scene)
