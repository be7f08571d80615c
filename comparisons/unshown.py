"""Effects that the finite-element model of a run cannot show.

That friction moves the surfaces is measured on the half-plane (`comparisons.coupling`). The others
are estimated from dimensionless groups, by constants that were measured; each names its case. All
are relative and of the size that the effect may have, not its sign.
"""

from collections.abc import Iterable

from comparisons.coupling import Coupling
from comparisons.level import ModelRun
from comparisons.problem import Problem
from comparisons.quantities import QUANTITIES

# A gap taken at the displaced place, along the roller's tilted normal, instead of at the
# undeformed one: 0.3 to 0.5 % in peak pressure and half-width at a/R = 0.02. Half of it is taken
# back by finite strain.
TILT_PER_A_OVER_RADIUS = 0.25
# Finite strain: 0.4 % in the peak pressure of a sinusoid under a rigid flat at p/E = 0.015, 1 % on
# rough surfaces at 0.035 (`comparisons.benchmarks.finite_deformation`).
STRAIN_PER_PRESSURE_OVER_MODULUS = 0.3
# Traction along the roller's normal on a boundary that stays level: 13 % in the near field of tau1
# at a/R = 0.05.
UNTURNED_PER_A_OVER_RADIUS = 2.6
# The real boundary in place of a flat one: 0.25 % in contact length and 0.14 % in peak pressure
# of a ground surface of rms slope 0.066; of second order.
BOUNDARY_PER_SLOPE_SQUARED = 1.0
# Stresses next to a real boundary whose asperities do not flatten as they would: 8.4 % in tau1
# and 14 % in its near field on the same surface; of first order.
UNFLATTENED_PER_SLOPE = 2.1
# Sliding traction that moves the surfaces, where the half-plane does not tell: 8e-5 in the peak
# pressure at mu beta = 0.029 (of second order); the pressure shifts by 0.64 mu beta half-widths.
COUPLING_PER_SQUARE, COUPLING_SHIFT = 0.1, 0.64

CONTACT = ("peak_pressure", "contact_length", "contact_ratio")
STRESS = ("tau1_max", "txz_max_abs")
NEAR_SURFACE = ("tau1_max", "tau1_max_depth", "txz_max_abs", "tau1_field_near")
NORMS = ("pressure_l2", "tau1_field_near")


def unshown_effects(
    problem: Problem, runs: dict[str, ModelRun], couplings: tuple[Coupling, ...]
) -> dict[str, dict[str, float]]:
    """By quantity and name of the effect, its relative size; effects of no size are left out.

    couplings  of the half-plane, one a friction coefficient
    """
    scene, settings = problem.scene, problem.scene.finite_element
    linear = settings.deformation == "linear"
    peak = max(float(run.finest.solution.pressure.max()) for run in runs.values())
    slope = 0.0 if scene.profile_info is None else scene.profile_info.roughness.rms_slope
    tilt = TILT_PER_A_OVER_RADIUS * problem.hertz.half_width / scene.roller_radius
    strain = STRAIN_PER_PRESSURE_OVER_MODULUS * peak / scene.body.youngs_modulus
    effects = []
    if linear and settings.gap == "reference":
        effects.append(("finite rotation", tilt, (*CONTACT, *STRESS)))
    if linear and settings.gap == "displaced" and settings.geometry == "flat":
        turn = UNTURNED_PER_A_OVER_RADIUS * problem.hertz.half_width / scene.roller_radius
        effects.append(("a surface that does not turn", turn, ("tau1_field_near",)))
    if linear:
        effects.append(("finite strain", strain, (*CONTACT, *STRESS)))
    if settings.geometry == "rough":
        if linear:
            unflattened = UNFLATTENED_PER_SLOPE * slope
            effects.append(("asperities that do not flatten", unflattened, NEAR_SURFACE))
    else:
        boundary = BOUNDARY_PER_SLOPE_SQUARED * slope**2
        effects.append(("the real boundary", boundary, (*CONTACT, *STRESS)))
    found: dict[str, dict[str, float]] = {}
    effects += [
        ("friction moving the surfaces", size, (quantity,))
        for quantity, size in _by_friction(problem, couplings).items()
    ]
    for name, size, quantities in effects:
        for quantity in quantities:
            if size > 0.0:
                found.setdefault(quantity, {})[name] = size
    return found


def _by_friction(problem: Problem, couplings: tuple[Coupling, ...]) -> dict[str, float]:
    """By quantity, the largest effect of any friction coefficient: measured, else estimated."""
    found: dict[str, float] = {}

    def at_least(size: float, quantities: Iterable[str]) -> None:
        for quantity in quantities:
            found[quantity] = max(found.get(quantity, 0.0), size)

    if problem.scene.finite_element.coupled:
        return found  # it is contained
    measured = {coupling.friction: coupling.changes for coupling in couplings}
    for friction in problem.scene.friction:
        if changes := measured.get(friction):
            for quantity in QUANTITIES:
                if quantity in changes:
                    change = changes[quantity]
                    size = change.difference
                    if size is None:  # zero without: by the scale that differences then take
                        size = change.value / QUANTITIES[quantity].scale(problem.hertz)
                    at_least(abs(size), [quantity])
        else:
            size = abs(friction * problem.dundurs_beta)
            at_least(COUPLING_PER_SQUARE * size**2, (*CONTACT, *STRESS))
            at_least(COUPLING_SHIFT * size, NORMS)
    return found
