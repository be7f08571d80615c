"""Finite-element models of a scene with other effects, laws of elasticity or increments: each is a
`ModelVariant`, on the same pressure elements."""

from dataclasses import dataclass, replace

from analytic.material import Law
from comparisons.judging.effects.catalogue import EFFECTS, contained, with_effects
from comparisons.judging.effects.laws import OpenLaw
from comparisons.models.problem import Problem
from comparisons.scenes.sections import MurnaghanSection

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
    half_block: bool = False  # the far boundary of an unbounded body is at half the distance

    @property
    def name(self) -> str:
        """Of its levels among the tasks of a run, beside what these check."""
        words = sorted(effect.replace("_", "-") for effect in self.effects) or ["none"]
        words += ["quadratic"] * self.quadratic
        words += [f"as-{self.laws_name}"] * bool(self.laws)
        at = "" if self.friction is None else f"@{self.friction:g}"
        return f"effect-{'+'.join(words)}{at}"


def problem_with(problem: Problem, variant: ModelVariant) -> Problem:
    """The problem of a variant, on the same pressure elements. An unbounded body in it is larger
    than the scene's, whose size the variant lacks."""
    scene = with_effects(problem.scene, variant.effects)
    if variant.friction is not None:
        scene = scene.unchecked({"load.friction": (variant.friction,)})
    if variant.quadratic:
        scene = scene.unchecked({"finite_element.element": STRAINED})
    for body, law in variant.laws:
        named = law.murnaghan and dict(zip("lmn", law.murnaghan, strict=True))
        constants = named and MurnaghanSection(**named)
        scene = scene.unchecked({f"{body}.law": law.name, f"{body}.murnaghan": constants})
    lacking = (EFFECTS[name].beyond for name in contained(problem.scene) - variant.effects)
    least = max((beyond(problem.scene) for beyond in lacking if beyond), default=0.0)
    return replace(problem, scene=scene, least_block=least)


def law_variants(
    whole: ModelVariant, laws: tuple[OpenLaw, ...]
) -> dict[tuple[int, str], ModelVariant]:
    """The whole with each probe, by place in `laws` and the probe's name."""
    return {
        (number, probe): replace(
            whole,
            laws=tuple((body, law) for body in open_law.bodies),
            laws_name=f"{'-and-'.join(open_law.bodies)}-{'-'.join(probe.split())}",
        )
        for number, open_law in enumerate(laws)
        for probe, law in open_law.probes.items()
    }
