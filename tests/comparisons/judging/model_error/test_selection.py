"""Selection of effects to compute: by estimate and tolerance, each for a reason."""

from dataclasses import replace

import pytest
from scenes import NEO_HOOKEAN, judging

from comparisons.judging.effects.catalogue import FLOW
from comparisons.judging.effects.estimates import Shown
from comparisons.judging.effects.selection import SHARE_OF_TOLERANCE, select_effects

RIGID = {"roller": {"rigid": True}}
DEEP = "tau1_max_depth"


def chosen(problem, peak=None, couplings=()):
    peak = peak or problem.hertz.peak_pressure
    return select_effects(problem, Shown(peak, peak, couplings))


def judged(problem, **tolerance):
    return replace(problem, scene=judging(problem.scene, tolerance))


def test_an_effect_is_computed_from_a_tenth_of_a_tolerance_on(problem_with):
    problem = problem_with(**RIGID)
    size = chosen(problem).estimates["exact_circle"]["peak_pressure"]
    above = judged(problem, peak_pressure=size / SHARE_OF_TOLERANCE * 0.999)
    below = judged(problem, peak_pressure=size / SHARE_OF_TOLERANCE * 1.001)
    assert "exact_circle" in chosen(above).added and "exact_circle" not in chosen(above).negligible
    assert "exact_circle" in chosen(below).negligible and "exact_circle" not in chosen(below).added
    assert chosen(below).not_modelled("peak_pressure")["exact_circle"] == size
    assert "exact_circle" not in chosen(above).not_modelled("peak_pressure")


def test_only_what_is_judged_asks_for_effects(problem_with):
    assert chosen(judged(problem_with(**RIGID))).added == frozenset()
    light = problem_with(**RIGID, load={"hertz_peak_pressure": 2e8})
    contact, depth = (chosen(judged(light, **{q: 0.02})).added for q in ("peak_pressure", DEEP))
    assert contact < depth
    assert chosen(judged(light, **{DEEP: 0.5})).added == depth  # no fewer where less is asked


def test_what_does_not_apply_is_not_spoken_of(problem_with):
    smooth = chosen(problem_with())
    absent = {"finite_size", "coating", "normal_tangential_coupling", "plastic_flow"}
    assert not absent & set(smooth.estimates)
    assert {"finite_roller", "finite_strain", "law_of_elasticity"} <= set(smooth.estimates)
    assert "finite_roller" not in chosen(problem_with(**RIGID)).estimates


def test_what_the_scene_has_is_neither_added_nor_missing(problem_with):
    selection = chosen(problem_with(**RIGID, finite_element={"roller_shape": "circle"}))
    assert selection.contained == {"exact_circle"}
    assert "exact_circle" not in selection.added | set(selection.negligible)
    assert "exact_circle" not in selection.not_modelled("peak_pressure")
    assert "exact_circle" in selection.whole


def test_finite_strain_that_cannot_be_solved_counts_with_its_estimate(problem_with):
    tables = {"body": {"yield_stress": 3e9}, "finite_element": {"plastic": True}}
    selection = chosen(problem_with(**tables))
    assert "flow is taken at small strains" in selection.impossible["finite_strain"]
    assert selection.not_modelled("peak_pressure")["finite_strain"] > 0.0


def test_a_cap_stands_for_flow_only_where_nothing_flows(problem_with):
    problem = problem_with(body={"hardness": 6e9})
    assert "plastic_flow" not in chosen(problem, peak=3.5e9).estimates  # below first yield
    capped = chosen(problem, peak=6e9)
    assert capped.estimates["plastic_flow"]["peak_pressure"] == pytest.approx(0.1)
    assert "no yield stress" in capped.impossible["plastic_flow"]


def test_a_coated_body_flows_as_any(problem_with):
    coating = {"thickness": 2e-6, "youngs_modulus": 400e9, "poissons_ratio": 0.2}
    problem = problem_with(body={"yield_stress": 1e9}, coating=coating)
    assert FLOW in chosen(problem, 4e9).added


def test_what_is_given_up_stands_with_its_reason(problem_with):
    selection = chosen(problem_with()).without(frozenset({"finite_roller"}), "its mesh failed")
    assert "finite_roller" not in selection.added
    assert selection.impossible["finite_roller"] == "its mesh failed"
    assert "finite_roller" in selection.not_modelled("peak_pressure")


def test_finite_deformation_is_chosen_below_a_cap_too(problem_with):
    wavy = {"kind": "sinusoid", "wavelength": 50e-6, "amplitude": 0.1e-6}
    for body in ({}, {"hardness": 6e9}):
        assert "finite_strain" in chosen(problem_with(**RIGID, profile=wavy, body=body)).added


def test_an_open_law_is_solved_where_it_matters_and_counts_with_its_estimate_else(problem_with):
    for problem in (problem_with(**RIGID), problem_with()):
        selection = select_effects(problem, Shown(2e9, 1.5e9))
        assert selection.laws and "finite_strain" in selection.added
        assert "law_of_elasticity" not in selection.not_modelled("peak_pressure")
        sizes = selection.estimates["law_of_elasticity"]
        [law] = selection.laws
        assert sizes["peak_pressure"] == pytest.approx(law.size * 2e9 / 210e9)
        assert sizes["contact_length"] == pytest.approx(0.75 * sizes["peak_pressure"])
        without = selection.without(frozenset({"finite_strain"}), "its elements are inverted")
        assert without.laws == () and without.impossible["law_of_elasticity"].startswith("its ele")
        assert without.not_modelled("peak_pressure")["law_of_elasticity"] == sizes["peak_pressure"]
    light = chosen(problem_with(load={"hertz_peak_pressure": 1e7}))
    assert light.laws == () and "law_of_elasticity" in light.negligible
    unlike = problem_with(roller={"youngs_modulus": 1e6 * 210e9})
    share = chosen(unlike, 2e9).estimates["law_of_elasticity"]["tau1_max"]
    assert share == pytest.approx(sizes["peak_pressure"], rel=1e-5)


def test_a_known_law_is_not_spoken_of(problem_with):
    known = {"body": NEO_HOOKEAN, "roller": NEO_HOOKEAN}
    selection = chosen(problem_with(**known), 2e9)
    assert selection.laws == () and "law_of_elasticity" not in selection.estimates


def test_coupling_too_small_to_matter_is_in_finite_deformation(problem_with):
    problem = problem_with(**RIGID, load={"friction": 1e-3})
    selection = chosen(problem)
    assert "finite_strain" in selection.added
    assert "normal_tangential_coupling" in selection.estimates
    assert "normal_tangential_coupling" not in selection.not_modelled("peak_pressure")
