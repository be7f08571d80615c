"""One number that answers: the least tolerance at which every judged figure holds."""

import math
from dataclasses import replace

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from scenes import judged, refound, unconverged

from comparisons.figures.figure import Figure
from comparisons.figures.quantity import QUANTITIES
from comparisons.judging import yielding
from comparisons.judging.study import Run
from comparisons.judging.verdict.headline import headline, validity
from comparisons.judging.verdict.within import rounded_up, within_of

SIZES = st.floats(0.0, 0.4, allow_subnormal=False)
ON_ONE_RUN = {"suppress_health_check": [HealthCheck.function_scoped_fixture], "deadline": None}


@st.composite
def errors(draw: st.DrawFn) -> list[Figure]:
    """Model errors of several quantities, each with a tolerance of its own."""
    return [
        judged(
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
    figures = judged(), judged("tau1_max", -0.0531, 0.0082, {"coating": 0.03})
    within = within_of(of_errors(smooth_outcome, figures))
    assert within.size == pytest.approx(0.0531 + 0.0082 + 0.03, rel=1e-12)
    assert within.sentence == (
        "The half-plane is right within 9.2 % here (largest: τ₁ max, −5.3 ± 0.82 %, 3.0 % not "
        "modelled)."
    )
    far = within_of(of_errors(smooth_outcome, [judged(value=-6.9)]))
    assert far.size == pytest.approx(6.902) and "is off by up to 700 % here" in far.sentence


def test_where_it_is_not_known_it_says_of_what_and_why(smooth_outcome: Run):
    def of(*figures: Figure) -> str:
        within = within_of(of_errors(smooth_outcome, figures))
        assert within.size is None
        return within.sentence.removeprefix("How wrong the half-plane may be here is not known: ")

    unsure = judged("contact_length", uncertainty=math.inf)
    assert of(judged(value=0.5), unsure) == "the contact length, whose uncertainty has no bound."
    open_effect = judged(not_modelled={"plastic_flow": math.inf})
    assert of(open_effect) == "the effect of plastic flow on the peak pressure."
    assert of() == "no figure has a tolerance."


def test_nothing_is_said_of_what_does_not_converge_or_flows(smooth_outcome: Run):
    failed = within_of(unconverged(smooth_outcome, "half_plane"))
    assert failed.size is None and "a solver did not converge (half-plane, pres" in failed.said
    said = yielding.Statement(yielding.BEYOND_DOUBT, "it flows")
    flowing = headline(refound(smooth_outcome, yielding.NAME, statements=(said,)))
    assert flowing.within.size is None and flowing.within.said == "it flows"
    assert flowing.kind == "fails" and "elastic body" in flowing.sentence
