"""Which effects a run computes: those that may move a judged figure by a share of its tolerance."""

from dataclasses import dataclass, replace

from comparisons.assessment.effects.catalogue import EFFECTS, contained
from comparisons.assessment.effects.estimates import Sizes, estimates
from comparisons.assessment.normal_tangential_coupling import Coupling
from comparisons.common.mpi import is_several
from comparisons.models.problem import Problem

SHARE_OF_TOLERANCE = 0.1  # that an effect may move before it is computed
# Effects in the order of the sums of their contributions, whose last bit depends on it. The
# nonlinear ones are measured beside the linear ones.
LINEAR = (
    "exact_circle",
    "coating",
    "normal_tangential_coupling",
    "finite_roller",
    "deformed_gap",
    "finite_size",
    "rough_boundary",
)
NONLINEAR = ("finite_strain", "plastic_flow")


@dataclass(frozen=True)
class EffectSelection:
    """What becomes of every effect.

    contained    the scene's own finite elements have it
    added        computed beside, for the verdict
    negligible   too small to matter, each with its estimate
    impossible   would matter, but cannot be computed here: the reason
    estimates    of all that apply, by effect and quantity
    """

    contained: frozenset[str]
    added: frozenset[str]
    negligible: dict[str, Sizes]
    impossible: dict[str, str]
    estimates: dict[str, Sizes]

    @property
    def whole(self) -> frozenset[str]:
        """Effects of the whole model, which the verdict is about."""
        return self.contained | self.added

    def without(self, names: frozenset[str], why: str) -> "EffectSelection":
        """The same without some of the added effects, for a reason."""
        impossible = self.impossible | dict.fromkeys(names, why)
        return replace(self, added=self.added - names, impossible=dict(sorted(impossible.items())))

    def not_modelled(self, quantity: str) -> Sizes:
        """By name, estimates of the effects on a quantity that no model has."""
        open_effects = set(self.negligible) | set(self.impossible)
        return {
            name: sizes[quantity]
            for name, sizes in self.estimates.items()
            if name in open_effects and quantity in sizes
        }


def select_effects(
    problem: Problem, peak: float, couplings: tuple[Coupling, ...]
) -> EffectSelection:
    """Decide by the estimates; `peak` [Pa] is the half-plane's largest pressure."""
    own, tolerance = contained(problem.scene), problem.scene.tolerance
    applying = {name for name, effect in EFFECTS.items() if effect.applies(problem)}

    def matters(sizes: Sizes) -> bool:
        return any(sizes.get(q, 0.0) > SHARE_OF_TOLERANCE * t for q, t in tolerance.items())

    # strain is judged beside the linear effects, so these are settled first
    first = estimates(problem, peak, own, couplings)
    linear = own | {name for name in applying & set(LINEAR) if matters(first.get(name, {}))}
    second = estimates(problem, peak, linear, couplings)
    sized = {name: sizes for name, sizes in second.items() if name in applying}
    added, negligible, impossible = set(), {}, {}
    for name, sizes in sized.items():
        if name in own:
            continue
        why = why_not(name, problem)
        if not matters(sizes):
            negligible[name] = sizes
        elif why is not None:
            impossible[name] = why
        else:
            added.add(name)
    return EffectSelection(own, frozenset(added), negligible, impossible, sized)


def why_not(name: str, problem: Problem) -> str | None:
    """Why an effect cannot be computed in a scene, or None."""
    scene = problem.scene
    if name == "plastic_flow":
        if scene.yielding is None:
            return "the body has no yield stress"
        return "the scene says finite_element.plastic = false"
    if name != "finite_strain":
        return None
    reasons = {
        "flow is of small deformation": scene.finite_element.plastic,
        "a cap on the pressure is of small deformation": scene.hardness is not None,
        "the body is coated": scene.coating is not None,
        "it is solved on one process": is_several(),
    }
    return next((why for why, hindered in reasons.items() if hindered), None)
