"""Which hardness represents a yield stress, and what a cap on the pressure does not model.

    python -m comparisons.benchmarks.hardness_cap

A rigid roller is pressed on an elastic half-plane whose pressure is capped at the hardness, and on
a finite-element body that flows plastically (von Mises, no hardening) at the yield stress Y: on the
same hats, gap and loads. A load is named by the elastic peak pressure of a smooth body under it;
only its ratio to Y matters, since both models are linear in shape and in modulus.

Measured (90 s on one processor): mean pressures with plastic flow, lengths relative to those with
plastic flow, and relative L2 distance of the capped pressure from the one with plastic flow:

    smooth, elastic peak / Y    2     2.5     3      4      6      8     12     16
    flow: mean / Y             1.50   1.82   2.02   2.13   2.57   2.65   2.76   2.91
    elastic: length            0.90   0.93   0.83   0.66   0.45   0.37   0.27   0.22
    cap 2.4 Y: length          0.90   0.93   0.89   0.90   1.18   1.11   1.20    -
               pressure         3 %   20 %   28 %   21 %   22 %   31 %   42 %    -
    cap 2.8 Y: length          0.90   0.93   0.89   0.76   1.00   1.00   1.00   1.06
               pressure         3 %   20 %   38 %   43 %   30 %   19 %   17 %   22 %
    cap 3 Y:   length          0.90   0.93   0.83   0.73   1.00   0.89   0.95   1.00
               pressure         3 %   21 %   39 %   49 %   45 %   36 %   14 %    6 %

The mean pressure approaches the limit of a flat punch, (2 + pi) Y / sqrt 3 = 2.97 Y, but slowly:
no single hardness fits. Soon after first yield (at 1.79 Y) the pressure falls below the elastic
one everywhere, at the axis 15 % at 2.5 Y, where no cap acts yet. At 3 to 4 Y the error of a cap of
2.4 Y is least; 2.8 Y fits where the elastic peak is 6 to 12 times the yield stress, 3 Y beyond.

On waves whose elastic pressure at the crests is 5 Y a cap of 2.6 Y has the least error, 10 %, at
6.2 Y one of 2.8 Y, 10 %; contact lengths are then right to 3 %. Capped pressures have plateaus and
no peak, so that its place means nothing; those with plastic flow are nearly level, too, with single
hats up to 3.3 Y at edges.
"""

import argparse
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import ContactError, solve_contact
from analytic.exact.hertz import hertz_from_peak_pressure
from analytic.grid import HatGrid, roller_gap
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane
from comparisons.benchmarks.harness import print_table, run_on_one_thread
from fem.body.elasticity import Support, elastic_body
from fem.compliance.operator import FiniteElementCompliance
from fem.nonlinear.plasticity import ElasticPlastic
from fem.nonlinear.press_plastic import press_plastically
from meshes.block import BlockSpec
from meshes.build import build_block

STEEL = Material(200.0, 0.3)  # in units of the yield stress, which is 1
CAPS = {f"cap {cap:g} Y": cap for cap in (2.4, 2.6, 2.8, 3.0)}  # hardness over yield stress
BLOCK = 60.0  # half-width and depth of the body, in reaches of the hats
INCREMENTS = 6  # from one load to the next
COLUMNS = ("elastic peak", "model", "length", "mean / Y", "peak / Y", "at x", "from flow, L2")


@dataclass(frozen=True)
class CappedCase:
    """A rigid roller on a surface, pressed to rising loads.

    peaks     elastic peak pressures of a smooth body over the yield stress, ascending; at the last
              of them its half-width is 1
    heights   of the surface at x, or None for a smooth one
    reach     to either side that hats cover
    pitch     of the hats
    fine      depth to which elements are no larger than `size`
    """

    title: str
    peaks: tuple[float, ...]
    heights: Callable[[np.ndarray], np.ndarray] | None
    reach: float
    pitch: float
    fine: float
    size: float


@dataclass(frozen=True)
class PressureFigures:
    """Of one pressure: contact length, mean and peak over the yield stress, the peak's place, and
    `apart`, the relative L2 distance from the pressure with plastic flow."""

    length: float
    mean: float
    peak: float
    place: float
    apart: float


def waves(x: np.ndarray) -> np.ndarray:
    """Heights of a sinusoid with a crest at x = 0.1."""
    return 0.004 * np.cos(2.0 * np.pi * (x - 0.1) / 0.4)


CASES = (
    CappedCase("smooth, from first yield on", (1.5, 2.0, 2.5, 3.0, 4.0), None, 1.8, 0.05, 2.0, 0.1),
    CappedCase("smooth, far beyond", (6.0, 8.0, 12.0, 16.0), None, 5.0, 0.125, 7.0, 0.5),
    CappedCase("waves", (1.0, 1.5), waves, 1.8, 0.0125, 0.5, 0.05),
)


def figures(
    x: np.ndarray, pressure: np.ndarray, weights: np.ndarray, flow: np.ndarray
) -> PressureFigures:
    """Of hat pressures (n,), beside those with plastic flow; a touching hat counts with its
    weight."""
    length = float(weights[pressure > 0.0].sum())
    at = int(np.argmax(pressure))
    mean, apart = weights @ pressure / length, np.linalg.norm(pressure - flow)
    found = mean, pressure[at], x[at], apart / np.linalg.norm(flow)
    return PressureFigures(length, *map(float, found))


def compare(case: CappedCase) -> list[dict[str, PressureFigures]]:
    """For each load the models "elastic", "flow", and CAPS where they can bear the load."""
    grid = HatGrid.within(-case.reach - case.pitch, case.reach + case.pitch, case.pitch)
    modulus, last = STEEL.plane_strain_modulus, case.peaks[-1]
    radius = 0.5 * modulus / last
    loads = [hertz_from_peak_pressure(p, radius, modulus).load_per_length for p in case.peaks]
    gap = grid.hat_integrals(roller_gap(radius, case.heights))
    half_plane = HalfPlane(grid.count, grid.pitch, modulus)

    def pressure(load: float, hardness: float = np.inf) -> np.ndarray:
        limits = Constraints(load=load, hardness=hardness)
        return solve_contact(half_plane, gap, grid.weights, limits).pressure

    hats = np.arange(grid.first - 1, grid.last + 2) * grid.pitch
    window = (hats[0], hats[-1], case.fine, case.size)
    block = BLOCK * case.reach
    mesh = build_block(BlockSpec(block, block, hats[[0, -1]][None], grid.pitch, 0.2, window))
    body = elastic_body(mesh, STEEL, Support("bonded", "fixed"))
    _, history = press_plastically(
        FiniteElementCompliance(body, hats),
        ElasticPlastic(STEEL, 1.0),
        gap,
        grid.weights,
        loads,
        pressure(loads[0]),
        increments=INCREMENTS,
    )
    rows = []
    for load, contact in zip(loads, history, strict=True):
        models = {"elastic": pressure(load), "flow": contact.pressure}
        for name, cap in CAPS.items():
            try:
                models[name] = pressure(load, cap)
            except ContactError:  # the cap cannot bear the load
                continue
        flow = contact.pressure
        rows.append({n: figures(grid.x, p, grid.weights, flow) for n, p in models.items()})
    return rows


def main(arguments: list[str] | None = None) -> int:
    """Print a table for each case; the exit status.

    Lengths in half-widths of the elastic contact of a smooth body under the last load.
    """
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--coarser", type=int, default=1, help="pitch and elements so much larger")
    options = parser.parse_args(arguments)
    for case in CASES:
        pitch, size = case.pitch * options.coarser, case.size * options.coarser
        pressed = compare(replace(case, pitch=pitch, size=size))
        rows = [
            (f"{peak:g} Y", name, *(f"{v:.2f}" for v in vars(found).values()))
            for peak, models in zip(case.peaks, pressed, strict=True)
            for name, found in models.items()
        ]
        print_table(case.title, COLUMNS, rows)
    return 0


if __name__ == "__main__":
    run_on_one_thread(main)
