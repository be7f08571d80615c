"""The finite elements' stiff and extreme cases: they hold, and fail when something is broken."""

import numpy as np
import pytest

from comparisons.campaigns.robustness import finite_element
from comparisons.campaigns.robustness.measures import THRESHOLD
from fem.body import elasticity
from fem.solver.mumps import SymmetricFactor


@pytest.fixture
def empty_caches():
    """Levels in the cache belong to the code before it was broken."""
    finite_element.ordinary_level.cache_clear()
    yield
    finite_element.ordinary_level.cache_clear()


@pytest.mark.parametrize(
    "name",
    [
        "ordinary",
        "grading of 1e7",
        "coating 1e+06 times as stiff",
        "even compression, ordinary",
        "even compression, rms slope 1",
        "roller 1e-06 times as stiff",
        "Poisson's ratio 0.4999, cubic",
        "friction 1, nu = 0",
        "hardness 0.99 of the peak",
        "lengths in 1e-09 m, stresses in 1 Pa",
        "a/t = 10, bonded",
        "a load that closes all gaps",
        "rms slope 1, rough boundary",
    ],
)
def test_a_case_holds(name, row_of):
    assert row_of("finite_element", name).faults == []


def test_a_broken_assembly_fails_the_rows(monkeypatch, empty_caches, row_of):
    original = elasticity.relative_constants

    def stiffer(*constants: object) -> tuple[np.ndarray, np.ndarray]:
        shear, lame = original(*constants)
        return shear, 1.01 * lame

    monkeypatch.setattr(elasticity, "relative_constants", stiffer)
    even = row_of("finite_element", "even compression, ordinary")
    assert not even.holds and even.decisive.quantity == "resultant"
    layer = row_of("finite_element", "a/t = 100, bonded")
    assert layer.error is None and not layer.holds
    # equations solved exactly are no proof that they are the right ones
    assert row_of("finite_element", "ordinary").holds


def test_a_stiffness_with_too_few_points_fails_the_row(monkeypatch, row_of):
    monkeypatch.setattr(elasticity, "quadrature_degree", lambda degree, curved: 1)
    assert not row_of("finite_element", "ordinary").holds


def test_a_factor_in_32_bits_fails_the_row(monkeypatch, row_of):
    original = SymmetricFactor.solve

    def rounded(self, load: np.ndarray) -> np.ndarray:
        return original(self, load).astype(np.float32).astype(float)

    monkeypatch.setattr(SymmetricFactor, "solve", rounded)
    row = row_of("finite_element", "ordinary")
    assert not row.holds and row.decisive.value > 1e3 * THRESHOLD


def test_a_mesh_that_depends_on_the_unit_fails_the_row(monkeypatch, empty_caches, row_of):
    original = finite_element.in_units

    def coarser(metre: float, pascal: float) -> dict:
        return {**original(metre, pascal), "resolution": {"pitch": 1.5e-5 * metre}}

    monkeypatch.setattr(finite_element, "in_units", coarser)
    assert not row_of("finite_element", "lengths in 1000 m, stresses in 1 Pa").holds
