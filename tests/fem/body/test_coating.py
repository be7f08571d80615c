"""Meshes with a line that element edges follow, by what they do to the surface's displacement."""

from dataclasses import replace

import numpy as np
import pytest

from analytic.material import Material
from fem.body.elasticity import Coating, Support, elastic_body
from fem.compliance.operator import FiniteElementCompliance
from meshes.block import BlockSpec
from meshes.build import build_block

BODY = Material(0.91, 0.3)
PITCH = 0.05
BLOCK = BlockSpec(50.0, 100.0, np.array([[-1.5, 1.5]]), PITCH)
HATS = PITCH * np.arange(-26, 27)


def surface(spec, modulus=None):
    """Weighted displacement under a smooth pressure; the coating's modulus over the body's."""
    coat = None if modulus is None else Material(modulus * 0.91, 0.3)
    coating = None if coat is None else Coating(coat, spec.interface)
    body = elastic_body(build_block(spec), BODY, Support("bonded", "fixed"), coating=coating)
    pressure = np.maximum(0.0, 1.0 - HATS[1:-1] ** 2) ** 2
    return FiniteElementCompliance(body, HATS).apply(pressure)


@pytest.fixture(scope="module")
def plain():
    """Of the body without a line."""
    return surface(BLOCK)


@pytest.mark.parametrize("thickness", [1.0, 0.1])
def test_a_line_in_a_body_of_one_material_changes_nothing(plain, thickness):
    lined = surface(replace(BLOCK, interface=thickness))
    assert lined == pytest.approx(plain, abs=4e-4 * np.ptp(plain))


@pytest.mark.parametrize("modulus", [0.1, 10.0])
def test_three_elements_across_a_coating_are_enough(plain, modulus):
    spec = replace(BLOCK, interface=0.15)
    found = surface(spec, modulus)
    finer = surface(replace(spec, window=(-2.0, 2.0, 0.4, 0.02)), modulus)
    assert found == pytest.approx(finer, abs=1e-4 * np.ptp(finer))
    assert np.ptp(found) != pytest.approx(np.ptp(plain), rel=0.1)
