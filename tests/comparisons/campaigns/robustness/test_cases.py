"""Stiff and extreme cases: they hold, and fail when what they test is broken.

Requirement: every row can fail. Kernels, solvers, assembly and meshes are each broken slightly, and
the rows that are meant for them must see it.
"""

from functools import partial

import numpy as np
import pytest
from scipy.sparse import diags

from analytic.contact import problem as contact
from analytic.layers import kernel
from analytic.operators import half_plane as operators
from analytic.operators.elements import hat_galerkin
from comparisons.campaigns.cases import Row, carried_out
from comparisons.campaigns.robustness import all_cases, finite_element, half_plane, measures
from comparisons.campaigns.robustness.measures import (
    THRESHOLD,
    backward_ratio,
    condition_estimate,
)
from fem.body import elasticity
from fem.solver.mumps import SymmetricFactor

SLOW = ("1000000 p", "65536 points")


def row_of(model: str, name: str) -> Row:
    named = (case for case in all_cases() if (case.model, case.name) == (model, name))
    return carried_out(next(named))


def test_quick_cases_hold():
    cases = [case for case in all_cases() if case.model == "half_plane"]
    rows = [carried_out(case) for case in cases if not case.name.startswith(SLOW)]
    assert rows and [fault for row in rows for fault in row.faults] == []


def test_a_broken_kernel_fails_the_rows(monkeypatch):
    def bent(offset: np.ndarray) -> np.ndarray:
        """The hat's coefficients, those of neighbours a thousandth off."""
        return hat_galerkin(offset) * np.where(np.abs(offset) == 1.0, 1.001, 1.0)

    monkeypatch.setattr(operators, "hat_galerkin", bent)
    monkeypatch.setattr(half_plane, "ordinary_shape", half_plane.ordinary_shape.__wrapped__)
    applications = measures.ordinary_applications.__wrapped__
    monkeypatch.setattr(measures, "ordinary_applications", applications)
    ordinary = row_of("half_plane", "ordinary: steel on steel")
    assert not ordinary.holds and ordinary.decisive.quantity == "gap against pressure"
    assert not row_of("half_plane", "plateau, heavy").holds


def test_a_broken_solver_fails_the_rows(monkeypatch):
    def loose(matrix: np.ndarray, right: np.ndarray) -> np.ndarray:
        return np.linalg.solve(matrix, right).astype(np.float32).astype(float)

    monkeypatch.setattr("analytic.operators.convolution.cholesky_solve", loose)
    row = row_of("half_plane", "half-plane, 120 scattered nodes")
    assert not row.holds and row.decisive.value > 1e3 * THRESHOLD
    assert not row_of("half_plane", "plateau, heavy").holds


def test_a_solver_that_gives_up_early_fails_the_rows(monkeypatch):
    original = contact.exchange

    def hasty(problem, start, **settled):
        return np.maximum(original(problem, start, **settled), 1e-6)

    monkeypatch.setattr(contact, "exchange", hasty)
    assert not row_of("half_plane", "load 1e-12 of modulus times length").holds


def test_a_broken_layer_fails_the_rows(monkeypatch):
    original = kernel.normal
    monkeypatch.setattr(kernel, "normal", lambda layer, w: original(layer, w) * 1.05)
    assert not row_of("half_plane", "coating of the body's own material").holds


def test_a_length_that_is_not_in_proportion_fails_the_units(monkeypatch):
    monkeypatch.setattr(half_plane, "HalfPlane", partial(operators.HalfPlane, datum=10.0))
    assert not row_of("half_plane", "lengths in pm").holds


def test_friction_towards_the_wrong_side_fails_the_row(monkeypatch):
    original = half_plane.CoupledHalfPlane
    monkeypatch.setattr(
        half_plane, "CoupledHalfPlane", lambda *constants: original(*constants[:3], -constants[3])
    )
    assert not row_of("half_plane", "friction 1, rigid on nu = 0").holds


def test_backward_ratio_of_what_is_exact_and_of_what_is_not():
    matrix = np.array([[2.0, 1.0], [1.0, 3.0]])
    right = matrix @ [1.0, 1.0]
    assert backward_ratio(matrix, np.ones(2), right) == 0.0
    # a residual of 1e-10 in one row, over 4 * 2 * eps
    wrong = backward_ratio(matrix, np.ones(2), right + np.array([1e-10, 0.0]))
    assert wrong == pytest.approx(1e-10 / (4.0 * 2.0 * np.finfo(float).eps), rel=1e-5)


def test_condition_estimate_of_a_diagonal():
    values = np.array([1e-3, 1.0, 1e5])
    estimate = condition_estimate(diags(values).tocsr(), lambda right: np.ravel(right) / values)
    assert estimate == pytest.approx(1e8)


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
def test_a_case_holds(name):
    assert row_of("finite_element", name).faults == []


def test_a_broken_assembly_fails_the_rows(monkeypatch, empty_caches):
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


def test_a_stiffness_with_too_few_points_fails_the_row(monkeypatch):
    monkeypatch.setattr(elasticity, "quadrature_degree", lambda degree, curved: 1)
    assert not row_of("finite_element", "ordinary").holds


def test_a_factor_in_32_bits_fails_the_row(monkeypatch):
    original = SymmetricFactor.solve

    def rounded(self, load: np.ndarray) -> np.ndarray:
        return original(self, load).astype(np.float32).astype(float)

    monkeypatch.setattr(SymmetricFactor, "solve", rounded)
    row = row_of("finite_element", "ordinary")
    assert not row.holds and row.decisive.value > 1e3 * THRESHOLD


def test_a_mesh_that_depends_on_the_unit_fails_the_row(monkeypatch, empty_caches):
    original = finite_element.in_units

    def coarser(metre: float, pascal: float) -> dict:
        return {**original(metre, pascal), "resolution": {"pitch": 1.5e-5 * metre}}

    monkeypatch.setattr(finite_element, "in_units", coarser)
    assert not row_of("finite_element", "lengths in 1000 m, stresses in 1 Pa").holds
