"""The verdict in one sentence: the number that decides it, and what it is made of; first the least
tolerance at which every judged figure holds."""

import math
from dataclasses import replace

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from scenes import asked_in_python, judging, posed, refound, unconverged, with_fields
from scenes import judged as figure_of

from comparisons.common.numbers import rounded_up, with_unit
from comparisons.figures.figure import Figure, Part
from comparisons.figures.quantity import QUANTITIES
from comparisons.figures.uncertainty import Uncertainty
from comparisons.judging import yielding
from comparisons.judging.effects.catalogue import FLOW, LAW
from comparisons.judging.effects.laws import open_laws
from comparisons.judging.effects.selection import EffectSelection
from comparisons.judging.model_error.model_error import INTERACTION
from comparisons.judging.study import Run
from comparisons.judging.verdict.headline import headline, validity, within_of

TOLERANCE = 0.02
NONE = EffectSelection(frozenset(), frozenset(), {}, {})


def error_of(quantity: str, value: float, uncertainty: float, **effects: float) -> Figure:
    shares = tuple(Part(name, size, 1e-4) for name, size in effects.items())
    return figure_of(quantity, value, uncertainty, parts=(*shares, Part(INTERACTION, 0.0)))


def judged(outcome: Run, *errors: Figure, selection: EffectSelection = NONE) -> Run:
    """A run whose half-plane has these errors, all judged."""
    scene = outcome.problem.scene
    tolerance = {error.quantity: TOLERANCE for error in errors}
    problem = replace(outcome.problem, scene=judging(scene, tolerance))
    budget = replace(outcome.data("model_error"), model_errors=errors, selection=selection)
    figures = tuple(budget.figures(tolerance))
    return refound(posed(outcome, problem=problem), "model_error", figures=figures, data=budget)


def test_failure_names_what_is_farthest_outside_and_the_dominant_effect(smooth_outcome: Run):
    errors = (
        error_of("peak_pressure", 0.5, 1e-3),
        error_of("contact_length", -0.7, 1e-3, finite_size=0.5, exact_circle=0.1),
        error_of("tau1_max", 0.0, 1e-3),
    )
    said = headline(judged(smooth_outcome, *errors))
    assert said.kind == "fails"
    assert "contact length, −70" in said.within.sentence
    assert "dominated by finite thickness or width" in said.sentence
    assert "2 of 3 judged errors are outside the tolerance of 2 %" in said.sentence
    shared = error_of("contact_length", -0.7, 1e-3, finite_size=0.3, exact_circle=0.3)
    assert "dominated" not in headline(judged(smooth_outcome, shared)).sentence


def test_a_range_by_the_law_is_said_with_its_ends_and_what_would_narrow_it(smooth_outcome: Run):
    error = error_of("peak_pressure", -0.01, 1e-4)
    error = replace(error, parts=(Part(LAW, 0.01, 0.015),), unknown={LAW: 0.015})
    spread = replace(NONE, laws=open_laws(smooth_outcome.problem.scene))
    said = headline(judged(smooth_outcome, error, selection=spread))
    assert said.kind == "inconclusive"
    assert "−2.5 to +0.50 ± 0.01" in said.within.sentence
    assert "the law of elasticity this error reaches across the tolerance of 2 %" in said.sentence
    assert said.next.startswith('body.material = "carbon steel" and roller.material = "carbon')
    named, linear = (asked_in_python(text, smooth_outcome.problem.scene) for text in said.paste)
    assert linear.body.law == linear.roller.law == "linear"
    assert named.body.solid == named.roller.solid == "carbon steel"
    # with the moduli that it was measured at
    assert all(law.is_scatter for law in open_laws(named))


def test_next_names_the_figures_to_use_or_the_tolerance_that_holds(smooth_outcome: Run):
    known = {"study": "contact", "source": "half_plane", "quantity": "contact_length"}
    length = smooth_outcome.figures.one(**known, friction=0.0).value
    error = replace(error_of("contact_length", -0.7, 1e-3), scale=length / 0.3)
    fails = headline(refound(judged(smooth_outcome, error), "ladder", figures=()))
    shown = with_unit(length / 0.3, "m")
    assert fails.next.startswith(f"take the whole model's contact length {shown} ± ")
    at_it = headline(judged(smooth_outcome, error_of("contact_length", 0.0199, 3.5e-4)))
    assert at_it.kind == "inconclusive"
    assert at_it.paste == ("crosscheck.run(scene, tolerance=0.021)",)
    unsure = headline(judged(smooth_outcome, error_of("contact_length", 0.01, 0.015)))
    assert unsure.kind == "inconclusive"
    assert unsure.paste == ("crosscheck.run(scene.changed({'budget.time': 600}))",)


def test_next_offers_no_figure_that_is_not_known_or_that_the_body_cannot_bear(smooth_outcome: Run):
    shear = smooth_outcome.figures.one(study="contact", source="half_plane", quantity="tau1_max")
    errors = [
        replace(error_of(name, -0.1, 1e-3), scale=shear.value / 0.9)
        for name in ("peak_pressure", "tau1_max")
    ]
    known = tuple(
        replace(error, study="ladder", source="whole", value=0.0, uncertainty=Uncertainty(parts))
        for error, parts in zip(
            judged(smooth_outcome, *errors).model_errors,
            ({"numerical": 0.28}, {"numerical": 0.01}),
            strict=True,
        )
    )
    run = refound(judged(smooth_outcome, *errors), "ladder", figures=known)
    unsure, _, offered = headline(run).next.partition("; ")
    said = "± 28 %: not known to the tolerance (finer levels take more budget.time)"
    assert unsure.endswith(said)
    assert offered.startswith("take the whole model's largest principal shear stress τ₁ ")
    flowing = replace(run.data("model_error"), selection=replace(NONE, contained={FLOW}))
    run = with_fields(run, {"body.yield_stress": 1e9, "finite_element.plastic": True})
    run = refound(run, "model_error", data=flowing)
    said = headline(run).next
    assert "±" in said
    assert ": more than the body bears, 577.4 MPa; take no figure in" in said  # Y/√3


def test_inconclusive_by_what_is_not_modelled(smooth_outcome: Run):
    sizes = {"plastic_flow": {"contact_length": 0.1}, "exact_circle": {"contact_length": 0.001}}
    why = {"plastic_flow": "the body has no yield stress"}
    missing = replace(NONE, impossible=why, estimates=sizes)
    for value in (1e-3, 0.05):
        error = error_of("contact_length", value, 1e-4)
        said = headline(judged(smooth_outcome, error, selection=missing))
        assert said.kind == "inconclusive"
        assert "Plastic flow, which is not modelled (the body has no yield" in said.sentence
        assert "may change this error by 10 % (estimate), across the tol" in said.sentence
        assert said.next.startswith("the flow is computed with body.yield_stress")
        assert said.paste == ("crosscheck.run(scene, law='linear')",)  # the value is not known


@pytest.mark.parametrize(
    ("errors", "kind", "said", "unsaid"),
    [
        # the one nearest to its tolerance is the largest, which is described already
        (
            [figure_of(), figure_of("tau1_max", -0.015)],
            *("holds", "Every judged error is within the tolerance of 2 %", "τ₁"),
        ),
        (
            [figure_of("contact_length", 0.01, math.inf)],
            *("inconclusive", "The uncertainty of this error reaches across the tol", "contact"),
        ),
        # one outside fails it, whatever is open beside it
        (
            [figure_of("contact_length", 0.04), figure_of("tau1_max", 0.01, 0.05)],
            *("fails", "1 of 2 judged errors is outside the tolerance of 2 %: contact", "τ₁"),
        ),
        # of other tolerances the nearest is another than the largest
        (
            [figure_of(tolerance=0.0032), figure_of("tau1_max", -0.015)],
            *("holds", "; nearest to its tolerance: peak pressure, +0.10 ± 0.20 % (tol", "τ₁"),
        ),
        (
            [figure_of(tolerance=0.002), figure_of("tau1_max", -0.015)],
            *("inconclusive", "The uncertainty of the error of peak pressure, +0.10", "τ₁"),
        ),
        # what no model shows can move an error either way
        (
            [
                figure_of(not_modelled={"plastic_flow": 0.03}),
                figure_of("tau1_max", not_modelled={"finite_roller": 0.001}),
            ],
            *("inconclusive", "Plastic flow, which is not modelled, may", "finite roller"),
        ),
        (
            [figure_of(value=-0.06, not_modelled={"plastic_flow": 0.03})],
            "fails",
            "1 of 1 judged errors is outside",
            "flow",
        ),
        # and is blamed where it is the larger unknown
        (
            [figure_of("tau1_max", -0.026, 0.0035, {"finite_strain": 0.046})],
            *("inconclusive", "this error by 4.6 %", "uncertainty"),
        ),
        (
            [figure_of("tau1_max", -0.026, 0.0065, {"finite_strain": 0.006})],
            *("inconclusive", "uncertainty of this error reaches across", "deformation"),
        ),
        ([], "inconclusive", "Nothing is judged.", "%"),
    ],
)
def test_the_verdict_names_what_decides_it(smooth_outcome: Run, errors, kind, said, unsaid):
    decided = headline(refound(smooth_outcome, "model_error", figures=tuple(errors)))
    assert decided.kind == kind
    assert said in decided.sentence and unsaid not in decided.sentence


def test_a_level_that_did_not_converge_is_named_in_few_digits(smooth_outcome: Run):
    failed = unconverged(smooth_outcome, "finite_element")
    said = headline(failed)
    assert said.kind == "not converged" and headline(failed) is said  # once a run
    pitch = f"{1e6 * smooth_outcome.runs['finite_element'].finest.grid.pitch:#.3g}".rstrip(".")
    assert f"(finite elements, pressure elements of {pitch} µm)" in said.within.sentence


SIZES = st.floats(0.0, 0.4, allow_subnormal=False)
ON_ONE_RUN = {"suppress_health_check": [HealthCheck.function_scoped_fixture], "deadline": None}


@st.composite
def errors(draw: st.DrawFn) -> list[Figure]:
    """Model errors of several quantities, each with a tolerance of its own."""
    return [
        figure_of(
            quantity,
            draw(st.sampled_from([-1.0, 1.0])) * draw(SIZES),
            draw(SIZES),
            {"exact_circle": draw(SIZES), "finite_roller": draw(SIZES)},
            draw(st.floats(1e-3, 0.9)),
        )
        for quantity in draw(st.lists(st.sampled_from([*QUANTITIES]), min_size=1, unique=True))
    ]


def of_errors(run: Run, figures: list[Figure]) -> Run:
    return refound(run, "model_error", figures=tuple(figures))


def verdict_at(figures: list[Figure], tolerance: float) -> str:
    return validity([replace(figure, bounds=(-tolerance, tolerance)) for figure in figures])


@settings(**ON_ONE_RUN)
@given(figures=errors())
def test_every_figure_holds_at_it_and_not_below(smooth_outcome: Run, figures: list[Figure]):
    within = within_of(of_errors(smooth_outcome, figures))
    assume(within.size > 1e-9)
    assert verdict_at(figures, within.size) == "holds"
    assert verdict_at(figures, 0.99 * within.size) != "holds"
    assert within.figure in figures
    shown = rounded_up(within.size)
    assert verdict_at(figures, shown) == "holds" and shown <= 1.1 * within.size
    assert f" {100.0 * shown:.6g} % here (largest: " in within.sentence


@given(size=st.floats(1e-12, 10.0))
def test_a_printed_tolerance_has_two_digits_and_is_never_below(size):
    assert size <= rounded_up(size) <= 1.1 * size
    assert float(f"{rounded_up(size):.2g}") == rounded_up(size) == rounded_up(rounded_up(size))


def test_the_largest_is_named_as_the_tables_have_it(smooth_outcome: Run):
    figures = figure_of(), figure_of("tau1_max", -0.0531, 0.0082, {"coating": 0.03})
    within = within_of(of_errors(smooth_outcome, figures))
    assert within.size == pytest.approx(0.0531 + 0.0082 + 0.03, rel=1e-12)
    assert within.sentence == (
        "The half-plane is right within 9.2 % here (largest: τ₁ max, −5.3 ± 0.82 %, 3.0 % not "
        "modelled)."
    )
    far = within_of(of_errors(smooth_outcome, [figure_of(value=-6.9)]))
    assert far.size == pytest.approx(6.902) and "is off by up to 700 % here" in far.sentence


def test_where_it_is_not_known_it_says_of_what_and_why(smooth_outcome: Run):
    def of(*figures: Figure) -> str:
        within = within_of(of_errors(smooth_outcome, figures))
        assert within.size is None
        return within.sentence.removeprefix("How wrong the half-plane may be here is not known: ")

    unsure = figure_of("contact_length", uncertainty=math.inf)
    assert of(figure_of(value=0.5), unsure) == "the contact length, whose uncertainty has no bound."
    open_effect = figure_of(not_modelled={"plastic_flow": math.inf})
    assert of(open_effect) == "the effect of plastic flow on the peak pressure."
    assert of() == "no figure has a tolerance."


def test_nothing_is_said_of_what_does_not_converge_or_flows(smooth_outcome: Run):
    failed = within_of(unconverged(smooth_outcome, "half_plane"))
    assert failed.size is None and "a solver did not converge (half-plane, pres" in failed.said
    said = yielding.Statement(yielding.BEYOND_DOUBT, "it flows")
    flowing = headline(refound(smooth_outcome, yielding.NAME, statements=(said,)))
    assert flowing.within.size is None and flowing.within.said == "it flows"
    assert flowing.kind == "fails" and "elastic body" in flowing.sentence
