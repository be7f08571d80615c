"""A scene of the user's on a map: where it lies, and what it is that the map's own is not.

A map is of one scene with values of two groups: rigid rollers, one wave in place of a trace. The
error of another scene with the same values is a guide alone."""

from typing import TYPE_CHECKING

from analytic.contact.problem import ContactError
from comparisons.common.errors import InputError
from comparisons.figures.quantity import MODELS, QUANTITIES
from comparisons.grid.groups import GROUPS, smooth_problem
from comparisons.models.problem import Problem
from comparisons.runs.run import posed
from comparisons.scenes.scene import Origin, Scene
from comparisons.scenes.surface import surface_of
from fem.solver.mumps import FemError
from meshes.block import MeshError

if TYPE_CHECKING:
    from comparisons.grid.map_picture import Mark

SAME_RATIO = 0.01  # of Poisson's ratios that count as one
SAME_CURVATURE = 0.2  # relative, of a/R where a map has one for all its points


def problem_named(name: str) -> Problem:
    """The problem of a scene that is to be marked, under the load of its approach where that is
    prescribed. Raises InputError where it cannot be solved."""
    scene = Scene.read(name)
    try:
        return posed(scene, surface_of(scene), MODELS)[0]
    except (ContactError, MeshError, FemError) as error:
        raise InputError(f"--mark: {scene.source}: {error}") from error


def mark_of(content: dict, problem: Problem) -> "Mark":
    """A scene's name and its values of a map's groups, for the map's picture. Raises InputError
    where a group has no value for a scene, or one off the map, or one of both is rough and the
    other smooth."""
    profiles = problem.scene.profile, content["scene"].get("profile")
    kinds = ["smooth" if profile is None else "rough" for profile in profiles]
    if kinds[0] != kinds[1]:
        raise InputError(
            f"--mark: {problem.scene.name} is {kinds[0]}, and the map is of a {kinds[1]} surface; "
            "allowed is a scene of its kind"
        )
    values = []
    for axis in (content["x"], content["y"]):
        name, (low, *_, high) = axis["group"], axis["values"]
        value = GROUPS[name].value_of(problem)
        if value is None:
            raise InputError(f"--mark: {problem.scene.name} has no {name} to be marked at")
        if not low <= value <= high:
            raise InputError(
                f"--mark: {problem.scene.name} lies off the map: its {axis['symbol']} is "
                f"{value:.2g}; allowed is {low:g} to {high:g}"
            )
        values.append(value)
    return problem.scene.name, (values[0], values[1])


def unlike(content: dict, problem: Problem) -> str:
    """What a scene that `mark_of` takes is and the map's is not, its groups apart, or nothing."""
    scene, posed = problem.scene, content["scene"]
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
