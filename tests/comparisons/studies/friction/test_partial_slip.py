"""Partial slip from the scene to its files: both models, uncertainties, verdicts, wrong input."""

from dataclasses import replace

import numpy as np
import pytest
from exact_partial_slip import SlippingContact
from scenes import STEEL, STEEL_PAIR, changed, half_plane_at, problem, resolved, run_of

from analytic.stress.fatigue import ruiz
from comparisons.drawing.blocks import TextTable
from comparisons.figures.quantity import MODELS
from comparisons.judging.presentation import parts_of
from comparisons.judging.study import Case, unsolved
from comparisons.models.plan import make_plan
from comparisons.output.result import read_result
from comparisons.runs.run import run
from comparisons.scenes.scene import Scene
from comparisons.studies.friction import PARTIAL_SLIP
from comparisons.studies.friction.finite_elements import finite_element_slip
from comparisons.studies.friction.half_planes import half_plane_slip
from comparisons.studies.friction.partial_slip import COMPARED, solvers

SMOOTH = STEEL_PAIR | {
    "load": {"per_length": 1e6, "friction": [0.1, 0.3]},
    "partial_slip": {"loads": [0.5, -0.5, 0.5]},
    "stress": {"points": [120, 40]},
    "budget": {"effects": False},
}
BULK = 100e6


def values(outcome, source: str = "half_plane") -> dict[str, float]:
    known = outcome.figures.of(study="partial_slip", source=source, against=None)
    return {figure.quantity: figure.value for figure in known}


@pytest.fixture(scope="module")
def cycled(tmp_path_factory, drawn_only):
    with drawn_only(*PARTIAL_SLIP.pictures):
        return run(resolved(SMOOTH), tmp_path_factory.mktemp("slip") / "out", MODELS)


def test_a_cycle_is_covered_by_what_is_stated(cycled):
    """Both models, at the larger friction, against Mindlin and Deresiewicz."""
    exact = SlippingContact(cycled.problem.hertz, 0.3, 0.5)
    trailing = -np.linspace(0.0, 1.0, 20_001) * exact.hertz.half_width
    parts = exact.surface_stress(trailing), exact.traction(trailing), exact.slip(trailing)
    wanted = {
        # the way back has slipped over what the way out did
        "stick_length": 2.0 * exact.stick_half_width,
        "energy_of_cycle": exact.energy_of_cycle,
        "edge_tension": exact.edge_tension,
        "slip_amplitude": float(exact.slip(cycled.problem.hertz.half_width)),
        "ruiz": float(ruiz(*parts).max()),
        # at the trailing edge, where there is no traction, on the upright plane; E' = 2 E*
        "smith_watson_topper": 0.5 * exact.edge_tension**2 / exact.hertz.combined_modulus,
    }
    for source in MODELS:
        known = cycled.figures.of(study="partial_slip", source=source, against=None)
        for quantity, value in wanted.items():
            figure = known.one(quantity=quantity)
            assert figure.friction == 0.3
            # three factors of which each is uncertain at an end of contact
            ceiling = 0.04 if quantity in ("ruiz", "smith_watson_topper") else 0.02
            assert abs(figure.value / value - 1.0) <= figure.numerical < ceiling


def test_the_largest_tension_of_rough_contact_is_at_an_end_of_it():
    """Hats of this pitch alone make it a sixth less, by those of an eighth of it 935 MPa."""
    waves = {"kind": "sinusoid", "wavelength": 60e-6, "amplitude": 0.2e-6}
    load = {"hertz_peak_pressure": 1e9, "friction": 0.3}
    roller = {"radius": 7.5706e-3, **STEEL}
    posed = problem(SMOOTH | {"roller": roller, "profile": waves, "load": load})
    level = half_plane_at(posed, posed.pitches[-1])
    figures = half_plane_slip(posed, level, 1).figures
    tension = 931.1e6
    assert figures["edge_tension"] == pytest.approx(tension, rel=2e-3)
    reversed_tension = 0.5 * tension**2 / posed.modulus
    assert figures["smith_watson_topper"] == pytest.approx(reversed_tension, rel=0.01)


def test_surfaces_that_are_apart_do_not_slip():
    """Steel on a softer body, which touches elsewhere at the other end of a cycle: by relative
    movement alone the largest amplitude would be 0.66 um, where they touch it is 0.55."""
    tables = {
        "roller": {"radius": 21e-3, "youngs_modulus": 215e9, "poissons_ratio": 0.28},
        "body": {"youngs_modulus": 46e9, "poissons_ratio": 0.22},
        "load": {"per_length": 2.6e5, "friction": 0.35},
        "partial_slip": {"loads": [0.6, -0.6, 0.6]},
    }
    posed = problem(tables)
    level = half_plane_at(posed, posed.pitches[1])
    slipped = half_plane_slip(replace(posed, window=None), level, 16)
    pressures = np.array([state.normal.pressure for state in slipped.states])
    apart = (pressures.min(axis=0) == 0.0) & (pressures.max(axis=0) > 0.0)
    assert apart.sum() >= 2
    assert slipped.figures["slip_amplitude"] == pytest.approx(0.549e-6, rel=0.01)
    span = slipped.amplitude(slipped.grid.x)
    always = pressures.min(axis=0) > 0.0
    assert span[apart & (pressures[-1] > 0.0)].max() < span[always].max()


def test_models_agree_within_their_uncertainty(cycled):
    """Both bodies are half-planes in either model."""
    differences = cycled.figures.of(study="partial_slip", against="finite_element")
    assert [figure.quantity for figure in differences] == list(COMPARED)
    for figure in differences:
        assert abs(figure.value) <= figure.numerical and figure.verdict == "agree"


def test_page_tables_and_files_have_it(cycled):
    page = (cycled.directory / "report.html").read_text(encoding="utf-8")
    assert "Partial slip" in page and "1 (half-plane), 1 (finite elements)" in page
    columns = np.genfromtxt(cycled.directory / "half_plane/partial_slip.csv", delimiter=",").T
    assert np.all(np.abs(columns[2][1:]) <= columns[1][1:] * (1.0 + 1e-9))
    result = read_result(cycled.directory)
    lengths = [r["value"] for r in result.figures.rows if r["quantity"] == "stick_length"]
    assert lengths[0] == values(cycled)["stick_length"]


def test_bulk_stress_moves_the_zone_and_adds_itself():
    """Nowell and Hills, on the half-plane."""
    scene = changed(SMOOTH, partial_slip={"loads": [0.5], "bulk_stress": BULK})
    outcome = run_of(scene, "half_plane")
    exact = SlippingContact(outcome.problem.hertz, 0.3, 0.5, BULK)
    zones = outcome.findings["partial_slip"].table("stick_zones")
    start, stop = (zones.columns[end].values[0] for end in ("start", "stop"))
    pitch = outcome.runs["half_plane"].finest.grid.pitch
    assert 0.5 * (start + stop) == pytest.approx(exact.offset, abs=0.1 * pitch)
    without = values(run_of(scene, "half_plane", partial_slip={"bulk_stress": 0}))
    moved = values(outcome)["edge_tension"] - without["edge_tension"]
    assert BULK < moved < 2.0 * BULK  # the zone moves towards +x, off the trailing edge


@pytest.mark.parametrize("roller", [STEEL, {"rigid": True}], ids=["elastic", "rigid"])
def test_unlike_bodies_are_loaded_alike_by_both_models(roller):
    """Both take few increments, the same of both, on the coarsest elements."""
    radius = {"radius": 8e-3}
    scene = SMOOTH | {"roller": radius | roller, "partial_slip": {"load": 0.5}}
    scene = scene | {"body": {"youngs_modulus": 70e9, "poissons_ratio": 0.33}}
    posed = replace(problem(changed(scene, load={"friction": 0.3})), window=None)
    level = half_plane_at(posed)
    one = half_plane_slip(posed, level, 3)
    other = finite_element_slip(posed, level, 3)
    assert all(state.converged for state in (*one.states, *other.states))
    for name, value in one.figures.items():
        assert value == pytest.approx(other.figures[name], rel=0.02)


@pytest.mark.parametrize("factor, verdict", [(1.0, "agree"), (1.4, "differ")])
def test_an_answer_from_outside_may_have_tractions(tmp_path, factor, verdict):
    """The exact ones, and those of a load that is larger."""
    scene = changed(SMOOTH, partial_slip={"loads": [0.5]}, load={"friction": 0.3})
    hertz = problem(scene).hertz
    x = np.linspace(-1.2, 1.2, 1201) * hertz.half_width
    traction = SlippingContact(hertz, 0.3, 0.5 * factor).traction(x)
    rows = 1e3 * x, 1e-6 * hertz.pressure(x), 1e-6 * traction
    np.savetxt(tmp_path / "answer.csv", np.column_stack(rows), delimiter=",", header="x,p,q")
    source = {"file": "answer.csv", "shear": 2, "units": {"length": "mm", "stress": "MPa"}}
    scene = scene | {"answers": {"exact": source}}
    scene.pop("stress")
    outcome = run_of(resolved(scene, folder=tmp_path), "half_plane")
    known = outcome.figures.of(study="partial_slip", source="exact")
    assert known.one(quantity="stick_length", against="half_plane").verdict == verdict
    norm = known.one(quantity="traction_l2")
    assert (norm.value < norm.numerical < 0.03) == (verdict == "agree")
    [block] = parts_of(PARTIAL_SLIP, outcome)
    [table] = [item for item in block.items if isinstance(item, TextTable)]
    [row] = [row for row in table.rows if row[0].startswith("length that sticks")]
    assert row[table.head.index("exact")] and row[-1] == verdict


def test_of_a_body_that_flows_the_half_plane_stands_alone():
    flows = {"finite_element": {"plastic": True}, "body": {"yield_stress": 2e9}}
    posed = problem(changed(SMOOTH, load={"friction": 0.3}, **flows))
    case = Case(posed, dict.fromkeys(MODELS))
    solved = replace(unsolved(posed, make_plan(posed, MODELS)), cases=(case,))
    assert tuple(solvers(solved)) == MODELS[:1]


def test_the_library_has_a_fretting_cycle():
    slip = Scene.read("fretting").partial_slip
    assert slip.path[0] == slip.path[-1] == slip.largest


def test_unlike_bodies_may_be_pressed_alone():
    scene = changed(SMOOTH, body={"youngs_modulus": 70e9}, load={"friction": 0.1})
    scene = scene | {"partial_slip": {"loads": [0], "increments": 2}}
    scene.pop("stress")
    outcome = run_of(scene, "half_plane")
    known = values(outcome)
    assert 0.0 < known["stick_ratio"] < 1.0 and "tangential_displacement" not in known
    assert known["held_pressure"] > outcome.problem.hertz.peak_pressure
