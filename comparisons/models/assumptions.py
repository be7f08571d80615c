"""What the models of a scene take for granted, in words: both alike, or the half-plane alone."""

from comparisons.models.nearest_operator import is_layered
from comparisons.models.problem import Problem
from comparisons.models.running_in import running_in_assumptions
from comparisons.scenes.scene import FiniteElementSettings


def assumptions_of(problem: Problem) -> tuple[str, ...]:
    """One sentence an assumption; where the finite elements drop one, what they have instead."""
    scene, settings = problem.scene, problem.scene.finite_element
    listed = [_deformation(settings), _gap(settings), _boundary(settings)]
    listed.append(_roller(settings, rigid=scene.roller is None))
    if scene.coating is not None:
        listed.append(
            "finite elements: a coating is bonded to the body; half-plane: the body is of its own "
            "material throughout"
        )
    if scene.running_in is not None:
        listed += running_in_assumptions(scene)
    if scene.hardness is not None:
        both = "plastic flow is a cap on the pressure (hardness)"
        listed.append(f"half-plane: {both}" if settings.plastic else both)
    if any(scene.friction):
        listed.append(_friction(problem))
    return tuple(listed)


def _deformation(settings: FiniteElementSettings) -> str:
    if settings.plastic:
        return (
            "small deformation, plane strain; half-plane: linear elasticity; finite elements: "
            "von Mises' yield with isotropic hardening"
        )
    if settings.deformation == "finite":
        return (
            "plane strain; half-plane: linear elasticity, small deformation; finite elements: "
            "neo-Hookean elasticity, finite deformation"
        )
    return "linear elasticity, small deformation, plane strain"


def _gap(settings: FiniteElementSettings) -> str:
    if settings.deformation == "finite":
        return (
            "half-plane: the gap is taken at the undeformed place; finite elements: at the "
            "current one, and the pressure acts along the current normal, by deformed area"
        )
    if settings.gap == "displaced":
        return (
            "half-plane: the gap is taken at the undeformed place; finite elements: at the "
            "displaced one, and the pressure acts along the roller's normal"
        )
    return "the gap is taken at the undeformed place, and the pressure acts along the mean normal"


def _boundary(settings: FiniteElementSettings) -> str:
    if settings.geometry == "flat":
        return "the roughness is in the gap: the boundary is flat"
    return (
        "half-plane: the roughness is in the gap; finite elements: it is the boundary, and next "
        "to it stresses are those of asperities that do not flatten"
    )


def _roller(settings: FiniteElementSettings, rigid: bool) -> str:
    parts = []
    if settings.roller_shape == "circle":
        parts.append("a circle")
    if settings.roller_body == "disc" and not rigid:
        parts.append("an elastic body of a disc's shape")
    both = "the roller is a parabola of the relative curvature"
    if not parts:
        return both
    return f"half-plane: {both}; finite elements: it is {' and '.join(parts)}"


def _friction(problem: Problem) -> str:
    scene, beta = problem.scene, problem.dundurs_beta
    product = max(scene.friction) * abs(beta)
    # by itself it tells how much of half-planes alone
    size = "" if is_layered(scene) else f" (friction times Dundurs' beta is {product:.3g})"
    moves = f"the sliding traction moves the surfaces{size}"
    still = "the sliding traction does not change the pressure"
    if scene.coupled == scene.finite_element.coupled:
        if scene.coupled:
            return moves
        return still + (" (exact: Dundurs' beta is 0)" if size and beta == 0.0 else size)
    which = ("half-plane", "finite elements")
    mover, other = which if scene.coupled else which[::-1]
    return f"{mover}: {moves}; {other}: {still}"
