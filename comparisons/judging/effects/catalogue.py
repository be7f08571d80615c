"""The half-plane's assumptions, each as an effect that finite elements may contain.

A new finite-element effect gets its entry in effects.toml, an estimate in `estimates`, and its
place in the sums of `selection`. A scene is reduced to what the half-plane assumes (`plain`) and
given any effects (`with_effects`): so each is measured alone, a `ModelVariant` on the same pressure
elements. Finite deformation is one effect: at finite strain the gap is on the deformed surface and
the trace is the boundary."""

import tomllib
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from operator import attrgetter
from pathlib import Path

from analytic.material import Law
from comparisons.models.operators import is_layered
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

PLAIN = {
    "finite_element.roller_shape": "parabola",
    "finite_element.roller_body": "half-plane",
    "finite_element.deformation": "linear",
}
# What an unbounded body is held beyond where the scene's is finite, so that it has less of the
# effect: of tau1, which goes with 1/D, a twentieth; of pressures under a disc, with 1/D^2, as much.
BEYOND_BODY, BEYOND_ROLLER = 20.0, 4.5
STRAINED = "P2"  # elements of finite deformation


def contained(scene: Scene) -> frozenset[str]:
    """Names of the effects that the scene's own finite elements have."""
    return frozenset(name for name, effect in EFFECTS.items() if effect.contained(scene))


def is_taken_apart(scene: Scene) -> bool:
    """Whether the scene's finite elements are the plain ones with effects, and nothing else."""
    return with_effects(scene, contained(scene)).tables == scene.tables


def plain(scene: Scene) -> Scene:
    """The scene as the half-plane assumes it."""
    bare = dict.fromkeys(("body.thickness", "body.width", "body.base", "coating"))
    flow = False if scene.finite_element.plastic is False else None
    own = {"finite_element.coupled": scene.load.coupled, "finite_element.plastic": flow}
    return scene.unchecked(PLAIN | bare | own)


def with_effects(scene: Scene, names: Iterable[str]) -> Scene:
    """The scene with the named effects and no others."""
    made = plain(scene)
    for name in EFFECTS:
        if name in names:
            made = EFFECTS[name].give(made, scene)
    return made


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
        """Of its file in a cache."""
        words = sorted(effect.replace("_", "-") for effect in self.effects) or ["none"]
        words += ["quadratic"] * self.quadratic
        words += [f"as-{self.laws_name}"] * bool(self.laws)
        words += [f"increments-{self.times}"] * (self.times > 1)
        words += ["half-block"] * self.half_block
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
    return replace(problem, scene=scene, least_block=_least_block(problem.scene, variant))


def _least_block(scene: Scene, variant: ModelVariant) -> float:
    """Size [m] of an unbounded block in a variant that lacks the size of a scene's bodies."""
    lacking, sizes = contained(scene) - variant.effects, [0.0]
    if "finite_size" in lacking:
        sizes += [BEYOND_BODY * min(filter(None, (scene.body.thickness, scene.body.width)))]
    if "finite_roller" in lacking:
        sizes += [BEYOND_ROLLER * scene.roller.radius]
    return max(sizes)
