"""`crosscheck paper`: solve four surfaces by both models, measure, judge, draw, write."""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from time import perf_counter

from analytic.contact.problem import ContactError
from comparisons.campaigns.paper.claims import (
    OUTCOMES,
    SCENES,
    SMOOTH,
    SURFACES,
    JudgedClaim,
    book_claims,
    claims,
    judge,
)
from comparisons.campaigns.paper.page import paper_page
from comparisons.campaigns.paper.readings import SLIDING
from comparisons.common.errors import ExitStatus, SolverError
from comparisons.common.files import check_writable, publish
from comparisons.common.progress import ProgressCallback, Step, no_progress, within
from comparisons.common.provenance import as_json, versions
from comparisons.figures.quantity import MODELS
from comparisons.models.plan import make_plan
from comparisons.models.posing import problem_of
from comparisons.models.problem import Levels
from comparisons.output.result_json import content_of
from comparisons.runs.run import solve
from comparisons.scenes.scene import Scene
from comparisons.studies import comparison, contact
from comparisons.studies import problem as asked
from comparisons.studies.study import Run, unsolved
from comparisons.studies.subsurface import quiescent_zone
from fem.solver.mumps import FemError
from meshes.block import MeshError

SCHEMA = 3  # 2 had the surfaces' figures by model and quantity
SHOWN = (contact.NAME, comparison.NAME, asked.NAME)  # studies whose figures are kept
SOLVING = 0.8  # share of the progress that solving takes
PAGE, NUMBERS = "paper.html", "paper.json"
SOURCE = "Bailey and Sayles 1991"
HERTZ = ("half_width", "peak_pressure", "tau1_max", "tau1_max_depth")
FRICTIONS = (0.0, SLIDING)
LEVELS = 3  # as many as an uncertainty needs; finer ones would take the command minutes
FINE = {"stress.points": (600, 120)}  # columns and rows of the fields


@dataclass(frozen=True)
class Paper:
    """The paper computed anew."""

    runs: dict[str, Run]  # of every surface, by its scene's name
    judged: tuple[JudgedClaim, ...]  # in the order of the figures, and Seireg's after
    seconds: float  # that it took, without drawing
    directory: Path  # where the files are

    @property
    def exit_status(self) -> ExitStatus:
        """3 where a contact did not converge; a denied claim is no error."""
        converged = all(run.converged for run in self.runs.values())
        return ExitStatus.DONE if converged else ExitStatus.NOT_CONVERGED

    def as_dict(self) -> dict:
        """The content of paper.json: SI units, but for claims, which state their unit."""
        hertz = self.runs[SMOOTH].problem.hertz
        counts = Counter(judged.outcome for judged in self.judged)
        return {
            "schema": SCHEMA,
            "source": SOURCE,
            "hertz": {name: getattr(hertz, name) for name in HERTZ},
            "claims": [judged.as_dict() for judged in self.judged],
            "outcomes": {kind: counts[kind] for kind in OUTCOMES},
            "surfaces": {
                name: {"surface": SURFACES[name], "figures": _shown(run)}
                for name, run in self.runs.items()
            },
            "seconds": self.seconds,
            "versions": versions(),
        }


def _shown(run: Run) -> list[dict]:
    """Figures as result.json has them."""
    return [figure for figure in content_of(run)["figures"] if figure["study"] in SHOWN]


def paper(
    out: Path,
    fields: Mapping[str, object] = FINE,
    callback: ProgressCallback = no_progress,
    effects: bool = False,
) -> Paper:
    """Compute the paper anew and write paper.html and paper.json.

    fields   of the scenes, by name, that say how finely they are solved
    effects  compute the half-plane's model error beside each claim; else it is estimated

    Raises InputError where `out` cannot be written, SolverError where a model finds no solution;
    nothing is written then."""
    check_writable(out, (PAGE, NUMBERS))
    start = perf_counter()
    runs = solve_surfaces(fields, within(callback, 0.0, SOLVING), effects)
    callback(Step("measuring the claims", SOLVING))
    judged = tuple(judge(claim, runs.get(claim.scene)) for claim in (*claims(), *book_claims()))
    result = Paper(runs, judged, perf_counter() - start, out)
    page = paper_page(result, callback)
    callback("writing files")
    publish(out, {PAGE: page, NUMBERS: as_json(result.as_dict())})
    return result


def solve_surfaces(
    fields: Mapping[str, object], callback: ProgressCallback = no_progress, effects: bool = False
) -> dict[str, Run]:
    """By the scene's name. Raises SolverError where a model finds no solution."""
    runs, count = {}, len(SCENES)
    for number, name in enumerate(SCENES):
        scene = Scene.read(name).changed({"load.friction": FRICTIONS, **fields})
        part = within(callback, number / count, (number + 1) / count)
        try:
            problem = problem_of(scene, levels=Levels(LEVELS, all_points=True))
            plan = replace(make_plan(problem, MODELS), effects=effects)
            prefixed = _prefixed(part, f"{number + 1} of {count}, {name}")
            run = solve(unsolved(problem, plan), None, prefixed)
        except (ContactError, FemError, MeshError) as error:
            raise SolverError(f"{name}: no solution was found: {error}") from error
        # figure 11 is drawn as the paper's, without the quiescent zone
        shown = {study: f for study, f in run.findings.items() if study != quiescent_zone.NAME}
        runs[name] = replace(run, findings=shown)
    return runs


def _prefixed(callback: ProgressCallback, prefix: str) -> ProgressCallback:
    def prefixed(stage: str) -> None:
        words = f"{prefix}: {stage}"
        callback(Step(words, stage.done) if isinstance(stage, Step) else words)

    return prefixed
