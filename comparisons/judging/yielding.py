"""Where the body would begin to flow, and whether an elastic half-plane can stand for it.

In: the half-plane's levels, or the finite elements' without it. Out: figures by friction, against
first flow, and what an elastic body exceeds beyond doubt.

Nomenclature: Y yield stress in tension, k in shear (Y/sqrt 3 by von Mises, Y/2 by Tresca), H
hardness, tau1 principal shear in the plane, mu friction coefficient, G shear modulus, E* combined
modulus."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import inf, pi
from typing import Literal

import numpy as np

from analytic.exact.hertz import hertz_extremes
from analytic.exact.shakedown import UNIT, shakedown_limit
from analytic.surface.roughness import summits
from comparisons.common.numbers import percent, plain, significant, with_unit
from comparisons.figures.figure import Figure, Findings, Statement, figures_of
from comparisons.figures.quantity import WHOLE, Quantity
from comparisons.figures.uncertainty import Uncertainty
from comparisons.judging.contact import AT_HARDNESS
from comparisons.judging.effects.catalogue import FLOW
from comparisons.judging.effects.estimates import BOTH_CRITERIA, STIFF, flow_of, typical_shears
from comparisons.judging.rule import judged
from comparisons.judging.study import MODEL_ERROR, Case, Run, Solved, Study
from comparisons.models.level import Level
from comparisons.models.problem import TABOR, Problem
from comparisons.scenes.scene import Scene

NAME = "yield"
FIELD, PEAK = "field", "peak pressure"  # what tau1 was read of
BEYOND_DOUBT, AT_SUCH_STRESSES = "beyond doubt", "at such stresses"  # names of what is said of flow
PLASTIC_STRAIN, STRAIN_BY_SLOPE = "plastic_strain", "plastic_strain_by_slope"
QUANTITIES = {
    "yield_stress": Quantity("yield stress", "Pa"),
    "hardness": Quantity("hardness", "Pa"),
    "ideal_strength": Quantity("ideal strength of a crystal", "Pa"),
    "tau1_max": Quantity("largest principal shear stress τ₁", "Pa"),
    "von_mises_max": Quantity("von Mises", "Pa"),
    "over_first_flow_tresca": Quantity("over first flow, Tresca"),
    "over_first_flow_von_mises": Quantity("over first flow, von Mises"),
    "share_at_hardness": Quantity("contact at the hardness or above"),
    "peak_pressure_over_shear_yield": Quantity("peak pressure over k = Y/√3"),
    "shakedown_limit": Quantity("elastic shakedown up to"),
    "plasticity_index_summits": Quantity("plasticity index, summits"),
    "plasticity_index_slope": Quantity("plasticity index, slope"),
    PLASTIC_STRAIN: Quantity("largest equivalent plastic strain"),
    STRAIN_BY_SLOPE: Quantity("that strain times the slope of the surface"),
}
CAPPED = " whose pressure is capped"
BY_THE_PEAK = ", by those below Hertz's contact of the same peak pressure"
OF_A_YIELD_STRESS = """First flow: τ₁ = Y/2 (Tresca, in the plane), or von Mises' stress = Y; a
hardness stands for Y = H/3, a yield stress for H = 3 Y (Tabor). Elastic shakedown: the largest peak
pressure over k = Y/√3 (von Mises, as finite elements flow) of a line contact that may roll and
slide over the body again and again without flowing on (Melan; Johnson and Jefferis 1963). A cap on
the pressure (*body.hardness*) stands for flow only roughly: 2.4 Y to 3 Y, here {} to {}, fit what
bodies that flow do, and none of these has both peak pressure and contact length right."""
OF_A_TRACE = """Plasticity index: (E*/H) times √(σκ) of the trace's summits (Greenwood and
Williamson 1966), or times its rms slope (Mikic 1974); well below 1 most of the contact is
elastic."""
IDLE = "flow was computed and moves no judged figure by a tenth of its tolerance"
FLOW_IN_WORDS = {"elastic": "elastic", "plastic": "the finite elements flow", "idle": IDLE}
LEAST_CAP = 2.4  # over Y, of those that fit what finite elements that flow do
DOES_NOT_APPLY = "the elastic half-plane does not apply"
# Without [stress]: the largest shear is that of Hertz's contact of the same peak pressure. That of
# the scenes that come along is 0.72 to 1.11 of it (friction 0 to 0.6; run in, up to 1.6).
FROM_PEAK = 0.4
LEVEL = 1e-6  # of the trace's height: summits that spread less are all as high


@dataclass(frozen=True)
class FlowCheck:
    """What one friction coefficient asks of the body; stresses in Pa."""

    friction: float
    tau1: float  # largest, of an elastic half-plane (with the cap of the scene's hardness, if any)
    von_mises: float | None  # largest equivalent stress; None: no field, tau1 is by the peak
    uncertainty: float  # of tau1, relative
    peak: float  # pressure
    # share of the contact at or above the hardness, or 3 Y; None where neither is known
    at_hardness: float | None

    def over_first_flow(self, yield_stress: float) -> tuple[float, float | None]:
        """Largest stress over that of first flow by Tresca (in the plane), by von Mises."""
        mises = None if self.von_mises is None else self.von_mises / yield_stress
        return 2.0 * self.tau1 / yield_stress, mises


@dataclass(frozen=True)
class FlowAssessment:
    """All friction coefficients of a scene."""

    # elastic | cap (on the pressure) | plastic (the finite elements flow, the scene's or the whole)
    # | idle (flow was computed, and moves no figure that is judged)
    flow: Literal["elastic", "cap", "plastic", "idle"]
    # Y [Pa]: the scene's, or a third of its hardness; None where neither is given
    yield_stress: float | None
    hardness: float | None  # H [Pa]: the scene's, or three times its yield stress
    # G/(2 pi) [Pa], above which no crystal is elastic (J. Frenkel 1926, Z. Phys. 37, 572-609);
    # infinite for a body below STIFF
    ideal_strength: float
    checks: tuple[FlowCheck, ...]  # one a friction coefficient
    asked: bool = True  # whether the question is of bodies that flow where they would

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
    def is_certain(self) -> bool:
        """Whether the body flows at its yield stress by both criteria, less the uncertainty."""
        # k is Y/2 by Tresca, and Y/sqrt(3) by von Mises, whose stress is at least sqrt(3) tau1
        return self.yield_stress is not None and self.least_shear > self.yield_in_shear

    @property
    def yield_in_shear(self) -> float:
        """k [Pa] by von Mises, of a yield stress that is known."""
        return self.yield_stress / 3.0**0.5

    @property
    def least_shear(self) -> float:
        """The largest tau1 [Pa] less its uncertainty."""
        return self.worst.tau1 * (1.0 - self.worst.uncertainty)

    @property
    def beyond_doubt(self) -> str:
        """What an elastic body exceeds for certain, less the uncertainty, where nothing in the
        scene stands for its flow: a sentence without its full stop, empty if nothing."""
        if self.exceeded is None:
            return ""
        shear = with_unit(self.worst.tau1, "Pa", 2)
        said = f"{DOES_NOT_APPLY}: its largest shear stress, {shear}, exceeds the"
        if self.exceeded == self.ideal_strength:
            strength = with_unit(self.ideal_strength, "Pa", 2)
            return f"{said} ideal strength of a crystal, G/2π = {strength}"
        flow = with_unit(self.yield_in_shear, "Pa", 2)
        return f"{said} shear yield stress, Y/√3 = {flow}"

    @property
    def exceeded(self) -> float | None:
        """The limit [Pa] that the largest tau1 of an elastic body exceeds for certain, if any."""
        if self.flow != "elastic" or not self.asked:
            return None
        if self.is_certain:
            return self.yield_in_shear
        return self.ideal_strength if self.least_shear > self.ideal_strength else None


def solve(solved: Solved, before: Mapping[str, Findings], tasks: object) -> Findings:
    """Figures by friction coefficient, of the scene, and what flows in words. What an elastic body
    exceeds for certain is judged where the models are compared."""
    flow = flow_assessment(solved)
    selection = before[MODEL_ERROR].data.selection if MODEL_ERROR in before else None
    if selection is not None and FLOW in selection.whole | selection.found:
        flow = replace(flow, flow="idle" if FLOW in selection.found else "plastic")
    source = "half_plane" if "half_plane" in solved.runs else "finite_element"
    of_scene = {
        "yield_stress": flow.yield_stress,
        "hardness": flow.hardness,
        "ideal_strength": flow.ideal_strength,
    }
    profile = solved.problem.surface.profile
    if flow.hardness is not None and profile is not None:
        # Greenwood and Williamson 1966, Proc. R. Soc. A 295, 300-319; Mikic 1974, Int. J. Heat Mass
        # Transfer 17, 205-214; the first not where all summits are as high
        (spread, curvature), relative = summits(profile), solved.problem.modulus / flow.hardness
        if spread > LEVEL * np.ptp(profile.height):
            of_scene["plasticity_index_summits"] = relative * np.sqrt(spread * curvature)
        slope = solved.problem.surface.info.roughness.rms_slope
        of_scene["plasticity_index_slope"] = relative * slope
    figures, said = figures_of(NAME, "scene", of_scene), [Statement("flow", flow.flow)]
    limit = flow.exceeded if solved.plan.compares else None
    for check in flow.checks:
        at = {"friction": check.friction}
        unsure = Uncertainty({"numerical": check.uncertainty})
        values = {"tau1_max": check.tau1, "von_mises_max": check.von_mises}
        if flow.yield_stress is not None:
            tresca, mises = check.over_first_flow(flow.yield_stress)
            values |= {"over_first_flow_tresca": tresca, "over_first_flow_von_mises": mises}
            values["peak_pressure_over_shear_yield"] = check.peak / flow.yield_in_shear
        values["share_at_hardness"] = check.at_hardness
        for figure in figures_of(NAME, source, values, unsure, at):
            if figure.quantity == "share_at_hardness":
                figure = replace(figure, scale=1.0)
            if figure.quantity == "tau1_max" and limit is not None and check is flow.worst:
                figure = replace(figure, bounds=(0.0, limit / figure.scale))
            figures.append(figure)
        if flow.hardness is not None:  # else nothing says what it is over
            limits = {"shakedown_limit": shakedown_limit(check.friction)[0]}
            figures += figures_of(NAME, "scene", limits, None, at)
        said.append(Statement("read", PEAK if check.von_mises is None else FIELD, source, at))
    if flow.flow == "plastic" and MODEL_ERROR in before:
        figures += _figures_of_flow(solved.problem, before[MODEL_ERROR].data.wholes)
    at_such = flows_at_such(solved.problem.scene, flow)
    flows = {BEYOND_DOUBT: flow.beyond_doubt, AT_SUCH_STRESSES: at_such}
    said += [Statement(name, text, source) for name, text in flows.items() if text]
    return Findings(tuple(figures), statements=tuple(said), data=flow)


def _figures_of_flow(problem: Problem, wholes: tuple[Level, ...]) -> list[Figure]:
    """How far the whole model flows, and over what slopes."""
    figures, info = [], problem.surface.info
    for friction, level in zip(problem.scene.load.friction, wholes, strict=False):
        strain = level.plastic_strain
        if strain is not None:
            slope = 0.5 * level.extent / problem.scene.roller.radius  # of the roller, at the edges
            slope = max(slope, 0.0 if info is None else info.roughness.rms_slope)
            values = {PLASTIC_STRAIN: strain, STRAIN_BY_SLOPE: strain * slope}
            at, itself = {"friction": friction}, Uncertainty({"itself": 1.0})
            figures += figures_of(NAME, WHOLE, values, itself, at)
    return figures


def flow_assessment(solved: Solved) -> FlowAssessment:
    """Of the half-plane where it was solved, else of the finite elements."""
    scene = solved.problem.scene
    plastic = scene.finite_element.plastic
    yield_stress, hardness = scene.body.yield_stress, scene.body.hardness
    hardness = hardness or (yield_stress and TABOR * yield_stress)
    yield_stress = yield_stress or (hardness and hardness / TABOR)
    return FlowAssessment(
        flow="plastic" if plastic else "elastic" if scene.body.hardness is None else "cap",
        yield_stress=yield_stress,
        hardness=hardness,
        ideal_strength=scene.body.material.shear_modulus / (2.0 * pi)
        if scene.body.youngs_modulus > STIFF
        else inf,
        checks=tuple(_check(case, hardness) for case in solved.cases),
        asked=not scene.asks_elastic,
    )


def _check(case: Case, hardness: float | None) -> FlowCheck:
    problem, friction = case.problem, case.friction
    run = case.runs.get("half_plane") or next(iter(case.runs.values()))
    level, field = run.finest, run.finest.stress
    pressure, weights = level.solution.pressure, level.grid.weights
    peak = float(pressure.max())
    stated = judged(run, problem)
    if field is None:
        tau1, mises = peak * hertz_extremes(UNIT, friction).tau1.value, None
        uncertainty = stated["peak_pressure"].numerical
        uncertainty += 0.0 if problem.scene.profile is None else FROM_PEAK
    else:
        tau1, mises = (abs(field.extremes[name].value) for name in ("tau1", "von_mises"))
        uncertainty = stated["tau1_max"].numerical
    share = None
    if hardness is not None:
        touching = weights[pressure > 0.0].sum()
        share = float(weights[pressure >= AT_HARDNESS * hardness].sum() / touching)
    return FlowCheck(
        friction=friction,
        tau1=tau1,
        von_mises=mises,
        uncertainty=uncertainty,
        peak=peak,
        at_hardness=share,
    )


def may_flow(run: Run, at_any: bool = False) -> str:
    """That a body whose yield stress is not given may flow, as a clause; empty where it cannot,
    where that is known or not asked.

    at_any  whether it would at any typical yield stress"""
    flow, body = run.data(NAME), run.problem.scene.body
    if flow.ratio is not None or body.youngs_modulus <= STIFF or not flow.asked:
        return ""
    shear, typical = with_unit(flow.worst.tau1, "Pa", 2), typical_shears(body)
    if typical is None:
        below = f"the figures are those of an elastic body; with a shear yield below {shear} it"
        return "" if at_any else f"{below} flows"
    if flow.worst.tau1 < typical[1 if at_any else 0]:
        return ""
    return f"{flow_of(body, *typical)}, and the largest here is {shear}"


def flows_at_such(scene: Scene, flow: FlowAssessment) -> str:
    """That a body flows under the shears of the half-plane where no model of the scene can show it:
    for want of a yield stress, by what its solid typically bears; or because elastic bodies are the
    question. A clause, or nothing."""
    shear, typical = with_unit(flow.worst.tau1, "Pa", 2), typical_shears(scene.body)
    where = ""
    if flow.ratio is None and typical and flow.least_shear > BOTH_CRITERIA * typical[1]:
        where = flow_of(scene.body, *typical)
    elif scene.asks_elastic and flow.is_certain:
        where = f"beyond a shear of Y/√3 = {with_unit(flow.yield_in_shear, 'Pa', 2)}"
    return f"it flows at such stresses: {where}, the largest is {shear}" if where else ""


def flow_sentence(run: Run) -> str:
    """The one thing to know of flow beside the verdict, without its full stop."""
    flow = run.data(NAME)
    if said := flow.beyond_doubt or flows_at_such(run.problem.scene, flow):
        return said
    worst = flow.worst
    where = f" at friction {plain(worst.friction)}" if len(flow.checks) > 1 else ""
    where += ", by the peak pressure (no [stress])" * (worst.von_mises is None)
    if flow.ratio is None:
        shear = with_unit(worst.tau1, "Pa", 2)
        return f"taken as elastic: it flows if its shear yield is below {shear}{where}"
    stress = with_unit(flow.yield_stress, "Pa", 3)
    third = "" if run.problem.scene.body.yield_stress else ", a third of the hardness"
    largest = f"the half-plane's largest shear is {significant(flow.ratio, 2)} times that of first "
    largest += f"flow{where} (Y = {stress}{third})"
    if flow.flow == "cap":
        return f"flow is the cap alone, at {percent(worst.at_hardness)} of the contact; {largest}"
    return f"{FLOW_IN_WORDS[flow.flow]}; {largest}"


def note(run: Run) -> str:
    """How to read the figures of flow."""
    scene, flow = run.problem.scene, run.data(NAME)
    said = "Stresses of the elastic half-plane" + CAPPED * bool(scene.body.hardness)
    said += f"{BY_THE_PEAK * (flow.worst.von_mises is None)}."
    if flow.yield_stress is None:
        return f"{said} The scene has neither yield stress nor hardness: what flows is not known."
    caps = (with_unit(cap * flow.yield_stress, "Pa", 2) for cap in (LEAST_CAP, TABOR))
    return f"{said} {OF_A_YIELD_STRESS.format(*caps)}" + f" {OF_A_TRACE}" * bool(scene.profile)


def lines(run: Run) -> list[tuple[str, str]]:
    """That it flows where no model shows it; with a yield stress shakedown and, of a rough body,
    its plasticity, at the largest shear."""
    flow, names = run.data(NAME), tuple(QUANTITIES)[8:12]
    flows = flows_at_such(run.problem.scene, flow)
    at = None, flow.worst.friction
    known = [f for f in run.findings[NAME].figures if f.quantity in names and f.friction in at]
    texts = (f"{QUANTITIES[f.quantity].label} {significant(f.value, 3)}" for f in known)
    said = [("flow", flows), ("yield", ", ".join(texts))]
    return [line for line in said if line[1]]


STUDY = Study(
    NAME,
    QUANTITIES,
    solve,
    title="Yield",
    caption=flow_sentence,
    note=note,
    shown=tuple(QUANTITIES),
    sources={"scene": ""},
    lines=lines,
)
