"""Conventions of third-order constants against the energies they stand for; ellipticity against the
acoustic tensor of every direction."""

import numpy as np
import pytest
from strain_limits import strain_limit

from analytic.material import LAWS, Law, Material
from analytic.material.third_order import (
    CONSTANTS,
    murnaghan_constants,
    murnaghan_errors,
    peak_change,
    third_order,
)

STEEL = Material(211e9, 0.2875)
LAME, SHEAR = STEEL.lame_constants
L, M, N = -300e9, -620e9, -720e9
# by 3 x 3 strains
STRAINS = np.random.default_rng(1).uniform(-1e-3, 1e-3, (20, 3, 3))
STRAINS = STRAINS + np.swapaxes(STRAINS, -1, -2)
UNIT = np.eye(3)


def traces(strain):
    return [np.trace(np.linalg.matrix_power(strain, k), axis1=-2, axis2=-1) for k in (1, 2, 3)]


def landau(strain, a, b, c):
    first, second, third = traces(strain)
    return a / 3 * third + b * first * second + c / 3 * first**3


def murnaghan(strain, ell, m, n):
    i1, second, _ = traces(strain)
    i2, i3 = 0.5 * (i1**2 - second), np.linalg.det(strain)
    return (ell + 2 * m) / 3 * i1**3 - 2 * m * i1 * i2 + n * i3


def brugger(strain, c111, c112, c123, c144, c155, c456):
    """1/6 C_IJK e_I e_J e_K of an isotropic solid, in Voigt's order, shears twice the strain."""
    e = [strain[..., i, i] for i in range(3)]
    g = [2 * strain[..., i, j] for i, j in ((1, 2), (0, 2), (0, 1))]
    energy = c111 / 6 * sum(x**3 for x in e) + c123 * e[0] * e[1] * e[2]
    energy += c112 / 2 * sum(e[i] ** 2 * e[j] for i in range(3) for j in range(3) if i != j)
    energy += c144 / 2 * sum(e[i] * g[i] ** 2 for i in range(3)) + c456 * g[0] * g[1] * g[2]
    mixed = sum(e[i] * g[j] ** 2 for i in range(3) for j in range(3) if i != j)
    return energy + c155 / 2 * mixed


def values(*names):
    return {name: float(np.dot(CONSTANTS[name], (L, M, N))) for name in names}


def test_conventions_stand_for_the_same_energy():
    expected = murnaghan(STRAINS, L, M, N)
    assert landau(STRAINS, *values("A", "B", "C").values()) == pytest.approx(expected, rel=1e-9)
    names = ("c111", "c112", "c123", "c144", "c155", "c456")
    assert brugger(STRAINS, *values(*names).values()) == pytest.approx(expected, rel=1e-9)
    toupin = {"c123": "nu1", "c144": "nu2", "c456": "nu3"}
    for name, other in toupin.items():
        assert CONSTANTS[name] == CONSTANTS[other]


@pytest.mark.parametrize(
    "names", ["l m n", "A B C", "nu1 nu2 nu3", "c111 c112 c123", "c111 c144 c456", "c112 c155 nu3"]
)
def test_three_constants_give_back_murnaghans(names):
    constants = murnaghan_constants(values(*names.split()), STEEL)
    assert constants == pytest.approx((L, M, N), rel=1e-12)


def test_pressure_derivatives_are_those_of_the_energy():
    """Moduli about a hydrostatic compression, by differences of Cauchy stress."""

    def cauchy(f):
        strain = 0.5 * (f.T @ f - UNIT)
        step, piola = 1e-7, np.zeros((3, 3))
        for i in range(3):
            for j in range(3):
                shift = np.zeros((3, 3))
                shift[i, j] += 0.5 * step
                shift[j, i] += 0.5 * step
                piola[i, j] = (energy(strain + shift) - energy(strain - shift)) / (2 * step)
        return f @ piola @ f.T / np.linalg.det(f)

    def energy(strain):
        first, second, _ = traces(strain)
        return LAME / 2 * first**2 + SHEAR * second + murnaghan(strain, L, M, N)

    def moduli(stretch):
        pressure = [-np.trace(cauchy(UNIT * (stretch + d))) / 3 for d in (-1e-4, 0.0, 1e-4)]
        bulk = -(pressure[2] - pressure[0]) / 2e-4 * stretch / 3
        sheared = UNIT * stretch
        sheared[0, 1] = 1e-4 * stretch
        return pressure[1], bulk, cauchy(sheared)[0, 1] / 1e-4

    low, high = moduli(1.0 + 1e-3), moduli(1.0 - 1e-3)
    slopes = [(b - a) / (high[0] - low[0]) for a, b in zip(low[1:], high[1:], strict=True)]
    # the shear stress of a simple shear under pressure has the modulus G itself
    derivatives = {"bulk_by_pressure": slopes[0], "shear_by_pressure": slopes[1], "n": N}
    assert murnaghan_constants(derivatives, STEEL) == pytest.approx((L, M, N), rel=5e-3)


@pytest.mark.parametrize(
    ("constants", "message"),
    [
        ({"l": 1.0, "m": 1.0}, "do not determine"),
        ({"m": 1.0, "c155": 1.0, "n": 1.0}, "do not determine"),
        ({"l": 1.0, "m": 1.0, "D": 1.0}, "no third-order constant 'D'"),
    ],
)
def test_what_gives_no_constants_is_refused(constants, message):
    with pytest.raises(ValueError, match=message):
        murnaghan_constants(constants, STEEL)


def test_errors_are_those_of_many_samples():
    constants, errors = values("nu1", "nu2", "nu3"), {"nu1": 70e9, "nu2": 30e9, "nu3": 8e9}
    random = np.random.default_rng(2)
    samples = [
        murnaghan_constants(
            {k: v + errors[k] * random.normal() for k, v in constants.items()}, STEEL
        )
        for _ in range(4000)
    ]
    scatter = np.std(samples, axis=0)
    assert murnaghan_errors(constants, errors, STEEL) == pytest.approx(scatter, rel=0.05)


@pytest.mark.parametrize("name", ["neo-hookean", "hencky"])
def test_laws_expand_to_third_order(name):
    """Energies less those of St. Venant-Kirchhoff, by principal strains in the plane."""
    strain = np.array([2e-3, -3e-3])
    log = 0.5 * np.log1p(2 * strain)
    first, second = strain.sum(), (strain**2).sum()
    if name == "hencky":
        full = SHEAR * (log**2).sum() + LAME / 2 * log.sum() ** 2
    else:
        full = SHEAR * strain.sum() - SHEAR * log.sum() + LAME / 2 * log.sum() ** 2
    third = full - LAME / 2 * first**2 - SHEAR * second
    expected = murnaghan(np.diag([*strain, 0.0]), *third_order(Law(name), STEEL))
    assert third == pytest.approx(expected, rel=0.02)  # the fourth order is of that size


def test_the_change_of_the_peak_is_from_the_neo_hookean_law():
    assert peak_change(Law(), STEEL) == 0.0
    same = Law("murnaghan", third_order(Law(), STEEL))
    assert peak_change(same, STEEL) == 0.0
    with_n, without = (peak_change(Law("murnaghan", (L, M, n)), STEEL) for n in (N, 0.0))
    assert with_n == without


def acoustic_tensors(law, material, f, directions=360):
    """(directions, 2, 2) by differences of the energy of the plane deformation gradient `f`."""
    lame, shear = material.lame_constants

    def energy(f):
        green = 0.5 * (f.T @ f - np.eye(2))
        volume = np.linalg.det(f)
        if law.name == "neo-hookean":
            log = np.log(volume)
            return shear / 2 * (np.trace(f.T @ f) - 2) - shear * log + lame / 2 * log**2
        if law.name == "hencky":
            log = 0.5 * np.log(np.linalg.eigvalsh(f.T @ f))
            return shear * (log**2).sum() + lame / 2 * log.sum() ** 2
        i1, i2 = np.trace(green), np.linalg.det(green)
        ell, m, _ = third_order(law, material)
        quadratic = (lame / 2 + shear) * i1**2 - 2 * shear * i2
        return quadratic + (ell + 2 * m) / 3 * i1**3 - 2 * m * i1 * i2

    step, tangent = 1e-4, np.zeros((2, 2, 2, 2))
    for i, j, k, o in np.ndindex(2, 2, 2, 2):
        for s, t in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
            moved = f.copy()
            moved[i, j] += s * step
            moved[k, o] += t * step
            tangent[i, j, k, o] += s * t * energy(moved) / (4 * step**2)
    angles = np.linspace(0.0, np.pi, directions, endpoint=False)
    normal = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    return np.einsum("ijkl,aj,al->aik", tangent, normal, normal)


@pytest.mark.parametrize(
    ("law", "material"),
    [
        (Law("murnaghan", (-474e9, -636e9, -708e9)), STEEL),
        (Law("murnaghan", (-10.9e9, -7.7e9, -1.4e9)), Material(4.92e9, 0.34)),
        (Law("murnaghan", (136e9, 48e9, -178e9)), Material(73e9, 0.17)),
        (Law("st-venant-kirchhoff"), STEEL),
        (Law("hencky"), Material(1e9, 0.4)),
    ],
)
def test_ellipticity_is_lost_where_an_acoustic_tensor_is_no_longer_positive(law, material):
    limit = strain_limit(law, material)

    def least(first, second):
        f = np.diag([float(first), float(second)])
        return np.linalg.eigvalsh(acoustic_tensors(law, material, f)).min() / material.shear_modulus

    for strain, stretches in (
        (limit.compression, lambda e: (1 - e, 1.0)),
        (limit.shear, lambda g: (1 + g / 2, 1 - g / 2)),
    ):
        if np.isinf(strain):
            assert least(*stretches(0.9)) > 0.0
            continue
        assert least(*stretches(0.98 * strain)) > 0.0 > least(*stretches(1.02 * strain))


def test_a_neo_hookean_solid_is_stable_at_any_compression_and_shear():
    limit = strain_limit(Law(), STEEL)
    assert limit.compression == limit.shear == np.inf
    assert set(LAWS) == {"neo-hookean", "hencky", "st-venant-kirchhoff", "murnaghan"}


def test_standard_errors_need_constants():
    with pytest.raises(ValueError, match="standard errors"):
        Law(standard_errors=(1.0, 1.0, 1.0))
