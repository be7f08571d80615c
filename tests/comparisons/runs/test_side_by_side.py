"""A run in several processes: the figures of one process, to the last bit."""

import json
from pathlib import Path

from scenes import python, without_cost

SCENE = """
roller = {radius = "8 mm", rigid = true}
body = {youngs_modulus = "210 GPa", poissons_ratio = 0.3}
profile = {kind = "sinusoid", wavelength = "150 um", amplitude = "0.3 um"}
load = {hertz_peak_pressure = "2 GPa", friction = 0.2}
budget = {time = 1.0}
resolution = {pitch = "20 um", levels = 2}
stress = {points = [20, 10]}
finite_element = {block = 40}
"""
RUN = """
import os, pathlib, sys
import comparisons.output.page.page
comparisons.output.page.page.render = lambda *_: ""
from comparisons.common import tasks
tasks.WORTH_A_FORK = 0.0
os.sched_getaffinity = lambda process: set(range({cores}))
start = tasks._process
def started(serve):
    pathlib.Path("started").open("a").write("*")
    return start(serve)
tasks._process = started
from comparisons.cli import entry
sys.argv = ["crosscheck", "run", "scene.toml", "--out", "out"]
entry()
"""


def test_figures_are_those_of_one_process(tmp_path):
    results = {cores: result(tmp_path / str(cores), cores) for cores in (1, 2)}
    [effects] = [entry for entry in results[1]["series"] if entry["name"] == "effects"]
    assert "finite_strain" in effects["columns"]["effect"]
    one, two = (json.dumps(without_cost(result)) for result in results.values())
    assert one == two


def result(folder: Path, cores: int) -> dict:
    """result.json of a run on so many cores."""
    folder.mkdir()
    (folder / "scene.toml").write_text(SCENE)
    done = python("-c", RUN.format(cores=cores), cwd=folder, OMP_NUM_THREADS="1")
    assert done.returncode in (0, 1, 4), done.stderr
    assert len((folder / "started").read_text()) == cores
    return json.loads((folder / "out/result.json").read_text())
