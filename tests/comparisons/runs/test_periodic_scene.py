"""A surface that repeats under a flat body: both models against Westergaard, and each other."""

import numpy as np
import pytest
from scenes import STEEL, changed, half_plane_at, problem, resolved, run_of

from analytic.layers.layered import LayeredBody, normal_compliance
from comparisons.common.errors import ExitStatus, SceneError
from comparisons.figures.quantity import MODELS
from comparisons.judging.rule import judged, values_of
from comparisons.models.smooth import closed_form
from comparisons.output.page.pictures.contact import surface_picture
from comparisons.output.page.tables.problem import problem_sheet
from comparisons.scenes.surface import surface_of

PERIOD, AMPLITUDE = 0.5e-3, 0.2e-6
WAVE = {
    "roller": {"rigid": True},
    "body": dict(STEEL),
    "profile": {
        "kind": "sinusoid",
        "wavelength": PERIOD,
        "amplitude": AMPLITUDE,
        "periodic": True,
    },
    "load": {"mean_pressure": 140e6, "friction": [0.0, 0.3]},
    "stress": {"half_range": 1.0, "points": [60, 20]},
    "resolution": {"levels": 3},
    "budget": {"effects": False},
}
ROUGH = changed(
    WAVE,
    roller={"rigid": False, **STEEL, "youngs_modulus": 70e9},
    load={"mean_pressure": 60e6, "friction": 0.1},
)
ROUGH |= {
    "profile": {
        "kind": "self-affine",
        "hurst": 0.8,
        "rms_slope": 0.005,
        "samples": 257,
        "length": PERIOD,
        "shortest_wavelength": PERIOD / 16,
        "seed": 5,
        "periodic": True,
    },
    "resolution": {"levels": 2},
}


@pytest.fixture
def wave():
    return run_of(WAVE)


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_both_models_are_westergaards_within_what_they_state(wave, model, friction):
    exact, levels = closed_form(wave.problem), wave.solved.case(friction).runs[model]
    stated = judged(levels, wave.problem)
    known = values_of(levels.finest, wave.problem)
    largest = exact.extremes(friction)
    for name, value in {
        "peak_pressure": exact.peak_pressure,
        "contact_length": exact.contact_length,
        "tau1_max": largest["tau1"].value,
        "tau1_max_depth": largest["tau1"].z,
        "txz_max_abs": abs(largest["txz"].value),
    }.items():
        assert abs(known[name] / value - 1.0) <= stated[name].total < 2e-2, name


@pytest.mark.parametrize("model", MODELS)
def test_pressures_and_gap_are_westergaards(wave, model):
    """But for the nodes next to the edges, where hats meet a square root."""
    exact, level = closed_form(wave.problem), wave.runs[model].finest
    x, half = level.grid.x, 0.5 * exact.contact_length
    inside = np.abs(np.abs(x) - half) > 5.0 * level.grid.pitch
    error = np.abs(level.solution.pressure - exact.pressure(x))[inside]
    assert error.max() < 2e-3 * exact.peak_pressure
    mean = wave.problem.scene.load.value
    ratio = 4.0 * (mean / exact.peak_pressure) ** 2  # pm/p*, of the peak 2 (p* pm)^(1/2)
    gap = AMPLITUDE * (1.0 - ratio + ratio * np.log(ratio))
    assert np.mean(level.solution.gap) == pytest.approx(gap, rel=1e-3)


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_fields_are_westergaards(wave, friction):
    exact, window = closed_form(wave.problem), wave.window
    field = exact.stress(window.x, window.z[:, None], friction).tau1
    for levels in wave.solved.case(friction).runs.values():
        known = levels.finest.stress.tau1
        assert np.abs(known - field).max() < 2e-2 * exact.peak_pressure
        deep = window.z > 0.1 * PERIOD
        assert np.abs(known - field)[deep].max() < 1e-3 * exact.peak_pressure


def test_a_rough_period_is_the_same_to_both(wave):
    rough = run_of(ROUGH)
    assert rough.exit_status != ExitStatus.NOT_CONVERGED
    assert closed_form(rough.problem) is None and rough.problem.dundurs_beta != 0.0
    assert not rough.plan.coupling  # what friction moves is estimated, not measured as nothing
    for figure in rough.figures.of(study="comparison"):
        if figure.quantity in ("peak_pressure", "contact_length", "tau1_max"):
            assert abs(figure.value) <= figure.total, figure.quantity
    patches = rough.runs["half_plane"].finest.patches
    assert len(patches) > 2 and 0.1 < np.ptp(patches, axis=1).sum() / PERIOD < 0.6


def test_the_report_knows_no_roller(wave):
    sheet = dict(row for rows in problem_sheet(wave).values() for row in rows)
    assert sheet["flat body"] == "rigid"
    assert not [text for text in (*sheet, *wave.plan.assumptions) if "roller" in text]
    picture = surface_picture(wave)
    assert "roller" not in picture.caption + picture.alternative


def test_where_the_period_is_cut_changes_nothing():
    first, second = (problem(changed(WAVE, load={"position": x})) for x in (0.0, 0.17e-3))
    one, other = half_plane_at(first), half_plane_at(second)
    assert other.patches[-1, 0] < 0.5 * PERIOD < other.patches[-1, 1]
    alike, again = values_of(one, first), values_of(other, second)
    assert again["peak_pressure"] == pytest.approx(alike["peak_pressure"], rel=2e-3)
    assert again["contact_length"] == pytest.approx(alike["contact_length"], rel=1e-2)


@pytest.mark.parametrize("model", MODELS)
def test_full_contact_is_of_second_order(model):
    """The waves of hats; no edge disturbs them."""
    load, stress = {"mean_pressure": 400e6, "friction": 0.0}, {"points": [30, 10]}
    outcome = run_of(WAVE, model, load=load, stress=stress)
    assert outcome.exit_status == ExitStatus.DONE
    levels, exact = outcome.runs[model].levels, closed_form(outcome.problem).peak_pressure
    [ratio] = outcome.figures.of(study="contact", quantity="contact_ratio")
    assert ratio.value == 1.0
    off = [abs(level.solution.pressure.max() / exact - 1.0) for level in levels[:3]]
    assert off[2] < 1e-4 and np.log2(off[:2] / np.array(off[1:])) == pytest.approx(2.0, abs=0.2)


LAYER = {"body": {"thickness": 0.1e-3}}
COATING = {"coating": {"thickness": 20e-6, "youngs_modulus": 400e9, "poissons_ratio": 0.22}}


@pytest.mark.parametrize("layers", [LAYER, COATING], ids=["layer", "coating"])
def test_a_layer_in_full_contact_bears_its_own_wave(layers):
    """p = pm + A/C(q) cos qx, C the layer's compliance."""
    closed = changed(WAVE, load={"mean_pressure": 900e6, "friction": 0.0}, **layers)
    del closed["stress"]
    outcome = run_of(closed, "finite_element")
    scene, levels = outcome.problem.scene, outcome.runs["finite_element"].levels
    top, below = scene.body, scene.body.base
    if scene.coating is not None:
        top, below = scene.coating, scene.body.material
    body = LayeredBody(top.material, top.thickness, below)
    compliance = float(normal_compliance(body, np.array([2.0 * np.pi / PERIOD]))[0])
    exact = 900e6 + AMPLITUDE / compliance
    off = [level.solution.pressure.max() / exact - 1.0 for level in levels]
    assert 0.0 < off[-1] < 1e-4 and 2.5 < off[1] / off[2] < 6.0


TRACE = "0,0.0\n1,0.2\n2,0.3\n3,0.2\n4,{last}\n"


def test_ends_of_a_measured_trace_meet_at_their_mean_or_are_refused(tmp_path):
    def surface(last: float):
        (tmp_path / "trace.csv").write_text(TRACE.format(last=last))
        file = {"file": "trace.csv", "x_unit": "um", "z_unit": "nm", "form": "mean"}
        scene = changed(WAVE, stress={}) | {"profile": file | {"periodic": True}}
        return surface_of(resolved(scene, "mine", tmp_path))

    met = surface(0.1)
    assert met.info.seam == pytest.approx(1e-10)
    assert met.profile.periodic and met.profile.height[0] == met.profile.height[-1]
    with pytest.raises(SceneError, match=r"the ends of the trace are 3e-10 m apart, neighbouring"):
        surface(0.3)
