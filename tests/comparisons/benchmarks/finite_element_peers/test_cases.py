"""The problems of the race of finite-element codes, and this project's solutions."""

from dataclasses import replace

import numpy as np
import pytest

from comparisons.benchmarks.finite_element_peers import cases

WAVES = np.array([[2e-7, 0.5, 0.3], [1e-7, 0.2, -1.0]])


def test_reference_is_hertz_contact_but_for_the_block(cylinder):
    """A block 40 a deep and wide presses back: 2.1e-4 more at the peak, as much less wide."""
    found, exact = cylinder.reference, cases.hertz()
    assert found.pressure.max() == pytest.approx(1.00021 * exact.peak_pressure, rel=5e-5)
    wide = replace(exact, half_width=exact.half_width / 1.00021)
    error = found.pressure - 1.00021 * wide.pressure(found.x)
    assert np.abs(error).max() < 0.04 * exact.peak_pressure  # next to the root at the edge
    assert np.abs(error[np.abs(found.x) < 0.9]).max() < 1e-3 * exact.peak_pressure
    load = found.pressure.sum() * (found.x[1] - found.x[0])  # equal hats
    assert load == pytest.approx(exact.load_per_length, rel=1e-9)


def test_errors_are_relative_to_the_reference(cylinder):
    right = cylinder.reference
    assert cylinder.errors(right) == {"peak": 0.0, "pressure": 0.0}
    more = cylinder.errors(replace(right, pressure=1.02 * right.pressure))
    assert more == pytest.approx({"peak": 0.02, "pressure": 0.02})
    aside = cylinder.errors(replace(right, x=right.x + 0.01))
    assert aside["peak"] == 0.0
    assert 0.01 < aside["pressure"] < 0.05


def test_pressure_is_zero_beside_the_nodes():
    answer = cases.BlockAnswer(np.array([0.0, 1.0]), np.array([2.0, 4.0]), 0, 0)
    assert list(answer.at(np.array([-0.1, 0.5, 1.1]))) == [0.0, 3.0, 0.0]


def test_gap_is_the_parabola_and_its_waves():
    x, parabola = 0.37, 0.37**2 / (2.0 * cases.RADIUS)
    waves = sum(a * (1.0 - np.cos(2.0 * np.pi * x / length + phi)) for a, length, phi in WAVES)
    assert cases.gap(np.array([x]), WAVES)[0] == pytest.approx(parabola + waves, rel=1e-14)
    assert cases.gap(np.array([x]), WAVES[:0])[0] == pytest.approx(parabola, rel=1e-14)


@pytest.mark.parametrize("code", cases.crosscheck(), ids=lambda code: code.configuration)
def test_ours_falls_with_the_mesh(cylinder, code):
    error = []
    for edges in (10, 20):
        answer = code.solve(cylinder.task(edges, 0.2))
        assert np.all(np.diff(answer.x) >= 0.0)
        error.append(cylinder.errors(answer)["pressure"])
    assert error[1] < (0.017 if code.configuration == "P2, a hat an edge" else 0.01)
    assert np.log2(error[0] / error[1]) == pytest.approx(1.0, abs=0.2)
