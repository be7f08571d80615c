"""The heat of friction in finite bodies: conduction on meshes of their own, its partition, and the
thermal stresses of the rough body with those of its contact.

A body without a thickness goes on as a half-space beyond its mesh. That of a layer ends where the
heat has gone into its base or been carried off. The roller is a disc of its radius and has its bulk
temperature at the scene's `reach` from the contact, and where its rim comes in; of a fast one only
what is heated is meshed."""

from collections.abc import Callable, Set

import numpy as np

from analytic.heat.moving_source import line_source
from analytic.numerics import runs_of
from comparisons.models.finite_element.bodies import rough_support
from comparisons.models.level import Level
from comparisons.models.operators import is_layered
from comparisons.models.problem import Problem
from comparisons.models.readings import left_out_at_ends
from comparisons.studies.heat.half_space import (
    FARTHEST,
    HeatedContact,
    HeatedStress,
    heat_of_friction,
    reach_of,
    surface_places,
)
from fem.body.coating import Coating
from fem.body.elasticity import elastic_body
from fem.body.surface import values_at
from fem.heat.body import thermal_body
from fem.heat.conduction import Conduction, Surroundings
from fem.heat.partition import FrictionalHeat
from fem.heat.thermal_stress import thermal_stress
from fem.stress.maximum import maximum
from fem.stress.stress import evaluate_all
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
    """`half_space_heat` under the pressures of a finite-element level; `block` scales the mesh
    of an unbounded body; `without` names features (`what_it_contains`) that are left out."""
    return solved_heat(problem, level, block, without)[0]


def solved_heat(
    problem: Problem, level: Level, block: float = 1.0, without: Set[str] = frozenset()
) -> tuple[HeatedContact, Callable[[np.ndarray], np.ndarray]]:
    """`finite_element_heat`, and the rough body's temperature (k,) [K] at points (k, 2) [m] by its
    shape functions; beyond its mesh a moving half-plane has a line source's, a layer its end's."""
    x, pitch = level.grid.hats, level.grid.pitch
    heat = np.pad(heat_of_friction(problem, level), 1)
    contact = (heat[1:] > 0.0) | (heat[:-1] > 0.0)
    first, after = runs_of(contact)
    patches = np.column_stack([x[first], x[after]])
    bodies = tuple(
        _conduction(problem, is_rough, patches, pitch, block, without) for is_rough in (True, False)
    )
    steady = FrictionalHeat(bodies, x, contact).steady(heat)
    into_body = np.zeros_like(heat)
    into_body[np.searchsorted(x, steady.x)] = steady.flux[0]
    rises = [
        values_at(conduction.body.surface, x) @ temperature[conduction.body.surface.point]
        for conduction, temperature in zip(bodies, steady.temperature, strict=True)
    ]
    inner = (values[1:-1] for values in (x, heat, into_body, *rises))
    body, nodal, velocity = bodies[0].body, steady.temperature[0], bodies[0].velocity

    def at(places: np.ndarray) -> np.ndarray:
        if bodies[0].surroundings.base != "open":
            half_width = body.mesh.spec.half_width
            held = np.clip(places[:, 0], -half_width, half_width)
            return body.at(np.column_stack([held, places[:, 1]]), nodal)
        rise, rate = body.at(places, nodal), -0.5 * velocity / body.material.diffusivity
        beyond, centre = np.isnan(rise), x @ into_body / into_body.sum()
        away, z = (places[beyond] - (centre, 0.0)).T
        share = steady.share * heat.sum() * pitch / (np.pi * body.material.conductivity)
        rise[beyond] = share * line_source(away, rate, z)
        return rise

    return HeatedContact(*inner, steady.share), at


def _conduction(
    problem: Problem,
    is_rough: bool,
    patches: np.ndarray,
    pitch: float,
    block: float,
    without: Set[str],
) -> Conduction:
    """The rough body, or else the roller, on a mesh of its own, finer on each level in every
    respect."""
    scene, settings = problem.scene, problem.scene.heat
    material = settings.body if is_rough else settings.roller
    velocity = settings.velocities[0 if is_rough else 1]
    thickness = scene.body.thickness if is_rough and "thickness" not in without else None
    coated = scene.coating if is_rough and "coating" not in without else None
    radius = np.inf if is_rough or "roller" in without else scene.roller.radius
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


def finite_element_stress(problem: Problem, level: Level, beyond: float = np.inf) -> HeatedStress:
    """Stress on a level; an unbounded body is held `beyond` this part of its mesh."""
    heat, friction, field = problem.scene.heat, problem.largest_friction, level.mesh_field
    made = field.mesh, field.material, rough_support(problem, field.mesh.spec, beyond)
    body = elastic_body(*made, degree=field.degree, coating=field.coating)
    expansion = np.where(body.coated, heat.coating_expansion or 0.0, heat.body_expansion)
    temperature = solved_heat(problem, level)[1]
    thermal, _ = thermal_stress(body, expansion, temperature(body.points))
    elastic = field.on(body)[field.frictions.index(friction)]
    both, bounds = elastic.plus(thermal.values), (*problem.window.ends, problem.window.z[-1])
    tau1 = maximum(body, both, lambda stress: stress.tau1, bounds)
    x = surface_places(problem, level)
    x = x[np.abs(x) <= field.mesh.spec.half_width]
    along = evaluate_all(body, (both, elastic), x, np.zeros_like(x))
    cold = level.stress.extremes["tau1"]
    sx = np.array([stress.sx for stress in along])
    if not is_layered(problem.scene):
        sx += (1.0, friction) @ left_out_at_ends(problem, level.grid, level.solution, x)
    return HeatedStress((tau1, cold), x, sx)
