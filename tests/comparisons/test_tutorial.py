"""The tutorial's notebook runs and says what stands in it; pictures show; scripts need no guard."""

import ast
import json

import matplotlib
import pytest
from scenes import PROJECT, python

from comparisons.drawing.style import collected_figures

NOTEBOOK = PROJECT / "comparisons/docs/tutorial.ipynb"
SCRIPT = """import comparisons as crosscheck
steel = {"youngs_modulus": 210e9, "poissons_ratio": 0.3}
smooth = {"roller": {"radius": 8e-3, **steel}, "body": steel, "load": {"per_length": 1e6}}
print(len(crosscheck.sweep(smooth, {"load": [1e6, 2e6]}, workers=2).content["points"]))
"""


def test_the_tutorial_runs_and_its_answers_stand_in_it():
    from matplotlib import pyplot

    names: dict = {}
    answers = {}
    for cell in json.loads(NOTEBOOK.read_text(encoding="utf-8"))["cells"]:
        if cell["cell_type"] != "code":
            continue
        tree = ast.parse("".join(cell["source"]))
        last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, str(NOTEBOOK), "exec"), names)
        if last is not None:
            value = eval(compile(ast.Expression(last.value), str(NOTEBOOK), "eval"), names)
            shown = [o["data"]["text/plain"] for o in cell["outputs"] if "data" in o]
            answers[ast.unparse(last)] = value, "".join(map("".join, shown))
    pyplot.close("all")
    (verdict, error), shown = answers[next(key for key in answers if "verdict" in key)]
    there = ast.literal_eval(shown)
    assert verdict == there[0] and error == pytest.approx(there[1], abs=2e-4)
    suffices, shown = answers["checked.result['suffices']"]
    assert suffices == ast.literal_eval(shown)
    spread, shown = answers["spread"]
    assert len(spread.content["points"]) == 8
    assert repr(spread).splitlines()[0] == shown.splitlines()[0]


def test_figures_stay_interactive_where_they_are():
    from matplotlib import pyplot

    before = matplotlib.rcParams["interactive"]
    try:
        for wanted in (True, False):
            matplotlib.rcParams["interactive"] = wanted
            with collected_figures():
                assert pyplot.isinteractive() is wanted
            assert pyplot.isinteractive() is wanted
    finally:
        matplotlib.rcParams["interactive"] = before


def test_a_script_without_a_guard_sweeps(tmp_path):
    (tmp_path / "script.py").write_text(SCRIPT)
    done = python(tmp_path / "script.py", env={})
    assert (done.stdout, done.returncode) == ("2\n", 0), done.stderr
