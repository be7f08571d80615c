"""`crosscheck paper`: solve four surfaces by both models, measure, judge, draw, write."""

from dataclasses import dataclass, replace
from pathlib import Path
from time import perf_counter

from analytic.contact.problem import ContactError
from comparisons.campaigns.paper.claims.claim_list import SCENES, SURFACES, book_claims, claims
from comparisons.campaigns.paper.claims.judgement import OUTCOMES, JudgedClaim, judge
from comparisons.campaigns.paper.claims.readings import SLIDING
from comparisons.campaigns.paper.page import paper_page
from comparisons.campaigns.paper.sections import sections_of
from comparisons.common.errors import ExitStatus, InputError, SolverError
from comparisons.common.files import check_writable, publish
from comparisons.common.mpi import is_several
from comparisons.common.progress import ProgressCallback, Step, no_progress, within
from comparisons.common.provenance import as_json, versions
from comparisons.figures.quantity import MODELS
from comparisons.models.plan import make_plan
from comparisons.models.problem import Levels, problem_of
from comparisons.output.result_json import content_of
from comparisons.runs.run import solve
from comparisons.scenes.scene import Scene
from comparisons.studies import comparison, contact, quiescent_zone
from comparisons.studies import problem as asked
from comparisons.studies.study import Run, unsolved
from fem.solver.mumps import FemError
from meshes.block import MeshError

SCHEMA = 3  # 2 had the surfaces' figures by model and quantity
SHOWN = (contact.NAME, comparison.NAME, asked.NAME)  # studies whose figures are kept
SOLVING = 0.8  # share of the progress that solving takes
PAGE, NUMBERS = "paper.html", "paper.json"
SOURCE = "Bailey and Sayles 1991"
FRICTIONS = (0.0, SLIDING)
LEVELS = 3  # as many as an uncertainty needs; finer ones would take the command minutes


@dataclass(frozen=True)
class Fineness:
    """How finely the surfaces are solved."""

    pitch: float | None = None  # [m] of the coarsest pressure elements, None for each scene's own
    points: tuple[int, int] = (600, 120)  # columns and rows of the fields


@dataclass(frozen=True)
class Paper:
    """The paper computed anew."""

    outcomes: dict[str, Run]  # of every surface, by its scene's name
    judged: tuple[JudgedClaim, ...]  # in the order of the figures, and Seireg's after
    seconds: float  # that it took, without drawing
    directory: Path  # where the files are

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
                name: {"surface": SURFACES[name], "figures": _figures(outcome)}
                for name, outcome in self.outcomes.items()
            },
            "seconds": self.seconds,
            "versions": versions(),
        }


def _figures(run: Run) -> list[dict]:
    """As result.json has them."""
    content = content_of(run)
    return [figure for figure in content["figures"] if figure["study"] in SHOWN]


def paper(
    out: Path,
    fineness: Fineness = Fineness(),
    callback: ProgressCallback = no_progress,
    effects: bool = False,
) -> Paper:
    """Compute the paper anew and write paper.html and paper.json.

    effects  compute the half-plane's model error beside each claim; else it is estimated

    Raises InputError where `out` cannot be written and under mpirun, SolverError where a model
    finds no solution; nothing is written then."""
    if is_several():
        raise InputError("paper: runs in several processes; allowed is one, without mpirun")
    check_writable(out, (PAGE, NUMBERS))
    start = perf_counter()
    outcomes = solve_surfaces(fineness, within(callback, 0.0, SOLVING), effects)
    callback(Step("measuring the claims", SOLVING))
    judged = tuple(judge(claim, outcomes.get(claim.scene)) for claim in (*claims(), *book_claims()))
    result = Paper(outcomes, judged, perf_counter() - start, out)
    page = paper_page(result, sections_of(outcomes, judged, callback))
    callback("writing files")
    publish(out, {PAGE: page, NUMBERS: as_json(result.as_dict())})
    return result


def solve_surfaces(
    fineness: Fineness, callback: ProgressCallback = no_progress, effects: bool = False
) -> dict[str, Run]:
    """By the scene's name. Raises SolverError where a model finds no solution."""
    runs = {}
    for number, name in enumerate(SCENES, start=1):
        scene = Scene.read(name)
        scene = scene.changed(
            {
                "load.friction": FRICTIONS,
                "stress.points": fineness.points,
                "resolution.pitch": fineness.pitch,
            }
        )
        part = within(callback, (number - 1) / len(SCENES), number / len(SCENES))
        try:
            part = _prefixed(part, f"{number} of {len(SCENES)}, {name}")
            problem = problem_of(scene, levels=Levels(LEVELS))
            plan = replace(make_plan(problem, MODELS), effects=effects)
            solved = solve(unsolved(problem, plan), None, part)
            # figure 11 is drawn as the paper's, without the quiescent zone
            shown = {
                n: findings for n, findings in solved.found.items() if n != quiescent_zone.NAME
            }
            runs[name] = replace(solved, found=shown)
        except (ContactError, FemError, MeshError) as error:
            raise SolverError(f"{name}: no solution was found: {error}") from error
    return runs


def _prefixed(callback: ProgressCallback, prefix: str) -> ProgressCallback:
    def prefixed(stage: str) -> None:
        words = f"{prefix}: {stage}"
        callback(Step(words, stage.done) if isinstance(stage, Step) else words)

    return prefixed
