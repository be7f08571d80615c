"""Which hardness stands for a yield stress, and what a cap on the pressure leaves out.

    python -m comparisons.benchmarks.hardness_cap

A rigid roller is pressed on an elastic half-plane whose pressure is capped, and on a body of finite
elements that flows (von Mises, no hardening) at the yield stress Y: on the same hats, gap and
loads. A load is named by the peak pressure that a smooth elastic body would have under it; only
that by Y counts, since the two models are linear in shape and in modulus.

Measured (90 s on one processor), lengths and pressures of the flow, and for each cap the length by
the flow's and how far its pressure is from the flow's (L2):

    smooth, elastic peak / Y    2     2.5     3      4      6      8     12     16
    flow: mean / Y             1.50   1.82   2.02   2.13   2.57   2.65   2.76   2.91
    elastic: length            0.90   0.93   0.83   0.66   0.45   0.37   0.27   0.22
    cap 2.4 Y: length          0.90   0.93   0.89   0.90   1.18   1.11   1.20    -
               pressure         3 %   20 %   28 %   21 %   22 %   31 %   42 %    -
    cap 2.8 Y: length          0.90   0.93   0.89   0.76   1.00   1.00   1.00   1.06
               pressure         3 %   20 %   38 %   43 %   30 %   19 %   17 %   22 %
    cap 3 Y:   length          0.90   0.93   0.83   0.73   1.00   0.89   0.95   1.00
               pressure         3 %   21 %   39 %   49 %   45 %   36 %   14 %    6 %

The mean pressure tends towards the limit of a flat punch, (2 + pi) Y / sqrt 3 = 2.97 Y, but slowly:
there is no one hardness. Soon after first flow (at 1.79 Y) the pressure falls below the elastic
one everywhere, at the axis 15 % at 2.5 Y, where no cap acts yet. At 3 to 4 Y a cap of 2.4 Y errs
least; 2.8 Y is right where the elastic peak is 6 to 12 times the yield stress, 3 Y beyond.

On waves whose crests would bear 5 Y elastically a cap of 2.6 Y errs least, 10 %, at 6.2 Y one of
2.8 Y, 10 %; contact lengths are then right to 3 %. Capped pressures have no peak but plateaus, so
its place means nothing; the flow's are nearly level, too, with single hats up to 3.3 Y at edges.
"""

import argparse
import sys
from collections.abc import Callable
from dataclasses import dataclass, replace
from time import process_time

import numpy as np
from rich.console import Console
from rich.table import Table

from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import ContactError, solve_contact
from analytic.exact.hertz import hertz_from_peak_pressure
from analytic.grid import HatGrid, roller_gap
from analytic.material import Material
from analytic.operators.half_plane import HalfPlane
from fem.body.elasticity import Support, elastic_body
from fem.compliance.operator import FiniteElementCompliance
from fem.nonlinear.plasticity import ElasticPlastic
from fem.nonlinear.press_plastic import press_plastically
from meshes.block import BlockSpec
from meshes.build import build_block

STEEL = Material(200.0, 0.3)  # by the yield stress, which is 1
CAPS = (2.4, 2.6, 2.8, 3.0)  # hardness by yield stress
BLOCK = 60.0  # half-width and depth of the body, in reaches of the hats
INCREMENTS = 6  # from one load to the next


@dataclass(frozen=True)
class Case:
    """A rigid roller on a surface, pressed to rising loads.

    peaks     elastic peak pressures of a smooth body by yield stress, ascending; at the last of
              them its half-width is 1
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
class Figures:
    """Of one pressure: contact length, mean and peak pressure by yield stress, the peak's place."""

    length: float
    mean: float
    peak: float
    place: float


@dataclass(frozen=True)
class Compared:
    """One load: figures without flow, with it, and under each cap, where it can bear the load.

    apart   relative L2 norm of the capped pressure less the plastic one, by cap
    """

    peak: float
    elastic: Figures
    plastic: Figures
    capped: dict[float, Figures]
    apart: dict[float, float]


def waves(wavelength: float, amplitude: float, crest: float) -> Callable[[np.ndarray], np.ndarray]:
    """Heights of a sinusoid with a crest at x = `crest`."""
    return lambda x: amplitude * np.cos(2.0 * np.pi * (x - crest) / wavelength)


CASES = (
    Case("smooth, from first flow on", (1.5, 2.0, 2.5, 3.0, 4.0), None, 1.8, 0.05, 2.0, 0.1),
    Case("smooth, far beyond", (6.0, 8.0, 12.0, 16.0), None, 5.0, 0.125, 7.0, 0.5),
    Case("waves", (1.0, 1.5), waves(0.4, 0.004, 0.1), 1.8, 0.0125, 0.5, 0.05),
)


def figures(x: np.ndarray, pressure: np.ndarray, weights: np.ndarray) -> Figures:
    """Figures of hat pressures (n,); a hat that touches counts with its weight."""
    length = float(weights[pressure > 0.0].sum())
    at = int(np.argmax(pressure))
    return Figures(length, float(weights @ pressure) / length, float(pressure[at]), float(x[at]))


def compare(case: Case) -> list[Compared]:
    """Both models under each load of a case."""
    grid = HatGrid.within(-case.reach - case.pitch, case.reach + case.pitch, case.pitch)
    modulus, last = STEEL.plane_strain_modulus, case.peaks[-1]
    radius = 0.5 * modulus / last
    loads = [hertz_from_peak_pressure(p, radius, modulus).load_per_length for p in case.peaks]
    gap = grid.hat_integrals(roller_gap(radius, case.heights))
    half_plane = HalfPlane(grid.count, grid.pitch, modulus)

    def pressure(load: float, hardness: float = np.inf) -> np.ndarray | None:
        try:
            limits = Constraints(load=load, hardness=hardness)
            return solve_contact(half_plane, gap, grid.weights, limits).pressure
        except ContactError:
            return None

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
    for peak, load, contact in zip(case.peaks, loads, history, strict=True):
        capped = {cap: found for cap in CAPS if (found := pressure(load, cap)) is not None}
        size = np.linalg.norm(contact.pressure)
        rows.append(
            Compared(
                peak,
                figures(grid.x, pressure(load), grid.weights),
                figures(grid.x, contact.pressure, grid.weights),
                {cap: figures(grid.x, p, grid.weights) for cap, p in capped.items()},
                {
                    cap: float(np.linalg.norm(p - contact.pressure) / size)
                    for cap, p in capped.items()
                },
            )
        )
    return rows


def table(case: Case, rows: list[Compared]) -> Table:
    """Lengths in half-widths of the elastic contact of a smooth body under the last load."""
    shown = Table(title=case.title)
    for heading in ("smooth elastic peak", "model", "length", "mean / Y", "peak / Y", "at x"):
        shown.add_column(heading, justify="right")
    shown.add_column("from flow, L2", justify="right")
    for row in rows:
        models = {"elastic": row.elastic, "flow": row.plastic}
        models |= {f"cap {cap:g} Y": found for cap, found in row.capped.items()}
        apart = {f"cap {cap:g} Y": f"{100.0 * d:.1f} %" for cap, d in row.apart.items()}
        for number, (name, found) in enumerate(models.items()):
            shown.add_row(
                f"{row.peak:g} Y" if number == 0 else "",
                name,
                f"{found.length:.3f}",
                f"{found.mean:.2f}",
                f"{found.peak:.2f}",
                f"{found.place:.2f}",
                apart.get(name, ""),
                end_section=number == len(models) - 1,
            )
    return shown


def main(arguments: list[str] | None = None) -> int:
    """Print a table for each case; the exit status."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--coarser", type=int, default=1, help="pitch and elements so much larger")
    options = parser.parse_args(arguments)
    for case in CASES:
        pitch, size = case.pitch * options.coarser, case.size * options.coarser
        start = process_time()
        Console(width=100).print(table(case, compare(replace(case, pitch=pitch, size=size))))
        print(f"{process_time() - start:.0f} s\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
