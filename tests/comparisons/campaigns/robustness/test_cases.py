"""The half-plane's stiff and extreme cases: they hold, and fail when what they test is broken.

Requirement: every row can fail. Kernels and solvers are each broken slightly, and the rows that
are meant for them must see it.
"""

from functools import partial

import numpy as np

from analytic.contact import problem as contact
from analytic.layers import kernel
from analytic.operators import half_plane as operators
from analytic.operators.elements import hat_galerkin
from comparisons.campaigns.cases import carried_out
from comparisons.campaigns.robustness import all_cases, half_plane, measures
from comparisons.campaigns.robustness.measures import THRESHOLD

SLOW = ("1000000 p", "65536 points")


def test_quick_cases_hold():
    cases = [case for case in all_cases() if case.model == "half_plane"]
    rows = [carried_out(case) for case in cases if not case.name.startswith(SLOW)]
    assert rows and [fault for row in rows for fault in row.faults] == []


def test_a_broken_kernel_fails_the_rows(monkeypatch, row_of):
    def bent(offset: np.ndarray) -> np.ndarray:
        """The hat's coefficients, those of neighbours a thousandth off."""
        return hat_galerkin(offset) * np.where(np.abs(offset) == 1.0, 1.001, 1.0)

    monkeypatch.setattr(operators, "hat_galerkin", bent)
    cached = (half_plane.ordinary_shape, measures.ordinary_applications)
    for each in cached:
        each.cache_clear()
    try:
        broken = (
            row_of("half_plane", "ordinary: steel on steel"),
            row_of("half_plane", "plateau, heavy"),
        )
    finally:
        for each in cached:
            each.cache_clear()
    assert not any(row.holds for row in broken)
    assert broken[0].decisive.quantity == "gap against pressure"


def test_a_broken_solver_fails_the_rows(monkeypatch, row_of):
    def loose(matrix: np.ndarray, right: np.ndarray) -> np.ndarray:
        return np.linalg.solve(matrix, right).astype(np.float32).astype(float)

    monkeypatch.setattr("analytic.operators.convolution.cholesky_solve", loose)
    row = row_of("half_plane", "half-plane, 120 scattered nodes")
    assert not row.holds and row.decisive.value > 1e3 * THRESHOLD
    assert not row_of("half_plane", "plateau, heavy").holds


def test_a_solver_that_gives_up_early_fails_the_rows(monkeypatch, row_of):
    original = contact.exchange

    def hasty(problem, start, **settled):
        return np.maximum(original(problem, start, **settled), 1e-6)

    monkeypatch.setattr(contact, "exchange", hasty)
    assert not row_of("half_plane", "load 1e-12 of modulus times length").holds


def test_a_broken_layer_fails_the_rows(monkeypatch, row_of):
    original = kernel.normal
    monkeypatch.setattr(kernel, "normal", lambda layer, w: original(layer, w) * 1.05)
    assert not row_of("half_plane", "coating of the body's own material").holds


def test_a_length_that_is_not_in_proportion_fails_the_units(monkeypatch, row_of):
    monkeypatch.setattr(half_plane, "HalfPlane", partial(operators.HalfPlane, datum=10.0))
    assert not row_of("half_plane", "lengths in pm").holds


def test_friction_towards_the_wrong_side_fails_the_row(monkeypatch, row_of):
    original = half_plane.CoupledHalfPlane
    monkeypatch.setattr(
        half_plane, "CoupledHalfPlane", lambda *constants: original(*constants[:3], -constants[3])
    )
    assert not row_of("half_plane", "friction 1, rigid on nu = 0").holds
