"""The half-plane with a layer, a coating, coupling: exact layers, and limits with known answers.

analytic/exact/layer_contact.json: ten digits, two independent derivations."""

import json

import numpy as np
import pytest
from scenes import STEEL, exact_layer, half_plane_at, problem

from analytic.exact.layers import TABLE
from comparisons.common.progress import Stages
from comparisons.grid.groups import scene_with
from comparisons.grid.map import finished_map
from comparisons.judging.ladder.candidates import CANDIDATES, words_of
from comparisons.models.analytic import CAP, analytic_level
from comparisons.models.posing import problem_of
from comparisons.models.problem import COUPLED
from comparisons.models.smooth import closed_form
from comparisons.scenes.scene import Origin, Scene

CASES = json.loads(TABLE.read_text())["cases"]
LOAD = {"per_length": 1e6, "friction": 0.3}
BODIES = {"roller": {"radius": 8e-3, **STEEL}, "body": dict(STEEL), "load": LOAD}
FIELD = {"stress": {"points": [60, 20]}}

OPERATORS, _ = CANDIDATES


def analytic_at(posed, pitch, *effects):
    [level] = analytic_level(posed, frozenset(effects), posed.grid(pitch), Stages()).values()
    return level


@pytest.mark.parametrize("case", CASES, ids=[f"{c['base']}-{c['a_over_t']}" for c in CASES])
def test_exact_layers(case):
    """The coarsest level and the third: the peak of second order, and pressures on the way."""
    nu = 0.3 if case["nu"] == "any" else float(case["nu"])
    tables, known = exact_layer(case, nu)
    posed = problem(tables)
    exact, half_width = known["peak_pressure"], 0.5 * known["contact_length"]
    for pitch, close in ((posed.pitches[0], 6e-4), (posed.pitches[2], 4e-5)):
        level = analytic_at(posed, pitch, "finite_size")
        assert level.solution.converged
        assert level.solution.pressure.max() == pytest.approx(exact, rel=close)
        assert abs(0.5 * level.contact_length - half_width) < 0.1 * pitch
        places, profile = np.array([(float(x), float(p)) for x, p in case["profile"].items()]).T
        pressure = np.interp(places * half_width, level.grid.x, level.solution.pressure)
        assert pressure / exact == pytest.approx(profile, abs=8.0 * close)


@pytest.mark.parametrize("mean_pressure", [1e8, 3e8, 6e8], ids=["a third", "two thirds", "closed"])
def test_westergaard_s_wave(mean_pressure):
    """The operator of a period, which is the model of any other surface, is of second order."""
    posed = problem(Scene.read("periodic").tables | {"load": {"mean_pressure": mean_pressure}})
    exact, off = closed_form(posed), []
    for pitch in (posed.pitches[0], posed.pitches[2]):
        level = analytic_at(posed, pitch)
        off.append(level.solution.pressure.max() / exact.peak_pressure - 1.0)
        assert abs(level.contact_length - exact.contact_length) < 0.2 * pitch
    assert off[1] < 1.5e-4 and 12.0 < off[0] / off[1] < 22.0


def test_a_coating_of_the_body_itself_is_a_half_plane():
    """Pressures, and the largest stresses on both sides of the interface."""
    coating = {"thickness": 30e-6, **STEEL}
    posed = problem(BODIES | FIELD | {"coating": coating})
    pitch = posed.pitches[0]
    coated = analytic_at(posed, pitch, "coating")
    plain = half_plane_at(posed, pitch, fields=True)
    known = plain.solution.pressure
    assert coated.solution.pressure == pytest.approx(known, rel=1e-8, abs=1e-8 * known.max())
    one, other = coated.stress, plain.stress
    for name in ("tau1", "txz", "von_mises"):
        assert one.extremes[name].value == pytest.approx(other.extremes[name].value, rel=1e-6)


@pytest.mark.parametrize("softer", [1.0, 0.25])
def test_traction_moves_both_surfaces_of_a_coated_body(softer):
    """A coating of the body itself under a roller of other constants: Dundurs' beta of the pair."""
    roller = {"radius": 8e-3, "youngs_modulus": softer * 210e9, "poissons_ratio": 0.1}
    coating = {"thickness": 30e-6, **STEEL}
    posed = problem(BODIES | {"roller": roller, "coating": coating})
    pitch = posed.pitches[0]
    coated = analytic_at(posed, pitch, "coating", COUPLED)
    moved = analytic_at(posed, pitch, COUPLED)
    still = analytic_at(posed, pitch)
    peak = posed.hertz.peak_pressure
    assert coated.solution.pressure == pytest.approx(moved.solution.pressure, abs=1e-7 * peak)
    assert np.abs(moved.solution.pressure - still.solution.pressure).max() > 1e-3 * peak


def test_what_an_operator_carries():
    """A layer without its width, a hardness where the pressure exceeds 3 Y."""
    highest = problem(BODIES).hertz.peak_pressure
    body = {**STEEL, "thickness": 1e-3, "width": 40e-3, "yield_stress": 0.3 * highest}
    posed = problem(BODIES | {"body": body})
    peak = float(half_plane_at(posed).solution.pressure.max())
    held = OPERATORS.carries(posed, frozenset({"finite_size", COUPLED, "finite_strain"}), peak)
    assert held == {"finite_size", COUPLED, CAP}
    assert words_of(held) == "half-plane with layer, coupling, pressures up to 3 Y"
    capped = analytic_at(posed, posed.pitches[0], CAP)
    pressure = capped.solution.pressure
    assert pressure.max() == pytest.approx(0.9 * highest)


@pytest.mark.parametrize("place", [0, 28, 46, 77])
def test_waves_of_a_finished_map(place):
    """Peak pressures of finite elements at finite strain, p/E from 0.009 to 0.034, where the
    half-plane misses 0.2 to 1.1 %."""
    content = finished_map("slope-wavelength")
    point = content["points"][place]
    values = {content[axis]["group"]: point[axis] for axis in "xy"}
    posed = problem_of(scene_with(Scene.of(content["scene"], Origin("map")), values))
    pitch = posed.pitches[0] / 2.0 ** (point["levels"] - 1)
    level = analytic_at(posed, pitch, "exact_circle", "finite_strain")
    peak = level.solution.pressure.max()
    known = point["quantities"]["peak_pressure"]
    error = peak / known["finite_element"] - 1.0
    assert abs(error) < 3e-4 + known["uncertainty"] < abs(known["difference"])
