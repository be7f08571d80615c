"""Scenes that cannot be solved are refused; a budget that is spent leaves the question open."""

from pathlib import Path

import pytest

from comparisons.common.errors import SceneError
from comparisons.common.quantities import MODELS
from comparisons.runs.run import run
from comparisons.scenes.resolve import resolve_tables

pytestmark = pytest.mark.usefixtures("undrawn")
STEEL = {"youngs_modulus": 210e9, "poissons_ratio": 0.3}
SMOOTH = {
    "title": "smooth",
    "roller": {"radius": 7.5706e-3, **STEEL},
    "body": dict(STEEL),
    "load": {"per_length": 3.55e6},
    "stress": {"points": [120, 40]},
    "budget": {"effects": False},
}


def scene_of(tables, name="scene", folder=Path(".")):
    return resolve_tables(tables, name=name, folder=folder, source=f"{name}.toml")


def changed(tables, **sections):
    """The tables with some sections' fields replaced."""
    return {
        **tables,
        **{name: {**tables.get(name, {}), **fields} for name, fields in sections.items()},
    }


class TestRefusals:
    @pytest.mark.parametrize(
        ("sections", "words"),
        [
            ({"body": {"hardness": 1e8, "width": 1e-2}}, "at this hardness .* reaches the end"),
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
    def test_a_scene_that_cannot_be_solved_is_refused_and_writes_nothing(
        self, tmp_path, sections, words
    ):
        with pytest.raises(SceneError, match=words) as refusal:
            run(scene_of(changed(SMOOTH, **sections)), tmp_path / "out", MODELS)
        assert "\n" not in str(refusal.value) and str(refusal.value).startswith("scene")
        assert list(tmp_path.iterdir()) == []

    def test_a_spent_budget_leaves_the_question_open(self, tmp_path):
        tables = changed(
            SMOOTH, budget={"time": 0.01}, tolerance={"tau1_max": 1e-5, "peak_pressure": 1e-5}
        )
        outcome = run(scene_of(tables), tmp_path / "out", MODELS)
        assert "budget.time" in outcome.result["refinement"]
        verdicts = {row.quantity: row.verdict for row in outcome.comparisons}
        assert verdicts["peak_pressure"] == "inconclusive"

    def test_a_level_that_would_not_fit_is_not_begun(self, tmp_path):
        """Room for the three planned levels and none for a fourth."""
        tables = changed(SMOOTH, budget={"memory": 1.5e8}, tolerance={"peak_pressure": 1e-6})
        outcome = run(scene_of(tables), tmp_path / "out", MODELS)
        assert "budget.memory" in outcome.result["refinement"]
        assert len(outcome.runs["finite_element"].levels) == 3
