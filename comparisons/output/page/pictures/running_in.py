"""The surface before and after running-in, where the models press it."""

from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.numbers import given, scale_of, significant, with_unit
from comparisons.drawing import style
from comparisons.models.running_in import ended
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import SceneSurface
from comparisons.studies.study import Run

if TYPE_CHECKING:
    from matplotlib.figure import Figure

POINTS = 4000  # along x; the picture is not finer
BEFORE = {**style.LINES["finite_element"], "linewidth": 0.9}
AFTER = {**style.OUTLINE, "color": style.LINES["half_plane"]["color"]}


def running_in_picture(outcome: Run) -> style.Picture | None:
    """Both surfaces over the stretch that the contact may reach; None without running-in."""
    scene, surface = outcome.problem.scene, outcome.problem.surface
    if surface.run_in is None:
        return None
    said = running_in_in_words(scene, surface)
    drawn = _drawn(outcome, style.WIDE)
    return style.Picture(
        source=style.data_uri(drawn),
        data=style.csv_link(drawn),
        narrow=style.data_uri(_drawn(outcome, style.COLUMN)),
        wide=True,
        alternative=f"The surface before and after running-in. {said}",
        caption=f"The surface before and after running-in, heights stretched. {said}",
    )


def running_in_in_words(scene: Scene, surface: SceneSurface) -> str:
    """What running-in did, in one sentence, and in more where it fell short."""
    run_in, places = surface.run_in, len(scene.running_in.places(surface.position))
    sweeps = f"{run_in.sweeps} sweep{'s' * (run_in.sweeps > 1)}"
    took = f"{len(run_in.passes)} passes ({sweeps} over {places} place{'s' * (places > 1)})"
    unfinished = "" if run_in.status == "settled" else "; it has not settled"
    sentence = (
        f"In {took} at {given(scene.running_in.hardness, 'Pa')} plastic flow took "
        f"{area(run_in.volume)} off it, up to {with_unit(run_in.largest_lowering, 'm', 3)} deep"
        f"{unfinished}."
    )
    if ended(surface):
        ends = ", ".join(given(place, "m") for place in ended(surface))
        sentence += f" From {ends} the roller touched an end of the trace, where support ends."
    return sentence


def area(volume: float) -> str:
    """Volume per unit length [m^2] as square micrometres."""
    return f"{significant(volume / 1e-12, 3)} µm²"


def _drawn(outcome: Run, width: float) -> "Figure":
    problem, run_in = outcome.problem, outcome.problem.surface.run_in
    x = np.linspace(*problem.extent, POINTS)
    before, after = run_in.before.spline()(x), run_in.profile.spline()(x)
    along, up = scale_of(x, "m"), scale_of([np.ptp(before)], "m")
    drawn = style.figure(width, 3.2)
    [axes] = style.stacked(drawn, [(0.35, 2.34)], 0.8, 0.02 * width)
    axes.plot(x / along.factor, before / up.factor, label="before running-in", **BEFORE)
    axes.plot(x / along.factor, after / up.factor, label="after", **AFTER)
    ends = x[[0, -1]] / along.factor
    axes.set(xlim=ends, xlabel=f"x [{along.name}]", ylabel=f"height [{up.name}]")
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncol=2)
    return drawn
