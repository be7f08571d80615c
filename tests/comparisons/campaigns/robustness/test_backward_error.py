"""Backward errors and condition numbers of matrices whose own are known."""

import numpy as np
import pytest
from scipy.sparse import diags

from comparisons.campaigns.robustness.measures import backward_ratio, condition_estimate


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
