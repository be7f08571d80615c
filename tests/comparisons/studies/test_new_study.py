"""A study is one file and one name: whatever shows, judges, stores or repeats has it from there.
Its section of a scene is one more file, which nothing names.

The study is the mean pressure in the contact, of smooth bodies pi/4 of the largest."""

import csv
import json
import math
import os
from pathlib import Path
from xml.etree import ElementTree

import pytest
from scenes import PROJECT, python

from comparisons.output.result import read_result

STUDY = '''
"""The mean pressure in the contact."""
import math

from comparisons.figures.convergence import grid_convergence
from comparisons.figures.figure import Figure, Findings, Statement
from comparisons.figures.quantity import Quantity
from comparisons.figures.uncertainty import Uncertainty, iteration
from comparisons.judging.study import Study

NAME = "mean_pressure"
QUANTITIES = {
    "mean_pressure": Quantity("mean pressure", "Pa"),
    "mean_over_peak": Quantity("mean over largest pressure"),
}


def solve(solved, before, tasks):
    problem, run = solved.problem, solved.runs["half_plane"]
    load = problem.hertz.load_per_length
    means = [load / level.contact_length for level in run.levels]
    refined = grid_convergence(means, 1.0, 1e-3 * means[-1])
    left = refined.uncertainty / means[-1]
    parts = {"iteration": iteration(run.finest.solution), "discretisation": left}
    stated = Uncertainty(parts, refined)
    ratio = means[-1] / run.finest.solution.pressure.max()
    exact, tolerance = math.pi / 4.0, problem.scene.mean_pressure.tolerance
    at = {"friction": max(problem.scene.load.friction)}
    common = {"study": NAME, "source": "half_plane", "at": at, "uncertainty": stated}
    return Findings(
        (
            Figure(quantity="mean_pressure", value=means[-1], scale=means[-1], **common),
            Figure(
                quantity="mean_over_peak", value=ratio / exact - 1.0, against="exact",
                scale=exact, bounds=(-tolerance, tolerance), **common
            ),
        ),
        statements=(Statement("state", "bears on the whole contact"),),
    )


STUDY = Study(
    NAME,
    QUANTITIES,
    solve,
    applies=lambda solved: solved.problem.scene.mean_pressure is not None,
    title="Mean pressure",
    note="A note.",
)
'''
SECTION = '''
"""The [mean_pressure] section: what is allowed."""
from comparisons.scenes.fields import Fraction, SceneSection


class MeanSection(SceneSection):
    tolerance: Fraction


SECTION = MeanSection
'''
WITH_IT = """
import sys
import comparisons.scenes.studies
comparisons.scenes.studies.__path__.append("sections")
import comparisons.studies
import mean_pressure
comparisons.studies.STUDIES += (mean_pressure.STUDY,)
from comparisons.drawing import style
style.svg = lambda drawn: ""
from comparisons.cli import main
sys.exit(main(sys.argv[1:]))
"""
SCENE = """
roller = {radius = "8 mm", youngs_modulus = "210 GPa", poissons_ratio = 0.3}
body = {youngs_modulus = "210 GPa", poissons_ratio = 0.3}
load = {per_length = "1 N/um", friction = 0.1}
mean_pressure = {tolerance = 0.02}
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    """A scene that was solved with the study."""
    folder = tmp_path_factory.mktemp("study")
    (folder / "mean_pressure.py").write_text(STUDY)
    (folder / "sections").mkdir()
    (folder / "sections/mean_pressure.py").write_text(SECTION)
    (folder / "scene.toml").write_text(SCENE)
    asked = ("run", "scene.toml", "--models", "half-plane", "--out", "out", "--junit", "ci.xml")
    (folder / "terminal.txt").write_text(command(folder, *asked))
    return folder


def command(folder: Path, *arguments: str, status: int = 0) -> str:
    """Output of crosscheck with the study."""
    found = f"{PROJECT}{os.pathsep}{folder}"
    done = python("-c", WITH_IT, *arguments, cwd=folder, PYTHONPATH=found)
    assert done.returncode == status, done.stderr
    return done.stdout + done.stderr


def test_its_figures_are_results(folder):
    figures = read_result(folder / "out").figures.of(study="mean_pressure")
    mean, ratio = figures
    assert (mean.quantity, ratio.against, ratio.friction) == ("mean_pressure", "exact", 0.1)
    hertz = read_result(folder / "out").figures.of(source="hertz")
    peak = hertz.one(quantity="peak_pressure").value
    assert mean.value == pytest.approx(0.25 * math.pi * peak, rel=2e-3)
    assert abs(ratio.value) <= ratio.numerical < 0.01 and ratio.verdict == "agree"


def test_terminal_page_and_tables_have_it(folder):
    terminal, page = ((folder / name).read_text() for name in ("terminal.txt", "out/report.html"))
    assert "mean pressure  mean over largest pressure " in terminal and ", agree at 2%" in terminal
    assert "Mean pressure" in page and "A note." in page and "bears on the whole contact" in page
    rows = csv.DictReader(command(folder, "table", "--csv", "out").splitlines())
    [row] = [row for row in rows if row["quantity"] == "mean_pressure"]
    assert row["unit"] == "Pa" and float(row["uncertainty"]) > 0.0


def test_continuous_integration_has_it(folder):
    cases = ElementTree.parse(folder / "ci.xml").iter("testcase")
    [case] = [case for case in cases if "mean_over_peak" in case.attrib["name"]]
    assert {part.tag for part in case} == {"system-out"}  # neither failed nor skipped


def test_a_wrong_field_of_its_section_is_one_line(folder):
    (folder / "wrong.toml").write_text(SCENE.replace("tolerance", "tolerances"))
    said = command(folder, "run", "wrong.toml", status=2)
    wanted = "mean_pressure.tolerances: is no known field; the nearest is mean_pressure.tolerance"
    assert wanted in said
    assert said.count("\n") == 1


def test_a_repetition_finds_what_moved(folder):
    assert "no figure moved" in command(folder, "rerun", "out")
    path = folder / "out/result.json"
    result = json.loads(path.read_text())
    [mean] = [f for f in result["figures"] if f["quantity"] == "mean_pressure"]
    mean["value"] *= 1.1
    path.write_text(json.dumps(result))
    assert "mean_pressure" in command(folder, "rerun", "out", status=1)
