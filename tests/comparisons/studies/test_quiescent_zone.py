"""The layer of low shear below asperities, on shear made for it and on real contacts."""

from types import SimpleNamespace

import numpy as np
import pytest
from scenes import STEADY, STEEL, half_plane_at, problem, run_of
from scipy.optimize import minimize_scalar, root_scalar

from analytic.exact.hertz import HertzContact, hertz_stress
from comparisons.drawing.blocks import Names
from comparisons.judging.presentation import parts_of
from comparisons.judging.study import WHY_NOT
from comparisons.studies import quiescent_zone as q

Z = np.linspace(0.0, 1.0, 101) ** 2
RIPPLE = 0.04 * np.cos(400.0 * Z) * np.exp(-((Z / 0.03) ** 2))  # near the surface, no zone's
WAVY = {
    "roller": {"radius": 10e-3, **STEEL},
    "body": STEEL,
    "profile": {"kind": "sinusoid", "wavelength": 25e-6, "amplitude": 0.1e-6},
    "load": {"hertz_peak_pressure": 1e9, "friction": [0.0, 0.3]},
    "stress": {"points": [200, 60]},
    "budget": {"effects": False},
}


def below_a_wave(z, height=1.0, wave=100.0):
    """A full wave of pressure shears as k z exp(-k z); the Hertz contact about as z near it."""
    return height * wave * z * np.exp(-wave * z) + z / (0.2 + z**2)


def dip_of(z, shear, deep):
    [dip] = q.shear_dips(z, shear[None], deep)
    return dip


def test_the_dip_is_where_the_slope_of_the_shear_vanishes():
    dip = dip_of(Z, below_a_wave(Z, 4.0), 0.4)
    within = {"bounds": (0.02, 0.3), "options": {"xatol": 1e-9}}
    low = minimize_scalar(lambda z: below_a_wave(z, 4.0), **within)
    high = minimize_scalar(lambda z: -below_a_wave(z, 4.0), bounds=(0.3, 0.9))
    top = minimize_scalar(lambda z: -below_a_wave(z, 4.0), bounds=(0.0, 0.02))
    assert q.state_of(dip) == q.QUIESCENT
    assert dip["depth"] == pytest.approx(low.x, abs=1e-3)
    assert (dip["hertz"], dip["hertz_depth"]) == pytest.approx((-high.fun, high.x), rel=2e-3)
    assert (dip["asperity"], dip["asperity_depth"]) == pytest.approx((-top.fun, top.x), rel=5e-3)
    assert dip["level"] == pytest.approx(low.fun / -high.fun, rel=1e-4)
    assert dip["ratio"] == pytest.approx(low.fun / min(-high.fun, -top.fun), rel=1e-4)
    least = q.QUIET * min(-high.fun, -top.fun)
    for depth, bracket in ((dip["start"], (top.x, low.x)), (dip["stop"], (low.x, high.x))):
        end = root_scalar(lambda z: below_a_wave(z, 4.0) - least, bracket=bracket)
        assert depth == pytest.approx(end.root, abs=2e-4)


@pytest.mark.parametrize(
    ("shear", "status", "level"),
    [
        (below_a_wave(Z, 0.0), q.SMOOTH, 0.0),  # it only grows
        (below_a_wave(Z, 0.2), q.SMOOTH, None),  # a maximum too low to have a zone below it
        (2.0 - Z, q.BRIDGED, 1.0),  # it only falls
        (1.0 - 0.1 * np.sin(np.pi * Z / 0.4) ** 2, q.BRIDGED, 0.9),
        (2.0 - Z - 1.4 * np.exp(-((Z / 0.1) ** 4)) + RIPPLE, q.BRIDGED, 1.0),
    ],
)
def test_where_there_is_no_zone(shear, status, level):
    dip = dip_of(Z, shear, 0.4)
    assert q.state_of(dip) == status
    assert np.isnan(dip["start"]) and np.isnan(dip["stop"])
    if level is not None:
        assert dip["level"] == pytest.approx(level, abs=0.02)


def test_the_scale_of_shear_and_of_depth_does_not_matter():
    one = dip_of(Z, below_a_wave(Z, 4.0), 0.4)
    other = dip_of(3e-4 * Z, 7e8 * below_a_wave(Z, 4.0), 1.2e-4)
    assert (other["level"], other["ratio"]) == pytest.approx((one["level"], one["ratio"]), rel=1e-9)
    assert other["start"] == pytest.approx(3e-4 * one["start"], rel=1e-9)


def test_dips_are_found_together_as_alone_and_without_what_is_not_known():
    deep, flat = below_a_wave(Z, 4.0), below_a_wave(Z, 0.2)
    below = Z >= 0.02
    cut = np.where(below, deep, np.nan)
    alone = [dip_of(Z, deep, 0.4), dip_of(Z, flat, 0.4), dip_of(Z[below], deep[below], 0.4)]
    for together, one in zip(q.shear_dips(Z, np.array([deep, flat, cut]), 0.4), alone, strict=True):
        np.testing.assert_array_equal(list(together.values()), list(one.values()))
    both = q.shear_dips(Z, np.array([deep, flat]), 0.4)
    assert [dip["level"] for dip in both] == [dip["level"] for dip in alone[:2]]


@pytest.mark.parametrize("columns", [41, 120, 777])
def test_mean_shear_of_the_sliding_smooth_contact(columns):
    """On the surface under the contact tau1 is mu p0; a window's columns need not end at a."""
    hertz = HertzContact(1e-3, 1e9, 0.5 * np.pi * 1e6, 1e-2, 1e11)
    window = SimpleNamespace(x=np.linspace(-1.37e-3, 1.5e-3, columns))
    tau1 = hertz_stress(hertz, window.x, np.zeros((1, 1)), 0.2).tau1
    smooth = SimpleNamespace(hertz=hertz, window=window)
    mean = q.mean_shear(smooth, tau1)
    assert mean == pytest.approx(0.2e9, rel=0.1 / columns)
    cut = np.where(np.abs(window.x) < 0.3e-3, np.nan, tau1)  # above a rough boundary
    assert q.mean_shear(smooth, cut) == pytest.approx(0.2e9, rel=0.1 / columns)


@pytest.mark.parametrize(
    ("friction", "status"), [(0.0, q.SMOOTH), (0.23, q.SMOOTH), (0.25, q.BRIDGED), (0.4, q.BRIDGED)]
)
def test_friction_alone_bridges_a_smooth_body(friction, status):
    hertz = HertzContact(1.0, 1.0, 0.5 * np.pi, 1.0, 1.0)
    window = SimpleNamespace(x=np.linspace(-1.2, 1.2, 961))
    tau1 = hertz_stress(hertz, window.x, Z[:, None], friction).tau1
    shear = q.mean_shear(SimpleNamespace(hertz=hertz, window=window), tau1)
    assert q.state_of(dip_of(Z, shear, 0.5)) == status


@pytest.fixture
def wavy():
    return run_of(WAVY, "half_plane")


def test_a_wavy_body_has_a_zone_that_friction_bridges(wavy):
    still, sliding = q.zones_of(wavy.findings[q.NAME])
    assert (still.state, sliding.state) == (q.QUIESCENT, q.BRIDGED)
    values = {name: figure.value for name, figure in still.figures.items()}
    assert 0.0 < values["start"] < values["depth"] < values["stop"]
    assert "start" not in sliding.figures
    assert sliding.figures["level"].value > q.QUIET > values["ratio"]
    assert still.asperities == len(wavy.problem.asperities) + 1
    assert sliding.bridged > still.bridged
    for row in wavy.findings[q.NAME].table(q.ASPERITIES, friction=0.0).rows():
        assert 0.0 < row["length"] < 25e-6
        assert abs(row["x"]) < wavy.problem.hertz.half_width


@pytest.mark.parametrize(
    ("half_range", "depth", "points"),
    [(1.0, 1.0, [200, 60]), (2.2, 1.6, [200, 60]), (1.5, 0.8, [400, 90]), (1.5, 1.0, [90, 30])],
)
def test_finer_elements_and_other_windows_find_it_within_its_uncertainty(
    wavy, half_range, depth, points
):
    stated = q.zones_of(wavy.findings[q.NAME])[0].figures
    other = WAVY | {"stress": {"half_range": half_range, "depth": depth, "points": points}}
    posed = problem(other)
    level = half_plane_at(posed, 0.5 * wavy.runs["half_plane"].finest.grid.pitch, fields=True)
    zone = q.zone_of(posed, level)
    a = posed.hertz.half_width
    for name in q.QUANTITIES:
        value, place = stated[name].value, "depth" in name or name in ("start", "stop")
        reading = 2e-3 * (a if place else value)
        assert stated[name].numerical * stated[name].scale < reading
        assert zone[name] == pytest.approx(value, abs=reading)


def test_on_a_bound_it_is_inconclusive(wavy, monkeypatch):
    """The ratio of the same levels is as far from a bound as it is uncertain, or farther."""
    ratio = q.zones_of(wavy.findings[q.NAME])[0].figures["ratio"]
    size = ratio.numerical * ratio.scale
    case = wavy.solved.case(0.0)
    posed = case, case.runs["half_plane"]
    for off, state in ((0.5, q.UNCLEAR), (3.0, q.QUIESCENT)):
        monkeypatch.setattr(q, "QUIET", ratio.value + off * size)
        assert q.zone_figures(*posed)[1] == state


def test_scenes_without_fields_or_roughness_have_none(finish):
    assert q.NAME not in finish(STEADY).findings
    outcome = run_of({k: v for k, v in WAVY.items() if k != "stress"}, "half_plane")
    assert q.NAME not in outcome.findings


@pytest.mark.parametrize(("name", "value"), [("half_range", 0.9), ("depth", 0.6)])
def test_a_field_that_ends_before_says_so(name, value):
    outcome = run_of(WAVY, "half_plane", stress={name: value, "points": [60, 20]})
    why = outcome.findings[q.NAME].said(WHY_NOT)
    assert why == f"stress.{name} is less than {'1' if name == 'half_range' else '0.8'} a"
    [block] = parts_of(q.STUDY, outcome)
    assert Names([(WHY_NOT, why)]) in block.items and q.lines(outcome) == []


def test_table_facts_and_line_say_what_the_figures_are(wavy):
    [block], [(_, line)] = parts_of(q.STUDY, wavy), q.lines(wavy)
    _, _, table, facts, _ = block.items
    states = [text for name, text in facts.rows if name.startswith(f"{q.STATE}, half-plane")]
    assert states == [q.QUIESCENT, q.BRIDGED]
    level = q.zones_of(wavy.findings[q.NAME])[0].figures["level"].value
    assert table.rows[0][:2] == (q.QUANTITIES["level"].label, "0")
    assert float(table.rows[0][2].split()[0]) == pytest.approx(level, rel=5e-3)
    assert line.startswith("friction 0: 0.") and "; friction 0.3: bridged, least shear 0.8" in line
