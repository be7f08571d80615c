"""Running-in of the surface before it was pressed.

In: a scene that was run in. Out: figures of it, and the volume that each pass moved."""

from collections.abc import Mapping
from dataclasses import asdict

import numpy as np

from analytic.surface.roughness import roughness
from comparisons.common.numbers import scale_of
from comparisons.drawing import style
from comparisons.drawing.curves import over, panels
from comparisons.figures.figure import Column, Findings, Series, Statement, figures_of
from comparisons.figures.quantity import Quantity
from comparisons.judging.study import Run, Solved, Study
from comparisons.models.running_in import ended
from comparisons.studies.problem import QUANTITIES as OF_SURFACES

NAME = "running_in"
POINTS = 4000  # along x; the picture is not finer
LINE_BEFORE = {**style.LINES["finite_element"], "linewidth": 0.9}
LINE_AFTER = {**style.OUTLINE, "color": style.LINES["half_plane"]["color"]}
ABOVE = 1.05  # times the hardness of running-in: a peak that it should have flattened
BEFORE, AFTER = "before", "after"  # sources of the surface's figures
OF_FLOW = {
    "volume_moved": Quantity("volume that flowed", "m^2"),
    "largest_lowering": Quantity("largest lowering", "m"),
    "passes": Quantity("passes"),
    "sweeps": Quantity("sweeps"),
    "hardness": Quantity("hardness at which asperities flow", "Pa"),
    "load_per_length": Quantity("load of running-in", "N/m"),
    "pitch": Quantity("pitch of its pressures", "m"),
}
QUANTITIES = OF_FLOW | OF_SURFACES


def solve(solved: Solved, before: Mapping[str, Findings], tasks: object) -> Findings:
    surface = solved.problem.surface
    run_in = surface.run_in
    values = {
        "hardness": run_in.constraints.hardness,
        "load_per_length": run_in.constraints.load,
        "pitch": run_in.pitch,
        "passes": len(run_in.passes),
        "sweeps": run_in.sweeps,
        "volume_moved": run_in.volume,
        "largest_lowering": run_in.largest_lowering,
    }
    figures = figures_of(NAME, "half_plane", values)
    figures += figures_of(NAME, BEFORE, asdict(roughness(run_in.before)))
    figures += figures_of(NAME, AFTER, asdict(surface.info.roughness))
    passes = {"volume": Column(tuple(one.volume for one in run_in.passes), "m^2")}
    series = [Series("passes", passes)]
    if places := tuple(ended(surface)):
        series.append(Series("at ends of the trace", {"position": Column(places, "m")}))
    said = (
        Statement("status", run_in.status),
        Statement("converged", "yes" if run_in.converged else "no"),
    )
    return Findings(tuple(figures), tuple(series), said)


def picture(run: Run) -> style.Picture:
    """The surface before and after over the stretch that the contact may reach."""
    problem, run_in = run.problem, run.problem.surface.run_in
    words = "The surface before and after running-in{}."
    x = np.linspace(*problem.extent, POINTS)
    before, profile = run_in.before.spline()(x), run_in.profile.spline()(x)
    along, up = scale_of(x, "m"), scale_of([np.ptp(before)], "m")
    drawn, [axes] = panels(style.WIDE, [(0.35, 2.34)], right=0.02 * style.WIDE, foot=0.51)
    axes.plot(x / along.factor, before / up.factor, label="before running-in", **LINE_BEFORE)
    axes.plot(x / along.factor, profile / up.factor, label="after", **LINE_AFTER)
    axes.set_ylabel(f"height [{up.name}]")
    over([axes], f"x [{along.name}]", x / along.factor)
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncol=2)
    return style.picture(drawn, words.format(""), words.format(", heights stretched"))


def files(run: Run) -> dict[str, dict[str, np.ndarray]]:
    """run_in_profile.csv: the trace along its own x, its height before and after."""
    surface = run.problem.surface
    after = surface.run_in.profile.height
    columns = {
        "x [m]": surface.run_in.profile.x + surface.position,
        "height before running-in [m]": after + surface.run_in.lowering,
        "height [m]": after,
    }
    return {"run_in_profile.csv": columns}


def advice(run: Run) -> str:
    """Whether the surface settled, and whether that held."""
    run_in = run.problem.surface.run_in
    text = ", settled" if run_in.status == "settled" else ", not settled"
    text += "" if run_in.converged else ", not converged"
    # features finer than running-in resolved may be pressed harder than it allowed
    hardness = run_in.constraints.hardness
    peak = max(np.max(model.finest.solution.pressure) for model in run.runs.values())
    if peak > ABOVE * hardness:
        text += f"; pressed afterwards by up to {peak / hardness:.2f} times its hardness"
    return text


STUDY = Study(
    name=NAME,
    quantities=QUANTITIES,
    solve=solve,
    applies=lambda solved: solved.problem.surface.run_in is not None,
    title="Running-in",
    shown=(*OF_FLOW, "status"),
    advice=advice,
    pictures={"running_in": picture},
    files=files,
)
