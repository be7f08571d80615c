"""The half-plane's assumptions, each as an effect that finite elements may contain.

A new finite-element effect gets its entry in effects.toml, an estimate in `estimates`, and its
place in the sums of `selection`. A scene is reduced to what the half-plane assumes (`plain`) and
given any effects (`with_effects`): so each is measured alone. What makes finite deformation is one
effect: at finite strain the gap is on the deformed surface and the boundary is rough. Its parts by
themselves are linear bodies that have one of them without the others, with largest stresses on the
flanks of asperities that do not flatten; no model error is put together of these."""

import tomllib
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from pathlib import Path

from comparisons.models.nearest_operator import is_layered
from comparisons.models.problem import Problem
from comparisons.scenes.scene import ResolvedScene


@dataclass(frozen=True)
class Effect:
    """One assumption that is dropped, as effects.toml describes it."""

    label: str
    words: str
    sets: dict[str, object] = field(default_factory=dict)
    takes: tuple[str, ...] = ()
    needs: tuple[str, ...] = ()

    def contained(self, scene: ResolvedScene) -> bool:
        """Whether a scene's finite elements have it, and its half-plane has not."""
        if "coupled" in self.sets and scene.coupled:
            return False
        given = {name: getattr(scene.finite_element, name) for name in self.sets}
        return given == self.sets if given else _any_of(scene, self.takes)

    def applies(self, problem: Problem) -> bool:
        """Whether it could differ from the half-plane at all in a scene."""
        scene = problem.scene
        if "coupled" in self.sets:
            moves = problem.dundurs_beta != 0.0 or is_layered(scene)
            return moves and any(scene.friction) and not scene.coupled
        return not self.needs or _any_of(scene, self.needs)

    def give(self, scene: ResolvedScene, whole: ResolvedScene) -> ResolvedScene:
        """A plainer scene with what `whole` has of it."""
        settings = replace(scene.finite_element, **self.sets)
        taken = {name: getattr(whole, name) for name in self.takes}
        return replace(scene, finite_element=settings, **taken)


def _any_of(scene: ResolvedScene, parts: Iterable[str]) -> bool:
    return any(getattr(scene, name) is not None for name in parts)


_TABLE = tomllib.loads(Path(__file__).with_name("effects.toml").read_text(encoding="utf-8"))
EFFECTS = {name: Effect(**described) for name, described in _TABLE.items()}

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
