"""Error against time of every method and setting that applies to a scene, and what to take."""

from pathlib import Path

from analytic.contact.problem import ContactError
from comparisons.campaigns.cost.measure import cost_cache, measured_study
from comparisons.campaigns.cost.methods import SolutionMethod, methods_of, with_every_effect
from comparisons.campaigns.cost.recommend import Cost, assess
from comparisons.campaigns.cost.show import content_of, cost_page
from comparisons.common.cache import Cache
from comparisons.common.errors import InputError, SceneError, SolverError
from comparisons.common.files import check_writable, publish
from comparisons.common.processes import ProcessWorker
from comparisons.common.progress import ProgressCallback, no_progress
from comparisons.common.provenance import as_json
from comparisons.common.tasks import ProcessEnded, Tasks, called
from comparisons.models.posing import problem_of
from comparisons.models.problem import Problem
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import surface_of
from meshes.block import MeshError

FILES = ("cost.json", "cost.html")
LOAD = "load"  # of a prescribed approach, in the cache
GOES_ON = "measured settings are kept, the same command goes on from there"


def cost(
    scene: Scene,
    out: Path,
    repeats: int,
    callback: ProgressCallback = no_progress,
    methods: tuple[SolutionMethod, ...] | None = None,
    whole: bool = False,
) -> Cost:
    """Measure, assess, and write cost.json and cost.html in `out`, whole or not at all. What was
    measured stays beside them (`comparisons.campaigns.cost.measure`): the same study goes on from
    there.

    methods  None: all that apply
    whole    whether the finite elements get every effect that matters, so that the models of the
             ladder are measured beside each other

    Raises InputError for a scene that cannot be solved or a folder that cannot be written,
    KeyboardInterrupt with how to go on."""
    if repeats < 1:
        raise InputError(f"--repeats: is {repeats}; allowed is 1 or more")
    check_writable(out, FILES)
    cache = cost_cache(out, scene, repeats, whole)
    cache.remove_leftovers()
    try:
        problem = _problem(scene, cache, callback)
        if whole:
            problem = with_every_effect(problem)
        methods = methods_of(problem) if methods is None else methods
        study = assess(problem, measured_study(problem, repeats, cache, callback, methods))
        callback("drawing the diagrams")
        publish(out, dict(zip(FILES, (as_json(content_of(study)), cost_page(study)), strict=True)))
    except KeyboardInterrupt:
        raise KeyboardInterrupt(GOES_ON) from None
    return study


def _problem(scene: Scene, cache: Cache, callback: ProgressCallback) -> Problem:
    """The scene's problem, under the load of its approach where that is prescribed."""
    callback("finding the extent of the contact")
    try:
        if scene.periodic:
            why = "is true; allowed is a roller, whose contact every method of `cost` solves"
            raise SceneError(f"{scene.source}: profile.periodic: {why}")
        surface = surface_of(scene)
        if scene.load.kind != "approach":
            return problem_of(scene, surface)
        callback("finite elements: load of the prescribed approach")
        with Tasks(ProcessWorker, 1, cache) as tasks:
            tasks.add(LOAD, called, _load_of_approach, scene)
            return problem_of(scene, surface, tasks.result(LOAD))
    except ProcessEnded as error:
        raise SolverError(
            f"{scene.source}: load.approach: the process that sought its load ended; allowed "
            "is a load (per_length) instead"
        ) from error
    except (ContactError, MeshError) as error:
        raise SceneError(f"{scene.source}: {error}") from error


def _load_of_approach(scene: Scene) -> float:
    """[N/m]; in a process of its own, which an interrupt ends at once."""
    from comparisons.models.finite_element.level import problem_of_approach

    return problem_of_approach(scene, no_progress).hertz.load_per_length
