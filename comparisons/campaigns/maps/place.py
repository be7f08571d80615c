"""A scene on the finished maps: about how large the half-plane's model error is, before solving.

A map is of another scene with the same values of two groups: rigid rollers, one wave in place of a
trace. Where a scene lies on no map, the estimates say what each effect may do at most.
"""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from analytic.contact.problem import ContactError
from comparisons.campaigns.maps.content import differences, places, scaled, unscaled
from comparisons.campaigns.maps.groups import GROUPS, STUDIES
from comparisons.campaigns.maps.map import finished_map, finished_names, misfit
from comparisons.common.errors import InputError
from comparisons.common.numbers import significant
from comparisons.common.progress import Stages, no_progress
from comparisons.figures.quantity import QUANTITIES, label
from comparisons.models.half_plane import half_plane_level
from comparisons.models.problem import Problem, problem_of
from comparisons.scenes.scene import Scene
from comparisons.studies.model_error.catalogue import EFFECTS, UNKNOWN
from comparisons.studies.model_error.laws import EFFECT as LAW
from comparisons.studies.model_error.selection import select_effects
from fem.solver.mumps import FemError
from meshes.block import MeshError


@dataclass(frozen=True)
class Place:
    """Where a scene lies on a map."""

    name: str  # of the finished map
    groups: tuple[float, float]  # (x, y) the scene's values of its groups
    # (x, y) the same, but the map's first value where an effect is smaller than on the map
    shown: tuple[float, float]
    # by quantity: relative model error, straight between the map's points on its scale
    errors: dict[str, float]

    @property
    def text(self) -> str:
        content = finished_map(self.name)
        values = (
            f"{content[axis]['symbol']} {'=' if value == shown else '<='} {significant(shown, 2)}"
            for axis, value, shown in zip("xy", self.groups, self.shown, strict=True)
        )
        errors = (f"{label(name)} {100.0 * error:+.2g} %" for name, error in self.errors.items())
        return (
            f"by the map {self.name} ({', '.join(values)}): model error about {', '.join(errors)}"
        )


def problem_named(name: str) -> Problem:
    """The problem of a scene that is to be marked, under the load of its approach where that is
    prescribed. Raises InputError where it cannot be solved."""
    scene = Scene.read(name)
    try:
        if scene.load.kind != "approach":
            return problem_of(scene)
        from comparisons.models.finite_element.level import problem_of_approach

        return problem_of_approach(scene, no_progress)
    except (ContactError, MeshError, FemError) as error:
        raise InputError(f"--mark: {scene.source}: {error}") from error


def place_on(name: str, problem: Problem) -> Place | None:
    """None where the map is of another kind of surface or does not reach so far."""
    content = finished_map(name)
    if misfit(content, problem.scene):
        return None
    groups, shown = [], []
    for axis in (content["x"], content["y"]):
        group = GROUPS[axis["group"]]
        value = group.value_of(problem)
        if value is None or value > axis["values"][-1]:
            return None
        if value < axis["values"][0] and not group.vanishes:
            return None
        groups.append(value)
        shown.append(max(value, axis["values"][0]))
    names = *problem.scene.tolerances, *(name for study in STUDIES for name in study.QUANTITIES)
    errors = {name: interpolated(content, name, *shown) for name in names}
    errors = {name: error for name, error in errors.items() if np.isfinite(error)}
    return Place(name, tuple(groups), tuple(shown), errors) if errors else None


def interpolated(content: dict, quantity: str, x: float, y: float) -> float:
    """Relative model error between a map's points; nan where a neighbour's is unknown."""
    across, up = content["x"], content["y"]
    values = scaled(differences(content, quantity))
    between = RegularGridInterpolator([places(up), places(across)], values)
    return float(unscaled(between([places(up, y)[0], places(across, x)[0]])[0]))


def places_of(problem: Problem) -> tuple[Place, ...]:
    """On as few finished maps as have all groups that the scene has, those with most first."""
    known = [place for name in finished_names() if (place := place_on(name, problem))]
    known.sort(key=lambda place: -np.count_nonzero(place.groups))
    chosen: list[Place] = []
    covered: set[tuple[bool, str]] = set()
    for place in known:
        content = finished_map(place.name)
        kind = content["quantity"] in QUANTITIES  # of the contact, or of another study
        groups = {
            (kind, content[a]["group"]) for a, v in zip("xy", place.groups, strict=True) if v > 0.0
        }
        if groups - covered or not (groups or chosen):
            chosen.append(place)
            covered |= groups
    return tuple(chosen)


def first_answer(problem: Problem) -> list[str]:
    """Lines for a user who waits: by the maps, or else by the estimates for a coarse half-plane."""
    on_maps = places_of(problem)
    beside = {
        "coating": problem.scene.coating,
        "plastic flow": problem.scene.finite_element.plastic,
    }
    off = [name for name, has in beside.items() if has]
    level = half_plane_level(problem, problem.pitches[0], None, Stages())
    effects = select_effects(problem, float(level.solution.pressure.max()), ()).estimates
    if on_maps and not off:
        law = max(effects.get(LAW, {}).values(), default=0.0)
        beyond = f"; the law of elasticity may add {100.0 * law:.2g} %" if law else ""
        return [f"{place.text}{beyond}" for place in on_maps]
    bounds = []
    counted = {e: sizes for e, sizes in effects.items() if e not in UNKNOWN or e == LAW}
    for name in problem.scene.tolerances:
        sizes = {effect: s[name] for effect, s in counted.items() if name in s}
        if sizes:
            total, most = sum(sizes.values()), max(sizes, key=sizes.get)
            bound = f"{100.0 * total:.2g} %" if total < 1.0 else "100 % or more"
            bounds.append(f"{label(name)} {bound} ({EFFECTS[most].label} most)")
    if not bounds:
        return []
    return [f"by estimates, on no finished map: model error at most about {', '.join(bounds)}"]
