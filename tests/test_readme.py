"""The README against the project: its commands, scene, files, links, table and bounds.

The scene of five lines is run as it stands, on a small profile made here. `ground-unrun` is solved
by the half-plane, whose column must be the README's; `tests/comparisons` runs it by both models.
"""

import ast
import io
import re
import shlex
import shutil
import sys
import tomllib
from contextlib import redirect_stdout
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
import readme_picture
from scenes import half_plane_at, page_rows

import comparisons
from comparisons.cli import main
from comparisons.common.errors import ExitStatus
from comparisons.common.files import OWN_FILES, OWN_FOLDERS
from comparisons.figures.quantity import MODELS
from comparisons.judging.effects.estimates import BOUNDARY_PER_SLOPE_SQUARED, STRAIN, TILT
from comparisons.judging.rule import values_of
from comparisons.judging.study import Run
from comparisons.models.posing import problem_of
from comparisons.output.terminal import SHORT
from comparisons.runs import run as run_module
from comparisons.scenes.scene import Origin, Scene

PROJECT = Path(__file__).resolve().parents[1]
README = (PROJECT / "README.md").read_text(encoding="utf-8")
GUIDE, REFERENCE, LIMITS, EXACT, WHOLE = (
    (PROJECT / f"comparisons/docs/{name}.md").read_text(encoding="utf-8")
    for name in ("user_guide", "reference", "limits", "evidence/exact", "whole_method")
)
IN_UNITS = {"GPa": 1e9, "um": 1e-6}


def blocks(kind: str, page: str = README) -> list[str]:
    """The fenced blocks of a kind on a page."""
    return re.findall(rf"^```{kind}\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)


def fenced(kind: str, page: str = README) -> str:
    return blocks(kind, page)[0]


COMMANDS = [command for text in blocks("console") for command in text.splitlines()]


def in_ticks(text: str) -> list[str]:
    return re.findall(r"`([^`]+)`", text)


@dataclass(frozen=True)
class Call:
    """A command that was run: its status, what it printed, and the run behind it."""

    status: int
    printed: str
    outcome: Run | None


def call(arguments: list[str], folder: Path) -> Call:
    """`crosscheck` with these arguments, in a folder."""
    outcomes, original = [], run_module.solve_scene

    def watched(scene: Scene, *arguments: object) -> Run:
        """Run with fewer points of the fields, which take half the time of all effects."""
        outcomes.append(original(scene.changed("stress.points", [150, 60]), *arguments))
        return outcomes[-1]

    with pytest.MonkeyPatch.context() as patch, redirect_stdout(io.StringIO()) as printed:
        patch.chdir(folder)
        patch.setattr(run_module, "solve_scene", watched)
        status = main(arguments)
    return Call(status, printed.getvalue(), outcomes[0] if outcomes else None)


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    """The README's own scene, and a small profile where it looks for one."""
    folder = tmp_path_factory.mktemp("readme")
    (folder / "mine.toml").write_text(fenced("toml"))
    x = np.linspace(-1200.0, 1200.0, 481)
    height = 0.1 * np.cos(x / 32.0) + 0.05 * np.sin(x / 53.0)
    table = np.column_stack([x, height])
    trace = folder / tomllib.loads(fenced("toml"))["profile"]["file"]
    np.savetxt(trace, table, delimiter=",", header="x_um,height_um", comments="")
    return folder


@pytest.fixture(scope="module")
def mine(folder) -> Call:
    [command] = [command for command in COMMANDS if command.endswith("run mine.toml")]
    return call(shlex.split(command)[1:], folder)


@pytest.fixture(scope="module")
def unrun() -> dict[float, dict[str, float]]:
    """Figures of the half-plane on the README's first scene, by friction coefficient, on the level
    with which its run ends: one more than it begins with."""
    problem = problem_of(Scene.read("ground-unrun"))
    levels = {}
    for mu in problem.scene.load.friction:
        level = half_plane_at(problem.under(mu), problem.pitches[-1] / 2.0, fields=True)
        levels[mu] = values_of(level, problem)
    return levels


def test_init_is_the_door_that_it_says(folder, tmp_path):
    """How rough, what error to expect, and a scene that is read as it was written."""
    [command] = [command for command in COMMANDS if " init " in command]
    shutil.copy(folder / "trace.csv", tmp_path)
    made = call(shlex.split(command)[1:], tmp_path)
    assert made.status == ExitStatus.DONE
    assert "Rq" in made.printed and "left out, by estimates at most: peak " in made.printed
    assert Scene.read(tmp_path / "trace.toml").profile is not None


def test_commands_in_passing_work(tmp_path):
    """The doctor's findings, and the studies, are tested with them: they take seconds and more."""
    named = {
        command.split()[0]
        for command in re.findall(r"`\./crosscheck ([^`]+)`", README + GUIDE + REFERENCE + LIMITS)
        if not command.startswith(("-", "test", "COMMAND"))
    }
    studies = {"run", "cost", "map", "sweep", "verify", "stability", "rerun"}
    assert named == {"scenes", "materials", "deck", "doctor", "init", "report", "table", *studies}
    for arguments in (["scenes"], *([name, "--help"] for name in sorted(named - {"scenes"}))):
        done = call(arguments, tmp_path)
        assert done.status == ExitStatus.DONE and done.printed


def test_own_scene_has_five_lines_and_works(mine):
    assert len(fenced("toml").splitlines()) == 5
    assert mine.status == ExitStatus.DONE
    assert "HOLDS" in mine.printed
    assert all(run.finest.solution.converged for run in mine.outcome.runs.values())


@pytest.mark.parametrize("block", blocks("toml", GUIDE), ids=lambda block: block.split()[0])
def test_every_example_of_the_guide_is_a_scenes(block, folder):
    tables = tomllib.loads(fenced("toml")) | tomllib.loads(block)
    Scene.of(tables, Origin("example", folder, "example.toml"))


def test_files_are_those_that_a_run_leaves(mine, folder):
    named = {
        name.replace("<model>", model)
        for [cell, _] in page_rows(README, "file")
        for name in in_ticks(cell)
        for model in OWN_FOLDERS
    }
    out = folder / mine.outcome.directory
    left = {str(path.relative_to(out)) for path in out.rglob("*") if path.is_file()}
    assert named == {name.replace("/**", "") for name in OWN_FILES}
    # their rows say when they are there
    sometimes = {"run_in_profile.csv", "report.pdf", "whole/contact.csv", "whole/stress.vtu"}
    assert named - left <= sometimes


def test_columns_and_arrays_are_those_that_the_files_hold(mine, folder):
    import meshio

    said = {cell: text for [cell, text] in page_rows(README, "file")}
    out = folder / mine.outcome.directory
    for model in MODELS:
        header = (out / model / "contact.csv").read_text().splitlines()[2]
        assert said["`<model>/contact.csv`"].split(", ") == header.split(",")
        arrays = meshio.read(out / model / "stress.vtu").point_data
        listed = said["`<model>/stress.vtu`"].partition(", for")[0].replace(" [Pa]", "").split(", ")
        held = list(dict.fromkeys(name.partition(" (")[0] for name in arrays))
        assert held[: len(listed)] == listed
        # what the finite elements' have besides stands in the reference
        beside = [f"{who}_{name}" for name in listed[:-1] for who in ("half_plane", "difference")]
        more = ["displacement", *beside] if model == "finite_element" else []
        assert held[len(listed) :] == more
        for name in ("displacement", "half_plane_tau1", "difference_tau1"):
            assert f"`{name}`" in REFERENCE


def test_a_stranger_reads_it_in_one_sitting():
    assert len(README.splitlines()) <= 110


def test_python_lines_work(monkeypatch):
    monkeypatch.setitem(sys.modules, "crosscheck", comparisons)  # as where it is installed
    names: dict = {}
    with redirect_stdout(io.StringIO()) as printed:
        exec(fenced("python", GUIDE), names)
    assert "peak pressure" in printed.getvalue()
    assert f"{names['peak'].value:.4g}".startswith("4.15")  # GPa, by Hertz
    assert names["axes"][0].get_ylabel() == "p/p₀"
    face = page_rows(REFERENCE, "of `crosscheck`")
    listed = [name for [cell, _] in face for name in in_ticks(cell)]
    assert sorted(listed) == sorted(names["crosscheck"].__all__)


def test_exit_statuses_are_the_programs():
    named = [
        int(number)
        for [numbers, _] in page_rows(REFERENCE, "exit status")
        for number in numbers.split(",")
    ]
    assert named == list(ExitStatus)


def shown_rows() -> list[tuple[str, str, list[str]]]:
    """Rows of the table that is shown: quantity in result.json, friction, half-plane, whole model,
    error, uncertainty, tolerance and largest part."""
    names = {label: name for name, label in SHORT.items()}
    number, unit = r"([+-]?[\d.]+)", r"([\d.]+ \w+)"
    row = re.compile(rf"(.+?) +([\d.]+) +{unit} +{unit} +{number} +{number} +{number} +(.+)")
    lines = fenced("text").split("─\n")[1].split("\n\n")[0].splitlines()
    shown = [row.fullmatch(line).groups() for line in lines]
    return [(names[label], friction, cells) for label, friction, *cells in shown]


def test_shown_table_has_what_is_judged_and_the_look_of_a_run(mine):
    shown = fenced("text")
    assert {name for name, _, _ in shown_rows()} == {"peak_pressure", "contact_length", "tau1_max"}
    heads = [
        re.split("─+\n", text)[0].partition("model error of")[2] for text in (shown, mine.printed)
    ]
    assert heads[0].split() == heads[1].split() and len(heads[0].split()) > 10
    for text in (shown, mine.printed):
        assert "elements that assume the same agree: largest difference" in " ".join(text.split())


def test_shown_figures_are_the_half_planes_and_make_the_errors(unrun):
    for name, friction, (half_plane, whole, error, *_) in shown_rows():
        cells = map(str.split, (half_plane, whole))
        values = [float(number) * IN_UNITS[unit] for number, unit in cells]
        assert values[0] == pytest.approx(unrun[float(friction)][name], rel=3e-3)
        assert 100.0 * (values[0] / values[1] - 1.0) == pytest.approx(float(error), abs=0.11)
    assert len(shown_rows()) == 6


def numbers_in(test: str) -> set[float]:
    """Every number in the source of a test, decorators and all."""
    path, *names = test.split("::")
    node = ast.parse((PROJECT / path).read_text())
    for name in names:
        [node] = [n for n in node.body if getattr(n, "name", None) == name]
    return {
        n.value
        for n in ast.walk(node)
        if isinstance(n, ast.Constant) and isinstance(n.value, float | int)
    }


@pytest.mark.parametrize("row", page_rows(EXACT, "figure"), ids=lambda row: row[0])
def test_bounds_are_those_of_the_tests_that_are_named(row):
    _, _, error, bound, test = row
    assert 0.0 < float(error) < float(bound)
    assert float(bound) in numbers_in(*in_ticks(test))


def test_effects_have_the_estimates_that_are_named():
    assert "a quarter of a/R" in LIMITS and TILT == 1 / 4
    assert "three tenths of peak pressure over E" in LIMITS and STRAIN == 3 / 10
    assert "the slope's mean square" in LIMITS and BOUNDARY_PER_SLOPE_SQUARED == 1


def test_the_whole_method_fits_on_a_page_and_works():
    """Three levels by both models; the lines printed are those that the page shows."""
    code, shown = fenced("python", WHOLE), fenced("text", WHOLE)
    assert len(code.splitlines()) <= 75
    with redirect_stdout(io.StringIO()) as printed:
        exec(code, {})
    lines, page = printed.getvalue().splitlines(), shown.splitlines()
    assert len(lines) == len(page) == 3
    for line, wanted in zip(lines, page, strict=True):
        assert line.split(":")[0] == wanted.split(":")[0]
        assert line.split()[-1] == wanted.split()[-1] == "agree"
        difference, uncertainty = (float(n) for n in re.findall(r"([+-]?[\d.]+)%", line))
        assert abs(difference) < 0.3 and 0.0 < uncertainty <= 0.3


def test_the_picture_is_the_readmes_and_twice_800_pixels_across():
    [link] = re.findall(r"!\[[^\]]+\]\(([^)]+)\)", README)
    assert (PROJECT / link).samefile(readme_picture.PICTURE)
    head = readme_picture.PICTURE.read_bytes()[:20]
    assert head.startswith(b"\x89PNG\r\n\x1a\n")
    assert int.from_bytes(head[16:], "big") == pytest.approx(1600, abs=10)
