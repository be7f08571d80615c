"""The cap on the half-plane's pressure that finite elements ask for."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scenes import STEEL, problem

from analytic.contact.patches import contact_patches
from analytic.operators.half_plane import HalfPlane
from comparisons.figures.figure import Figures
from comparisons.models.problem import pressed_on
from comparisons.studies.subsurface.pressure_cap import (
    BY_LENGTH,
    BY_PEAK,
    cap_sentence,
    figures_of_caps,
)

YIELD = 0.5e9
WAVY = {
    "roller": {"radius": 10e-3, **STEEL},
    "body": {**STEEL, "yield_stress": YIELD},
    "profile": {"kind": "sinusoid", "wavelength": 50e-6, "amplitude": 0.2e-6},
    "load": {"hertz_peak_pressure": 1e9},
}


def flowing_as(caps, longer=None):
    """A whole model that is the half-plane under a cap [Pa] on each level; of increments from long
    to short on the first one `longer` are the caps before its own."""
    asked = problem(WAVY)
    grids = [asked.grid(pitch) for pitch in asked.pitches[: len(caps)]]

    def quantities(grid, cap):
        operator = HalfPlane(grid.count, grid.pitch, asked.modulus)
        limit = replace(asked.constraints(), hardness=cap)
        solution = pressed_on(asked, grid, operator, limit)
        patches = contact_patches(grid.x, solution.pressure, solution.gap)
        length = np.array([np.ptp(patches, axis=1).sum()])
        figures = {"peak_pressure": solution.pressure, "contact_length": length}
        return SimpleNamespace(figures=figures)

    levels = SimpleNamespace(levels=[SimpleNamespace(grid=grid) for grid in grids])
    whole = SimpleNamespace(
        friction=0.0,
        runs={"finite_element": levels},
        contains_all=False,
        wholes=[quantities(grid, cap) for grid, cap in zip(grids, caps, strict=True)],
        longer=[quantities(grids[0], cap) for cap in (*(longer or caps[:1] * 2), caps[0])],
    )
    return Figures(figures_of_caps(asked, whole))


def test_of_a_half_plane_under_a_cap_the_caps_are_that_cap():
    known = flowing_as([1.5e9, 1.5e9])
    for name in (BY_LENGTH, BY_PEAK):
        cap, over, peak, length, mean = known.of(source=name)
        assert cap.value == pytest.approx(1.5e9, rel=5e-4)
        assert over.value == pytest.approx(3.0, rel=5e-4)
        assert max(abs(f.value) for f in (peak, length, mean)) < 5e-4
        assert cap.numerical < 1e-3
    assert "body.hardness = 1.50 GPa, 3.0 Y" in cap_sentence(known, 0.0)


def test_a_cap_is_as_uncertain_as_levels_and_increments_say():
    """Three times what the last level changes, three times what increments change, each in full."""
    known = flowing_as([1.45e9, 1.5e9], longer=[1.3e9, 1.4e9])
    cap = known.one(quantity="cap", source=BY_PEAK)
    parts = cap.uncertainty.parts
    assert parts["discretisation"] == pytest.approx(3.0 * 0.05 / 1.5, rel=1e-6)
    assert parts["increments"] == pytest.approx(3.0 * 0.05 / 1.5, rel=1e-6)


def test_where_flow_adds_nothing_to_the_contact_there_is_no_cap_by_length():
    known = flowing_as([np.inf, np.inf])
    assert known.of(source=BY_LENGTH) == () and known.of(source=BY_PEAK) != ()
    assert cap_sentence(known, 0.0) == ""
