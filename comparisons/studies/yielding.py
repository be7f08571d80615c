"""Where the body would begin to flow, and whether an elastic half-plane can stand for it.

Nomenclature: Y yield stress in tension, k in shear (Tresca: Y/2), H hardness, tau1 principal shear
in the plane, mu friction coefficient, G shear modulus, E* combined modulus."""

from dataclasses import dataclass
from math import inf, pi
from typing import Literal

import numpy as np

from analytic.exact.hertz import hertz_extremes
from analytic.exact.shakedown import UNIT, shakedown_limit
from analytic.surface.roughness import summits
from comparisons.common.numbers import with_unit
from comparisons.figures.verdict import Validity
from comparisons.models.level import ModelRun
from comparisons.models.problem import Problem
from comparisons.studies.contact import uncertainties
from comparisons.studies.model_error.estimates import TABOR

AT_CAP = 1.0 - 1e-9  # times the hardness: held there
DOES_NOT_APPLY = "the elastic half-plane does not apply"
# Without [stress]: the largest shear is that of Hertz's contact of the same peak pressure. That of
# the scenes that come along is 0.72 to 1.11 of it (friction 0 to 0.6; run in, up to 1.6).
FROM_PEAK = 0.4
LEVEL = 1e-6  # of the trace's height: summits that spread less are all as high
# [Pa] Rubber, which bears shears of the size of G, is softer; what is stiffer flows or breaks at
# the latest at the ideal strength of a crystal, G/(2 pi) (J. Frenkel 1926, Z. Phys. 37, 572-609).
STIFF = 1e9


@dataclass(frozen=True)
class FlowCheck:
    """What one friction coefficient asks of the body; stresses in Pa."""

    friction: float
    tau1: float  # largest, of an elastic half-plane (with the cap of the scene's hardness, if any)
    von_mises: float | None  # largest equivalent stress; None where no field was computed
    uncertainty: float  # of tau1, relative
    from_field: bool  # tau1 was computed on a field, else from the peak pressure
    peak: float  # pressure
    # share of the contact at or above the hardness, or 3 Y; None where neither is known
    at_hardness: float | None
    # largest peak pressure over k under which an elastic line contact shakes down
    shakedown: float | None

    def over_first_flow(self, yield_stress: float) -> tuple[float, float | None]:
        """Largest stress over that of first flow by Tresca (in the plane), by von Mises."""
        mises = None if self.von_mises is None else self.von_mises / yield_stress
        return 2.0 * self.tau1 / yield_stress, mises


@dataclass(frozen=True)
class FlowAssessment:
    """All friction coefficients of a scene."""

    # elastic | cap (on the pressure) | plastic (the finite elements flow)
    flow: Literal["elastic", "cap", "plastic"]
    # Y [Pa]: the scene's, or a third of its hardness; None where neither is given
    yield_stress: float | None
    hardness: float | None  # H [Pa]: the scene's, or three times its yield stress
    # G/(2 pi) [Pa], above which no crystal is elastic; infinite for a soft body
    ideal_strength: float
    # (E*/H) sqrt(s/R): s standard deviation of the trace's summits, 1/R their mean curvature
    # (Greenwood and Williamson 1966, Proc. R. Soc. A 295, 300-319)
    summit_index: float | None
    # (E*/H) times the rms slope (Mikic 1974, Int. J. Heat Mass Transfer 17, 205-214); None without
    # trace or H, and the first where all summits are as high
    slope_index: float | None
    checks: tuple[FlowCheck, ...]  # one a friction coefficient

    @property
    def worst(self) -> FlowCheck:
        return max(self.checks, key=lambda check: check.tau1)

    @property
    def ratio(self) -> float | None:
        """Largest stress over that of first flow, by whichever criterion flows first."""
        if self.yield_stress is None:
            return None
        tresca, mises = self.worst.over_first_flow(self.yield_stress)
        return max(tresca, mises or 0.0)

    @property
    def beyond_doubt(self) -> str:
        """What an elastic body exceeds for certain, less the uncertainty, where nothing in the
        scene stands for its flow: a sentence without its full stop, empty if nothing."""
        worst = self.worst
        least = worst.tau1 * (1.0 - worst.uncertainty)
        if self.flow != "elastic":
            return ""
        said = f"{DOES_NOT_APPLY}: its largest shear stress, {with_unit(worst.tau1, 'Pa', 2)}, "
        # k is Y/2 by Tresca, and Y/sqrt(3) by von Mises, whose stress is at least sqrt(3) tau1
        if self.yield_stress is not None and least > self.yield_stress / 3.0**0.5:
            flow = with_unit(0.5 * self.yield_stress, "Pa", 2)
            return f"{said}exceeds the shear yield stress, Y/2 = {flow}"
        if least > self.ideal_strength:
            strength = with_unit(self.ideal_strength, "Pa", 2)
            return f"{said}exceeds the ideal strength of a crystal, G/2π = {strength}"
        return ""

    def judged(self, verdict: Validity, why: str) -> tuple[Validity, str]:
        """A verdict on the half-plane and its reason; it fails where flow is beyond doubt."""
        flows = self.beyond_doubt
        return ("fails", f"{flows}; {why}") if flows else (verdict, why)

    def as_dict(self) -> dict:
        """For JSON, SI units; None for what is unknown."""
        return {
            "flow": self.flow,
            "yield_stress": self.yield_stress,
            "hardness": self.hardness,
            "ideal_strength": None if self.ideal_strength == inf else self.ideal_strength,
            "plasticity_index_summits": self.summit_index,
            "plasticity_index_slope": self.slope_index,
            "beyond_doubt": self.beyond_doubt or None,
            "by_friction": [self._entry(check) for check in self.checks],
        }

    def _entry(self, check: FlowCheck) -> dict:
        tresca = mises = ratio = None
        if self.yield_stress is not None:
            tresca, mises = check.over_first_flow(self.yield_stress)
            ratio = 2.0 * check.peak / self.yield_stress
        return {
            "friction": check.friction,
            "tau1_max": check.tau1,
            "von_mises_max": check.von_mises,
            "from": "field" if check.from_field else "peak pressure",
            "over_first_flow_tresca": tresca,
            "over_first_flow_von_mises": mises,
            "share_at_hardness": check.at_hardness,
            "peak_pressure_over_shear_yield": ratio,
            "shakedown_limit": check.shakedown,
        }


def flow_assessment(problem: Problem, runs: dict[str, ModelRun]) -> FlowAssessment:
    """Of the half-plane where it was solved, else of the finite elements."""
    scene, run = problem.scene, runs.get("half_plane") or next(iter(runs.values()))
    plastic, profile = scene.finite_element.plastic, problem.surface.profile
    yield_stress, hardness = scene.body.yield_stress, scene.body.hardness
    hardness = hardness or (yield_stress and TABOR * yield_stress)
    yield_stress = yield_stress or (hardness and hardness / TABOR)
    summit = slope = None
    if hardness and profile is not None:
        spread, curvature = summits(profile)
        relative = problem.modulus / hardness
        if spread > LEVEL * np.ptp(profile.height):
            summit = float(relative * np.sqrt(spread * curvature))
        slope = relative * problem.surface.info.roughness.rms_slope
    return FlowAssessment(
        flow="plastic" if plastic else "elastic" if scene.body.hardness is None else "cap",
        yield_stress=yield_stress,
        hardness=hardness,
        ideal_strength=scene.body.material.shear_modulus / (2.0 * pi)
        if scene.body.youngs_modulus > STIFF
        else inf,
        summit_index=summit,
        slope_index=slope,
        checks=tuple(_check(problem, run, mu, hardness) for mu in scene.load.friction),
    )


def _check(problem: Problem, run: ModelRun, friction: float, hardness: float | None) -> FlowCheck:
    level, field = run.finest, run.finest.stress(friction)
    pressure, weights = level.solution.pressure, level.grid.weights
    peak = float(pressure.max())
    stated = uncertainties(run, problem, friction)
    if field is None:
        tau1, mises = peak * hertz_extremes(UNIT, friction).tau1.value, None
        uncertainty = stated["peak_pressure"].total
        uncertainty += 0.0 if problem.scene.profile is None else FROM_PEAK
    else:
        tau1, mises = (abs(field.extremes[name].value) for name in ("tau1", "von_mises"))
        uncertainty = stated["tau1_max"].total
    share = None
    if hardness is not None:
        touching = weights[pressure > 0.0].sum()
        share = float(weights[pressure >= AT_CAP * hardness].sum() / touching)
    return FlowCheck(
        friction=friction,
        tau1=tau1,
        von_mises=mises,
        uncertainty=uncertainty,
        from_field=field is not None,
        peak=peak,
        at_hardness=share,
        shakedown=None if hardness is None else shakedown_limit(friction)[0],
    )
