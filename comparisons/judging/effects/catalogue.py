"""The half-plane's assumptions, each as an effect that finite elements may contain.

An effect is one entry of EFFECTS: how a scene is given it, and how much it may change. A scene is
reduced to what the half-plane assumes and given any effects (`with_effects`): so each is
measured alone, and all are computed that may matter. Finite deformation is one effect: at finite
strain the gap is on the deformed surface and the trace is the boundary."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from operator import attrgetter

from comparisons.figures.figure import SHARED
from comparisons.judging.effects.estimates import (
    Shown,
    Sizes,
    coating,
    coupling,
    exact_circle,
    finite_deformation,
    finite_roller,
    finite_size,
    law_of_elasticity,
    plastic_flow,
    roller_support,
    why_no_flow,
)
from comparisons.judging.effects.laws import OpenLaw
from comparisons.models.model import Model
from comparisons.models.problem import COUPLED, Problem
from comparisons.scenes.finite_element import FiniteElementSection
from comparisons.scenes.scene import Scene
from comparisons.scenes.sections import MurnaghanSection

STRAINED = "P2"  # elements of finite deformation
FINITE, FLOW = "finite_strain", "plastic_flow"
LAW, SAMPLING = "law_of_elasticity", SHARED
SMALL_STRAINS = "flow is taken at small strains"
ITS_OWN_LAW = "a body that flows has Hencky's law of elasticity"
# What an unbounded body is held beyond where the scene's is finite, so that it has less of the
# effect: of tau1, which goes with 1/D, a twentieth; of pressures under a disc, with 1/D^2, as much.
BEYOND_BODY, BEYOND_ROLLER = 20.0, 4.5


@dataclass(frozen=True)
class Effect:
    """One assumption that is dropped."""

    label: str  # short name for tables
    words: str  # what replaces the assumption, for tables
    # by quantity, how much it may change; nothing where it cannot
    estimate: Callable[[Problem, Shown], Sizes] = lambda problem, shown: {}
    sets: Mapping[str, object] = field(default_factory=dict)  # in [finite_element], to give it
    takes: tuple[str, ...] = ()  # parts of the scene that give it
    on_one_period: bool = False  # whether a periodic surface may have it
    is_nonlinear: bool = False
    why_not: Callable[[Problem], str | None] = lambda problem: None  # it cannot be computed
    beside_flow: str | None = None  # why it cannot be where the whole model flows
    beyond: Callable[[Scene], float] | None = None  # [m] size of an unbounded body that lacks it

    def is_in(self, scene: Scene) -> bool:
        """True if a scene's finite elements have all that gives the effect."""
        switches = {name: getattr(scene.finite_element, name) for name in self.sets}
        parts = [attrgetter(name)(scene) is not None for name in self.takes]
        return switches == self.sets if switches else any(parts)


# In the order of the sums of their contributions, whose last bit depends on it.
EFFECTS = {
    "exact_circle": Effect(
        "exact circle", "the roller's circle", exact_circle, {"roller_shape": "circle"}
    ),
    "coating": Effect("coating", "the coating", coating, {}, ("coating",), on_one_period=True),
    COUPLED: Effect(
        "normal-tangential coupling",
        "sliding traction that moves the surfaces",
        coupling,
        {"coupled": True},
    ),
    "finite_roller": Effect(
        "finite roller",
        "a roller of finite size",
        finite_roller,
        {"roller_body": "disc"},
        beyond=lambda scene: BEYOND_ROLLER * scene.roller.radius,
    ),
    "finite_size": Effect(
        "finite thickness or width",
        "the body's own thickness and width",
        finite_size,
        takes=("body.thickness", "body.width", "body.base"),
        on_one_period=True,
        beyond=lambda scene: (
            BEYOND_BODY * min(filter(None, (scene.body.thickness, scene.body.width)))
        ),
    ),
    FINITE: Effect(
        "finite deformation",
        "strains and rotations that are not small, on the deformed surface of the trace",
        finite_deformation,
        {"deformation": "finite"},
        is_nonlinear=True,
        beside_flow=SMALL_STRAINS,
    ),
    FLOW: Effect(
        "plastic flow",
        "flow in place of the cap on the pressure",
        plastic_flow,
        {"plastic": True},
        is_nonlinear=True,
        why_not=why_no_flow,
    ),
    LAW: Effect(  # no switch gives another one
        "law of elasticity",
        "another law of finite strain with the same constants",
        law_of_elasticity,
        beside_flow=ITS_OWN_LAW,
    ),
    "roller_support": Effect(  # not known where the scene gives none
        "roller's support",
        "another support of the roller, from opposite the contact to a hub of half its radius",
        roller_support,
        why_not=lambda problem: (
            "no support is given: a sector of the disc is held at 0.4 of its radius"
        ),
    ),
    SAMPLING: Effect(  # no model knows more of the surface
        "sampling of the trace",
        "the surface between the samples, by what leaving out every other one changes",
    ),
}
NONLINEAR = frozenset(name for name, effect in EFFECTS.items() if effect.is_nonlinear)
# What a scene does not say: no finite elements have another one.
UNKNOWN = tuple(name for name, effect in EFFECTS.items() if not (effect.sets or effect.takes))


def estimates(problem: Problem, shown: Shown) -> dict[str, Sizes]:
    """Estimates by effect and quantity, without those of no size; infinite where unbounded."""
    sized = {}
    for name, effect in EFFECTS.items():
        sizes = effect.estimate(problem, shown)
        if sizes := {quantity: size for quantity, size in sizes.items() if size > 0.0}:
            sized[name] = sizes
    return sized


def why_not(name: str, problem: Problem, flows: bool = False) -> str | None:
    """Why an effect cannot be computed in a scene, or None; `flows`: the whole model does."""
    effect = EFFECTS[name]
    if problem.scene.periodic and not effect.on_one_period:
        return "the bodies of a periodic surface are linear, its roughness is in the gap"
    return (flows and effect.beside_flow) or effect.why_not(problem)


def contained(scene: Scene) -> frozenset[str]:
    """Names of the effects that the scene's own finite elements have, and its half-plane has
    not."""
    bare = with_effects(scene, ())
    return frozenset(n for n, effect in EFFECTS.items() if effect.is_in(scene) > effect.is_in(bare))


def is_taken_apart(scene: Scene) -> bool:
    """Whether the scene's finite elements are the plain ones with effects, and nothing else."""
    return with_effects(scene, contained(scene)).tables == scene.tables


def with_effects(scene: Scene, names: Iterable[str]) -> Scene:
    """The scene with the named effects and no others; without any as the half-plane assumes it."""
    return scene.unchecked(fields_with(scene, names))


def fields_with(scene: Scene, names: Iterable[str]) -> dict[str, object]:
    """Fields that give a scene the named effects and no others."""
    switches = {name for effect in EFFECTS.values() for name in effect.sets}
    sets = {name: FiniteElementSection.model_fields[name].default for name in switches}
    sets |= {"coupled": scene.load.coupled}
    sets |= {"plastic": False} if scene.finite_element.plastic is False else {}
    fields = dict.fromkeys(name for effect in EFFECTS.values() for name in effect.takes)
    fields |= {f"finite_element.{name}": value for name, value in sets.items()}
    for name, effect in EFFECTS.items():
        if name in names:
            fields |= {f"finite_element.{switch}": value for switch, value in effect.sets.items()}
            fields |= {field: attrgetter(field)(scene) for field in effect.takes}
    return fields


def model_with(
    problem: Problem,
    effects: frozenset[str],
    friction: float | None = None,
    quadratic: bool = False,
) -> Model:
    """Model with the effects and no others. An unbounded body is larger than the scene's, whose
    size it lacks.

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
    """Whole models with each probe, by index in `laws` and the probe's name."""
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
