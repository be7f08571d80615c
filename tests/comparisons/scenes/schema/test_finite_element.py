"""Bodies and the [finite_element] switches: what follows from others, and what is said."""

from types import SimpleNamespace

import pytest
from scenes import CONSTANTS, RIGID_PAIR, STEEL, STEEL_PAIR, changed, resolved

from analytic.material import Law
from analytic.material.hardening import Hardening
from comparisons.figures.figure import Findings
from comparisons.figures.quantity import MODELS
from comparisons.judging.study import unsolved
from comparisons.models.assumptions import assumptions_of
from comparisons.models.plan import make_plan
from comparisons.models.posing import problem_of
from comparisons.studies.problem import assumed

LOAD = {"load": {"per_length": 1e6, "friction": 0.2}}
ELASTIC, RIGID = STEEL_PAIR | LOAD, RIGID_PAIR | LOAD
WAVE = {"kind": "sinusoid", "wavelength": 5e-5, "amplitude": 1e-7}


def scene_of(tables: dict, finite_element: dict | None = None, **sections: dict):
    return resolved(changed(tables, **sections, finite_element=finite_element or {}))


@pytest.mark.parametrize(
    ("ratio", "as_written", "element"),
    [
        (0.49, {}, "P2"),
        (0.4901, {}, "P3"),
        (0.4999, {"element": "P2"}, "P2"),
        (0.4999, {"deformation": "finite", "coupled": True}, "P2"),
    ],
)
def test_elements_are_cubic_near_incompressibility(ratio, as_written, element):
    tables = {**RIGID, "body": {**STEEL, "poissons_ratio": ratio}}
    assert scene_of(tables, as_written).finite_element.element == element


@pytest.mark.parametrize(("profile", "is_rough"), [(WAVE, True), (None, False)])
def test_finite_deformation_takes_the_boundary_that_there_is(profile, is_rough):
    sections = {} if profile is None else {"profile": profile}
    finite = problem_of(scene_of(RIGID, {"deformation": "finite"}, **sections))
    assert finite.rough_boundary == is_rough
    assert not problem_of(scene_of(RIGID, {}, **sections)).rough_boundary


@pytest.mark.parametrize("switches", [{"deformation": "finite"}, {"plastic": True}])
def test_several_friction_coefficients_couple_where_each_moves_the_contact(switches):
    """And none where there is no friction."""
    body = {"yield_stress": 1e9}
    for friction in (0.0, 0.2, [0.0, 0.1]):
        scene = scene_of(RIGID, switches, body=body, load={"friction": friction})
        assert scene.finite_element.coupled == (friction != 0.0)


@pytest.mark.parametrize("load", [False, True])
@pytest.mark.parametrize("coupled_there", [None, False, True])
def test_coupling_is_that_of_the_load_unless_it_is_said(load, coupled_there):
    as_written = {} if coupled_there is None else {"coupled": coupled_there}
    scene = scene_of(RIGID, as_written, load={"coupled": load})
    assert scene.load.coupled == load
    assert scene.finite_element.coupled == (load if coupled_there is None else coupled_there)


def test_laws_of_elasticity_are_the_bodies_own():
    """And come back from the record as they were."""
    law = {"law": "murnaghan", "murnaghan": CONSTANTS}
    scene = scene_of(ELASTIC, body=law, roller={"law": "hencky"})
    assert scene.body.material.law == Law("murnaghan", (-150e9, -600e9, -700e9))
    assert scene.roller.material.law == Law("hencky")
    again = resolved(scene.tables)
    assert (again.body, again.roller) == (scene.body, scene.roller)
    assert scene_of(ELASTIC).body.material.law.name == "neo-hookean"


@pytest.mark.parametrize(
    ("fields", "law"),
    [
        ({"hardening_modulus": "1 GPa"}, Hardening(280e6, 1e9)),
        (
            {"hardening": {"table": [[0, "280 MPa"], [0.05, "340 MPa"]], "kinematic": "1 GPa"}},
            Hardening(280e6, table=((0.0, 280e6), (0.05, 340e6)), kinematic=1e9),
        ),
        (
            {"hardening": {"voce": {"rate": 12, "saturated": "400 MPa"}}},
            Hardening(280e6, voce=(400e6, 12.0)),
        ),
    ],
)
def test_laws_of_hardening_are_read_with_their_units_and_come_back(fields, law):
    scene = scene_of(ELASTIC, body={"yield_stress": "280 MPa", **fields})
    assert scene.body.flow_stress() == law
    assert resolved(scene.tables).body == scene.body


@pytest.mark.parametrize("support", ["opposite", "half disc", {"hub": "2 mm"}])
def test_a_support_of_the_roller_comes_back_as_it_was_given(support):
    scene = scene_of(ELASTIC, roller={"support": support})
    written = scene.tables["roller"]["support"]
    assert written == (support if isinstance(support, str) else {"hub": 2e-3})
    assert resolved(scene.tables).roller.support == scene.roller.support


@pytest.mark.parametrize(
    ("as_written", "said"),
    [
        ({}, "the gap is on the undeformed surface"),
        ({"deformation": "finite"}, "the deformed one, and the pressure acts along the current"),
        ({"roller_shape": "circle"}, "finite elements: it is an exact circle"),
        ({"roller_body": "disc"}, "finite elements: it is an elastic body of finite"),
        ({"coupled": True}, "finite elements: the sliding traction moves the surfaces"),
    ],
)
def test_assumptions_say_what_is_dropped(as_written, said):
    tables = {**ELASTIC, "body": {**STEEL, "poissons_ratio": 0.2}}
    spoken = "\n".join(assumptions_of(problem_of(scene_of(tables, as_written))))
    assert said in spoken
    assert ("finite elements:" in spoken) == bool(as_written)


@pytest.mark.parametrize(
    ("added", "said", "unsaid"),
    [
        ([], "\nelastic", "whole model"),
        (["plastic_flow"], "; whole model: von Mises' yield at 1 GPa, hardening by", "\nelastic"),
        (["finite_strain"], "; whole model: neo-Hookean elasticity, finite deformation", "yield"),
    ],
)
def test_assumptions_are_those_of_the_run_that_was_made(added, said, unsaid):
    metal = {"yield_stress": 1e9, "hardening_modulus": 2e9}
    problem = problem_of(scene_of(ELASTIC, body=metal, profile=WAVE))
    budget = SimpleNamespace(wholes=(None,), selection=SimpleNamespace(added=added, whole=added))
    solved = unsolved(problem, make_plan(problem, MODELS))
    spoken = "\n".join(["", *assumed(solved, Findings(data=budget))])
    assert said in spoken and unsaid not in spoken
    assert "between samples the surface is a cubic spline" in spoken
    assert spoken.endswith("whole model: as the half-plane") == bool(added)


@pytest.mark.parametrize(("thickness", "exact"), [(None, True), (1e-3, False)])
def test_friction_is_without_effect_on_half_planes_alone(thickness, exact):
    """Bodies are alike: a layer's surface is moved by friction."""
    body = STEEL if thickness is None else {**STEEL, "thickness": thickness}
    tables = {**ELASTIC, "body": body, "load": {**ELASTIC["load"], "friction": 0.1}}
    [spoken] = [s for s in assumptions_of(problem_of(scene_of(tables))) if "traction" in s]
    assert ("Dundurs" in spoken) is exact
