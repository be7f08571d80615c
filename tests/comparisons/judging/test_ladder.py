"""Model that suffices: errors of every model against the whole one, and what is said of them.

The finished runs stand their finite elements in for by a half-plane that is one per cent stiffer:
the whole model is Hertz's contact at 1.01 E*."""

import json
from dataclasses import replace

import pytest
from scenes import STEADY, WAVY, changed, refound

from comparisons.common.errors import ExitStatus
from comparisons.figures.figure import Statement
from comparisons.figures.uncertainty import Uncertainty
from comparisons.judging.ladder import study as ladder
from comparisons.judging.study import LADDER, MODEL_ERROR, WHY_NOT
from comparisons.output.result import result_of

STIFFER = 1.01
TOLERANT = {"peak_pressure": 0.1, "contact_length": 0.1, "tau1_max": 0.1}


@pytest.fixture(scope="module")
def smooth_outcome(finish):
    """Run under a load at which nothing else matters."""
    return finish(changed(STEADY, load={"per_length": 1e4}))


@pytest.fixture(scope="module")
def wavy_outcome(finish):
    return finish(changed(WAVY, tolerance=TOLERANT))


def test_hertz_stands_where_the_surface_is_smooth(smooth_outcome):
    """p0 and tau1 go with the root of E*, the length with its inverse."""
    known = smooth_outcome.figures.of(study=LADDER, source="hertz", against="whole")
    softer = STIFFER**-0.5 - 1.0
    assert known.one(quantity="peak_pressure").value == pytest.approx(softer, rel=0.02)
    assert known.one(quantity="tau1_max").value == pytest.approx(softer, rel=1e-6)
    length = known.one(quantity="contact_length")
    assert abs(length.value - (STIFFER**0.5 - 1.0)) <= length.numerical
    assert {figure.verdict for figure in known} == {"holds"}
    assert smooth_outcome.findings[LADDER].said(ladder.SUFFICES) == "hertz"


def test_hertz_fails_and_the_half_plane_holds_on_a_wavy_surface(wavy_outcome):
    known, findings = wavy_outcome.figures.of(study=LADDER), wavy_outcome.findings[LADDER]
    assert "fails" in {figure.verdict for figure in known.of(source="hertz")}
    assert findings.said(ladder.SUFFICES) == "half_plane"
    [(name, line)] = ladder.lines(wavy_outcome)
    assert name == "cheapest that holds"
    assert line.startswith("half-plane (")


def test_the_half_plane_has_its_model_errors(wavy_outcome):
    """The whole model has no error but its uncertainty."""
    assert wavy_outcome.findings[MODEL_ERROR].data.solutions
    known = wavy_outcome.figures.of(study=LADDER)
    for error in wavy_outcome.model_errors:
        rung = known.one(source="half_plane", quantity=error.quantity, at=error.at)
        assert (rung.value, rung.total) == (error.value, error.total)
        whole = known.one(source="whole", quantity=error.quantity, at=error.at)
        assert whole.value == 0.0 < whole.numerical


def test_a_run_answers_for_its_half_plane_alone(wavy_outcome):
    """Hertz fails, the run does not; result.json names what suffices."""
    assert wavy_outcome.exit_status == ExitStatus.DONE
    content = json.loads(json.dumps(result_of(wavy_outcome).result))
    assert content["suffices"] == "half_plane"
    assert content["escalate_to"] is None


def test_nothing_suffices_where_no_rung_holds(wavy_outcome):
    """The line names one that may, by errors that are known to their tolerances; no other."""
    errors = wavy_outcome.figures.of(study=LADDER)
    said = (Statement(ladder.NONE, "the whole model is not known to the tolerance"),)
    none = "none, the whole model is not known to the tolerance; "

    def line(unsure: float) -> str:
        vague = Uncertainty({"numerical": unsure})
        looser = (replace(e, uncertainty=vague, unknown={}) for e in errors if e.source != "hertz")
        hertz = (
            replace(e, value=-0.9, uncertainty=Uncertainty({"numerical": 4.6}), unknown={})
            for e in errors.of(source="hertz")
        )
        run = refound(wavy_outcome, LADDER, figures=(*hertz, *looser), statements=said)
        [(_, text)] = ladder.lines(run)
        return text

    tolerance = errors[0].tolerance
    assert line(0.99 * tolerance).startswith(f"{none}cheapest that may: half-plane (")
    assert line(1.01 * tolerance) == f"{none}none is known to suffice"
    no_whole = (Statement(WHY_NOT, "no whole"),)
    without = refound(wavy_outcome, LADDER, figures=(), series=(), statements=no_whole)
    assert ladder.lines(without) == [] == ladder.blocks(without)


def test_a_model_that_fails_is_shown_by_an_error_that_fails(wavy_outcome):
    """Not by one whose uncertainty reaches farther."""
    vague = tuple(
        replace(error, unknown={"finite_strain": 9.0}) if error.verdict != "fails" else error
        for error in wavy_outcome.figures.of(study=LADDER)
    )
    [block] = ladder.blocks(refound(wavy_outcome, LADDER, figures=vague))
    rows = block.items[0].rows
    assert [row[0] for row in rows][:2] == ["Hertz's closed form", "half-plane"]
    assert (rows[0][4], rows[1][4]) == ("fails", "inconclusive")
    assert float(rows[0][3].split()[0]) < 10.0 < float(rows[1][3].split()[0])
