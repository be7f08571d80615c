"""Layers and coatings on the analytic side: a/t from 1e-3 to 1e2, locking, contrasts of 1e6.

References: the exact limits of thick and thin; pressures of the contact's own integral equation in
between (Chebyshev collocation, 1e-10); the half-plane where a coating is none or all there is; a
single wave in a hundred digits.
"""

from dataclasses import dataclass
from functools import partial

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import solve_contact
from analytic.exact.layers import (
    LayerLimit,
    thick_layer,
    thin_compressible_layer,
    thin_incompressible_layer,
)
from analytic.grid import HatGrid, roller_gap
from analytic.layers.layered import LayeredBody, normal_compliance
from analytic.layers.operator import LayeredSurface
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane, ModelOperator
from comparisons.studies.robustness.many_digits import wave_sinking
from comparisons.studies.robustness.pressing import (
    Pressed,
    cost_figures,
    departure,
    residual_figures,
)
from comparisons.studies.robustness.row import Case, Figure, Findings

PER_HALF = 77.3
DISCRETE = 5e-4  # of the length, PEAK of the peak, with PER_HALF hats
PEAK = 1e-4
NYLON = Material(1.0 - 0.3**2, 0.3)  # plane-strain modulus 1
ELASTOMER = Material(1.0, 0.5 - 1e-9)


@dataclass(frozen=True)
class Between:
    """A rigid cylinder on a layer where no limit helps: half-width `a_over_t` in thicknesses.

    load, peak  in E' t^2/R and E' t/R, right to 1e-9; E' is the layer's plane-strain modulus
    """

    base: str
    poissons_ratio: float
    a_over_t: float
    load: float
    peak: float


# Chebyshev collocation of the slope equation with Johnson's kernels (1985, section 5.8), checked
# against Bessel functions; worst relative difference 3.6e-10.
BETWEEN = (
    Between("bonded", 0.3, 1.0, 1.221796849, 0.8048844113),
    Between("bonded", 0.4999, 1.0, 1.494562771, 1.000958512),
    Between("bonded", 0.3, 4.0, 57.32755905, 10.37553733),
    Between("bonded", 0.4999, 4.0, 150.4431554, 29.17421839),
    Between("frictionless", 0.3, 1.0, 1.117343609, 0.7284882671),
    Between("frictionless", 0.3, 4.0, 48.62308932, 8.724252752),
)


def pressed_on(operator: ModelOperator, pitch: float, radius: float, load: float) -> Pressed:
    """A cylinder on an operator of hats about the middle."""
    half = operator.count // 2
    grid = HatGrid(pitch, -half, operator.count - 1 - half)
    weighted_gap, constraints = grid.hat_integrals(roller_gap(radius)), Constraints(load=load)
    solution = solve_contact(operator, weighted_gap, grid.weights, constraints)
    return Pressed(grid.x, weighted_gap, operator, constraints, solution)


def on_layer(
    body: LayeredBody, half_width: float, radius: float, load: float, reach: float = 1.5
) -> Pressed:
    """A cylinder of `radius` [m] on a layered body, PER_HALF hats on `half_width` [m]."""
    pitch, count = half_width / PER_HALF, 2 * int(reach * PER_HALF) + 1
    return pressed_on(LayeredSurface(count, pitch, body), pitch, radius, load)


def held(pressed: Pressed, *figures: Figure) -> Findings:
    """Findings with the figures of every contact, and the condition of its matrix."""
    kept, checks = residual_figures(pressed.solution)
    spent, cost = cost_figures(pressed.solution, len(pressed.x))
    touching = np.flatnonzero(pressed.pressure > 0.0)
    condition = float(np.linalg.cond(pressed.operator.block(touching)))
    return Findings((*figures, *kept, *spent), checks, condition, cost)


def limit_findings(
    body: LayeredBody, limit: LayerLimit, radius: float, left_out: float
) -> Findings:
    """Against a limit that leaves out `left_out` of the load, relative."""
    pressed = on_layer(body, limit.half_width, radius, limit.load_per_length)
    peak = abs(pressed.pressure.max() / limit.peak_pressure - 1.0)
    length = abs(0.5 * pressed.contact_length / limit.half_width - 1.0)
    allowed = left_out + 2.0 * DISCRETE
    return held(
        pressed,
        Figure("peak pressure", peak, allowed, "the limit and what it leaves out"),
        Figure("half-width", length, allowed, "the limit and what it leaves out"),
    )


def thick_findings(base: str, a_over_t: float) -> Findings:
    limit = thick_layer(a_over_t, 50.0, 1.0, NYLON, base)
    return limit_findings(LayeredBody(NYLON, 1.0, base), limit, 50.0, 0.23 * a_over_t**4)


def thin_findings(base: str, a_over_t: float) -> Findings:
    radius = 1e3 * a_over_t
    limit = thin_compressible_layer(a_over_t, radius, 1.0, NYLON, base)
    share = 0.53 if base == "frictionless" else 0.37
    return limit_findings(LayeredBody(NYLON, 1.0, base), limit, radius, share / a_over_t)


def incompressible_findings(a_over_t: float) -> Findings:
    radius = 1e3 * a_over_t
    limit = thin_incompressible_layer(a_over_t, radius, 1.0, 1.0)
    return limit_findings(LayeredBody(ELASTOMER, 1.0, "bonded"), limit, radius, 8.0 / a_over_t)


def between_findings(between: Between) -> Findings:
    """Against a solution of the integral equation."""
    nu, radius = between.poissons_ratio, 50.0
    body = LayeredBody(Material(1.0 - nu**2, nu), 1.0, between.base)
    pressed = on_layer(body, between.a_over_t, radius, between.load / radius)
    peak = abs(pressed.pressure.max() / (between.peak / radius) - 1.0)
    length = abs(0.5 * pressed.contact_length / between.a_over_t - 1.0)
    return held(
        pressed,
        Figure("peak pressure", peak, PEAK, "collocation of the integral equation"),
        Figure("half-width", length, DISCRETE, "collocation of the integral equation"),
    )


def coated_findings(body: LayeredBody, stands_for: Material, allowed: float) -> Findings:
    """A coating that is none, or all there is: the pressures of a half-plane of `stands_for`."""
    modulus = stands_for.plane_strain_modulus
    load = np.pi * modulus / (4.0 * 50.0)  # half-width 1
    pressed = on_layer(body, 1.0, 50.0, load)
    count, pitch = pressed.operator.count, pressed.pitch
    plain = pressed_on(HalfPlane(count, pitch, modulus), pitch, 50.0, load)
    figure = departure(
        pressed.pressure, plain.pressure, "pressure", allowed, "the half-plane it stands for"
    )
    return held(pressed, figure)


def rigid_base_findings(softness: float) -> Findings:
    """A coating `softness` times as soft as its body: a layer on a rigid base."""
    coating = Material(0.91, 0.3)
    stiff = Material(0.91 / softness, 0.3)
    limit = thick_layer(0.25, 50.0, 1.0, coating, "bonded")
    soft = on_layer(LayeredBody(coating, 1.0, stiff), 0.25, 50.0, limit.load_per_length)
    rigid = on_layer(LayeredBody(coating, 1.0, "bonded"), 0.25, 50.0, limit.load_per_length)
    figure = departure(
        soft.pressure, rigid.pressure, "pressure", 10.0 * softness, "the layer on a rigid base"
    )
    return held(soft, figure)


def wave_findings(body: LayeredBody) -> Findings:
    """Waves from 1e-6 to 20 per thickness, each against a hundred digits."""
    k = np.geomspace(1e-6, 20.0, 12) / body.thickness
    found = normal_compliance(body, k)
    exact = np.array([wave_sinking(body, float(each)) for each in k])
    error = float(np.abs(found / exact - 1.0).max())
    return Findings((Figure("compliance", error, 2e-14, "a hundred digits"),))


def cases() -> tuple[Case, ...]:
    """The cases of this module."""
    table = {
        **{
            f"a/t = {ratio:g}, {base}": partial(thick_findings, base, ratio)
            for base in ("bonded", "frictionless")
            for ratio in (1e-3, 0.1)
        },
        **{
            f"a/t = {b.a_over_t:g}, {b.base}, nu = {b.poissons_ratio:g}": partial(
                between_findings, b
            )
            for b in BETWEEN
        },
        "a/t = 100, bonded": partial(thin_findings, "bonded", 100.0),
        "a/t = 100, frictionless": partial(thin_findings, "frictionless", 100.0),
        "a/t = 100, bonded, incompressible": partial(incompressible_findings, 100.0),
    }
    hard, soft = Material(0.91e6, 0.2), Material(0.91, 0.3)
    coatings = {
        "coating of the body's own material": partial(
            coated_findings, LayeredBody(soft, 0.3, soft), soft, 1e-9
        ),
        "stiff coating 1e-12 a thin, 1e6 times as stiff": partial(
            coated_findings, LayeredBody(hard, 1e-12, soft), soft, 5e-5
        ),
        "soft coating 1e-12 a thin, 1e-6 times as stiff": partial(
            coated_findings, LayeredBody(soft, 1e-12, hard), hard, 5e-5
        ),
        "stiff coating 1e6 a thick": partial(
            coated_findings, LayeredBody(hard, 1e6, soft), hard, 1e-6
        ),
        "soft coating on a body 1e6 times as stiff": partial(rigid_base_findings, 1e-6),
    }
    waves = {
        "waves: bonded, nu = 0.3": LayeredBody(NYLON, 1.0, "bonded"),
        "waves: bonded, nu = 0.5 less 1e-9": LayeredBody(ELASTOMER, 1e-6, "bonded"),
        "waves: frictionless": LayeredBody(NYLON, 1.0, "frictionless"),
        "waves: coating 1e6 times as stiff": LayeredBody(hard, 1.0, soft),
        "waves: coating 1e-6 times as stiff": LayeredBody(soft, 1.0, hard),
    }
    rows = [("layer", name, solve) for name, solve in table.items()]
    rows += [("coating", name, solve) for name, solve in coatings.items()]
    rows += [("layer", name, partial(wave_findings, body)) for name, body in waves.items()]
    return tuple(Case(group, name, "half_plane", solve) for group, name, solve in rows)
