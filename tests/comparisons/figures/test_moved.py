"""Repetitions: what counts as a figure that moved, and by what it is measured."""

from dataclasses import replace

import pytest

from comparisons.figures.figure import Column, Figure, Findings, Part, Series, Statement
from comparisons.figures.moved import items_of, movement
from comparisons.figures.uncertainty import Uncertainty
from comparisons.judging.study import Run

OTHER = {"scene.load.per_length": 1e5, "verdict": "inconclusive"}
PEAK = Figure(
    study="contact",
    quantity="peak_pressure",
    source="half_plane",
    value=2e9,
    at={"friction": 0.1},
    scale=2e9,
    uncertainty=Uncertainty({"iteration": 1e-9, "discretisation": 1e-4}),
)
NAME = "contact.peak_pressure [half_plane, friction 0.1]"


def moved(before, after, **other):
    """Between two figures, or series, of one study."""

    def items(part, other):
        kind = "figures" if isinstance(part, Figure) else "series"
        return items_of({"contact": Findings(**{kind: (part,)})}, other)

    return movement(items(before, OTHER), items(after, OTHER | other))


def test_a_run_repeats_itself(smooth_outcome: Run):
    items = items_of(smooth_outcome.findings, OTHER)
    change = movement(items, items)
    assert change.moved == () and change.rounding == change.new == 0
    assert change.same == len(items) > len(smooth_outcome.figures)


def test_a_figure_may_move_by_what_it_states_itself():
    inside = moved(PEAK, replace(PEAK, value=2e9 * (1.0 + 0.9e-4)))
    (row,) = inside.moved
    assert (row.name, inside.beyond) == (NAME, ())
    assert (row.change, row.stated) == pytest.approx((0.9e-4, 1e-4 + 1e-9))
    assert moved(PEAK, replace(PEAK, value=2e9 * (1.0 + 1.1e-4))).beyond[0].name == NAME
    rounded = moved(PEAK, replace(PEAK, value=2e9 * (1.0 + 1e-12)))
    assert (rounded.moved, rounded.rounding) == ((), 1)  # which is counted apart


def test_a_difference_moves_by_its_own_uncertainty():
    figure = replace(PEAK, against="finite_element", value=0.01, scale=3.0)
    (row,) = moved(figure, replace(figure, value=0.012)).moved
    assert row.change == pytest.approx(0.002) and row.beyond


def test_of_an_uncertainty_that_is_unknown_the_known_parts_count():
    parts = {"discretisation": float("inf"), "domain": 1e-3}
    figure = replace(PEAK, uncertainty=Uncertainty(parts))
    (row,) = moved(figure, replace(figure, value=2e9 * (1.0 + 0.9e-3))).moved
    assert not row.beyond and row.stated == pytest.approx(1e-3 + 1e-9)


def test_what_states_nothing_may_not_move():
    exact = replace(PEAK, uncertainty=Uncertainty())
    (row,) = moved(exact, replace(exact, value=2e9 * (1.0 + 1e-6))).beyond
    assert row.stated == 0.0 and row.change == pytest.approx(1e-6)
    (row,) = moved(PEAK, PEAK, **{"scene.load.per_length": 1.1e5}).beyond
    assert row.name == "scene.load.per_length"


def test_a_verdict_that_changed_is_a_finding():
    (row,) = moved(PEAK, PEAK, verdict="fails").beyond
    assert (row.recorded, row.repeated, row.change) == ("inconclusive", "fails", None)
    judged = replace(PEAK, value=2e9, bounds=(0.0, 1.2))
    rows = moved(judged, replace(judged, value=2.9e9)).beyond
    assert [row.name for row in rows] == [NAME, f"{NAME}, verdict"]


def test_a_figure_that_went_is_a_finding_and_a_new_one_is_not():
    change = moved(PEAK, replace(PEAK, quantity="contact_length"))
    assert [row.name for row in change.beyond] == [NAME, f"{NAME}, uncertainty"]
    assert change.moved[0].repeated is None and change.new == 2


def test_an_effect_moves_by_its_own_uncertainty():
    parts = Part("layer", 0.02, 1e-3), Part("flow", 0.01)
    figure = replace(PEAK, parts=parts)
    changed = replace(figure, parts=(replace(parts[0], value=0.0205), Part("flow", 0.0102)))
    rows = {row.name.rpartition(", ")[2]: row for row in moved(figure, changed).moved}
    assert not rows["layer"].beyond and rows["layer"].stated == 1e-3
    assert rows["flow"].beyond


def test_what_a_run_took_is_no_figure():
    series = Series("levels", {"seconds": Column((1.0, 2.0), "s")}, is_account=True)
    slower = replace(series, columns={"seconds": Column((1.0, 7.0), "s")})
    assert moved(series, slower).moved == ()


def test_words_are_no_figures_but_what_converged_is():
    findings = {"contact": Findings((PEAK,), statements=(Statement("why", "because"),))}
    other = {"contact": Findings((PEAK,), statements=(Statement("why", "therefore"),))}
    assert movement(items_of(findings, {}), items_of(other, {})).moved == ()


def test_patches_move_by_the_length_that_they_do_not_share():
    def patches(*ends):
        start, stop = (Column(side, "m", (1e-7,) * len(side)) for side in zip(*ends, strict=True))
        return Series("patches", {"start": start, "stop": stop}, "half_plane")

    (row,) = moved(patches((0.0, 1e-4)), patches((0.0, 4.9e-5), (5e-5, 1e-4))).moved
    assert row.name == "contact.patches [half_plane]"
    assert row.change == pytest.approx(0.01, rel=1e-9)
    assert row.stated == pytest.approx(1e-3) and row.beyond


def test_a_column_moves_by_the_norm_of_its_change():
    def curve(*values):
        return Series("rise", {"rise": Column(values, "m", (0.3, 0.4))}, "half_plane")

    inside = moved(curve(3.0, 4.0), curve(3.0, 4.4))
    assert inside.beyond == () and inside.moved[0].change == pytest.approx(0.08)
    assert inside.moved[0].stated == pytest.approx(0.1)
    assert moved(curve(3.0, 4.0), curve(3.0, 4.6)).beyond
    assert moved(curve(3.0, 4.0), curve(3.0, 4.0, 5.0)).beyond[0].change is None
