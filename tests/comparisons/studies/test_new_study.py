"""A study is one file and one name: whatever shows, judges, stores or repeats has it from there.
Its section of a scene is one more file, which nothing names.

The study is partial slip: what sticks under a tangential load Q below friction is the contact under
P - Q/mu (Jaeger 1998), of smooth bodies of half-width a sqrt(1 - Q/(mu P)) (Cattaneo, Mindlin)."""

import csv
import json
import math
import os
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest
from scenes import PROJECT

from comparisons.output.record import read_result

STUDY = '''
"""How much of the contact sticks under half of the tangential load that makes it slide."""
import numpy as np

from analytic.contact.patches import contact_patches
from comparisons.drawing.blocks import Block, Heading, Note, TextTable
from comparisons.figures.convergence import grid_convergence
from comparisons.figures.figure import Figure, Findings, Statement
from comparisons.figures.quantity import Quantity
from comparisons.figures.uncertainty import Uncertainty, iteration
from comparisons.studies.study import Study

NAME = "partial_slip"
QUANTITIES = {
    "stick_length": Quantity("length that sticks", "m"),
    "stick_ratio": Quantity("share of the contact that sticks"),
}


def solve(solved, before, tasks):
    problem, run = solved.problem, solved.runs["half_plane"]
    rest = 1.0 - problem.scene.partial_slip.share
    left, lengths = rest * problem.hertz.load_per_length, []
    for level in run.levels:
        from analytic.operators.half_plane import HalfPlane
        from comparisons.models.problem import pressed_on

        operator = HalfPlane(level.grid.count, level.grid.pitch, problem.modulus)
        solution = pressed_on(problem, level.grid, operator, problem.constraints(left))
        stuck = contact_patches(level.grid.x, solution.pressure, solution.gap)
        lengths.append(float(np.ptp(stuck, axis=1).sum()))
    refined = grid_convergence(lengths, 1.0, 0.1 * run.finest.grid.pitch)
    left = refined.uncertainty / lengths[-1]
    stated = Uncertainty({"iteration": iteration(run.finest), "discretisation": left}, refined)
    ratio = lengths[-1] / run.finest.contact_length
    exact = rest**0.5
    at = {"friction": max(problem.scene.load.friction)}
    common = {"study": NAME, "source": "half_plane", "at": at, "uncertainty": stated}
    return Findings(
        (
            Figure(quantity="stick_length", value=lengths[-1], scale=lengths[-1], **common),
            Figure(
                quantity="stick_ratio", value=ratio / exact - 1.0, against="cattaneo_mindlin",
                scale=exact, bounds=(-0.02, 0.02), **common
            ),
        ),
        statements=(Statement("state", "sticks in the middle"),),
    )


def blocks(run):
    length, _ = run.found[NAME].figures
    rows = (("stuck", f"{1e6 * length.value:.1f} um"),)
    table = TextTable("Stick", ("", "length"), rows)
    return [Block("yield", (Heading("Partial slip"), table, Note("A note.")))]


STUDY = Study(
    NAME,
    QUANTITIES,
    solve,
    applies=lambda solved: solved.problem.scene.partial_slip is not None,
    blocks=blocks,
    lines=lambda run: [("partial slip", run.found[NAME].said("state"))],
)
'''
SECTION = '''
"""The [partial_slip] section: the tangential load."""
from typing import Annotated

from comparisons.common.units import DIMENSIONLESS
from comparisons.scenes.fields import Number, SceneSection


class SlipSection(SceneSection):
    share: Annotated[float, Number(DIMENSIONLESS, above=0.0, below=1.0)]


SECTION = SlipSection
'''
WITH_IT = """
import sys
import comparisons.scenes.studies
comparisons.scenes.studies.__path__.append("sections")
import comparisons.studies
import partial_slip
comparisons.studies.STUDIES += (partial_slip.STUDY,)
from comparisons.cli import main
sys.exit(main(sys.argv[1:]))
"""
SCENE = """
roller = {radius = "8 mm", youngs_modulus = "210 GPa", poissons_ratio = 0.3}
body = {youngs_modulus = "210 GPa", poissons_ratio = 0.3}
load = {per_length = "1 N/um", friction = 0.1}
partial_slip = {share = 0.5}
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    """A scene that was solved with the study."""
    folder = tmp_path_factory.mktemp("study")
    (folder / "partial_slip.py").write_text(STUDY)
    (folder / "sections").mkdir()
    (folder / "sections/partial_slip.py").write_text(SECTION)
    (folder / "scene.toml").write_text(SCENE)
    asked = ("run", "scene.toml", "--models", "half-plane", "--out", "out", "--junit", "ci.xml")
    (folder / "terminal.txt").write_text(command(folder, *asked))
    return folder


def command(folder: Path, *arguments: str, status: int = 0) -> str:
    """What crosscheck prints, with the study."""
    environment = os.environ | {"PYTHONPATH": f"{PROJECT}{os.pathsep}{folder}"}
    done = subprocess.run(
        [sys.executable, "-c", WITH_IT, *arguments],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
    )
    assert done.returncode == status, done.stderr
    return done.stdout + done.stderr


def test_its_figures_are_results(folder):
    figures = read_result(folder / "out/result.json").figures.of(study="partial_slip")
    length, ratio = figures
    assert (length.quantity, ratio.against, ratio.friction) == (
        *("stick_length", "cattaneo_mindlin"),
        0.1,
    )
    hertz = read_result(folder / "out/result.json").figures.one(source="hertz").value
    assert length.value == pytest.approx(2.0 * hertz * math.sqrt(0.5), rel=2e-3)
    assert abs(ratio.value) <= ratio.numerical < 0.01 and ratio.verdict == "agree"


def test_terminal_page_and_tables_have_it(folder):
    assert "sticks in the middle" in (folder / "terminal.txt").read_text()
    page = (folder / "out/report.html").read_text()
    assert "Partial slip" in page and "A note." in page
    rows = csv.DictReader(command(folder, "table", "--long", "out").splitlines())
    [row] = [row for row in rows if row["quantity"] == "stick_length"]
    assert row["unit"] == "m" and float(row["uncertainty"]) > 0.0


def test_continuous_integration_has_it(folder):
    cases = ElementTree.parse(folder / "ci.xml").iter("testcase")
    [case] = [case for case in cases if "stick_ratio" in case.attrib["name"]]
    assert {part.tag for part in case} == {"system-out"}  # neither failed nor skipped


def test_a_wrong_field_of_its_section_is_one_line(folder):
    (folder / "wrong.toml").write_text(SCENE.replace("share = 0.5", "shares = 0.5"))
    said = command(folder, "run", "wrong.toml", status=2)
    assert "partial_slip.shares: is no known field; the nearest is partial_slip.share" in said
    assert said.count("\n") == 1


def test_a_repetition_finds_what_moved(folder):
    assert "no figure moved" in command(folder, "rerun", "out")
    path = folder / "out/result.json"
    result = json.loads(path.read_text())
    [length] = [f for f in result["figures"] if f["quantity"] == "stick_length"]
    length["value"] *= 1.1
    path.write_text(json.dumps(result))
    assert "stick_length" in command(folder, "rerun", "out", status=1)
