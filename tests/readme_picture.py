"""A run in one picture, everything over the same x: the picture of the README.

From the top: all models' pressures with Hertz's, the half-plane's less the whole model's, the
surfaces under load, and the principal shear stress below them by the whole model, all at the
friction coefficient that decides. This command makes it again:

    .venv/bin/python -m tests.readme_picture
"""

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from comparisons.common.numbers import Scale, percent, plain, significant
from comparisons.drawing.field import colour_bar, cross, fill, round_bands
from comparisons.drawing.style import drawing, figure, stacked
from comparisons.figures.quantity import LABELS, MODELS
from comparisons.output.page.pictures.contact import draw_difference, draw_surfaces
from comparisons.studies.contact import draw_pressures
from comparisons.studies.model_error.show import moved_text
from comparisons.studies.study import Run

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PICTURE = Path(__file__).parents[1] / "comparisons/docs/ground-unrun.png"
PIXELS = 192  # to the inch: twice what 800 pixels across need
WIDTH, LEFT, RIGHT = 8.35, 0.72, 0.12  # inches
# Inches from panel to panel, and of the panel: pressures, differences, surfaces, shear, its bar.
PANELS = ((0.08, 2.1), (0.32, 0.55), (0.14, 1.0), (0.32, 2.0), (0.44, 0.1))
FOOT = 0.26  # inches
REACH = 1.15  # half-widths to either side


def overview(outcome: Run) -> "Figure":
    """The picture of a run of both models with [stress]; to be called inside `drawing()`."""
    half_width, window = outcome.problem.hertz.half_width, outcome.window
    drawn = figure(WIDTH, FOOT + sum(map(sum, PANELS)))
    *panels, bar = stacked(drawn, PANELS, LEFT, RIGHT)
    pressures, differences, surfaces, shear = panels
    given = outcome, (-REACH * half_width, REACH * half_width), Scale(half_width, "a")
    draw_pressures(pressures, *given)
    pressures.set_ylim(0.0, 1.25 * pressures.dataLim.y1)
    look = {"borderaxespad": 0.1, "columnspacing": 1.0, "handletextpad": 0.5}
    pressures.legend(loc="upper right", ncols=2, **look)
    draw_difference(differences, *given)
    friction = outcome.deciding_friction
    norm = percent(outcome.data("model_error").of("pressure_l2", friction).value)
    models = " − ".join(LABELS[name] for name in outcome.pair(friction))
    moved = "".join(f", {text} on average" for text in moved_text(outcome, friction))
    words = f"{models}: {norm} (relative L2 norm){moved}"
    differences.set_title(words)
    draw_surfaces(surfaces, *given)
    _shear(shear, bar, outcome)
    for panel in panels:
        panel.set_xlim(-REACH, REACH)
        panel.yaxis.set_label_coords(-0.8 * LEFT / (WIDTH - LEFT - RIGHT), 0.5)
        panel.tick_params(labelbottom=panel is shear)
    shear.set_xlabel("x/a")
    shear.set_ylim(window.z[-1] / half_width, 0.0)
    return drawn


def remake(scene: str = "ground-unrun", path: Path = PICTURE) -> None:
    """Run a scene and write its picture."""
    from comparisons.runs.run import run
    from comparisons.scenes.scene import Scene

    with TemporaryDirectory() as folder:
        outcome = run(Scene.read(scene), Path(folder) / "out", MODELS)
    with drawing():
        overview(outcome).savefig(path, dpi=PIXELS, pil_kwargs={"optimize": True})


def _shear(axes: "Axes", bar: "Axes", outcome: Run) -> None:
    hertz, window = outcome.problem.hertz, outcome.window
    friction = outcome.deciding_friction
    levels = outcome.levels(friction)
    found = {model: level.stress(friction) for model, level in levels.items()}
    last = list(levels)[-1]
    field = found[last].field.tau1 / hertz.peak_pressure
    bands = round_bands([field], signed=False)
    x, z = window.x / hertz.half_width, window.z / hertz.half_width
    shown = fill(axes, x, z, field, bands, "viridis", False)
    place = found[last].extremes["tau1"]
    cross(axes, place.x / hertz.half_width, place.z / hertz.half_width)
    largest = {
        model: significant(stress.extremes["tau1"].value / hertz.peak_pressure, 3)
        for model, stress in found.items()
    }
    axes.set_title(
        f"principal shear τ₁, {LABELS[last]}, friction {plain(friction)}: largest "
        f"{largest[last]} p₀ at + (half-plane {largest['half_plane']} p₀)"
    )
    colour_bar(axes.figure, bar, shown, "τ₁/p₀", bands)


if __name__ == "__main__":
    remake()
