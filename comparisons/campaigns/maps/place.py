"""A scene on the finished maps: about how large the half-plane's model error is, before solving.

A map is of another scene with the same values of two groups: rigid rollers, one wave in place of a
trace. `unlike` says what it differs by beside.
"""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from analytic.contact.problem import ContactError
from comparisons.campaigns.maps.content import (
    differences,
    places,
    scaled,
    uncertainties,
    unscaled,
)
from comparisons.campaigns.maps.groups import GROUPS, smooth_problem
from comparisons.campaigns.maps.map import finished_map, finished_names, misfit
from comparisons.common.errors import InputError
from comparisons.common.numbers import significant
from comparisons.common.progress import no_progress
from comparisons.figures.quantity import QUANTITIES, label
from comparisons.models.posing import problem_of
from comparisons.models.problem import Problem
from comparisons.scenes.scene import Origin, Scene
from fem.solver.mumps import FemError
from meshes.block import MeshError

SAME_RATIO = 0.01  # of Poisson's ratios that count as one
SAME_CURVATURE = 0.2  # relative, of a/R where a map has one for all its points
STRAIGHT = 0.125  # of a second difference, which a straight line is off by in the middle


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
    def words(self) -> str:
        content = finished_map(self.name)
        values = (
            f"{content[axis]['symbol']} {'=' if value == shown else '<='} {significant(shown, 2)}"
            for axis, value, shown in zip("xy", self.groups, self.shown, strict=True)
        )
        return f"by the map {self.name} ({', '.join(values)})"

    @property
    def text(self) -> str:
        errors = (f"{label(name)} {100.0 * error:+.2g} %" for name, error in self.errors.items())
        return f"{self.words}: model error about {', '.join(errors)}"


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
    errors = {name: interpolated(content, name, *shown) for name in problem.scene.tolerances}
    errors = {name: error for name, error in errors.items() if np.isfinite(error)}
    return Place(name, tuple(groups), tuple(shown), errors) if errors else None


def unlike(content: dict, problem: Problem) -> str:
    """What a scene is that the map's is not, its groups apart, or nothing: the error of another
    scene is a guide alone."""
    scene, posed = problem.scene, content["scene"]
    if why := misfit(content, scene):
        return why
    body, profile = posed["body"], posed.get("profile")
    axes = {content["x"]["group"], content["y"]["group"]}
    rigid, nu = posed["roller"].get("rigid", False), body["poissons_ratio"]
    finite = content["finite_element"].get("deformation") == "finite"
    reasons, ratio_of = {}, GROUPS["modulus_ratio"].value_of
    if scene.roller.rigid != rigid:
        reasons["roller"] = f"has {'an elastic' if rigid else 'a rigid'} roller"
    elif not rigid and abs(ratio_of(problem) / ratio_of(_smooth(content)) - 1.0) > SAME_RATIO:
        reasons["roller"] = "has a roller of another stiffness"
    if "poissons_ratio" not in axes and abs(scene.body.poissons_ratio - nu) > SAME_RATIO:
        reasons["ratio"] = f"has Poisson's ratio {scene.body.poissons_ratio:g}, not {nu:g}"
    if scene.coating is not None and "coating_over_a" not in axes:
        reasons["coating"] = "has a coating"
    elif scene.coating is not None and "coating" in posed:
        its, value = posed["coating"]["poissons_ratio"], scene.coating.poissons_ratio
        if abs(value - its) > SAME_RATIO:
            reasons["coating"] = f"has a coating of Poisson's ratio {value:g}, not {its:g}"
    stresses = any(QUANTITIES[name].needs_stress for name in scene.tolerances)
    slides = any(scene.load.friction) and not any(posed["load"]["friction"])
    if slides and stresses and "friction_dundurs" not in axes:
        reasons["friction"] = "slides"
    if scene.body.width is not None and "a_over_width" not in axes:
        reasons["width"] = "has a width of its own"
    if scene.body.base not in (None, body.get("base") or "bonded"):
        reasons["base"] = "lies on another base"
    if scene.finite_element.plastic:
        reasons["flow"] = "flows"
    if finite and scene.body.law not in (None, "neo-hookean"):
        reasons["law"] = "has another law of elasticity"
    if profile is not None:
        if scene.profile.kind != profile["kind"]:
            reasons["wave"] = f"is no {profile['kind']}"
        its, value = (GROUPS["a_over_radius"].value_of(p) for p in (_smooth(content), problem))
        if abs(value / its - 1.0) > SAME_CURVATURE:
            reasons["curvature"] = f"has a/R = {value:.2g}, not {its:.2g}"
    return ", ".join(reasons.values())


def _smooth(content: dict) -> Problem:
    """Of the map's own scene."""
    return smooth_problem(Scene.of(content["scene"], Origin("map")))


def known_to(content: dict, quantity: str, x: float, y: float) -> float:
    """Uncertainty of `interpolated`: by the largest second differences of the points around, and
    their own uncertainty; infinite where that is unknown."""
    across, up = places(content["x"]), places(content["y"])
    at = places(content["y"], y)[0], places(content["x"], x)[0]
    axes = zip((up, across), at, strict=True)
    low = (min(max(int(np.searchsorted(a, p)) - 1, 0), len(a) - 2) for a, p in axes)
    cell = tuple(slice(k, k + 2) for k in low)
    values = scaled(differences(content, quantity), content)
    unsure = uncertainties(content, quantity)
    bent = 0.0
    for along, ends in enumerate((((1, 1), (0, 0)), ((0, 0), (1, 1)))):
        second = np.pad(np.abs(np.diff(values, 2, axis=along)), ends, "edge")
        bent += second[cell].max()
    middle = scaled(interpolated(content, quantity, x, y), content)
    ends = unscaled(middle + STRAIGHT * bent * np.array([-1.0, 0.0, 1.0]), content)
    total = np.abs(np.diff(ends)).max() + unsure[cell].max()
    return float(total) if np.isfinite(total) else np.inf


def interpolated(content: dict, quantity: str, x: float, y: float) -> float:
    """Relative model error between a map's points; nan where a neighbour's is unknown."""
    across, up = content["x"], content["y"]
    values = scaled(differences(content, quantity), content)
    between = RegularGridInterpolator([places(up), places(across)], values)
    return float(unscaled(between([places(up, y)[0], places(across, x)[0]])[0], content))


def is_of_materials(content: dict) -> bool:
    """Whether a group is a property of materials, which every scene has."""
    return any(GROUPS[content[axis]["group"]].material for axis in "xy")


def places_of(problem: Problem) -> tuple[Place, ...]:
    """On as few finished maps as have all groups that the scene has, those with most first."""
    names = (name for name in finished_names() if not is_of_materials(finished_map(name)))
    known = [place for name in names if (place := place_on(name, problem))]
    known.sort(key=lambda place: -np.count_nonzero(place.groups))
    chosen: list[Place] = []
    covered: set[str] = set()
    for place in known:
        content = finished_map(place.name)
        pairs = zip("xy", place.groups, strict=True)
        groups = {content[axis]["group"] for axis, value in pairs if value > 0.0}
        if groups - covered or not (groups or chosen):
            chosen.append(place)
            covered |= groups
    return tuple(chosen)
