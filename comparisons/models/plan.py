"""The steps that a scene needs, decided before anything runs, printed and recorded.

A skipped step never changes a figure that is asked for."""

from dataclasses import dataclass

from comparisons.figures.quantity import MODELS
from comparisons.models.assumptions import assumptions_of
from comparisons.models.problem import Problem
from comparisons.scenes.scene import sections_of

LONGER = (4, 2)  # times as long increments of plastic flow, of their check


@dataclass(frozen=True)
class Plan:
    """Steps of a run."""

    models: tuple[str, ...]  # of MODELS
    coupling: bool  # solve the half-plane with and without normal-tangential coupling
    effects: bool  # compute effects beside the scene's own where their estimates ask for it
    domain_check: bool  # repeat the coarsest finite-element level on a block of half the size
    increments_check: bool  # repeat that level with longer increments of plastic flow
    assumptions: tuple[str, ...]  # of the models of this run
    skipped: dict[str, str]  # by step that the run skips, the reason

    @property
    def compares(self) -> bool:
        return set(self.models) == set(MODELS)


def make_plan(problem: Problem, models: tuple[str, ...]) -> Plan:
    """The plan that computes what the scene asks for and nothing else."""
    scene, settings = problem.scene, problem.scene.finite_element
    half_plane, finite_elements = (name in models for name in MODELS)
    uncoupled = [no_coupling(problem, friction) for friction in scene.load.friction]
    # a disc is held by what the scene says
    endless = not scene.roller.rigid and settings.roller_body == "half-plane"
    unbounded = scene.body.thickness is None or scene.body.width is None or endless
    compares = half_plane and finite_elements
    coupling = half_plane and not all(uncoupled)
    effects = compares and bool(scene.budget.effects) and bool(scene.tolerances)
    no_traction = scene.stress is not None and not any(scene.load.friction)
    no_statistics = scene.statistics is not None and not half_plane
    steps = [
        *((name not in models, f"{name} model", "not asked for") for name in MODELS),
        (scene.profile is None, "refinement under asperities", "the surface is smooth"),
        *(
            (getattr(scene, name) is None, section.STEP, f"the scene has no [{name}]")
            for name, section in sections_of(type(scene)).items()
            if section.STEP is not None
        ),
        (no_traction, "stresses of the sliding traction", "there is no friction"),
        (no_statistics, "statistics of rough contact", "they take the half-plane"),
        (scene.body.hardness is None, "hardness cap", "the body has no hardness"),
    ]
    if half_plane:
        steps.append((not coupling, "coupling", uncoupled[-1]))
    if finite_elements:
        shared = "it is the body's block with another modulus, or the same"
        unasked = "not asked for (budget.effects)" if scene.tolerances else "no quantity is judged"
        steps += [
            (scene.roller.rigid, "mesh of the roller", "it is rigid"),
            (problem.shares_factor, "factorisation of the roller's block", shared),
            (not effects, "effects beside the scene's own finite elements", unasked),
            (not unbounded, "check of the far boundary", "the body's boundaries are its own"),
            (not settings.plastic, "check of the increments of flow", "no body flows"),
        ]
    steps.append((not compares, "comparison", "it takes both models"))
    return Plan(
        models,
        coupling,
        effects,
        domain_check=finite_elements and unbounded,
        increments_check=finite_elements and settings.plastic,
        assumptions=assumptions_of(problem),
        skipped={step: because for needless, step, because in steps if needless},
    )


def no_coupling(problem: Problem, friction: float) -> str | None:
    """Why there is no normal-tangential coupling, or None if there is."""
    if friction == 0.0:
        return "there is no friction"
    if problem.dundurs_beta == 0.0:
        return "the bodies have equal constants: Dundurs' beta is 0"
    if problem.scene.periodic:
        return "the operator of a periodic surface has none"
    return None
