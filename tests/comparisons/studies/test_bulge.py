"""What a sliding contact raises ahead of itself: against the half-plane's step, and on a layer."""

import numpy as np
import pytest
from scenes import STEEL, changed, problem, resolved

from comparisons.drawing.style import drawing
from comparisons.figures.quantity import MODELS
from comparisons.models.plan import make_plan
from comparisons.runs.run import run
from comparisons.studies.study import unsolved
from comparisons.studies.subsurface import bulge
from comparisons.studies.subsurface.bulge import (
    QUANTITIES,
    bulge_picture,
    bulges_of,
    elastic_energy,
)

RADIUS, PRESSURE = 10e-3, 1e9
SLIDING = {
    "roller": {"radius": RADIUS, "rigid": True},
    "body": STEEL,
    "load": {"hertz_peak_pressure": PRESSURE, "friction": [0.0, 0.3]},
    "stress": {"points": [80, 30], "bulge": True},
    "resolution": {"pitch": 20e-6, "levels": 2},
    "budget": {"effects": False, "time": 1.0},
}
WAVY = {"profile": {"kind": "sinusoid", "wavelength": 100e-6, "amplitude": 0.2e-6}}
THIN = {"poissons_ratio": 0.49, "thickness": 80e-6, "base": "bonded"}


def solved(tables, models=("finite_element",)):
    return run(resolved(tables), None, models)


def bulge_of(outcome) -> dict:
    """The bulge at the one friction coefficient above 0: values by name, of the height and the end
    their uncertainties, the curve and the patches."""
    [patch] = bulges_of(outcome.findings["bulge"])
    values = {name: patch.value(name) for name in QUANTITIES}
    height = patch.figures["height"]
    values["uncertainty"] = height.numerical * height.scale
    values |= {name: column.values for name, column in patch.curve.columns.items()}
    values["energy_ahead"] = dict(zip(outcome.runs, patch.energy_ahead, strict=True))
    return values | {"patches": patch.patches.rows() if patch.patches else []}


def step(friction, load, poissons_ratio=0.3):
    """Of the surface ahead of a line load (Johnson 1985, section 2.4)."""
    slope = (1.0 - 2.0 * poissons_ratio) * (1.0 + poissons_ratio) / STEEL["youngs_modulus"]
    return -slope * friction * load


@pytest.fixture(scope="module")
def smooth():
    return solved(SLIDING, MODELS)


def test_an_unbounded_body_has_a_step_down_ahead_and_no_bulge(smooth):
    figures = bulge_of(smooth)
    hertz = smooth.problem.hertz
    exact = step(0.3, hertz.load_per_length)
    assert exact < 0.0 and abs(figures["height"]) < figures["uncertainty"] < 0.1 * abs(exact)
    assert figures["half_plane"] == pytest.approx(exact, rel=5e-3)
    assert abs(figures["work"]) < 1e-3
    # rigid roller: the same share of the penetration whatever that is
    depth = hertz.half_width**2 / RADIUS
    assert exact / depth == pytest.approx(-0.25 * np.pi * 0.3 * 0.4 / 0.7)
    beside = np.interp(1.1 * hertz.half_width, figures["distance"], figures["rise"])
    assert beside == pytest.approx(exact, rel=0.02)
    assert figures["relative_penetration"] == pytest.approx((hertz.half_width / RADIUS) ** 2)


def test_inside_the_contact_the_step_grows_with_the_load_up_to_there(smooth):
    figures = bulge_of(smooth)
    s = np.array(figures["distance"]) / smooth.problem.hertz.half_width
    inside = s < 0.8
    share = 2.0 / np.pi * (np.arcsin(s[inside]) + s[inside] * np.sqrt(1.0 - s[inside] ** 2))
    exact = step(0.3, smooth.problem.hertz.load_per_length) * share
    assert np.array(figures["rise"])[inside] == pytest.approx(exact, abs=0.02 * abs(exact[-1]))


def test_both_models_carry_the_same_energy_ahead(smooth):
    figures = bulge_of(smooth)
    half_plane, other = (figures["energy_ahead"][name] for name in MODELS)
    assert half_plane == pytest.approx(other, abs=3e-3) and half_plane > 0.55
    level, window = smooth.runs["half_plane"].finest, smooth.window
    back, front = elastic_energy(smooth.problem, level, window, 0.0)
    assert front == pytest.approx(back, rel=1e-6)


def test_roughness_leaves_the_step_as_it_is():
    outcome = solved(SLIDING | WAVY)
    figures = bulge_of(outcome)
    exact = step(0.3, outcome.problem.hertz.load_per_length)
    assert len(outcome.runs["finite_element"].finest.patches) > 1
    assert figures["half_plane"] == pytest.approx(exact, rel=5e-3)
    assert abs(figures["height"]) < figures["uncertainty"] < 0.1 * abs(exact)


def test_an_incompressible_layer_rises_ahead_and_not_far():
    outcome = solved(changed(SLIDING, body=THIN, resolution={"pitch": 10e-6}))
    figures = bulge_of(outcome)
    assert figures["height"] > 5.0 * abs(figures["half_plane"]) > 0.0
    assert figures["end"] < 3.0 * outcome.problem.hertz.half_width
    assert figures["uncertainty"] < 0.05 * figures["height"]


def test_flow_raises_a_bulge_ahead_that_ends():
    """Beside an elastic body under the same load, which has none."""
    flowing = changed(
        SLIDING,
        roller={"radius": RADIUS, "rigid": False, **STEEL},
        body={"yield_stress": 1e9, "hardening_modulus": 10e9},
        load={"hertz_peak_pressure": 3.5e9, "friction": 0.3},
        finite_element={"plastic": True, "coupled": True},
        resolution={"pitch": 150e-6},
        budget={"time": 1.0},
    )
    outcome = solved(flowing)
    figures = bulge_of(outcome)
    assert figures["work"] is None and figures["relative_penetration"] == pytest.approx(
        3.7e-3, rel=0.01
    )
    a = outcome.problem.hertz.half_width
    assert 0.15 < figures["over_penetration"] < 0.35
    assert a < figures["at"] < 2.0 * a < figures["end"] < 5.0 * a
    assert np.max(figures["rise"]) > 0.1 * a**2 / RADIUS  # higher than behind, in spite of the step


FLOWING = {
    "roller": {"radius": RADIUS, **STEEL},
    "body": {**STEEL, "yield_stress": 1e9, "hardening_modulus": 10e9},
    "load": {"hertz_peak_pressure": 5e9, "friction": 0.3},
    "stress": {"points": [80, 30], "half_range": 3.0, "bulge": True},
    "finite_element": {"plastic": True, "coupled": True},
    "resolution": {"elements": 4.0, "levels": 2},
    "budget": {"effects": False, "time": 1.0},
}


def test_the_bulge_depends_on_penetration_over_yield_strain():
    """Half the strains by a roller of twice the radius at half the pressures: the same contact."""
    one = solved(FLOWING)
    tables = changed(FLOWING, roller={"radius": 2.0 * RADIUS}, body={"yield_stress": 0.5e9})
    two = solved(changed(tables, load={"hertz_peak_pressure": 2.5e9}))
    first, second = (bulge_of(outcome) for outcome in (one, two))
    assert second["contact"] == pytest.approx(first["contact"], rel=1e-6)
    assert second["height"] == pytest.approx(0.5 * first["height"], rel=1e-4)
    assert second["end"] == pytest.approx(first["end"], rel=1e-4)
    assert second["energy"] == pytest.approx(0.25 * first["energy"], rel=1e-4)
    assert second["plastic_strain"] == pytest.approx(0.5 * first["plastic_strain"], rel=1e-3)
    assert second["relative_penetration"] == pytest.approx(0.25 * first["relative_penetration"])
    assert first["contact"] > 1.5 * one.problem.hertz.half_width  # wider than what is elastic


def test_patches_of_a_meshed_profile_have_the_step_and_no_bulge():
    """Elastic asperities of small slopes: about each centre the half-plane's step alone."""
    rough = changed(SLIDING | WAVY, finite_element={"geometry": "rough"}, resolution={"levels": 3})
    figures = bulge_of(solved(changed(rough, resolution={"pitch": 10e-6})))
    steps = np.array([patch["half_plane"] for patch in figures["patches"]])
    heights = np.array([patch["height"] for patch in figures["patches"]])
    assert len(steps) > 2 and (steps < 0.0).all()
    assert np.abs(heights).max() < 0.1 * np.abs(steps).max()
    assert 0.5 < figures["energy_ahead"]["finite_element"] < 0.9  # above the waves there is none


def test_patches_that_flow_raise_bulges_of_their_own():
    wavy = {"kind": "sinusoid", "wavelength": 400e-6, "amplitude": 4e-6}
    tables = changed(
        FLOWING, load={"hertz_peak_pressure": 2e9}, resolution={"pitch": 40e-6, "elements": None}
    )
    outcome = solved(tables | {"profile": wavy})
    figures = bulge_of(outcome)
    patches, level = figures["patches"], outcome.runs["finite_element"].finest
    assert set(level.mesh_field.displacement) == {0.0, 0.3} and len(patches) == len(level.patches)
    deepest = max(patches, key=lambda patch: patch["relative_penetration"])
    assert deepest["kind"] in ("elastic", "plastic") and deepest["over_penetration"] > 0.05
    shares = sum(patch["penetration"] for patch in patches)
    assert shares == pytest.approx(figures["penetration"], rel=1e-6)  # 4 P/(pi E*) of all loads
    [block] = bulge.blocks(outcome)
    assert len(block.items[2].rows) == 1 + len(patches)


@pytest.mark.parametrize(
    ("tables", "models", "why"),
    [
        (SLIDING, ("half_plane",), "takes the finite elements"),
        (changed(SLIDING, load={"friction": 0.0}), MODELS, "takes the finite elements, and fric"),
        (changed(SLIDING | WAVY, load={"friction": 0.3}), MODELS, "a second friction coefficient"),
    ],
)
def test_what_cannot_be_measured_says_why(tables, models, why):
    posed = problem(tables)
    assert why in bulge.needs(unsolved(posed, make_plan(posed, models)))


def test_it_is_measured_where_it_is_asked_for(smooth, smooth_outcome):
    assert bulge.NAME not in smooth_outcome.findings and bulge_picture(smooth_outcome) is None
    [block] = bulge.blocks(smooth)
    heading, shown, table, note = block.items
    assert shown.names == ("bulge",) and heading.text and note.text
    assert [row[0] for row in table.rows] == ["0.3"] and "beyond 20 a" in table.rows[0]
    with drawing():
        picture = bulge_picture(smooth)
    assert "Bulge: friction 0.3: 0.00" in picture.alternative
