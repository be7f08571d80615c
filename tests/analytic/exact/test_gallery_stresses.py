"""Every stress field of the gallery: in balance, and met by the elements standing for its load."""

import numpy as np
import pytest

from analytic.exact.gallery import ExactStress, exact_stresses
from analytic.stress.points import stress_at

CASES = {case.name: case for case in exact_stresses()}
GAUSS, WEIGHT = np.polynomial.legendre.leggauss(200)
NAMES = ("sx", "sz", "txz")

every_case = pytest.mark.parametrize("case", CASES.values(), ids=CASES)
every_wide_case = pytest.mark.parametrize(
    "case", [case for case in CASES.values() if case.half_width], ids=lambda case: case.name
)


def test_gallery_covers_each_load():
    assert len(CASES) == len(exact_stresses())
    for kind in ("line", "strip", "triangle"):
        frictions = {case.friction for name, case in CASES.items() if kind in name}
        assert 0.0 in frictions and len(frictions) >= 2


@every_case
def test_stresses_carry_the_load_through_any_arc(case: ExactStress):
    """Tractions on half-circles about the load carry P down and friction P along."""
    angle = 0.5 * np.pi * (1.0 + GAUSS)
    cosine, sine = np.cos(angle), np.sin(angle)
    for radius in (1.5, 20.0, 1e5):
        radius *= case.half_width or 1e-3
        stress = case.stress(radius * cosine, radius * sine)
        measure = 0.5 * np.pi * radius * WEIGHT
        along = measure @ (stress.sx * cosine + stress.txz * sine)
        down = measure @ (stress.txz * cosine + stress.sz * sine)
        assert down == pytest.approx(-case.load, rel=1e-10)
        assert along == pytest.approx(-case.friction * case.load, rel=1e-10, abs=1e-10 * case.load)


@every_wide_case
def test_surface_carries_pressure_and_traction(case: ExactStress):
    x = case.half_width * np.array([-1.7, -0.99, -0.4, 0.0, 0.3, 0.99, 1.2])
    stress, pressure = case.stress(x, np.zeros_like(x)), case.pressure(x)
    scale = pressure.max()
    assert stress.sz == pytest.approx(-pressure, abs=1e-14 * scale)
    assert stress.txz == pytest.approx(-case.friction * pressure, abs=1e-14 * scale)


def errors(case: ExactStress, element: str, counts: np.ndarray) -> np.ndarray:
    """Largest over the load's largest pressure, half a half-width to two below it."""
    x, z = np.meshgrid(np.linspace(-2.0, 2.0, 33), [0.5, 1.0, 2.0])
    x, z = case.half_width * x, case.half_width * z
    exact, found = case.stress(x, z), []
    for count in counts:
        nodes = np.arange(-count, count + 1) * (case.half_width / count)
        pressure = case.pressure(nodes)
        field = stress_at(nodes, pressure, case.friction, x, z, element)
        error = max(np.abs(getattr(field, n) - getattr(exact, n)).max() for n in NAMES)
        found.append(error / pressure.max())
    return np.array(found)


@every_wide_case
def test_elements_that_stand_for_the_load_meet_it(case: ExactStress):
    """Hats hold a triangle exactly; a strip by hats, either by strips, to the pitch squared."""
    counts = np.array([10, 20, 40, 80])
    for element in ("hat", "strip"):
        found = errors(case, element, counts)
        if element == "hat" and "triangle" in case.name:
            assert found.max() < 1e-13
            continue
        order = -np.polyfit(np.log(counts), np.log(found), 1)[0]
        assert order == pytest.approx(2.0, abs=0.1)
        assert found[-1] < 2e-4


@every_case
def test_seen_from_afar_every_load_is_a_line(case: ExactStress):
    """What is left over the line load's own falls by the square of the distance."""
    line = next(c for c in CASES.values() if c.half_width == 0.0 and c.friction == 0.0)
    distance = (case.half_width or 1e-3) * 1e3
    angle = np.array([0.3, 1.2, 2.0, 2.9])
    x, z = distance * np.cos(angle), distance * np.sin(angle)
    found = case.stress(x, z)
    normal = line.stress(x, z)
    # under a traction sz is what txz is under the pressure
    expected = (normal.sz + case.friction * normal.txz) * case.load / line.load
    assert found.sz == pytest.approx(expected, rel=1e-5)
