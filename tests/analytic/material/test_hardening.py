"""Flow stresses: values, slopes, increments against bisection, and what is refused."""

import numpy as np
import pytest
from scipy.optimize import brentq

from analytic.material.hardening import Hardening

Y = 300e6
TABLE = ((0.0, Y), (0.01, Y), (0.05, 400e6), (0.2, 480e6))  # with a Lueders plateau: not concave
LAWS = {
    "perfect": Hardening(Y),
    "linear": Hardening(Y, 1e9),
    "voce": Hardening(Y, voce=(500e6, 12.0)),
    "ludwik": Hardening(Y, ludwik=(600e6, 0.2)),
    "table": Hardening(Y, table=TABLE),
}


@pytest.fixture(params=LAWS)
def law(request):
    return LAWS[request.param]


def test_values():
    strain = np.array([0.0, 0.03, 10.0])
    stresses = {name: law.stress(strain) / 1e6 for name, law in LAWS.items()}
    np.testing.assert_allclose(stresses["perfect"], [300, 300, 300], rtol=1e-14)
    np.testing.assert_allclose(stresses["linear"], [300, 330, 10300], rtol=1e-14)
    np.testing.assert_allclose(stresses["voce"], [300, 500 - 200 * np.exp(-0.36), 500], rtol=1e-14)
    ludwik = [300, 300 + 600 * 0.03**0.2, 300 + 600 * 10**0.2]
    np.testing.assert_allclose(stresses["ludwik"], ludwik, rtol=1e-14)
    np.testing.assert_allclose(stresses["table"], [300, 350, 480], rtol=1e-14)


def test_slope_is_the_derivative(law):
    strain, h = np.array([1e-3, 0.02, 0.1, 0.7]), 1e-6
    difference = (law.stress(strain + h) - law.stress(strain - h)) / (2.0 * h)
    np.testing.assert_allclose(law.slope(strain), difference, rtol=1e-5, atol=10.0)
    assert np.all(law.slope(np.zeros(1)) >= law.slope(strain[:1]))


@pytest.mark.parametrize("before", [0.0, 1e-9, 0.005, 0.3])
def test_increment_solves_its_equation(law, before):
    """From excesses of rounding's size to fifty yield stresses, against bisection."""
    stiffness, start = 240e9, float(law.stress(np.array(before)))
    trial = start + Y * np.array([1e-6, 1e-3, 0.1, 1.0, 50.0])
    strain = law.increment(trial, np.full(5, before), stiffness)

    def left(rise, q):
        return q - stiffness * rise - float(law.stress(np.array(before + rise)))

    exact = [brentq(left, 0.0, q / stiffness, args=(q,), xtol=1e-18, rtol=1e-14) for q in trial]
    np.testing.assert_allclose(strain, exact, rtol=1e-9, atol=1e-15)
    rest = trial - stiffness * strain - law.stress(before + strain)
    np.testing.assert_allclose(rest, 0.0, atol=1e-13 * trial.max())


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"yield_stress": 0.0}, "yield stress must be positive"),
        ({"yield_stress": np.inf}, "yield stress must be positive"),
        ({"modulus": -1.0}, "hardening modulus must not be negative"),
        ({"kinematic": -1.0}, "kinematic modulus must not be negative"),
        ({"modulus": 1e9, "voce": (400e6, 2.0)}, "one of modulus, voce, ludwik and table"),
        ({"voce": (200e6, 2.0)}, "saturated stress of at least"),
        ({"voce": (400e6, 0.0)}, "positive rate"),
        ({"ludwik": (1e9, 1.2)}, "exponent above 0"),
        ({"ludwik": (-1e9, 0.2)}, "strength that is not negative"),
        ({"table": ((0.01, Y), (0.1, 400e6))}, "begins at plastic strain 0"),
        ({"table": ((0.0, 250e6), (0.1, 400e6))}, "with the yield stress"),
        ({"table": ((0.0, Y), (0.1, 290e6))}, "must not soften"),
        ({"table": ((0.0, Y), (0.1, 400e6), (0.1, 410e6))}, "must rise"),
        ({"table": ((0.0, Y), (np.nan, 400e6))}, "pairs of plastic strain and stress"),
        ({"table": ()}, "pairs of plastic strain and stress"),
    ],
)
def test_wrong_laws_are_refused_in_one_line(settings, message):
    with pytest.raises(ValueError, match=message) as refusal:
        Hardening(**{"yield_stress": Y} | settings)
    assert "\n" not in str(refusal.value)
