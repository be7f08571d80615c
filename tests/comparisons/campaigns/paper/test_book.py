"""Seireg's conclusions on rough contact as physics: which way each figure goes, and by how much."""

import json
from functools import cache

import numpy as np
import pytest
from scenes import DATA

from analytic.statistics.nominally_flat import Summits
from analytic.statistics.rough_bodies import bearing_of
from comparisons.campaigns.paper import book
from comparisons.campaigns.paper.claims import (
    CONFIRMED,
    DENIED,
    THEORY,
    JudgedClaim,
    book_claims,
    judge,
)

REFERENCE = json.loads((DATA / "g_greenwood.json").read_text())["GT"]


@cache
def judged() -> dict[str, JudgedClaim]:
    """By the keys of their claims."""
    return {claim.key: judge(claim, None) for claim in book_claims()}


def test_outcomes_are_those_of_the_numbers():
    denied = {key for key, claim in judged().items() if claim.outcome == DENIED}
    assert denied == {"rough-constant", "penetration-coefficient"} | {
        f"seireg-{name}" for name in ("bottom", "fifteen", "partition")
    }
    assert {claim.outcome for claim in judged().values()} == {CONFIRMED, DENIED}
    assert len(judged()) == 13


def test_heat_against_reference_values():
    """Those of 16 digits; the parabola's error, and the partition, have tests of their own."""
    reference = json.loads((DATA / "h_heat.json").read_text())["seed_claims"]
    fifteen = judged()["seireg-fifteen"]
    exact = float(reference["bottom_deviation_at_15_tL_exact"])
    assert fifteen.numbers[THEORY].value == pytest.approx(exact, rel=1e-12)
    mean, short, _ = (row[THEORY] for row in fifteen.besides.values())
    assert mean == pytest.approx(float(reference["mean_deviation_at_15_tL_exact"]), rel=1e-10)
    exact = float(reference["bottom_deviation_at_15_tL_seed_formula"])
    assert short == pytest.approx(exact, rel=1e-12)
    coefficient = 1.12 / float(reference["surface_flux_coefficient_exact_2_over_sqrt_pi"])
    assert judged()["seireg-flux"].numbers[THEORY].value == pytest.approx(coefficient, rel=1e-12)
    halves = list(judged()["seireg-partition"].besides.values())
    assert halves[0][THEORY] == pytest.approx(0.5, abs=1e-9)


@pytest.mark.parametrize(("name", "factor"), [("A", 1.79), ("B", 1.62), ("C", 1.62)])
def test_mean_real_pressure_over_three_decades(name, factor):
    """Set C's decades are of its own unit of load; A is stated over those of figure 4.5."""
    sets, unit = book.SETS, book.SETS["A"].deviation / book.SETS[name].deviation
    loads = (load / unit**1.5 for load in (100.0, 0.1))
    heavy, light = (book.real_pressure(sets[name], load) for load in loads)
    assert heavy / light == pytest.approx(factor, abs=0.005)


def test_sets_b_and_c_have_the_same_bearing():
    a, b, c = (bearing_of(summits, book.SPHERE) for summits in book.SETS.values())
    assert b == pytest.approx(c) and b > a
    assert a == pytest.approx(8 / 3 * 500e6 * 0.5e-6 * np.sqrt(2 * 10e-3 * 0.2e-3))


def test_every_direction_of_the_third_conclusion_is_the_other_one():
    """More pressure, and so less area, by roughness, by fewer and by sharper asperities."""
    base = {"density": 500e6, "radius": 0.2e-3, "deviation": 0.5e-6}
    pressure = book.real_pressure(Summits(**base), 10.0)
    for name, factor in (("deviation", 1.5), ("density", 0.7), ("radius", 0.7)):
        rougher = Summits(**base | {name: factor * base[name]})
        assert book.real_pressure(rougher, 10.0) > 1.02 * pressure


def test_light_and_heavy_loads_bracket_the_reference():
    """Of a bearing of 4, near set A's 2.7, the reference has 0.7262 / 0.1233 and 5.823 / 5.724."""
    (light,) = (row for row in REFERENCE if (row["T"], row["mu"]) == (0.01, 4.0))
    ratio = float(light["a_eff_star_A"]) / float(light["aHertz_star"])
    number = judged()["rough-light-load"].numbers[THEORY].value
    assert ratio < number < 1.1 * ratio
    (peak,) = judged()["rough-light-load"].besides.values()
    assert peak[THEORY] < float(light["p0_over_p0Hertz"])
    assert judged()["rough-heavy-load"].numbers[THEORY].value < 1.05
