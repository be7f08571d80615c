"""The closed form of a scene's smooth contact: Hertz's contact, or Westergaard's of a single wave.

A periodic surface of several waves has none."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from analytic.exact.hertz import hertz_extremes, hertz_stress
from analytic.exact.westergaard import (
    westergaard_extremes,
    westergaard_from_mean_pressure,
    westergaard_stress,
)
from analytic.stress_state import Extremum, StressState
from comparisons.models.problem import Problem


@dataclass(frozen=True)
class ClosedForm:
    """Closed form of smooth half-planes under a load; lengths [m], pressures and stresses [Pa]."""

    name: str  # whose it is
    label: str  # of its curve of pressure
    peak_pressure: float
    contact_length: float
    pressure: Callable[[np.ndarray], np.ndarray]  # of x
    stress: Callable[..., StressState]  # of x, z and `friction`
    extremes: Callable[[float], dict[str, Extremum]]  # `tau1` and `txz`, of the friction


def closed_form(problem: Problem) -> ClosedForm | None:
    """Closed form of a smooth contact; None where there is none."""
    scene, hertz = problem.scene, problem.hertz
    if not scene.periodic:
        size = hertz.peak_pressure, 2.0 * hertz.half_width

        def extremes(friction: float) -> dict[str, Extremum]:
            largest = hertz_extremes(hertz, friction)
            shears = largest.txz_max, largest.txz_min
            return {"tau1": largest.tau1, "txz": max(shears, key=lambda one: abs(one.value))}

        of = hertz.pressure, partial(hertz_stress, hertz), extremes
        return ClosedForm("Hertz", "Hertz, smooth", *size, *of)
    profile, nu = scene.profile, scene.body.poissons_ratio
    if profile.variety != "sinusoid" or profile.cutoff or profile.short_cutoff:
        return None
    sizes = scene.load.value, profile.wavelength, profile.amplitude
    wave = westergaard_from_mean_pressure(*sizes, problem.modulus)
    crest = problem.surface.position  # x = 0 lies there on the trace, whose crest is at its zero

    def stress(x: np.ndarray, z: np.ndarray, friction: float = 0.0) -> StressState:
        return westergaard_stress(wave, np.add(x, crest), z, nu, friction)

    return ClosedForm(
        name="Westergaard",
        label="Westergaard, exact",
        peak_pressure=wave.peak_pressure,
        contact_length=2.0 * wave.half_width * problem.period / wave.wavelength,
        pressure=lambda x: wave.pressure(np.add(x, crest)),
        stress=stress,
        extremes=partial(westergaard_extremes, wave, nu),
    )
