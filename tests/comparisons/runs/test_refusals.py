"""Scenes that cannot be solved are refused; a budget that is spent leaves the question open."""

import pytest
from scenes import QUICK, changed, resolved

from comparisons.common.errors import SceneError
from comparisons.figures.quantity import MODELS
from comparisons.runs.run import run

pytestmark = pytest.mark.usefixtures("undrawn")


@pytest.mark.parametrize(
    ("sections", "words"),
    [
        (
            {"body": {"hardness": 1e8, "width": 1e-2}},
            "carries the load on .* m, more than the roller",
        ),
        ({"resolution": {"pitch": 1e-12}}, "pressure elements at the finest"),
        ({"resolution": {"pitch": 1e-2}}, "allowed is at most"),
        ({"body": {"width": 1e-3}}, "reaches the end of the body"),
        ({"budget": {"memory": 1e7}}, "budget.memory"),
        (
            {
                "profile": {"kind": "sinusoid", "wavelength": 5e-5, "amplitude": 1e-7}
                | {"length": 6e-4}
            },
            "reaches the end of the trace",
        ),
    ],
)
def test_a_scene_that_cannot_be_solved_is_refused_and_writes_nothing(tmp_path, sections, words):
    with pytest.raises(SceneError, match=words) as refusal:
        run(resolved(changed(QUICK, **sections)), tmp_path / "out", MODELS)
    assert "\n" not in str(refusal.value) and str(refusal.value).startswith("made.toml: ")
    assert list(tmp_path.iterdir()) == []


def test_a_spent_budget_leaves_the_question_open(tmp_path):
    tables = changed(
        QUICK, budget={"time": 0.01}, tolerance={"tau1_max": 1e-5, "peak_pressure": 1e-5}
    )
    outcome = run(resolved(tables), tmp_path / "out", MODELS)
    assert "budget.time" in outcome.solved.refinement
    verdicts = {row.quantity: row.verdict for row in outcome.figures.of(study="comparison")}
    assert verdicts["peak_pressure"] == "inconclusive"


def test_a_level_that_would_not_fit_is_not_begun(tmp_path):
    """Room for the three planned levels and none for a fourth."""
    tables = changed(QUICK, budget={"memory": 2.9e8}, tolerance={"peak_pressure": 1e-6})
    outcome = run(resolved(tables), tmp_path / "out", MODELS)
    assert "budget.memory" in outcome.solved.refinement
    assert len(outcome.runs["finite_element"].levels) == 3
