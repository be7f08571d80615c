"""Both models against everything whose exact answer is known.

Figures and their stated uncertainties by the product's own road (`verify_scenes`, `verify_pairs`)
and on the library's operators (`verify_operators`); observed orders (`verify_orders`); manufactured
solutions (`verify_manufactured`); the contact by PETSc's own solver (`verify_second_road`).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from comparisons.common.errors import InputError
from comparisons.common.files import check_writable, published
from comparisons.common.mpi import is_several
from comparisons.common.progress import ProgressCallback, Stages, Step, no_progress
from comparisons.common.provenance import as_json
from comparisons.studies.verify.checks import Check
from comparisons.studies.verify.junit import junit
from comparisons.studies.verify.operators import OperatorCase, operator_cases, operator_pairs
from comparisons.studies.verify.orders import figure_orders, pressure_orders
from comparisons.studies.verify.pairs import FEWEST, Solved, solved
from comparisons.studies.verify.result import Failure, Verification
from comparisons.studies.verify.scenes import ExactScene, exact_scenes
from comparisons.studies.verify.table import verify_page
from meshes.block import MeshError

DEGREES = (1, 2, 3)
SCENES_SHARE = 0.9  # of the time, for what is told
OWN_FILES = ("verify.json", "verify.html")


@dataclass(frozen=True)
class Scope:
    """What to verify.

    manufactured  kinds of bodies and degrees of their elements
    second_road   names of the scenes that both roads solve
    fewest        figures with exact answers that there must be
    """

    scenes: tuple[ExactScene, ...]
    operators: tuple[OperatorCase, ...]
    manufactured: tuple[tuple[str, int], ...]
    second_road: tuple[str, ...]
    fewest: int = FEWEST


def everything() -> Scope:
    """The scope of `crosscheck verify`."""
    from comparisons.studies.verify.independent_solver import SCENES
    from comparisons.studies.verify.manufactured import BODIES

    bodies = tuple((kind, degree) for kind in BODIES for degree in DEGREES)
    return Scope(exact_scenes(), operator_cases(), bodies, tuple(SCENES))


def verify(
    out: Path,
    report: Path | None = None,
    callback: ProgressCallback = no_progress,
    scope: Scope | None = None,
) -> Verification:
    """Verify, and leave verify.json and verify.html in `out`, JUnit XML in the file `report`.

    Raises InputError where those cannot be written, and under mpirun.
    """
    if is_several():
        raise InputError("verify: runs in several processes; allowed is one, without mpirun")
    check_writable(out)
    if report is not None:
        _check_report(report)
    scope = scope or everything()
    stages = Stages(callback)
    results, failed = _scenes(scope.scenes, stages)
    pairs = [pair for _, found in results for pair in found.pairs]
    checks = [*figure_orders(pairs), *pressure_orders(results)]
    with stages.stage("operators", Step("exact contacts on the library's operators", SCENES_SHARE)):
        pairs += operator_pairs(scope.operators)
    checks += _finite_elements(scope, stages)
    found = Verification(
        tuple(pairs), tuple(checks), tuple(failed), dict(stages.seconds), scope.fewest
    )
    with published(out, OWN_FILES) as folder:
        (folder / "verify.json").write_text(as_json(_finite(found.as_dict())), encoding="utf-8")
        (folder / "verify.html").write_text(verify_page(found), encoding="utf-8")
    if report is not None:
        with published(report.parent, ()) as folder:
            (folder / report.name).write_text(junit(found), encoding="utf-8")
    return found


def _scenes(
    scenes: Sequence[ExactScene], stages: Stages
) -> tuple[list[tuple[str, Solved]], list[Failure]]:
    """Each scene by each of its models; one that cannot be solved is a finding, not the end."""
    found, failed = [], []
    asked = [(model, scene) for scene in scenes for model in scene.models]
    for number, (model, scene) in enumerate(asked, start=1):
        with stages.stage(model, _scene_step(number, len(asked), f"{model}, {scene.name}")):
            try:
                found.append((model, solved(scene, model)))
            except (ArithmeticError, InputError, MeshError, RuntimeError) as error:
                failed.append(Failure(scene.name, model, str(error)))
    return found, failed


def _scene_step(number: int, count: int, name: str) -> Step:
    return Step(f"{number} of {count}: {name}", SCENES_SHARE * (number - 1) / count)


def _finite_elements(scope: Scope, stages: Stages) -> list[Check]:
    """Manufactured solutions, and both roads to the contact."""
    from comparisons.studies.verify.independent_solver import SCENES, both_roads
    from comparisons.studies.verify.manufactured import manufactured_orders

    checks = []
    for kind, degree in scope.manufactured:
        with stages.stage("manufactured", f"manufactured solution: {kind}, degree {degree}"):
            checks += manufactured_orders(kind, degree)
    for name in scope.second_road:
        with stages.stage("second road", f"PETSc's own contact: {name}"):
            checks += both_roads(name, SCENES[name])
    return checks


def _check_report(report: Path) -> None:
    if report.is_dir():
        raise InputError(f"{report}: cannot be written: it is a folder; allowed is a file")
    check_writable(report.parent)


def _finite(content: dict) -> dict:
    """JSON has no NaN: None stands for a figure that there is not."""
    import math

    def plain(value: object) -> object:
        if isinstance(value, dict):
            return {key: plain(item) for key, item in value.items()}
        if isinstance(value, list):
            return [plain(item) for item in value]
        return None if isinstance(value, float) and not math.isfinite(value) else value

    return plain(content)
