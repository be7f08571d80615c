"""The rule by which a model is judged: by itself, or against another on the same pressure elements.

In: a model on its levels. Out: figures of its finest one, or differences from the other, each with
the uncertainty that levels, the far boundary, increments of flow and iteration leave. A difference
is a figure of its own: what the pressure elements leave out is in both models."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import zip_longest
from typing import Self

import numpy as np

from comparisons.figures.convergence import LOWEST_ORDER
from comparisons.figures.figure import Figure
from comparisons.figures.quantity import NORMS, QUANTITIES
from comparisons.figures.uncertainty import (
    Reading,
    by_levels,
    far_boundary,
    iteration,
    length_resolution,
    of_increments,
    peak_resolution,
)
from comparisons.judging.study import COMPARISON, CONTACT
from comparisons.models.level import Level, Solution
from comparisons.models.problem import Problem
from comparisons.models.window import Window

UNDER_CREST = 4.0  # pressure elements within which stresses are as finely resolved as pressures
AT_SURFACE = 1e-3  # pressure elements below which a largest stress is at the surface
# By figure, the one whose largest value it is or belongs to.
LARGEST = {name: name for name in ("peak_pressure", "tau1_max", "txz_max_abs")}
LARGEST["tau1_max_depth"] = "tau1_max"
EXTREMES = {"tau1_max": "tau1", "txz_max_abs": "txz", "von_mises_max": "von_mises"}


def judged_by(
    study: str,
    models: Sequence[Solution],
    read: Callable[..., Mapping[str, float]],
    how: Callable[[str, float], Reading],
    at: Mapping[str, float],
    repeated: Mapping[str, tuple[float, float]] | None = None,
) -> dict[str, Figure]:
    """Figures by quantity of what is read off each level of a model, or of both models on the same
    pressure elements: relative differences, which have a sequence of their own.

    models    the model, and the one that it is judged against
    read      values by quantity, of a level of each model
    how       by quantity and its value on the finest levels
    repeated  by the far boundary and increments of flow; as `by_repetition` has it"""
    history = [read(*levels) for levels in zip(*(model.levels for model in models), strict=True)]
    repeated = by_repetition(models, read) if repeated is None else repeated
    source, against = [*(model.name for model in models), None][:2]
    figures = {}
    for name, value in history[-1].items():
        values, reading = tuple(of_level[name] for of_level in history), how(name, value)
        unit = 1.0 if against else reading.scale
        figures[name] = Figure(
            study=study,
            quantity=name,
            source=source,
            value=value,
            at=at,
            against=against,
            scale=reading.scale,
            uncertainty=by_levels(values, reading, repeated[name], unit),
            bounds=(-reading.tolerance, reading.tolerance) if reading.tolerance else None,
            place=reading.place,
            levels=values,
        )
    return figures


def judged(model: Solution, problem: Problem, against: Solution | None = None) -> dict[str, Figure]:
    """Figures by quantity: the model's [SI]; or (model - other) / other, judged where the scene has
    a tolerance. `problem` is that of the case."""
    both = [model] if against is None else [model, against]
    finest = [one.finest for one in both]
    reference = values_of(finest[-1], problem)

    def read(*levels: Level) -> dict[str, float]:
        values = [values_of(level, problem) for level in levels]
        return values[0] if against is None else relative_differences(*values, problem)

    def how(name: str, value: float) -> Reading:
        size = QUANTITIES[name].size(reference[name], problem.hertz)
        unsolved, resolution = iteration(*(level.solution for level in finest)), 0.0
        if against is not None:
            unsolved *= max(1.0, abs(1.0 + value))
        if name == "contact_length":
            resolution = relative_resolution(*finest) if against else edges_read(*finest) / size
        return Reading(
            order=formal_order(name, finest if against else model.levels, problem),
            scale=size,
            resolution=resolution,
            iteration=unsolved,
            # meshes and hats lack not the same of a crest: their difference was seen to stand still
            # on levels that lack it, and to fall from 2 % to nothing on those that come to resolve
            # it
            least=max(left_by_crest(name, level) for level in finest),
            tolerance=problem.scene.tolerances.get(name) if against else None,
        )

    at = {"friction": problem.scene.load.friction[0]}
    return judged_by(COMPARISON if against else CONTACT, both, read, how, at)


def norms_of(model: Solution, problem: Problem, against: Solution) -> Iterable[Figure]:
    """The norms of both models' difference. They may be equal by chance: what a repetition changes
    counts by its own norm."""
    both, first = (model, against), against.levels[0]
    read = partial(norms, window=problem.window)
    repeated = by_repetition([against], lambda level: read(level, first))
    unsolved = iteration(*(one.finest.solution for one in both))
    at = {"friction": problem.scene.load.friction[0]}

    def how(name: str, size: float) -> Reading:
        return Reading(NORMS[name].formal_order, iteration=unsolved)

    return judged_by(COMPARISON, both, read, how, at, repeated).values()


def values_of(level: Level, problem: Problem) -> dict[str, float]:
    """The compared quantities that one model has by itself, SI."""
    return quantities_of(level, problem).largest()


@dataclass(frozen=True)
class QuantitiesOfInterest:
    """Compared quantities of one model on one level at one friction coefficient, or a difference of
    such, on the same pressure elements. A largest value is one of each asperity
    (`Problem.asperities`): effects may move the largest of all from one to another, and the
    difference of two largest values at different points would measure neither."""

    # by quantity, SI: (k,) one an asperity, (1,) where it is no largest value
    figures: dict[str, np.ndarray]
    # of a model: x [m] of its largest values, undeformed, as `figures`
    places: dict[str, np.ndarray] = field(default_factory=dict)
    # of a model: how finely its peak pressure is read from the nodes, relative
    peak_resolution: float = 0.0

    def __sub__(self, other: Self) -> Self:
        return QuantitiesOfInterest(
            {name: value - other.figures[name] for name, value in self.figures.items()}
        )

    def leading(self, name: str) -> int:
        """The asperity of the largest value that a figure belongs to; 0 where it is none."""
        return int(np.argmax(self.figures[LARGEST[name]])) if name in LARGEST else 0

    def largest(self) -> dict[str, float]:
        """The figures of the leading asperity alone."""
        return {name: float(values[self.leading(name)]) for name, values in self.figures.items()}


def quantities_of(level: Level, problem: Problem) -> QuantitiesOfInterest:
    """Quantities of a solved level; `problem` is the one that it solves."""
    x = level.grid.x if level.material is None else level.material
    pressure, peaks = level.solution.pressure, np.full(len(problem.asperities) + 1, -1)
    rising = np.argsort(-pressure, kind="stable")[::-1]
    peaks[np.searchsorted(problem.asperities, x[rising])] = rising  # the last of each stays
    figures = {"peak_pressure": pressure[peaks], "contact_length": np.array([level.contact_length])}
    places = {"peak_pressure": x[peaks]}
    if (stress := level.stress) is not None:
        for name, key in (("tau1_max", "tau1"), ("txz_max_abs", "txz")):
            figures[name], places[name], depth = stress.maxima[key]
            if name == "tau1_max":
                # depths count from the level's boundary, whose heights [m] these are
                is_rough = level.mesh is not None and problem.rough_boundary
                boundary = problem.surface.profile.spline()(places[name]) if is_rough else 0.0
                figures["tau1_max_depth"] = depth + boundary
    return QuantitiesOfInterest(figures, places, peak_resolution(pressure))


def relative_differences(
    one: Mapping[str, float], reference: Mapping[str, float], problem: Problem
) -> dict[str, float]:
    """(one - reference) / reference of figures by name, or over Hertz's where that vanishes."""
    return {
        name: (value - reference[name]) / QUANTITIES[name].size(reference[name], problem.hertz)
        for name, value in one.items()
    }


def by_repetition(
    models: Sequence[Solution], read: Callable[..., Mapping[str, float]]
) -> dict[str, tuple[float, float]]:
    """Uncertainties by the far boundary and by the increments of flow of what is read off a level
    of each model, in its units: by the coarsest levels and what these were repeated with."""
    coarsest = [model.levels[0] for model in models]
    first = read(*coarsest)
    checks = [
        read(*coarsest[:k], level, *coarsest[k + 1 :])
        for k, model in enumerate(models)
        for level in model.repeated.get("domain", ())
    ]
    longer = zip_longest(*(model.repeated.get("increments", ()) for model in models))
    pairs = (zip(levels, coarsest, strict=True) for levels in longer)
    increments = [read(*(level or first for level, first in pair)) for pair in pairs]
    return {
        name: (
            sum(far_boundary(moved.get(name, value), value) for moved in checks),
            of_increments([figures.get(name, value) for figures in (*increments, first)]),
        )
        for name, value in first.items()
    }


def left_by_crest(name: str, level: Level) -> float:
    """Bound of a level's error by crests that it does not resolve, relative: of the peak pressure,
    and of a largest shear so near to the surface that it belongs to a crest."""
    key = EXTREMES.get(name)
    near = key and level.stress.extremes[key].z <= UNDER_CREST * level.grid.pitch
    return level.unresolved_crest if near or name == "peak_pressure" else 0.0


def formal_order(name: str, levels: Sequence[Level], problem: Problem) -> float:
    """Formal order of a quantity under refinement; on linear elements none is above 1. Where
    friction brings a largest stress to the surface, there it stands at an end of contact, next to
    which stresses go with the square root of the distance: half an order, whatever the elements."""
    key = EXTREMES.get(name)
    if key is not None:
        depths = (level.stress.extremes[key].z for level in levels)
        if any(z <= AT_SURFACE * level.grid.pitch for z, level in zip(depths, levels, strict=True)):
            return LOWEST_ORDER
    order, elements = QUANTITIES[name].formal_order, problem.scene.finite_element
    meshed = any(level.mesh is not None for level in levels)
    return min(order, elements.most_order) if meshed else order


def edges_read(level: Level) -> float:
    """Resolution of the level's length of contact [m]."""
    return length_resolution(level.grid.pitch, len(level.patches))


def relative_resolution(level: Level, reference: Level) -> float:
    """Resolution of the difference of two contact lengths, of two models or of an effect,
    relative to the reference's: both err."""
    ratio = level.contact_length / reference.contact_length
    return (edges_read(level) + ratio * edges_read(reference)) / reference.contact_length


def norms(level: Level, reference: Level, window: Window | None) -> dict[str, float]:
    """Relative L2 norms of the difference of the pressures of two levels on the same elements, and
    of their tau1 on the window, as far as both have that."""
    sizes = {"pressure_l2": relative_l2(level.solution.pressure, reference.solution.pressure)}
    tau1 = [known.stress and known.stress.tau1 for known in (level, reference)]
    if all(field is not None for field in tau1):
        fewer, taken = min(f.shape[1] for f in tau1), window.columns(window.norm_step)
        tau1 = [field if field.shape[1] == fewer else field[:, taken] for field in tau1]
        thickness = np.gradient(window.z)[:, None]  # of the layer that each depth stands for
        sizes["tau1_l2"] = relative_l2(*tau1, thickness)
    return sizes


def relative_l2(
    values: np.ndarray, reference: np.ndarray, weights: np.ndarray | float = 1.0
) -> float:
    """||values - reference|| / ||reference||; points where either is not finite are left out."""
    known = np.isfinite(values) & np.isfinite(reference)
    if not known.all():
        weights = np.broadcast_to(weights, values.shape)[known]
        values, reference = values[known], reference[known]
    size = np.sum(weights * reference**2)
    if size == 0.0:
        return 0.0 if not np.any(values) else np.inf
    return float(np.sqrt(np.sum(weights * (values - reference) ** 2) / size))
