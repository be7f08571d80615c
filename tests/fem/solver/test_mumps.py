"""The symmetric factorisation: right answers, clear failures, more room where it is needed."""

import gc
import resource
from pathlib import Path

import numpy as np
import pytest
from scipy.sparse import diags, kronsum

from fem import compat
from fem.solver import mumps
from fem.solver.mumps import FemError, SymmetricFactor, factorisation_seconds, solve_once


def petsc(dense):
    PETSc = compat.petsc()
    matrix = PETSc.Mat().createDense(dense.shape, array=dense, comm=PETSc.COMM_SELF)
    return matrix.convert("aij")


@pytest.fixture
def positive():
    root = np.random.default_rng(4).normal(size=(30, 30))
    return root @ root.T + np.eye(30)


def test_solves_one_and_many_even_when_the_matrix_is_gone(positive):
    matrix = petsc(positive)
    factor = SymmetricFactor(matrix)
    matrix.destroy()
    gc.collect()
    load = np.random.default_rng(5).normal(size=(30, 3))
    np.testing.assert_allclose(positive @ factor.solve(load), load, atol=1e-10)
    np.testing.assert_allclose(positive @ factor.solve(load[:, 1]), load[:, 1], atol=1e-10)


def test_a_singular_matrix_is_refused_in_one_line(positive):
    positive[:, 7] = positive[7, :] = 0.0
    with pytest.raises(FemError, match=r"could not factor 30 unknowns: the matrix is singular"):
        SymmetricFactor(petsc(positive))


def test_too_little_room_is_answered_by_more(positive, monkeypatch):
    rooms, attempt = [], mumps._attempt

    def short_of_room(matrix, symmetric, spare):
        rooms.append(spare)
        solver, factor, info = attempt(matrix, symmetric, spare)
        return solver, factor, -9 if spare < 4 * mumps.SPARE_ROOM else info

    monkeypatch.setattr(mumps, "_attempt", short_of_room)
    factor = SymmetricFactor(petsc(positive))
    assert rooms == [mumps.SPARE_ROOM, 2 * mumps.SPARE_ROOM, 4 * mumps.SPARE_ROOM]
    np.testing.assert_allclose(positive @ factor.solve(np.ones(30)), 1.0, atol=1e-10)


def test_never_enough_room_ends_in_an_error(positive, monkeypatch):
    attempt, made = mumps._attempt, []

    def in_vain(*arguments):
        solver, factor, _ = attempt(*arguments)
        made.extend([solver, factor])
        return solver, factor, -9

    monkeypatch.setattr(mumps, "_attempt", in_vain)
    with pytest.raises(FemError, match=r"INFOG\(1\) = -9"):
        SymmetricFactor(petsc(positive))
    assert len(made) > 4
    assert not any(made)  # no attempt's factor stays


def test_what_petsc_holds_goes_with_its_owner(positive):
    matrix = petsc(positive)
    factor = SymmetricFactor(matrix)
    mumps.release_with(factor, matrix)
    held = [factor._factor, factor._right, factor._left, matrix]
    assert all(held)
    del factor
    gc.collect()
    assert not any(held)  # PETSc's objects are false once they are destroyed


@pytest.mark.skipif(
    not Path("/proc/self/statm").exists(), reason="memory is read from Linux's /proc"
)
@pytest.mark.parametrize("symmetric", [True, False])
def test_systems_that_are_solved_once_leave_nothing_behind(symmetric):
    """Each holds 4 to 7 MB while it is solved."""
    line = diags([-1.0, 2.1, -1.0], [-1, 0, 1], (100, 100))
    matrix = kronsum(line, line).tocsr()

    def resident() -> float:
        pages = int(Path("/proc/self/statm").read_text().split()[1])
        return pages * resource.getpagesize()

    for _ in range(2):
        solve_once(matrix, np.ones(matrix.shape[0]), symmetric)
    before = resident()
    for _ in range(10):
        solve_once(matrix, np.ones(matrix.shape[0]), symmetric)
    assert resident() - before < 10e6


@pytest.mark.parametrize("unknowns", [1_000, 100_000, 1_000_000])
def test_time_grows_a_little_faster_than_the_unknowns(unknowns):
    seconds = factorisation_seconds(unknowns)
    assert 2.0 * seconds < factorisation_seconds(2 * unknowns) < 2.0**1.5 * seconds
    assert 0.001 < seconds < 60.0
