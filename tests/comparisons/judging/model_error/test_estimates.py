"""Estimates are larger than the effects: on every point of the maps, and in the stresses. What is
said of the half-plane by them before finite elements are solved."""

from dataclasses import replace
from unittest.mock import patch

import pytest
from scenes import STEEL, changed, finite_elements, half_plane_at, lawed, problem, resolved

from analytic.material import Law
from comparisons.grid.groups import scene_with
from comparisons.grid.map import FINISHED, finished_map, finished_names
from comparisons.judging.effects.catalogue import UNKNOWN, estimates
from comparisons.judging.effects.estimates import Shown
from comparisons.judging.effects.laws import open_laws
from comparisons.judging.model_error.study import early_lines
from comparisons.judging.rule import values_of
from comparisons.models.posing import problem_of
from comparisons.scenes.files import read_toml
from comparisons.scenes.surface import surface_of


@pytest.mark.parametrize("name", finished_names())
def test_they_bound_every_point_of_a_finished_map(name):
    """The half-plane's error, beyond its uncertainty, is at most the sum of estimates. These ask
    for no contact on the layers."""
    content = finished_map(name)
    base = resolved(read_toml(FINISHED / f"{name}.toml"), name, FINISHED)
    checked, tight = 0, 0.0
    for point in content["points"]:
        if point["status"] != "solved":
            continue
        groups = {content[axis]["group"]: point[axis] for axis in ("x", "y")}
        with patch(
            "comparisons.models.posing._touched",
            lambda posed, ends, *how: (0.5 * ends[0], 0.5 * ends[1]),
        ):
            scene = scene_with(base, groups)
            posed = problem_of(scene, surface_of(scene, standard=False))
        errors = point["quantities"]
        peak = errors["peak_pressure"]["half_plane"]
        sizes = estimates(posed, Shown(peak, peak))
        for name in UNKNOWN:  # the maps take one law and one support
            sizes.pop(name, None)
        for quantity, error in errors.items():
            if error["uncertainty"] is None:
                continue
            bound = sum(effect.get(quantity, 0.0) for effect in sizes.values())
            proven = abs(error["difference"]) - error["uncertainty"]
            assert proven <= bound, (groups, quantity)
            tight = max(tight, proven / bound)
            checked += 1
    assert checked >= 4 * 60
    assert tight > 0.3  # nor are they idle: somewhere an effect is a third of its bound


@pytest.mark.parametrize("surface", ["smooth", "waves"])
@pytest.mark.parametrize("roller", ["rigid", "elastic"])
def test_laws_of_elasticity_spread_within_their_estimate(surface, roller):
    """Peak pressures of full solutions at finite deformation, of one body and of two alike, as the
    solids that the estimate is taken from."""
    tables = {
        "roller": {"radius": 5e-3} | ({"rigid": True} if roller == "rigid" else STEEL),
        "body": STEEL,
        "load": {"hertz_peak_pressure": 2e9},
    }
    if surface == "waves":
        tables["profile"] = {"kind": "sinusoid", "wavelength": 60e-6, "amplitude": 0.15e-6}
    plain = problem(tables)
    [open_law] = open_laws(plain.scene)
    peaks = []
    for law in (Law(), *open_law.probes.values()):
        bodies = dict.fromkeys(open_law.bodies, lawed(law))
        posed = problem(changed(tables, **bodies, finite_element={"deformation": "finite"}))
        peaks.append(float(finite_elements(posed).solution.pressure.max()))
        assert "law_of_elasticity" not in estimates(posed, Shown(peaks[-1], peaks[-1]))
    bound = estimates(plain, Shown(peaks[0], peaks[0]))["law_of_elasticity"]["peak_pressure"]
    spread = [peak / peaks[0] - 1.0 for peak in peaks[1:]]
    assert 0.3 * bound < max(map(abs, spread)) < bound


@pytest.mark.parametrize("friction", [0.0, 0.2])
def test_flow_without_a_cap_is_within_its_estimate(friction):
    """A smooth contact at p0 = 3 Y, perfectly plastic: neither exceeded nor four times as large."""
    body, load = STEEL | {"yield_stress": 1e9}, {"hertz_peak_pressure": 3e9, "friction": friction}
    tables = {"roller": {"radius": 8e-3, "rigid": True}, "body": body, "load": load}
    tables |= {"stress": {"points": [60, 20]}, "resolution": {"elements": 8}}
    posed = problem(tables)
    flowing = problem(tables | {"finite_element": {"plastic": True, "coupled": True}})
    elastic = half_plane_at(posed, fields=True)
    plastic = finite_elements(flowing, posed.pitches[0], fields=True)
    values = [values_of(level, posed) for level in (elastic, plastic)]
    peak = posed.hertz.peak_pressure
    bounds = estimates(posed, Shown(peak, peak))["plastic_flow"]
    for name in ("peak_pressure", "contact_length", "tau1_max", "txz_max_abs"):
        moved = abs(values[0][name] / values[1][name] - 1.0)
        assert moved <= bounds[name] <= 4.0 * moved, name


def lines_of(posed) -> tuple[str, str]:
    return early_lines(posed, half_plane_at(posed))


@pytest.mark.parametrize(
    ("tables", "left"),
    [
        ({}, "peak pressure 0.17 %, contact length 0.16 %, mostly law of elasticity"),
        (
            {"body": {"thickness": 1e-5}},
            "peak pressure 100 % or more, contact length 100 % or more, mostly finite thickness",
        ),
    ],
)
def test_figures_and_what_is_left_out(problem_with, tables, left):
    posed = problem_with(load={"hertz_peak_pressure": 1e8}, **tables)
    figures, beside = lines_of(posed)
    assert figures.startswith("half-plane: peak pressure 100.0 MPa, contact length 27.7")
    assert beside.startswith(f"left out, by estimates at most: {left}")


def test_what_flows_is_said_by_either_switch(problem_with):
    """The answer is the half-plane's, whatever the finite elements of the scene do."""
    posed = problem_with(body={"yield_stress": 4e8})
    switched = posed.scene.unchecked({"finite_element.plastic": True})
    said = lines_of(posed)
    assert lines_of(replace(posed, scene=switched)) == said
    assert said[1].endswith("mostly plastic flow")
