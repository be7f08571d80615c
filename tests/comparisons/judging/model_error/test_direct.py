"""The model error of the half-plane, put together of effects, against finite elements that have
them all.

Here they are switched on in the scene, from the first level to the last: nothing is added up.
"""

import numpy as np
import pytest
from scenes import (
    KNOWN_RUBBER,
    KNOWN_STEEL,
    changed,
    finite_elements,
    half_plane_at,
    problem,
    resolved,
    run_of,
)

from comparisons.figures.figure import Figure
from comparisons.judging.effects.catalogue import contained
from comparisons.judging.model_error.model_error import split_variants
from comparisons.judging.rule import values_of
from comparisons.models.problem import Levels

COATING = {"thickness": 20e-6, "youngs_modulus": 400e9, "poissons_ratio": 0.22}
RUBBER = {
    "roller": {"radius": 20e-3, "rigid": True}, "body": KNOWN_RUBBER, "load": {"per_length": 1e3},
}  # fmt: skip
WAVY = {
    "profile": {"kind": "sinusoid", "wavelength": 60e-6, "amplitude": 0.1e-6},
    "stress": {"depth": 0.5, "half_range": 1.2, "points": [40, 20]},
}
STRAINED = {"roller_shape": "circle", "deformation": "finite"}
DISC, COUPLED = {"roller_body": "disc"}, {"coupled": True}
QUANTITIES = ("peak_pressure", "contact_length")
STRESSES = ("tau1_max", "txz_max_abs")


def steel(radius: float, peak_pressure: float, friction: float = 0.0, **roller: object) -> dict:
    """A roller on steel, rigid unless its material is given."""
    load = {"hertz_peak_pressure": peak_pressure, "friction": friction}
    roller = {"radius": radius} | (roller or {"rigid": True})
    return {"roller": roller, "body": KNOWN_STEEL, "load": load}


# What both scenes have, and the switches that one of them has beside it.
SCENES = {
    "rubber": (RUBBER, STRAINED),
    "rubber, friction": (changed(RUBBER, load={"friction": 0.3}), STRAINED | COUPLED),
    "steel block, friction": (
        changed(steel(10e-3, 2e9, 0.2), body={"thickness": 2e-3, "width": 4e-3}),
        STRAINED | COUPLED,
    ),
    "waves on steel, friction": (steel(10e-3, 1.5e9, 0.2) | WAVY, STRAINED | COUPLED),
    "steel on steel": (steel(5e-3, 3e9, **KNOWN_STEEL), STRAINED | DISC),
    "waves, steel on steel, friction": (
        steel(5e-3, 1.5e9, 0.1, **KNOWN_STEEL) | WAVY,
        STRAINED | COUPLED | DISC,
    ),
    "coated steel, friction": (steel(5e-3, 2.5e9, 0.2) | {"coating": COATING}, STRAINED | COUPLED),
    "rubber layer": (changed(RUBBER, body={"thickness": 5e-3}), STRAINED),
}


def direct_errors(tables: dict) -> dict[str, float]:
    """(half-plane - finite elements) / finite elements on the third level, by quantity."""
    posed = problem(tables)
    how = posed.pitches[2], "stress" in tables
    levels = half_plane_at(posed, *how), finite_elements(posed, *how)
    flat, real = (values_of(level, posed) for level in levels)
    return {name: flat[name] / real[name] - 1.0 for name in flat}


def both(name: str, levels: int, elements: float) -> list[tuple[Figure, float]]:
    """Errors of every quantity, put together and switched on; the third level has so many elements
    to a half-width."""
    tables, switches = SCENES[name]
    half_width = problem(tables).hertz.half_width
    tables = tables | {"resolution": {"pitch": 4.0 * half_width / elements}}
    judged = dict.fromkeys((*QUANTITIES, *(STRESSES if "stress" in tables else ())), 1e-5)
    added = run_of(tables, levels=Levels(3, levels), tolerance=judged)
    switched = tables | {"finite_element": switches}
    assert added.data("model_error").levels == levels and added.data("model_error").unsplit is None
    friction = added.problem.scene.load.friction[0]
    split = split_variants(added.problem, added.data("model_error").selection, friction)
    assert split.whole.effects == contained(resolved(switched))
    errors = direct_errors(switched)
    return [
        (added.figures.one(study="model_error", quantity=quantity), error)
        for quantity, error in errors.items()
    ]


@pytest.mark.parametrize("name", SCENES)
def test_effects_on_two_levels_contain_what_all_at_once_make_on_three(name):
    # between waves the pressures of a coarse grid do not reach far enough
    for stated, direct in both(name, levels=2, elements=64.0 if "waves" in name else 24.0):
        assert abs(stated.value - direct) <= stated.numerical < np.inf, stated.quantity
        if stated.quantity == "peak_pressure":
            assert stated.numerical < 0.05


def test_on_the_same_levels_they_are_the_same():
    """Relative to the whole model, wherever it comes from."""
    for stated, direct in both("rubber layer", levels=3, elements=24.0):
        assert stated.value == pytest.approx(direct, abs=1e-6), stated.quantity
