"""`crosscheck paper`: solve four surfaces by both models, measure, judge, draw, write."""

from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

from analytic.contact.problem import ContactError
from comparisons.common.errors import ExitStatus, InputError, SolverError
from comparisons.common.files import check_writable, published
from comparisons.common.mpi import is_several
from comparisons.common.progress import ProgressCallback, Step, no_progress, within
from comparisons.common.provenance import as_json, versions
from comparisons.common.quantities import MODELS
from comparisons.common.tasks import tasks_of_a_run
from comparisons.models.level_cache import level_cache
from comparisons.models.plan import make_plan
from comparisons.models.problem import problem_of
from comparisons.models.window import window_of
from comparisons.results.outcome import Outcome
from comparisons.results.record import record_of
from comparisons.results.result_json import result_of
from comparisons.runs.run import solved
from comparisons.scenes.resolve import load_scene
from comparisons.scenes.scene import ResolvedScene
from comparisons.studies.paper.claims.book import judged_book
from comparisons.studies.paper.claims.claim_list import SCENES, SURFACES, claims
from comparisons.studies.paper.claims.judgement import OUTCOMES, JudgedClaim, judge
from comparisons.studies.paper.claims.readings import SLIDING
from comparisons.studies.paper.page import paper_page
from comparisons.studies.paper.sections import sections_of
from fem.solver.mumps import FemError
from meshes.block import MeshError

SCHEMA = 2
SOLVING = 0.8  # share of the progress that solving takes
PAGE, NUMBERS = "paper.html", "paper.json"
SOURCE = "Bailey and Sayles 1991"
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


@dataclass(frozen=True)
class Paper:
    """The paper computed anew.

    outcomes   of every surface, by its scene's name
    judged     claims in the order of the figures, and Seireg's after them
    seconds    that it took, without drawing
    directory  where the files are
    """

    outcomes: dict[str, Outcome]
    judged: tuple[JudgedClaim, ...]
    seconds: float
    directory: Path

    @property
    def exit_status(self) -> ExitStatus:
        """3 where a contact did not converge; a denied claim is no error."""
        converged = all(outcome.converged for outcome in self.outcomes.values())
        return ExitStatus.DONE if converged else ExitStatus.NOT_CONVERGED

    def as_dict(self) -> dict:
        """The content of paper.json: SI units, but for claims, which state their unit."""
        hertz = next(iter(self.outcomes.values())).problem.hertz
        return {
            "schema": SCHEMA,
            "source": SOURCE,
            "hertz": {
                name: getattr(hertz, name)
                for name in ("half_width", "peak_pressure", "tau1_max", "tau1_max_depth")
            },
            "claims": [each.as_dict() for each in self.judged],
            "outcomes": {kind: sum(j.outcome == kind for j in self.judged) for kind in OUTCOMES},
            "surfaces": {
                name: {"surface": SURFACES[name]}
                | {part: outcome.result[part] for part in ("profile", "models", "comparison")}
                for name, outcome in self.outcomes.items()
            },
            "seconds": self.seconds,
            "versions": versions(),
        }


def paper(
    out: Path,
    fineness: Fineness = Fineness(),
    callback: ProgressCallback = no_progress,
    effects: bool = False,
) -> Paper:
    """Compute the paper anew and write paper.html and paper.json.

    effects  compute the half-plane's model error beside each claim; else it is estimated

    Raises InputError where `out` cannot be written and under mpirun, SolverError where a model
    finds no solution; nothing is written then.
    """
    if is_several():
        raise InputError("paper: runs in several processes; allowed is one, without mpirun")
    check_writable(out, (PAGE, NUMBERS))
    start = perf_counter()
    outcomes = solve_surfaces(out, fineness, within(callback, 0.0, SOLVING), effects)
    callback(Step("measuring the claims", SOLVING))
    judged = tuple(judge(claim, outcomes[claim.scene]) for claim in claims()) + judged_book()
    found = Paper(outcomes, judged, perf_counter() - start, out)
    page = paper_page(found, sections_of(outcomes, judged, callback))
    callback("writing files")
    with published(out, (PAGE, NUMBERS)) as folder:
        (folder / PAGE).write_text(page, encoding="utf-8")
        (folder / NUMBERS).write_text(as_json(found.as_dict()), encoding="utf-8")
    return found


def solve_surfaces(
    out: Path,
    fineness: Fineness,
    callback: ProgressCallback = no_progress,
    effects: bool = False,
) -> dict[str, Outcome]:
    """By the scene's name. Raises SolverError where a model finds no solution."""
    found = {}
    for number, name in enumerate(SCENES, start=1):
        scene = load_scene(name)
        scene = replace(
            scene,
            friction=FRICTIONS,
            stress=replace(scene.stress, points=fineness.points),
            resolution=replace(scene.resolution, pitch=fineness.pitch, levels=LEVELS, most=LEVELS),
        )
        part = within(callback, (number - 1) / len(SCENES), number / len(SCENES))
        try:
            part = _prefixed(part, f"{number} of {len(SCENES)}, {name}")
            found[name] = _solved(scene, out, part, effects)
        except (ContactError, FemError, MeshError) as error:
            raise SolverError(f"{name}: no solution was found: {error}") from error
    return found


def _prefixed(callback: ProgressCallback, prefix: str) -> ProgressCallback:
    def prefixed(stage: str) -> None:
        words = f"{prefix}: {stage}"
        callback(Step(words, stage.done) if isinstance(stage, Step) else words)

    return prefixed


def _solved(scene: ResolvedScene, out: Path, callback: ProgressCallback, effects: bool) -> Outcome:
    problem = problem_of(scene)
    plan = replace(make_plan(problem, MODELS), effects=effects)
    window = window_of(problem)
    with TemporaryDirectory(prefix="crosscheck-") as folder:
        cache = level_cache(Path(folder) / "run", scene, plan)
        with tasks_of_a_run(callback, scene.budget.memory) as tasks:
            runs, stop, moved, rows, budget = solved(problem, plan, window, cache, tasks)
    result = result_of(problem, plan, runs, rows, stop, moved, budget)
    record = record_of(scene, runs, {})
    return Outcome(problem, plan, window, runs, rows, result, record, out, moved, budget)
