"""Contributions of each effect, alone and jointly, on each level: differences of solutions.

With F(S) the finite elements' solution with the effects S, W all of them, k finite deformation,
c normal-tangential coupling, 0 none:

    an effect i            F({i}) - F(0)
    finite deformation     F(k + c) - F(c), c only under friction, where sliding traction moves it
    plastic flow           F(flow + c) - F(c)
    finite deformation of a body that flows    F(W) - F(W - k)
    interaction            F(W) - F(0) - the sum of these

These add up to F(W) - F(0), in any order: an effect without a solution by itself counts
in the interaction. The scene's own finite elements do not contain F(W) - F(scene)."""

from dataclasses import dataclass, replace

from comparisons.judging.effects.catalogue import (
    EFFECTS,
    FLOW,
    NONLINEAR,
    STRAINED,
    law_variants,
    model_with,
)
from comparisons.judging.effects.selection import EffectSelection
from comparisons.models.model import Model
from comparisons.models.plan import LONGER
from comparisons.models.problem import COUPLED, Problem


class NotComputedError(Exception):
    """A model variant has no solution; the message says why."""


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
    chosen = selection.whole - ({COUPLED} if friction == 0.0 else frozenset())
    quadratic = problem.scene.finite_element.element != STRAINED and bool(chosen & set(NONLINEAR))

    def variant(effects: frozenset[str]) -> Model:
        shaped = effects & {COUPLED, *NONLINEAR} or problem.scene.load.coupled
        return model_with(problem, effects, friction if shaped else None, quadratic)

    def grown(effects: frozenset[str]) -> frozenset[str]:
        """Add what nonlinear bodies cannot be without."""
        return effects | ({COUPLED} if friction and effects & set(NONLINEAR) else frozenset())

    nothing, pairs = frozenset(), {}
    for name in EFFECTS:
        if name in chosen:
            beside = chosen & {COUPLED} if name in NONLINEAR else nothing
            pairs[name] = variant(grown(beside | {name})), variant(beside)
    if chosen.issuperset(NONLINEAR):  # what an elastic body would do at finite strain matters less
        small = variant(grown(chosen - {"finite_strain"}))
        pairs["finite_strain"] = variant(grown(chosen)), small
    of_scene = None
    if quadratic:
        of_scene = variant(selection.contained - ({COUPLED} if friction == 0.0 else frozenset()))
    whole, increments = variant(grown(chosen)), ()
    if FLOW in selection.added:
        small = pairs["finite_strain"][1] if chosen.issuperset(NONLINEAR) else whole
        increments = (*(replace(small, times=times) for times in LONGER), small)
    laws = law_variants(whole, selection.laws)
    return SplitVariants(whole, of_scene, variant(nothing), pairs, laws, increments)
