"""How much each effect may change a figure, from dimensionless groups: before anything is solved.

    a, p0   half-width and peak pressure of the smooth contact     R     radius of the roller
    t, w    thickness and width of the body                        p     largest pressure
    mu beta friction times Dundurs' beta                           E, H  modulus, hardness

All are relative sizes without a sign, meant to be too large rather than too small: they decide
what is computed, and stand for what is not. That friction moves the surfaces is measured on the
half-plane (`comparisons.coupling`) where it is known.
"""

from collections.abc import Iterable

from analytic.material import Material
from comparisons.coupling import Coupling
from comparisons.problem import Problem
from comparisons.quantities import QUANTITIES

CONTACT = ("peak_pressure", "contact_length", "contact_ratio")
STRESS = ("tau1_max", "txz_max_abs")
NEAR_SURFACE = ("tau1_max", "tau1_max_depth", "txz_max_abs", "tau1_field_near")
NORMS = ("pressure_l2", "tau1_field_near", "tau1_field_deep")

Sizes = dict[str, float]


def estimates(
    problem: Problem,
    peak: float,
    linear: Iterable[str],
    couplings: tuple[Coupling, ...] = (),
) -> dict[str, Sizes]:
    """By effect and quantity; effects and quantities of no size are left out.

    peak       largest pressure [Pa] of the half-plane
    linear     names of the effects that the linear body has, beside which strain is not small
    couplings  of the half-plane, one a friction coefficient
    """
    scene, half_width = problem.scene, problem.hertz.half_width
    curvature = half_width / scene.roller_radius
    slope = 0.0 if scene.profile_info is None else scene.profile_info.roughness.rms_slope
    found = {
        "finite body": _finite_body(problem),
        "coating": _coating(problem),
        "real boundary": _real_boundary(slope),
        "displaced gap": _displaced_gap(curvature, peak, scene.body),
        "circle": _alike(CIRCLE * curvature**2),
        "disc": _alike(DISC * curvature**2) if scene.roller is not None else {},
        "coupling": _coupling(problem, couplings),
        "finite strain": _finite_strain(
            peak / scene.body.youngs_modulus, curvature, slope, set(linear)
        ),
        "plastic flow": _flow(problem, peak),
    }
    kept = {
        effect: {name: size for name, size in sizes.items() if size > 0.0}
        for effect, sizes in found.items()
    }
    return {effect: sizes for effect, sizes in kept.items() if sizes}


# (the constants of each effect stand with its function)

# The circle's next term is x^4 / (8 R^3), a^2 / (4 R^2) of the parabola at the contact's edge.
CIRCLE = 0.2
# A sector of the roller, free above, in place of a half-plane.
DISC = 1.0


def _alike(size: float) -> Sizes:
    return dict.fromkeys(QUANTITIES, size)


# Under a layer the half-plane's error is of second order in a/t; of first order in stresses,
# which keep what the far boundary reflects.
THICKNESS, WIDTH, REFLECTED = 0.6, 6.0, 1.0


def _finite_body(problem: Problem) -> Sizes:
    scene, half_width = problem.scene, problem.hertz.half_width
    size = reflected = 0.0
    if scene.thickness is not None:
        ratio = half_width / scene.thickness
        size += THICKNESS * ratio**2
        reflected += REFLECTED * ratio**2
    if scene.width is not None:
        ratio = half_width / scene.width
        size += WIDTH * ratio**2
        reflected += WIDTH * ratio**2
    found = _alike(size)
    return found | {name: max(size, reflected) for name in (*STRESS, *NORMS, "tau1_max_depth")}


def _coating(problem: Problem) -> Sizes:
    """As much as the stiffness differs: a coating is no small effect unless it is very thin."""
    scene = problem.scene
    if scene.coating is None:
        return {}
    ratio = scene.coating.material.plane_strain_modulus / scene.body.plane_strain_modulus
    depth = min(1.0, scene.coating.thickness / problem.hertz.half_width)
    size = abs(ratio - 1.0)
    return _alike(size * depth) | dict.fromkeys(NEAR_SURFACE, size)


# The real boundary in place of a flat one: 0.25 % in contact length and 0.14 % in peak pressure
# of a ground surface of rms slope 0.066; of second order. Stresses next to a boundary whose
# asperities do not flatten are of first order: 8.4 % in tau1 and 14 % in its near field.
BOUNDARY_PER_SLOPE_SQUARED, UNFLATTENED_PER_SLOPE = 1.0, 2.1


def _real_boundary(slope: float) -> Sizes:
    found = _alike(BOUNDARY_PER_SLOPE_SQUARED * slope**2)
    return found | dict.fromkeys(NEAR_SURFACE, UNFLATTENED_PER_SLOPE * slope)


# A gap taken at the displaced place, along the roller's tilted normal: 0.3 to 0.5 % in peak
# pressure and half-width at a/R = 0.02. The surface there is shorter by its own strain under the
# pressure, (1 - 2 nu) (1 + nu) p / E: 2.7 % in the peak pressure of asperities at p/E = 0.054. On a boundary that stays level the near field of tau1
# then differs by 33 % at a/R = 0.07.
TILT, UNTURNED = 0.25, 5.0


def _displaced_gap(curvature: float, peak: float, body: Material) -> Sizes:
    ratio = body.poissons_ratio
    shorter = (1.0 - 2.0 * ratio) * (1.0 + ratio) * peak / body.youngs_modulus
    found = _alike(TILT * curvature + shorter)
    return found | {"tau1_field_near": UNTURNED * curvature + shorter}


# Finite strain: 0.4 % in the peak pressure of a sinusoid under a rigid flat at p/E = 0.015, 1 % on
# rough surfaces at 0.035 (`comparisons.benchmarks.finite_deformation`).
STRAIN = 0.3


def _finite_strain(pressure: float, curvature: float, slope: float, linear: set[str]) -> Sizes:
    """Beside a linear body that has some effects by halves."""
    found = _alike(STRAIN * pressure)
    if "displaced gap" in linear:
        found["tau1_field_near"] += UNTURNED * curvature
    if "real boundary" in linear:
        for name in NEAR_SURFACE:
            found[name] += UNFLATTENED_PER_SLOPE * slope
    return found


# Sliding traction that moves the surfaces, where the half-plane does not tell: 8e-5 in the peak
# pressure at mu beta = 0.029, of second order; the pressure shifts by 0.64 mu beta half-widths.
COUPLING_PER_SQUARE, COUPLING_SHIFT = 0.1, 0.64


def _coupling(problem: Problem, couplings: tuple[Coupling, ...]) -> Sizes:
    """The largest of any friction coefficient: measured, else estimated."""
    found: Sizes = {}
    if problem.scene.coupled:
        return found
    measured = {coupling.friction: coupling.changes for coupling in couplings}
    for friction in problem.scene.friction:
        size = abs(friction * problem.dundurs_beta)
        sizes = _alike(COUPLING_PER_SQUARE * size**2)
        sizes |= dict.fromkeys(NORMS, COUPLING_SHIFT * size)
        for name, change in (measured.get(friction) or {}).items():
            if name in QUANTITIES:
                moved = change.difference
                if moved is None:  # zero without: by the scale that differences then take
                    moved = change.value / QUANTITIES[name].scale(problem.hertz)
                sizes[name] = abs(moved)
        found = {name: max(size, found.get(name, 0.0)) for name, size in sizes.items()}
    return found


# Below first yield, p0 = 1.79 Y at a hardness of 2.8 Y to 3 Y, nothing flows; where the cap holds
# the pressure, hardnesses from 2.4 Y to 3 Y fit what flow does, none of them everywhere
# (`comparisons.benchmarks.hardness_cap`).
FIRST_FLOW, CAP = 0.6, 0.1


def _flow(problem: Problem, peak: float) -> Sizes:
    scene = problem.scene
    if scene.yielding is not None:
        return _alike(1.0)  # it was asked for
    if scene.hardness is None:
        return {}
    beyond = (peak / scene.hardness - FIRST_FLOW) / (1.0 - FIRST_FLOW)
    return _alike(CAP * min(1.0, beyond)) if beyond > 0.0 else {}
