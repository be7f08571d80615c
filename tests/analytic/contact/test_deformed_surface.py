"""Half-planes on their deformed surfaces: the equations of elasticity to second order, wave by
wave, and what finite elements at finite strain say of laws and of waves."""

import numpy as np
import pytest
from numpy.polynomial.polynomial import polyder, polymul

from analytic.contact.deformed_surface import DeformedContact, SecondOrderSurface
from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import solve_contact
from analytic.exact.hertz import hertz_from_peak_pressure
from analytic.grid import HatGrid, roller_gap
from analytic.material import Law, Material
from analytic.material.third_order import peak_change, third_order
from analytic.operators.half_plane import HalfPlane

TERMS = 8  # of polynomials in y
LAWS = (Law(), Law("st-venant-kirchhoff"), Law("murnaghan", (-3e11, -6e11, 5e11)))


def times(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Product of polynomials in y, or of tensors of them, summed over inner indices."""
    if one.ndim == 1:
        return np.pad(polymul(one, other), (0, 2 * TERMS))[:TERMS]
    pairs = [
        [sum(times(one[i, k], other[k, j]) for k in range(2)) for j in range(2)] for i in range(2)
    ]
    return np.array(pairs)


def scaled(factor: np.ndarray, tensor: np.ndarray) -> np.ndarray:
    return np.array([[times(factor, part) for part in row] for row in tensor])


def turned(tensor: np.ndarray) -> np.ndarray:
    return tensor.transpose(1, 0, 2)


def trace(tensor: np.ndarray) -> np.ndarray:
    return tensor[0, 0] + tensor[1, 1]


def isotropic(scalar: np.ndarray) -> np.ndarray:
    return np.eye(2)[:, :, None] * scalar


def along_y(polynomial: np.ndarray, decay: float) -> np.ndarray:
    """Derivative by y, over e^(decay y)."""
    return np.pad(polyder(polynomial), (0, 1)) + decay * polynomial


def gradient(ux: np.ndarray, uy: np.ndarray, k: float, decay: float) -> np.ndarray:
    """Gradient of a displacement e^(ikx) e^(decay y) times polynomials, y outward."""
    return np.array([[1j * k * u, along_y(u, decay)] for u in (ux, uy)])


def wave(k: float, nu: float) -> np.ndarray:
    """Gradient of the linear displacement under the pressure e^(ikx), G = 1 (Johnson, ch. 2)."""
    ux, uy = np.zeros((2, TERMS), dtype=complex)
    ux[:2] = np.array([2.0 * nu - 1.0, -abs(k)]) / (2j * k)
    uy[:2] = (nu - 1.0) / abs(k), 0.5
    return gradient(ux, uy, k, abs(k))


def linear_stress(strain: np.ndarray, lame: float) -> np.ndarray:
    return isotropic(lame * trace(strain)) + strain + turned(strain)


def quadratic_stress(
    a: np.ndarray, b: np.ndarray, lame: float, third: tuple[float, float]
) -> np.ndarray:
    """Cauchy's stress of second order in gradients at current points, F = 1 + g + g g: of
    F S F' / J with Green's strain, bilinear in two waves."""
    ell, m = third
    strain, other = 0.5 * (a + turned(a)), 0.5 * (b + turned(b))
    ab = times(a, b)
    green = 0.5 * (ab + turned(ab) + times(turned(a), b))
    first = times(trace(strain), trace(other))
    second = 0.5 * (first - trace(times(strain, other)))
    stress = linear_stress(b, lame)
    law = isotropic(ell * first - 2.0 * m * second) + 2.0 * m * scaled(trace(strain), other)
    moved = times(a, stress) + times(stress, turned(a)) - scaled(trace(a), stress)
    return isotropic(lame * trace(green)) + 2.0 * green + law + moved


def risen(k1: float, k2: float, nu: float, third: tuple[float, float]) -> complex:
    """u2_y at the surface of e^(i(k1 + k2)x) under both waves: a particular solution, and the
    linear one that frees the surface of its tractions."""
    lame, k, decay = 2.0 * nu / (1.0 - 2.0 * nu), k1 + k2, abs(k1) + abs(k2)
    one, other = wave(k1, nu), wave(k2, nu)
    stress = sum(quadratic_stress(*pair, lame, third) for pair in ((one, other), (other, one)))

    def unbalanced(stress: np.ndarray) -> np.ndarray:
        return np.concatenate([1j * k * part[0] + along_y(part[1], decay) for part in stress])

    def stress_of(part: np.ndarray) -> np.ndarray:
        return linear_stress(gradient(*part.reshape(2, TERMS), k, decay), lame)

    basis = [part for part in np.eye(2 * TERMS, dtype=complex) if not part[[6, 7, 14, 15]].any()]
    columns = np.array([unbalanced(stress_of(part)) for part in basis]).T
    solved, *_ = np.linalg.lstsq(columns, -unbalanced(stress), rcond=1e-12)
    assert np.abs(columns @ solved + unbalanced(stress)).max() < 1e-9
    part = solved @ basis
    sheared, pressed = (stress + stress_of(part))[:, 1, 0]
    # a surface freed of the traction -sheared and the pressure pressed
    back = -(1.0 - nu) / abs(k) * pressed - 0.5j * (1.0 - 2.0 * nu) / k * sheared
    return part[TERMS] + back


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.name)
@pytest.mark.parametrize("nu", [0.0, 0.3, 0.45])
def test_symbols_against_the_equations_of_elasticity(law, nu):
    """Waves of one sign and of both, of any lengths."""
    steel = Material(200e9, nu, law)
    shear = steel.shear_modulus
    third = tuple(constant / shear for constant in third_order(law, steel)[:2])
    same, mixed = (symbol * shear**2 for symbol in SecondOrderSurface(steel, 1.0).symbols)
    for k1, k2, expected in ((2.0, 1.0, -same / 3.0), (-5.0, -1.0, -same / 6.0)):
        assert risen(k1, k2, nu, third) == pytest.approx(expected, rel=1e-9)
    for k1, k2 in ((3.0, -1.0), (1.0, -1.5), (-7.0, 2.0)):
        expected = -mixed / max(abs(k1), abs(k2))
        assert risen(k1, k2, nu, third) == pytest.approx(expected, rel=1e-9)


def test_a_band_of_waves_rises_as_its_symbols_say():
    """Two waves under a wide envelope: A at the sum of their wavenumbers, B at the difference."""
    steel, count = Material(200e9, 0.3), 4096
    x = np.linspace(-1.0, 1.0, count)
    envelope, pitch = np.exp(-20.0 * x**2), x[1] - x[0]
    waves = {k: envelope * np.exp(1j * k * x) for k in (200.0, 300.0)}
    pressure = 1e9 * sum(waves.values()).real
    surface = SecondOrderSurface(steel, pitch)
    same, mixed = surface.symbols
    rise = surface.rise(pressure, np.zeros(count))
    for k, expected in ((500.0, -0.5 * same / 500.0), (100.0, -0.5 * mixed / 300.0)):
        shape = envelope**2 * np.cos(k * x)
        amplitude = rise @ shape / (shape @ shape)
        assert amplitude == pytest.approx(1e18 * expected, rel=0.02)


def changed_peak(law: Law, nu: float, curvature: float) -> float:
    """Relative change of a smooth contact's peak under a rigid roller, a circle, over p0/E."""
    steel = Material(200e9, nu, law)
    modulus = steel.plane_strain_modulus
    hertz = hertz_from_peak_pressure(0.5 * curvature * modulus, 1.0, modulus)
    grid = HatGrid.within(-1.5 * curvature, 1.5 * curvature, 0.01 * curvature)
    operator = HalfPlane(grid.count, grid.pitch, modulus)

    constraints = Constraints(load=hertz.load_per_length)

    def solve(gap, start=None):
        return solve_contact(operator, gap, grid.weights, constraints, start)

    sagitta = roller_gap(1.0, None, "circle")
    linear = solve(grid.hat_integrals(roller_gap(1.0)))
    contact = DeformedContact(grid, steel, None, np.zeros_like, sagitta, None)
    peak = contact.pressed(solve, linear).pressure.max()
    return (peak / linear.pressure.max() - 1.0) / (hertz.peak_pressure / 200e9)


def test_laws_change_a_smooth_contact_as_finite_elements_at_finite_strain_say():
    """Neo-Hookean 0.131 p0/E at a/R = 0.05, known to 0.007, 0.136 at a/R = 0.1, to 0.004; other
    laws by `peak_change`, which is fitted to finite elements within 4 %."""
    plain = changed_peak(Law(), 0.3, 1e-3)
    assert changed_peak(Law(), 0.3, 0.05) == pytest.approx(0.1312, abs=0.007)
    assert changed_peak(Law(), 0.3, 0.1) == pytest.approx(0.1357, abs=0.004)
    for law in LAWS[1:]:
        expected = peak_change(law, Material(200e9, 0.3, law))
        assert changed_peak(law, 0.3, 1e-3) - plain == pytest.approx(expected, rel=0.04)
