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
from analytic.stress.fatigue import ruiz, smith_watson_topper
from analytic.stress.points import friction_stress_at
from analytic.stress_state import Extremum, StressState
from comparisons.models.level import Level
from comparisons.models.operators import patches_of
from comparisons.models.problem import Problem
from comparisons.models.readings import ends_of, largest_tau1, left_out_at_ends

# Pitches from an end of contact where the surface's stress is looked at too: tension, traction and
# slip together are largest between the last nodes
BESIDE_AN_END = np.arange(-16, 17) / 8.0
Beside = Callable[[np.ndarray, np.ndarray], StressState]


@dataclass(frozen=True)
class SlippedLevel:
    """After each of the scene's m loads."""

    path: tuple[float, ...]  # the loads, over that of sliding
    grid: HatGrid
    friction: float
    # slip and work of all steps from the load before; displacement of the roller against the ends
    # of the coarsest grid
    states: tuple[SlipState, ...]
    slips: np.ndarray  # (m, n) [m] of the roller over the body while they touched
    is_stepped: bool  # whether the loads come by increments
    material: Material  # of the body's surface
    # [m] of the body's surface under the roller at the end; None: it has no base
    lowering: float | None = None
    tau1: Extremum | None = None  # largest, at the end; with [stress]
    x: np.ndarray = field(default_factory=lambda: np.empty(0))  # (k,) [m]
    # (k,) of the surface there; at the other end of the cycle (None: there is no cycle)
    surface: StressState | None = None
    opposite: StressState | None = None

    @cached_property
    def zones(self) -> tuple[np.ndarray, ...]:
        """Zones (k, 2) [m] that stick, of each load."""
        return tuple(stick_zones(self.grid.x, state, self.friction) for state in self.states)

    @property
    def energies(self) -> np.ndarray:
        """(m,) [J/m] lost to friction from the first touch on."""
        return np.cumsum([state.work for state in self.states])

    @property
    def displacements(self) -> np.ndarray:
        """(m,) [m] of the roller."""
        return np.array([state.displacement for state in self.states])

    @property
    def worst(self) -> float:
        """Largest residual of all states."""
        return max(state.residual for state in self.states)

    @cached_property
    def figures(self) -> dict[str, float]:
        """Figures at the end of the path of loads; of fatigue Ruiz' parameter, and with a cycle
        Smith, Watson and Topper's."""
        normal, stuck = self.states[-1].normal, float(np.ptp(self.zones[-1], axis=1).sum())
        edges = contact_patches(self.grid.x, normal.pressure, normal.gap)
        touching = self.grid.x[normal.pressure > 0.0]
        known = {
            "stick_length": stuck,
            "stick_ratio": stuck / float(np.ptp(edges, axis=1).sum()),
            "energy_lost": float(self.energies[-1]),
            "slip_amplitude": float(self.amplitude(np.append(touching, edges)).max()),
            "held_pressure": float(normal.pressure.max()),
        }
        if any(self.path):  # else by symmetry alone
            known["tangential_displacement"] = self.states[-1].displacement
        if self.lowering is not None:
            known["held_lowering"] = self.lowering
        before = last_visit(self.path)
        if before is not None:
            known["energy_of_cycle"] = float(self.energies[-1] - self.energies[before])
        if self.tau1 is not None:
            last = self.surface
            largest = {
                "edge_tension": last.sx,
                "tau1_slip": self.tau1.value,
                "ruiz": ruiz(last.sx, last.txz, self.amplitude(self.x)),
            }
            if self.opposite is not None:
                fatigue = smith_watson_topper(last, self.opposite, self.material)
                largest["smith_watson_topper"] = fatigue
            known |= {name: float(np.nanmax(values)) for name, values in largest.items()}
        return known

    def amplitude(self, x: np.ndarray) -> np.ndarray:
        """Amplitude of slip (k,) [m] at x (k,) [m]: half of what a cycle runs through; without one
        what was slipped, as much as in a cycle between the load and its opposite."""
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

    @property
    def places(self) -> dict[str, tuple[float, ...]]:
        """Positions of the largest stresses [m]."""
        if self.tau1 is None:
            return {}
        largest = float(self.x[np.nanargmax(self.surface.sx)])
        return {"edge_tension": (largest,), "tau1_slip": (self.tau1.x, self.tau1.z)}


def last_visit(path: tuple[float, ...]) -> int | None:
    """Index at which a path was last at its final load, before; None if never."""
    return next((k for k in reversed(range(len(path) - 1)) if path[k] == path[-1]), None)


def half_plane_slip(problem: Problem, level: Level, increments: int) -> SlippedLevel:
    """Slip of two half-planes on the pressure elements of a level."""
    grid, hardness = level.grid, problem.constraints().hardness
    gap = grid.hat_integrals(problem.gap, problem.knots)
    bodies = problem.modulus, problem.dundurs_beta, problem.largest_friction, hardness
    pair = half_planes(grid, gap, *bodies)
    slipped = slipped_level(problem, grid, pair, increments)
    if problem.window is None:
        return slipped

    def dragged(number: int) -> Beside:
        """Stresses of all but the pressure."""
        ends = ends_stress(problem, grid, slipped.states[number], bulk_stress(problem, number))
        line = grid.x, slipped.states[number].traction
        return lambda *at: friction_stress_at(*line, *at).traction.plus(1.0, ends(*at))

    def surface(number: int, x: np.ndarray) -> StressState:
        pressure, top = slipped.states[number].normal.pressure, (x, np.zeros_like(x))
        return friction_stress_at(grid.x, pressure, *top).normal.plus(1.0, dragged(number)(*top))

    pressure = slipped.states[-1].normal.pressure
    tau1 = largest_tau1(problem, grid, pressure, 0.0, dragged(-1))
    return with_surface(problem, slipped, tau1, surface)


def with_surface(
    problem: Problem,
    slipped: SlippedLevel,
    tau1: Extremum,
    stress: Callable[[int, np.ndarray], StressState],
    cusps: bool = True,
) -> SlippedLevel:
    """Add the largest tau1 at the end, and stresses of the surface at the x of grid, window and
    about ends of contact, where sx is largest: under the last load, and at the other end of the
    last cycle, where the load is farthest from the final one.

    stress  (k,) [Pa] of the surface under a load of the path, by its number, at x (k,) [m]
    cusps   whether these lack what is next to ends of contact, which slip"""
    path, grid, last = slipped.path, slipped.grid, slipped.states[-1].normal
    curves = (patch.ends for patch in ends_of(problem, grid, last).patches)
    edges = np.concatenate([patches_of(grid, last).ravel(), *curves])
    near = (edges[:, None] + grid.pitch * BESIDE_AN_END).ravel()
    x = np.unique(np.concatenate([problem.window.x, grid.x, near]))

    def surface(number: int) -> StressState:
        state, loaded = slipped.states[number], stress(number, x)
        if not cusps:
            return loaded
        pressed, dragged = left_out_at_ends(problem, grid, state.normal, x)
        return replace(loaded, sx=loaded.sx + pressed + traction_share(state, grid)(x) * dragged)

    other = None
    if (before := last_visit(path)) is not None:
        other = surface(max(range(before, len(path)), key=lambda k: abs(path[k] - path[-1])))
    return replace(slipped, tau1=tau1, x=x, surface=surface(-1), opposite=other)


def bulk_stress(problem: Problem, number: int) -> float:
    """Bulk stress of the body under a load of the history [Pa]."""
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
    state, coarsest = None, problem.grid(problem.pitches[0]).x[[0, -1]]
    states, slips, slipped = [], [], np.zeros(grid.count)
    is_stepped = pair.raised is not None
    for steps in steps_of(problem, is_stepped, increments):
        # what slips on the whole way, under one normal load: where it begins is read from it as
        # from a gap, whatever the steps
        on_the_way, work, pressed = np.zeros(grid.count), 0.0, None
        for loads in steps:
            before, state = state, stepped(pair, state, loads)
            work += state.work
            # alike bodies touch where they did: beside an end of contact they move as at it
            pressures = [one.normal.pressure for one in (before, state) if one is not None]
            touched = np.min(pressures, axis=0) > 0.0 if is_stepped else True
            slipped = slipped + np.where(touched, state.slip, 0.0)
            on_the_way = state.slip + (on_the_way if loads.normal == pressed else 0.0)
            pressed = loads.normal
        carried = pair.carried(state.normal.pressure, state.traction)
        moved = state.displacement - float(np.interp(coarsest, grid.x, carried).mean())
        states.append(replace(state, slip=on_the_way, work=work, displacement=moved))
        slips.append(slipped)
    return SlippedLevel(
        path=problem.scene.partial_slip.path,
        grid=grid,
        friction=pair.friction,
        states=tuple(states),
        slips=np.array(slips),
        is_stepped=is_stepped,
        material=(problem.scene.coating or problem.scene.body).material,
    )


def traction_share(state: SlipState, grid: HatGrid) -> Callable[[np.ndarray], np.ndarray]:
    """q / p at x (k,) [m], that of the nearest node in contact."""
    touching = state.normal.pressure > 0.0
    nodes = grid.x[touching]
    share = state.traction[touching] / state.normal.pressure[touching]
    middles = 0.5 * (nodes[1:] + nodes[:-1])
    return lambda x: share[np.searchsorted(middles, x)]


def ends_stress(problem: Problem, grid: HatGrid, state: SlipState, bulk: float = 0.0) -> Beside:
    """Stresses that hats leave out next to the ends of contact, where q / p is that of the nearest
    node, and the bulk's sx [Pa]."""
    ends, share = ends_of(problem, grid, state.normal), traction_share(state, grid)

    def stress(x: np.ndarray, z: np.ndarray) -> StressState:
        loaded = ends.stress(share(x), x, z)
        return replace(loaded, sx=loaded.sx + bulk)

    return stress
