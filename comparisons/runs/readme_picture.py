"""A run in one picture, everything over the same x: the picture of the README.

From the top: both models' pressures with Hertz's, their difference, the surfaces under load, and
the principal shear stress below them by the finite elements, for the last friction coefficient.
The README's picture is made anew by

    .venv/bin/python -c "from comparisons.runs.readme_picture import remake; remake()"
"""

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.numbers import Scale, percent, plain, significant, with_unit
from comparisons.common.quantities import LABELS
from comparisons.report.figures.fields import colour_bar, cross, fill, round_bands
from comparisons.report.figures.style import DIFFERENCE, LINES, REFERENCE, drawing, figure
from comparisons.report.figures.surfaces import draw_surfaces
from comparisons.report.tables.problem import load_text
from comparisons.results.outcome import Outcome

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PICTURE = Path(__file__).parents[1] / "docs/ground-unrun.png"
PIXELS = 192  # to the inch: twice what 800 pixels across need
WIDTH, LEFT, RIGHT = 8.35, 0.72, 0.12  # inches
# Inches from panel to panel, and of the panel: pressures, differences, surfaces, shear, its bar.
PANELS = ((0.08, 2.1), (0.14, 0.55), (0.14, 1.0), (0.32, 2.0), (0.44, 0.1))
FOOT = 0.26  # inches
REACH = 1.15  # half-widths to either side


def overview(outcome: Outcome) -> "Figure":
    """The picture of a run of both models with [stress]; to be called inside `drawing()`."""
    half_width, window = outcome.problem.hertz.half_width, outcome.window
    wide, height = WIDTH - LEFT - RIGHT, FOOT + sum(map(sum, PANELS))
    drawn, edge, panels = figure(WIDTH, height), height, []
    for above, tall in PANELS:
        edge -= above + tall
        box = (LEFT / WIDTH, edge / height, wide / WIDTH, tall / height)
        panels.append(drawn.add_axes(box))
    pressures, differences, surfaces, shear, bar = panels
    _pressures(pressures, outcome)
    _differences(differences, outcome)
    across = (-REACH * half_width, REACH * half_width)
    draw_surfaces(surfaces, outcome, across, Scale(half_width, "a"))
    _shear(shear, bar, outcome)
    for panel in panels[:-1]:
        panel.set_xlim(-REACH, REACH)
        panel.yaxis.set_label_coords(-0.8 * LEFT / wide, 0.5)
        panel.tick_params(labelbottom=panel is shear)
    shear.set_xlabel("x/a")
    shear.set_ylim(window.z[-1] / half_width, 0.0)
    return drawn


def save(outcome: Outcome, path: Path) -> None:
    """Write the picture of a finished run as PNG."""
    with drawing():
        overview(outcome).savefig(path, dpi=PIXELS, pil_kwargs={"optimize": True})


def remake(scene: str = "ground-unrun", path: Path = PICTURE) -> None:
    """Run a scene and write its picture."""
    from comparisons.common.quantities import MODELS
    from comparisons.runs.run import run
    from comparisons.scenes.resolve import load_scene

    with TemporaryDirectory() as folder:
        save(run(load_scene(scene), Path(folder) / "out", MODELS), path)


def _curve(outcome: Outcome, model: str) -> tuple[np.ndarray, np.ndarray]:
    """x/a and p/p0 of a model's nodes."""
    level, hertz = outcome.runs[model].finest, outcome.problem.hertz
    return level.grid.x / hertz.half_width, level.solution.pressure / hertz.peak_pressure


def _pressures(axes: "Axes", outcome: Outcome) -> None:
    hertz = outcome.problem.hertz
    for model in outcome.runs:
        axes.plot(*_curve(outcome, model), label=LABELS[model], **LINES[model])
    x = np.linspace(-1.0, 1.0, 401)
    smooth = hertz.pressure(x * hertz.half_width) / hertz.peak_pressure
    axes.plot(x, smooth, label="Hertz, smooth", **REFERENCE)
    axes.set_ylim(0.0, 1.2 * axes.dataLim.y1)
    axes.set_ylabel("p/p₀")
    load = (
        f"P = {load_text(outcome.problem)},  p₀ = {with_unit(hertz.peak_pressure, 'Pa')},  "
        f"a = {with_unit(hertz.half_width, 'm')}"
    )
    axes.text(0.008, 0.97, load, transform=axes.transAxes, va="top")
    axes.legend(loc="upper right", ncols=3, borderaxespad=0.1, columnspacing=1.0, handletextpad=0.5)


def _differences(axes: "Axes", outcome: Outcome) -> None:
    """Half-plane less finite elements: both have the same nodes."""
    x, one = _curve(outcome, "half_plane")
    other = _curve(outcome, "finite_element")[1]
    axes.plot(x, one - other, **DIFFERENCE)
    largest = 1.25 * np.max(np.abs(one - other))
    axes.set_ylim(-largest, largest)
    axes.set_ylabel("Δp/p₀")
    axes.locator_params(axis="y", nbins=3)
    norm = next(row for row in outcome.comparisons if row.quantity == "pressure_l2")
    axes.text(
        0.008,
        0.93,
        f"half-plane − finite elements: {percent(norm.difference)} (relative L2 norm)",
        transform=axes.transAxes,
        va="top",
    )


def _shear(axes: "Axes", bar: "Axes", outcome: Outcome) -> None:
    hertz, window = outcome.problem.hertz, outcome.window
    friction = outcome.problem.scene.friction[-1]
    found = {model: run.finest.stress(friction) for model, run in outcome.runs.items()}
    field = found["finite_element"].field.tau1 / hertz.peak_pressure
    bands = round_bands([field], signed=False)
    x, z = window.x / hertz.half_width, window.z / hertz.half_width
    shown = fill(axes, x, z, field, bands, "viridis", False)
    place = found["finite_element"].extremes["tau1"]
    cross(axes, place.x / hertz.half_width, place.z / hertz.half_width)
    largest = {
        model: significant(stress.extremes["tau1"].value / hertz.peak_pressure, 3)
        for model, stress in found.items()
    }
    axes.set_title(
        f"principal shear τ₁ by finite elements, friction {plain(friction)}: largest "
        f"{largest['finite_element']} p₀ at + (half-plane {largest['half_plane']} p₀)"
    )
    colour_bar(axes.figure, bar, shown, "τ₁/p₀", bands)
