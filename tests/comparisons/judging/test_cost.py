"""Error against run time: the levels of a run, the methods that `cost` adds, the cheapest."""

import pytest
from scenes import SMOOTH, as_toml, changed, problem, resolved, run_of

from comparisons.cli import main
from comparisons.common.errors import InputError
from comparisons.figures.quantity import MODELS, WHOLE
from comparisons.judging.ladder import cost
from comparisons.judging.ladder.cost import cheapest, methods_of
from comparisons.judging.rule import values_of
from comparisons.models.model import Model
from comparisons.runs.run import Known, run

WAVE = {"kind": "sinusoid", "wavelength": 100e-6, "amplitude": 0.3e-6}
PLAIN = SMOOTH | {"budget": {"effects": False}}
LAYER = changed(SMOOTH, body={"thickness": 2e-3})


def rows_of(outcome) -> list[dict]:
    return outcome.findings[cost.NAME].table(cost.ROWS).rows()


def test_every_level_of_a_run_is_a_row_measured_by_the_finest():
    outcome = run(resolved(PLAIN), None, MODELS)
    rows, [finest] = rows_of(outcome), [r for r in rows_of(outcome) if r["peak_pressure"] is None]
    levels = [level for model in outcome.runs.values() for level in model.levels]
    coarse = [r["pitch"] for r in rows if r["model"] in (P1, "finite elements, P3")]
    assert coarse == [outcome.runs["finite_element"].levels[0].grid.pitch] * 2
    assert len(rows) == len(levels) + 2 and finest["model"] == "finite elements"
    exact = values_of(outcome.runs["finite_element"].finest, outcome.problem)
    for name, model in (("half-plane", "half_plane"), ("finite elements", "finite_element")):
        mine = [row for row in rows if row["model"] == name]
        for row, level in zip(mine, outcome.runs[model].levels, strict=True):
            value = values_of(level, outcome.problem)["peak_pressure"]
            error = abs(value / exact["peak_pressure"] - 1.0)
            assert (row["peak_pressure"] or 0.0) == pytest.approx(error, rel=1e-9)
            assert row["pitch"] == level.grid.pitch and row["unknowns"] == level.unknowns
            assert row["seconds"] == sum(level.seconds.values()) > 0.0


def test_what_is_left_out_counts_as_error_where_a_whole_is_known():
    """Errors of the half-plane end at its model error, whatever its elements."""
    outcome = run_of(SMOOTH, tolerance={"peak_pressure": 0.02})
    error = outcome.model_errors.one(quantity="peak_pressure")
    last = [row for row in rows_of(outcome) if row["model"] == "half-plane"][-1]
    assert last["peak_pressure"] == pytest.approx(abs(error.value), abs=2.0 * error.numerical)
    [whole] = [row for row in rows_of(outcome) if row["model"] == "whole model"]
    pitch = outcome.data("model_error").wholes[0].grid.pitch
    assert whole["peak_pressure"] is None and whole["pitch"] == pytest.approx(pitch)
    assert outcome.data("ladder") is None or outcome.figures.one(source=WHOLE) is not None


def row(model: str, kind: str, pitch: float, seconds: float, error: float | None) -> dict:
    names = "model", "kind", "pitch", "seconds", "peak_pressure"
    return dict(zip(names, (model, kind, pitch, seconds, error), strict=True))


def chosen(rows: list[dict], floor: float = 0.0) -> list[dict]:
    """The cheapest to 1 % of a peak pressure that is known to `floor`."""
    return cheapest(rows, {"peak_pressure": 0.01}, {"peak_pressure": floor})


P1, P2, PLANE = "finite elements, P1", "finite elements", "half-plane"


def elements(model: str, *errors: float) -> list[dict]:
    """Ever finer levels, each of twice the time."""
    return [row(model, P2, 4.0 / 2**k, 2.0**k, error) for k, error in enumerate(errors)]


class TestCheapest:
    def test_of_each_kind_the_cheapest_that_meets_the_tolerance(self):
        plane = [row(PLANE, PLANE, 4.0, 0.1, 3e-2), row(PLANE, PLANE, 2.0, 0.2, 1e-3)]
        fine = elements(P2, 3e-2, 2e-3, 2e-4)
        assert chosen([*plane, *fine]) == [plane[1], fine[1]]

    def test_none_that_meets_it_by_chance(self):
        """A finer one does not; or it would not in the limit, which a model error keeps away."""
        rows = elements(P2, 1e-5, 5e-2, 1e-3)
        assert chosen(rows) == rows[2:] and chosen(rows[:2]) == []
        assert chosen([*elements(P1, 5e-2, 1e-3), *elements(P2, 5e-2, 3e-2, 2.7e-2)]) == []

    def test_what_the_reference_leaves_unknown_counts_as_error(self):
        rows = elements(P2, 8e-3, 1e-3)
        assert chosen(rows) == rows[:1]
        assert chosen(rows, 5e-3) == rows[1:] and chosen(rows, 2e-2) == []


def test_those_that_apply_beside_what_every_run_solves():
    def names(tables):
        return [model.label for model in methods_of(problem(tables))]

    assert names(SMOOTH) == [PLANE, P2, P1, "finite elements, P3"]
    assert names(LAYER) == [*names(SMOOTH), "half-plane, layered"]
    finite = {"profile": WAVE, "load": {"per_length": 2e5}}
    finite["finite_element"] = {"deformation": "finite"}
    nonlinear = [PLANE, P2, "finite elements, linear", "half-plane, deformed"]
    assert names(SMOOTH | finite) == nonlinear


def test_what_fails_costs_its_row_and_what_there_is_no_time_for_is_not_begun(monkeypatch):
    """One of them as a user may mend it, the other as a defect."""

    solve = Model.solve

    def failing(model, *how):
        if not model.name.startswith("cost-"):
            return solve(model, *how)
        raise InputError("too small") if model.label == "small" else ZeroDivisionError("by\nzero")

    numbers = {"small": (1,), "wrong": (1,), "late": (11,)}
    methods = {Model(f"cost-{n}", "finite elements", label=n): of for n, of in numbers.items()}
    monkeypatch.setattr(cost, "methods_of", lambda problem: methods)
    monkeypatch.setattr(Model, "solve", failing)
    outcome = run(resolved(PLAIN), None, MODELS, known=Known(all_methods=True))
    said = [s.text for s in outcome.findings[cost.NAME].statements if s.name == "left out"]
    small, wrong = (line.partition(": ")[2] for line in said)
    assert small == "too small" and wrong.startswith("ZeroDivisionError: by zero in ")
    assert rows_of(outcome)


@pytest.mark.usefixtures("undrawn")
def test_the_command_is_a_run_that_prints_a_table_of_80_columns(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(
        cost, "methods_of", lambda problem: dict(list(methods_of(problem).items())[:1])
    )
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "small.toml").write_text(as_toml(PLAIN))
    assert main(["cost", "small.toml"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) <= 80
    assert sum(line.startswith("half-plane ") for line in lines) >= 5
    said = " ".join(lines).partition("cheapest for peak pressure to 2 %: ")[2]
    assert "half-plane at" in said.partition("cheapest for")[0]
    assert (tmp_path / "results/small-cost/report.html").exists()
