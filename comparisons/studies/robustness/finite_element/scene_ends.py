"""Finite elements on scenes at their ends: stiffness ratios, locking, friction, hardness, units.

References: Hertz and the sliding and the flattened cylinder, exact; the same scene in other units
of length and of stress; the same surface from behind, on the mirrored mesh.
"""

from functools import partial

import numpy as np

from analytic.exact.flattened_cylinder import flattened_cylinder
from analytic.exact.sliding import sliding_from_load
from analytic.material import dundurs_constants
from comparisons.models.level import Level
from comparisons.studies.robustness.finite_element.bodies import (
    MOST_COUPLED_STEPS,
    MOST_STEPS,
    FinitePressed,
    held_finite,
)
from comparisons.studies.robustness.pressing import departure
from comparisons.studies.robustness.row import Case, Figure, Findings
from comparisons.studies.robustness.scenes import (
    LOAD,
    ORDINARY,
    RIGID,
    STEEL,
    Tables,
    finite_level,
    ordinary_level,
    problem_from,
)

PEAK, LENGTH, PLACE = 2e-3, 3e-3, 4e-3  # of Hertz's, with 19 hats on a half-width
CUBIC_PEAK = 1e-3
LOCKING = 0.49  # Poisson's ratio from which cubic elements are due (`fem.body.elasticity`)
SAME = 1e-7  # what another unit may change: a mesh's coordinates are rounded to 1e-9 of an edge


def held(level: Level, *figures: Figure, most: int = MOST_STEPS) -> Findings:
    """Findings of a level of finite elements, its steps beside those of the ordinary scene."""
    _, usual = ordinary_level()
    pressed = FinitePressed(level.grid, level.solution)
    return held_finite(pressed, *figures, most=most, usual=usual.solution.iterations["steps"])


def hertz_findings(tables: Tables, peak: float = PEAK) -> Findings:
    """A smooth contact against Hertz's."""
    problem = problem_from(tables)
    level, hertz = finite_level(problem), problem.hertz
    figures = (
        Figure(
            "peak pressure",
            abs(level.solution.pressure.max() / hertz.peak_pressure - 1.0),
            peak,
            "Hertz, exact",
        ),
        Figure(
            "contact length",
            abs(0.5 * level.contact_length / hertz.half_width - 1.0),
            LENGTH,
            "Hertz, exact",
        ),
    )
    return held(level, *figures)


def tau_findings(tables: Tables) -> Findings:
    """Stresses, too: the largest principal shear."""
    problem = problem_from({**tables, "stress": {"points": [40, 20]}})
    level, hertz = finite_level(problem), problem.hertz
    found = level.stresses[0].extremes["tau1"]
    figures = (
        Figure("tau1", abs(found.value / hertz.tau1_max - 1.0), 1e-2, "Hertz, exact"),
        Figure(
            "depth of tau1",
            abs(found.z / hertz.tau1_max_depth - 1.0),
            3e-2,
            "Hertz, exact",
        ),
    )
    return held(level, *figures)


def sliding_findings(friction: float, poissons_ratio: float) -> Findings:
    """A rigid roller that slides, its traction moving the surface."""
    body = {**STEEL, "poissons_ratio": poissons_ratio}
    load = {**LOAD, "friction": friction, "coupled": True}
    element = {"element": "P3" if poissons_ratio > LOCKING else "P2"}
    problem = problem_from({**ORDINARY, "body": body, "load": load, "finite_element": element})
    level = finite_level(problem)
    beta = dundurs_constants(problem.scene.body, None)[1]
    hertz = problem.hertz
    exact = sliding_from_load(hertz.load_per_length, hertz.radius, problem.modulus, friction, beta)
    x, pressure, size = level.grid.x, level.solution.pressure, exact.half_width
    place = x @ pressure / pressure.sum()
    figures = (
        Figure(
            "peak pressure",
            abs(pressure.max() / exact.peak_pressure - 1.0),
            PEAK,
            "sliding cylinder, exact",
        ),
        Figure(
            "place of the load",
            abs(place - exact.load_position) / size,
            PLACE,
            "sliding cylinder, exact",
        ),
    )
    return held(level, *figures, most=MOST_COUPLED_STEPS)


def hardness_findings(share: float) -> Findings:
    """A hardness of `share` of Hertz's peak."""
    plain, usual = ordinary_level()
    hardness = share * float(usual.solution.pressure.max())
    problem = problem_from({**ORDINARY, "body": {**STEEL, "hardness": hardness}})
    level = finite_level(problem)
    if share >= 1.0:
        hertz = plain.hertz
        peak = abs(level.solution.pressure.max() / hertz.peak_pressure - 1.0)
        length = abs(0.5 * level.contact_length / hertz.half_width - 1.0)
        return held(
            level,
            Figure("peak pressure", peak, PEAK, "Hertz, exact"),
            Figure("contact length", length, LENGTH, "Hertz, exact"),
        )
    hertz = problem.hertz
    flat = flattened_cylinder(hertz.load_per_length, hertz.radius, problem.modulus, hardness)
    length = abs(0.5 * level.contact_length / flat.contact - 1.0)
    flowed = np.count_nonzero(level.solution.pressure >= hardness * (1.0 - 1e-9))
    off = abs(flowed * level.grid.pitch - 2.0 * flat.flowed) / level.grid.pitch
    figures = (
        Figure("contact length", length, LENGTH, "flattened cylinder, exact"),
        Figure("flowed length", off, 2.0, "flattened cylinder, exact, in hats"),
    )
    return held(level, *figures)


def in_units(metre: float, pascal: float) -> Tables:
    """The ordinary scene with all lengths times `metre` and all stresses times `pascal`."""
    return {
        "roller": {**RIGID, "radius": RIGID["radius"] * metre},
        "body": {**STEEL, "youngs_modulus": STEEL["youngs_modulus"] * pascal},
        "load": {"per_length": LOAD["per_length"] * metre * pascal},
    }


def unit_findings(metre: float, pascal: float) -> Findings:
    """In other units the same triangles and the same figures."""
    _, usual = ordinary_level()
    level = finite_level(problem_from(in_units(metre, pascal)))
    length = abs(level.contact_length / usual.contact_length / metre - 1.0)
    figures = (
        departure(
            level.solution.pressure / pascal, usual.solution.pressure, "pressure", SAME, "in metres"
        ),
        Figure("contact length", length, 1e-5, "in metres"),
        Figure(
            "unknowns", level.unknowns / usual.unknowns, 1.0, "in metres: the same mesh", least=1.0
        ),
    )
    return held(level, *figures)


def cases() -> tuple[Case, ...]:
    """The cases of this module."""
    elastic = {"radius": 8e-3, "poissons_ratio": 0.2}

    def with_body(**fields: float) -> Tables:
        return {**ORDINARY, "body": {**STEEL, **fields}}

    cubic = {"finite_element": {"element": "P3"}}
    materials = [
        ("ordinary: rigid on steel", partial(hertz_findings, ORDINARY)),
        *(
            (
                f"roller {ratio:g} times as stiff",
                partial(
                    hertz_findings,
                    {**ORDINARY, "roller": {**elastic, "youngs_modulus": ratio * 207e9}},
                ),
            )
            for ratio in (1e6, 1e-6)
        ),
        ("Poisson's ratio 0", partial(hertz_findings, with_body(poissons_ratio=0.0))),
        ("Poisson's ratio 0.49", partial(hertz_findings, with_body(poissons_ratio=0.49))),
        ("Poisson's ratio 0.4999", partial(hertz_findings, with_body(poissons_ratio=0.4999))),
        (
            "Poisson's ratio 0.4999, cubic",
            partial(hertz_findings, {**with_body(poissons_ratio=0.4999), **cubic}, CUBIC_PEAK),
        ),
        (
            "held like a half-plane close by",
            partial(hertz_findings, {**ORDINARY, "finite_element": {"far_field": "half-plane"}}),
        ),
        ("stresses", partial(tau_findings, ORDINARY)),
        (
            "stresses, Poisson's ratio 0.4999, cubic",
            partial(tau_findings, {**with_body(poissons_ratio=0.4999), **cubic}),
        ),
    ]
    others = [
        ("friction", f"friction {mu:g}, nu = {nu:g}", partial(sliding_findings, mu, nu))
        for mu, nu in ((0.5, 0.3), (1.0, 0.0), (1.0, 0.4999))
    ]
    others += [
        ("hardness", f"hardness {share:g} of the peak", partial(hardness_findings, share))
        for share in (1.0 + 1e-6, 1.0 - 1e-2)
    ]
    others += [
        (
            "units",
            f"lengths in {metre:g} m, stresses in {pascal:g} Pa",
            partial(unit_findings, metre, pascal),
        )
        for metre, pascal in ((1e-9, 1.0), (1e3, 1.0), (1.0, 1e-6), (2.0**-20, 2.0**10))
    ]
    rows = [("materials", name, solve) for name, solve in materials] + others
    return tuple(Case(group, name, "finite_element", solve) for group, name, solve in rows)
