"""A trace in one picture: what is pressed, its power spectrum and its bearing curve."""

from typing import TYPE_CHECKING

import numpy as np

from analytic.profile import Profile
from analytic.surface.roughness import bearing_curve, power_spectrum
from comparisons.common.numbers import scale_of
from comparisons.drawing.style import WIDE, drawing, figure, svg
from comparisons.scenes.surface import SceneSurface

if TYPE_CHECKING:
    from matplotlib.axes import Axes

HEIGHT = 5.2  # inches
DECADES = 12  # of the spectrum below its largest value; what is lower is rounding
POINTS = 4000  # of a drawn curve; more cannot be told apart


def picture(surface: SceneSurface) -> str:
    """The trace of a surface as SVG, its heights as pressed, its x as on the trace."""
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
    axes.set_title("the trace as pressed")
    axes.set_xlabel(f"x on the trace [{along.name}]")
    axes.set_ylabel(f"height [{across.name}]")


def _spectrum(axes: "Axes", profile: Profile) -> None:
    wavenumber, density = power_spectrum(profile)
    axes.set_title("power spectral density")
    axes.set_xlabel("wavelength [m]")
    axes.set_ylabel("density [m³]")
    if np.any(density > 0.0):
        kept = density > 10.0**-DECADES * density.max()
        axes.loglog(1.0 / wavenumber[kept], density[kept], linewidth=0.8)
        axes.invert_xaxis()


def _bearing(axes: "Axes", profile: Profile) -> None:
    share, height = bearing_curve(profile)
    across = scale_of(height, "m")
    axes.plot(100.0 * share, height / across.factor)
    axes.set_title("bearing curve")
    axes.set_xlabel("share of the length that is as high [%]")
    axes.set_ylabel(f"height [{across.name}]")
