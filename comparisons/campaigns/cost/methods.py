"""The methods whose cost is measured, at which settings, and to which scenes each applies.

A setting is a pitch of pressure elements [m]: the scene's, coarser and finer by powers of two."""

from dataclasses import dataclass

from comparisons.models.problem import Problem

HALF_PLANE_PITCHES = (2.0, 1.0, 0.5, 0.25, 0.125, 0.0625)  # of the scene's coarsest
FINITE_ELEMENT_PITCHES = (2.0, 1.0, 0.5, 0.25)


@dataclass(frozen=True)
class SolutionMethod:
    """One way to solve a contact."""

    name: str  # in table and diagram
    model: str  # half_plane | finite_element
    element: str  # hat | strip of pressure; or P1 | P2 | P3

    def settings(self, problem: Problem) -> tuple[float, ...]:
        factors = HALF_PLANE_PITCHES if self.model == "half_plane" else FINITE_ELEMENT_PITCHES
        return tuple(factor * problem.pitches[0] for factor in factors)


FINEST = SolutionMethod("hats, FFT", "half_plane", "hat")  # the others' reference, where it may be
METHODS = (
    SolutionMethod("strips, FFT", "half_plane", "strip"),
    FINEST,
    *(SolutionMethod(degree, "finite_element", degree) for degree in ("P1", "P2", "P3")),
)


def why_not(method: SolutionMethod, problem: Problem) -> str | None:
    """Why a method does not apply to a scene at all, None where it does."""
    settings = problem.scene.finite_element
    if method.model == "half_plane":
        if problem.coupling and method != FINEST:
            return "friction moves the surfaces: only hats by FFT have that"
        return None
    nonlinear = settings.plastic or settings.deformation == "finite"
    if method.element != "P2" and nonlinear:
        return "bodies that yield or deform finitely take P2"
    return None


def is_half_plane_problem(problem: Problem) -> bool:
    """Whether both models solve the same problem, so that their limits are the same."""
    scene, settings = problem.scene, problem.scene.finite_element
    unbounded = scene.body.thickness is None and scene.body.width is None and scene.coating is None
    flat = settings.geometry == "flat" or scene.profile is None
    linear = settings.deformation == "linear" and not settings.plastic
    moves = bool(any(scene.load.friction) and problem.dundurs_beta)
    same_traction = settings.coupled == scene.load.coupled or not moves
    shapes = (settings.gap, settings.roller_shape, settings.roller_body)
    same_shapes = shapes == ("reference", "parabola", "half-plane")
    return unbounded and flat and linear and same_shapes and same_traction
