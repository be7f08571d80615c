"""What a finished cost study holds, and the content of cost.json."""

from dataclasses import dataclass

from comparisons.common.quantities import QUANTITIES
from comparisons.models.problem import Problem
from comparisons.studies.cost.choice import Assessed, Choice, followed
from comparisons.studies.cost.reference import Reference
from comparisons.studies.cost.study import Study

SCHEMA = 1


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
