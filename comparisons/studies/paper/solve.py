"""The four surfaces of the paper, each solved by both models under the same load."""

from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

from analytic.contact.problem import ContactError
from comparisons.assessment.comparison import compare
from comparisons.assessment.refinement import refined
from comparisons.common.errors import SolverError
from comparisons.common.model_names import MODELS
from comparisons.common.progress import ProgressCallback, Step, no_progress, within
from comparisons.models.level_cache import level_cache
from comparisons.models.plan import make_plan
from comparisons.models.problem import problem_of
from comparisons.models.window import window_of
from comparisons.results.outcome import Outcome
from comparisons.results.record import record_of
from comparisons.results.result_json import result_of
from comparisons.scenes.resolve import load_scene
from comparisons.scenes.scene import ResolvedScene
from comparisons.studies.paper.claims.readings import SLIDING
from comparisons.studies.paper.surfaces import SCENES
from fem.solver.mumps import FemError
from meshes.block import MeshError

FRICTIONS = (0.0, SLIDING)
LEVELS = 3  # as many as an uncertainty needs; finer ones would take the command minutes


@dataclass(frozen=True)
class Fineness:
    """How finely the surfaces are solved.

    pitch   [m] of the coarsest pressure elements, None for each scene's own
    points  columns and rows of the fields
    """

    pitch: float | None = None
    points: tuple[int, int] = (600, 120)


def solve_surfaces(
    out: Path, fineness: Fineness | None = None, callback: ProgressCallback = no_progress
) -> dict[str, Outcome]:
    """By the scene's name. Raises SolverError where a model finds no solution."""
    found = {}
    for number, name in enumerate(SCENES, start=1):
        scene = _set_up(load_scene(name), fineness or Fineness())

        part = within(callback, (number - 1) / len(SCENES), number / len(SCENES))

        def told(
            stage: str, number: int = number, name: str = name, part: ProgressCallback = part
        ) -> None:
            words = f"{number} of {len(SCENES)}, {name}: {stage}"
            part(Step(words, stage.behind) if isinstance(stage, Step) else words)

        try:
            found[name] = _solved(scene, out, told)
        except (ContactError, FemError, MeshError) as error:
            raise SolverError(f"{name}: no solution was found: {error}") from error
    return found


def _set_up(scene: ResolvedScene, fineness: Fineness) -> ResolvedScene:
    """The scene at both frictions, on as many levels and points as all others."""
    return replace(
        scene,
        friction=FRICTIONS,
        stress=replace(scene.stress, points=fineness.points),
        resolution=replace(scene.resolution, pitch=fineness.pitch, levels=LEVELS, most=LEVELS),
    )


def _solved(scene: ResolvedScene, out: Path, callback: ProgressCallback) -> Outcome:
    problem = problem_of(scene)
    plan = make_plan(problem, MODELS)
    window = window_of(problem)
    with TemporaryDirectory(prefix="crosscheck-") as folder:
        checkpoint = level_cache(Path(folder) / "run", scene, plan)
        runs, stop = refined(problem, plan, window, checkpoint, callback)
    comparisons = tuple(
        row
        for friction in scene.friction
        for row in compare(runs["half_plane"], runs["finite_element"], problem, friction, window)
    )
    return Outcome(
        problem=problem,
        plan=plan,
        window=window,
        runs=runs,
        comparisons=comparisons,
        result=result_of(problem, plan, runs, comparisons, stop),
        record=record_of(scene, runs, {}),
        directory=out,
    )
