"""What a run will do about every model of the ladder, before it solves the scene.

In: a problem and its plan. Out: a row a model: what it takes by the laws of cost, when it is
computed, or why not. Which effects may matter is estimated, as the run will, from the half-plane's
contact on the levels that are asked for; of stresses nothing is known yet."""

from collections.abc import Iterator
from dataclasses import dataclass

from comparisons.common.progress import Stages
from comparisons.figures.quantity import UP_TO, WHOLE
from comparisons.models.forecast import expected_level
from comparisons.models.half_plane import half_plane_level
from comparisons.models.level import ModelRun
from comparisons.models.plan import Plan
from comparisons.models.problem import Problem
from comparisons.models.smooth import closed_form
from comparisons.models.window import window_of
from comparisons.studies.ladder.estimated import sizes_of
from comparisons.studies.ladder.operators import (
    carried,
    carried_deformed,
    why_no_stresses,
    words_of,
)
from comparisons.studies.ladder.rungs import (
    DEFORMED,
    FINITE,
    FLOW,
    HALF_PLANE,
    HERTZ,
    KINDS,
    LINEAR,
    NONLINEAR,
    OPERATORS,
    OTHER,
    closed_form_words,
    kind_of,
    words_of_kind,
)
from comparisons.studies.model_error.catalogue import EFFECTS
from comparisons.studies.model_error.contributions import split_variants
from comparisons.studies.model_error.error_budget import selected_effects
from comparisons.studies.model_error.selection import EffectSelection
from comparisons.studies.model_error.solutions import LEAST_LEVELS, SolvedVariants
from comparisons.studies.study import Solved
from comparisons.studies.subsurface.yielding import flow_assessment

# Times as long as the half-plane: of layers and coatings 1.7 to 2.3; two contacts more.
BY_OPERATOR, ON_DEFORMED = 2.3, 3.0
ALWAYS = "always"
UNLESS_HELD = "where the half-plane does not hold"
NEEDED = "unless the first comparison decides"
FLOWS = "cannot hold by the estimates: the body flows beyond doubt"


@dataclass(frozen=True)
class PlannedRung:
    """One model: seconds by the laws of cost, None where it is not computed; when, or why not."""

    words: str
    seconds: float | None
    why: str

    @property
    def computed(self) -> str:
        if self.seconds is None:
            return "no"
        return "yes" if self.why == ALWAYS else "if needed"


class _Planned:
    """What the rows are made of."""

    def __init__(self, problem: Problem, plan: Plan) -> None:
        self.problem, self.plan, self.up_to = problem, plan, problem.scene.budget.up_to
        self.window = window_of(problem) if plan.stress else None
        levels = [half_plane_level(problem, pitch, None, Stages()) for pitch in problem.pitches]
        run = ModelRun(HALF_PLANE, tuple(levels))
        self.patches = levels[0].patches
        self.solved = Solved(problem, plan, self.window, {HALF_PLANE: run})
        self.flow = flow_assessment(problem, self.solved.runs)
        self.selection: EffectSelection | None = None
        self.effects = frozenset(sizes_of(self.solved, {}))
        if plan.compares:
            self.selection = selected_effects(self.solved, ())
            self.effects = self.selection.whole
        self.seconds = self._of_levels(HALF_PLANE)

    def rows(self) -> Iterator[PlannedRung]:
        smooth = closed_form(self.problem) is not None
        words = closed_form_words(self.problem) if smooth else KINDS[HERTZ]
        why = ALWAYS if smooth else "does not apply: several waves have no closed form"
        yield PlannedRung(words, 0.0 if smooth else None, why)
        yield PlannedRung(KINDS[HALF_PLANE], self.seconds, ALWAYS)
        yield self._by_half_plane(OPERATORS)
        yield self._by_half_plane(DEFORMED)
        if self.selection is None:
            why = self._beyond(LINEAR) or "not asked for (--models)"
            yield PlannedRung("finite elements of any kind", None, why)
        else:
            yield from self._finite_elements(self.selection)

    def _beyond(self, kind: str) -> str:
        names = [name.replace("-", "_") for name in UP_TO]
        if kind != FLOW and names.index(kind) <= UP_TO.index(self.up_to):
            return ""
        return f"beyond --up-to {self.up_to}" if self.up_to != WHOLE else ""

    def _by_half_plane(self, kind: str) -> PlannedRung:
        """With an operator, or on the deformed surface."""
        problem, effects = self.problem, self.effects
        deformed = carried_deformed(problem, effects)
        held = deformed if kind == DEFORMED else carried(problem, effects, self.flow)
        words = words_of(held) if held else KINDS[kind]
        is_better = self.selection is None and deformed and not self._beyond(DEFORMED)
        reasons = {
            "does not apply: it has nothing more that matters": not held,
            self._beyond(kind): self._beyond(kind),
            FLOWS: self._is_refuted(kind),
            "the one on the deformed surface has more": kind == OPERATORS and is_better,
            why_no_stresses(problem, self.window): why_no_stresses(problem, self.window),
        }
        if why := next((why for why, hindered in reasons.items() if hindered), None):
            return PlannedRung(words, None, why)
        factor = ON_DEFORMED if kind == DEFORMED else BY_OPERATOR
        return PlannedRung(words, factor * self.seconds, UNLESS_HELD)

    def _is_refuted(self, kind: str) -> bool:
        """Whether flow beyond doubt leaves no elastic model of a kind; a cap stands for some."""
        flows = "plastic_flow" in self.effects
        if kind == OPERATORS:
            return bool(self.plan.compares and self.flow.beyond_doubt and not flows)
        return bool(self.flow.beyond_doubt or (self.plan.compares and flows))

    def _finite_elements(self, selection: EffectSelection) -> Iterator[PlannedRung]:
        problem, contained = self.problem, selection.contained
        splits = [split_variants(problem, selection, mu) for mu in problem.scene.load.friction]
        split, needed, always = splits[-1], NEEDED, ALWAYS
        if self.up_to != WHOLE:
            needed, always = f"{NEEDED}, or a cheaper model holds", "unless a cheaper model holds"
        rows = {kind: [] for kind in (LINEAR, FINITE, FLOW)}
        for name, (with_it, _) in split.pairs.items():
            if contained != {name} and with_it != split.whole:
                kind = NONLINEAR.get(name, LINEAR)
                words = f"{KINDS[kind]} alone"
                if kind == LINEAR:
                    words = f"finite elements with {EFFECTS[name].label}"
                variants = dict.fromkeys(one.pairs[name][0] for one in splits if name in one.pairs)
                rows[kind].append(PlannedRung(words, self._of_variants(variants), needed))
        own = self._of_levels(OTHER)
        if contained and contained != selection.whole:
            words = words_of_kind(contained)
            rows[kind_of(contained)].append(PlannedRung(words, own, always))
        linear = selection.whole - set(NONLINEAR) - {"deformed_gap", "rough_boundary"}
        if len(linear) > 1 and linear != selection.whole:
            words = words_of_kind(linear)
            why = "costs more than what is computed already"
            rows[LINEAR].append(PlannedRung(words, None, why))
        for kind, known in rows.items():
            yield from known or [PlannedRung(KINDS[kind], None, self._why_none(kind, selection))]
        more = dict.fromkeys(v for one in splits for v in one.wholes)
        words = f"whole model: {words_of_kind(selection.whole)}"
        is_own = selection.whole == contained
        seconds = own + (0.0 if is_own else self._of_variants(more))
        yield PlannedRung(words, seconds, always if is_own else needed)

    def _why_none(self, kind: str, selection: EffectSelection) -> str:
        """Why there is no model of a kind beside the whole."""
        if kind == LINEAR:
            return "does not apply: no linear effect matters beside"
        name = next(effect for effect, its in NONLINEAR.items() if its == kind)
        if beyond := self._beyond(kind):
            return beyond
        if name in selection.whole:
            return "it is the whole model"
        if name in selection.impossible:
            return selection.impossible[name]
        said = "too small to matter" if name in selection.negligible else "of no size"
        return f"does not apply: {EFFECTS[name].label} is {said} by the estimates"

    def _of_levels(self, model: str) -> float:
        """Seconds of a model on the levels asked for."""
        costs = (
            expected_level(model, self.problem, self.plan, pitch, self.patches, self.window)
            for pitch in self.problem.pitches
        )
        return sum(cost.seconds for cost in costs)

    def _of_variants(self, variants: dict) -> float:
        """The same of finite elements with other effects, on the least levels."""
        known = SolvedVariants(self.problem, self.window, None, None, self.patches)
        return sum(known.forecast(v, n) for v in variants for n in range(1, LEAST_LEVELS + 1))


def planned_rungs(problem: Problem, plan: Plan) -> list[PlannedRung]:
    """From the cheapest on; none where no ladder is asked for."""
    alone = plan.models == (HALF_PLANE,) and problem.scene.budget.up_to != WHOLE
    if not problem.scene.tolerances or not (plan.compares or alone):
        return []
    return list(_Planned(problem, plan).rows())
