"""Cost studies: what fails is a row, what is recommended, and what is kept of it."""

import types
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from comparisons.common.errors import SceneError
from comparisons.common.processes import ProcessEnded
from comparisons.common.progress import no_progress
from comparisons.models.problem import problem_of
from comparisons.report.figures.style import Picture
from comparisons.scenes.resolve import resolve_tables
from comparisons.studies.cost.choice import Assessed, choices, pareto
from comparisons.studies.cost.cost import judged
from comparisons.studies.cost.measure import Measured, Refused
from comparisons.studies.cost.methods import (
    ADAPTED,
    FINEST,
    METHODS,
)
from comparisons.studies.cost.page import cost_page
from comparisons.studies.cost.result import content_of
from comparisons.studies.cost.solve import Answer
from comparisons.studies.cost.study import FAILED, OK, SKIPPED, Row, Study, _asked, _series
from comparisons.studies.cost.table import cells, notes_of, refusals, shown

STEEL = {"youngs_modulus": 210e9, "poissons_ratio": 0.3}
SMOOTH = {
    "title": "Smooth",
    "roller": {"radius": 7.5706e-3, **STEEL},
    "body": dict(STEEL),
    "load": {"per_length": 3.55e6},
}
BY_NAME = {method.name: method for method in METHODS}


def problem(tables, **sections):
    return problem_of(scene(tables, **sections))


def scene(tables, **sections):
    tables = tables | {name: tables.get(name, {}) | more for name, more in sections.items()}
    return resolve_tables(tables, name="made", folder=Path("."), source="made.toml")


def row(name, setting, seconds, peak, status=OK, stress_seconds=0.0):
    """A row whose peak pressure is off by `peak`, of an exact 1."""
    answer = Answer(
        figures=({"peak_pressure": 1.0 + peak, "contact_length": 1.0},),
        x=np.array([-1.0, 0.0, 1.0]),
        pressure=np.array([0.0, 1.0, 0.0]),
        stresses=(),
        elements=1,
        unknowns=100,
        converged=True,
        level=None,
    )
    times = {"contact": seconds, "stresses": stress_seconds}
    measured = Measured(answer, times, seconds, seconds, (seconds, seconds), 1, 10**8, seconds)
    return Row(BY_NAME[name], setting, status, None if status == OK else "why", measured)


def assessed(*rows):
    return [
        Assessed(r, {"peak_pressure": abs(r.measured.answer.figures[0]["peak_pressure"] - 1.0)})
        for r in rows
    ]


def chosen(rows, tolerance, floor=0.0):
    reference = types.SimpleNamespace(floor=floor)
    found = choices(Study((), {}), rows, {"peak_pressure": reference}, {"peak_pressure": tolerance})
    return found[0]


class TestRows:
    """What fails or would take too long is a row, told apart."""

    class Process:
        """Gives the answers, or raises them."""

        def __init__(self, *answers):
            self.answers, self.tasks = list(answers), []

        def __call__(self, work, task):
            self.tasks.append(task)
            answer = self.answers.pop(0)
            if isinstance(answer, Exception):
                raise answer
            return answer

    def rows(self, *answers, name="P2", left=1e9):
        process = self.Process(*answers)
        store = types.SimpleNamespace(load=lambda task: None, save=lambda task, found: None)
        ask = _asked(store, process)
        found = _series(BY_NAME[name], problem(SMOOTH), 3, left, ask, no_progress)
        return found, process

    def test_refused_and_failed(self):
        good = row("P2", 1.0, 1.0, 0.0).measured
        wild = replace(good, answer=replace(good.answer, converged=False))
        refused, failed = Refused("budget.memory", True), Refused("MeshError: no mesh", False)
        found, _ = self.rows(good, failed, wild, refused)
        assert [r.status for r in found] == [OK, FAILED, FAILED, SKIPPED]
        assert found[1].because == "MeshError: no mesh" and found[2].because == "did not converge"
        assert found[2].measured is wild

    def test_a_lost_process_is_a_failure_and_the_finer_settings_are_skipped(self):
        good = row("P2", 1.0, 1.0, 0.0).measured
        found, process = self.rows(good, ProcessEnded())
        assert [r.status for r in found] == [OK, FAILED, SKIPPED, SKIPPED]
        assert len(process.tasks) == 2

    def test_what_would_not_end_in_time_is_skipped(self):
        """After a second the next one takes 3.5, and there are 3 left."""
        found, process = self.rows(row("P2", 1.0, 1.0, 0.0).measured, left=4.0)
        assert [r.status for r in found] == [OK, SKIPPED, SKIPPED, SKIPPED]
        assert "budget.time" in found[1].because and process.tasks[0].limit <= 1.0

    def test_a_dense_matrix_that_is_too_large_is_skipped(self, monkeypatch):
        monkeypatch.setattr("comparisons.studies.cost.study.MOST_DENSE", 100)
        good = row("hats, dense", 1.0, 1e-3, 0.0).measured
        found, _ = self.rows(good, good, name="hats, dense")
        assert [r.status for r in found][:3] == [OK, OK, SKIPPED]
        assert found[2].because.startswith("113 elements; a dense matrix")

    def test_they_are_kept_and_told_apart(self, monkeypatch):
        rows = [row("P2", 1e-5, 1.0, 1e-4), row("P2", 5e-6, 1.0, 1e-4, status=FAILED)]
        rows += [Row(BY_NAME["P1"], None, SKIPPED, "does not apply")]
        found = judged(problem(SMOOTH), Study(tuple(rows), {}))
        names = shown(found)
        texts = [cells(found, each, names) for each in found.assessed]
        assert texts[1][-1].endswith("failed") and "skipped" in texts[2]
        assert refusals(found) == [
            "P2 5.00 µm failed: why",
            "P1 skipped: does not apply",
        ]
        monkeypatch.setattr(
            "comparisons.studies.cost.page.cost_picture", lambda *a: Picture("data:,", "", "")
        )
        page = cost_page(found)
        assert all(f'<tr class="{status}">' in page for status in (OK, FAILED, SKIPPED))
        content = content_of(found)
        assert [r["status"] for r in content["rows"]] == [OK, FAILED, SKIPPED]
        assert all(
            each not in front for front in found.fronts.values() for each in found.assessed[1:]
        )
        assert notes_of(found)

    def test_nothing_to_measure_by_is_an_error_of_the_scene(self):
        wave = {"kind": "sinusoid", "wavelength": 100e-6, "amplitude": 0.3e-6}
        wavy = problem(SMOOTH, profile=wave)
        with pytest.raises(SceneError, match="nothing to measure errors by: why"):
            judged(wavy, Study((Row(FINEST, 1e-6, FAILED, "why"),), {}))


class TestChoice:
    def test_what_nothing_beats(self):
        rows = assessed(
            row("P1", 4.0, 1.0, 1e-1),
            row("P1", 2.0, 2.0, 1e-2),
            row("P2", 4.0, 1.5, 5e-2),
            row("P2", 2.0, 3.0, 2e-2),
            row("P3", 4.0, 9.0, 1e-5),
            row("P3", 2.0, 0.1, 0.0, status=FAILED),
        )
        front = pareto(rows, "peak_pressure", floor=1e-3)
        assert [each.row.setting for each in front] == [4.0, 4.0, 2.0, 4.0]
        assert [each.row.method.name for each in front] == ["P1", "P2", "P1", "P3"]

    def test_below_the_floor_nothing_is_closer(self):
        rows = assessed(row("P2", 2.0, 1.0, 5e-4), row("P3", 2.0, 2.0, 1e-6))
        assert len(pareto(rows, "peak_pressure", floor=1e-3)) == 1

    def test_time_of_a_contact_figure_is_without_the_stresses(self):
        one = row("P2", 2.0, 1.0, 0.0, stress_seconds=5.0)
        assert (one.seconds(False), one.seconds(True)) == (1.0, 6.0)
        rows = assessed(one, row("P3", 2.0, 2.0, 0.0))
        assert chosen(rows, 0.1).finite_element.row is one

    def test_the_cheapest_that_meets_the_tolerance(self):
        rows = assessed(
            row("hats, FFT", 4.0, 0.1, 3e-2),
            row("hats, FFT", 2.0, 0.2, 1e-3),
            row("P1", 1.0, 5.0, 1e-3),
            row("P2", 4.0, 1.0, 3e-2),
            row("P2", 2.0, 2.0, 2e-3),
            row("P2", 1.0, 8.0, 2e-4),
        )
        choice = chosen(rows, 0.01)
        assert choice.half_plane.row is rows[1].row and choice.finite_element.row is rows[4].row
        assert choice.sentence == (
            "For 1 % of the peak pressure take the half-plane (hats, FFT at a pitch of 2.00 m: "
            "expect 200 ms); of the finite elements P2 at a pitch of 2.00 m, 100 unknowns: "
            "expect 2.0 s."
        )

    def test_not_one_that_meets_it_by_chance(self):
        rows = assessed(
            row("P2", 4.0, 1.0, 1e-5), row("P2", 2.0, 2.0, 5e-2), row("P2", 1.0, 8.0, 1e-3)
        )
        assert chosen(rows, 0.01).finite_element.row.setting == 1.0

    def test_the_floor_counts_as_error(self):
        rows = assessed(row("P2", 4.0, 1.0, 8e-3), row("P2", 2.0, 2.0, 1e-3))
        assert chosen(rows, 0.01, floor=5e-3).finite_element.row.setting == 2.0

    def test_a_reference_that_is_not_good_enough_recommends_nothing(self):
        choice = chosen(assessed(row("P2", 4.0, 1.0, 0.0)), 0.01, floor=0.02)
        assert choice.finite_element is choice.half_plane is None
        assert "nothing can be said: the reference itself is that uncertain" in choice.sentence

    def test_cheaper_ones_that_run_does_not_have_are_named(self):
        rows = assessed(row("P2 adapted", 0.01, 0.5, 1e-3), row("P2", 4.0, 1.0, 1e-3))
        choice = chosen(rows, 0.01)
        assert choice.cheapest.row.method.name == ADAPTED
        assert choice.sentence.endswith(
            "P2 at a pitch of 4.00 m, 100 unknowns: expect 1.0 s; no setting of the half-plane "
            "will do; cheapest of all is P2 adapted to 0.01, 100 unknowns: expect 500 ms."
        )

    def test_nothing_will_do(self):
        sentence = chosen(assessed(row("P2", 4.0, 1.0, 0.5)), 0.01).sentence
        assert sentence == "For 1 % of the peak pressure no measured setting will do."
