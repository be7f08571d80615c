"""The half-plane's assumptions, each as an effect that finite elements may contain.

A new finite-element effect gets its entry in EFFECTS, an estimate in `estimates`, and its place in
the sums of `selection`. A scene is reduced to what the half-plane assumes (`plain`) and given any
effects (`with_effects`): so each is measured alone. What makes finite deformation is one effect: at
finite strain the gap is on the deformed surface and the boundary is rough. Its parts by themselves
are linear bodies that have one of them without the others, with largest stresses on the flanks of
asperities that do not flatten; no model error is put together of these.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

from comparisons.models.nearest_operator import is_layered
from comparisons.models.problem import Problem
from comparisons.scenes.scene import ResolvedScene


@dataclass(frozen=True)
class Effect:
    """One assumption that is dropped."""

    label: str  # short name for tables
    words: str  # what replaces the assumption, for tables
    contained: Callable[[ResolvedScene], bool]  # whether a scene's finite elements have it
    # whether it could differ from the half-plane at all in a scene
    applies: Callable[[Problem], bool]
    # puts what `whole` has of it into a plainer scene
    give: Callable[[ResolvedScene, ResolvedScene], ResolvedScene]


def _with(scene: ResolvedScene, **setting: object) -> ResolvedScene:
    return replace(scene, finite_element=replace(scene.finite_element, **setting))


def _switch(
    label: str,
    words: str,
    applies: Callable[[Problem], bool] = lambda problem: True,
    **setting: object,
) -> Effect:
    """An effect that is one field of the scene's [finite_element], at this value."""
    [(field, value)] = setting.items()
    return Effect(
        label,
        words,
        lambda scene: getattr(scene.finite_element, field) == value,
        applies,
        lambda scene, whole: _with(scene, **setting),
    )


def _bounded(scene: ResolvedScene) -> bool:
    return scene.thickness is not None or scene.width is not None


def _couples(problem: Problem) -> bool:
    scene = problem.scene
    moves = problem.dundurs_beta != 0.0 or is_layered(scene)
    return moves and any(scene.friction) and not scene.coupled


EFFECTS: dict[str, Effect] = {
    "finite_size": Effect(
        "finite thickness or width",
        "the body's own thickness and width",
        _bounded,
        lambda problem: _bounded(problem.scene),
        lambda scene, whole: replace(
            scene, thickness=whole.thickness, width=whole.width, base=whole.base
        ),
    ),
    "coating": Effect(
        "coating",
        "the coating",
        lambda scene: scene.coating is not None,
        lambda problem: problem.scene.coating is not None,
        lambda scene, whole: replace(scene, coating=whole.coating),
    ),
    "rough_boundary": _switch(
        "rough boundary",
        "the trace as boundary",
        lambda problem: problem.scene.profile is not None,
        geometry="rough",
    ),
    "deformed_gap": _switch(
        "deformed gap",
        "the gap on the deformed surface, along the roller's normal",
        gap="displaced",
    ),
    "exact_circle": _switch("exact circle", "the roller's circle", roller_shape="circle"),
    "finite_roller": _switch(
        "finite roller",
        "a roller of finite size",
        lambda problem: problem.scene.roller is not None,
        roller_body="disc",
    ),
    "normal_tangential_coupling": Effect(
        "normal-tangential coupling",
        "sliding traction that moves the surfaces",
        lambda scene: scene.finite_element.coupled and not scene.coupled,
        _couples,
        lambda scene, whole: _with(scene, coupled=True),
    ),
    "finite_strain": _switch(
        "finite deformation",
        "strains and rotations that are not small, on the deformed surface of the trace",
        deformation="finite",
    ),
    "law_of_elasticity": Effect(
        "law of elasticity",
        "another law of finite strain with the same constants",
        lambda scene: False,
        lambda problem: True,
        lambda scene, whole: scene,
    ),
    "plastic_flow": Effect(
        "plastic flow",
        "flow in place of the cap on the pressure",
        lambda scene: scene.finite_element.plastic,
        lambda problem: problem.scene.hardness is not None or problem.scene.yielding is not None,
        lambda scene, whole: _with(scene, plastic=True),
    ),
}

# What finite deformation contains in any scene, and with a profile.
IN_FINITE_STRAIN = "deformed_gap"
COUPLED = "normal_tangential_coupling"
KINEMATIC = ("deformed_gap", "rough_boundary", "finite_strain")


def kinematic(scene: ResolvedScene) -> frozenset[str]:
    """The effects of a scene that are finite deformation together."""
    return frozenset(KINEMATIC if scene.profile is not None else ("deformed_gap", "finite_strain"))


def contained(scene: ResolvedScene) -> frozenset[str]:
    """Names of the effects that the scene's own finite elements have."""
    names = {name for name, effect in EFFECTS.items() if effect.contained(scene)}
    return frozenset(names | ({IN_FINITE_STRAIN} if "finite_strain" in names else set()))


def is_taken_apart(scene: ResolvedScene) -> bool:
    """Whether the scene's finite elements are the plain ones with effects, and nothing else."""
    own = scene
    if scene.finite_element.deformation == "finite":
        own = EFFECTS[IN_FINITE_STRAIN].give(scene, scene)
    return with_effects(scene, contained(scene)) == own


def plain(scene: ResolvedScene) -> ResolvedScene:
    """The scene as the half-plane assumes it."""
    settings = replace(
        scene.finite_element,
        geometry="flat",
        gap="reference",
        roller_shape="parabola",
        roller_body="half-plane",
        coupled=scene.coupled,
        deformation="linear",
        plastic=False,
    )
    bare = dict.fromkeys(("thickness", "width", "base", "coating"))
    return replace(scene, **bare, finite_element=settings)


def with_effects(scene: ResolvedScene, names: Iterable[str]) -> ResolvedScene:
    """The scene with the named effects and no others."""
    made = plain(scene)
    for name in EFFECTS:
        if name in names:
            made = EFFECTS[name].give(made, scene)
    return made
