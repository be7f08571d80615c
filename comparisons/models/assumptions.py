"""The assumptions of a scene's models in words: of both, or of the half-plane alone."""

from comparisons.common.numbers import as_written
from comparisons.models.operators import is_layered
from comparisons.models.problem import Problem
from comparisons.models.running_in import running_in_assumptions
from comparisons.scenes.finite_element import FiniteElementSection
from comparisons.scenes.scene import Scene
from comparisons.scenes.sections import BodySection, RollerSection

WITHIN_LINEAR = "within linear elasticity"
LAW_NAMES = {
    "neo-hookean": "neo-Hookean",
    "hencky": "Hencky's",
    "st-venant-kirchhoff": "St. Venant-Kirchhoff",
    "murnaghan": "Murnaghan's",
}


def assumptions_of(problem: Problem) -> tuple[str, ...]:
    """One sentence an assumption; where the finite elements drop one, what they have instead."""
    scene, settings = problem.scene, problem.scene.finite_element
    listed = ["elastic"] if scene.body.hardness is None and not settings.plastic else []
    listed += [_law(scene), _deformation(scene), _gap(settings), _boundary(problem)]
    listed += ["between samples the surface is a cubic spline"] if scene.profile is not None else []
    listed += [] if scene.periodic else [_roller(settings, scene.roller)]
    if scene.coating is not None:
        coated = "a coating is bonded to the body of another"
        listed.append(_split("the body is of one material", coated))
    if scene.running_in is not None:
        listed += running_in_assumptions(scene, problem.surface)
    if scene.body.hardness is not None:
        both = "plastic flow is a cap on the pressure (hardness)"
        listed.append(f"half-plane: {both}" if settings.plastic else both)
    if any(scene.load.friction):
        listed.append(_friction(problem))
    return tuple(listed)


def without_law(scene: Scene) -> list[str]:
    """The `body`, the elastic `roller` and the `coating` of which the scene says no law of
    elasticity."""
    return [name for name, section in scene.elastic_sections.items() if section.law is None]


def laws(scene: Scene) -> str:
    """The laws of elasticity of all bodies at finite strain, in words."""
    laws = {}
    for section in scene.elastic_sections.values():
        law = section.material.law
        measured = section.solid and law.murnaghan is not None
        laws[f"{section.solid}'s measured" if measured else LAW_NAMES[law.name]] = None
    return " and ".join(laws)


def question(scene: Scene) -> str:
    """Beginning of a sentence: what the verdict of a scene is meant for; empty where it is meant
    for the bodies as they are."""
    if scene.linear:
        return WITHIN_LINEAR + (" and flow" if scene.finite_element.plastic else "")
    return "for elastic bodies" if scene.asks_elastic else ""


def _law(scene: Scene) -> str:
    if scene.linear:
        return f"law of elasticity: linear, every figure is {WITHIN_LINEAR}"
    missing = " and ".join(without_law(scene))
    return f"law of elasticity: {laws(scene)}" + (f" (not given: {missing})" if missing else "")


def _split(half_plane: str, finite_elements: str) -> str:
    return f"half-plane: {half_plane}; finite elements: {finite_elements}"


def _deformation(scene: Scene) -> str:
    settings = scene.finite_element
    linear, small = "linear elasticity", "small deformation"
    if settings.plastic and settings.deformation == "finite":
        flow = f"finite deformation, von Mises' yield by true strain {yielding_text(scene.body)}"
        return f"plane strain; {_split(f'{linear}, {small}', flow)}"
    if settings.plastic:
        flow = f"von Mises' yield {yielding_text(scene.body)}"
        return f"{small}, plane strain; {_split(linear, flow)}"
    if settings.deformation == "finite":
        finite = f"{laws(scene)} elasticity, finite deformation"
        return f"plane strain; {_split(f'{linear}, {small}', finite)}"
    return f"{linear}, {small}, plane strain"


def yielding_text(body: BodySection) -> str:
    """Flow of a body, in one phrase."""
    words = {
        "voce": "by Voce's law",
        "ludwik": "by Ludwik's law",
        "table": "by a table",
        "kinematic": "kinematically",
    }
    laws = [words[name] for name in words if body.hardening and name in body.hardening.laws]
    modulus = body.hardening_modulus
    laws = [f"by {as_written(modulus, 'Pa')}"] * bool(modulus) + laws
    harder = f"hardening {' and '.join(laws)}" if laws else "perfectly plastic"
    return f"at {as_written(body.yield_stress, 'Pa')}, {harder}"


def _gap(settings: FiniteElementSection) -> str:
    undeformed = "the gap is on the undeformed surface"
    if settings.deformation == "linear":
        return f"{undeformed}, and the pressure acts along the mean normal"
    deformed = "on the deformed one, and the pressure acts along the current normal"
    return _split(undeformed, f"{deformed}, by deformed area")


def _boundary(problem: Problem) -> str:
    if problem.rough_boundary:
        return _split("the roughness is in the gap", "it is the boundary")
    return "the roughness is in the gap: the boundary is flat"


def support_text(roller: RollerSection) -> str:
    """Support of an elastic roller, as a disc, in one phrase."""
    support = roller.support
    if support is None:
        return "a sector, held at 0.4 of its radius (not given: roller.support)"
    if roller.hub is not None:
        return f"held on a rigid hub of radius {as_written(roller.hub, 'm')}"
    words = {"opposite": "held opposite the contact", "half disc": "half a disc, held at its flat"}
    return words[support]


def _roller(settings: FiniteElementSection, roller: RollerSection) -> str:
    parts = ["an exact circle"] if settings.roller_shape == "circle" else []
    if settings.roller_body == "disc" and not roller.rigid:
        parts.append(f"an elastic body of finite size, {support_text(roller)}")
    parabola = "the roller is a parabola of the relative curvature"
    return _split(parabola, f"it is {' and '.join(parts)}") if parts else parabola


def _friction(problem: Problem) -> str:
    scene, beta = problem.scene, problem.dundurs_beta
    product = max(scene.load.friction) * abs(beta)
    # for layers the product alone does not say how much
    size = "" if is_layered(scene) else f" (friction times Dundurs' beta is {product:.3g})"
    moves = f"the sliding traction moves the surfaces{size}"
    still = "the sliding traction does not change the pressure"
    if scene.load.coupled != scene.finite_element.coupled:
        return _split(moves, still) if scene.load.coupled else _split(still, moves)
    if scene.load.coupled:
        return moves
    return still + (" (exact: Dundurs' beta is 0)" if size and beta == 0.0 else size)
