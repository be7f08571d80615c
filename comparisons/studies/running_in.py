"""What running-in did to the surface before it was pressed.

In: a scene that was run in. Out: figures of it, and the volume that each pass moved."""

from collections.abc import Mapping
from dataclasses import asdict

from analytic.surface.roughness import roughness
from comparisons.figures.figure import Column, Findings, Series, Statement, figures_of
from comparisons.figures.quantity import Quantity
from comparisons.models.running_in import ended
from comparisons.studies.problem import QUANTITIES as OF_SURFACES
from comparisons.studies.study import Solved, Study

NAME = "running_in"
BEFORE, AFTER = "before", "after"  # sources of the surface's figures
QUANTITIES = OF_SURFACES | {
    "hardness": Quantity("hardness at which asperities flow", "Pa"),
    "load_per_length": Quantity("load of running-in", "N/m"),
    "pitch": Quantity("pitch of its pressures", "m"),
    "passes": Quantity("passes"),
    "sweeps": Quantity("sweeps"),
    "volume_moved": Quantity("volume that flowed", "m^2"),
    "largest_lowering": Quantity("largest lowering", "m"),
}


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


STUDY = Study(
    NAME, QUANTITIES, solve, applies=lambda solved: solved.problem.surface.run_in is not None
)
