"""The verdict in one sentence: the number that decides it, and what it is made of."""

import math
from dataclasses import replace

from scenes import judging, posed, refound, unconverged

from comparisons.output.headline import headline
from comparisons.studies.model_error.model_error import Estimate, ModelError
from comparisons.studies.model_error.selection import EffectSelection
from comparisons.studies.study import Run

TOLERANCE = 0.02
NONE = EffectSelection(frozenset(), frozenset(), {}, {}, {})


def own(quantity: str, value: float, uncertainty: float, **effects: float) -> ModelError:
    shares = {name: Estimate(size, 1e-4) for name, size in effects.items()}
    return ModelError(quantity, 0.0, shares, 0.0, value, uncertainty)


def judged(outcome: Run, *errors: ModelError, selection: EffectSelection = NONE) -> Run:
    """A run whose half-plane has these errors, all judged."""
    scene = outcome.problem.scene
    tolerance = {error.quantity: TOLERANCE for error in errors}
    problem = replace(outcome.problem, scene=judging(scene, tolerance))
    budget = replace(outcome.data("model_error"), model_errors=errors, selection=selection)
    figures = tuple(budget.figures(tolerance))
    return refound(posed(outcome, problem=problem), "model_error", figures=figures, data=budget)


def test_agreement_names_what_is_nearest_to_its_tolerance(smooth_outcome: Run):
    errors = own("peak_pressure", 1e-3, 1e-4), own("tau1_max", -0.0123, 1e-3)
    said = headline(judged(smooth_outcome, *errors))
    assert said.kind == "holds"
    assert "both judged errors are within their tolerances" in said.sentence
    assert (
        "principal shear stress τ₁ is −1.2 % (tolerance 2 %, uncertainty 0.10 %)" in said.sentence
    )


def test_it_says_no_more_than_the_uncertainty_supports(smooth_outcome: Run):
    for value, uncertainty, words in (
        (0.0012, 0.0138, "is +0.1 %"),
        (-0.0004, 0.0138, "is 0.0 % (tol"),
        (0.00123, 0.0001, "is +0.12 %"),
    ):
        said = headline(judged(smooth_outcome, own("peak_pressure", value, uncertainty)))
        assert said.kind == "holds" and words in said.sentence
        assert "the one judged error is within its tolerance" in said.sentence


def test_failure_names_what_is_farthest_outside_and_the_dominant_effect(smooth_outcome: Run):
    errors = (
        own("peak_pressure", 0.5, 1e-3),
        own("contact_length", -0.7, 1e-3, finite_size=0.5, exact_circle=0.1),
        own("tau1_max", 0.0, 1e-3),
    )
    said = headline(judged(smooth_outcome, *errors))
    assert said.kind == "fails"
    assert "contact length is −70 %" in said.sentence
    assert "dominated by finite thickness or width" in said.sentence
    assert "1 more of 3 judged errors is outside" in said.sentence
    shared = own("contact_length", -0.7, 1e-3, finite_size=0.3, exact_circle=0.3)
    assert "dominated" not in headline(judged(smooth_outcome, shared)).sentence


def test_where_effects_interact_it_names_no_culprit(smooth_outcome: Run):
    error = own("contact_length", -0.7, 1e-3, finite_size=0.5, exact_circle=0.1)
    said = headline(judged(smooth_outcome, replace(error, interaction=0.6))).sentence
    assert "the effects interact" in said and "dominated" not in said
    beside = headline(judged(smooth_outcome, replace(error, interaction=0.4))).sentence
    assert "dominated by finite thickness or width" in beside and "interact" not in beside


def test_a_verdict_says_the_law_of_elasticity_that_it_leans_on(smooth_outcome: Run):
    """Where the scene gives it; else its spread counts, and no law is leaned on."""
    error = own("peak_pressure", 1e-3, 1e-4)
    strained = replace(NONE, added=frozenset({"finite_strain"}))
    given = headline(judged(smooth_outcome, error, selection=strained)).sentence
    assert "uncertainty 0.010 %), with neo-Hookean elasticity." in given
    estimates = {"law_of_elasticity": {"peak_pressure": 1e-3}}
    spread = replace(strained, estimates=estimates, negligible=estimates)
    assert "elasticity" not in headline(judged(smooth_outcome, error, selection=spread)).sentence


def test_a_norm_has_no_sign(smooth_outcome: Run):
    assert (
        "difference is 9.0 %"
        in headline(judged(smooth_outcome, own("pressure_l2", 0.09, 1e-3))).sentence
    )


def test_inconclusive_by_uncertainty_or_by_what_is_not_modelled(smooth_outcome: Run):
    said = headline(judged(smooth_outcome, own("contact_length", 0.01, math.inf)))
    assert said.kind == "inconclusive"
    assert "uncertainty that reaches across the tolerance" in said.sentence
    sizes = {"plastic_flow": {"contact_length": 0.1}, "exact_circle": {"contact_length": 0.001}}
    missing = EffectSelection(
        frozenset(),
        frozenset(),
        {"exact_circle": sizes["exact_circle"]},
        {"plastic_flow": "the body has no yield stress"},
        sizes,
    )
    said = headline(judged(smooth_outcome, own("contact_length", 1e-3, 1e-4), selection=missing))
    assert said.kind == "inconclusive"
    assert "but plastic flow, which is not modelled (the body has no yield" in said.sentence
    assert "may change it by 10 % (estimate)" in said.sentence
    assert "plastic = true, with body.yield_stress, computes it" in said.next
    said = headline(judged(smooth_outcome, own("contact_length", 0.05, 1e-4), selection=missing))
    assert said.kind == "inconclusive"
    assert "but plastic flow, which is not modelled (the body has no yield" in said.sentence
    assert "may change it by 10 % (estimate)" in said.sentence
    assert "plastic = true, with body.yield_stress, computes it" in said.next


def test_nothing_judged_is_no_verdict(smooth_outcome: Run):
    said = headline(judged(smooth_outcome))
    assert said.kind == "inconclusive" and "no figure has a tolerance" in said.sentence


def test_a_level_that_did_not_converge_is_named_in_few_digits(smooth_outcome: Run):
    said = headline(unconverged(smooth_outcome, "finite_element"))
    assert said.kind == "not converged"
    pitch = f"{1e6 * smooth_outcome.runs['finite_element'].finest.grid.pitch:#.3g}".rstrip(".")
    assert f"(finite elements, pressure elements of {pitch} µm)" in said.sentence
