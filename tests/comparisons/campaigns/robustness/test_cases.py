"""Stiff and extreme cases: they hold, and fail when what they test is broken.

Requirement: every row can fail. Kernels, solvers, assembly and meshes are each broken slightly, and
the rows that are meant for them must see it.
"""

import numpy as np
import pytest

from analytic.contact import problem as contact
from analytic.layers import kernel
from analytic.operators import half_plane as operators
from analytic.operators.elements import at_whole_offsets
from comparisons.campaigns.cases import Row, rows_of
from comparisons.campaigns.robustness import all_cases, finite_element, half_plane, measures
from fem.body import elasticity

SLOW = ("1000000 p", "65536 points")


def row_of(model: str, name: str) -> Row:
    named = (case for case in all_cases() if (case.model, case.name) == (model, name))
    [row] = rows_of([next(named)])
    return row


def test_quick_cases_hold():
    cases = [case for case in all_cases() if case.model == "half_plane"]
    rows = rows_of(case for case in cases if not case.name.startswith(SLOW))
    assert rows and [fault for row in rows for fault in row.faults] == []


def test_a_broken_kernel_fails_the_rows(monkeypatch):
    def bent(count: int) -> np.ndarray:
        """The hat's coefficients, those of neighbours a thousandth off."""
        return at_whole_offsets(count) * np.where(np.arange(count) == 1, 1.001, 1.0)

    monkeypatch.setattr(operators, "at_whole_offsets", bent)
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
    assert not row_of("half_plane", "plateau, heavy").holds


def test_a_solver_that_gives_up_early_fails_the_rows(monkeypatch):
    original = contact.exchange
    monkeypatch.setattr(
        contact, "exchange", lambda *given, **how: np.maximum(original(*given, **how), 1e-6)
    )
    assert not row_of("half_plane", "load 1e-12 of modulus times length").holds


def test_a_broken_layer_fails_the_rows(monkeypatch):
    original = kernel.normal
    monkeypatch.setattr(kernel, "normal", lambda layer, w: original(layer, w) * 1.05)
    assert not row_of("half_plane", "stiff coating 1e-12 a thin, 1e6 times as stiff").holds


def test_friction_towards_the_wrong_side_fails_the_row(monkeypatch):
    original = half_plane.coupled_half_planes
    monkeypatch.setattr(half_plane, "coupled_half_planes", lambda *c: original(*c[:3], -c[3]))
    assert not row_of("half_plane", "friction 1, rigid on nu = 0").holds


@pytest.fixture
def empty_caches():
    """Levels in the cache belong to the code before it was broken."""
    finite_element.ordinary_level.cache_clear()
    yield
    finite_element.ordinary_level.cache_clear()


@pytest.mark.parametrize(
    "name",
    [
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
    layer = row_of("finite_element", "a/t = 100, bonded")
    assert layer.error is None and not layer.holds


def test_a_stiffness_with_too_few_points_fails_the_row(monkeypatch, empty_caches):
    monkeypatch.setattr(elasticity, "quadrature_degree", lambda degree, curved: 1)
    assert not row_of("finite_element", "a/t = 1, frictionless").holds


def test_a_mesh_that_depends_on_the_unit_fails_the_row(monkeypatch, empty_caches):
    original = finite_element.in_units

    def coarser(metre: float, pascal: float) -> dict:
        return {**original(metre, pascal), "resolution": {"pitch": 1.5e-5 * metre}}

    monkeypatch.setattr(finite_element, "in_units", coarser)
    assert not row_of("finite_element", "lengths in 1000 m, stresses in 1 Pa").holds
