"""The half-plane's model error: its error beyond the numerical ones, split into effects.

All is relative to the whole model, the finite elements with every effect that matters, so that the
error is the same whether an effect is added here or switched on in the scene. It is the scene's own
finite elements on their finest level, and what these do not contain of it on the level of the
effects. A largest value is followed asperity by asperity, and the whole model's is the largest of
these in the end: an effect is what changes at that asperity. Where the half-plane has its own
largest value at another one, what lies between the two is the jump, no effect.

With F(S) the finite elements' solution with the effects S, W all of them, k finite deformation,
c normal-tangential coupling, 0 none:

    an effect i            F({i}) - F(0)
    finite deformation     F(k + c) - F(c), c only under friction, where sliding traction moves it
    plastic flow           F(flow + c) - F(c)
    finite deformation of a body that flows    F(W) - F(W - k)
    interaction            F(W) - F(0) - the sum of these

These add up to F(W) - F(0), in any order: an effect without a solution by itself counts
in the interaction. The scene's own finite elements do not contain F(W) - F(scene)."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, reduce
from operator import sub

import numpy as np

from comparisons.figures.convergence import grid_convergence
from comparisons.figures.figure import Figure, Part
from comparisons.figures.quantity import QUANTITIES, WHOLE
from comparisons.figures.uncertainty import (
    Uncertainty,
    difference_of_figures,
    far_boundary,
    iteration,
    of_increments,
)
from comparisons.judging.effects.catalogue import (
    EFFECTS,
    FLOW,
    LAW,
    NONLINEAR,
    STRAINED,
    law_variants,
    model_with,
)
from comparisons.judging.effects.laws import LawSpread, OpenLaw, law_spread
from comparisons.judging.effects.selection import EffectSelection
from comparisons.judging.rule import (
    LARGEST,
    QuantitiesOfInterest,
    formal_order,
    judged,
    quantities_of,
    relative_resolution,
)
from comparisons.judging.study import MODEL_ERROR, Case
from comparisons.models.model import Model
from comparisons.models.plan import LONGER
from comparisons.models.problem import COUPLED, Problem

INTERACTION, JUMP = "interaction", "jump"  # parts beside the effects
INPUTS = "inputs"  # of the uncertainty: what the errors of measured constants change
NEAR = 0.5  # of the largest value: asperities below it do not compete


def figure_of(error: Figure, selection: EffectSelection, tolerance: Mapping[str, float]) -> Figure:
    """A model error with what no model has by a selection of effects, and judged where its quantity
    has a tolerance."""
    unknown, bound = selection.not_modelled(error.quantity), tolerance.get(error.quantity)
    bounds = None if bound is None else (-bound, bound)
    return replace(error, unknown=unknown | error.unknown, bounds=bounds)


@dataclass(frozen=True)
class SplitVariants:
    """The variants that the split takes at one friction coefficient."""

    whole: Model  # with all effects
    of_scene: Model | None  # that stands for the scene's own finite elements, None: these
    nothing: Model  # without any effect
    pairs: dict[str, tuple[Model, Model]]  # by effect, with and without it
    # whole models with other laws of elasticity, by index in the selection's, and probe
    laws: dict[tuple[int, str], Model]
    # whole models at small strains, where increments are the same as at finite ones, by longer
    # increments of flow, the longest first, and by its own; none where the scene's own finite
    # elements flow, or the whole model does not
    increments: tuple[Model, ...]

    @property
    def wholes(self) -> tuple[Model, ...]:
        """Models that the model error takes; the others split it."""
        return (self.whole,) if self.of_scene is None else (self.whole, self.of_scene)

    @property
    def held_nearer(self) -> dict[str, Model]:
        """Models, by effect of size, that lack it, with their far boundary at half the distance."""
        sizes = {name: pair[1] for name, pair in self.pairs.items() if EFFECTS[name].beyond}
        return {name: replace(without, half_block=True) for name, without in sizes.items()}

    @property
    def all(self) -> tuple[Model, ...]:
        """Models, each once, the whole model first."""
        of_pairs = (variant for pair in self.pairs.values() for variant in pair)
        return tuple(dict.fromkeys((*self.wholes, self.nothing, *of_pairs)))

    @property
    def checks(self) -> tuple[Model, ...]:
        """Models that are solved on the coarsest level alone."""
        return (*self.laws.values(), *self.increments, *self.held_nearer.values())


def split_variants(problem: Problem, selection: EffectSelection, friction: float) -> SplitVariants:
    """The variants at a friction coefficient, the same on every level."""
    nothing = frozenset()
    still = {COUPLED} if friction == 0.0 else nothing  # what does nothing there
    chosen = selection.whole - still
    quadratic = problem.scene.finite_element.element != STRAINED and bool(chosen & NONLINEAR)

    def variant(effects: frozenset[str]) -> Model:
        shaped = effects & (NONLINEAR | {COUPLED}) or problem.scene.load.coupled
        return model_with(problem, effects, friction if shaped else None, quadratic)

    def grown(effects: frozenset[str]) -> frozenset[str]:
        """Add what nonlinear bodies cannot be without."""
        return effects | ({COUPLED} if friction and effects & NONLINEAR else nothing)

    pairs = {}
    for name in EFFECTS:
        if name in chosen:
            beside = chosen & {COUPLED} if name in NONLINEAR else nothing
            pairs[name] = variant(grown(beside | {name})), variant(beside)
    whole = small = variant(grown(chosen))
    if chosen.issuperset(NONLINEAR):  # what an elastic body would do at finite strain matters less
        small = variant(grown(chosen - {"finite_strain"}))
        pairs["finite_strain"] = whole, small
    of_scene = variant(selection.contained - still) if quadratic else None
    flows = FLOW in selection.added
    increments = (*(replace(small, times=times) for times in LONGER), small) if flows else ()
    laws = law_variants(whole, selection.laws)
    return SplitVariants(whole, of_scene, variant(nothing), pairs, laws, increments)


@dataclass(frozen=True)
class Solutions:
    """Solutions of one case, and the model errors that follow."""

    case: Case
    split: SplitVariants  # what is solved
    laws: tuple[OpenLaw, ...] = ()  # of elasticity, that are not known
    # by variant, the solutions on each level, coarse to fine, with None for the scene's own finite
    # elements: of whole models alone on the levels beyond `levels_split`; of checks on the first
    history: tuple[Mapping[Model | None, QuantitiesOfInterest], ...] = ()
    levels_split: int = 0  # on which the effects are solved one by one
    unsplit: str | None = None  # why there is no such level

    @cached_property
    def effects(self) -> dict[str, list[QuantitiesOfInterest]]:
        """Changes by each effect alone that every split level has, by level."""
        pairs = self.split.pairs.items()
        levels = self.history[: self.levels_split]
        return {
            name: [level[with_it] - level[without] for level in levels]
            for name, (with_it, without) in pairs
            if levels and all(with_it in level and without in level for level in levels)
        }

    @cached_property
    def interaction(self) -> list[QuantitiesOfInterest]:
        """Joint change by the effects beyond the sum of these, by split level."""
        levels = self.history[: self.levels_split]
        joint = [level[self.split.whole] - level[self.split.nothing] for level in levels]
        return [reduce(sub, changes) for changes in zip(joint, *self.effects.values(), strict=True)]

    def solved(self, variant: Model | None) -> list[QuantitiesOfInterest]:
        """A variant on the levels of the effects."""
        return [level[variant] for level in self.history]

    @cached_property
    def wholes(self) -> list[QuantitiesOfInterest]:
        """Figures with every effect."""
        return self.solved(self.split.whole)

    @cached_property
    def missing(self) -> list[QuantitiesOfInterest]:
        """Part of the whole models that the scene's own finite elements lack."""
        return list(map(sub, self.wholes, self.solved(self.split.of_scene)))

    @cached_property
    def half_plane(self) -> QuantitiesOfInterest:
        """Quantities of the half-plane on its finest level."""
        return quantities_of(self.case.runs["half_plane"].finest, self.case.problem)

    @cached_property
    def of_scene(self) -> list[QuantitiesOfInterest]:
        """The scene's own finite elements, by level."""
        levels = self.case.runs["finite_element"].levels
        return [quantities_of(level, self.case.problem) for level in levels]

    @cached_property
    def whole(self) -> QuantitiesOfInterest:
        """The finest one: the scene's own finite elements there, and what they lack. A whole that
        flows beside them stands for itself: what flow takes depends on the level as they do."""
        if self.longer is not None:
            return self.wholes[-1]
        lacking, finest = self.missing[-1].figures.items(), self.of_scene[-1].figures
        return QuantitiesOfInterest({name: finest[name] + value for name, value in lacking})

    @cached_property
    def longer(self) -> list[QuantitiesOfInterest] | None:
        """Whole model, at small strains, on the coarsest level by longer increments of flow, and by
        its own; empty: they have no solution; None: there is nothing to check."""
        asked = self.split.increments
        found = [self.history[0][variant] for variant in asked if variant in self.history[0]]
        return (found if len(found) == len(asked) else []) if asked else None

    @cached_property
    def unsolved(self) -> float:
        """Relative error that the solvers' iterations leave."""
        number = len(self.history) - 1
        pairs = ((run.finest, run.levels[number]) for run in self.case.runs.values())
        return iteration(*(level.solution for pair in pairs for level in pair))

    @cached_property
    def resolutions(self) -> dict[str, float]:
        """Relative resolution, by quantity, of pressure elements on the effects' finest level."""
        level = self.case.runs["finite_element"].levels[len(self.history) - 1]
        return {
            "contact_length": relative_resolution(level, level),
            "peak_pressure": self.wholes[-1].peak_resolution,
        }

    def error(self, row: Figure) -> Figure:
        """The half-plane's, in the quantity of a row of the models' comparison, with its parts: the
        difference from the scene's own finite elements is on the same pressure elements."""
        name, at = row.quantity, self.whole.leading(row.quantity)
        half_plane, own = (of.largest()[name] for of in (self.half_plane, self.of_scene[-1]))
        figure, scale = self._size(name, at)
        numerical = row.numerical * self._scale(own, name) / scale
        if at != self.of_scene[-1].leading(name):  # the comparison is at another asperity
            sequence = [level.figures[name][at] / scale for level in self.of_scene]
            refined = grid_convergence(sequence, self._order(name))
            numerical = max(numerical, self.unsolved + refined.uncertainty)
        if self.longer is not None:  # the half-plane on its finest level, that on another
            stated = judged(self.case.runs["half_plane"], self.case.problem)[name]
            numerical += stated.numerical * self._scale(half_plane, name) / scale
        if name in LARGEST:
            numerical += self._of_competitors(name, numerical, at) / scale
        error = self._figure(name, (half_plane - figure) / scale, numerical, self._lacking(name))
        parts = [self._effect(name, effect, at, row.numerical) for effect in self.effects]
        joint = [level.figures[name][at] for level in self.interaction]
        parts.append(Part(INTERACTION, self._estimate(name, joint, at)[0]))
        jump, moved = self._jump(name, row.numerical, at)
        return replace(error, parts=(*parts, Part(JUMP, jump), *error.parts), place=moved)

    def of_levels(self, levels: Sequence[QuantitiesOfInterest]) -> Iterator[Figure]:
        """Errors of finite elements with other effects, on the last level of these."""
        pairs = zip(levels, self.wholes, strict=False)
        sizes = [(one.largest(), whole.largest()) for one, whole in pairs]
        for name in self.whole.figures:
            at = self.whole.leading(name)
            middle = 1.0 + self._spread(name, at).middle
            apart = [one[name] - middle * whole[name] for one, whole in sizes]
            lacking = self._increments(name, at) if any(apart) else 0.0
            yield self._figure(name, *self._estimate(name, apart, at), lacking)

    def of_exact(self, exact: Mapping[str, float] | None = None) -> Iterator[Figure]:
        """Errors of figures [SI] that have no numerical error; by default of the whole model: what
        is not known of it."""
        stated = judged(self.case.runs["finite_element"], self.case.problem)
        for name, own in self.of_scene[-1].largest().items():
            figure, scale = self._size(name, self.whole.leading(name))
            error = 0.0 if exact is None else (exact[name] - figure) / scale
            numerical = stated[name].numerical * abs(own) / scale
            yield self._figure(name, error, numerical, self._lacking(name))

    def _figure(self, name: str, error: float, numerical: float, lacking: float) -> Figure:
        """A model against the whole one: (model - whole) / whole.

        numerical  uncertainty of the model's difference from the scene's own finite elements, or of
                   finite elements with other effects from the whole model
        lacking    of what is between these and the whole model, all relative to it"""
        at = self.whole.leading(name)
        (figure, scale), before = self._size(name, at), self.whole.figures[name][at]
        ratio = error + figure / scale
        spread, parts, unknown = self._spread(name, at), (), {}
        uncertainty = {"numerical": float(difference_of_figures(numerical, ratio, lacking))}
        over = self._scale(before, name) / scale
        larger = over * max(1.0, abs(ratio))
        if spread.half:
            unknown[LAW] = float(spread.half * larger)
            parts = (Part(LAW, float(spread.middle * over), unknown[LAW]),)
        if spread.scatter:
            uncertainty[INPUTS] = float(spread.scatter * larger)
        return Figure(
            study=MODEL_ERROR,
            quantity=name,
            source="half_plane",
            value=float(error),
            at=self.case.at,
            against=WHOLE,
            scale=float(scale),
            uncertainty=Uncertainty(uncertainty),
            unknown=unknown,
            parts=parts,
        )

    def _spread(self, name: str, at: int) -> LawSpread:
        """Spread by the whole model's law of elasticity, from its solutions with the others."""
        first, laws, whole = self.history[0], self.split.laws, self.wholes[0]
        if not self.laws or not first.keys() >= set(laws.values()):
            return LawSpread()
        scale = self._scale(whole.figures[name][at], name)
        moved = {key: first[variant] - whole for key, variant in laws.items()}
        changes = {key: float(of.figures[name][at] / scale) for key, of in moved.items()}
        return law_spread(self.laws, changes)

    def _size(self, name: str, at: int) -> tuple[float, float]:
        """The whole model's figure by the middle of what its law of elasticity may be, and what
        errors are relative to [SI]."""
        figure = self.whole.figures[name][at]
        figure += self._spread(name, at).middle * self._scale(figure, name)
        return figure, self._scale(figure, name)

    def _scale(self, figure: float, name: str) -> float:
        """Scale of differences [SI]: the figure, or the Hertz contact's where it vanishes."""
        return QUANTITIES[name].size(figure, self.case.problem.hertz)

    def _order(self, name: str) -> float:
        """Order of convergence under refinement."""
        finest = [run.finest for run in self.case.runs.values()]
        return formal_order(name, finest, self.case.problem)

    def _estimate(self, name: str, changes: Sequence[float], at: int) -> tuple[float, float]:
        """The relative size, with its uncertainty, of changes [SI], one a level, at an asperity."""
        # by one scale: a largest value may jump to the surface on one level alone
        scale = self._size(name, at)[1]
        values = [float(change / scale) for change in changes]
        if not any(values):
            return 0.0, 0.0
        resolution = self.resolutions.get(name, 0.0)
        refined = grid_convergence(values, self._order(name), resolution)
        return values[-1], refined.uncertainty + self.unsolved

    def _effect(self, name: str, effect: str, at: int, numerical: float) -> Part:
        changes, last = self.effects[effect], self.history[self.levels_split - 1]
        size, unsure = self._estimate(name, [change.figures[name][at] for change in changes], at)
        with_it, without = self.split.pairs[effect]
        if EFFECTS[effect].beyond:
            # of the far boundary of the solution without it; unknown where none is nearer
            domain = np.inf
            nearer = self.history[0].get(self.split.held_nearer[effect])
            if nearer is not None:
                ends = nearer, self.history[0][without]
                domain = far_boundary(*(solution.figures[name][at] for solution in ends))
                domain /= self._size(name, at)[1]
            unsure += domain
        if name not in LARGEST:
            return Part(effect, size, unsure)
        moved, before = (last[one].figures[LARGEST[name]] for one in (with_it, without))
        certain = moved.max() / (1.0 + max(unsure, numerical))  # which may be infinite
        return Part(effect, size, unsure, bool(certain > moved[np.argmax(before)]))

    def _lacking(self, name: str) -> float:
        """Uncertainty of what the whole model has beside the scene's elements, relative."""
        at = self.whole.leading(name)
        return self._missing(name, at) + self._increments(name, at)

    def _missing(self, name: str, at: int) -> float:
        """The part by levels; of a whole that flows beside them, and stands for itself, by its."""
        beside = self.missing if self.longer is None else self.wholes
        return self._estimate(name, [level.figures[name][at] for level in beside], at)[1]

    def _increments(self, name: str, at: int) -> float:
        """The part by increments of flow; unknown where longer ones have no solution."""
        if not self.longer:
            return 0.0 if self.longer is None else np.inf
        scale = self._size(name, at)[1]
        return of_increments([float(value.figures[name][at] / scale) for value in self.longer])

    def _of_competitors(self, name: str, numerical: float, at: int) -> float:
        """Uncertainty of a figure by asperities that may have the largest value [SI].

        numerical  of the figure, relative"""
        largest, whole = LARGEST[name], self.whole.figures
        stated = judged(self.case.runs["finite_element"], self.case.problem)
        alone = stated[largest].numerical  # a depth does not say where it is
        alone = max(numerical, alone) if largest == name else alone
        values, top = whole[largest], whole[largest][at]

        def doubt(k: int) -> float:
            return alone * abs(values[k]) + self._missing(largest, k) * abs(top)

        if not np.isfinite(doubt(at)):
            return 0.0  # it is unknown already
        least = top - doubt(at)
        near = [k for k in np.flatnonzero(values > NEAR * top) if values[k] + doubt(k) >= least]
        if name == largest:
            return max(values[k] + doubt(k) for k in near) - top - doubt(at)
        return max(abs(whole[name][k] - whole[name][at]) for k in near)

    def _jump(
        self, name: str, numerical: float, at: int
    ) -> tuple[float, tuple[float, float] | None]:
        """Excess of the half-plane's largest value over its value at the whole model's asperity;
        x [m] of its largest value and of the whole model's, unless these are twin peaks: None."""
        before = self.half_plane.leading(name)
        if before == at:
            return 0.0, None
        largest, figures = LARGEST[name], self.half_plane.figures
        jump = float((figures[name][before] - figures[name][at]) / self._size(name, at)[1])
        if not figures[largest][before] / figures[largest][at] - 1.0 > numerical:
            return jump, None
        whole = self.wholes[-1].places[largest][at]
        return jump, (float(self.half_plane.places[largest][before]), float(whole))
