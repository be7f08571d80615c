"""How a number judges a claim of the paper, and how its uncertainty is found."""

from math import inf
from types import SimpleNamespace

import numpy as np
import pytest

from comparisons.campaigns.paper.claims import (
    CONFIRMED,
    DENIED,
    FIGURES,
    INCONCLUSIVE,
    NOT_CONVERGED,
    SCENES,
    Claim,
    claims,
    judgement,
    measured,
)
from comparisons.campaigns.paper.readings import LevelView
from comparisons.figures.figure import Figure
from comparisons.figures.uncertainty import Uncertainty


def claim(**changes) -> Claim:
    words = dict.fromkeys(("key", "figure", "title", "text", "measure", "scene"), "…")
    judged = {"reading": lambda view: 0.0, "confirms": (2.0, 3.0)}
    return Claim(**words | judged | changes)


def outcome_of(value, uncertainty, other=None, **changes):
    values = {"half_plane": value, "finite_element": value if other is None else other}
    numbers = {model: number(model, value, uncertainty) for model, value in values.items()}
    return judgement(claim(**changes), numbers)


def number(model: str, value: float, uncertainty: float, *notes: str) -> Figure:
    stated = Uncertainty({"discretisation": uncertainty})
    return Figure("paper", "key", model, value, uncertainty=stated, notes=notes)


class TestJudgement:
    @pytest.mark.parametrize(
        ("value", "uncertainty", "expected"),
        [
            (2.5, 0.4, CONFIRMED),
            (2.0, 0.0, CONFIRMED),
            (1.5, 0.4, DENIED),
            (3.5, 0.4, DENIED),
            (2.1, 0.2, INCONCLUSIVE),
            (1.9, 0.2, INCONCLUSIVE),
            (2.5, inf, INCONCLUSIVE),
        ],
    )
    def test_the_whole_uncertainty_must_lie_on_one_side(self, value, uncertainty, expected):
        assert outcome_of(value, uncertainty)[0] == expected

    @pytest.mark.parametrize(
        ("value", "expected"), [(2.5, CONFIRMED), (1.5, INCONCLUSIVE), (0.5, DENIED), (4.0, DENIED)]
    )
    def test_between_words_and_their_denial_it_is_inconclusive(self, value, expected):
        judged = outcome_of(value, 0.1, allows=(1.0, 3.0), ambiguity="no number")
        assert judged == (expected, "no number" if expected == INCONCLUSIVE else None)

    def test_what_a_stand_in_was_made_for_proves_nothing_but_may_fail(self):
        outcome, why = outcome_of(2.5, 0.1, tuned="this ratio")
        assert outcome == INCONCLUSIVE and "made to show this ratio" in why
        assert outcome_of(1.0, 0.1, tuned="this ratio") == (DENIED, None)

    @pytest.mark.parametrize(
        ("other", "reason"),
        [
            (1.0, "the two models do not say the same"),
            (2.05, "the numerical uncertainty of the finite elements reaches over a bound"),
        ],
    )
    def test_what_one_model_alone_says_is_inconclusive(self, other, reason):
        assert outcome_of(2.5, 0.1, other=other) == (INCONCLUSIVE, reason)

    def test_an_unsolved_contact_is_inconclusive(self):
        unsolved = {"half_plane": number("half_plane", 2.5, 0.1, NOT_CONVERGED)}
        reason = "the contact of the half-plane did not converge"
        assert judgement(claim(), unsolved) == (INCONCLUSIVE, reason)

    @pytest.mark.parametrize(
        ("confirms", "allows", "expected"),
        [
            ((2.0, inf), None, "Confirmed from 2 a on, else denied."),
            ((0.0, 0.5), None, "Confirmed from 0 to 0.5 a, else denied."),
            ((0.9, 1.0), (0.5, 1.0), "Confirmed from 0.9 to 1 a, denied unless from 0.5 to 1 a."),
        ],
    )
    def test_the_criterion_says_the_bounds(self, confirms, allows, expected):
        assert claim(confirms=confirms, allows=allows, unit="a").criterion == expected


class TestMeasured:
    def number(self, values, check=None, exact=False, by_row=0.0) -> Figure:
        """What levels of these values, and a far-boundary check, come to."""
        solution = SimpleNamespace(converged=True, residuals=SimpleNamespace(worst=0.0))
        levels = [SimpleNamespace(value=value, solution=solution) for value in values]
        level = None if check is None else SimpleNamespace(value=check)
        checks = {"far_boundary_check": level, "longer_increments": ()}
        run = SimpleNamespace(levels=levels, finest=levels[-1], **checks)

        def reading(view: LevelView) -> float:
            return view.level.value + by_row * (view.every - 1)

        outcome = SimpleNamespace(runs={"m": run}, problem=None, window=None)
        return measured(claim(reading=reading, exact=exact), outcome, "m")

    def test_uncertainty_grows_with_levels_boundary_and_reading(self):
        number = self.number
        plain = number([1.04, 1.02, 1.01])
        assert plain.value == 1.01
        assert plain.numerical == pytest.approx(1.25 * 0.01)  # order 1: 1.25 times the last step
        # faster than order 1: no order is trusted, and the fit with order 1 scatters
        assert number([1.05, 1.01, 1.0]).numerical == pytest.approx(0.02533, abs=1e-5)
        read = number([1.04, 1.02, 1.01], by_row=0.01).numerical
        assert read == pytest.approx(plain.numerical + 0.01)
        bound = number([1.04, 1.02, 1.01], check=1.05, by_row=0.01).numerical
        assert bound == pytest.approx(read + 0.01 / (np.sqrt(2.0) - 1.0))

    def test_an_error_against_an_exact_value_has_none(self):
        error = self.number([3.0, 2.0, 1.0], exact=True)
        assert (error.value, error.numerical) == (1.0, 0.0)


def test_the_list_of_claims_is_whole():
    listed = claims()
    for name in ("key", "title"):
        assert len({getattr(c, name) for c in listed}) == len(listed) > 30
    assert {c.scene for c in listed} == set(SCENES) == set(FIGURES)
    for one in listed:
        low, high = one.confirms
        assert low < high
        if one.allows is not None:
            assert one.ambiguity and one.allows[0] <= low and high <= one.allows[1]
        number = one.figure.partition("(")[0]
        assert number in {"1", "5", "11", FIGURES[one.scene]}
