"""A finished cost study: its rows with their errors, what to take, and the content of cost.json."""

from dataclasses import dataclass

from comparisons.campaigns.cost.recommend import (
    AssessedRow,
    Recommendation,
    pareto,
    recommendations,
    scene_sections,
)
from comparisons.campaigns.cost.reference import Reference, error_of, references
from comparisons.campaigns.cost.study import CostRow, CostRun, measuring_machine
from comparisons.common.errors import SceneError
from comparisons.common.provenance import versions
from comparisons.figures.quantity import QUANTITIES
from comparisons.models.problem import Problem
from comparisons.models.window import window_of

SCHEMA = 2


@dataclass(frozen=True)
class Cost:
    """A finished study."""

    problem: Problem
    study: CostRun
    references: dict[str, Reference]  # by quantity
    assessed: list[AssessedRow]  # every row with its errors
    # the rows on the Pareto front by quantity, the cheapest first
    fronts: dict[str, list[AssessedRow]]
    recommendations: list[Recommendation]  # one a tolerance, the last one for all of them
    versions: dict
    machine: dict


def assess(problem: Problem, study: CostRun) -> Cost:
    """Errors, Pareto fronts and recommendations of what was measured. Raises SceneError without a
    reference."""
    scene = problem.scene
    window = window_of(problem) if scene.stress is not None else None
    known = references(problem, study, window)
    if not known:
        failed = next((row.because for row in study.rows if row.because), "nothing was solved")
        raise SceneError(f"{scene.source}: there is no reference for errors: {failed}")

    def errors(row: CostRow) -> dict[str, float | None]:
        if row.measured is None:
            return {}
        return {
            name: None
            if row is reference.row
            else error_of(row.measured.solved, name, reference, problem, window)
            for name, reference in known.items()
        }

    rows = [AssessedRow(row, errors(row)) for row in study.rows]
    return Cost(
        problem=problem,
        study=study,
        references=known,
        assessed=rows,
        fronts={name: pareto(rows, name, known[name].floor) for name in known},
        recommendations=recommendations(rows, known, scene.tolerances),
        versions=versions(),
        machine=measuring_machine(),
    )


def content_of(cost: Cost) -> dict:
    """The content of cost.json: SI units, errors relative, None for what is unknown."""
    names = [name for name in QUANTITIES if name in cost.references]
    return {
        "schema": SCHEMA,
        "scene": cost.problem.surface.as_dict(cost.problem.scene),
        "reference": {
            name: {"source": r.source, "values": list(r.values), "uncertainty": r.floor}
            for name, r in ((name, cost.references[name]) for name in names)
        },
        "rows": [_row(cost, each) for each in cost.assessed],
        "recommendations": [
            {
                "quantity": each.quantity,
                "tolerance": each.tolerance,
                "sentence": each.sentence,
                "half_plane": _taken(cost, each.half_plane),
                "finite_element": _taken(cost, each.finite_element),
                "cheapest": _taken(cost, each.cheapest, scene=False),
            }
            for each in cost.recommendations
        ],
        "versions": cost.versions,
        "machine": cost.machine,
    }


def _row(cost: Cost, each: AssessedRow) -> dict:
    row, measured = each.row, each.row.measured
    found = {
        "method": row.method.name,
        "model": row.method.model,
        "pitch": row.setting,
        "status": row.status,
        "because": row.because,
    }
    if measured is None:
        return found
    return found | {
        "elements": measured.solved.elements,
        "unknowns": measured.solved.unknowns,
        "seconds": measured.seconds,
        "total": measured.total,
        "smallest_total": measured.spread[0],
        "largest_total": measured.spread[1],
        "wall": measured.wall,
        "repeats": measured.repeats,
        "peak_memory": measured.memory,
        "figures": list(measured.solved.figures),
        "errors": each.errors,
        "best_for": [name for name, front in cost.fronts.items() if each in front],
    }


def _taken(cost: Cost, each: AssessedRow | None, scene: bool = True) -> dict | None:
    """Its place in `rows`, and what to write into the scene for it."""
    if each is None:
        return None
    found = {"row": cost.assessed.index(each), "method": each.row.method.name}
    return found | {"scene": scene_sections(each.row, cost.problem)} if scene else found
