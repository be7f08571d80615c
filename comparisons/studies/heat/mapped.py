"""Temperatures on maps of the half-plane's model error: their groups, and the error at a point.

Both models have the half-plane's pressures there: the error is the half-space's for heat alone, and
the roller a disc where the finite elements have its circle."""

from collections.abc import Mapping

from comparisons.common.errors import SceneError
from comparisons.figures.figure import Figures
from comparisons.models.level import ModelRun
from comparisons.models.problem import Problem
from comparisons.scenes.scene import Scene
from comparisons.studies.heat.half_space import HEAT_QUANTITIES, check_heat, peclet_numbers

# As `Study.mapped` has them; for GROUPS see the end.
QUANTITIES, SECTION, check = HEAT_QUANTITIES, "heat", check_heat


def errors_of(
    problem: Problem, runs: dict[str, ModelRun]
) -> tuple[Figures, dict[str, dict[str, float]]]:
    """The model error in each temperature, and by model the values on the finest level [SI]."""
    from comparisons.studies.heat.study import heat_figures

    without = set() if problem.scene.finite_element.roller_shape == "circle" else {"roller"}
    figures = Figures(heat_figures(problem, runs, without)[0])
    values = {
        name: {figure.quantity: figure.value for figure in figures.of(source=name, against=None)}
        for name in runs
    }
    return figures.of(against="finite_element"), values


def is_alike(scene: Scene, tables: Mapping) -> bool:
    """Whether a scene conducts heat as another one, of these tables, for the same groups."""
    heat, other = scene.heat, tables.get(SECTION)
    if heat is None or other is None:
        return True
    base = heat.base or "held"
    same_base = not scene.body.thickness or base == other.get("base", base)
    return same_base and heat.slide_to_roll == other["slide_to_roll"]


def usual_axes(scene: Scene) -> tuple[str, str]:
    return "peclet", "a_over_thickness" if scene.coating is None else "coating_over_a"


def peclet(problem: Problem) -> float | None:
    """Of the body; None of a scene without heat."""
    return None if problem.scene.heat is None else peclet_numbers(problem)["body"]


def set_peclet(scene: Scene, value: float, half_width: float) -> dict[str, float]:
    """The speed at which the body has a Peclet number, `half_width` [m] that of smooth bodies."""
    heat = scene.heat
    share = 1.0 / heat.slide_to_roll + 0.5  # of the speed, at which the body moves
    if share == 0.0:
        raise SceneError(
            f"{scene.source}: heat.slide_to_roll: is -2, at which the contact stays on the body; "
            "allowed with peclet is any other one"
        )
    diffusivity = heat.body_conductivity / (heat.body_density * heat.body_specific_heat)
    return {"heat.speed": 2.0 * diffusivity * value / (half_width * abs(share))}


def set_conductivity(scene: Scene, value: float, half_width: float) -> dict[str, float]:
    """The coating's, at which it has a ratio to the body's."""
    return {"heat.coating_conductivity": value * scene.heat.body_conductivity}


GROUPS = {
    "peclet": (set_peclet, peclet),
    "conductivity_ratio": (set_conductivity, lambda problem: None),
}
