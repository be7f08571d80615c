"""The half-plane's model error: its error beyond the numerical ones, split into effects.

All is relative to the whole, the finite elements with every effect that matters, so that the error
is the same whether an effect is added here or switched on in the scene. The whole is the scene's
own finite elements on their finest level, and what these do not contain of it on the level of the
effects. A largest value is followed asperity by asperity, and the whole's is the largest of these
in the end: an effect is what changes at that asperity. Where the half-plane has its own largest
value at another one, what lies between the two is the jump, no effect."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from comparisons.figures.convergence import grid_convergence
from comparisons.figures.figure import Figure, Part
from comparisons.figures.quantity import QUANTITIES
from comparisons.figures.uncertainty import (
    difference_of_figures,
    far_boundary,
    iteration,
    of_increments,
)
from comparisons.judging.effects.laws import LawSolutions, LawSpread
from comparisons.judging.model_error.contributions import OF_SIZE, EffectContributions
from comparisons.judging.model_error.quantities_of_interest import (
    LARGEST,
    QuantitiesOfInterest,
    quantities_of,
)
from comparisons.judging.rule import formal_order, judged, relative_resolution, values_of
from comparisons.judging.study import Case
from comparisons.models.level import ModelRun
from comparisons.models.problem import Problem

NEAR = 0.5  # of the largest value: asperities below it do not compete


@dataclass(frozen=True)
class ModelError:
    """Of one quantity at one friction coefficient, relative to the whole."""

    quantity: str
    friction: float
    effects: dict[str, Part]  # by name, what each changes in the finite elements
    interaction: float  # what they change jointly beyond their sum
    value: float  # (half-plane - whole) / whole
    uncertainty: float  # of `value`
    scale: float = 1.0  # the whole's figure [SI], or the Hertz contact's where that vanishes
    # of elasticity; its middle is a part of `value`
    law: LawSpread = field(default_factory=LawSpread)
    # of a largest value: what the half-plane's own exceeds its value at the whole's asperity
    jump: float = 0.0
    # x [m] of the half-plane's largest value and of the whole's, where these are at two asperities,
    # else None
    moved: tuple[float, float] | None = None


@dataclass(frozen=True)
class Solutions:
    """What was solved of one case, and the model errors that follow."""

    case: Case
    # the effects on the first levels, coarse to fine; perhaps of the whole alone on the last; none
    # where the whole has no solution
    history: tuple[EffectContributions, ...] = ()
    laws: LawSolutions | None = None  # the whole with other laws; None: its own is known
    # the whole, at small strains, on the coarsest level by longer increments of flow, the longest
    # first, and by its own; empty: they have no solution; None: it does not flow, or the scene's
    # own finite elements do
    longer: list[QuantitiesOfInterest] | None = None
    # by effect of size, what lacks it on the coarsest level with its far boundary at half the
    # distance, where it has a solution
    nearer: dict[str, QuantitiesOfInterest] = field(default_factory=dict)

    @property
    def problem(self) -> Problem:
        return self.case.problem

    @property
    def runs(self) -> Mapping[str, ModelRun]:
        return self.case.runs

    @cached_property
    def split_levels(self) -> list[EffectContributions]:
        """Those on which the effects are solved one by one; none where one cannot be split."""
        split = [level for level in self.history if level.nothing is not None]
        return [] if any(level.unsplit for level in self.history) else split

    @cached_property
    def effects(self) -> list[str]:
        """Names of the effects that every split level has."""
        last = self.split_levels[-1].pairs if self.split_levels else {}
        return [name for name in last if all(name in level.pairs for level in self.split_levels)]

    @cached_property
    def values(self) -> dict[str, dict[str, float]]:
        """Of each model's finest level, by model and quantity [SI]."""
        runs = self.runs.items()
        return {name: values_of(run.finest, self.problem) for name, run in runs}

    @cached_property
    def half_plane(self) -> list[QuantitiesOfInterest]:
        return self._levels("half_plane")

    @cached_property
    def of_scene(self) -> list[QuantitiesOfInterest]:
        """The scene's own finite elements, by level."""
        return self._levels("finite_element")

    def _levels(self, model: str) -> list[QuantitiesOfInterest]:
        return [quantities_of(level, self.problem) for level in self.runs[model].levels]

    @cached_property
    def wholes(self) -> list[QuantitiesOfInterest]:
        """With every effect, on the levels of the effects."""
        return [level.whole for level in self.history]

    @cached_property
    def missing(self) -> list[QuantitiesOfInterest]:
        """What the scene's own finite elements lack of the wholes."""
        return [level.not_contained for level in self.history]

    @cached_property
    def whole(self) -> QuantitiesOfInterest:
        """The finest one: the scene's own finite elements there, and what they lack. A whole that
        flows beside them stands for itself: what flow takes depends on the level as they do."""
        if self.longer is not None:
            return self.wholes[-1]
        lacking = self.missing[-1].figures.items()
        figures = {name: self.of_scene[-1].figures[name] + value for name, value in lacking}
        return QuantitiesOfInterest(figures)

    @cached_property
    def unsolved(self) -> float:
        """What the solvers' iterations leave, relative."""
        number = len(self.history) - 1
        pairs = ((run.finest, run.levels[number]) for run in self.runs.values())
        return iteration(*(level.solution for pair in pairs for level in pair))

    @cached_property
    def resolutions(self) -> dict[str, float]:
        """By quantity, what the pressure elements of the effects' finest level cannot resolve."""
        level = self.runs["finite_element"].levels[len(self.history) - 1]
        return {
            "contact_length": relative_resolution(level, level),
            "peak_pressure": self.wholes[-1].peak_resolution,
        }

    def error(self, row: Figure) -> ModelError:
        """Of the quantity of a row of the models' comparison."""
        name, at = row.quantity, self.whole.leading(row.quantity)
        effects = {effect: self._effect(name, effect, at, row.numerical) for effect in self.effects}
        interaction = 0.0
        if self.split_levels:
            joint = [level.interaction(self.effects) for level in self.split_levels]
            interaction, _ = self._estimate(name, joint, at)
        value, uncertainty, scale = self._of_figure(name, row.numerical, at)
        jump, moved = self._jump(name, row.numerical, at)
        return ModelError(
            quantity=name,
            friction=self.case.friction,
            effects=effects,
            interaction=interaction,
            value=value,
            uncertainty=uncertainty,
            scale=scale,
            law=self._law(name, at),
            jump=jump,
            moved=moved,
        )

    def _spread(self, name: str, at: int) -> LawSpread:
        return LawSpread() if self.laws is None else self.laws.spread(name, at)

    def _figure(self, name: str, at: int) -> float:
        """Of the whole [SI], by the middle of what its law of elasticity may be."""
        figure = self.whole.figures[name][at]
        middle = self._spread(name, at).middle
        return figure + middle * _scale(figure, name, self.problem) if middle else figure

    def _law(self, name: str, at: int) -> LawSpread:
        """Relative to the figure that the error is relative to, and of the error."""
        spread = self._spread(name, at)
        if spread == LawSpread():
            return spread
        figure = self._figure(name, at)
        scale = _scale(figure, name, self.problem)
        over = _scale(self.whole.figures[name][at], name, self.problem) / scale
        ratio = max(1.0, abs(self.values["half_plane"][name] / scale))
        sizes = spread.middle * over, spread.half * over * ratio, spread.scatter * over * ratio
        return LawSpread(*map(float, sizes))

    def _order(self, name: str) -> float:
        """Of convergence under refinement."""
        finest = [run.finest for run in self.runs.values()]
        return formal_order(name, finest, self.problem)

    def _estimate(
        self, name: str, changes: list[QuantitiesOfInterest], at: int
    ) -> tuple[float, float]:
        """The relative size, with its uncertainty, of changes, one a level, at an asperity."""
        # by one scale: a place may jump to the surface on one level alone
        scale = self._scale_of(name, at)
        values = [float(change.figures[name][at] / scale) for change in changes]
        if not any(values):
            return 0.0, 0.0
        resolution = self.resolutions.get(name, 0.0)
        refined = grid_convergence(values, self._order(name), resolution)
        return values[-1], refined.uncertainty + self.unsolved

    def _effect(self, name: str, effect: str, at: int, numerical: float) -> Part:
        changes = [level.effect(effect) for level in self.split_levels]
        (size, unsure), pair = (
            self._estimate(name, changes, at),
            self.split_levels[-1].pairs[effect],
        )
        if effect in OF_SIZE:
            # of the far boundary of the solution without it; unknown where none is nearer
            domain = np.inf
            if effect in self.nearer:
                ends = self.nearer[effect], self.split_levels[0].pairs[effect][1]
                domain = far_boundary(*(solution.figures[name][at] for solution in ends))
                domain /= self._scale_of(name, at)
            unsure += domain
        with_it, without = (solution.figures.get(LARGEST.get(name)) for solution in pair)
        if with_it is None:
            return Part(effect, size, unsure)
        certain = with_it.max() / (1.0 + max(unsure, numerical))  # which may be infinite
        return Part(effect, size, unsure, bool(certain > with_it[np.argmax(without)]))

    def _of_figure(self, name: str, numerical: float, at: int) -> tuple[float, float, float]:
        """Error of a figure, its uncertainty, and what both are relative to [SI]."""
        figure = self._figure(name, at)
        scale = _scale(figure, name, self.problem)
        numerical *= _scale(self.values["finite_element"][name], name, self.problem) / scale
        if at != self.of_scene[-1].leading(name):  # the comparison is at another asperity
            sequence = [level.figures[name][at] / scale for level in self.of_scene]
            refined = grid_convergence(sequence, self._order(name))
            numerical = max(numerical, self.unsolved + refined.uncertainty)
        lacking, half_plane = self._lacking(name, at), self.values["half_plane"][name]
        if self.longer is not None:  # the half-plane on its finest level, the whole on another
            stated = judged(self.runs["half_plane"], self.problem)[name]
            numerical += stated.numerical * _scale(half_plane, name, self.problem) / scale
        uncertainty = difference_of_figures(numerical, half_plane / scale, lacking)
        if name in LARGEST:
            uncertainty += self._of_competitors(name, numerical, at) / scale
        return float((half_plane - figure) / scale), float(uncertainty), float(scale)

    def _lacking(self, name: str, at: int) -> float:
        """Uncertainty of what the whole has beside the scene's own finite elements, relative. One
        that flows beside them stands for itself: by its levels, and by its increments."""
        levels = self.missing if self.longer is None else self.wholes
        return self._estimate(name, levels, at)[1] + self._increments(name, at)

    def _increments(self, name: str, at: int) -> float:
        """The part by increments of flow; unknown where longer ones have no solution."""
        if not self.longer:
            return 0.0 if self.longer is None else np.inf
        scale = self._scale_of(name, at)
        return of_increments([float(value.figures[name][at] / scale) for value in self.longer])

    def _of_competitors(self, name: str, numerical: float, at: int) -> float:
        """What asperities that may have the largest value add to the uncertainty of a figure [SI].

        numerical  of the figure, relative"""
        largest, whole = LARGEST[name], self.whole.figures
        stated = judged(self.runs["finite_element"], self.problem)
        alone = stated[largest].numerical  # a depth does not say where it is
        alone = max(numerical, alone) if largest == name else alone
        beside = self.missing if self.longer is None else self.wholes
        values, top = whole[largest], whole[largest][at]

        def missing(k: int) -> float:
            """By asperity, how sure is what the whole has beside them."""
            return self._estimate(largest, beside, k)[1]

        if not np.isfinite(alone + missing(at)):
            return 0.0  # it is unknown already

        def doubt(k: int) -> float:
            return alone * abs(values[k]) + missing(k) * abs(top)

        least = top - doubt(at)
        near = [k for k in np.flatnonzero(values > NEAR * top) if values[k] + doubt(k) >= least]
        if name == largest:
            return max(values[k] + doubt(k) for k in near) - top - doubt(at)
        return max(abs(whole[name][k] - whole[name][at]) for k in near)

    def _jump(
        self, name: str, numerical: float, at: int
    ) -> tuple[float, tuple[float, float] | None]:
        """What the half-plane's largest value exceeds its value at the whole's asperity by, and
        both places where these are no twin peaks, as ModelError has them."""
        half_plane, before = self.half_plane[-1], self.half_plane[-1].leading(name)
        if before == at:
            return 0.0, None
        largest, figures = LARGEST[name], half_plane.figures
        apart = figures[name][before] - figures[name][at]
        jump = float(apart / _scale(self._figure(name, at), name, self.problem))
        if not figures[largest][before] / figures[largest][at] - 1.0 > numerical:
            return jump, None
        places = half_plane.places[largest][before], self.wholes[-1].places[largest][at]
        return jump, (float(places[0]), float(places[1]))

    def of_variants(self, name: str, levels: Sequence[QuantitiesOfInterest]) -> ModelError:
        """Of finite elements with other effects, on the last of the levels of the effects."""
        at = self.whole.leading(name)
        scale, middle = self._scale_of(name, at), self._spread(name, at).middle
        apart = [
            (one.largest()[name] - (1.0 + middle) * whole.largest()[name]) / scale
            for one, whole in zip(levels, self.wholes, strict=False)
        ]
        if not any(apart):
            return self._plain_error(name, at, 0.0, 0.0)
        resolution = self.resolutions.get(name, 0.0)
        unsure = grid_convergence(apart, self._order(name), resolution).uncertainty + self.unsolved
        unsure += self._increments(name, at)
        return self._plain_error(name, at, float(apart[-1]), float(unsure))

    def of_exact(self, name: str, exact: QuantitiesOfInterest, numerical: float) -> ModelError:
        """Of a model without numerical error.

        numerical  relative uncertainty of the scene's own finite elements"""
        at = self.whole.leading(name)
        lacking = self._lacking(name, at)
        scale, value = self._scale_of(name, at), exact.largest()[name]
        numerical *= abs(self.of_scene[-1].largest()[name]) / scale
        unsure = float(difference_of_figures(numerical, value / scale, lacking))
        value = float((value - self._figure(name, at)) / scale)
        return self._plain_error(name, at, value, unsure)

    def of_whole(self, name: str, numerical: float) -> ModelError:
        """What is not known of the whole itself."""
        at = self.whole.leading(name)
        return self._plain_error(name, at, 0.0, numerical + self._lacking(name, at))

    def _scale_of(self, name: str, at: int) -> float:
        return _scale(self._figure(name, at), name, self.problem)

    def _plain_error(self, name: str, at: int, value: float, unsure: float) -> ModelError:
        scale, law = self._scale_of(name, at), self._law(name, at)
        return ModelError(name, self.case.friction, {}, 0.0, value, unsure, scale, law=law)


def _scale(figure: float, name: str, problem: Problem) -> float:
    """What differences are measured by [SI]: the figure, the Hertz contact's where it vanishes."""
    return abs(figure) or QUANTITIES[name].scale(problem.hertz)
