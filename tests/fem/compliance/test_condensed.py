"""Columns of a compliance, shifted."""

import numpy as np

from fem.compliance.condensed import ShiftInvariant


def test_shifted_columns_are_those_of_any_compliance_that_does_not_depend_on_the_place():
    count, far = 40, np.arange(-39.0, 40.0)
    place = np.arange(count)
    exact = (np.exp(-(far**2) / 50.0) + 0.1 * np.arctan(far))[place[:, None] - place + count - 1]
    shifted = ShiftInvariant(lambda hats: exact[:, hats], count, place[10:30])
    pressure = np.random.default_rng(1).uniform(size=count)
    np.testing.assert_allclose(shifted @ pressure, exact @ pressure, rtol=1e-12)
    block = np.ix_(place[3:9], place[20:])
    np.testing.assert_allclose(shifted[block], exact[block], rtol=1e-12)
