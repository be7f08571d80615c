"""Output of `crosscheck init`: as JSON, as a table, and the trace in one picture."""

import json
from dataclasses import dataclass
from operator import itemgetter
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from analytic.profile import Profile
from analytic.surface.roughness import bearing_curve, power_spectrum
from comparisons.campaigns.init.guess import ProfileFields
from comparisons.common.numbers import scale_of, with_unit
from comparisons.drawing.style import WIDE, drawing, figure, svg
from comparisons.drawing.tables import figure_table
from comparisons.output.page.tables.problem import roughness_notes
from comparisons.output.plausibility import warnings_about_surface
from comparisons.output.terminal import PLAIN, Printed, plain_table, plain_text
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import ProfileInfo, SceneSurface
from comparisons.studies.problem import QUANTITIES, figures_of_surface

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from rich.console import RenderableType

TRACE = ("source", "format", "place", "samples", "length", "spacing", "bridged", "trimmed", "form")
FILTERED = ("cutoff", "short_cutoff", "standard", "standard_why")
UNEVEN = 0.01  # of the spacing: samples whose distances differ by more are not even
HEIGHT = 5.2  # inches
DECADES = 12  # of the spectrum below its largest value; what is lower is rounding
POINTS = 4000  # of a drawn curve; more cannot be told apart


@dataclass(frozen=True, repr=False)
class FirstScene(Printed):
    """A scene file that was written, what it says, how its profile is read, a picture, and the
    fields that are examples."""

    path: Path
    picture: Path | None
    scene: Scene
    surface: SceneSurface
    profile: ProfileFields
    examples: tuple[str, ...]

    def as_dict(self) -> dict:
        """Scene and surface for JSON, SI units."""
        trace = self.surface.info.as_dict()
        return {
            "scene": str(self.path),
            "picture": None if self.picture is None else str(self.picture),
            "profile": {name: trace[name] for name in TRACE},
            "fields": self.profile.fields,
            "guesses": self.profile.reasons,
            "examples": list(self.examples),
            "surface": {"pressed": trace["roughness"]} | {name: trace[name] for name in FILTERED},
            "roller_radius": self.scene.roller.radius,
        }

    @property
    def assumed(self) -> str:
        """The fields that are examples, with their values."""
        return ", ".join(
            f"{section}.{name} = {value}"
            for section in ("roller", "body", "load")
            for name, value in self.scene.written[section].items()
            if name in self.examples
        )

    def tables(self) -> "RenderableType":
        """How the profile was read, its roughness, what is doubtful, guessed or an example, what to
        do next, and the half-plane's result on the coarsest level."""
        from rich.console import Group
        from rich.text import Text

        info = self.surface.info
        shown = figure_table(figures_of_surface(info), QUANTITIES)
        table = plain_table("roughness", numbers=shown.head[1:], rows=shown.rows)
        guesses = (
            f"{name} = {json.dumps(self.profile.fields[name], ensure_ascii=False)}: {because}"
            for name, because in self.profile.reasons.items()
        )
        ends = ["", f"scene   {self.path}"]
        ends += [] if self.picture is None else [f"picture {self.picture}"]
        warnings = (f"plausibility warning: {text}" for text in warnings_about_surface(info))
        assumed = [f"assumed as examples, put in yours: {self.assumed}"] if self.assumed else []
        return Group(
            Text(_reading(info).translate(PLAIN), style="bold"),
            *([Text(info.place)] if info.place else []),
            "",
            table,
            "",
            *(plain_text(f"{name}: {text}") for name, text in roughness_notes(info)),
            "",
            *(Text(line.translate(PLAIN)) for line in warnings),
            *map(Text, (*guesses, *ends, f"next    crosscheck run {self.path}", *assumed)),
            *(Text(line.translate(PLAIN)) for line in first_lines(self.scene)),
        )


def _reading(info: ProfileInfo) -> str:
    """How a profile was read, in a line."""
    steps = np.diff(info.trace.x)
    least, most = float(steps.min()), float(steps.max())
    even = most - least <= UNEVEN * info.spacing
    apart = _length(info.spacing) if even else f"{_length(least)} to {_length(most)}"
    read = f"{info.source}: {info.format}, {info.samples} samples, "
    return f"{read}{_length(info.length)} long, {apart} apart"


def first_lines(scene: Scene) -> tuple[str, str]:
    """The half-plane's result on the coarsest level, and estimates of what it leaves out."""
    from comparisons.common.tasks import Here
    from comparisons.judging.model_error.study import early_lines
    from comparisons.models.model import scene_model
    from comparisons.models.posing import problem_of

    problem = problem_of(scene.unchecked({"stress": None}))
    levels = scene_model("half_plane", problem).solve(Here(), problem, 1)
    friction, level = max(levels.items(), key=itemgetter(0))
    return early_lines(problem.under(friction), level)


def _length(value: float) -> str:
    return with_unit(value, "m")


def picture(surface: SceneSurface) -> str:
    """The trace of a surface, its heights as pressed, its x as on the trace, with its power
    spectrum and bearing curve, as SVG."""
    profile = Profile(surface.profile.x + surface.position, surface.profile.height)
    with drawing():
        drawn = figure(WIDE, HEIGHT)
        grid = drawn.add_gridspec(
            2, 2, hspace=0.5, wspace=0.2, left=0.07, right=0.99, top=0.94, bottom=0.1
        )
        _trace(drawn.add_subplot(grid[0, :]), profile)
        _spectrum(drawn.add_subplot(grid[1, 0]), profile)
        _bearing(drawn.add_subplot(grid[1, 1]), profile)
        return svg(drawn)


def _trace(axes: "Axes", profile: Profile) -> None:
    x, height = profile.x, profile.height
    along, across = scale_of(x, "m"), scale_of(height, "m")
    # of each stretch its lowest and highest sample, so that no peak is lost
    starts = np.unique(np.linspace(0, len(x), min(len(x), POINTS // 2), endpoint=False, dtype=int))
    parts = np.split(np.arange(len(x)), starts[1:])
    ends = [part[[np.argmin(height[part]), np.argmax(height[part])]] for part in parts]
    kept = np.unique(np.concatenate([*ends, [0, len(x) - 1]]))
    axes.plot(x[kept] / along.factor, height[kept] / across.factor, linewidth=0.8)
    labels = {"xlabel": f"x on the trace [{along.name}]", "ylabel": f"height [{across.name}]"}
    axes.set(title="the trace as pressed", **labels)


def _spectrum(axes: "Axes", profile: Profile) -> None:
    wavenumber, density = power_spectrum(profile)
    axes.set(title="power spectral density", xlabel="wavelength [m]", ylabel="density [m³]")
    if np.any(density > 0.0):
        kept = density > 10.0**-DECADES * density.max()
        axes.loglog(1.0 / wavenumber[kept], density[kept], linewidth=0.8)
        axes.invert_xaxis()


def _bearing(axes: "Axes", profile: Profile) -> None:
    share, height = bearing_curve(profile)
    across = scale_of(height, "m")
    axes.plot(100.0 * share, height / across.factor)
    axes.set(title="bearing curve", ylabel=f"height [{across.name}]")
    axes.set_xlabel("share of the length that is as high [%]")
