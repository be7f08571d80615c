"""A scene of the user's on a map: where it lies, and in what it differs from the map's own.

A map is of one scene with values of two groups: rigid rollers, one wave in place of a trace. The
error of another scene with the same values is a guide alone."""

from typing import TYPE_CHECKING

from analytic.contact.problem import ContactError
from comparisons.common.errors import InputError
from comparisons.figures.quantity import MODELS, QUANTITIES
from comparisons.grid.groups import GROUPS
from comparisons.models.posing import problem_of
from comparisons.models.problem import Problem
from comparisons.runs.run import posed
from comparisons.scenes.scene import Origin, Scene
from comparisons.scenes.surface import surface_of
from fem.solver.mumps import FemError
from meshes.block import MeshError

if TYPE_CHECKING:
    from comparisons.grid.map_picture import Mark

RATIO, NU, COATING, CURVATURE = "roller's modulus", "Poisson's ratio", "coating's ratio", "a/R"
LIKE = {RATIO: 0.01, NU: 0.02, COATING: 0.02, CURVATURE: 0.2}  # relative, of what counts as one
GROUP_OF = {NU: "poissons_ratio", RATIO: "modulus_ratio", "friction": "friction_dundurs"}
GROUP_OF |= {"width": "a_over_width"}


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
    """Differences of a scene that `mark_of` takes from the map's, its groups apart, or nothing."""
    its, maps = traits(problem), traits(problem_of(Scene.of(content["scene"], Origin("map"))))
    grouped = {GROUP_OF.get(name): name for name in its}
    for axis in "xy":
        its.pop(grouped.get(content[axis]["group"]), None)
    if content["finite_element"].get("deformation") != "finite":
        del its["law of elasticity"]
    differ = []
    for name, value in its.items():
        wanted, both = maps[name], (value, maps[name])
        numbers = all(isinstance(one, float) for one in both)
        if abs(value - wanted) > LIKE[name] * wanted if numbers else value != wanted:
            words = (f"{one:.2g}" if isinstance(one, float) else one for one in both)
            differ.append(f"{name} is {', not '.join(words)}")
    return "; ".join(differ)


def traits(problem: Problem) -> dict[str, float | str]:
    """Traits that all points of a map have in common, and another scene need not. The roller's
    modulus is over the body's, the coating's ratio Poisson's."""
    scene, body = problem.scene, problem.scene.body
    stresses = any(QUANTITIES[name].needs_stress for name in scene.tolerances)
    rough = scene.profile is not None
    return {
        RATIO: "infinite" if scene.roller.rigid else GROUPS["modulus_ratio"].value_of(problem),
        NU: body.poissons_ratio,
        COATING: "none" if scene.coating is None else scene.coating.poissons_ratio,
        "friction": "some" if stresses and any(scene.load.friction) else "none",
        "width": "infinite" if body.width is None else "finite",
        "base": body.base or "bonded",
        "flow": "plastic" if scene.finite_element.plastic else "none",
        "law of elasticity": body.law or "neo-hookean",
        "profile": scene.profile.kind if rough else "none",
        CURVATURE: GROUPS["a_over_radius"].value_of(problem) if rough else "any",
    }
