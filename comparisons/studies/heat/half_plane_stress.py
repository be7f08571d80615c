"""Stresses of a contact and of the heat of its friction together, and those of the half-plane.

The bulk temperature leaves no stress; the heat is steady, the body elastic."""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import RectBivariateSpline

from analytic.contact.end_stress import EndStress
from analytic.stress.field import StressField
from analytic.stress.maxima import stress_maxima
from analytic.stress_state import Extremum, StressState
from comparisons.models.half_plane import field_on, stresses_at
from comparisons.models.level import Level
from comparisons.models.problem import Problem, ends_of
from comparisons.models.window import Window, search_window
from comparisons.studies.heat.half_space import friction_of, half_space_heat, half_spaces


@dataclass(frozen=True)
class HeatedStress:
    """A level's largest tau1 in the window and its sx along the surface, with heat and without."""

    tau1: tuple[Extremum, Extremum]
    x: np.ndarray  # (n,) [m] ascending
    sx: np.ndarray  # (2, n) [Pa] of the surface there, tensile where positive

    @property
    def figures(self) -> dict[str, float]:
        """With heat [Pa], and their places [m]."""
        return self._figures(0)

    @property
    def elastic(self) -> dict[str, float]:
        """The same without heat."""
        return self._figures(1)

    def _figures(self, row: int) -> dict[str, float]:
        tau1, sx = self.tau1[row], self.sx[row]
        largest = {"tau1_heated": tau1.value, "tau1_depth_heated": tau1.z, "sx_heated": sx.max()}
        return largest | {"tau1_position": tau1.x, "sx_position": self.x[sx.argmax()]}


def surface_places(level: Level, window: Window, ends: EndStress) -> np.ndarray:
    """x (n,) [m] of grid, window and ends of contact, where sx of the surface is largest."""
    found = level.patches.ravel(), *(patch.ends for patch in ends.patches)
    x = np.unique(np.concatenate([window.x, level.grid.x, *found]))
    return x[np.abs(x) <= window.extent]


def half_plane_stress(problem: Problem, level: Level, window: Window) -> HeatedStress:
    """Of the half-plane on a level of its own."""
    friction, ends = friction_of(problem), ends_of(problem, level.grid, level.solution)
    searched, close = search_window(problem, window), ends.at(friction)
    thermal = _thermal(problem, level, searched)
    field = field_on(level, searched, ends).at(friction)
    both = field.stress.plus(1.0, thermal(*np.meshgrid(field.x, field.z)))
    found = stress_maxima(
        level.grid.x,
        level.solution.pressure,
        friction,
        StressField(field.x, field.z, both),
        problem.scene.body.poissons_ratio,
        beside=lambda x, z: close(x, z).plus(1.0, thermal(x, z)),
    )
    x = surface_places(level, window, ends)
    top = x, np.zeros_like(x)
    elastic = stresses_at(problem, level, (friction,), *top)[friction].sx
    sx = np.array([elastic + thermal(*top).sx, elastic])
    return HeatedStress((found.tau1, level.stress(friction).extremes["tau1"]), x, sx)


def _thermal(problem: Problem, level: Level, window: Window):
    """Thermal stresses of x and z [m] in a window, by splines between the nodes of the fluxes."""
    from analytic.heat.thermal_stress import thermal_stress

    contact, pitch = half_space_heat(problem, level), level.grid.pitch
    ends = contact.x[0] - window.x[0], window.x[-1] - contact.x[-1]
    before, after = (max(0, int(np.ceil(beyond / pitch)) + 4) for beyond in ends)
    flux = np.pad(contact.into_body, (before, after))
    x = contact.x[0] + pitch * np.arange(-before, len(contact.x) + after)
    surface, scene = half_spaces(problem, len(x), pitch)[0], problem.scene
    found = thermal_stress(surface, flux, window.z, scene.body.material, scene.heat.body_expansion)
    order = min(3, len(window.z) - 1)
    parts = [RectBivariateSpline(window.z, x, each, kx=order) for each in vars(found).values()]
    return lambda x, z: StressState(*(part.ev(z, x) for part in parts))
