"""Finite elements of a scene with other effects, or laws of elasticity: models on the same pressure
elements."""

from dataclasses import replace

from comparisons.judging.effects.catalogue import EFFECTS, contained, fields_with
from comparisons.judging.effects.laws import OpenLaw
from comparisons.models.model import Model
from comparisons.models.problem import Problem
from comparisons.scenes.sections import MurnaghanSection

STRAINED = "P2"  # elements of finite deformation


def model_with(
    problem: Problem,
    effects: frozenset[str],
    friction: float | None = None,
    quadratic: bool = False,
) -> Model:
    """With the effects and no others. An unbounded body is larger than the scene's, whose size it
    lacks.

    friction   the coefficient that shapes its pressures; None: they are the same for all
    quadratic  its elements are those that finite deformation takes"""
    scene, words = problem.scene, sorted(effect.replace("_", "-") for effect in effects) or ["none"]
    sets, at = fields_with(scene, effects), ""
    if friction is not None:
        sets["load.friction"], at = (friction,), f"@{friction:g}"
    if quadratic:
        sets["finite_element.element"] = STRAINED
        words.append("quadratic")
    lacking = (EFFECTS[name].beyond for name in contained(scene) - effects)
    labels = ", ".join(EFFECTS[name].label for name in sorted(effects)) or "no effect"
    return Model(
        f"effect-{'+'.join(words)}{at}",
        "finite elements",
        effects,
        label=f"with {labels}",
        sets=sets,
        least_block=max((beyond(scene) for beyond in lacking if beyond), default=0.0),
    )


def law_variants(whole: Model, laws: tuple[OpenLaw, ...]) -> dict[tuple[int, str], Model]:
    """The whole with each probe, by place in `laws` and the probe's name."""
    variants = {}
    for number, open_law in enumerate(laws):
        for probe, law in open_law.probes.items():
            named, sets = law.murnaghan and dict(zip("lmn", law.murnaghan, strict=True)), {}
            constants = named and MurnaghanSection(**named)
            for body in open_law.bodies:
                sets |= {f"{body}.law": law.name, f"{body}.murnaghan": constants}
            words = f"{whole.name}-as-{'-and-'.join(open_law.bodies)}-{'-'.join(probe.split())}"
            variants[number, probe] = replace(whole, name=words, sets=whole.sets | sets)
    return variants
