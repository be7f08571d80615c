"""Flash temperatures from the scene to its files: both models, uncertainties, verdict, report.
Thermal stresses of coated bodies by finite elements."""

from dataclasses import replace
from pathlib import Path

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
    refound,
    resolved,
    run_of,
)

from comparisons.drawing.blocks import TextTable
from comparisons.figures.quantity import MODELS
from comparisons.judging.presentation import lines_of, parts_of
from comparisons.models.problem import Levels
from comparisons.models.readings import ends_of_contact, left_out_at_ends, stresses_at
from comparisons.output.junit import run_cases_of
from comparisons.output.result import read_result
from comparisons.runs.run import Known, run
from comparisons.studies.heat import STUDY
from comparisons.studies.heat.finite_elements import finite_element_stress, solved_heat
from comparisons.studies.heat.half_space import HEAT_QUANTITIES, HEATED, WITHOUT
from comparisons.studies.heat.show import heat_facts

TRACE = changed(GROUND, load={"friction": [0.0, 0.1]}) | {
    "heat": {"speed": 1.0, **BOTH_CONDUCT},
    "budget": {"effects": False},
    "resolution": {"pitch": "1.6 um"},
    "finite_element": {"growth": 0.5},
}


def differences(outcome):
    """Differences of both models, in the order of the quantities."""
    return outcome.figures.of(study="heat", against="finite_element")


def value(outcome, quantity, source="half_plane"):
    return outcome.figures.one(study="heat", quantity=quantity, source=source, against=None).value


@pytest.fixture(scope="module")
def rough(tmp_path_factory, drawn_only):
    out = tmp_path_factory.mktemp("heat") / "out"
    with drawn_only():
        return run(resolved(TRACE), out, MODELS, known=Known(levels=Levels(3)))


def test_a_rough_trace_has_one_flash_temperature_by_both_models(rough):
    """Both solve one problem but for the roller, a disc in the finite elements: what is left of
    their difference is numerical, and within what is stated."""
    for figure in differences(rough):
        roller, other_pressures = figure.parts
        assert roller.uncertainty < 1e-4 < 1e-3 < abs(roller.value) < 0.02
        assert abs(figure.value - roller.value) < figure.numerical < 0.02
        assert figure.verdict == "agree" and figure.friction == 0.1
        assert abs(other_pressures.value) < figure.numerical
    assert value(rough, "flash_temperature") > 100.0


def test_figures_in_result_json(rough):
    figures = read_result(rough.directory).figures
    flash = figures.of(study="heat", quantity="flash_temperature")
    assert flash.one(against="finite_element").verdict == "agree"
    one, other = (flash.one(source=model, against=None) for model in MODELS)
    assert other.value == pytest.approx(one.value, rel=0.02)
    assert one.place[0] < 0.0  # the hot end is behind
    rules = {"equal_largest", "equal_mean", "conductivities"}
    assert {figure.source for figure in flash} - set(MODELS) == rules


def test_what_is_judged_has_a_case_for_continuous_integration(rough):
    """Whatever decides the exit status: a temperature that differs is no green run."""
    cases = {case.name: case for case in run_cases_of(rough) if case.classname.endswith(".heat")}
    assert set(cases) == {f"{name}, friction 0.1" for name in HEAT_QUANTITIES}
    assert {case.result for case in cases.values()} == {"passed"}
    heat = [replace(f, bounds=f.bounds and (-1e-9, 1e-9)) for f in rough.findings["heat"].figures]
    differs = refound(rough, "heat", figures=tuple(heat))
    assert {f.verdict for f in differs.judged.of(study="heat")} == {"differ"}
    assert differs.exit_status == 1
    cases = [case for case in run_cases_of(differs) if case.classname.endswith(".heat")]
    assert {case.result for case in cases} == {"failure"}


def test_temperatures_as_csv(rough):
    for model in MODELS:
        path = Path(rough.directory) / model / "temperature.csv"
        x, heat, into_body, body, _ = np.loadtxt(path, delimiter=",", skiprows=1).T
        heated = rough.data("heat").contacts[model]
        assert x == pytest.approx(heated.x, abs=1e-12)
        assert body == pytest.approx(heated.body, rel=1e-9)
        assert heat.max() == pytest.approx(0.1 * rough.runs[model].finest.solution.pressure.max())
        assert into_body == pytest.approx(heated.into_body, rel=1e-9)
        assert 0.5 < heated.fraction < 1.0


def test_below_the_surface_it_cools(rough):
    study = rough.data("heat")
    for field in study.field:
        assert field.shape == (len(study.z), len(study.x))
        assert field.max() == pytest.approx(field[0].max())
        assert np.all(np.diff(field.max(axis=1)) < 0.0)
    largest = value(rough, "flash_temperature")
    assert study.field[0].max() == pytest.approx(largest, rel=5e-3)


def test_one_model_alone():
    outcome = run_of(TRACE, "half_plane", levels=Levels(2), heat={"slide_to_roll": -2.0})
    [flash] = outcome.figures.of(study="heat", quantity="flash_temperature", source="half_plane")
    assert (flash.against, flash.verdict) == (None, None)
    assert 0.0 < flash.numerical < 0.05
    assert value(outcome, "peclet_number", "body") == 0.0


STRESSED = QUICK | {
    "load": {"hertz_peak_pressure": 1e9, "friction": [0.0, 0.1]},
    "heat": {"speed": 10.0, "stresses": True, "body_expansion": "12 um/m/K", **BOTH_CONDUCT},
}


@pytest.fixture(scope="module")
def stressed(tmp_path_factory, drawn_only):
    out = tmp_path_factory.mktemp("stressed") / "out"
    with drawn_only(*STUDY.pictures):
        return run(resolved(STRESSED), out, MODELS)


def test_thermal_stresses_by_both_models(stressed):
    """Transforms and elements, whose meshes and boundaries differ, have one answer; without heat
    it is that of the comparison."""
    tau1, depth, along = differences(stressed)[3:]
    for figure in (tau1, depth, along):
        assert abs(figure.value) < figure.numerical + 3e-3  # held 400 a away
        assert figure.numerical < 0.05
    assert tau1.verdict == depth.verdict == "agree"
    shear = stressed.solved.case(0.1).runs["half_plane"].finest.stress.extremes["tau1"]
    assert value(stressed, "tau1_heated_without_heat") == shear.value
    assert value(stressed, "tau1_depth_heated_without_heat") == shear.z
    # 2 mu p0 at the trailing edge (Johnson 1985, section 7.1), which heat takes back
    cold, other = (value(stressed, "sx_heated_without_heat", model) for model in MODELS)
    assert cold == pytest.approx(0.2e9, rel=2e-4) and other == pytest.approx(0.2e9, rel=1e-2)
    for model in MODELS:
        surface = stressed.data("heat").stresses[model]
        assert value(stressed, "sx_heated", model) == 0.0 > surface.sx[0].max()
        assert surface.sx[0].argmax() in (0, len(surface.x) - 1)  # it ends far off


def test_thermal_stresses_go_with_expansion_and_leave_temperatures(stressed):
    without = run_of(STRESSED, "half_plane", heat={"body_expansion": "1e-9 1/K"})
    for name in HEATED:
        assert value(without, name) == pytest.approx(value(without, f"{name}{WITHOUT}"), rel=1e-3)
    assert value(without, "flash_temperature") == value(stressed, "flash_temperature")


def test_thermal_stresses_in_every_output(stressed):
    result = read_result(stressed.directory)
    stresses = result.figures.of(study="heat", source="half_plane", against=None)
    warm, cold = (stresses.one(quantity=f"sx_heated{name}") for name in ("", "_without_heat"))
    assert warm.value == 0.0 < cold.value and warm.place is None
    stress = stressed.data("heat").stresses["finite_element"]
    place = stress.x[stress.sx[1].argmax()]
    assert place == pytest.approx(-stressed.problem.hertz.half_width, rel=2e-3)
    page = (stressed.directory / "report.html").read_text()
    assert "<h2>Frictional heat</h2>" in page
    assert "Rise of temperature below the surface of the roller" in page
    said = "Last, σx of the body&#39;s surface; wide and pale: without heat."
    assert said in page
    [block], [(_, said)] = parts_of(STUDY, stressed), lines_of(STUDY, stressed)
    assert "agree" in said
    [table] = [item for item in block.items if isinstance(item, TextTable)]
    shown = {row[0]: row for row in table.rows}
    for name in HEATED:
        assert shown[STUDY.quantities[name].label][-1] == "agree"
        assert float(shown[STUDY.quantities[f"{name}{WITHOUT}"].label][2].split()[0]) > 0.0
    assert shown[STUDY.quantities[f"sx_heated{WITHOUT}"].label][3] == "199 ± 5 MPa"
    rows = {row["quantity"]: row for row in result.figures.rows if not row["against"]}
    assert rows["tau1_heated"]["unit"] == "Pa" and rows["tau1_depth_heated"]["unit"] == "m"


def test_a_slab_is_no_half_space():
    tables = changed(TRACE, body={"thickness": "60 um"}, heat={"speed": 0.05, "tolerance": 0.02})
    tables["load"] = {"hertz_peak_pressure": 1e9, "friction": 0.1}
    del tables["profile"], tables["resolution"]
    outcome = run_of(tables, levels=Levels(2))
    figure = differences(outcome)[0]
    assert figure.verdict == "differ"
    assert outcome.exit_status == 1
    assert list(outcome.data("heat").contains) == ["thickness", "roller"]
    effects = {part.name: part.value for part in figure.parts}
    # without the slab more heat enters the roller: together they are less than their sum
    assert 1.0 < figure.value < effects["thickness"] < 2.0
    assert -0.02 < effects["roller"] < -0.002
    assert [fact for fact, _ in heat_facts(outcome)][-2:] == [
        "change of the largest rise without the body's thickness, its base at its bulk temperature",
        "change of the largest rise without the roller as a disc",
    ]


PLAIN = changed(STRESSED, load={"friction": 0.1})
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
    """Arguments of `finite_element_stress`, on the coarsest level."""
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
