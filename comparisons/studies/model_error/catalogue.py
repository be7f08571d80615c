"""The half-plane's assumptions, each as an effect that finite elements may contain.

A new finite-element effect gets its entry in effects.toml, an estimate in `estimates`, and its
place in the sums of `selection`. A scene is reduced to what the half-plane assumes (`plain`) and
given any effects (`with_effects`): so each is measured alone. What makes finite deformation is one
effect: at finite strain the gap is on the deformed surface and the boundary is rough. Its parts by
themselves are linear bodies that have one of them without the others, with largest stresses on the
flanks of asperities that do not flatten; no model error is put together of these."""

import tomllib
from collections.abc import Iterable
from dataclasses import dataclass, field
from operator import attrgetter
from pathlib import Path

from comparisons.models.nearest_operator import is_layered
from comparisons.models.problem import Problem
from comparisons.scenes.scene import Scene


@dataclass(frozen=True)
class Effect:
    """One assumption that is dropped, as effects.toml describes it."""

    label: str
    words: str
    sets: dict[str, object] = field(default_factory=dict)
    takes: tuple[str, ...] = ()
    needs: tuple[str, ...] = ()

    def contained(self, scene: Scene) -> bool:
        """Whether a scene's finite elements have it, and its half-plane has not."""
        if "coupled" in self.sets and scene.load.coupled:
            return False
        switches = {name: getattr(scene.finite_element, name) for name in self.sets}
        return switches == self.sets if switches else _any_of(scene, self.takes)

    def applies(self, problem: Problem) -> bool:
        """Whether it could differ from the half-plane at all in a scene."""
        scene = problem.scene
        if "coupled" in self.sets:
            moves = problem.dundurs_beta != 0.0 or is_layered(scene)
            return moves and any(scene.load.friction) and not scene.load.coupled
        return not self.needs or _any_of(scene, self.needs)

    def give(self, scene: Scene, whole: Scene) -> Scene:
        """A plainer scene with what `whole` has of it."""
        sets = {f"finite_element.{name}": value for name, value in self.sets.items()}
        return scene.unchecked(sets | {name: attrgetter(name)(whole) for name in self.takes})


def _any_of(scene: Scene, parts: Iterable[str]) -> bool:
    return any(attrgetter(name)(scene) is not None for name in parts)


_TABLE = tomllib.loads(Path(__file__).with_name("effects.toml").read_text(encoding="utf-8"))
EFFECTS = {name: Effect(**described) for name, described in _TABLE.items()}
# What a scene does not say: no finite elements have another one.
UNKNOWN = tuple(name for name, effect in EFFECTS.items() if not (effect.sets or effect.takes))

# What finite deformation contains in any scene, and with a profile.
IN_FINITE_STRAIN = "deformed_gap"
PLAIN = {
    "finite_element.geometry": "flat",
    "finite_element.gap": "reference",
    "finite_element.roller_shape": "parabola",
    "finite_element.roller_body": "half-plane",
    "finite_element.deformation": "linear",
    "finite_element.plastic": False,
}
COUPLED = "normal_tangential_coupling"
KINEMATIC = ("deformed_gap", "rough_boundary", "finite_strain")


def kinematic(scene: Scene) -> frozenset[str]:
    """The effects of a scene that are finite deformation together."""
    return frozenset(KINEMATIC if scene.profile is not None else ("deformed_gap", "finite_strain"))


def contained(scene: Scene) -> frozenset[str]:
    """Names of the effects that the scene's own finite elements have."""
    names = {name for name, effect in EFFECTS.items() if effect.contained(scene)}
    return frozenset(names | ({IN_FINITE_STRAIN} if "finite_strain" in names else set()))


def is_taken_apart(scene: Scene) -> bool:
    """Whether the scene's finite elements are the plain ones with effects, and nothing else."""
    plain = scene
    if scene.finite_element.deformation == "finite":
        plain = EFFECTS[IN_FINITE_STRAIN].give(scene, scene)
    return with_effects(scene, contained(scene)).tables == plain.tables


def plain(scene: Scene) -> Scene:
    """The scene as the half-plane assumes it."""
    bare = dict.fromkeys(("body.thickness", "body.width", "body.base", "coating"))
    coupled = {"finite_element.coupled": scene.load.coupled}
    return scene.unchecked(PLAIN | bare | coupled)


def with_effects(scene: Scene, names: Iterable[str]) -> Scene:
    """The scene with the named effects and no others."""
    made = plain(scene)
    for name in EFFECTS:
        if name in names:
            made = EFFECTS[name].give(made, scene)
    return made
