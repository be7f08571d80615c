"""Passes on one level of refinement: the body, the row of places, and what is read of each pass.

Nomenclature: a half-width and p0 peak pressure of the smooth contact, k = Y/sqrt(3) yield stress in
shear by von Mises, ep plastic strain."""

from dataclasses import dataclass, replace
from time import process_time
from typing import TYPE_CHECKING

import numpy as np

from analytic.contact.patches import contact_patches
from analytic.exact.shakedown import peak_carried
from analytic.grid import HatGrid, roller_gap
from analytic.profile import surface
from comparisons.common.errors import SceneError
from comparisons.common.progress import Stages
from comparisons.common.tasks import Here
from comparisons.figures.quantity import MODELS
from comparisons.models.nearest_operator import nearest_operator, solve_on
from comparisons.models.plan import make_plan
from comparisons.models.problem import Levels, Problem, mean_height, problem_of, surface_ends

if TYPE_CHECKING:
    from fem.nonlinear.cycles import CycledBody, CyclePass
    from fem.nonlinear.plasticity import PlasticState

COARSEST = 4.0  # pressure elements, and places, on a half-width where smooth bodies roll, level 1
DEPTH = 1.3  # half-widths: refined down to there, where the roller travels
MIDDLE = 0.125  # of the travel, to both sides: what lies there has been rolled over alike
AXIS = 0.15  # half-widths to both sides of a roller that does not travel: its profile of stresses
PROFILE_DEPTH, PROFILE_STEP = 2.0, 0.1  # half-widths: of the profile of residual stresses
# Seconds of an iteration and of each of its unknowns, and iterations a place: measured from 5 000
# to 60 000 unknowns.
ITERATION, EACH_UNKNOWN, ITERATIONS = 1e-3, 6e-7, 26.0


@dataclass(frozen=True)
class CycledLevel:
    """The passes on one level; arrays (m,) have an entry a pass."""

    pitch: float  # of the pressure elements [m]
    unknowns: int
    seconds: float  # of the processor
    places: int  # of the roller in a pass
    flow: np.ndarray  # largest equivalent plastic strain that a pass adds, to and fro
    net: np.ndarray  # largest equivalent of the change of plastic strain by a pass
    work: np.ndarray  # [J/m] of the contact on the body
    plastic_work: np.ndarray  # [J/m]
    stored: np.ndarray  # [J/m] elastic energy that a pass leaves more
    residual: np.ndarray  # [Pa] largest compression sx without the roller, negative
    residual_depth: np.ndarray  # [m]
    peak: np.ndarray  # [Pa] largest pressure, mean over neighbouring hats
    length: np.ndarray  # [m] in contact
    carried: float  # p0/k that the residual stresses left carry without flow; nan: not known
    x: np.ndarray  # (n,) [m] of the pressure elements
    height: np.ndarray  # (n,) [m] mean heights before
    lowering: np.ndarray  # (2, n) [m] by the first pass and by all
    pressure: np.ndarray  # (2, n) [Pa] in the first pass and in the last
    z: np.ndarray  # (j,) [m] depths of the profile
    profile: np.ndarray  # (2, j, 2) [Pa] sx and sy there, after the first pass and after all

    @property
    def balance(self) -> np.ndarray:
        """Work less what flow took and what is stored, over the plastic work of the first pass."""
        return (self.work - self.plastic_work - self.stored) / (self.plastic_work[0] or 1.0)


def cycled_problem(problem: Problem) -> Problem:
    """The problem of a scene's passes: flowing, at its largest friction coefficient, with pressure
    elements wherever the roller goes. Raises SceneError where that is beyond the trace."""
    scene, cycles = problem.scene, problem.scene.cycles
    half_width = problem.hertz.half_width
    travel = cycles.distance(half_width)
    fields: dict[str, object] = {
        "cycles": None,
        "finite_element.plastic": True,
        "load.friction": max(scene.load.friction),
    }
    if travel:
        range_now = 0.5 * travel / half_width + 1.0
        fields["stress"] = {"depth": DEPTH, "half_range": range_now}
        if scene.profile is None:
            fields["resolution"] = {"elements": COARSEST}
    elif scene.stress is None:
        fields["stress"] = {}
    load = problem.hertz.load_per_length
    levels = Levels(max(2, cycles.levels))
    posed = problem_of(scene.changed(fields), problem.surface, load, levels)
    low, high = posed.extent[0] - 0.5 * travel, posed.extent[1] + 0.5 * travel
    start, stop = surface_ends(posed)
    if travel and (low < start or high > stop):
        raise SceneError(
            f"{scene.source}: cycles.travel: is {travel:.3g} m, and the contact would reach from "
            f"{low:.3g} m to {high:.3g} m of a body from {start:.3g} m to {stop:.3g} m; allowed is "
            "less, or a longer trace"
        )
    return replace(posed, extent=(low, high))


def places_of(problem: Problem, travel: float, number: int) -> np.ndarray:
    """x [m] of the roller on a level from 1, in turn."""
    if not travel:
        return np.zeros(1)
    step = problem.hertz.half_width / (COARSEST * 2.0 ** (number - 1))
    return np.linspace(-0.5, 0.5, max(3, round(travel / step) + 1)) * travel


def expected_seconds(problem: Problem) -> float:
    """Of all levels of the passes of a scene, by the laws of cost."""
    from comparisons.models.finite_element.cost import expected
    from comparisons.models.finite_element.mesh import Refinement

    cycles, posed, total = problem.scene.cycles, cycled_problem(problem), 0.0
    plan, patches = make_plan(posed, MODELS), np.array([posed.extent])
    travel = cycles.distance(problem.hertz.half_width)
    for number in range(1, cycles.levels + 1):
        cost = expected(posed, plan, Refinement(posed.pitches[number - 1]), patches)
        places = len(places_of(posed, travel, number)) - 1
        moving = places * ITERATIONS * (ITERATION + EACH_UNKNOWN * cost.unknowns)
        total += cost.seconds + cycles.passes * moving
    return total


def solved_level(here: Here, problem: Problem, number: int, passes: int, travel: float) -> CycledLevel:
    """The passes on a level from 1, of `cycled_problem`; a task. Raises FemError, MeshError."""
    from comparisons.models.finite_element.bodies import BodyCache, bodies_of
    from comparisons.models.finite_element.contact import mutual_compliance
    from comparisons.models.finite_element.mesh import Refinement
    from fem.nonlinear.cycles import CycledBody
    from fem.nonlinear.plasticity import ElasticPlastic
    from fem.nonlinear.press_plastic import TRAVEL
    from fem.solver.mumps import FemError

    here.callback(f"cycles: level {number}")
    began, scene, load = process_time(), problem.scene, problem.hertz.load_per_length
    grid, friction = problem.grid(problem.pitches[number - 1]), scene.load.friction[0]
    places = places_of(problem, travel, number)
    gaps = [_gap(problem, grid, place) for place in places]
    model = nearest_operator(scene, grid, friction if scene.finite_element.coupled else 0.0)
    guess = solve_on(model, gaps[0], grid.weights, problem.widest)
    patches = contact_patches(grid.x, guess.pressure, guess.gap)
    if travel:
        patches = np.array([problem.extent])
    plan = make_plan(problem, MODELS)
    bodies = bodies_of(problem, plan, Refinement(grid.pitch), patches, Stages(), BodyCache())
    operator = mutual_compliance(problem, bodies, grid)
    roller = operator.parts[1].compliance if len(operator.parts) > 1 else None
    metal = ElasticPlastic(scene.body.material, scene.body.flow_stress())
    body = CycledBody(
        operator.rough, metal, gaps[0], grid.weights, guess.pressure, friction, roller, TRAVEL
    )
    reader = _Reader(problem, grid, body, travel)
    for count in range(1, passes + 1):
        here.callback(f"cycles: level {number}, pass {count} of {passes}")
        before = body.body.state
        done = body.press(load, gaps if travel else (), *reader.alike)
        if done.loaded.pressure[[0, -1]].any():
            raise FemError("the contact of the flowing body reaches beyond the pressure elements")
        reader.read(before, done)
    return reader.level(len(places), sum(b.unknowns for b in bodies.all), process_time() - began)


def _gap(problem: Problem, grid: HatGrid, place: float) -> np.ndarray:
    """Weighted gap (n,) [m^2] under the roller at a place [m]."""
    profile = problem.surface.profile
    curve = None if profile is None else surface(profile)
    shifted = None if curve is None else lambda from_centre: curve(from_centre + place)
    shape = problem.scene.finite_element.roller_shape
    gap = roller_gap(problem.scene.roller.radius, shifted, shape)
    return grid.hat_integrals(lambda x: gap(x - place), problem.knots)


class _Reader:
    """What is read of each pass, in the middle of what was rolled over, or of a roller that stays
    everywhere; profiles over depth there, or below the roller's place."""

    def __init__(self, problem: Problem, grid: HatGrid, body: "CycledBody", travel: float) -> None:
        self.problem, self.grid, self.body, self.travel = problem, grid, body, travel
        x, self.depth = body.body.points.T
        half_width = problem.hertz.half_width
        self.area = body.body.areas.ravel()
        self.inside = np.abs(x) <= (MIDDLE * travel if travel else np.inf)
        below = np.abs(x) <= (MIDDLE * travel if travel else AXIS * half_width)
        edges = np.arange(0.0, PROFILE_DEPTH, PROFILE_STEP) * half_width
        layer = np.digitize(self.depth, np.append(edges, PROFILE_DEPTH * half_width)) - 1
        self.layer = np.where(below & (layer < len(edges)), layer, len(edges))
        # a smooth body that is rolled over is alike everywhere then
        endless = travel and problem.scene.profile is None
        self.alike = (self.inside, 0.5 * grid.pitch) if endless else ()
        if endless:
            self.inside = np.ones_like(self.inside)
        self.rows: list[tuple[float, ...]] = []
        self.lowering: list[np.ndarray] = []
        self.pressure: list[np.ndarray] = []
        self.profiles: list[np.ndarray] = []

    def read(self, before: "PlasticState", done: "CyclePass") -> None:
        """A pass from a plastic state on."""
        from fem.nonlinear.cycles import plastic_parts
        from fem.nonlinear.press_plastic import averaged_pressure

        now, inside = done.released.state, self.inside
        change = plastic_parts(now) - plastic_parts(before)
        net = np.sqrt(2.0 / 3.0 * (change**2 @ [1.0, 1.0, 0.5, 1.0]))
        sx, sy = self._residual(done)
        lowest = np.where(inside, sx, 0.0).argmin()
        pressure = averaged_pressure(done.loaded.pressure)
        values = (now.equivalent - before.equivalent)[inside].max(), net[inside].max()
        values += done.work, done.plastic_work, done.stored, sx[lowest], self.depth[lowest]
        self.rows.append((*values, pressure.max(), self._length(done)))
        self.lowering.append(done.lowering)
        self.pressure.append(pressure)
        self.profiles.append(np.column_stack([self._layers(sx), self._layers(sy)]))

    def level(self, places: int, unknowns: int, seconds: float) -> CycledLevel:
        names = "flow net work plastic_work stored residual residual_depth peak length".split()
        columns = dict(zip(names, np.array(self.rows).T, strict=True))
        ends = [0, -1]
        return CycledLevel(
            pitch=self.grid.pitch,
            unknowns=unknowns,
            seconds=seconds,
            places=places,
            carried=self._carried(),
            x=self.grid.x,
            height=mean_height(self.problem, self.grid),
            lowering=np.array(self.lowering)[ends],
            pressure=np.array(self.pressure)[ends],
            z=self._layers(self.depth),
            profile=np.array(self.profiles)[ends],
            **columns,
        )

    def _residual(self, done: "CyclePass") -> tuple[np.ndarray, np.ndarray]:
        """sx and sy [Pa] at the body's points without the roller."""
        left = done.released
        inside, across = self.body.body.stress(left.displacement, left.state)
        return inside[:, 0], across

    def _length(self, done: "CyclePass") -> float:
        """In contact [m], of the place whose pressures are read."""
        loaded = done.loaded
        patches = contact_patches(self.grid.x, loaded.pressure, done.opening)
        return float(np.ptp(patches, axis=1).sum())

    def _layers(self, values: np.ndarray) -> np.ndarray:
        """Means (j,) over layers of depth of what stands at the points."""
        count = self.layer.max()
        area = np.bincount(self.layer, self.area, count + 1)[:count]
        return np.bincount(self.layer, self.area * values, count + 1)[:count] / area

    def _carried(self) -> float:
        """Of a smooth body that was rolled over, by the means over depth."""
        from fem.nonlinear.cycles import plastic_parts

        if not self.travel or self.problem.scene.profile is not None:
            return np.nan
        body, state = self.body.body, self.body.body.state
        sx, sy = self.profiles[-1].T
        back = 2.0 / 3.0 * body.metal.hardening.kinematic * plastic_parts(state)
        back[:, 2] *= 0.5  # of the shear strain gxz
        rest = np.column_stack([sx, 0.0 * sx, 0.0 * sx, sy])
        rest -= np.column_stack([self._layers(part) for part in back.T])
        shear = body.metal.hardening.yield_stress / 3**0.5
        flow = self._layers(body.metal.hardening.stress(state.equivalent)) / 3**0.5
        friction, nu = self.problem.scene.load.friction[0], body.metal.elastic.poissons_ratio
        z = self._layers(self.depth) / self.problem.hertz.half_width
        return peak_carried(z, rest / shear, flow / shear, friction, nu)
