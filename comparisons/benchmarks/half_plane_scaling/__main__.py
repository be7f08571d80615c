"""How the half-plane solver's time and memory grow with the number of nodes.

    python -m comparisons.benchmarks.half_plane_scaling

A self-affine line between fixed cut-offs with a tenth of it in contact, closed, and a smooth
cylinder on a free one: the same surfaces, sampled ever more finely. Processor time of one thread,
from building the operator on.

A pair is the transform of one application on the finest grid, there and back. Shorter ones, of the
preconditioner and of coarser grids, count by their length. Exit status 0 only if the demands named
below hold for both.
"""

import argparse
import os
import sys

SIZES = tuple(2**power for power in range(10, 21, 2))
_ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def main(arguments: list[str] | None = None) -> int:
    """Print both tables and what they show; the exit status."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=SIZES, help="numbers of nodes")
    parser.add_argument("--repeats", type=int, default=9, help="most timed runs of one size")
    options = parser.parse_args(arguments)
    # before numpy is loaded: it does not ask again
    os.environ.update(dict.fromkeys(_ONE_THREAD, "1"))
    from rich.console import Console

    from comparisons.benchmarks.half_plane_scaling.growth import demands, table
    from comparisons.benchmarks.half_plane_scaling.runs import cylinder, grown, rough

    screen, holds = Console(width=120), True
    for title, problem in (("self-affine, closed", rough), ("cylinder, free", cylinder)):
        rows = [grown(problem, count, options.repeats) for count in sorted(options.sizes)]
        screen.print(table(title, rows))
        for holding, text in demands(rows):
            print("holds " if holding else "FAILS ", f"{title}: {text}")
            holds = holds and holding
    return 0 if holds else 1


if __name__ == "__main__":
    sys.exit(main())
