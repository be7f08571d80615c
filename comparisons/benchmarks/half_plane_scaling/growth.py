"""What one solution took at each size, and what is asked of its growth."""

from dataclasses import dataclass

import numpy as np
from rich.table import Table

STEEPEST = 1.2  # slope of log time over log n
OVERHEAD = 2.0  # times the transforms' own time, from COUNTED nodes on
COUNTED = 65536  # below, the interpreter's own share shows; those rows are printed, not judged
UNEVEN = 1.3  # by which memory per node may differ between sizes from WEIGHED nodes on
WEIGHED = 65536  # below, what the interpreter itself takes shows


@dataclass(frozen=True)
class Growth:
    """One solution: nodes, seconds, exchanges of sides, transforms, memory.

    finest    pairs on the finest grid         pairs  all, in pairs of the finest grid
    pair      seconds of one such pair         memory  peak [bytes]
    """

    count: int
    seconds: float
    exchanges: int
    finest: float
    pairs: float
    pair: float
    memory: int

    @property
    def overhead(self) -> float:
        """Time over that of the pairs alone."""
        return self.seconds / (self.pairs * self.pair)


def demands(rows: list[Growth]) -> list[tuple[bool, str]]:
    """What is asked of the rows of one surface, in ascending order, and whether it holds."""
    found = []
    if len(rows) > 1:
        counts, seconds = [row.count for row in rows], [row.seconds for row in rows]
        slope = np.polyfit(np.log(counts), np.log(seconds), 1)[0]
        found.append((bool(slope <= STEEPEST), f"time as n^{slope:.3f}, at most {STEEPEST:g}"))
    large = [row for row in rows if row.count >= COUNTED]
    if large:
        worst = max(row.overhead for row in large)
        found.append(
            (worst <= OVERHEAD, f"{worst:.2f} times the transforms' own time, at most {OVERHEAD:g}")
        )
    each = [row.memory / row.count for row in rows if row.count >= WEIGHED]
    if len(each) > 1:
        spread = max(each) / min(each)
        text = f"memory per node differs by {spread:.2f}, at most {UNEVEN:g}"
        found.append((spread <= UNEVEN, text))
    return found


def table(title: str, rows: list[Growth]) -> Table:
    """For rich to print."""
    grid = Table(title=title)
    names = ("n", "time [ms]", "exchanges", "finest", "pairs", "pair [ms]", "overhead", "bytes/n")
    for name in names:
        grid.add_column(name, justify="right")
    for row in rows:
        grid.add_row(
            str(row.count),
            f"{1e3 * row.seconds:.4g}",
            str(row.exchanges),
            f"{row.finest:.1f}",
            f"{row.pairs:.1f}",
            f"{1e3 * row.pair:.4g}",
            f"{row.overhead:.2f}",
            f"{row.memory / row.count:.0f}",
        )
    return grid
