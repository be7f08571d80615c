"""One scene from start to end: plan, both models level by level, studies, files.

In: a scene. Out: a finished run, and its folder."""

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial
from importlib import import_module
from pathlib import Path

from analytic.contact.problem import ContactError
from comparisons.common.cache import NO_CACHE, Cache, kinds_of
from comparisons.common.errors import (
    InputError,
    SceneError,
    SolverError,
    check_finite_elements,
    one_line,
)
from comparisons.common.files import unfinished
from comparisons.common.processes import cores
from comparisons.common.progress import ProgressCallback, Stages, no_progress
from comparisons.common.provenance import (
    JUDGING_CODE,
    LEVEL_CODE,
    digest,
    key_of,
    machine,
    made,
    program_code,
    revision,
    versions,
)
from comparisons.common.tasks import AT_ONCE, Here, Opens, ProcessEnded, Tasks, tasks_here
from comparisons.figures.figure import Findings
from comparisons.judging.model_error.study import selection_lines
from comparisons.judging.study import Run, Solved, studied, unsolved
from comparisons.models.level import Level
from comparisons.models.plan import Plan, make_plan
from comparisons.models.posing import problem_of
from comparisons.models.problem import Levels, Problem
from comparisons.models.running_in import run_in_surface
from comparisons.output.arrays import traces_of
from comparisons.output.page import IMPORTS
from comparisons.runs.long import expected, told
from comparisons.runs.refinement import announce, refined
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import SceneSurface, scene_key, surface_of
from comparisons.studies import STUDIES
from comparisons.studies.answers.answer import Answer
from fem.solver.mumps import FemError
from meshes.block import MeshError

# Modules that say what was solved. Those that draw it come where nothing waits for them: a result
# waits for no page.
ANSWER = ("rich.console", "rich.table", "comparisons.output.terminal")
# What shapes levels, and the results of studies that are kept beside them.
CODE = (*LEVEL_CODE, *JUDGING_CODE)
Answers = Mapping[str, tuple[Answer, ...]]  # by name, on each resolution
LESS_MEMORY = "where memory ends again, allowed is a smaller budget.memory"
GOES_ON = "finished levels are kept, the same command goes on from there"


@dataclass(frozen=True)
class Known:
    """Inputs that a run need not find out: read before, or recorded."""

    surface: SceneSurface | None = None  # as measured; None: read as the scene says
    answers: Answers | None = None  # from outside; None: read from the scene's files
    levels: Levels | None = None  # None: as many as figures take and the budget allows
    all_methods: bool = False  # solve it by every method and resolution, for what they cost


def run(
    scene: Scene,
    out: Path | None,
    models: tuple[str, ...],
    callback: ProgressCallback = no_progress,
    opens: Opens | None = None,
    known: Known = Known(),
) -> Run:
    """`solve_scene`, then `finish`: a run whose files are in `out`, or nowhere (None)."""
    solved = solve_scene(scene, out, models, callback, opens, known)
    finish(solved, callback)
    return solved


def solve_scene(
    scene: Scene,
    out: Path | None,
    models: tuple[str, ...],
    callback: ProgressCallback = no_progress,
    opens: Opens | None = None,
    known: Known = Known(),
) -> Run:
    """Solve a scene, compare and judge. Its files are written by `finish`. Until then what is
    solved is kept beside `out`: a run that is stopped goes on from there.

    models    of half_plane, finite_element
    callback  gets each stage as it begins
    opens     workers for the samples of the scene's [scatter]; None: this machine's cores
    Raises InputError for a scene that cannot be solved, SolverError where the finite elements find
    no solution or a process ends amid a task, MissingLibrary without dolfinx; nothing is kept
    then."""
    if "finite_element" in models:
        check_finite_elements()
    surface = known.surface or surface_of(scene)
    try:
        with _tasks_of(scene, models) as tasks:
            problem, plan = posed(scene, surface, models, known.levels, callback, tasks)
            how = {"answers": known.answers, "opens": opens, "all_methods": known.all_methods}
            return _solve(replace(unsolved(problem, plan), **how), out, callback, tasks)
    except (ContactError, MeshError) as error:
        raise SceneError(f"{scene.source}: {error}") from error
    except ProcessEnded as error:
        left = "" if out is None else f"; {GOES_ON}"
        left += f"; {LESS_MEMORY}" if error.killed else ""
        raise SolverError(f"{scene.source}: {error}{left}") from error
    except FemError as error:
        remedy = "a lighter load"
        if scene.finite_element.plastic:
            remedy += ", a higher body.yield_stress or more hardening"
        raise SolverError(
            f"{scene.source}: the finite elements found no solution: {error}; what may help is "
            f"{remedy}, or finer pressures (resolution.pitch)"
        ) from error


def posed(
    scene: Scene,
    surface: SceneSurface,
    models: tuple[str, ...],
    levels: Levels | None = None,
    callback: ProgressCallback = no_progress,
    tasks: Tasks | None = None,
) -> tuple[Problem, Plan]:
    """The problem of a scene on its surface as measured, and the plan of the run that solves it.
    `tasks` solve the finite elements that this takes; None: this process."""
    stages, tasks = Stages(callback), tasks or Tasks()
    if scene.running_in is not None:
        with stages.stage("running-in", "running the surface in"):
            surface = run_in_surface(scene, surface)
    with stages.stage("set-up", "finding the reach of the contact"):
        if scene.load.kind != "approach":
            problem = problem_of(scene, surface, levels=levels)
        elif "finite_element" in models:
            tasks.add("approach", _approached, scene, surface, levels, urgency=AT_ONCE)
            problem = tasks.result("approach")
        else:
            raise SceneError(
                f"{scene.source}: load.approach: needs finite elements to find its load; "
                "allowed with the half-plane alone is per_length or hertz_peak_pressure"
            )
    return problem, make_plan(problem, models)


def _approached(here: Here, scene: Scene, surface: SceneSurface, levels: Levels | None) -> Problem:
    from comparisons.models.finite_element.level import problem_of_approach

    return problem_of_approach(scene, here.callback, surface, levels)


def planned(scene: Scene, surface: SceneSurface, models: tuple[str, ...]) -> list[str]:
    """Lines on what a run would do and how long it would take; the half-plane alone is solved for
    that, on the levels asked for. Steps that the scene does not need come last, with reasons."""
    problem, plan = posed(scene, surface, models)
    tasks, scene_now, effects = Tasks(at_once=cores()), unsolved(problem, plan), []

    def begin(solved: Solved) -> None:
        _begin(scene_now, tasks, solved)
        effects.extend(selection_lines(solved, tasks))

    announce(scene_now, tasks, begin)
    skipped = [f"skipped: {step}: {why}" for step, why in plan.skipped.items()]
    return [*expected(scene_now, tasks), *effects, *skipped]


def _begin(scene: Solved, tasks: Tasks, solved: Solved) -> None:
    """Let the studies that the scene asks for begin with what is solved."""
    for study in STUDIES:
        if study.applies(scene) and study.needs(scene) is None:
            study.begin(solved, tasks)


def _tasks_of(scene: Scene, models: Sequence[str]) -> Tasks:
    here, there = [revision, *(partial(import_module, name) for name in ANSWER)], []
    if "finite_element" in models:
        from fem.solver.compilation import load_dolfinx
        from meshes.build import start_worker

        level = partial(import_module, "comparisons.models.finite_element.level")
        there = [start_worker, load_dolfinx, level]
    return tasks_here(memory=scene.budget.memory, here=here, there=there)


def _solve(scene: Solved, out: Path | None, callback: ProgressCallback, tasks: Tasks) -> Run:
    problem, plan = scene.problem, scene.plan
    tasks.kept, tasks.callback = level_cache(out, problem, plan), callback
    tasks.spare = [] if out is None else [*IMPORTS]
    begin, kept = partial(_begin, scene, tasks), None if out is None else unfinished(out, "run")

    def say() -> None:
        tasks.callback = told(kept, expected(scene, tasks), tasks, callback)

    try:
        begin(scene)
        solved = refined(scene, tasks, begin, say)
        findings = studied(STUDIES, solved, tasks)
    except (ContactError, FemError, InputError, MeshError):
        tasks.kept.discard()
        raise
    return Run(solved, findings, record_of(solved, findings), out, STUDIES)


def finish(run: Run, callback: ProgressCallback = no_progress) -> bool:
    """Write the files of a solved run into its folder, if it has one; what was kept of it goes.
    Whether its report could be drawn. Raises InputError for a folder that cannot be written."""
    if run.directory is None:
        return False
    from comparisons.runs.write import write_files

    drawn = write_files(run, callback)
    replace(NO_CACHE, folder=unfinished(run.directory, "run")).discard()
    return drawn


def level_cache(out: Path | None, problem: Problem, plan: Plan) -> Cache:
    """Finished levels of the run of `plan` that writes `out`, and results of its studies: a run
    that was stopped goes on from them. None writes and caches nothing."""
    if out is None:
        return NO_CACHE
    shape = scene_key(problem.scene, problem.surface)
    key = cache(lambda: key_of(shape, repr(plan), versions(), program_code(*CODE)))
    return Cache(unfinished(out, "run"), key, kinds_of(Level))


def record_of(solved: Solved, findings: Mapping[str, Findings]) -> dict:
    """Record for a repetition, beside scene, figures and arrays."""
    scene = solved.problem.scene
    return {
        "made": made(),
        "versions": versions(),
        "machine": machine(),
        "seed": scene.profile and scene.profile.seed,
        "hashes": _hashes(solved, findings),
        "levels": max(len(run.levels) for run in solved.runs.values()),
        "command": one_line(" ".join(sys.argv[1:])) or None,
    }


def _hashes(solved: Solved, findings: Mapping[str, Findings]) -> dict[str, object]:
    """Hashes of trace and profile, pressures, the run-in surface, and the files of answers."""
    surface = solved.problem.surface
    hashes: dict[str, object] = {
        name: digest(profile.x, profile.height) for name, profile in traces_of(surface).items()
    }
    for name in solved.runs:
        pressures = (level.solution.pressure for _, level in solved.contacts(name))
        hashes[f"{name}_pressure"] = digest(*pressures)
    if surface.run_in is not None:
        run_in = surface.run_in.profile
        hashes["run_in_profile"] = digest(run_in.x, run_in.height)
    for files in findings["answers"].series if "answers" in findings else ():
        if files.name == "files":
            hashes[f"answer_{files.source}"] = list(files.columns["sha256"].values)
    return hashes
