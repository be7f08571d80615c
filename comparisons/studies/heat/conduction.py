"""The heat of friction in finite bodies: conduction on meshes of their own, and its partition.

A body without a thickness goes on as a half-space beyond its mesh. That of a layer ends where the
heat has gone into its base or been carried off. The roller is a disc of its radius and has its bulk
temperature at the scene's `reach` from the contact, and where its rim comes in; of a fast one only
what is heated is meshed."""

from collections.abc import Callable, Set
from dataclasses import dataclass

import numpy as np

from analytic.heat.moving_source import line_source
from analytic.material import ThermalMaterial
from analytic.numerics import runs_of
from comparisons.models.level import Level
from comparisons.models.problem import Problem
from comparisons.studies.heat.half_space import FARTHEST, HeatedContact, heat_of_friction, reach_of
from fem.body.coating import Coating
from fem.heat.body import thermal_body
from fem.heat.conduction import Conduction, Surroundings
from fem.heat.partition import FrictionalHeat
from fem.heat.surface_heat import values_at
from meshes.build import build_block
from meshes.real_shape import rounded
from meshes.thermal_layer import thermal_spec

BLOCK = 10.0  # half-width and depth over those of what is heated
BESIDE = 6.0  # half-width of a layer's block over its thickness, beyond that
UPSTREAM = 5.0  # the same over kappa/V, of an insulated layer, whose heat goes nowhere else
# Depth of the part of a disc that is meshed over kappa/V, from which its far side does not count.
EXIT = 20.0
LAYERS, GROWTH = 1.0, 0.28  # of `meshes.thermal_layer`, on the coarsest level


def finite_element_heat(
    problem: Problem, level: Level, block: float = 1.0, without: Set[str] = frozenset()
) -> HeatedContact:
    """As `half_space_heat`, under the pressures of a finite-element level; `block` scales the mesh
    of an unbounded body; `without` names features (`what_it_contains`) that are left out."""
    return solved_heat(problem, level, block, without)[0]


def solved_heat(
    problem: Problem, level: Level, block: float = 1.0, without: Set[str] = frozenset()
) -> tuple[HeatedContact, Callable[[np.ndarray], np.ndarray]]:
    """`finite_element_heat`, and the rough body's temperature (k,) [K] of places (k, 2) [m] by its
    shape functions; beyond its mesh a moving half-plane has a line source's, a layer its end's."""
    x, heat = level.grid.x, heat_of_friction(problem, level)
    x = np.concatenate([[x[0] - level.grid.pitch], x, [x[-1] + level.grid.pitch]])
    heat = np.pad(heat, 1)
    contact = (heat[1:] > 0.0) | (heat[:-1] > 0.0)
    first, after = runs_of(contact)
    patches = np.column_stack([x[first], x[after]])
    settings = problem.scene.heat
    rough_velocity, roller_velocity = settings.velocities
    halves = (
        _Half(True, settings.body, rough_velocity),
        _Half(False, settings.roller, roller_velocity),
    )
    bodies = tuple(
        _conduction(problem, half, patches, level.grid.pitch, block, without) for half in halves
    )
    found = FrictionalHeat(bodies, x, contact).steady(heat)
    into_body = np.zeros_like(heat)
    into_body[np.searchsorted(x, found.x)] = found.flux[0]
    rises = [
        values_at(each.body.surface, x) @ temperature[each.body.surface.point]
        for each, temperature in zip(bodies, found.temperature, strict=True)
    ]
    inner = (values[1:-1] for values in (x, heat, into_body, *rises))
    body, nodal, velocity = bodies[0].body, found.temperature[0], settings.velocities[0]

    def at(places: np.ndarray) -> np.ndarray:
        if bodies[0].surroundings.base != "open":
            half_width = body.mesh.spec.half_width
            held = np.clip(places[:, 0], -half_width, half_width)
            return body.at(np.column_stack([held, places[:, 1]]), nodal)
        rise, rate = body.at(places, nodal), -0.5 * velocity / body.material.diffusivity
        beyond, centre = np.isnan(rise), x @ into_body / into_body.sum()
        away, z = (places[beyond] - (centre, 0.0)).T
        share = found.share * heat.sum() * level.grid.pitch / (np.pi * body.material.conductivity)
        rise[beyond] = share * line_source(away, rate, z)
        return rise

    return HeatedContact(*inner, found.share), at


@dataclass(frozen=True)
class _Half:
    """One of the two bodies."""

    rough: bool  # else the roller
    material: ThermalMaterial
    velocity: float  # of its surface past the contact [m/s]


def _conduction(
    problem: Problem,
    half: _Half,
    patches: np.ndarray,
    pitch: float,
    block: float,
    without: Set[str],
) -> Conduction:
    """The rough body or the roller on a mesh of its own, finer on each level in every respect."""
    scene, settings = problem.scene, problem.scene.heat
    rough, material, velocity = half.rough, half.material, half.velocity
    thickness = scene.body.thickness if rough and "thickness" not in without else None
    coated = scene.coating if rough and "coating" not in without else None
    radius = np.inf if rough or "roller" in without else scene.roller.radius
    half_width = block * BLOCK * float(np.abs(patches).max())
    layer = None if coated is None else Coating(settings.coating, coated.thickness)
    slower = min(m.diffusivity for m in (material, layer and layer.material) if m)
    length = slower / velocity if velocity else np.inf
    if thickness is not None:
        depth, around = thickness, Surroundings(settings.base or "held", "flow")
        half_width += block * BESIDE * thickness
        if settings.base == "insulated":
            half_width = half_width + UPSTREAM * abs(length) if velocity else reach_of(problem)
    elif np.isfinite(radius):
        reach = min(reach_of(problem), FARTHEST * radius)
        whole = reach * np.sqrt(1.0 - (0.5 * reach / radius) ** 2)  # x where the rim is that far
        depth = half_width = min(whole, max(half_width, block * EXIT * abs(length)))
        around = Surroundings("held", "flow" if depth > EXIT * abs(length) else "held")
    else:
        half_width = half_width if velocity else min(half_width, 0.5 * reach_of(problem))
        depth, around = half_width, Surroundings("open", "open")
    finer = problem.pitches[0] / pitch
    spec = thermal_spec(
        patches,
        pitch,
        half_width=half_width,
        depth=depth,
        length=length,
        layers=LAYERS * finer,
        growth=GROWTH / np.sqrt(finer),
        interface=None if layer is None else layer.thickness,
    )
    mesh = build_block(spec)
    mesh = rounded(mesh, radius) if np.isfinite(radius) else mesh
    body = thermal_body(mesh, material, coating=layer, radius=radius)
    return Conduction(body, velocity, around, float(patches.mean()), reach_of(problem))
