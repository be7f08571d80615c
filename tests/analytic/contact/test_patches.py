"""Contact patches from nodal pressures and gaps."""

import numpy as np
import pytest

from analytic.contact.patches import contact_patches


@pytest.mark.parametrize("edge", np.linspace(0.02, 0.98, 7))
def test_edges_of_one_patch_are_found_between_the_nodes(edge):
    x = np.arange(-30.0, 31.0)
    right, left = 10.0 + edge, -(8.0 + edge)
    inside = (x > left) & (x < right)
    pressure = np.where(inside, np.sqrt(np.clip((x - left) * (right - x), 0.0, None)), 0.0)
    points, weights = np.polynomial.legendre.leggauss(20)
    share = 0.5 * (points + 1.0)

    def averaged(distance):  # of a gap that opens like Hertz's beyond an edge
        sides = (np.maximum(distance + side * share, 0.0) ** 1.5 for side in (-1.0, 1.0))
        return sum(np.sum(0.5 * weights * (1.0 - share) * gap) for gap in sides)

    gap = np.array([averaged(max(d - right, left - d)) for d in x]) * ~inside
    patches = contact_patches(x, pressure, gap)
    assert patches.shape == (1, 2)
    assert patches[0] == pytest.approx([left, right], abs=0.05)


def test_patches_are_listed_in_order_and_close_ones_take_half_a_pitch():
    pressure = np.array([0, 0, 1, 2, 1, 0, 0, 3, 0, 0, 1, 1, 0, 0], dtype=float)
    x = 2.0 * np.arange(len(pressure))
    patches = contact_patches(x, pressure, np.zeros_like(x))
    assert patches.tolist() == [[3.0, 9.0], [13.0, 15.0], [19.0, 23.0]]


def test_contact_up_to_the_end_of_the_grid():
    x = np.arange(5.0)
    assert contact_patches(x, np.ones(5), np.zeros(5)).tolist() == [[-0.5, 4.5]]


def test_no_contact():
    assert contact_patches(np.arange(5.0), np.zeros(5), np.ones(5)).shape == (0, 2)
