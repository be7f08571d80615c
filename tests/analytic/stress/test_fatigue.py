"""Smith, Watson and Topper's parameter on states whose plane is known."""

import numpy as np
import pytest

from analytic.material import Material
from analytic.stress.fatigue import ruiz, smith_watson_topper
from analytic.stress_state import StressState

STEEL = Material(210e9, 0.3)
SIZE = 100e6


def state(sx: float, sz: float, txz: float) -> StressState:
    return StressState(*(np.array([value]) for value in (sx, sz, txz)))


@pytest.mark.parametrize(
    ("amplitude", "compliance"),
    [((SIZE, 0.0, 0.0), 1.0 - 0.3**2), ((0.0, 0.0, SIZE), 1.0 + 0.3)],
    ids=["uniaxial", "shear, at 45 degrees"],
)
def test_a_reversed_cycle(amplitude, compliance):
    one, other = state(*amplitude), state(*(-value for value in amplitude))
    [damage] = smith_watson_topper(one, other, STEEL)
    assert damage == pytest.approx(SIZE**2 * compliance / 210e9, rel=1e-12)


def test_a_turned_state_has_the_same():
    turn = 0.3
    c, s = np.cos(turn), np.sin(turn)
    one, other = state(SIZE, 0.0, 0.0), state(-SIZE, 0.0, 0.0)
    turned = [state(a * c**2, a * s**2, a * s * c) for a in (SIZE, -SIZE)]
    [straight], [aslant] = (smith_watson_topper(*pair, STEEL) for pair in ((one, other), turned))
    assert aslant == pytest.approx(straight, rel=2e-4)  # planes a degree apart


def test_compression_opens_no_crack():
    one, other = state(-SIZE, -SIZE, 0.0), state(-2.0 * SIZE, -SIZE, 0.0)
    assert smith_watson_topper(one, other, STEEL) == 0.0
    assert ruiz(np.array([-SIZE]), np.array([SIZE]), np.array([1e-6])) == 0.0
