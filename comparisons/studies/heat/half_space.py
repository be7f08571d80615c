"""The heat of friction, mu p V, in the half-spaces that both bodies stand for.

The contact stays where it is, the surfaces pass it; the pressure is that of one moment and taken as
steady. That is exact where the contact stays on the rough body (slide-to-roll ratio -2). Else
asperities move with the body: each heats it for longer than here, the roller in many places."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.errors import SceneError
from comparisons.models.level import Level
from comparisons.models.problem import Problem

if TYPE_CHECKING:
    from analytic.heat.moving_source import HeatedSurface

# Peclet number V a / (2 kappa) of the contact's half-width a. Faster, and the heated layer is
# thinner than a seventieth of a: mesh and half-space would need elements for that alone. Slower,
# and heat reaches farther than a thousand a before it is carried off: no unbounded body is as
# large. At rest the scene's `reach` bounds it.
SLOWEST, FASTEST = 1e-3, 1e4
# For thermal stresses, of the body: kappa/V is ten a then, a fortieth of what is meshed
LEAST_STRESSED = 0.05
BODIES = ("body", "roller")
# Of the roller's radius: the largest distance from the contact where it has its bulk temperature;
# what is left of the disc farther off is a narrow lens.
FARTHEST = 1.2


@dataclass(frozen=True)
class HeatedContact:
    """What friction heats both surfaces by, at the nodes (n,) of a level."""

    x: np.ndarray  # [m]
    heat: np.ndarray  # [W/m^2] mu p V
    into_body: np.ndarray  # [W/m^2] the part of it that enters the body
    body: np.ndarray  # [K] rise of its surface above the bulk temperature
    roller: np.ndarray
    fraction: float  # of the heat that enters the body

    @property
    def figures(self) -> dict[str, float]:
        """Largest rise in the contact [K] and its place [m], the mean where heat is made, weighed
        by it, and the part of it that enters the body."""
        touch = self.heat > 0.0
        largest = np.argmax(np.where(touch, self.body, -np.inf))
        return {
            "flash_temperature": float(self.body[largest]),
            "mean_temperature": float(self.heat @ self.body / self.heat.sum()),
            "fraction_into_body": self.fraction,
            "flash_position": float(self.x[largest]),
        }


def reach_of(problem: Problem) -> float:
    """From the contact to where a body that it stays on has its bulk temperature [m]."""
    return problem.scene.heat.reach or problem.scene.roller.radius


def friction_of(problem: Problem) -> float:
    """The coefficient that heats: the largest of the scene."""
    return max(problem.scene.load.friction)


def heat_of_friction(problem: Problem, level: Level) -> np.ndarray:
    """mu p V (n,) [W/m^2] at the nodes of a level."""
    return friction_of(problem) * problem.scene.heat.speed * level.solution.pressure


def half_spaces(
    problem: Problem, count: int, pitch: float
) -> "tuple[HeatedSurface, HeatedSurface]":
    """Body and roller as half-spaces of one material each, on nodes of one pitch [m]."""
    from analytic.heat.moving_source import HeatedSurface

    heat = problem.scene.heat
    materials = (heat.body, heat.roller)
    return tuple(
        HeatedSurface(material, count, pitch, velocity, reach_of(problem))
        for material, velocity in zip(materials, heat.velocities, strict=True)
    )


def half_space_heat(problem: Problem, level: Level) -> HeatedContact:
    """Both surfaces' temperatures, equal where they touch, under the pressures of a level."""
    from analytic.heat.partition import divided

    grid, heat = level.grid, heat_of_friction(problem, level)
    found = divided(*half_spaces(problem, grid.count, grid.pitch), heat)
    return HeatedContact(grid.x, heat, found.flux, found.first, found.second, found.fraction)


def peclet_numbers(problem: Problem) -> dict[str, float]:
    """|V| a / (2 kappa) of each body, a of the smooth contact; 0 at rest."""
    heat = problem.scene.heat
    pairs = zip((heat.body, heat.roller), heat.velocities, strict=True)
    half_width = problem.hertz.half_width
    numbers = (abs(velocity) * half_width / (2.0 * m.diffusivity) for m, velocity in pairs)
    return dict(zip(BODIES, numbers, strict=True))


def what_it_contains(problem: Problem) -> dict[str, str]:
    """What the finite elements have and the half-space has not, in words."""
    scene, found = problem.scene, {}
    if scene.body.thickness is not None:
        how = {"held": "at its bulk temperature", "insulated": "insulated"}[
            scene.heat.base or "held"
        ]
        found["thickness"] = f"the body's thickness, its base {how}"
    if scene.coating is not None:
        found["coating"] = "the coating"
    return found | {"roller": "the roller as a disc"}


def check_heat(problem: Problem) -> None:
    """Raise SceneError for speeds that no temperature can be computed for."""
    scene = problem.scene
    for body, peclet in peclet_numbers(problem).items():
        if peclet != 0.0 and not SLOWEST <= peclet <= FASTEST:
            speed = scene.heat.speed
            low, high = (speed * bound / peclet for bound in (SLOWEST, FASTEST))
            why = "heat would reach no depth that elements show"
            if peclet < SLOWEST:
                why = "no body is as large as the part that would be heated"
            raise SceneError(
                f"{scene.source}: heat.speed: is {speed:g} m/s, a Peclet number of {peclet:.3g} of "
                f"the {body}: {why}; allowed is {low:.3g} m/s to {high:.3g} m/s here, Peclet "
                f"numbers from {SLOWEST:g} to {FASTEST:g}"
            )
    own = peclet_numbers(problem)["body"]
    if scene.heat.stresses and own < LEAST_STRESSED:
        given = f"{scene.source}: heat.stresses: is true at a Peclet number of {own:.3g}"
        raise SceneError(f"{given} of the body; allowed is {LEAST_STRESSED:g} or more")
    least = 4.0 * float(np.abs(problem.extent).max())
    reach = reach_of(problem)
    if reach < least:
        raise SceneError(
            f"{scene.source}: heat.reach: is {reach:g} m; allowed is at least "
            f"{least:.3g} m, four times as far as the contact may reach"
        )
    most = FARTHEST * scene.roller.radius
    if scene.heat.velocities[1] == 0.0 and reach > most:
        raise SceneError(
            f"{scene.source}: heat.reach: is {reach:g} m in a roller at rest; allowed "
            f"is at most {most:.3g} m, {FARTHEST:g} times its radius"
        )
