"""Partial slip on one level: the history of loads, what is read of it, and two half-planes."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise
from math import ceil

import numpy as np

from analytic.contact.partial_slip import (
    Loads,
    SlipState,
    SurfacePair,
    half_planes,
    pressed_in,
    stepped,
    stick_zones,
)
from analytic.contact.patches import contact_patches
from analytic.grid import HatGrid
from analytic.material import Material
from analytic.numerics import runs_of
from analytic.stress.elements import FrictionStress
from analytic.stress.fatigue import ruiz, smith_watson_topper
from analytic.stress.field import StressField
from analytic.stress.maxima import stress_maxima
from analytic.stress.points import friction_stress_at
from analytic.stress_state import Extremum, StressState
from comparisons.models.level import Level
from comparisons.models.problem import Problem
from comparisons.models.readings import ends_of, hats_field, left_out_at_ends
from comparisons.models.window import Window, search_window

# Pitches from an end of contact where the surface's stress is looked at too: tension, traction and
# slip together are largest between the last nodes
BESIDE_AN_END = np.arange(-16, 17) / 8.0
Beside = Callable[[np.ndarray, np.ndarray], StressState]


@dataclass(frozen=True)
class SlippedLevel:
    """After each of the scene's m loads."""

    path: tuple[float, ...]  # the loads, over that of sliding
    grid: HatGrid
    states: tuple[SlipState, ...]
    zones: tuple[np.ndarray, ...]  # (k, 2) [m] that stick, of each
    energies: np.ndarray  # (m,) [J/m] lost to friction from the first touch on
    displacements: np.ndarray  # (m,) [m] of the roller, against the ends of the coarsest grid
    is_stepped: bool  # whether the loads come by increments
    material: Material  # of the body's surface
    slips: np.ndarray  # (m, n) [m] of the roller over the body while they touched
    # [m] of the body's surface under the roller at the end; None: it has no base
    lowering: float | None = None
    tau1: Extremum | None = None  # largest, at the end; with [stress]
    x: np.ndarray = field(default_factory=lambda: np.empty(0))  # (k,) [m]
    # (k,) of the surface there; at the other end of the cycle (None: there is no cycle)
    surface: StressState | None = None
    opposite: StressState | None = None

    @property
    def worst(self) -> float:
        """Largest residual of all states."""
        return max(state.residual for state in self.states)

    @cached_property
    def figures(self) -> dict[str, float]:
        """At the end of the path of loads."""
        normal, stuck = self.states[-1].normal, float(np.ptp(self.zones[-1], axis=1).sum())
        edges = contact_patches(self.grid.x, normal.pressure, normal.gap)
        touching = self.grid.x[normal.pressure > 0.0]
        known = {
            "stick_length": stuck,
            "stick_ratio": stuck / float(np.ptp(edges, axis=1).sum()),
            "tangential_displacement": float(self.displacements[-1]),
            "energy_lost": float(self.energies[-1]),
            "slip_amplitude": float(self.amplitude(np.append(touching, edges)).max()),
        }
        known["held_pressure"] = float(normal.pressure.max())
        if self.lowering is not None:
            known["held_lowering"] = self.lowering
        if not any(self.path):  # symmetry alone
            del known["tangential_displacement"]
        before = last_visit(self.path)
        if before is not None:
            known["energy_of_cycle"] = float(self.energies[-1] - self.energies[before])
        if self.tau1 is not None:
            known["edge_tension"] = float(np.nanmax(self.surface.sx))
            known["tau1_slip"] = self.tau1.value
            known |= self.fatigue()
        return known

    def amplitude(self, x: np.ndarray) -> np.ndarray:
        """Of slip (k,) [m] at x (k,) [m]: half of what a cycle runs through; without one what was
        slipped, as much as in a cycle between the load and its opposite."""
        before = last_visit(self.path)
        span = np.abs(self.slips[-1])
        if before is not None:
            span = 0.5 * np.ptp(self.slips[before:], axis=0)
        first, after = runs_of(self.states[-1].normal.pressure > 0.0)
        inner = np.minimum(first + 1, after - 1), np.maximum(after - 2, first)
        sides = (first - 1, first, inner[0]), (after, after - 1, inner[1])
        for outside, end, beside in sides if self.is_stepped else ():  # straight on to an end
            span[outside] = np.maximum(2.0 * span[end] - span[beside], 0.0)
        return np.interp(x, self.grid.x, span)

    def fatigue(self) -> dict[str, float]:
        """Ruiz' parameter at the end of the path, and with a cycle Smith, Watson and Topper's."""
        amplitude, last = self.amplitude(self.x), self.surface
        known = {"ruiz": ruiz(last.sx, last.txz, amplitude)}
        if self.opposite is not None:
            parameter = smith_watson_topper(last, self.opposite, self.material)
            known["smith_watson_topper"] = parameter
        return {name: float(np.nanmax(values)) for name, values in known.items()}

    @property
    def places(self) -> dict[str, tuple[float, ...]]:
        """Of the largest [m]."""
        if self.tau1 is None:
            return {}
        largest = float(self.x[np.nanargmax(self.surface.sx)])
        return {"edge_tension": (largest,), "tau1_slip": (self.tau1.x, self.tau1.z)}


def last_visit(path: tuple[float, ...]) -> int | None:
    """Where a path was last at its final load, before; None if never."""
    return next((k for k in reversed(range(len(path) - 1)) if path[k] == path[-1]), None)


def half_plane_slip(
    problem: Problem, level: Level, window: Window | None, increments: int
) -> SlippedLevel:
    """Of two half-planes on the pressure elements of a level."""
    grid, hardness = level.grid, problem.constraints().hardness
    gap = grid.hat_integrals(problem.gap, problem.knots)
    bodies = problem.modulus, problem.dundurs_beta, problem.largest_friction, hardness
    pair = half_planes(grid, gap, *bodies)
    slipped = slipped_level(problem, grid, pair, increments)
    if window is None:
        return slipped
    state, x = slipped.states[-1], surface_places(problem, slipped, window)
    beside, bulk = _traction_stress(problem, grid, state, -1), bulk_stress(problem, -1)
    searched = search_window(problem, window)
    normal = hats_field(grid, state.normal.pressure, searched)
    traction = hats_field(grid, state.traction, searched).stress.traction
    below = np.meshgrid(normal.x, normal.z)
    stress = normal.stress.normal.plus(1.0, traction)
    stress = stress.plus(1.0, ends_stress(problem, grid, state)(*below))
    stress = StressState(stress.sx + bulk, stress.sz, stress.txz)
    tau1 = stress_maxima(
        grid.x,
        state.normal.pressure,
        0.0,
        StressField(normal.x, normal.z, stress),
        problem.scene.body.poissons_ratio,
        beside=beside,
    ).tau1

    def surface(number: int) -> StressState:
        at, top = slipped.states[number], (x, np.zeros_like(x))
        pressed = friction_stress_at(grid.x, at.normal.pressure, *top).normal
        loaded = pressed.plus(1.0, _traction_stress(problem, grid, at, number)(*top))
        return with_cusps(problem, grid, at, x, loaded)

    return with_surface(problem, replace(slipped, tau1=tau1, x=x), surface)


def with_surface(
    problem: Problem, slipped: SlippedLevel, surface: Callable[[int], StressState]
) -> SlippedLevel:
    """With stresses (k,) of the surface at the level's places x under the last load, and at the
    other end of the last cycle, where the load is farthest from the final one, of what gives them
    under each load of the path."""
    path, other = problem.scene.partial_slip.path, None
    if (before := last_visit(path)) is not None:
        other = surface(max(range(before, len(path)), key=lambda k: abs(path[k] - path[-1])))
    return replace(slipped, surface=surface(-1), opposite=other)


def bulk_stress(problem: Problem, number: int) -> float:
    """Of the body under a load of the history [Pa]."""
    slip = problem.scene.partial_slip
    return slip.bulk_stress * slip.path[number] / slip.largest


def steps_of(problem: Problem, unlike: bool, increments: int) -> Iterator[tuple[Loads, ...]]:
    """The steps to each of the scene's loads; alike bodies take one, and are pressed by one."""
    load, slip = problem.hertz.load_per_length, problem.scene.partial_slip
    limit = problem.largest_friction * load
    strain = slip.bulk_stress / problem.scene.body.material.plane_strain_modulus / slip.largest
    first = pressed_in(load, increments if unlike else 1)
    for before, after in pairwise((0.0, *slip.path)):
        count = max(1, ceil(increments * abs(after - before))) if unlike else 1
        shares = before + (after - before) * np.arange(1, count + 1) / count
        steps = tuple(Loads(load, share * limit, share * strain) for share in map(float, shares))
        yield first + steps
        first = ()


def slipped_level(
    problem: Problem, grid: HatGrid, pair: SurfacePair, increments: int
) -> SlippedLevel:
    state, work, coarsest = None, 0.0, problem.grid(problem.pitches[0]).x[[0, -1]]
    states, energies, moved, slips = [], [], [], []
    # alike bodies touch where they did: beside an end of contact they move as at it
    slipped, touched = np.zeros(grid.count), True
    for steps in steps_of(problem, pair.raised is not None, increments):
        # what slips on the whole way, under one normal load: where it begins is read from it as
        # from a gap, whatever the steps
        on_the_way, pressed = np.zeros(grid.count), None
        for loads in steps:
            before, state = state, stepped(pair, state, loads)
            work += state.work
            if pair.raised is not None:
                touched = state.normal.pressure > 0.0
                if before is not None:
                    touched &= before.normal.pressure > 0.0
            slipped = slipped + np.where(touched, state.slip, 0.0)
            on_the_way = state.slip + (on_the_way if loads.normal == pressed else 0.0)
            pressed = loads.normal
        states.append(replace(state, slip=on_the_way))
        slips.append(slipped)
        energies.append(work)
        carried = pair.carried(state.normal.pressure, state.traction)
        moved.append(state.displacement - np.interp(coarsest, grid.x, carried).mean())
    zones = tuple(stick_zones(grid.x, state, pair.friction) for state in states)
    return SlippedLevel(
        path=problem.scene.partial_slip.path,
        grid=grid,
        states=tuple(states),
        zones=zones,
        energies=np.array(energies),
        displacements=np.array(moved),
        is_stepped=pair.raised is not None,
        material=(problem.scene.coating or problem.scene.body).material,
        slips=np.array(slips),
    )


def surface_places(problem: Problem, slipped: SlippedLevel, window: Window) -> np.ndarray:
    """x (k,) [m] of grid, window and about ends of contact, where sx of the surface is largest."""
    state = slipped.states[-1]
    ends = ends_of(problem, slipped.grid, state.normal).patches
    patches = contact_patches(slipped.grid.x, state.normal.pressure, state.normal.gap)
    edges = np.concatenate([patches.ravel(), *(patch.ends for patch in ends)])
    beside = slipped.grid.pitch * BESIDE_AN_END
    near = (edges[:, None] + beside).ravel()
    return np.unique(np.concatenate([window.x, slipped.grid.x, near]))


def with_cusps(
    problem: Problem, grid: HatGrid, state: SlipState, x: np.ndarray, surface: StressState
) -> StressState:
    """Stresses of the surface at x (k,) [m] with what they lack at ends of contact, which slip."""
    pressed, dragged = left_out_at_ends(problem, grid, state.normal, x)
    return replace(surface, sx=surface.sx + pressed + traction_share(state, grid)(x) * dragged)


def traction_share(state: SlipState, grid: HatGrid) -> Callable[[np.ndarray], np.ndarray]:
    """q / p at x (k,) [m], that of the nearest node in contact."""
    touching = state.normal.pressure > 0.0
    nodes = grid.x[touching]
    share = state.traction[touching] / state.normal.pressure[touching]
    middles = 0.5 * (nodes[1:] + nodes[:-1])
    return lambda x: share[np.searchsorted(middles, x)]


def ends_stress(problem: Problem, grid: HatGrid, state: SlipState) -> Beside:
    """What hats leave out next to the ends of contact, where q / p is that of the nearest node."""
    ends, share = ends_of(problem, grid, state.normal), traction_share(state, grid)

    def stress(x: np.ndarray, z: np.ndarray) -> StressState:
        parts = FrictionStress.of(ends.parts(x, z))
        return parts.normal.plus(share(x), parts.traction)

    return stress


def _traction_stress(problem: Problem, grid: HatGrid, state: SlipState, number: int) -> Beside:
    """Stresses of the traction, of the ends and of the bulk, under a load of the path."""
    ends, bulk = ends_stress(problem, grid, state), bulk_stress(problem, number)

    def stress(x: np.ndarray, z: np.ndarray) -> StressState:
        traction = friction_stress_at(grid.x, state.traction, x, z).traction
        both = traction.plus(1.0, ends(x, z))
        return StressState(both.sx + bulk, both.sz, both.txz)

    return stress
