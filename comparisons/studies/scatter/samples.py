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
from comparisons.scenes.scene import CUT_OFF, ResolvedScene, Spread
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


def sampled(scene: ResolvedScene, point: np.ndarray) -> ResolvedScene:
    """The scene with its uncertain inputs at a point (d,) of the unit cube, in their order. Of the
    noise the point chooses the seed. Noise comes before the tip, which rounds what it makes too
    sharp, as a stylus would have."""
    at = dict(zip(scene.scatter.inputs, point, strict=True))

    def value(name: str, own: float) -> float:
        spread = scene.scatter.inputs.get(name)
        return own if spread is None else float(values_at(spread, own, at[name]))

    bodies = {}
    for name in ("roller", "body"):
        material = getattr(scene, name)
        if material is not None:
            bodies[name] = replace(
                material,
                youngs_modulus=value(f"{name}_youngs_modulus", material.youngs_modulus),
                poissons_ratio=value(f"{name}_poissons_ratio", material.poissons_ratio),
            )
    friction = tuple(value("friction", mu) for mu in scene.friction)
    load = replace(scene.load, value=value("load", scene.load.value))
    radius = value("roller_radius", scene.roller_radius)
    moved, profile = value("position", scene.position) - scene.position, scene.profile
    if profile is not None:
        if "noise" in at:
            rng = np.random.default_rng(int(at["noise"] * 2.0**32))
            size = scene.scatter.inputs["noise"].deviation
            profile = with_noise(profile, size, scene.scatter.correlation_length, rng)
        if "tip_radius" in at:
            profile = opened(profile, value("tip_radius", 0.0))
        profile = profile.shifted(moved)
    own = {"friction": friction, "load": load, "roller_radius": radius, "profile": profile}
    return replace(scene, **bodies, **own, position=scene.position + moved)


def solved(problem: Problem) -> tuple[Found, np.ndarray]:
    """Figures of the half-plane on the coarsest level's pressure elements, whose error is in every
    sample alike, and the pressure (n,) [Pa] at its nodes."""
    scene = problem.scene
    window = None if scene.stress is None else window_of(problem)
    stages = Stages(no_progress)
    level = half_plane_level(problem, problem.pitches[0], window, stages, fields=False)
    return {mu: values_of(level, problem, mu) for mu in scene.friction}, level.solution.pressure


def solve_samples(
    scene: ResolvedScene, points: np.ndarray, places: np.ndarray
) -> dict[str, object]:
    """What the half-plane finds at points (n, d): `figures`, at each a dictionary by quantity for
    every friction coefficient, or why there is none; and its `pressures` (n, k) [Pa] at places
    (k,) [m], nan without a solution."""
    found, pressures = [], np.full((len(points), len(places)), np.nan)
    for number, point in enumerate(points):
        try:
            problem = problem_of(sampled(scene, point))
            by_friction, pressure = solved(problem)
            x = problem.grid(problem.pitches[0]).x
            pressures[number] = np.interp(places, x, pressure, 0.0, 0.0)
            found.append(tuple(by_friction.values()))
        except (InputError, ContactError, ArithmeticError, ValueError) as error:
            found.append(one_line(str(error)))
    return {"figures": tuple(found), "pressures": pressures}
