"""The half-plane's model error: its error beyond the numerical ones, split into effects.

All is relative to the whole, the finite elements with every effect that matters, so that the error
is the same whether an effect is added here or switched on in the scene. The whole is the scene's
own finite elements on their finest level, and what these do not contain of it on the level of the
effects. A largest value is followed asperity by asperity, and the whole's is the largest of these
in the end: an effect is what changes at that asperity. Where the half-plane has its own largest
value at another one, what lies between the two is the jump, no effect. Norms do not add: their
error is the norm of the half-plane against the whole on the level of the effects, with the far
boundary of the models' difference."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from comparisons.figures.convergence import grid_convergence
from comparisons.figures.figure import Figure
from comparisons.figures.quantity import QUANTITIES
from comparisons.figures.uncertainty import (
    LENGTHS,
    difference_of_figures,
    difference_of_norms,
    iteration,
    peak_resolution,
    relative_resolution,
)
from comparisons.models.level import ModelRun
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.studies.contact import uncertainties, values_of
from comparisons.studies.model_error.contributions import EffectContributions
from comparisons.studies.model_error.quantities_of_interest import (
    LARGEST,
    QuantitiesOfInterest,
    quantities_of,
    relative_sizes,
)

NEAR = 0.5  # of the largest value: asperities below it do not compete


@dataclass(frozen=True)
class Estimate:
    """A relative size with its uncertainty, absolute in the same measure."""

    value: float
    uncertainty: float
    # whether the effect by itself moves the largest value to another asperity
    moves_maximum: bool = False


@dataclass(frozen=True)
class ModelError:
    """Of one quantity at one friction coefficient, relative to the whole."""

    quantity: str
    friction: float
    effects: dict[str, Estimate]  # by name, what each changes in the finite elements
    interaction: float  # what they change jointly beyond their sum
    value: float  # (half-plane - whole) / whole, or the norm of that difference
    uncertainty: float  # of `value`
    scale: float = 1.0  # the whole's figure [SI], or the Hertz contact's where that vanishes
    # of a largest value: what the half-plane's own exceeds its value at the whole's asperity
    jump: float = 0.0
    # x [m] of the half-plane's largest value and of the whole's, where these are at two asperities,
    # else None
    moved: tuple[float, float] | None = None

    @property
    def interacts(self) -> bool:
        """Whether no effect explains the error: they change more jointly than any by itself."""
        sizes = [abs(effect.value) for effect in self.effects.values()]
        return bool(sizes) and abs(self.interaction) > max(sizes)


def model_errors(
    problem: Problem,
    window: Window | None,
    runs: dict[str, ModelRun],
    rows: list[Figure],
    history: list[EffectContributions],
) -> list[ModelError]:
    """One for each row, all of one friction coefficient.

    rows     the models' comparison at that friction
    history  the effects there on the first levels, coarse to fine; perhaps of the whole alone on
             the last of these"""
    friction = rows[0].friction
    number, divided = len(history) - 1, [parts for parts in history if parts.nothing is not None]
    if any(parts.unsplit for parts in history):
        divided = []
    names = list(divided[-1].pairs) if divided else []
    names = [name for name in names if all(name in parts.pairs for parts in divided)]
    values = {model: values_of(run.finest, problem, friction) for model, run in runs.items()}
    levels = {
        model: [quantities_of(level, problem, friction) for level in run.levels]
        for model, run in runs.items()
    }
    half_plane, own = levels["half_plane"], levels["finite_element"]
    wholes, missing = [parts.whole for parts in history], [p.not_contained for p in history]
    contains_all = not (
        missing[-1].pressure.any() or any(map(np.any, missing[-1].figures.values()))
    )
    figures = {name: own[-1].figures[name] + each for name, each in missing[-1].figures.items()}
    whole = QuantitiesOfInterest(figures, wholes[-1].pressure, wholes[-1].tau1)
    unsolved = iteration(
        *(level for run in runs.values() for level in (run.finest, run.levels[number]))
    )
    reference = runs["finite_element"].levels[number]
    stated = uncertainties(runs["finite_element"], problem, friction)
    edge = relative_resolution(reference, reference)
    resolutions = dict.fromkeys(LENGTHS, edge)
    resolutions["peak_pressure"] = peak_resolution(wholes[-1].pressure)

    def share(name: str, changes: list[QuantitiesOfInterest], at: int) -> Estimate:
        if QUANTITIES[name].of_pair:
            values = [
                relative_sizes(change, reference, problem, window)[name]
                for change, reference in zip(changes, wholes, strict=False)
            ]
        else:  # by one scale: a place may jump to the surface on one level alone
            scale = _scale(whole.figures[name][at], name, problem)
            values = [float(change.figures[name][at] / scale) for change in changes]
        if not any(values):
            return Estimate(0.0, 0.0)
        formal_order, resolution = QUANTITIES[name].formal_order, resolutions.get(name, 0.0)
        refined = grid_convergence(values, formal_order, resolution)
        return Estimate(values[-1], refined.uncertainty + unsolved)

    def of_effect(name: str, effect: str, at: int, numerical: float) -> Estimate:
        found = share(name, [parts.effect(effect) for parts in divided], at)
        pair = divided[-1].pairs[effect]
        with_it, without = (each.figures.get(LARGEST.get(name)) for each in pair)
        if with_it is None:
            return found
        certain = with_it.max() / (1.0 + max(found.uncertainty, numerical))  # which may be infinite
        return replace(found, moves_maximum=bool(certain > with_it[np.argmax(without)]))

    def of_figure(row: Figure, numerical: float, at: int) -> tuple[float, float, float]:
        """Error of a figure, its uncertainty, and what both are relative to [SI]."""
        name, figure = row.quantity, whole.figures[row.quantity][at]
        scale = _scale(figure, name, problem)
        numerical *= _scale(values["finite_element"][name], name, problem) / scale
        if at != own[-1].leading(name):  # the comparison is at another asperity
            sequence = [each.figures[name][at] / scale for each in own]
            numerical = max(
                numerical,
                unsolved + grid_convergence(sequence, QUANTITIES[name].formal_order).uncertainty,
            )
        lacking = share(name, missing, at).uncertainty
        half_plane_value = values["half_plane"][name]
        uncertainty = difference_of_figures(numerical, half_plane_value / scale, lacking)
        if name in LARGEST:
            largest = LARGEST[name]
            alone = stated[largest].total  # a depth does not say where it is
            alone = max(numerical, alone) if largest == name else alone
            others = _competing(whole, name, at, alone, lambda k: share(largest, missing, k))
            uncertainty += others / scale
        return float((half_plane_value - figure) / scale), float(uncertainty), float(scale)

    found = []
    for row in rows:
        name, at = row.quantity, whole.leading(row.quantity)
        numerical, scale = row.numerical, 1.0
        effects = {effect: of_effect(name, effect, at, numerical) for effect in names}
        jump, moved, joint = 0.0, None, 0.0
        if divided:
            joint = share(name, [parts.interaction(names) for parts in divided], at).value
        if not QUANTITIES[name].of_pair:
            value, uncertainty, scale = of_figure(row, numerical, at)
            before = half_plane[-1].leading(name)
            if before != at:
                largest, figure = LARGEST[name], half_plane[-1].figures
                apart = figure[name][before] - figure[name][at]
                jump = float(apart / _scale(whole.figures[name][at], name, problem))
                if figure[largest][before] / figure[largest][at] - 1.0 > numerical:  # no twin peaks
                    places = half_plane[-1].places[largest][before], wholes[-1].places[largest][at]
                    moved = float(places[0]), float(places[1])
        elif not contains_all:
            differences = [a - b for a, b in zip(half_plane[: len(wholes)], wholes, strict=True)]
            norm, there = share(name, differences, at), row.levels[number]
            lacking = share(name, missing, at).uncertainty
            parts = numerical, abs(there - row.value), lacking
            value, known = norm.value, row.uncertainty.parts
            beside = known["domain"] + known["increments"]
            uncertainty = difference_of_norms(norm.uncertainty, beside, parts)
        else:
            value, uncertainty = row.value, numerical
        of_row = effects, joint, value, uncertainty, scale, jump, moved
        found.append(ModelError(name, friction, *of_row))
    return found


def _competing(
    whole: QuantitiesOfInterest,
    name: str,
    at: int,
    numerical: float,
    missing: Callable[[int], Estimate],
) -> float:
    """What asperities that may have the largest value add to the uncertainty of a figure [SI].

    numerical  relative uncertainty of the scene's own finite elements
    missing    by asperity, what the whole has beside these, relative to the largest value"""
    values = whole.figures[LARGEST[name]]
    top = values[at]
    if not np.isfinite(numerical + missing(at).uncertainty):
        return 0.0  # it is unknown already

    def doubt(k: int) -> float:
        return numerical * abs(values[k]) + missing(k).uncertainty * abs(top)

    least = top - doubt(at)
    near = [k for k in np.flatnonzero(values > NEAR * top) if values[k] + doubt(k) >= least]
    if name == LARGEST[name]:
        return max(values[k] + doubt(k) for k in near) - top - doubt(at)
    return max(abs(whole.figures[name][k] - whole.figures[name][at]) for k in near)


def _scale(figure: float, name: str, problem: Problem) -> float:
    """What differences are measured by [SI]: the figure, the Hertz contact's where it vanishes."""
    return abs(figure) or QUANTITIES[name].scale(problem.hertz)
