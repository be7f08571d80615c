"""Both models against everything whose exact answer is known.

Figures and model errors with their stated uncertainties, of scenes solved as `run` does (`scenes`)
and of contacts on the library's operators (`operators`), smooth and rough (`rough`); observed
orders (`coverage`); manufactured solutions (`manufactured`); the contact by PETSc's own solver
(`independent_solver`)."""

from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

from comparisons.campaigns.cases import Case, answers_of, carried_out, check_places, rows_of, write
from comparisons.campaigns.verify.coverage import (
    FEWEST,
    FEWEST_ROUGH,
    Verification,
    order_cases,
    verification,
)
from comparisons.campaigns.verify.operators import operator_cases, operator_contacts
from comparisons.campaigns.verify.pages import verify_page
from comparisons.campaigns.verify.scenes import exact_scenes, scene_cases, spread
from comparisons.common.errors import InputError
from comparisons.common.mpi import is_several
from comparisons.common.progress import ProgressCallback, no_progress

DEGREES = (1, 2, 3)


@dataclass(frozen=True)
class Scope:
    """What to verify."""

    exact: tuple[Case, ...]  # cases that yield figures with exact values
    others: tuple[Case, ...] = ()  # cases of the finite elements
    # fewest, fewest_rough: informative figures that there must be, in all and of rough contacts
    fewest: int = FEWEST
    fewest_rough: int = FEWEST_ROUGH


def everything() -> Scope:
    from comparisons.campaigns.verify.independent_solver import independent_cases
    from comparisons.campaigns.verify.manufactured import BODIES, manufactured_cases
    from comparisons.campaigns.verify.rough import rough_cases

    contacts = operator_contacts()
    smooth = operator_cases(contacts, spread(len(contacts)))
    bodies = [(kind, degree) for kind in BODIES for degree in DEGREES]
    return Scope(
        (*scene_cases(exact_scenes()), *smooth, *rough_cases()),
        (*manufactured_cases(bodies), *independent_cases()),
    )


def verify(
    out: Path,
    junit: Path | None = None,
    callback: ProgressCallback = no_progress,
    scope: Scope | None = None,
) -> Verification:
    """Verify; leave verify.json and verify.html in `out`, JUnit XML in the file `junit`. Raises
    InputError where those cannot be written, and under mpirun."""
    if is_several():
        raise InputError("verify: runs in several processes; allowed is one, without mpirun")
    check_places("verify", out, junit)
    scope = scope or everything()
    start = perf_counter()
    cases = (*scope.exact, *scope.others)
    kept = answers_of(out, cases)
    rows = rows_of(cases, callback, kept)
    exact, others = rows[: len(scope.exact)], rows[len(scope.exact) :]
    rows = (*exact, *map(carried_out, order_cases(exact)), *others)
    verified = verification(rows, perf_counter() - start, scope.fewest, scope.fewest_rough)
    write(verified, out, junit, verify_page(verified))
    kept.discard()
    return verified
