"""Cost studies: what fails is a row, what is recommended, and what files hold of it."""

import types
from dataclasses import replace

import numpy as np
import pytest
from scenes import SMOOTH, changed, problem

from analytic.grid import HatGrid
from comparisons.campaigns.cost.measure import (
    FAILED,
    OK,
    SKIPPED,
    CostRow,
    MeasuredRun,
    RefusedError,
    _series,
)
from comparisons.campaigns.cost.methods import FINEST, METHODS
from comparisons.campaigns.cost.recommend import assess, pareto, recommendations
from comparisons.campaigns.cost.show import (
    cells,
    content_of,
    cost_page,
    notes_of,
    refusals,
    shown,
)
from comparisons.common.errors import SceneError
from comparisons.common.progress import no_progress
from comparisons.common.tasks import ProcessEnded
from comparisons.drawing.style import Picture
from comparisons.figures.figure import Figure
from comparisons.figures.uncertainty import Uncertainty
from comparisons.models.level import Level

BY_NAME = {method.name: method for method in METHODS}


def row(name, setting, seconds, peak, status=OK, stress_seconds=0.0):
    """A row whose peak pressure is off by `peak`, of an exact 1."""
    grid = HatGrid(1.0, 0, 0)
    solution = types.SimpleNamespace(pressure=np.ones(1), converged=True)
    level = Level(grid, solution, np.zeros(1), np.array([[-1.0, 1.0]]), {}, unknowns=100)
    values = ({"peak_pressure": 1.0 + peak, "contact_length": 1.0},)
    times = {"contact": seconds, "stresses": stress_seconds}
    spread = (seconds, seconds)
    measured = MeasuredRun(level, values, times, seconds, seconds, spread, 1, 10**8, seconds)
    return CostRow(BY_NAME[name], setting, status, None if status == OK else "why", measured)


def assessed(*rows, tolerance=0.01, floor=0.0):
    def error(made):
        return Figure(
            study="cost",
            quantity="peak_pressure",
            source=made.method.name,
            value=abs(made.measured.values[0]["peak_pressure"] - 1.0),
            against="an exact 1",
            uncertainty=Uncertainty({"reference": floor}),
            bounds=(-tolerance, tolerance),
        )

    return [replace(made, errors={"peak_pressure": error(made)}) for made in rows]


def chosen(rows, tolerance=0.01, floor=0.0):
    [choice] = recommendations(rows, {"peak_pressure": floor}, {"peak_pressure": tolerance})
    return choice


class TestRows:
    """What fails or would take too long is a row that says so."""

    class Process:
        """Gives the answers, or raises them."""

        def __init__(self, *answers):
            self.answers, self.tasks = list(answers), []

        def __call__(self, task):
            self.tasks.append(task)
            answer = self.answers.pop(0)
            if isinstance(answer, Exception):
                raise answer
            return answer

    def rows(self, *answers, name="P2", left=1e9):
        process = self.Process(*answers)
        series = _series(BY_NAME[name], problem(SMOOTH), 3, left, process, no_progress)
        return series, process

    def test_refused_and_failed(self):
        good = row("P2", 1.0, 1.0, 0.0).measured
        unsolved = replace(good.level, solution=types.SimpleNamespace(converged=False))
        wild = replace(good, level=unsolved)
        refused = RefusedError(SKIPPED, "budget.memory")
        failed = RefusedError(FAILED, "MeshError: no mesh")
        series, _ = self.rows(good, failed, wild, refused)
        assert [r.status for r in series] == [OK, FAILED, FAILED, SKIPPED]
        assert series[1].because == "MeshError: no mesh" and series[2].because == "did not converge"
        assert series[2].measured is wild

    def test_a_lost_process_is_a_failure_and_the_finer_settings_are_skipped(self):
        good = row("P2", 1.0, 1.0, 0.0).measured
        series, process = self.rows(good, ProcessEnded())
        assert [r.status for r in series] == [OK, FAILED, SKIPPED, SKIPPED]
        assert len(process.tasks) == 2

    def test_what_would_not_end_in_time_is_skipped(self):
        """After a second the next one takes 3.5, and there are 3 left."""
        series, process = self.rows(row("P2", 1.0, 1.0, 0.0).measured, left=4.0)
        assert [r.status for r in series] == [OK, SKIPPED, SKIPPED, SKIPPED]
        assert "budget.time" in series[1].because and process.tasks[0].limit <= 1.0

    def test_files_and_table_have_them(self, monkeypatch):
        rows = [row("P2", 1e-5, 1.0, 1e-4), row("P2", 5e-6, 1.0, 1e-4, status=FAILED)]
        rows += [CostRow(BY_NAME["P1"], None, SKIPPED, "does not apply")]
        study = assess(problem(SMOOTH), rows)
        names = shown(study)
        texts = [cells(study, entry, names) for entry in study.rows]
        assert texts[1][-1].endswith("failed") and "skipped" in texts[2]
        assert refusals(study) == ["P2 5.00 µm failed: why", "P1 skipped: does not apply"]
        monkeypatch.setattr(
            "comparisons.campaigns.cost.show.cost_picture", lambda *a: Picture("data:,", "", "")
        )
        page = cost_page(study)
        assert all(f'<tr class="{status}">' in page for status in (OK, FAILED, SKIPPED))
        content = content_of(study)
        assert [r["status"] for r in content["rows"]] == [OK, FAILED, SKIPPED]
        assert all(one not in front for front in study.fronts.values() for one in study.rows[1:])
        assert notes_of(study)

    def test_no_reference_is_an_error_of_the_scene(self):
        wave = {"kind": "sinusoid", "wavelength": 100e-6, "amplitude": 0.3e-6}
        wavy = problem(changed(SMOOTH, profile=wave))
        with pytest.raises(SceneError, match="no reference for errors: why"):
            assess(wavy, [CostRow(FINEST, 1e-6, FAILED, "why")])


class TestRecommendation:
    def test_the_pareto_front(self):
        rows = assessed(
            row("P1", 4.0, 1.0, 1e-1),
            row("P1", 2.0, 2.0, 1e-2),
            row("P2", 4.0, 1.5, 5e-2),
            row("P2", 2.0, 3.0, 2e-2),
            row("P3", 4.0, 9.0, 1e-5),
            row("P3", 2.0, 0.1, 0.0, status=FAILED),
        )
        front = pareto(rows, "peak_pressure", floor=1e-3)
        assert [entry.setting for entry in front] == [4.0, 4.0, 2.0, 4.0]
        assert [entry.method.name for entry in front] == ["P1", "P2", "P1", "P3"]

    def test_below_the_floor_nothing_is_closer(self):
        rows = assessed(row("P2", 2.0, 1.0, 5e-4), row("P3", 2.0, 2.0, 1e-6))
        assert len(pareto(rows, "peak_pressure", floor=1e-3)) == 1

    def test_time_of_a_contact_figure_is_without_the_stresses(self):
        one = row("P2", 2.0, 1.0, 0.0, stress_seconds=5.0)
        assert (one.seconds(False), one.seconds(True)) == (1.0, 6.0)
        rows = assessed(one, row("P3", 2.0, 2.0, 0.0))
        assert chosen(rows).finite_element is rows[0]

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
        assert choice.half_plane is rows[1] and choice.finite_element is rows[4]
        assert choice.sentence == (
            "For 1 % of the peak pressure take the half-plane (hats, FFT at a pitch of 2.00 m: "
            "expect 200 ms); of the finite elements P2 at a pitch of 2.00 m, 100 unknowns: "
            "expect 2.0 s."
        )

    def test_not_one_that_meets_it_by_chance(self):
        rows = assessed(
            row("P2", 4.0, 1.0, 1e-5), row("P2", 2.0, 2.0, 5e-2), row("P2", 1.0, 8.0, 1e-3)
        )
        choice = chosen(rows, 0.01)
        assert choice.finite_element.setting == 1.0
        assert choice.sentence.endswith(
            "by chance it is met cheaper by P2 at a pitch of 4.00 m, 100 unknowns: expect 1.0 s, "
            "but a finer one does not."
        )
        assert "by chance" not in chosen(rows[1:], 0.01).sentence
        assert chosen(rows[:2], 0.01).sentence == (
            "For 1 % of the peak pressure no measured setting will do; by chance it is met by P2 "
            "at a pitch of 4.00 m, 100 unknowns: expect 1.0 s, but a finer one does not."
        )

    def test_the_floor_counts_as_error(self):
        rows = assessed(row("P2", 4.0, 1.0, 8e-3), row("P2", 2.0, 2.0, 1e-3), floor=5e-3)
        assert chosen(rows, 0.01, floor=5e-3).finite_element.setting == 2.0

    def test_a_reference_that_is_not_good_enough_recommends_nothing(self):
        choice = chosen(assessed(row("P2", 4.0, 1.0, 0.0), floor=0.02), floor=0.02)
        assert choice.finite_element is choice.half_plane is None
        assert "nothing can be said: the reference itself is that uncertain" in choice.sentence

    def test_cheaper_ones_that_run_does_not_have_are_named(self):
        rows = assessed(row("strips, FFT", 8.0, 0.5, 1e-3), row("P2", 4.0, 1.0, 1e-3))
        choice = chosen(rows, 0.01)
        assert choice.cheapest.method.name == "strips, FFT"
        assert choice.sentence.endswith(
            "P2 at a pitch of 4.00 m, 100 unknowns: expect 1.0 s; no setting of the half-plane "
            "will do; cheapest of all is strips, FFT at a pitch of 8.00 m: expect 500 ms "
            "(run cannot solve by it)."
        )

    def test_nothing_will_do(self):
        sentence = chosen(assessed(row("P2", 4.0, 1.0, 0.5)), 0.01).sentence
        assert sentence == "For 1 % of the peak pressure no measured setting will do."
