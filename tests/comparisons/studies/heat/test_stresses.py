"""Thermal stresses of coated bodies by finite elements."""

from dataclasses import replace

import numpy as np
import pytest
from scenes import (
    BOTH_CONDUCT,
    GROUND,
    QUICK,
    STEEL,
    STEEL_HEAT,
    changed,
    finite_elements,
    half_plane_at,
    problem,
    run_of,
)

from comparisons.models.readings import ends_of_contact, left_out_at_ends, stresses_at
from comparisons.studies.heat.finite_elements import finite_element_stress, solved_heat

PLAIN = QUICK | {
    "load": {"hertz_peak_pressure": 1e9, "friction": 0.1},
    "heat": {"speed": 10.0, "stresses": True, "body_expansion": 12e-6, **BOTH_CONDUCT},
}
# Unlike bodies, fast: the heated layer is a hundredth of the contact.
HOT = {
    "roller": {"radius": 16e-3, "youngs_modulus": 205e9, "poissons_ratio": 0.3},
    "body": {"youngs_modulus": 160e9, "poissons_ratio": 0.27},
    "load": {"per_length": 3e5, "friction": 0.25},
    "heat": {"speed": 3.5, "slide_to_roll": 2.0, "stresses": True, "body_expansion": 11.5e-6}
    | {"body_conductivity": 24.0, "body_density": 7300.0, "body_specific_heat": 510.0}
    | {"roller_conductivity": 41.0, "roller_density": 7900.0, "roller_specific_heat": 470.0},
    "stress": {"depth": 1.5, "half_range": 2.5, "points": [300, 150]},
    "budget": {"effects": False},
}
OF_COAT = {f"coating_{name}": value for name, value in STEEL_HEAT.items()}
COATED = changed(PLAIN, heat={**OF_COAT, "coating_expansion": 12e-6}) | {
    "coating": {"thickness": "5 um", **STEEL}
}


def solved(tables):
    """What `finite_element_stress` takes, on the coarsest level."""
    posed = problem(tables)
    return posed, finite_elements(posed, fields=True)


def test_a_coating_counts_by_what_it_differs_in():
    """One of the body's own material changes nothing; one that expands twice as much adds what a
    layer that cannot expand along the surface bears, E alpha T / (1 - nu)."""
    plain = finite_element_stress(*solved(PLAIN))
    posed, level = solved(COATED)
    same = finite_element_stress(posed, level)
    for name, value in same.figures.items():
        if "depth" not in name:
            assert value == pytest.approx(plain.figures[name], abs=5e6)  # of 1 GPa
    assert np.all(same.sx[0][same.x > -1e-4] < 0.0)
    other = replace(posed, scene=posed.scene.unchecked({"heat.coating_expansion": 24e-6}))
    more = finite_element_stress(other, level)
    added = (more.sx[0] - more.sx[1]) - (same.sx[0] - same.sx[1])
    temperature = solved_heat(posed, level)[1](np.column_stack([same.x, np.zeros_like(same.x)]))
    held = -STEEL["youngs_modulus"] * 12e-6 * temperature / (1.0 - STEEL["poissons_ratio"])
    assert np.linalg.norm(added - held) < 0.08 * np.linalg.norm(held)


def test_a_hot_surface_by_the_half_plane():
    """tau1 by an independent integration; 2 mu p0 at the trailing edge (Johnson 1985, section 7.1);
    with heat the surface is compressed everywhere, though least so beyond the window."""
    run = run_of(HOT, "half_plane")
    known = run.figures.of(study="heat", source="half_plane", against=None)
    exact = {
        "tau1_heated": 753.231e6,
        "sx_heated_without_heat": 2.0 * 0.25 * run.problem.hertz.peak_pressure,
        "sx_heated": 0.0,
    }
    for name, value in exact.items():
        figure = known.one(quantity=name)
        stated = figure.numerical * figure.scale
        assert figure.value == pytest.approx(value, abs=stated) and stated < 2e-4 * 381.8e6


def test_the_cusp_at_an_end_of_rough_contact_is_that_of_much_finer_hats():
    """The largest of all patches; hats of 32 times the pitch miss a twelfth of it."""
    posed = problem(GROUND)
    pitch, values = posed.pitches[-1], []
    for number in (0, 5):
        level = half_plane_at(posed, pitch / 2**number)
        at = posed, level.grid, level.solution
        x = ends_of_contact(*at)
        by_hats = stresses_at(posed, level, (1.0,), x, np.zeros_like(x))[1.0].sx
        values.append((by_hats.max(), (by_hats + left_out_at_ends(*at, x).sum(axis=0)).max()))
    (coarse, limit), (fine, finest) = values
    assert coarse < 0.93 * fine
    assert limit == pytest.approx(fine, rel=5e-4) and finest == pytest.approx(fine, rel=1e-3)
