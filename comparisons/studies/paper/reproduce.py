"""`crosscheck paper`: solve, measure, judge, draw, and leave page, numbers and stress files."""

from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

from comparisons.common.errors import ExitStatus, InputError
from comparisons.common.files import check_writable, published
from comparisons.common.mpi import is_several
from comparisons.common.progress import ProgressCallback, Step, no_progress, within
from comparisons.common.provenance import as_json, versions
from comparisons.results.outcome import Outcome
from comparisons.studies.paper.claims.claim_list import claims
from comparisons.studies.paper.claims.claims import OUTCOMES, Judged, judge
from comparisons.studies.paper.page import paper_page
from comparisons.studies.paper.sections import sections_of
from comparisons.studies.paper.solve import Fineness, solve_surfaces
from comparisons.studies.paper.subsurf import write_subsurf
from comparisons.studies.paper.subsurf_mesh import subsurf_files
from comparisons.studies.paper.surfaces import SURFACES

SCHEMA = 1
SOLVING = 0.8  # of the time, for what is told
PAGE, NUMBERS, STRESSES = "paper.html", "paper.json", "subsurf"
SOURCE = "Bailey and Sayles 1991"


@dataclass(frozen=True)
class Paper:
    """The paper computed anew.

    outcomes   of every surface, by its scene's name
    judged     claims in the order of the figures
    seconds    that it took, drawing left out
    directory  where the files are
    """

    outcomes: dict[str, Outcome]
    judged: tuple[Judged, ...]
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
                "half_width": hertz.half_width,
                "peak_pressure": hertz.peak_pressure,
                "tau1_max": hertz.tau1_max,
                "tau1_max_depth": hertz.tau1_max_depth,
            },
            "claims": [each.as_dict() for each in self.judged],
            "outcomes": {
                outcome: sum(each.outcome == outcome for each in self.judged)
                for outcome in OUTCOMES
            },
            "surfaces": {
                name: {
                    "surface": SURFACES[name],
                    "profile": outcome.result["profile"],
                    "models": outcome.result["models"],
                    "comparison": outcome.result["comparison"],
                }
                for name, outcome in self.outcomes.items()
            },
            "seconds": self.seconds,
            "versions": versions(),
        }


def paper(
    out: Path, fineness: Fineness | None = None, callback: ProgressCallback = no_progress
) -> Paper:
    """Compute the paper anew and write paper.html, paper.json and the files of stresses.

    Raises InputError where `out` cannot be written and under mpirun, SolverError where a model
    finds no solution; nothing is written then.
    """
    if is_several():
        raise InputError("paper: runs in several processes; allowed is one, without mpirun")
    check_writable(out)
    start = perf_counter()
    outcomes = solve_surfaces(out, fineness, within(callback, 0.0, SOLVING))
    callback(Step("measuring the claims", SOLVING))
    judged = tuple(judge(claim, outcomes[claim.scene]) for claim in claims())
    found = Paper(outcomes, judged, perf_counter() - start, out)
    page = paper_page(found, sections_of(outcomes, judged, callback))
    callback("writing files")
    with published(out, (PAGE, NUMBERS)) as folder:
        (folder / PAGE).write_text(page, encoding="utf-8")
        (folder / NUMBERS).write_text(as_json(found.as_dict()), encoding="utf-8")
        (folder / STRESSES).mkdir()
        for outcome in outcomes.values():
            for name, content in subsurf_files(outcome).items():
                write_subsurf(folder / STRESSES / name, content)
    return found
