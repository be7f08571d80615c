"""From a point of the unit cube to the scene that it stands for, and the half-plane's figures."""

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import ndtr, ndtri

from analytic.contact.problem import ContactError
from analytic.surface.stylus import opened, with_noise
from comparisons.common.errors import InputError, one_line
from comparisons.common.progress import Stages, no_progress
from comparisons.models.half_plane import half_plane_level
from comparisons.models.problem import Problem, problem_of
from comparisons.models.window import window_of
from comparisons.scenes.scene import Scene
from comparisons.scenes.studies.scatter import CUT_OFF, FIELDS, Spread
from comparisons.scenes.surface import SceneSurface
from comparisons.studies.contact import values_of

Found = dict[float, dict[str, float]]  # by friction coefficient of the scene, and by quantity


def values_at(spread: Spread, own: float, share: ArrayLike) -> np.ndarray:
    """The input's values at which its distribution reaches `share`, from 0 to 1; the scene's `own`
    value is the mean of what is normal."""
    if spread.range:
        low, high = spread.range
        return low + share * (high - low)
    left_out = ndtr(-CUT_OFF)
    return own + spread.size(own) * ndtri(left_out + share * (1.0 - 2.0 * left_out))


def sampled(scene: Scene, surface: SceneSurface, point: np.ndarray) -> tuple[Scene, SceneSurface]:
    """Scene and surface with their uncertain inputs at a point (d,) of the unit cube, in their
    order. Of the noise the point chooses the seed. Noise comes before the tip, which rounds what
    it makes too sharp, as a stylus would have."""
    spreads = scene.scatter.inputs
    at = dict(zip(spreads, point, strict=True))

    def value(name: str, own: float) -> float:
        return float(values_at(spreads[name], own, at[name])) if name in at else own

    fields = {
        f"{section}.{field}": value(name, getattr(getattr(scene, section), field))
        for name, (section, field) in FIELDS.items()
        if name in at and name != "friction"
    }
    fields["load.friction"] = tuple(value("friction", mu) for mu in scene.load.friction)
    fields[f"load.{scene.load.kind}"] = value("load", scene.load.value)
    scene = scene.unchecked(fields)
    moved, profile = value("position", surface.position) - surface.position, surface.profile
    if profile is None:
        return scene, surface
    if "noise" in at:
        rng = np.random.default_rng(int(at["noise"] * 2.0**32))
        size, correlation_length = spreads["noise"].deviation, scene.scatter.correlation_length
        profile = with_noise(profile, size, correlation_length or 0.0, rng)
    if "tip_radius" in at:
        profile = opened(profile, value("tip_radius", 0.0))
    position = surface.position + moved
    return scene, replace(surface, profile=profile.shifted(moved), position=position)


def solved(problem: Problem) -> tuple[Found, np.ndarray]:
    """Figures of the half-plane on the coarsest level's pressure elements, whose error is in every
    sample alike, and the pressure (n,) [Pa] at its nodes."""
    scene = problem.scene
    window = None if scene.stress is None else window_of(problem)
    stages = Stages(no_progress)
    level = half_plane_level(problem, problem.pitches[0], window, stages, fields=False)
    return {
        mu: values_of(level, problem, mu) for mu in scene.load.friction
    }, level.solution.pressure


def solve_samples(
    scene: Scene, surface: SceneSurface, points: np.ndarray, places: np.ndarray
) -> dict[str, object]:
    """What the half-plane finds at points (n, d): `figures`, at each a dictionary by quantity for
    every friction coefficient, or why there is none; and its `pressures` (n, k) [Pa] at places
    (k,) [m], nan without a solution."""
    found, pressures = [], np.full((len(points), len(places)), np.nan)
    for number, point in enumerate(points):
        try:
            problem = problem_of(*sampled(scene, surface, point))
            by_friction, pressure = solved(problem)
            x = problem.grid(problem.pitches[0]).x
            pressures[number] = np.interp(places, x, pressure, 0.0, 0.0)
            found.append(tuple(by_friction.values()))
        except (InputError, ContactError, ArithmeticError, ValueError) as error:
            found.append(one_line(str(error)))
    return {"figures": tuple(found), "pressures": pressures}
