"""How deep every asperity of a solved contact is penetrated: elastic, plastic or cutting."""

import numpy as np

from analytic.statistics.penetration import contact_kind, relative_penetration
from comparisons.models.level import Level, MeshField
from comparisons.models.problem import Problem
from comparisons.studies.statistics.figures import PatchState

STRAIN = "equivalent_plastic_strain"


def patch_loads(level: Level) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Load [N/m], its centre [m] and peak pressure [Pa] (k,) of a level's patches. Pressures belong
    to the nearest patch."""
    patches, x = level.patches, level.grid.x
    carried = level.grid.weights * level.solution.pressure
    places = np.searchsorted(0.5 * (patches[:-1, 1] + patches[1:, 0]), x)
    load, moment = (np.bincount(places, each, len(patches)) for each in (carried, carried * x))
    peak = np.zeros(len(patches))
    np.maximum.at(peak, places, level.solution.pressure)
    return load, moment / load, peak


def patch_states(problem: Problem, level: Level) -> tuple[PatchState, ...]:
    """Every patch of a level."""
    patches, wanted = level.patches, problem.scene.statistics
    load, _, peak = patch_loads(level)
    depth = relative_penetration(peak, problem.modulus)
    rule = wanted.metal, wanted.lubricated
    kinds = {
        "book": contact_kind(depth["book"], depth["book"], *rule),
        "exact": contact_kind(depth["sphere"], depth["ridge"], *rule),
    }
    field = level.mesh_field
    flows = isinstance(field, MeshField) and STRAIN in field.others
    return tuple(
        PatchState(
            start=float(start),
            stop=float(stop),
            load=float(load[k]),
            peak=float(peak[k]),
            radius=float(np.pi * problem.modulus * (stop - start) ** 2 / (16.0 * load[k])),
            depth={name: float(values[k]) for name, values in depth.items()},
            kinds={name: str(values[k]) for name, values in kinds.items()},
            plastic_strain=_strain_below(field, start, stop) if flows else None,
        )
        for k, (start, stop) in enumerate(patches)
    )


def _strain_below(field: MeshField, start: float, stop: float) -> float:
    """The largest below a patch, no deeper than that is wide: first flow is at 0.4 of it."""
    x, z = field.points.T
    below = (x >= start) & (x <= stop) & (z <= stop - start)
    return float(np.max(field.others[STRAIN][below], initial=0.0))
