"""Effects that a run computes: those that may move a judged figure by a share of its tolerance.

A tolerance that is looser than the usual one selects as the usual one does: what it left out would
count, and might keep from holding what holds at a tighter one."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from comparisons.common.numbers import with_unit
from comparisons.common.tasks import Tasks
from comparisons.figures.quantity import USUAL
from comparisons.judging.coupling import Coupling, coupled
from comparisons.judging.effects.catalogue import (
    EFFECTS,
    FINITE,
    FLOW,
    LAW,
    NONLINEAR,
    UNKNOWN,
    contained,
    estimates,
    why_not,
)
from comparisons.judging.effects.estimates import Shown, Sizes
from comparisons.judging.effects.laws import OpenLaw, open_laws
from comparisons.judging.study import Solved
from comparisons.judging.yielding import flow_assessment
from comparisons.models.plan import flow_seconds, time_with_flow
from comparisons.models.problem import COUPLED, Problem

SHARE_OF_TOLERANCE = 0.1  # that an effect may move before it is computed
ASKED = 'budget.effects = "all" computes it'


@dataclass(frozen=True)
class EffectSelection:
    """Decision on every effect."""

    contained: frozenset[str]  # the scene's own finite elements have it
    added: frozenset[str]  # computed beside, for the verdict
    impossible: dict[str, str]  # would matter, but cannot be computed here: the reason
    estimates: dict[str, Sizes]  # of all that apply, by effect and quantity
    laws: tuple[OpenLaw, ...] = ()  # with which the whole model is solved once more
    found: frozenset[str] = frozenset()  # those that were computed, and turned out negligible
    # [s] budget.time in which finite strain of what flows can be computed, where it is too short
    time: float | None = None

    @property
    def whole(self) -> frozenset[str]:
        """Effects of the whole model, which the verdict is about."""
        return self.contained | self.added

    @property
    def negligible(self) -> frozenset[str]:
        """Effects that are too small to matter, by their estimates."""
        larger = self.whole | self.impossible.keys() | ({LAW} if self.laws else set())
        larger |= {COUPLED} if self.whole & NONLINEAR else set()  # these bodies have it
        return frozenset(self.estimates) - larger

    def without(self, names: frozenset[str], why: str) -> "EffectSelection":
        """Selection without some of the added effects, for a reason; other laws of elasticity take
        finite deformation."""
        added, laws = self.added - names, self.laws
        if laws and (LAW in names or FINITE not in self.contained | added):
            names, laws = names | {LAW}, ()
        impossible = dict(sorted((self.impossible | dict.fromkeys(names, why)).items()))
        return replace(self, added=added, impossible=impossible, laws=laws)

    def estimated(
        self, name: str, sizes: Sizes, why: str, tolerances: Mapping[str, float]
    ) -> "EffectSelection":
        """Selection with the estimate of an effect that is not computed for a reason, unless it
        turns out to be negligible."""
        impossible = {other: why for other, why in self.impossible.items() if other != name}
        impossible |= {} if is_negligible(sizes, tolerances) else {name: why}
        estimates = self.estimates | {name: sizes}
        return replace(self, impossible=dict(sorted(impossible.items())), estimates=estimates)

    def account(self, name: str) -> tuple[str, str]:
        """Status of an effect, and its reason."""
        if name in self.contained:
            return "contained", "the scene's own finite elements have it"
        if name == LAW and self.laws:
            return "computed", "; ".join(law.words for law in self.laws)
        if name in self.added:
            return "computed", "its estimate exceeds a tenth of a tolerance"
        if name in self.impossible:
            return "not computed", self.impossible[name]
        if name in self.found:
            return "negligible", "it was computed, and moves no figure by a tenth of its tolerance"
        if name in self.negligible:
            return "negligible", "its estimate is below a tenth of every tolerance"
        if name == COUPLED and name in self.estimates:  # with friction, it cannot be without
            return "contained", f"it is a part of {EFFECTS[FINITE].label}"
        return "does not apply", "it does not apply, or has no size"

    def not_modelled(self, quantity: str) -> Sizes:
        """Estimates, by name, of the effects on a quantity that no model has."""
        unknown = self.negligible | self.impossible.keys()  # not those of `laws`
        return {
            name: sizes[quantity]
            for name, sizes in self.estimates.items()
            if name in unknown and quantity in sizes
        }


def effects_of_run(solved: Solved, tasks: Tasks) -> EffectSelection:
    """Selection by the half-plane as far as it is refined, decided once."""
    levels = len(solved.runs["half_plane"].levels)
    return tasks.held("effects", levels, lambda: selected_effects(solved, coupled(solved, tasks)))


def selected_effects(
    solved: Solved, couplings: tuple[Coupling, ...], known: Mapping[str, Sizes] = {}
) -> EffectSelection:
    """Selection by the half-plane, and by what is `known` of effects that were computed."""
    finest = (case.runs["half_plane"].finest for case in solved.cases)
    pressure = max((level.solution.pressure for level in finest), key=np.max)
    problem, patches, no_time = solved.problem, solved.runs["half_plane"].levels[0].patches, None
    flow = flow_assessment(solved)
    # by the laws of cost, of the levels that flow takes and of the scene's own finite elements
    if not why_not(FLOW, problem) and time_with_flow(problem, patches) > problem.time:
        more = with_unit(flow_seconds(problem, patches), "s", 2)
        no_time = f"it takes {more} more (budget.time)"
    shown = Shown.by(pressure, couplings=couplings, shear=flow.least_shear)
    selection = select_effects(problem, shown, known, no_time)
    asked = problem.scene.budget.effects
    if not solved.plan.effects:
        computed = {LAW} if selection.laws else set()  # beside the added
        left_out = selection.added | computed | set(selection.impossible) - (set(UNKNOWN) - {LAW})
        return selection.without(left_out, "not asked for (budget.effects)")
    flows = flow.beyond_doubt and FLOW not in selection.added | selection.found
    # it flows, too, where nothing says how far
    flows = flows or any(map(math.isinf, selection.estimates.get(FLOW, {}).values()))
    if asked != "all" and flows:
        why = f"the body flows, an elastic one cannot hold ({ASKED})"
        return selection.without(selection.added, why)
    return selection


def select_effects(
    problem: Problem,
    shown: Shown,
    known: Mapping[str, Sizes] = {},
    no_time: str | None = None,
) -> EffectSelection:
    """Decide by the estimates.

    known    by effect, what it was found to change, in place of its estimate
    no_time  why flow is not computed where it could be"""
    own, tolerances = contained(problem.scene), problem.scene.tolerances
    sized, no_flow = estimates(problem, shown) | known, why_not(FLOW, problem) or no_time
    mattering = {name for name, sizes in sized.items() if not is_negligible(sizes, tolerances)}
    flows = FLOW in own or (FLOW in mattering and not no_flow)
    if LAW in mattering and not flows:  # it shows in finite deformation alone
        mattering.add(FINITE)
    mattering = (mattering & sized.keys()) - own
    reasons = {name: why_not(name, problem, flows) for name in sized} | {FLOW: no_flow}
    impossible = {name: reasons[name] for name in sized if name in mattering and reasons[name]}
    computed = mattering - impossible.keys()
    laws = open_laws(problem.scene) if LAW in computed else ()
    found = frozenset(known) - mattering
    return EffectSelection(own, computed - {LAW}, impossible, sized, laws, found)


def is_negligible(sizes: Sizes, tolerances: Mapping[str, float]) -> bool:
    """True if an effect moves no judged figure by a share of its tolerance that matters."""
    return all(
        sizes.get(quantity, 0.0) <= SHARE_OF_TOLERANCE * min(tolerance, USUAL)
        for quantity, tolerance in tolerances.items()
    )
