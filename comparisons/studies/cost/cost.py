"""Error against time of every method and setting that applies to a scene, and what to take."""

from dataclasses import dataclass
from pathlib import Path

from analytic.contact.problem import ContactError
from comparisons.common.errors import InputError, SceneError, SolverError
from comparisons.common.files import check_writable, published
from comparisons.common.mpi import is_several
from comparisons.common.processes import ProcessEnded, fresh_process
from comparisons.common.progress import Listener, silent
from comparisons.common.quantities import QUANTITIES
from comparisons.models.problem import Problem, problem_of
from comparisons.models.window import window_of
from comparisons.results.record import as_json, versions
from comparisons.scenes.scene import ResolvedScene
from comparisons.studies.cost.cache import CostStore, measuring_machine
from comparisons.studies.cost.choice import Assessed, Choice, choices, followed, pareto
from comparisons.studies.cost.methods import METHODS, Method
from comparisons.studies.cost.reference import Reference, error_of, references
from comparisons.studies.cost.study import Row, Study, measured_study
from meshes.errors import MeshError

SCHEMA = 1
FILES = ("cost.json", "cost.html")
GOES_ON = "measured settings are kept, the same command goes on from there"


@dataclass(frozen=True)
class Cost:
    """A finished study.

    references  by quantity            assessed  every row with its errors
    fronts      by quantity, rows that nothing beats, from cheap to dear
    choices     one a tolerance, the last for all of them
    """

    problem: Problem
    study: Study
    references: dict[str, Reference]
    assessed: list[Assessed]
    fronts: dict[str, list[Assessed]]
    choices: list[Choice]
    versions: dict
    machine: dict

    @property
    def floors(self) -> dict[str, float]:
        return {name: reference.floor for name, reference in self.references.items()}


def cost(
    scene: ResolvedScene,
    out: Path,
    repeats: int,
    listener: Listener = silent,
    methods: tuple[Method, ...] = METHODS,
) -> Cost:
    """Measure, judge, and leave cost.json and cost.html in `out`, whole or not at all.

    What was measured stays beside them (`comparisons.studies.cost.cache`): the same study goes on
    from there, or has it all. Raises InputError for a scene that cannot be solved, or a folder that
    cannot be written, KeyboardInterrupt with how to go on.
    """
    if is_several():
        raise InputError("cost: is measured by one process on one thread; allowed without mpirun")
    if repeats < 1:
        raise InputError(f"--repeats: is {repeats}; allowed is 1 or more")
    check_writable(out)
    store = CostStore(out, scene, repeats)
    store.tidy()
    try:
        problem = _problem(scene, store, listener)
        found = judged(problem, measured_study(problem, repeats, store, listener, methods))
        listener("drawing the diagrams")
        from comparisons.studies.cost.page import cost_page

        with published(out, FILES) as folder:
            (folder / "cost.json").write_text(as_json(content_of(found)), encoding="utf-8")
            (folder / "cost.html").write_text(cost_page(found), encoding="utf-8")
    except KeyboardInterrupt:
        raise KeyboardInterrupt(GOES_ON) from None
    return found


def _problem(scene: ResolvedScene, store: CostStore, listener: Listener) -> Problem:
    """The scene's problem; a prescribed approach is turned into its load."""
    listener("finding the reach of the contact")
    try:
        if scene.load.kind != "approach":
            return problem_of(scene)
        load = store.load_per_length()
        if load is None:
            listener("finite elements: load of the prescribed approach")
            with fresh_process() as call:
                load = call(_load_of_approach, scene)
            store.save_load_per_length(load)
        return problem_of(scene, load)
    except ProcessEnded as error:
        raise SolverError(
            f"{scene.source}: load.approach: the process that looked for its load ended; allowed "
            "is a load (per_length) instead"
        ) from error
    except (ContactError, MeshError) as error:
        raise SceneError(f"{scene.source}: {error}") from error


def _load_of_approach(scene: ResolvedScene) -> float:
    """[N/m]; in a process of its own, which an interrupt ends at once."""
    from comparisons.models.finite_element.load_at_approach import problem_of_approach

    return problem_of_approach(scene, silent).hertz.load_per_length


def judged(problem: Problem, study: Study) -> Cost:
    """Errors, fronts and choices of what was measured."""
    scene = problem.scene
    window = window_of(problem) if scene.stress is not None else None
    known = references(problem, study, window)
    if not known:
        failed = next((row.because for row in study.rows if row.because), "nothing was solved")
        raise SceneError(f"{scene.source}: there is nothing to measure errors by: {failed}")

    def errors(row: Row) -> dict[str, float | None]:
        if row.measured is None:
            return {}
        answer = row.measured.answer
        return {
            name: None
            if row is reference.row
            else error_of(answer, name, reference, problem, window)
            for name, reference in known.items()
        }

    assessed = [Assessed(row, errors(row)) for row in study.rows]
    return Cost(
        problem=problem,
        study=study,
        references=known,
        assessed=assessed,
        fronts={name: pareto(assessed, name, known[name].floor) for name in known},
        choices=choices(study, assessed, known, scene.tolerance),
        versions=versions(),
        machine=measuring_machine(),
    )


def content_of(cost: Cost) -> dict:
    """The content of cost.json: SI units, errors relative, None for what is unknown."""
    names = [name for name in QUANTITIES if name in cost.references]
    return {
        "schema": SCHEMA,
        "scene": cost.problem.scene.as_dict(),
        "reference": {
            name: {
                "source": cost.references[name].source,
                "values": list(cost.references[name].values),
                "uncertainty": cost.references[name].floor,
            }
            for name in names
        },
        "rows": [_row(cost, each) for each in cost.assessed],
        "choices": [
            {
                "quantity": choice.quantity,
                "tolerance": choice.tolerance,
                "sentence": choice.sentence,
                "half_plane": _chosen(cost, choice.half_plane),
                "finite_element": _chosen(cost, choice.finite_element),
                "cheapest": _chosen(cost, choice.cheapest, scene=False),
            }
            for choice in cost.choices
        ],
        "versions": cost.versions,
        "machine": cost.machine,
    }


def _row(cost: Cost, each: Assessed) -> dict:
    row, measured = each.row, each.row.measured
    found = {
        "method": row.method.name,
        "model": row.method.model,
        "pitch": None if row.method.adapted else row.setting,
        "wanted_error": row.setting if row.method.adapted else None,
        "status": row.status,
        "because": row.because,
    }
    if measured is None:
        return found
    return found | {
        "elements": measured.answer.elements,
        "unknowns": measured.answer.unknowns,
        "seconds": measured.seconds,
        "total": measured.total,
        "smallest_total": measured.spread[0],
        "largest_total": measured.spread[1],
        "wall": measured.wall,
        "repeats": measured.repeats,
        "peak_memory": measured.memory,
        "figures": list(measured.answer.figures),
        "errors": each.errors,
        "best_for": [name for name, front in cost.fronts.items() if each in front],
    }


def _chosen(cost: Cost, each: Assessed | None, scene: bool = True) -> dict | None:
    """Which row, by its place in `rows`, and what to write into the scene for it."""
    if each is None:
        return None
    found = {"row": cost.assessed.index(each), "method": each.row.method.name}
    return found | {"scene": followed(each.row, cost.problem)} if scene else found
