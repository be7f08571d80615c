"""The heat of friction, mu p V, in the half-spaces that both bodies stand for, and its stresses.

The contact stays where it is, the surfaces pass it; the pressure is that of one moment and taken as
steady. That is exact where the contact stays on the rough body (slide-to-roll ratio -2). Else
asperities move with the body: each heats it for longer than here, the roller at many points.
Stresses are steady and elastic, of a body that the bulk temperature leaves without any."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.interpolate import CubicSpline, RectBivariateSpline

from analytic.stress_state import Extremum, StressState
from comparisons.common.errors import SceneError
from comparisons.models.level import Level
from comparisons.models.problem import Problem
from comparisons.models.readings import (
    ends_of,
    ends_of_contact,
    largest_tau1,
    left_out_at_ends,
    stresses_at,
)
from comparisons.models.window import search_window

if TYPE_CHECKING:
    from analytic.heat.moving_source import HeatedSurface

# Peclet number V a / (2 kappa) of the contact's half-width a. Faster, and the heated layer is
# thinner than a seventieth of a: mesh and half-space would need elements for that alone. Slower,
# and heat reaches farther than a thousand a before it is carried off: no unbounded body is as
# large. At rest the scene's `reach` bounds it.
SLOWEST, FASTEST = 1e-3, 1e4
# For thermal stresses, of the body: kappa/V is ten a then, a fortieth of what is meshed
LEAST_STRESSED = 0.05
HEAT_QUANTITIES = ("flash_temperature", "mean_temperature", "fraction_into_body")
HEATED, WITHOUT = ("tau1_heated", "tau1_depth_heated", "sx_heated"), "_without_heat"
# Of the roller's radius: the largest distance from the contact where it has its bulk temperature;
# what is left of the disc farther off is a narrow lens.
FARTHEST = 1.2
# How far off the surface's largest sx is looked for, over the farthest contact; points on a side
SEEN, PLACES = 20.0, 60


@dataclass(frozen=True)
class HeatedContact:
    """Heat that friction brings into both surfaces, at the nodes (n,) of a level."""

    x: np.ndarray  # [m]
    heat: np.ndarray  # [W/m^2] mu p V
    into_body: np.ndarray  # [W/m^2] the part of it that enters the body
    body: np.ndarray  # [K] rise of its surface above the bulk temperature
    roller: np.ndarray
    fraction: float  # of the heat that enters the body

    @property
    def figures(self) -> dict[str, float]:
        """Largest rise in the contact [K], the mean where heat is made, weighed by it, and the part
        of it that enters the body."""
        return {
            "flash_temperature": float(self.body[self._hottest]),
            "mean_temperature": float(self.heat @ self.body / self.heat.sum()),
            "fraction_into_body": self.fraction,
        }

    @property
    def places(self) -> dict[str, tuple[float, ...]]:
        """Position of the largest [m]."""
        return {"flash_temperature": (float(self.x[self._hottest]),)}

    @property
    def _hottest(self) -> int:
        return int(np.argmax(np.where(self.heat > 0.0, self.body, -np.inf)))


def reach_of(problem: Problem) -> float:
    """Distance from the contact to where a body that it stays on has its bulk temperature [m]."""
    return problem.scene.heat.reach or problem.scene.roller.radius


def heat_of_friction(problem: Problem, level: Level) -> np.ndarray:
    """mu p V (n,) [W/m^2] at the nodes of a level."""
    return problem.largest_friction * problem.scene.heat.speed * level.solution.pressure


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
    parts = divided(*half_spaces(problem, grid.count, grid.pitch), heat)
    return HeatedContact(grid.x, heat, parts.flux, parts.first, parts.second, parts.fraction)


def peclet_numbers(problem: Problem) -> dict[str, float]:
    """|V| a / (2 kappa) of each body, a of the smooth contact; 0 at rest."""
    heat, half_width = problem.scene.heat, problem.hertz.half_width
    bodies = zip(("body", "roller"), (heat.body, heat.roller), heat.velocities, strict=True)
    return {name: abs(v) * half_width / (2.0 * m.diffusivity) for name, m, v in bodies}


def what_it_contains(problem: Problem) -> dict[str, str]:
    """Features that the finite elements have and the half-space has not, in words."""
    scene, features = problem.scene, {}
    if scene.body.thickness is not None:
        how = "insulated" if scene.heat.base == "insulated" else "at its bulk temperature"
        features["thickness"] = f"the body's thickness, its base {how}"
    if scene.coating is not None:
        features["coating"] = "the coating"
    return features | {"roller": "the roller as a disc"}


def check_heat(problem: Problem) -> None:
    """Raise SceneError for speeds that no temperature can be computed for."""
    for field, wrong in _unsuitable(problem):
        raise SceneError(f"{problem.scene.source}: heat.{field}: is {wrong}")


def _unsuitable(problem: Problem) -> Iterator[tuple[str, str]]:
    """Fields of [heat], with what they are and what is allowed."""
    heat, radius = problem.scene.heat, problem.scene.roller.radius
    numbers, reach = peclet_numbers(problem), reach_of(problem)
    for body, peclet in numbers.items():
        if peclet != 0.0 and not SLOWEST <= peclet <= FASTEST:
            low, high = (heat.speed * bound / peclet for bound in (SLOWEST, FASTEST))
            why = "heat would reach no depth that elements show"
            if peclet < SLOWEST:
                why = "no body is as large as the part that would be heated"
            yield (
                "speed",
                f"{heat.speed:g} m/s, a Peclet number of {peclet:.3g} of the {body}: {why}; "
                f"allowed is {low:.3g} m/s to {high:.3g} m/s here, Peclet numbers from "
                f"{SLOWEST:g} to {FASTEST:g}",
            )
    if heat.stresses and numbers["body"] < LEAST_STRESSED:
        slow = f"true at a Peclet number of {numbers['body']:.3g} of the body"
        yield "stresses", f"{slow}; allowed is {LEAST_STRESSED:g} or more"
    least, most = 4.0 * float(np.abs(problem.extent).max()), FARTHEST * radius
    if reach < least:
        far = "four times as far as the contact may reach"
        yield "reach", f"{reach:g} m; allowed is at least {least:.3g} m, {far}"
    if heat.velocities[1] == 0.0 and reach > most:
        allowed = f"allowed is at most {most:.3g} m, {FARTHEST:g} times its radius"
        yield "reach", f"{reach:g} m in a roller at rest; {allowed}"


@dataclass(frozen=True)
class HeatedStress:
    """A level's largest tau1 in the window and its sx along the surface, with heat and without."""

    tau1: tuple[Extremum, Extremum]
    x: np.ndarray  # (n,) [m] ascending, to far beyond the contact
    sx: np.ndarray  # (2, n) [Pa] of the surface there, tensile where positive

    @property
    def figures(self) -> dict[str, float]:
        """Figures with heat and without [Pa], [m]. Tension is 0 where the surface is compressed."""
        return {
            f"{name}{case}": value
            for case, tau1, sx in zip(("", WITHOUT), self.tau1, self.sx, strict=True)
            for name, value in zip(
                HEATED, (tau1.value, tau1.z, max(0.0, float(sx.max()))), strict=True
            )
        }

    @property
    def places(self) -> dict[str, tuple[float, ...]]:
        """Positions of the largest with heat [m]."""
        tau1, sx = self.tau1[0], self.sx[0]
        tensile = {"sx_heated": (float(self.x[sx.argmax()]),)} if sx.max() > 0.0 else {}
        return {"tau1_heated": (tau1.x, tau1.z)} | tensile


def surface_places(problem: Problem, level: Level) -> np.ndarray:
    """x (n,) [m] of grid, window and ends of contact, and far beyond: where sx may be largest."""
    edges = ends_of_contact(problem, level.grid, level.solution)
    far = np.abs(edges).max() * np.geomspace(1.0, SEEN, PLACES)
    return np.unique(np.concatenate([problem.window.x, level.grid.x, edges, -far, far]))


def half_plane_stress(problem: Problem, level: Level) -> HeatedStress:
    """Stress of the half-plane on a level of its own."""
    friction, grid, solution = problem.largest_friction, level.grid, level.solution
    close, thermal = ends_of(problem, grid, solution), _thermal(problem, level)

    def beside(x: np.ndarray, z: np.ndarray) -> StressState:
        return close.stress(friction, x, z).plus(1.0, thermal(x, z))

    tau1 = largest_tau1(problem, grid, solution.pressure, friction, beside)
    x = surface_places(problem, level)
    elastic = stresses_at(problem, level, (friction,), x, np.zeros_like(x))[friction].sx
    elastic += (1.0, friction) @ left_out_at_ends(problem, grid, solution, x)
    nodes, stress = _thermal_line(problem, level, (x[0], x[-1]), np.zeros(1))
    sx = np.array([elastic + CubicSpline(nodes, stress.sx[0])(x), elastic])
    return HeatedStress((tau1, level.stress.extremes["tau1"]), x, sx)


def _thermal(problem: Problem, level: Level) -> Callable[[np.ndarray, np.ndarray], StressState]:
    """Thermal stresses of x and z [m] in the window, by splines between the nodes of the fluxes."""
    window = search_window(problem)
    x, stress = _thermal_line(problem, level, (window.x[0], window.x[-1]), window.z)
    order = min(3, len(window.z) - 1)
    parts = [RectBivariateSpline(window.z, x, part, kx=order) for part in vars(stress).values()]
    return lambda x, z: StressState(*(part.ev(z, x) for part in parts))


def _thermal_line(
    problem: Problem, level: Level, span: tuple[float, float], depths: np.ndarray
) -> tuple[np.ndarray, StressState]:
    """x (n,) [m] over contact and span, as dense as the fluxes, and thermal stresses (m, n) [Pa]
    at depths (m,) [m]."""
    from analytic.heat.thermal_stress import thermal_stress

    contact, pitch = half_space_heat(problem, level), level.grid.pitch
    ends = contact.x[0] - span[0], span[1] - contact.x[-1]
    before, after = (max(0, int(np.ceil(beyond / pitch)) + 4) for beyond in ends)
    flux = np.pad(contact.into_body, (before, after))
    x = contact.x[0] + pitch * np.arange(-before, len(contact.x) + after)
    surface, scene = half_spaces(problem, len(x), pitch)[0], problem.scene
    return x, thermal_stress(surface, flux, depths, scene.body.material, scene.heat.body_expansion)
