"""Passes on one level of refinement: what is read of each, and how they are solved.

A smooth body that is rolled over is endless, each pass steady (`fem.nonlinear.rolling`). Else the
roller is pressed on, may move along the trace, and is lifted (`fem.nonlinear.cycles`)."""

from collections.abc import Callable
from dataclasses import replace
from time import process_time
from typing import TYPE_CHECKING

import numpy as np

from analytic.contact.patches import contact_patches
from analytic.grid import HatGrid, roller_gap
from analytic.profile import surface
from comparisons.common.errors import SceneError
from comparisons.common.progress import Stages
from comparisons.common.tasks import Here
from comparisons.figures.quantity import MODELS
from comparisons.models.nearest_operator import nearest_operator, solve_on
from comparisons.models.plan import make_plan
from comparisons.models.posing import problem_of, surface_ends
from comparisons.models.problem import Levels, Problem, mean_height
from comparisons.studies.subsurface.cycles import endless
from comparisons.studies.subsurface.cycles.passes import CycledLevel, Passes

if TYPE_CHECKING:
    from fem.nonlinear.cycles import CycledBody, CyclePass
    from fem.nonlinear.plasticity import PlasticState

COARSEST = 4.0  # places of a roller that travels on a half-width, on level 1
DEPTH = 1.3  # half-widths: refined down to there, where the roller travels
MIDDLE = 0.125  # of the travel, to both sides: what lies there has been rolled over alike
AXIS = 0.15  # half-widths to both sides of the largest pressure of a roller that does not travel
PROFILE_DEPTH, PROFILE_STEP = 2.0, 0.1  # half-widths: of the profile of residual stresses
# Seconds of an iteration and of each of its unknowns, and iterations a place, from 5 000 to 60 000
# unknowns.
ITERATION, EACH_UNKNOWN, ITERATIONS = 1e-3, 6e-7, 26.0


def is_endless(problem: Problem) -> bool:
    scene = problem.scene
    return scene.cycles.kind == "roll" and scene.profile is None


def travel_of(problem: Problem) -> float:
    """What the roller travels on a trace [m]."""
    travel = problem.scene.cycles.travel
    return 0.0 if travel is None else travel.metres(problem.hertz.half_width)


def cycled_problem(problem: Problem) -> Problem:
    """The problem of a scene's passes: flowing, at its largest friction coefficient, with pressure
    elements wherever the roller goes. Raises SceneError where that is beyond the trace."""
    scene, half_width, travel = problem.scene, problem.hertz.half_width, travel_of(problem)
    friction = max(scene.load.friction)
    fields: dict[str, object] = {"cycles": None, "load.friction": friction}
    fields["finite_element.plastic"] = True
    if travel:
        fields["stress"] = {"depth": DEPTH, "half_range": 0.5 * travel / half_width + 1.0}
    elif scene.stress is None:
        fields["stress"] = {}
    load, levels = problem.hertz.load_per_length, Levels(max(2, scene.cycles.levels))
    posed = problem_of(scene.changed(fields), problem.surface, load, levels)
    low, high = posed.extent[0] - 0.5 * travel, posed.extent[1] + 0.5 * travel
    start, stop = surface_ends(posed)
    if travel and (low < start or high > stop):
        raise SceneError(
            f"{scene.source}: cycles.travel: is {travel:.3g} m, and the contact may reach from "
            f"{low:.3g} m to {high:.3g} m of a body from {start:.3g} m to {stop:.3g} m; allowed is "
            "less, or a longer trace"
        )
    return replace(posed, extent=(low, high))


def expected_seconds(problem: Problem) -> float:
    """Of all levels of the passes of a scene, by the laws of cost."""
    from comparisons.models.finite_element.cost import expected
    from comparisons.models.finite_element.mesh import Refinement

    cycles, numbers = problem.scene.cycles, range(1, problem.scene.cycles.levels + 1)
    if is_endless(problem):
        return sum(endless.expected_seconds(problem, number, cycles.passes) for number in numbers)
    posed, travel, total = cycled_problem(problem), travel_of(problem), 0.0
    plan, patches = make_plan(posed, MODELS), np.array([posed.extent])
    for number in numbers:
        cost = expected(posed, plan, Refinement(posed.pitches[number - 1]), patches)
        moves = len(_places(posed, travel, number)) - 1
        moving = moves * ITERATIONS * (ITERATION + EACH_UNKNOWN * cost.unknowns)
        total += cost.seconds + cycles.passes * moving
    return total


def solved_level(here: Here, problem: Problem, number: int) -> CycledLevel:
    """The passes of a scene on a level from 1; a task. Raises FemError, MeshError."""
    began, passes, endlessly = process_time(), problem.scene.cycles.passes, is_endless(problem)
    words = f"cycles: level {number}, pass {{}} of {passes}"
    if endlessly:
        level = endless.rolled(problem, number, lambda n: here.callback(words.format(n)))
    else:
        level = _cycled(problem, number, lambda n: here.callback(words.format(n)))
    return replace(level, seconds=process_time() - began)


def _places(problem: Problem, travel: float, number: int) -> np.ndarray:
    """x [m] of the roller on a level from 1, in turn."""
    if not travel:
        return np.zeros(1)
    step = problem.hertz.half_width / (COARSEST * 2.0 ** (number - 1))
    return np.linspace(-0.5, 0.5, max(3, round(travel / step) + 1)) * travel


def _cycled(scene_problem: Problem, number: int, begin: Callable[[int], None]) -> CycledLevel:
    """Of a roller that is pressed on, and may travel; `begin` is called with each pass."""
    from comparisons.models.finite_element.bodies import BodyCache, bodies_of
    from comparisons.models.finite_element.contact import mutual_compliance
    from comparisons.models.finite_element.mesh import Refinement
    from fem.nonlinear.cycles import CycledBody
    from fem.nonlinear.plasticity import ElasticPlastic
    from fem.nonlinear.press_plastic import TRAVEL
    from fem.solver.mumps import FemError

    problem, travel = cycled_problem(scene_problem), travel_of(scene_problem)
    scene, load, friction = (
        problem.scene,
        problem.hertz.load_per_length,
        problem.scene.load.friction[0],
    )
    grid = problem.grid(problem.pitches[number - 1])
    gaps = [_gap(problem, grid, place) for place in _places(problem, travel, number)]
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
    for count in range(1, scene_problem.scene.cycles.passes + 1):
        begin(count)
        before = body.body.state
        done = body.press(load, gaps if travel else ())
        if done.loaded.pressure[[0, -1]].any():
            raise FemError("the contact of the flowing body reaches beyond the pressure elements")
        reader.read(before, done)
    return reader.level(sum(body.unknowns for body in set(bodies.all)))


def _gap(problem: Problem, grid: HatGrid, place: float) -> np.ndarray:
    """Weighted gap (n,) [m^2] under the roller at a place [m]."""
    profile = problem.surface.profile
    curve = None if profile is None else surface(profile)
    shifted = None if curve is None else lambda from_centre: curve(from_centre + place)
    shape = problem.scene.finite_element.roller_shape
    gap = roller_gap(problem.scene.roller.radius, shifted, shape)
    return grid.hat_integrals(lambda x: gap(x - place), problem.knots)


class _Reader:
    """What is read of each pass: of flow in the middle of what was rolled over, or of a roller that
    stays everywhere; of stresses over depth there, or below the largest pressure."""

    def __init__(self, problem: Problem, grid: HatGrid, body: "CycledBody", travel: float) -> None:
        self.problem, self.grid, self.body = problem, grid, body
        x, self.depth = body.body.points.T
        half_width, self.area = problem.hertz.half_width, body.body.areas.ravel()
        self.inside = np.abs(x) <= (MIDDLE * travel if travel else np.inf)
        peak = grid.x[body.state.pressure.argmax()]
        below = self.inside if travel else np.abs(x - peak) <= AXIS * half_width
        layer = (self.depth // (PROFILE_STEP * half_width)).astype(int)
        count = round(PROFILE_DEPTH / PROFILE_STEP)
        self.layer = np.where(below & (layer < count), layer, count)
        self.rows: list[dict[str, float]] = []
        self.arrays: list[tuple[np.ndarray, ...]] = []

    def read(self, before: "PlasticState", done: "CyclePass") -> None:
        """A pass from a plastic state on."""
        from fem.nonlinear.energy import equivalent_of, plastic_parts
        from fem.nonlinear.press_plastic import averaged_pressure

        now, inside, left = done.released.state, self.inside, done.released
        net = equivalent_of(plastic_parts(now) - plastic_parts(before))
        stress, sy = self.body.body.stress(left.displacement, left.state)
        sx = stress[:, 0]
        lowest = np.where(inside, sx, 0.0).argmin()
        pressure = averaged_pressure(done.loaded.pressure)
        patches = contact_patches(self.grid.x, done.loaded.pressure, done.opening)
        self.rows.append(
            {
                "flow": (now.equivalent - before.equivalent)[inside].max(),
                "net": net[inside].max(),
                **vars(done.energies),
                "residual": sx[lowest],
                "residual_depth": self.depth[lowest],
                "peak": pressure.max(),
                "length": np.ptp(patches, axis=1).sum(),
            }
        )
        profile = np.column_stack([self._layers(sx), self._layers(sy)])
        self.arrays.append((pressure, done.lowering, profile))

    def level(self, unknowns: int) -> CycledLevel:
        """All that was read."""
        ends = zip(self.arrays[0], self.arrays[-1], strict=True)
        pressure, lowering, profile = (np.array(pair) for pair in ends)
        return CycledLevel(
            pitch=self.grid.pitch,
            unknowns=unknowns,
            seconds=0.0,
            passes=Passes.of(self.rows),
            x=self.grid.x,
            pressure=pressure,
            lowering=lowering,
            height=mean_height(self.problem, self.grid),
            z=self._layers(self.depth),
            profile=profile,
        )

    def _layers(self, values: np.ndarray) -> np.ndarray:
        """Means over layers of depth, where there are points, of what stands at the points."""
        area = np.bincount(self.layer, self.area)[:-1]
        known = np.flatnonzero(area)
        return np.bincount(self.layer, self.area * values)[known] / area[known]
