"""The finite elements' stiff and extreme cases: they hold, and see what is broken by a little."""

import numpy as np
import pytest

from comparisons.studies.robustness.backward import THRESHOLD
from comparisons.studies.robustness.finite_element import algebra as finite_element_algebra
from comparisons.studies.robustness.finite_element import extremes as finite_element_extremes
from comparisons.studies.robustness.finite_element import layers as finite_element_layers
from comparisons.studies.robustness.finite_element import scene_ends as finite_element_cases
from comparisons.studies.robustness.row import Row, carried_out
from fem.body import elasticity
from fem.solver.mumps import SymmetricFactor


def row_of(module, name: str) -> Row:
    [case] = [case for case in module.cases() if case.name == name]
    return carried_out(case)


@pytest.fixture
def afresh():
    """Bodies and levels that are kept belong to the code before it was broken."""
    kept = (finite_element_extremes.plain_compliance, finite_element_cases.ordinary_level)
    for each in kept:
        each.cache_clear()
    yield
    for each in kept:
        each.cache_clear()


@pytest.mark.parametrize(
    ("module", "name"),
    [
        (finite_element_algebra, "ordinary"),
        (finite_element_algebra, "grading of 1e7"),
        (finite_element_algebra, "coating 1e+06 times as stiff"),
        (finite_element_algebra, "even compression, ordinary"),
        (finite_element_algebra, "even compression, rms slope 1"),
        (finite_element_cases, "roller 1e-06 times as stiff"),
        (finite_element_cases, "Poisson's ratio 0.4999, cubic"),
        (finite_element_cases, "friction 1, nu = 0"),
        (finite_element_cases, "hardness 0.99 of the peak"),
        (finite_element_cases, "lengths in 1e-09 m, stresses in 1 Pa"),
        (finite_element_layers, "a/t = 10, bonded"),
        (finite_element_extremes, "load 1e-100 of modulus times length"),
        (finite_element_extremes, "a load that closes all gaps"),
        (finite_element_extremes, "spike, pressed in"),
        (finite_element_extremes, "rms slope 1, real boundary"),
        (finite_element_extremes, "body and profile reversed, sliding, too"),
    ],
)
def test_a_case_holds(module, name):
    row = row_of(module, name)
    assert row.passed, row.error or row.telling


def test_a_broken_assembly_fails_the_rows(monkeypatch, afresh):
    original = elasticity.relative_constants

    def stiffer(*given: object) -> tuple[np.ndarray, np.ndarray]:
        shear, lame = original(*given)
        return shear, 1.01 * lame

    monkeypatch.setattr(elasticity, "relative_constants", stiffer)
    even = row_of(finite_element_algebra, "even compression, ordinary")
    assert not even.passed and even.telling.name == "resultant"
    layer = row_of(finite_element_layers, "a/t = 100, bonded")
    assert layer.error is None and not layer.passed
    # equations solved exactly are no proof that they are the right ones
    assert row_of(finite_element_algebra, "ordinary").passed


def test_a_stiffness_with_too_few_points_fails_the_row(monkeypatch):
    monkeypatch.setattr(elasticity, "quadrature_degree", lambda degree, curved: 1)
    ordinary = row_of(finite_element_algebra, "ordinary")
    assert not ordinary.passed


def test_a_factor_in_32_bits_fails_the_row(monkeypatch):
    original = SymmetricFactor.solve

    def rounded(self, load: np.ndarray) -> np.ndarray:
        return original(self, load).astype(np.float32).astype(float)

    monkeypatch.setattr(SymmetricFactor, "solve", rounded)
    row = row_of(finite_element_algebra, "ordinary")
    assert not row.passed and row.telling.value > 1e3 * THRESHOLD


def test_a_mesh_that_depends_on_the_unit_fails_the_row(monkeypatch, afresh):
    original = finite_element_cases.in_units

    def coarser(metre: float, pascal: float) -> dict:
        pitch = 1.5e-5 * metre
        return {**original(metre, pascal), "resolution": {"pitch": pitch}}

    monkeypatch.setattr(finite_element_cases, "in_units", coarser)
    row = row_of(finite_element_cases, "lengths in 1000 m, stresses in 1 Pa")
    assert not row.passed
