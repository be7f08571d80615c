"""How the finite elements' error of Hertz's contact falls with unknowns and with time.

    python -m comparisons.benchmarks.hertz_convergence

A rigid cylinder on a body of plane-strain modulus 1, half-width and peak pressure 1. Equal edges,
each under one hat, with displacements of degree 1, 2 and 3, and meshes that the contact chooses
itself (`comparisons.models.finite_element.adaptive`). Elements grow away from equal edges by less
the finer they are; on meshes with the fewest unknowns, the reference for the adapted ones, as
steeply as on those.

One thread; processor times hold gmsh's process, meshing, assembly, factorisation and contact, not
the stresses, and not the loading of libraries. Exit status 0 only if the demands hold.
"""

import argparse
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from scipy.interpolate import interp1d

from analytic.contact.defect_correction import solve_with_model
from analytic.contact.equilibrium import Constraints
from analytic.contact.smooth_pressure import Patch, smooth_pressure
from analytic.exact.hertz import hertz_from_peak_pressure
from analytic.grid import HatGrid
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane
from comparisons.benchmarks import harness
from comparisons.models.finite_element.adaptive import (
    GROWTH,
    Pressing,
    adapted_contact,
    half_plane_block,
)
from fem.body.elasticity import elastic_body
from fem.compliance.far_field import FarField
from fem.compliance.operator import FiniteElementCompliance
from fem.stress.maximum import maximum
from fem.stress.stress import nodal_stress
from meshes.block import BlockSpec
from meshes.build import build_block

HERTZ = hertz_from_peak_pressure(1.0, 0.5, 1.0)
BODY = Material(0.91, 0.3)
EDGES = (5, 10, 20, 40, 80, 160)  # on half of the contact
TOLERANCES = (1e-2, 3e-3, 1e-3, 3e-4, 1e-4)
BEYOND = 6  # equal edges beyond the end of contact, on each side
BETWEEN = 0.25  # of a pitch: the contact ends between two nodes, as it does in general
# Growth of the elements at 20 edges a half-width; with finer edges it falls like their root.
GROWTH_AT_20, STEEPEST = 0.2, 0.5
LEAST_RATIO = 3.5  # unknowns of equal edges over those of adapted ones at the same pressure
FEWEST, ADAPTED = "degree 2, steep growth", "degree 2, adapted"
# Orders, each with its allowed deviation: a method, its size, its error.
ORDERS = (
    ("degree 2", "size", "node", -2.0, 0.4),
    ("degree 2", "size", "hats", -1.0, 0.15),
    (ADAPTED, "count", "hats", -2.0, 0.4),
)
ERRORS = ("node", "peak", "half_width", "hats", "tau1")


@dataclass(frozen=True)
class HertzRun:
    """One solution. Errors are relative.

    size        edges on half of the contact, or the tolerance
    count       of hats
    seconds     of the processor, gmsh's process included
    node, peak  of the highest nodal pressure, and of the smooth curve's peak
    hats        L2 norm of the piecewise-linear pressure
    tau1        of the largest principal shear
    """

    size: float
    unknowns: int
    count: int
    seconds: float
    node: float
    peak: float
    half_width: float
    hats: float
    tau1: float


Series = tuple[HertzRun, ...]  # of one method, coarse to fine


def equal_edges(per_half: int, degree: int = 2, growth: float | None = None) -> HertzRun:
    """Equal edges all over the contact, each under one hat; `growth` that does not fall."""
    start = harness.processor_seconds()
    edge = 1.0 / (per_half + BETWEEN)
    edges = per_half + BEYOND
    grid = HatGrid.within(-edges * edge, edges * edge, edge)
    half_width, depth, support = half_plane_block(1.5)
    growth = growth or min(STEEPEST, GROWTH_AT_20 * np.sqrt(20.0 / per_half))
    refined = edge * np.array([[-edges, edges]])
    mesh = build_block(BlockSpec(half_width, depth, refined, edge, growth))
    body = elastic_body(mesh, BODY, support, degree=degree)
    hats = grid.pitch * np.arange(grid.first - 1, grid.last + 2)
    compliance = FiniteElementCompliance(body, hats, far=FarField(body, hats[0], hats[-1]))
    solution = solve_with_model(
        compliance,
        HalfPlane(grid.count, grid.pitch, HERTZ.combined_modulus),
        grid.hat_integrals(_gap),
        grid.weights,
        Constraints(load=HERTZ.load_per_length),
    )
    (patch,) = smooth_pressure(hats, solution.pressure, solution.gap)
    return _assessed(per_half, compliance, solution.pressure, patch, start)


def adapted(tolerance: float, degree: int = 2) -> HertzRun:
    """Meshes and hats that the contact chooses, until its error estimate meets the tolerance."""
    start = harness.processor_seconds()
    pressing = Pressing(_gap, HERTZ.load_per_length, BODY, (-1.5, 1.5), degree=degree)
    contact = adapted_contact(pressing, tolerance)
    (patch,) = contact.patches
    return _assessed(tolerance, contact.compliance, contact.solution.pressure, patch, start)


def _gap(x: np.ndarray) -> np.ndarray:
    return x**2 / (2.0 * HERTZ.radius)


def _assessed(
    size: float,
    compliance: FiniteElementCompliance,
    pressure: np.ndarray,
    patch: Patch,
    start: float,
) -> HertzRun:
    seconds = harness.processor_seconds() - start
    hats, body = compliance.hats, compliance.body
    nodal = nodal_stress(body, compliance.displacement(pressure), hats, pressure)
    shear = maximum(body, nodal, lambda stress: stress.tau1).value
    return HertzRun(
        size=size,
        unknowns=body.unknowns,
        count=len(pressure),
        seconds=seconds,
        node=abs(pressure.max() - 1.0),
        peak=abs(patch.peak[0] - 1.0),
        half_width=abs(0.5 * (patch.ends[1] - patch.ends[0]) - 1.0),
        hats=distance(lambda x: np.interp(x, hats, np.pad(pressure, 1))),
        tau1=abs(shear / HERTZ.tau1_max - 1.0),
    )


def distance(found: Callable[[np.ndarray], np.ndarray]) -> float:
    """L2 norm of a pressure's difference from Hertz's over that of Hertz's."""
    angle = np.linspace(0.0, np.pi, 100_001)
    x, share = -1.2 * np.cos(angle), np.sin(angle)
    exact = HERTZ.pressure(x)
    return float(np.sqrt(share @ (found(x) - exact) ** 2 / (share @ exact**2)))


def all_series(finest: int, tolerances: list[float]) -> dict[str, Series]:
    """Runs of all methods by their names; equal edges up to `finest` on half of the contact."""
    counts = [count for count in EDGES if count <= finest]
    methods = {f"degree {degree}": partial(equal_edges, degree=degree) for degree in (1, 2, 3)}
    methods[FEWEST] = partial(equal_edges, growth=GROWTH)
    for degree in (1, 2, 3):
        equal_edges(counts[0], degree)  # loads libraries
    found = {name: tuple(map(run, counts)) for name, run in methods.items()}
    for degree in (2, 3):
        runs = (adapted(tolerance, degree) for tolerance in sorted(tolerances, reverse=True))
        found[f"degree {degree}, adapted"] = tuple(runs)
    return found


def order(series: Series, size: str, error: str) -> float:
    """Slope of log error over log size, least squares; both are names of fields of `HertzRun`."""
    values = np.log([[getattr(run, name) for run in series] for name in (size, error)])
    return float(np.polyfit(*values, 1)[0])


def unknowns_ratio(equal: Series, other: Series) -> list[tuple[float, float]]:
    """For each run of `other` its L2 error, and how many times its unknowns `equal` needs for it.

    Linear between the logarithms of the runs of `equal`, extrapolated beyond them.
    """
    known = np.log([(run.hats, run.unknowns) for run in equal]).T
    needed = interp1d(*known, fill_value="extrapolate")
    return [(run.hats, float(np.exp(needed(np.log(run.hats))) / run.unknowns)) for run in other]


def demands(found: dict[str, Series]) -> list[harness.Demand]:
    verdicts = []
    for name, size, error, wanted, slack in ORDERS:
        slope = order(found[name], size, error)
        text = f"{name}: order of {error} in {size} {slope:.2f}, wanted {wanted:g} within {slack:g}"
        verdicts.append(harness.Demand(abs(slope - wanted) <= slack, text))
    ratios = unknowns_ratio(found[FEWEST], found[ADAPTED])
    least = min(ratio for _, ratio in ratios)
    each = ", ".join(f"{ratio:.1f} at {error:.1e}" for error, ratio in ratios)
    text = f"equal edges need {each} times the unknowns, at least {LEAST_RATIO:g}"
    return [*verdicts, harness.Demand(least >= LEAST_RATIO, text)]


def main(arguments: list[str] | None = None) -> int:
    """Print all runs, orders in the unknowns, and the demands; the exit status."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--finest", type=int, default=80, help="equal edges on half of the contact")
    parser.add_argument("--tolerances", type=float, nargs="+", default=TOLERANCES)
    options = parser.parse_args(arguments)
    found = all_series(options.finest, options.tolerances)
    rows = []
    for name, series in found.items():
        for run in series:
            sizes = f"{run.size:g}", str(run.unknowns), str(run.count), f"{run.seconds:.2f}"
            rows.append((name, *sizes, *(f"{getattr(run, error):.1e}" for error in ERRORS)))
        slopes = (f"{order(series, 'unknowns', error):.2f}" for error in ERRORS)
        rows.append(("  order in unknowns", "", "", "", "", *slopes))
    harness.print_table(
        "Relative errors", ("method", "size", "unknowns", "hats", "s", *ERRORS), rows
    )
    return harness.print_demands(demands(found))


if __name__ == "__main__":
    harness.run_on_one_thread(main)
