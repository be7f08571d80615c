"""Every picture of contacts that lie anywhere: random ridges, positions, loads, lost heights."""

from pathlib import Path

import numpy as np
import pytest
from scenes import STEEL, resolved

from comparisons.common.errors import SceneError
from comparisons.figures.quantity import MODELS
from comparisons.judging.study import Run
from comparisons.output.page import page
from comparisons.output.page.pictures.answer import overview_picture
from comparisons.runs.run import run

RADIUS = 10e-3
COARSE = {"resolution": {"levels": 2, "nodes": 256}, "budget": {"effects": False}}


def tables_of(rng: np.random.Generator, folder: Path) -> dict:
    """A scene of one to four ridges left and right of a roller, on a trace with lost heights."""
    x = np.arange(0.0, rng.uniform(0.6, 3.0), 2e-3)  # [mm]
    height = 0.02 * rng.standard_normal(len(x))  # [um]
    for _ in range(rng.integers(1, 5)):
        away = (x - rng.uniform(0.15, 0.85) * x[-1]) / rng.uniform(0.01, 0.1)
        height += rng.uniform(0.5, 15.0) * np.exp(-0.5 * away**2)
    lost = rng.integers(20, len(x) - 20, rng.integers(0, 3))
    height[lost[:, None] + np.arange(3)] = np.nan
    np.savetxt(folder / "trace.txt", np.column_stack([x, height]))
    rough = {
        "file": "trace.txt",
        "x_unit": "mm",
        "z_unit": "um",
        "form": "none",
        "dropouts": "bridge",
    }
    stress = {"points": [40, 16]}
    if rng.random() < 0.3:
        stress["half_range"] = rng.uniform(0.3, 2.0)
    return {
        "roller": {"radius": RADIUS, **STEEL},
        "body": STEEL | ({"hardness": 3e9} if rng.random() < 0.3 else {}),
        "profile": rough,
        "load": {
            "hertz_peak_pressure": 10.0 ** rng.uniform(7.5, 9.2),
            "friction": [[0.0], [0.3], [0.0, 0.1]][rng.integers(3)],
            "position": 1e-3 * x[-1] * rng.uniform(0.3, 0.7),
        },
        **COARSE,
    } | ({"stress": stress} if rng.random() < 0.7 else {})


def solved(seed: int, folder: Path, models: tuple[str, ...]) -> Run:
    """The run of the first random scene whose contact the trace does not end in."""
    rng = np.random.default_rng(seed)
    while True:
        try:
            return run(resolved(tables_of(rng, folder), folder=folder), None, models)
        except SceneError as refused:
            assert "reaches the end of the trace" in str(refused)


EVERY = [(seed, MODELS[:1]) for seed in (3, 4, 5, 7, 9, 11)] + [(1, MODELS), (10, MODELS)]


@pytest.mark.parametrize(("seed", "models"), EVERY)
def test_every_picture_is_drawn_and_shows_the_contact(tmp_path, drawn_by, seed, models):
    outcome = solved(seed, tmp_path, models)
    assert {"overview", "pressure", "close_up", "surface"} <= set(page.draw(outcome))
    hertz, level = outcome.problem.hertz, outcome.runs[models[-1]].finest
    ends = level.patches[[0, -1], [0, 1]]
    [overview], _ = drawn_by(overview_picture, outcome)
    for axes in overview.axes:
        low, high = axes.get_xlim()
        shown = low < ends[0] / hertz.half_width and ends[1] / hertz.half_width < high
        assert shown or hasattr(axes, "_colorbar")
    if outcome.window is not None:  # a largest stress stands below the contact, wherever that is
        held = outcome.window.holds(ends)
        assert held.any() if outcome.problem.scene.stress.half_range else held.all()
        largest, pressure = level.stress.extremes["tau1"].value, level.solution.pressure
        assert largest > 0.2 * pressure[outcome.window.holds(level.grid.x)].max()
