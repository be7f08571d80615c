"""The steps that a scene needs, decided before anything runs, printed and recorded.

A skipped step never changes a figure that is asked for."""

from dataclasses import dataclass

from comparisons.figures.quantity import MODELS
from comparisons.models.assumptions import assumptions_of
from comparisons.models.finite_element.compliance_check import no_check
from comparisons.models.problem import Problem
from comparisons.scenes.scene import Scene


@dataclass(frozen=True)
class Skipped:
    """A step that a run skips, and the reason."""

    step: str
    because: str


@dataclass(frozen=True)
class Plan:
    """Steps of a run."""

    models: tuple[str, ...]  # of MODELS
    stress: bool  # compute subsurface fields
    shared_factor: bool  # the roller's block is the body's with another modulus: one factorisation
    coupling: bool  # solve the half-plane with and without normal-tangential coupling
    effects: bool  # compute effects beside the scene's own where their estimates ask for it
    domain_check: bool  # repeat the coarsest finite-element level on a block of half the size
    increments_check: bool  # repeat that level with longer increments of plastic flow
    skipped: tuple[Skipped, ...]  # steps, each with its reason
    assumptions: tuple[str, ...]  # of the models of this run

    @property
    def compares(self) -> bool:
        return set(self.models) == set(MODELS)


def make_plan(problem: Problem, models: tuple[str, ...]) -> Plan:
    """The plan that computes what the scene asks for and nothing else."""
    scene = problem.scene
    finite_elements = "finite_element" in models
    stress = scene.stress is not None
    shared = finite_elements and _shares_factor(scene)
    uncoupled = [no_coupling(problem, friction) for friction in scene.load.friction]
    coupling = "half_plane" in models and not all(uncoupled)
    # a disc is held by what the scene says
    half_plane = not scene.roller.rigid and scene.finite_element.roller_body == "half-plane"
    unbounded = scene.body.thickness is None or scene.body.width is None or half_plane
    domain_check = finite_elements and unbounded
    increments_check = finite_elements and scene.finite_element.plastic
    effects = set(models) == set(MODELS) and bool(scene.budget.effects) and bool(scene.tolerances)
    skipped = [
        Skipped(f"{model} model", "not asked for") for model in MODELS if model not in models
    ]

    def skip(needless: bool, step: str, because: str) -> None:
        if needless:
            skipped.append(Skipped(step, because))

    slides = any(scene.load.friction)
    skip(scene.profile is None, "refinement under asperities", "the surface is smooth")
    skip(scene.heat is None, "frictional heat", "the scene has no [heat]")
    skip(not stress, "subsurface stresses", "the scene has no [stress]")
    skip(stress and not slides, "stresses of the sliding traction", "there is no friction")
    why = "they take the half-plane" if scene.statistics else "the scene has no [statistics]"
    unasked = scene.statistics is None or "half_plane" not in models
    skip(unasked, "statistics of rough contact", why)
    skip(scene.body.hardness is None, "hardness cap", "the body has no hardness")
    if "half_plane" in models:
        skip(not coupling, "coupling", uncoupled[-1])
    if finite_elements:
        skip(scene.roller.rigid, "mesh of the roller", "it is rigid")
        same = "it is the body's block with another modulus, or the same"
        skip(shared, "factorisation of the roller's block", same)
        why = "not asked for (budget.effects)" if scene.tolerances else "no quantity is judged"
        skip(not effects, "effects beside the scene's own finite elements", why)
        skip(not domain_check, "check of the far boundary", "the body's boundaries are its own")
        skip(not increments_check, "check of the increments of flow", "no body flows")
        leans = no_check(scene)
        skip(leans is not None, "check of the compliance before contact", leans)
    if set(models) != set(MODELS):
        skipped.append(Skipped("comparison", "it takes both models"))
    steps = stress, shared, coupling, effects, domain_check, increments_check
    return Plan(models, *steps, tuple(skipped), assumptions_of(problem))


def no_coupling(problem: Problem, friction: float) -> str | None:
    """Why there is no normal-tangential coupling, or None if there is."""
    if friction == 0.0:
        return "there is no friction"
    if problem.dundurs_beta == 0.0:
        return "the bodies have equal constants: Dundurs' beta is 0"
    return None


def _shares_factor(scene: Scene) -> bool:
    """Whether the roller's block is the body's but for a factor on its modulus."""
    settings, roller = scene.finite_element, scene.roller.material
    own = (scene.body.thickness, scene.body.width, scene.coating) != (
        None,
        None,
        None,
    ) or settings.plastic
    own = own or settings.deformation == "finite"  # its boundary is its shape
    flat = settings.geometry == "flat" and settings.roller_body == "half-plane"
    alike = roller is not None and roller.poissons_ratio == scene.body.poissons_ratio
    return alike and flat and not own
