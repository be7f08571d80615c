"""The finite-element problems behind an error budget: one for each set of effects, on one grid."""

from dataclasses import dataclass, replace

from analytic.material import Law
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
    laws: tuple[tuple[str, Law], ...] = ()  # by body, in place of the scene's own
    laws_name: str = ""  # what these stand for
    times: int = 1  # as long increments of flow

    @property
    def name(self) -> str:
        """Of its file in a cache."""
        words = sorted(effect.replace("_", "-") for effect in self.effects) or ["none"]
        words += ["quadratic"] * self.quadratic
        words += [f"as-{self.laws_name}"] * bool(self.laws)
        words += [f"increments-{self.times}"] * (self.times > 1)
        at = "" if self.friction is None else f"@{self.friction:g}"
        return f"effect-{'+'.join(words)}{at}"


def problem_with(problem: Problem, variant: ModelVariant) -> Problem:
    """The problem of a variant, on the same pressure elements."""
    scene = with_effects(problem.scene, variant.effects)
    if variant.friction is not None:
        scene = scene.unchecked({"load.friction": (variant.friction,)})
    if variant.quadratic:
        scene = scene.unchecked({"finite_element.element": STRAINED})
    for body, law in variant.laws:
        constants = law.murnaghan and dict(zip("lmn", law.murnaghan, strict=True))
        scene = scene.unchecked({f"{body}.law": law.name, f"{body}.murnaghan": constants})
    return replace(problem, scene=scene)
