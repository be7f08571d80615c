"""Estimates of what each effect may change, from dimensionless groups: before it is computed.

    a, p0   half-width and peak pressure of the smooth contact     R     radius of the roller
    t, w    thickness and width of the body                        p     largest pressure
    mu beta friction times Dundurs' beta                           E, H  modulus, hardness
    s       rms slope of the surface                               lambda  its shortest wave

All are relative sizes without a sign, rather too large than too small: they decide which effects
are computed, and count for those that are not. Each is a factor times a group. The factors bound
the full solutions of smooth and wavy bodies, the maps' among them, quantity by quantity: an effect
is larger in stresses than in the contact.
Normal-tangential coupling is measured on the half-plane where that is possible
(`comparisons.judging.coupling`)."""

import math
from dataclasses import dataclass
from typing import Self

import numpy as np

from analytic.material import dundurs_constants
from comparisons.common.numbers import with_unit
from comparisons.figures.quantity import QUANTITIES
from comparisons.judging.coupling import Coupling
from comparisons.judging.effects.laws import OF_THE_PEAK, open_laws
from comparisons.models.problem import TABOR, Problem
from comparisons.scenes.materials import typical_range
from comparisons.scenes.sections import BodySection

Sizes = dict[str, float]

STRESSES = ("tau1_max", "txz_max_abs")
NEAR_SURFACE = ("tau1_max", "tau1_max_depth", "txz_max_abs")


@dataclass(frozen=True)
class Shown:
    """Contact as the half-plane shows it, by which effects are estimated."""

    peak: float  # [Pa] largest pressure
    mean: float  # [Pa] that the load stands under on average
    couplings: tuple[Coupling, ...] = ()  # one a friction coefficient
    shear: float = 0.0  # [Pa] largest tau1, at least

    @classmethod
    def by(cls, *pressures: np.ndarray, **beside: object) -> Self:
        """The largest of pressures [Pa] on equal elements, each (n,), and what is known beside."""
        means = (float(pressure @ pressure / pressure.sum()) for pressure in pressures)
        return cls(max(float(pressure.max()) for pressure in pressures), max(means), **beside)


def _equal(size: float) -> Sizes:
    return dict.fromkeys(QUANTITIES, size)


def _curvature(problem: Problem) -> float:
    return problem.hertz.half_width / problem.scene.roller.radius


# Of second order in a/t and a/w in the contact, of first in stresses, which keep what the far
# boundary reflects: 4.6 % in tau1 at a/t = 0.05.
BODY_SQUARE = {"thickness": 0.6, "width": 6.0}
REFLECTED = {"tau1_max": 1.0, "tau1_max_depth": 1.0}
BROADER = 1.5  # reflected by free sides, of what a base reflects


def finite_size(problem: Problem, shown: Shown) -> Sizes:
    estimate = _equal(0.0)
    for extent, factor in (("thickness", 1.0), ("width", BROADER)):
        length = getattr(problem.scene.body, extent)
        if length is None:
            continue
        ratio = problem.hertz.half_width / length
        square = BODY_SQUARE[extent] * ratio**2
        for name in estimate:
            estimate[name] += square + factor * REFLECTED.get(name, 0.0) * ratio
    return estimate


def coating(problem: Problem, shown: Shown) -> Sizes:
    """Change as large as the stiffness differs; of the contact's figures the deeper it reaches."""
    coating, body = problem.scene.coating, problem.scene.body.material
    if coating is None:
        return {}
    ratio = coating.material.plane_strain_modulus / body.plane_strain_modulus
    size = max(ratio, 1.0 / ratio) - 1.0
    depth = min(1.0, coating.thickness / problem.hertz.half_width)
    return _equal(size * depth) | dict.fromkeys(NEAR_SURFACE, size)


# 0.25 % in contact length and 0.14 % in peak pressure of a ground surface of rms slope 0.066: of
# second order. The largest tau1 may come to stand below another asperity, at another depth.
BOUNDARY_PER_SLOPE_SQUARED, BOUNDARY_OF_DEPTH = 1.0, 7.0
# The roller's tilted normal: 0.3 to 0.5 % in peak pressure and half-width at a/R = 0.02. Once
# deformed, the surface is shorter by its own strain under the pressure, (1 - 2 nu) (1 + nu)
# p / E: 2.7 % in the peak pressure of asperities at p/E = 0.054.
TILT, TILT_OF_STRESS = 0.25, 2.2
# 0.4 % in the peak pressure of a sinusoid under a rigid flat at p/E = 0.015, 1 % on rough surfaces
# at 0.035; 2 % in tau1 at 0.038.
STRAIN, STRAIN_OF_STRESS = 0.3, 0.75


def finite_deformation(problem: Problem, shown: Shown) -> Sizes:
    """Finite strain, the gap on the deformed surface, the trace as boundary."""
    body, info = problem.scene.body.material, problem.surface.info
    if problem.scene.linear:
        return {}
    pressure = shown.peak / body.youngs_modulus
    strained = _equal(STRAIN * pressure) | dict.fromkeys(STRESSES, STRAIN_OF_STRESS * pressure)
    strain = (1.0 - 2.0 * body.poissons_ratio) * (1.0 + body.poissons_ratio) / body.youngs_modulus
    size = TILT * _curvature(problem) + strain * shown.peak
    moved = _equal(size) | dict.fromkeys(STRESSES, TILT_OF_STRESS * size)
    slope = 0.0 if info is None else info.roughness.rms_slope
    bounded = _equal(BOUNDARY_PER_SLOPE_SQUARED * slope**2)
    bounded["tau1_max_depth"] = BOUNDARY_OF_DEPTH * slope
    return {name: strained[name] + moved[name] + bounded[name] for name in strained}


# The circle's next term is x^4 / (8 R^3): a^2 / (4 R^2) of the parabola at the contact's edge.
CIRCLE = 0.25


def exact_circle(problem: Problem, shown: Shown) -> Sizes:
    return _equal(CIRCLE * _curvature(problem) ** 2)


# A disc in place of a half-plane: of a polymer 0.52 (a/R)^2 as a sector, -0.33 held opposite the
# contact, 0.72 on a hub of half the radius; on larger hubs 0.25 to 0.34 times the square of a over
# the ring's thickness.
DISC, RING = 0.8, 0.45


def finite_roller(problem: Problem, shown: Shown) -> Sizes:
    roller = problem.scene.roller
    if roller.rigid:
        return {}
    square = _curvature(problem) ** 2
    if roller.hub is not None:
        share = problem.modulus / roller.material.plane_strain_modulus
        thickness = roller.radius - roller.hub
        ratio = problem.hertz.half_width / thickness
        square = max(square, RING / DISC * share * ratio**2)
    return _equal(DISC * square)


# How far supports from opposite the contact to a hub of half the radius are from the sector that is
# taken where none is given, over (a/R)^2 and the roller's share of the compliance: in peak pressure
# and length 0.5 at Poisson's ratio 0, 0.63 at 0.3, 0.9 at 0.4, 1.2 at 0.48.
SUPPORT, SUPPORT_BY_RATIO = 0.6, 3.1  # of the ratio's square
# Friction turns a disc by its support, about its middle; over friction, a/R and the roller's share:
# 4 in the depth of tau1 of a smooth contact. On ground and wavy surfaces 1 in peak pressure and 1.7
# in length, where single asperities come into contact.
TURNED = {"tau1_max_depth": 4.0}
TURNED_ROUGH = {"peak_pressure": 1.0, "contact_length": 1.7}


def roller_support(problem: Problem, shown: Shown) -> Sizes:
    roller = problem.scene.roller
    if roller.rigid or roller.support is not None:
        return {}
    share = problem.modulus / roller.material.plane_strain_modulus
    factor = SUPPORT + SUPPORT_BY_RATIO * roller.poissons_ratio**2
    size = factor * share * _curvature(problem) ** 2
    sizes = _equal(size)
    turned = max(problem.scene.load.friction) * share * _curvature(problem)
    moved = TURNED | (TURNED_ROUGH if problem.scene.profile is not None else {})
    return sizes | {name: sizes[name] + of * turned for name, of in moved.items()}


# Of a body that flows, under the pressure that it bears. Small strains move its peaks by 0.5 % at
# most, lengths by 0.9 %, tau1 by 2.5 %, up to a plastic strain of 0.07 under smooth rollers and of
# 0.025 on a turned surface, peaks by 2.4 % on a ground one at 0.02: less than an elastic body under
# that pressure may be off. Beyond, terms of the order of the plastic strain count: at 0.19 on a
# steep surface 5 % of the peak and 7 % of tau1, for 8.6 and 10.4.
FLOWED = 0.3


def finite_flow(problem: Problem, shown: Shown, strain: float) -> Sizes:
    """Finite deformation of a whole model that flows at small strains, up to an equivalent plastic
    strain, and shows these pressures."""
    elastic = finite_deformation(problem, shown)
    return {name: size + FLOWED * strain for name, size in elastic.items()}


# What a law changes on a smooth contact counts as much more on asperities: of St.
# Venant-Kirchhoff's and Murnaghan's laws -1.6 to +2.05 over p/E in peak pressure and tau1 of waves
# and of a ground trace, -0.89 to +1.19 on smooth contacts. The depth of tau1 moves by more.
OF_ASPERITIES, LAW_OF_DEPTH = 1.75, 1.3


def law_of_elasticity(problem: Problem, shown: Shown) -> Sizes:
    """Changes by the bodies whose law is not known, each by its share of what closes the gap; of a
    coating by its depth."""
    scene = problem.scene
    strained = 0.0
    for law in open_laws(scene):
        stiffness = law.material.plane_strain_modulus * law.material.youngs_modulus
        for name in law.bodies:
            thickness = scene.coating.thickness if name == "coating" else math.inf
            depth = min(1.0, thickness / problem.hertz.half_width)
            strained += depth * law.size * problem.modulus / stiffness
    strained *= 1.0 if scene.profile is None else OF_ASPERITIES
    estimate = _equal(strained * shown.mean)
    estimate["tau1_max_depth"] *= LAW_OF_DEPTH
    return estimate | dict.fromkeys(("peak_pressure", *STRESSES), strained * shown.peak)


# Coupling where it is not measured on the half-plane: 1.4 % in contact
# length at mu beta = 0.28, of second order; stresses next to the surface change at high friction:
# at mu beta of 0.06 to 0.1 the largest shear stands 16 % higher, or on the surface, where it was
# 0.3 half-widths below.
COUPLING_SQUARE = 0.25
COUPLING_OF_STRESS = {"tau1_max": 0.8, "tau1_max_depth": 3.0, "txz_max_abs": 0.3}
# A layer and a coating couple even where both bodies have equal constants: pressures of steel on
# steel change by 10 %, 7 % and 3 % at a/t = 3, 1 and 1/4 and friction 0.3.
FAR_SIDE, COAT_SIDE = 2.0, 3.0


def coupling(problem: Problem, shown: Shown) -> Sizes:
    """The largest of any friction coefficient: measured, else estimated."""
    estimate: Sizes = {}
    if problem.scene.load.coupled:
        return estimate
    measured = {coupling.friction: coupling.changes for coupling in shown.couplings}
    for friction in problem.scene.load.friction:
        sizes = _coupled(friction * abs(problem.dundurs_beta))
        for name, change in measured.get(friction, {}).items():
            if name in QUANTITIES:
                sizes[name] = abs(change)
        layered = _coupled(friction * _layered_beta(problem))  # which no half-plane shows
        estimate = {
            name: max(size, layered[name], estimate.get(name, 0.0)) for name, size in sizes.items()
        }
    return estimate


def _coupled(size: float) -> Sizes:
    """Changes by surfaces that traction moves by `size` = mu beta."""
    sizes = _equal(COUPLING_SQUARE * size**2)
    return sizes | {name: factor * size for name, factor in COUPLING_OF_STRESS.items()}


def _layered_beta(problem: Problem) -> float:
    """Dundurs' beta of a layer or a coating, in its stead: that of the coating by its depth, and
    that of the body alone by the nearness of its far side."""
    scene, half_width = problem.scene, problem.hertz.half_width
    estimate = 0.0
    if scene.coating is not None:
        beta = dundurs_constants(scene.coating.material, scene.roller.material)[1]
        estimate += abs(beta) * min(1.0, COAT_SIDE * scene.coating.thickness / half_width)
    if scene.body.thickness is not None:
        alone = abs(dundurs_constants(scene.body.material, None)[1])
        share = 2.0 * problem.modulus / scene.body.material.plane_strain_modulus
        estimate += alone * share * min(1.0, FAR_SIDE * half_width / scene.body.thickness)
    return estimate


# Below first yield, p0 = 1.79 Y at a hardness of 2.8 Y to 3 Y, nothing flows; where it holds
# the pressure, hardnesses from 2.4 Y to 3 Y fit what finite elements that flow do, none everywhere:
# 2.4 Y at 3 to 4 times first yield, 2.8 Y at 6 to 12 times, 3 Y beyond.
FIRST_FLOW, CAP = 0.6, 0.1
# Without a hardness, smooth, no hardening, at friction 0 and 0.2: from first flow on the peak
# pressure is too high by 0.9 of p/H - 0.6 at most, 33 % at p = H and 83 % at 1.5 H, the length too
# small by half of that; stresses by up to 1.5 times as much, and by 6 % already where friction
# makes the surface flow first. Their largest value moves to another depth.
UNCAPPED, UNCAPPED_STRESS, FIRST_AT_SURFACE = 1.0, 1.5, 0.1
BOTH_CRITERIA = 2.0 / 3.0**0.5  # shear of first flow by von Mises over that by Tresca
# [Pa] Rubber, which bears shears of the size of G, is softer.
STIFF = 1e9


def plastic_flow(problem: Problem, shown: Shown) -> Sizes:
    scene, body, peak = problem.scene, problem.scene.body, shown.peak
    shear = max(shown.shear, OF_THE_PEAK * peak)
    if scene.finite_element.plastic or scene.asks_elastic:
        return {}  # the scene's own finite elements flow, or it asks for none that do
    if not (body.hardness or body.yield_stress):
        typical = typical_shears(body)
        return _equal(math.inf) if typical and shear > BOTH_CRITERIA * typical[1] else {}
    if body.yield_stress:
        beyond = max(peak, shear / OF_THE_PEAK) / (TABOR * body.yield_stress) - FIRST_FLOW
    else:
        beyond = peak / body.hardness - FIRST_FLOW
    if beyond <= 0.0:
        return {}
    if body.hardness:
        excess = max(0.0, peak / body.hardness - 1.0)
        return _equal(CAP * min(1.0, beyond / (1.0 - FIRST_FLOW)) + excess)
    stress = UNCAPPED_STRESS * beyond + FIRST_AT_SURFACE
    stresses = dict.fromkeys(STRESSES, stress) | {"tau1_max_depth": max(1.0, stress)}
    return _equal(UNCAPPED * beyond) | stresses


def why_no_flow(problem: Problem) -> str | None:
    """Why finite elements that flow cannot be solved in a scene."""
    scene = problem.scene
    if scene.body.yield_stress is None:
        known = typical_shears(scene.body) and not scene.body.hardness  # which stands for flow
        return "the body has no yield stress" + (f", {flow_of(scene.body)}" if known else "")
    if scene.load.kind == "approach":
        return "it needs a load in place of load.approach"
    if scene.finite_element.deformation == "finite":
        return 'it needs finite_element.deformation = "linear"'
    return None


def typical_shears(body: BodySection) -> tuple[float, float] | None:
    """Range of shears [Pa] at which bodies of its solid typically flow, Y/2 by Tresca; of its
    class where only that is known, None where nothing is, or of a rubber."""
    if body.youngs_modulus <= STIFF:
        return None
    known = typical_range("yield_stress", body.solid, body.kinds)
    return known and (0.5 * known[0], 0.5 * known[1])


def flow_of(body: BodySection) -> str:
    """Clause on the shears at which its solid typically flows."""
    span = " to ".join(dict.fromkeys(with_unit(end, "Pa", 2) for end in typical_shears(body)))
    return f"{body.solid or ' or '.join(body.kinds)} typically flows at a shear of {span}"
