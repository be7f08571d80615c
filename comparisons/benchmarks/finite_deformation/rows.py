"""What the chain of models shows on each case, as a table, and from where on it matters."""

from dataclasses import dataclass, fields
from itertools import pairwise

import numpy as np
from rich.table import Table

from comparisons.benchmarks.finite_deformation.cases import Case
from comparisons.benchmarks.finite_deformation.models import chain


@dataclass(frozen=True)
class Row:
    """What a case shows, all relative to the half-plane's assumptions: by its steps in the peak
    pressure, circle, geometry, place and strain; and in all, peak, length, shear; the pressure's
    peak over Young's modulus, Newton's iterations."""

    case: Case
    circle: float
    geometry: float
    place: float
    strain: float
    peak: float
    length: float
    shear: float
    pressure: float
    iterations: int


def row(case: Case) -> Row:
    """Solve a case by all models."""
    found = chain(case)
    models = [getattr(found, field.name) for field in fields(found)]
    first, last = models[0], models[-1]
    steps = [(b.peak - a.peak) / first.peak for a, b in pairwise(models)]
    whole = [
        getattr(last, name) / getattr(first, name) - 1.0 for name in ("peak", "length", "shear")
    ]
    return Row(case, *steps, *whole, last.peak, last.iterations)


def table(title: str, rows: list[Row]) -> Table:
    """For rich to print; differences in per cent."""
    grid = Table(title=title)
    names = ("a/R", "rms slope", "seed", "p0/E", "true circle", "real geometry", "current place")
    names += ("finite strain", "peak", "length", "tau1_max", "steps")
    for name in names:
        grid.add_column(name, justify="right")
    for each in rows:
        parts = (each.circle, each.geometry, each.place, each.strain)
        grid.add_row(
            f"{each.case.curvature:g}",
            f"{each.case.slope:g}",
            f"{each.case.seed}" if each.case.slope else "",
            f"{each.pressure:.3g}",
            *(f"{100.0 * value:+.3f}" for value in (*parts, each.peak, each.length, each.shear)),
            str(each.iterations),
        )
    return grid


def threshold(points: list[tuple[float, float]], level: float) -> float | None:
    """Where values first reach a level: of means over equal places, straight in logarithms between
    them; None if they do not reach it."""
    place = sorted({x for x, _ in points})
    mean = [float(np.mean([y for x, y in points if x == at])) for at in place]
    above = [i for i, value in enumerate(mean) if value >= level]
    if not above:
        return None
    i = above[0]
    if i == 0:
        return place[0]
    share = np.log(level / mean[i - 1]) / np.log(mean[i] / mean[i - 1])
    return float(place[i - 1] * (place[i] / place[i - 1]) ** share)
