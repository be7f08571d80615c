"""Cycles from the scene to its files: verdicts, figures, surfaces, wrong input."""

from dataclasses import replace

import numpy as np
import pytest
from scenes import STEEL, changed, problem, resolved

from comparisons.common.errors import SceneError
from comparisons.figures.quantity import MODELS
from comparisons.models.plan import make_plan
from comparisons.output.record import read_result
from comparisons.runs.run import run
from comparisons.studies.study import unsolved
from comparisons.studies.subsurface.cycles.level import expected_seconds
from comparisons.studies.subsurface.cycles.passes import CycledLevel, Passes
from comparisons.studies.subsurface.cycles.study import LONGEST, needs, outcome, planned
from comparisons.studies.subsurface.cycles.surfaces import FLATTENED, FRESH, LAST, ONCE

ROLLED = {
    "roller": {"radius": 8e-3, **STEEL},
    "body": {**STEEL, "yield_stress": 1e9},
    "load": {"hertz_peak_pressure": 3.6 * 1e9 / 3**0.5},
    "cycles": {"kind": "roll", "passes": 3, "share": 0.2},
    "resolution": {"levels": 2},
    "budget": {"effects": False},
}
PRESSED = changed(ROLLED, cycles={"kind": "press", "passes": 2}, body={"hardening_modulus": 5e9})
ROUGH = {"kind": "sinusoid", "amplitude": "0.1 um", "wavelength": "100 um", "length": "4 mm"}


@pytest.fixture(scope="module")
def rolled(tmp_path_factory):
    return run(resolved(ROLLED), tmp_path_factory.mktemp("rolled") / "out", MODELS)


@pytest.fixture(scope="module")
def pressed(tmp_path_factory):
    return run(resolved(PRESSED), tmp_path_factory.mktemp("pressed") / "out", MODELS)


def value(outcome_of, quantity: str, **wanted: object) -> float:
    return outcome_of.figures.of(study="cycles", **wanted).one(quantity=quantity).value


def test_rolling_below_the_limit_is_told_to_shake_down(rolled):
    said = rolled.findings["cycles"].said("shakedown")
    assert said.startswith("shakes down: from pass 2 on") and "3.6 k" in said
    assert value(rolled, "passes_to_shakedown") == 2
    assert value(rolled, "shakedown_limit") == pytest.approx(4.0, rel=1e-4)
    assert value(rolled, "carried") < 4.0
    assert value(rolled, "energy_balance") < 2e-3
    loss = rolled.figures.of(study="cycles").one(quantity="loss_first")
    assert 0.0 < loss.uncertainty.parts["increments"] < 0.05
    flow = rolled.figures.of(study="cycles").one(quantity="flow_first")
    one, other = flow.levels
    assert abs(one - other) < flow.numerical * flow.scale  # two levels: three times their change


def test_the_half_plane_bears_the_load_on_what_flow_leaves(pressed):
    """A second pressing is elastic: so the finite elements find it, too."""
    for quantity, last in (("peak_reloaded", "peak_last"), ("length_reloaded", "length_last")):
        reloaded = value(pressed, quantity, source=ONCE)
        assert reloaded == pytest.approx(value(pressed, last), rel=0.01)
    peaks = [value(pressed, "peak_reloaded", source=name) for name in (FRESH, ONCE, LAST)]
    assert value(pressed, "energy_balance") < 1e-5
    hertz = pressed.problem.hertz.peak_pressure
    assert peaks[0] == pytest.approx(hertz, rel=0.01) and peaks[1] < 0.98 * hertz
    assert peaks[2] == pytest.approx(peaks[1], rel=0.01)
    # at 3 Y running-in has nothing to take off: it knows no flow below the surface
    assert value(pressed, "peak_reloaded", source=FLATTENED) == pytest.approx(peaks[0], rel=1e-3)
    assert value(pressed, "shape_rms") == pytest.approx(value(pressed, "lowered_rms"), rel=1e-6)


def test_page_and_files_have_it(rolled, pressed):
    for shown, words in ((rolled, "endless"), (pressed, "pressed once")):
        page = (shown.directory / "report.html").read_text(encoding="utf-8")
        assert ">Cycles<" in page and words in page
        stress = shown.directory / "finite_element/cycles_stress.csv"
        z, sx, *_ = np.genfromtxt(stress, delimiter=",", skip_header=1).T
        assert np.all(np.diff(z) > 0.0) and sx.min() < -1e7
    surface = pressed.directory / "finite_element/cycles_surface.csv"
    x, fresh, _, once, *_ = np.genfromtxt(surface, delimiter=",", skip_header=1).T
    assert not fresh.any() and once[np.abs(x).argmin()] < -1e-9
    assert read_result(pressed.directory / "result.json").figures.of(study="cycles", source=LAST)


@pytest.mark.parametrize(
    "flow, net, what",
    [
        ([0.0, 0.0], [0.0, 0.0], ("elastic", 0)),
        ([1.0, 0.1, 0.001], [1.0, 0.1, 0.0], ("shakes down", 3)),
        ([1.0, 0.6, 0.4, 0.2], [1.0, 0.6, 0.4, 0.2], ("settling", 4)),
        ([1.0], [1.0], ("settling", 1)),
        ([1.0, 0.5, 0.5, 0.5], [1.0, 0.3, 0.3, 0.3], ("ratchets", 4)),
        ([1.0, 0.5, 0.5, 0.5], [1.0, 0.3, 0.1, 0.01], ("cycles", 4)),
    ],
    ids=str,
)
def test_what_becomes_of_a_body(flow, net, what):
    known = {name: np.ones(len(flow)) for name in Passes.__dataclass_fields__}
    passes = Passes(**known | {"flow": np.array(flow), "net": np.array(net)})
    nothing = np.zeros(1)
    level = CycledLevel(1.0, 1, 0.0, passes, *(nothing,) * 6)
    assert outcome(level, 0.01) == what


def test_a_trace_is_rolled_over_where_it_takes_no_longer_than_it_may():
    rough = changed(ROLLED | {"profile": ROUGH}, cycles={"passes": 200, "travel": "0.8 mm"})
    solved = unsolved(posed := problem(rough), make_plan(posed, MODELS))
    assert expected_seconds(posed) > LONGEST and "fewer cycles.passes" in needs(solved)
    shorter = unsolved(problem(changed(rough, cycles={"passes": 2})), solved.plan)
    assert planned(shorter).endswith("s more, 2 passes on 2 levels")
    half_plane = replace(solved, plan=make_plan(posed, MODELS[:1]))
    assert needs(half_plane) == "takes the finite elements"
    far = problem(changed(rough, cycles={"travel": "3.9 mm"}))
    with pytest.raises(SceneError, match=r"cycles\.travel: is 0\.0039 m"):
        needs(unsolved(far, make_plan(far, MODELS)))


@pytest.mark.parametrize(
    "changes, message",
    [
        ({"cycles": {"passes": 0}}, "cycles.passes: is 0"),
        ({"cycles": {"travel": 0}}, "cycles.travel: is 0"),
        ({"cycles": {"travel": 2.0}}, "cycles.travel: is given for a smooth body"),
        ({"cycles": {"kind": "press", "travel": 2.0}}, "cycles.travel: is given for kind"),
        ({"cycles": {"kind": "rolls"}}, 'cycles.kind: is "rolls"'),
        ({"body": {"yield_stress": None}}, "cycles: is given for a body that does not yield"),
        ({"body": {"width": "4 mm"}}, "body.width: is given where"),
        ({"finite_element": {"deformation": "finite"}}, "cycles: is of small strains"),
        ({"coating": {"thickness": 1e-5, **STEEL}}, "cycles: is given for a coated body"),
    ],
    ids=str,
)
def test_wrong_input_is_one_line(changes, message):
    tables = changed(ROLLED, **changes)
    tables["body"] = {name: v for name, v in tables["body"].items() if v is not None}
    with pytest.raises(SceneError, match=message) as error:
        resolved(tables)
    assert "\n" not in str(error.value) and "allowed" in str(error.value)
