"""The ways to solve a scene's contact that `cost` compares.

In: a scene's problem. Out: the methods that apply to it, each with pitches of pressure elements
[m], the scene's, coarser and finer ones by powers of two; and a level by one of them."""

from dataclasses import dataclass, replace

import numpy as np

from comparisons.common.progress import Stages
from comparisons.models.forecast import expected_level
from comparisons.models.half_plane import half_plane_level
from comparisons.models.level import Level, flowing_contact
from comparisons.models.plan import make_plan
from comparisons.models.problem import Problem
from comparisons.models.window import window_of
from comparisons.studies.ladder.operators import (
    carried_deformed,
    carried_linear,
    operator_level,
)
from comparisons.studies.model_error.catalogue import contained

HALF_PLANE_PITCHES = (2.0, 1.0, 0.5, 0.25, 0.125, 0.0625)  # of the scene's coarsest
FINITE_ELEMENT_PITCHES = (2.0, 1.0, 0.5, 0.25)
HAT, OPERATOR, DEFORMED = "hat", "operator", "deformed"
# Fields of finite elements that assume small, elastic strains.
LINEAR = {"finite_element.deformation": "linear", "finite_element.plastic": False}


@dataclass(frozen=True)
class SolutionMethod:
    """One way to solve a contact."""

    name: str  # in table and picture
    model: str  # half_plane | finite_element
    # hat of pressure on a half-plane; operator: on a layer, a coating or under an exact circle;
    # deformed: on the deformed surface; or P1 | P2 | P3
    element: str
    linear: bool = False  # finite elements at small, elastic strains, whatever the scene has

    def posed(self, problem: Problem) -> Problem:
        """The problem that these finite elements solve."""
        fields = {"finite_element.element": self.element} | (LINEAR if self.linear else {})
        return replace(problem, scene=problem.scene.unchecked(fields))

    def carried(self, problem: Problem) -> frozenset[str]:
        """What an operator, or the deformed surface, has of the scene's finite elements."""
        scene, effects = problem.scene, contained(problem.scene)
        if self.element == DEFORMED:
            return carried_deformed(problem, effects)
        return carried_linear(scene, effects)

    def pitches(self, problem: Problem) -> tuple[float, ...]:
        """From coarse to fine."""
        factors = HALF_PLANE_PITCHES if self.model == "half_plane" else FINITE_ELEMENT_PITCHES
        return tuple(factor * problem.pitches[0] for factor in factors)

    def expected_seconds(self, problem: Problem, pitch: float) -> float:
        """What a level of finite elements will take, by the laws of cost."""
        if self.model == "half_plane":
            return 0.0
        problem = self.posed(problem)
        flows = problem.scene.finite_element.plastic
        patches = flowing_contact(problem) if flows else np.array([problem.extent])
        plan = make_plan(problem, (self.model,))
        return expected_level(self.model, problem, plan, pitch, patches).seconds


HALF_PLANE = SolutionMethod("half-plane", "half_plane", HAT)
LAYERED = SolutionMethod("half-plane, layered", "half_plane", OPERATOR)
DEFORMING = SolutionMethod("half-plane, deformed", "half_plane", DEFORMED)
P1, P2, P3 = (SolutionMethod(f"elements {p}", "finite_element", p) for p in ("P1", "P2", "P3"))
P2_LINEAR = SolutionMethod("elements P2, linear", "finite_element", "P2", linear=True)


def methods_of(problem: Problem) -> tuple[SolutionMethod, ...]:
    """Those that apply, the half-plane's first: only P2 takes bodies that yield or deform
    finitely."""
    scene, settings = problem.scene, problem.scene.finite_element
    one_contact = len(scene.load.friction) == 1 or not settings.coupled
    applies = {
        HALF_PLANE: True,
        LAYERED: one_contact and LAYERED.carried(problem),
        DEFORMING: one_contact and DEFORMING.carried(problem),
        P1: not settings.nonlinear,
        P2_LINEAR: settings.nonlinear,
        P2: True,
        P3: not settings.nonlinear,
    }
    return tuple(method for method, does in applies.items() if does)


def is_half_plane_problem(problem: Problem) -> bool:
    """Whether both models solve the same problem, so that their limits are the same."""
    scene, settings = problem.scene, problem.scene.finite_element
    unbounded = scene.body.thickness is None and scene.body.width is None and scene.coating is None
    moves = bool(any(scene.load.friction) and problem.dundurs_beta)
    same_traction = settings.coupled == scene.load.coupled or not moves
    same_shapes = (settings.roller_shape, settings.roller_body) == ("parabola", "half-plane")
    return unbounded and not settings.nonlinear and same_shapes and same_traction


def solved(
    method: SolutionMethod, problem: Problem, pitch: float, half_block: bool = False
) -> Level:
    """A level, without its mesh; `half_block` holds an unbounded body at half the distance."""
    window, stages = window_of(problem) if problem.scene.stress is not None else None, Stages()
    if method.element == HAT:
        return half_plane_level(problem, pitch, window, stages, fields=False)
    if method.element in (OPERATOR, DEFORMED):
        frictions, held = problem.scene.load.friction, method.carried(problem)
        return operator_level(problem, held, frictions, pitch, window)
    from comparisons.models.finite_element.level import finite_element_level
    from comparisons.models.finite_element.mesh import Refinement

    problem = method.posed(problem)
    plan, refinement = make_plan(problem, (method.model,)), Refinement(pitch, half_block)
    level = finite_element_level(problem, plan, refinement, window, stages, fields=False)
    return replace(level, mesh=None)
