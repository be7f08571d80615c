"""What the pictures show, and one scale of each kind for all of them: p0, a, heights in m."""

from dataclasses import dataclass

import numpy as np

from analytic.grid import HatGrid
from analytic.operators.half_plane import HalfPlane
from comparisons.drawing.field import round_bands
from comparisons.models.problem import mean_height
from comparisons.output.page.pictures.stresses import COMPONENTS, Component
from comparisons.studies.study import Run

RANGE = 1.25  # a, to either side


@dataclass(frozen=True)
class Scales:
    """Shared by all surfaces."""

    bands: dict[str, np.ndarray]  # of colour, by component's name [p0]
    pressure: float  # top of the pressures' axes [p0]
    relief: float  # height of the surfaces' axes [m]


def values_of(outcome: Run, component: Component, model: str, friction: float) -> np.ndarray:
    """A model's field on the run's window [p0]."""
    field = outcome.runs[model].finest.stress(friction).field
    return component.of(field) / outcome.problem.hertz.peak_pressure


def trace_surfaces(outcome: Run) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """x (n,) and the heights (n,) of body and roller under load [m] over the whole trace. From the
    half-plane's pressures, beyond the contact too; of a smooth body over the range of its pressure
    elements. The datum of the heights is arbitrary."""
    problem, level = outcome.problem, outcome.runs["half_plane"].finest
    profile, pitch, grid = problem.surface.profile, level.grid.pitch, level.grid
    if profile is not None:
        grid = HatGrid.within(float(profile.x[0]), float(profile.x[-1]), pitch)
    pressure = np.zeros(grid.count)
    first = level.grid.first - grid.first
    pressure[first : first + level.grid.count] = level.solution.pressure
    of_both = HalfPlane(grid.count, pitch, problem.modulus).apply(pressure) / grid.weights
    gap = grid.hat_integrals(problem.gap, problem.knots) / grid.weights + of_both
    gap -= np.median(gap[pressure > 0.0])
    displacement = problem.modulus / problem.scene.body.material.plane_strain_modulus * of_both
    body = mean_height(problem, grid) - displacement
    return grid.x, body, body + np.maximum(gap, 0.0)


def scales_of(outcomes: dict[str, Run]) -> Scales:
    bands = {}
    for component in COMPONENTS:
        fields = [
            values_of(outcome, component, "half_plane", friction)
            for outcome in outcomes.values()
            for friction in outcome.problem.scene.load.friction
        ]
        bands[component.name] = round_bands(fields, component.signed)
    pressure = 1.12 * max(map(_highest, outcomes.values()))
    return Scales(bands, pressure, max(map(_relief, outcomes.values())))


def _highest(outcome: Run) -> float:
    peaks = [run.finest.solution.pressure.max() for run in outcome.runs.values()]
    return float(max(peaks) / outcome.problem.hertz.peak_pressure)


def _relief(outcome: Run) -> float:
    """Height [m] that both surfaces under load take, with room for the roller."""
    x, body, roller = trace_surfaces(outcome)
    near = np.abs(x) <= RANGE * outcome.problem.hertz.half_width
    return 1.45 * float(roller[near].max() - body[near].min())
