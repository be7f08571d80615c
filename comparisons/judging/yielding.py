"""First flow of the body, and whether an elastic half-plane can stand for it.

In: the half-plane's levels, or the finite elements' without it. Out: figures by friction, against
first flow, and what an elastic body surely exceeds.

Nomenclature: Y yield stress in tension, k in shear (Y/sqrt 3 by von Mises, Y/2 by Tresca), H
hardness, tau1 principal shear in the plane, mu friction coefficient, G shear modulus, E* combined
modulus."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from math import inf, pi
from typing import Literal

import numpy as np

from analytic.exact.hertz import hertz_extremes
from analytic.exact.shakedown import UNIT, shakedown_limit
from analytic.surface.roughness import summits
from comparisons.common.numbers import percent, plain, significant, with_unit
from comparisons.figures.figure import Figure, Figures, Findings, Statement, figures_of
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
BEYOND_DOUBT, AT_SUCH_STRESSES = "beyond doubt", "at such stresses"  # names of what is said of flow
OVER_FIRST_FLOW = "over_first_flow_tresca", "over_first_flow_von_mises"
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
YIELD, CRYSTAL = "shear yield stress, Y/√3", "ideal strength of a crystal, G/2π"
# Without [stress]: the largest shear is that of Hertz's contact of the same peak pressure. That of
# the shipped scenes is 0.72 to 1.11 of it (friction 0 to 0.6; run in, up to 1.6).
FROM_PEAK = 0.4
LEVEL = 1e-6  # of the trace's height: summits that spread less are all as high


@dataclass(frozen=True)
class FlowAssessment:
    """Stresses that elastic bodies bear in a scene, against what its body does; limits in Pa."""

    scene: Scene
    # elastic | cap (pressure is at most the hardness) | idle (flow moves no figure that is judged)
    # | plastic (the finite elements flow, the scene's own or those of the whole model)
    flow: Literal["elastic", "cap", "plastic", "idle"]
    # Y: the scene's, or a third of its hardness; None where neither is given
    yield_stress: float | None
    hardness: float | None  # H: the scene's, or three times its yield stress
    # the largest stresses, and what they are over, by friction coefficient
    figures: Figures

    @property
    def worst(self) -> Figure:
        """The largest tau1 [Pa] of all friction coefficients."""
        return max(self.figures.of(quantity="tau1_max"), key=lambda figure: figure.value)

    def there(self, quantity: str) -> float | None:
        """The value of another figure where tau1 is the largest, if it is known."""
        figure = self.figures.one(quantity=quantity, friction=self.worst.friction)
        return figure and figure.value

    @property
    def ratio(self) -> float | None:
        """Largest stress over that of first flow, by whichever criterion flows first."""
        return max(filter(None, map(self.there, OVER_FIRST_FLOW)), default=None)

    @property
    def limits(self) -> dict[str, float]:
        """The shears [Pa] that no elastic body bears, in words: by von Mises that of its yield
        stress, by which it flows by Tresca's criterion, too; and the ideal strength, above which no
        crystal is elastic (J. Frenkel 1926, Z. Phys. 37, 572-609). Infinite where the yield stress
        is not known, and for a body below STIFF."""
        body, known = self.scene.body, self.yield_stress
        strength = body.material.shear_modulus / (2.0 * pi) if body.youngs_modulus > STIFF else inf
        return {YIELD: inf if known is None else known / 3.0**0.5, CRYSTAL: strength}

    @property
    def least_shear(self) -> float:
        """The largest tau1 [Pa] less its uncertainty."""
        return self.worst.value * (1.0 - self.worst.numerical)

    @property
    def exceeded(self) -> str | None:
        """The first of the limits that an elastic body exceeds for certain, if any, where nothing
        in the scene stands for its flow."""
        if self.flow != "elastic" or self.scene.asks_elastic:
            return None
        limits = self.limits.items()
        return next((name for name, limit in limits if self.least_shear > limit), None)

    @property
    def beyond_doubt(self) -> str:
        """Sentence on the limit that is exceeded, without its full stop; empty if there is none."""
        if (name := self.exceeded) is None:
            return ""
        shear, limit = (with_unit(size, "Pa", 2) for size in (self.worst.value, self.limits[name]))
        return f"{DOES_NOT_APPLY}: its largest shear stress, {shear}, exceeds the {name} = {limit}"

    @property
    def at_such_stresses(self) -> str:
        """Clause that a body flows under the shears of the half-plane where no model of the scene
        can show it: for want of a yield stress, by what its solid typically bears; or because
        elastic bodies are the question. Empty if it does not."""
        shear, typical = with_unit(self.worst.value, "Pa", 2), typical_shears(self.scene.body)
        limit, where = self.limits[YIELD], ""
        if self.ratio is None and typical and self.least_shear > BOTH_CRITERIA * typical[1]:
            where = flow_of(self.scene.body)
        elif self.scene.asks_elastic and self.least_shear > limit:
            where = f"beyond a shear of Y/√3 = {with_unit(limit, 'Pa', 2)}"
        return f"it flows at such stresses: {where}, the largest is {shear}" if where else ""


def solve(solved: Solved, before: Mapping[str, Findings], tasks: object) -> Findings:
    """Figures by friction coefficient, of the scene, and what flows in words. What an elastic body
    exceeds for certain is judged where the models are compared."""
    flow = flow_assessment(solved)
    selection = before[MODEL_ERROR].data.selection if MODEL_ERROR in before else None
    if selection is not None and FLOW in selection.whole | selection.found:
        flow = replace(flow, flow="idle" if FLOW in selection.found else "plastic")
    of_scene = {"yield_stress": flow.yield_stress, "hardness": flow.hardness}
    of_scene["ideal_strength"] = flow.limits[CRYSTAL]
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
    for figure in flow.figures:
        if figure is flow.worst and limit is not None:
            figure = replace(figure, bounds=(0.0, flow.limits[limit] / figure.scale))
        figures.append(figure)
    for friction in solved.problem.scene.load.friction if flow.hardness is not None else ():
        limits = {"shakedown_limit": shakedown_limit(friction)[0]}
        figures += figures_of(NAME, "scene", limits, None, {"friction": friction})
    if flow.flow == "plastic" and MODEL_ERROR in before:
        figures += _figures_of_flow(solved.problem, before[MODEL_ERROR].data.wholes)
    flows = {BEYOND_DOUBT: flow.beyond_doubt, AT_SUCH_STRESSES: flow.at_such_stresses}
    said += [Statement(name, text, flow.worst.source) for name, text in flows.items() if text]
    return Findings(tuple(figures), statements=tuple(said), data=flow)


def _figures_of_flow(problem: Problem, wholes: tuple[Level, ...]) -> list[Figure]:
    """Flow of the whole model, and the slopes over which it flows."""
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
    """Assessment of the half-plane where it was solved, else of the finite elements."""
    scene = solved.problem.scene
    yield_stress, hardness = scene.body.yield_stress, scene.body.hardness
    flow = "plastic" if scene.finite_element.plastic else "elastic" if hardness is None else "cap"
    hardness = hardness or (yield_stress and TABOR * yield_stress)
    yield_stress = yield_stress or (hardness and hardness / TABOR)
    figures = Figures(f for case in solved.cases for f in _figures(case, yield_stress, hardness))
    return FlowAssessment(scene, flow, yield_stress, hardness, figures)


def _figures(case: Case, yield_stress: float | None, hardness: float | None) -> Iterator[Figure]:
    """The largest stresses of an elastic body (held at the scene's hardness, if any), by
    the peak pressure where there is no field; over those of first flow by Tresca, in the plane, and
    by von Mises; and the contact at the hardness or above."""
    problem, friction = case.problem, case.friction
    run = case.runs.get("half_plane") or next(iter(case.runs.values()))
    level, field, stated = run.finest, run.finest.stress, judged(run, problem)
    pressure, weights = level.solution.pressure, level.grid.weights
    peak, values = float(pressure.max()), {}
    if field is None:
        values["tau1_max"] = peak * hertz_extremes(UNIT, friction).tau1.value
        uncertainty = stated["peak_pressure"].numerical
        uncertainty += 0.0 if problem.scene.profile is None else FROM_PEAK
    else:
        largest = {name: abs(field.extremes[name].value) for name in ("tau1", "von_mises")}
        values = {f"{name}_max": value for name, value in largest.items()}
        uncertainty = stated["tau1_max"].numerical
    if yield_stress is not None:
        first = dict(zip(values, (0.5, 1.0), strict=False))  # over Y
        over = [values[name] / (share * yield_stress) for name, share in first.items()]
        values |= dict(zip(OVER_FIRST_FLOW, over, strict=False))
        values["peak_pressure_over_shear_yield"] = 3.0**0.5 * peak / yield_stress
    if hardness is not None:
        touching = weights[pressure > 0.0].sum()
        values["share_at_hardness"] = weights[pressure >= AT_HARDNESS * hardness].sum() / touching
    unsure = Uncertainty({"numerical": uncertainty})
    for figure in figures_of(NAME, run.name, values, unsure, {"friction": friction}):
        yield replace(figure, scale=1.0) if figure.quantity == "share_at_hardness" else figure


def may_flow(run: Run, at_any: bool = False) -> str:
    """Clause that a body whose yield stress is not given may flow; empty where it cannot,
    where that is known or not asked.

    at_any  whether it would at any typical yield stress"""
    flow, body = run.data(NAME), run.problem.scene.body
    if flow.ratio is not None or body.youngs_modulus <= STIFF or flow.scene.asks_elastic:
        return ""
    shear, typical = with_unit(flow.worst.value, "Pa", 2), typical_shears(body)
    if typical is None:
        below = f"the figures are those of an elastic body; with a shear yield below {shear} it"
        return "" if at_any else f"{below} flows"
    if flow.worst.value < typical[1 if at_any else 0]:
        return ""
    return f"{flow_of(body)}, and the largest here is {shear}"


def flow_sentence(run: Run) -> str:
    """The one thing to know of flow beside the verdict, without its full stop."""
    flow = run.data(NAME)
    if said := flow.beyond_doubt or flow.at_such_stresses:
        return said
    several = len(run.problem.scene.load.friction) > 1
    where = f" at friction {plain(flow.worst.friction)}" if several else ""
    where += ", by the peak pressure (no [stress])" * (flow.there("von_mises_max") is None)
    if flow.ratio is None:
        shear = with_unit(flow.worst.value, "Pa", 2)
        return f"taken as elastic: it flows if its shear yield is below {shear}{where}"
    stress = with_unit(flow.yield_stress, "Pa", 3)
    third = "" if run.problem.scene.body.yield_stress else ", a third of the hardness"
    largest = f"the half-plane's largest shear is {significant(flow.ratio, 2)} times that of first "
    largest += f"flow{where} (Y = {stress}{third})"
    if flow.flow == "cap":
        share = percent(flow.there("share_at_hardness"))
        return f"flow is the hardness alone, at {share} of the contact; {largest}"
    return f"{FLOW_IN_WORDS[flow.flow]}; {largest}"


def note(run: Run) -> str:
    """How to read the figures of flow."""
    scene, flow = run.problem.scene, run.data(NAME)
    said = "Stresses of the elastic half-plane" + CAPPED * bool(scene.body.hardness)
    said += f"{BY_THE_PEAK * (flow.there('von_mises_max') is None)}."
    if flow.yield_stress is None:
        return f"{said} The scene has neither yield stress nor hardness: what flows is not known."
    caps = (with_unit(cap * flow.yield_stress, "Pa", 2) for cap in (LEAST_CAP, TABOR))
    return f"{said} {OF_A_YIELD_STRESS.format(*caps)}" + f" {OF_A_TRACE}" * bool(scene.profile)


def lines(run: Run) -> list[tuple[str, str]]:
    """Lines on flow where no model shows it; with a yield stress on shakedown and, of a rough body,
    its plasticity, at the largest shear."""
    flow, names = run.data(NAME), tuple(QUANTITIES)[8:12]
    at = None, flow.worst.friction
    known = [f for f in run.findings[NAME].figures if f.quantity in names and f.friction in at]
    texts = (f"{QUANTITIES[f.quantity].label} {significant(f.value, 3)}" for f in known)
    said = [("flow", flow.at_such_stresses), ("yield", ", ".join(texts))]
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
