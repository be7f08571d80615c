"""The cost of a scene: its methods and what their errors are measured by, the cheapest, the files;
what is stopped goes on."""

import io
import json
import os
import signal
import sys
import types
from dataclasses import replace
from pathlib import Path

import pytest
from rich.console import Console
from scenes import SMOOTH, changed, problem, resolved

from analytic.exact.hertz import hertz_from_load
from comparisons.campaigns.cost import cost as cost_module
from comparisons.campaigns.cost import methods as cost_methods
from comparisons.campaigns.cost.cost import (
    FOLDER,
    Cost,
    CostRow,
    Reference,
    assessed,
    content_of,
    cost,
    cost_table,
    is_exact,
    references,
    rows_of,
)
from comparisons.campaigns.cost.methods import (
    HALF_PLANE,
    LAYERED,
    P1,
    P2,
    P3,
    is_half_plane_problem,
    methods_of,
    solved,
)
from comparisons.cli import main
from comparisons.common.cache import NO_CACHE
from comparisons.common.errors import InputError, SceneError
from comparisons.studies.contact import values_of

WAVE = {"kind": "sinusoid", "wavelength": 100e-6, "amplitude": 0.3e-6}
WAVY = SMOOTH | {"profile": WAVE, "load": {"per_length": 2e5}}
HERTZ = hertz_from_load(3.55e6, 7.5706e-3, 210e9 / 0.91 / 2.0)
EXACT = {"peak_pressure": HERTZ.peak_pressure, "contact_length": 2.0 * HERTZ.half_width}
# The command line, with methods and pitches left out that would only take time.
COMMAND = """
import sys
from comparisons.campaigns.cost import cost, methods
from comparisons.cli import main
methods.HALF_PLANE_PITCHES, methods.FINITE_ELEMENT_PITCHES = (2.0, 1.0, 0.5), (2.0, 1.0)
cost.methods_of = lambda problem: (methods.HALF_PLANE, methods.P2)
if __name__ == "__main__":
    sys.exit(main())
"""


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    """Two methods at three and two pitches, and the folder."""
    folder = tmp_path_factory.mktemp("cost") / "out"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(cost_methods, "HALF_PLANE_PITCHES", (2.0, 1.0, 0.5))
        patch.setattr(cost_methods, "FINITE_ELEMENT_PITCHES", (2.0, 1.0))
        patch.setattr(cost_module, "methods_of", lambda problem: (HALF_PLANE, P2))
        return cost(resolved(SMOOTH), folder), folder


class TestWhole:
    def test_every_pitch_is_a_row_measured_by_hertz(self, small):
        known, _ = small
        assert [row.method for row in known.rows] == [HALF_PLANE] * 3 + [P2] * 2
        assert known.left_out == () and known.references["peak_pressure"].row is None
        for row in known.rows:
            for name, exact in EXACT.items():
                error = abs(row.values[0][name] / exact - 1.0)
                assert row.errors[name] == pytest.approx(error, rel=1e-6)
                assert 0.0 < error < 2e-2
        assert 0.0 < known.rows[2].seconds < known.rows[-1].seconds < 5.0
        assert 2e7 < known.rows[2].level.peak_memory < known.rows[-1].level.peak_memory

    def test_files_and_table_say_the_same(self, small):
        known, folder = small
        assert {path.name for path in folder.iterdir()} == {"cost.json", "cost.svg", FOLDER}
        content = json.loads((folder / "cost.json").read_text())
        assert content == json.loads(json.dumps(content_of(known)))
        last = content["cheapest"][-1]
        assert content["rows"][last["row"]]["method"] == P2.name
        assert last["tolerances"].keys() == EXACT.keys()
        assert (folder / "cost.svg").read_text().startswith("<?xml")
        console = Console(width=80, file=io.StringIO())
        console.print(cost_table(known))
        lines = console.file.getvalue().splitlines()
        assert max(map(len, lines)) <= 80
        assert sum(line.startswith(("half-plane", "elements P2")) for line in lines) == 5
        assert "cheapest for peak pressure to 2 %: half-plane at" in " ".join(lines)


def made(method, pitch, seconds, error) -> CostRow:
    """A row whose peak pressure is off by `error`."""
    return CostRow(method, pitch, None, ({},), seconds, errors={"peak_pressure": error})


def chosen(rows: list[CostRow], floor: float = 0.0) -> list[CostRow]:
    """The cheapest to 1 % of an exact peak pressure that is known to `floor`."""
    best = Reference("exact", {"peak_pressure": floor}, ({},))
    scene = types.SimpleNamespace(tolerances={"peak_pressure": 0.01})
    known = Cost(types.SimpleNamespace(scene=scene), tuple(rows), {"peak_pressure": best}, ())
    [aim] = known.aims
    return known.cheapest(aim)


class TestCheapest:
    def test_of_each_model_the_cheapest_that_meets_the_tolerance(self):
        rows = [
            made(HALF_PLANE, 4.0, 0.1, 3e-2),
            made(HALF_PLANE, 2.0, 0.2, 1e-3),
            made(P1, 1.0, 5.0, 1e-3),
            made(P2, 4.0, 1.0, 3e-2),
            made(P2, 2.0, 2.0, 2e-3),
            made(P2, 1.0, 8.0, 2e-4),
        ]
        assert chosen(rows) == [rows[1], rows[4]]
        assert chosen(rows[2:4]) == [rows[2]]

    def test_not_one_that_meets_it_by_chance(self):
        rows = [made(P2, 4.0, 1.0, 1e-5), made(P2, 2.0, 2.0, 5e-2), made(P2, 1.0, 8.0, 1e-3)]
        assert chosen(rows) == rows[2:] and chosen(rows[:2]) == []

    def test_what_the_reference_leaves_unknown_counts_as_error(self):
        rows = [made(P2, 4.0, 1.0, 8e-3), made(P2, 2.0, 2.0, 1e-3)]
        assert chosen(rows) == rows[:1]
        assert chosen(rows, 5e-3) == rows[1:] and chosen(rows, 2e-2) == []


class TestMethods:
    @pytest.mark.parametrize(
        ("sections", "half_plane"),
        [
            ({}, True),
            ({"roller": {"poissons_ratio": 0.2}}, True),
            ({"body": {"thickness": 2e-3}}, False),
            ({"body": {"hardness": 9e9}}, True),
            ({"finite_element": {"roller_shape": "circle"}}, False),
            ({"finite_element": {"roller_body": "disc"}}, False),
        ],
    )
    def test_where_hertz_is_exact(self, sections, half_plane):
        made = problem(changed(SMOOTH, **sections))
        assert is_half_plane_problem(made) is is_exact(made) is half_plane
        assert {HALF_PLANE, P1, P2, P3} <= set(methods_of(made))

    def test_friction_that_moves_the_surfaces_is_not_hertz(self):
        coupled = {"friction": [0.3], "coupled": True}
        assert not is_exact(problem(changed(SMOOTH, roller={"poissons_ratio": 0.0}, load=coupled)))

    def test_models_of_the_ladder_are_solved_where_they_differ(self):
        def names(tables):
            return [m.name for m in methods_of(problem(tables))]

        elements = ["elements P1", "elements P2", "elements P3"]
        assert names(SMOOTH) == ["half-plane", *elements]
        layer = changed(SMOOTH, body={"thickness": 2e-3})
        assert names(layer) == ["half-plane", "half-plane, layered", *elements]
        finite = WAVY | {"finite_element": {"deformation": "finite"}}
        nonlinear = ["elements P2, linear", "elements P2"]
        assert names(finite) == ["half-plane", "half-plane, deformed", *nonlinear]

    def test_a_layer_by_its_operator_meets_finite_elements(self):
        layer = problem(changed(SMOOTH, body={"thickness": 2e-3}))
        plain, operator, elements = (
            solved(method, layer, layer.pitches[1]).solution.pressure.max()
            for method in (HALF_PLANE, LAYERED, P2)
        )
        assert operator == pytest.approx(elements, rel=1e-3)
        assert plain < elements * (1.0 - 1e-2)


class TestRows:
    """Of methods that take no process."""

    @pytest.fixture
    def answers(self, monkeypatch):
        """What stands in for the levels, which are good by default; an error is raised."""
        given, good = {}, solved(HALF_PLANE, problem(SMOOTH), 1e-4)

        def result(tasks, method, problem, pitch, half_block):
            answer = given.get((method, pitch), good)
            if isinstance(answer, Exception):
                raise answer
            return answer, 1.0

        monkeypatch.setattr(cost_module, "_result", result)
        return given

    def test_what_fails_is_said_and_no_finer_one_is_tried(self, answers):
        made = problem(SMOOTH)
        pitches = P1.pitches(made)
        answers[P1, pitches[1]] = InputError("budget.memory: is too small")
        wild = solved(HALF_PLANE, made, 1e-4)
        answers[P2, pitches[0]] = replace(wild, solution=replace(wild.solution, converged=False))
        answers[P3, pitches[0]] = ZeroDivisionError("by\nzero")
        rows, left_out = rows_of(made, methods_of(made)[1:], NO_CACHE)
        assert [(row.method, row.pitch) for row in rows] == [
            (P1, pitches[0]),
            *((P2, pitch) for pitch in pitches[1:]),
        ]
        assert [line.partition(" and finer: ")[2] or line for line in left_out] == [
            "budget.memory: is too small",
            f"elements P2 at {1e6 * pitches[0]:.1f} µm: did not converge",
            "ZeroDivisionError: by zero",
        ]
        with pytest.raises(SceneError, match="no reference for errors: elements P1"):
            assessed(problem(WAVY), rows, left_out)

    def test_what_there_is_no_time_for_is_left_out(self, answers):
        made = problem(SMOOTH | {"budget": {"time": 2.0}})
        rows, left_out = rows_of(made, (HALF_PLANE, P3), NO_CACHE)
        assert sum(row.method == HALF_PLANE for row in rows) == len(HALF_PLANE.pitches(made))
        assert 0 < sum(row.method == P3 for row in rows) < len(P3.pitches(made))
        assert "budget.time" in left_out[0] and len(left_out) == 1


def test_on_a_rough_half_plane_the_finest_is_the_reference_with_its_uncertainty():
    made = problem(WAVY)

    def row(pitch):
        level = solved(HALF_PLANE, made, pitch)
        return CostRow(HALF_PLANE, pitch, level, (values_of(level, made, 0.0),), 1.0)

    rows = [row(pitch) for pitch in HALF_PLANE.pitches(made)[:5]]
    known = assessed(made, rows, ())
    assert references(made, rows[:2]) == {}
    finer = row(0.25 * rows[-1].pitch).values[0]
    for name, best in known.references.items():
        assert best.row is rows[-1] and best.source.startswith("half-plane at ")
        assert abs(best.values[0][name] / finer[name] - 1.0) <= best.floors[name] < 0.05
    errors = [row.errors.get("peak_pressure") for row in known.rows]
    assert errors[-1] is None and errors[0] > 3.0 * errors[2] > 0.0


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["smoth"], "the nearest scene is smooth"),
        (["smooth", "--out", "/dev/null/there"], "/dev/null is not a folder"),
        (["periodic"], "profile.periodic: is true; allowed is a roller"),
    ],
)
def test_wrong_input_is_one_line(arguments, words, capsys):
    assert main(["cost", *arguments]) == 2
    out, err = capsys.readouterr()
    assert out == "" and words in err and err.count("\n") == 1


def saved(out: Path) -> dict[str, int]:
    """What is solved, and when each was written."""
    return {path.name: path.stat().st_mtime_ns for path in (out / FOLDER).glob("*.npz")}


def test_a_ctrl_c_ends_it_and_the_same_command_goes_on(tmp_path, started, until):
    (tmp_path / "small.toml").write_text(
        "roller = {radius = 7.5706e-3, youngs_modulus = 210e9, poissons_ratio = 0.3}\n"
        "body = {youngs_modulus = 210e9, poissons_ratio = 0.3}\n"
        "load = {per_length = 3.55e6}\n"
    )
    (tmp_path / "program.py").write_text(COMMAND)
    out = tmp_path / "out"
    program, scene = tmp_path / "program.py", tmp_path / "small.toml"
    words = sys.executable, program, "cost", scene, "--out", out
    with started(*words) as process:
        assert until(lambda: len(saved(out)) >= 1)
        os.killpg(process.pid, signal.SIGINT)  # as a terminal does
        assert process.wait(20.0) == 130
        said = process.stderr.read()  # nobody holds it any more
    assert said == (
        "crosscheck: interrupted; finished levels are kept, the same command goes on from there\n"
    )
    before = saved(out)
    assert 1 <= len(before) < 5 and not (out / "cost.json").exists()
    with started(*words) as process:
        printed, said = process.communicate(timeout=120.0)
        assert process.returncode == 0 and said == "" and "cost.svg" in printed
    assert before.items() <= saved(out).items() and len(saved(out)) == 5
    assert len(json.loads((out / "cost.json").read_text())["rows"]) == 5
