"""Thermal stresses of coated bodies by finite elements."""

from dataclasses import replace

import numpy as np
import pytest
from scenes import BOTH_CONDUCT, STEEL, STEEL_HEAT, changed, finite_elements, problem

from comparisons.models.window import window_of
from comparisons.studies.heat.finite_elements import finite_element_stress, solved_heat

PLAIN = {
    "roller": {"radius": 7.5706e-3, **STEEL},
    "body": dict(STEEL),
    "load": {"hertz_peak_pressure": 1e9, "friction": 0.1},
    "heat": {"speed": 10.0, "stresses": True, "body_expansion": 12e-6, **BOTH_CONDUCT},
    "stress": {"points": [120, 40]},
}
OF_COAT = {f"coating_{name}": value for name, value in STEEL_HEAT.items()}
COATED = changed(PLAIN, heat={**OF_COAT, "coating_expansion": 12e-6}) | {
    "coating": {"thickness": "5 um", **STEEL}
}


def solved(tables):
    """What `finite_element_stress` takes, on the coarsest level."""
    posed = problem(tables)
    return posed, finite_elements(posed, fields=True), window_of(posed)


def test_a_coating_counts_by_what_it_differs_in():
    """One of the body's own material changes nothing; one that expands twice as much adds what a
    layer that cannot expand along the surface bears, E alpha T / (1 - nu)."""
    plain = finite_element_stress(*solved(PLAIN))
    posed, *rest = solved(COATED)
    same = finite_element_stress(posed, *rest)
    for one, other in ((same.figures, plain.figures), (same.elastic, plain.elastic)):
        for name in ("tau1_heated", "sx_heated"):
            assert one[name] == pytest.approx(other[name], abs=5e6)  # of 1 GPa
    other = replace(posed, scene=posed.scene.unchecked({"heat.coating_expansion": 24e-6}))
    more = finite_element_stress(other, *rest)
    added = (more.sx[0] - more.sx[1]) - (same.sx[0] - same.sx[1])
    temperature = solved_heat(posed, rest[0])[1](np.column_stack([same.x, np.zeros_like(same.x)]))
    held = -STEEL["youngs_modulus"] * 12e-6 * temperature / (1.0 - STEEL["poissons_ratio"])
    assert np.linalg.norm(added - held) < 0.08 * np.linalg.norm(held)
