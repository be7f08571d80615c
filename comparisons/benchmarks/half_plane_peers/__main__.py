"""The half-plane solver beside other codes, in one run and one thread.

    python -m comparisons.benchmarks.half_plane_peers

A smooth cylinder, a sinusoid and self-affine lines, at several sizes, each solved to the same
contact conditions by one yardstick (`peers_yardstick`). Operators, kernels and plans are made once
for a size and kept, wherever a code lets them be: Tamaas, whose models start from their last
solution, makes a model each time, at a hundredth of its time. Times are the processor's.

Exit status 0 only if a peer is present and, beside those present, ours is never slower, as many
times faster as wanted (`peers_verdict`), and its error no larger. Absent peers are named.
"""

import argparse
import os
import sys
from collections.abc import Callable

SIZES = (256, 1024, 4096, 16384, 65536)
SEEDS = (1, 2, 3)
_ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def main(arguments: list[str] | None = None) -> int:
    options = _options(arguments)
    # before numpy and the peers are loaded: none of them asks again
    os.environ.update(dict.fromkeys(_ONE_THREAD, "1"))
    from rich.console import Console

    from comparisons.benchmarks.half_plane_peers.race import race
    from comparisons.benchmarks.half_plane_peers.verdict import verdicts

    screen = Console(width=130)
    ours, peers = _codes(screen)
    wrong, table = [], _table()
    for title, case_of in _cases(options.seeds):
        first: dict[str, int] = {}
        for count in options.sizes:
            entries = race(case_of(count), ours + peers, options.limit, options.repeats, first)
            first = {entry.code: entry.tolerance for entry in entries}
            for entry in entries:
                table.add_row(title, str(count), *_cells(entry, entries[0]))
            table.add_section()
            found = verdicts(title, count, entries[0], entries[len(ours) :])
            for verdict in found:
                print("holds " if verdict.holds else "FAILS ", verdict.text, flush=True)
            wrong += [verdict for verdict in found if not verdict.holds]
    screen.print(table)
    if not peers:
        print("no peer is installed: nothing is shown")
        return 1
    print(f"{len(wrong)} demands fail" if wrong else "all demands hold")
    return 1 if wrong else 0


def _options(arguments: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sizes", type=int, nargs="+", default=SIZES, help="numbers of nodes")
    parser.add_argument("--seeds", type=int, nargs="*", default=SEEDS, help="of the rough lines")
    parser.add_argument("--repeats", type=int, default=21, help="most timed runs of one code")
    parser.add_argument("--limit", type=float, default=120.0, help="seconds for one run")
    return parser.parse_args(arguments)


def _codes(screen) -> tuple[list, list]:
    """Ours, and the peers that are there; the others are named."""
    from comparisons.benchmarks.half_plane_peers import contact_mechanics as peers_contact_mechanics
    from comparisons.benchmarks.half_plane_peers import crosscheck as peers_crosscheck
    from comparisons.benchmarks.half_plane_peers import tamaas as peers_tamaas
    from comparisons.benchmarks.half_plane_peers.code import AbsentError

    peers = []
    for module in (peers_tamaas, peers_contact_mechanics):
        try:
            peers += module.codes()
        except AbsentError as absent:
            screen.print(f"skipped: {absent}")
    return peers_crosscheck.codes(), peers


def _cases(seeds: list[int]) -> list[tuple[str, Callable]]:
    from functools import partial

    from comparisons.benchmarks.half_plane_peers.cases import cylinder, rough, sinusoid

    rough_lines = [(f"self-affine, seed {seed}", partial(rough, seed=seed)) for seed in seeds]
    return [("cylinder", cylinder), ("sinusoid", sinusoid), *rough_lines]


def _table():
    from rich.table import Table

    table = Table(title="Processor time of one thread; ratio: time over that of the first row")
    for name in ("case", "n", "code", "time [ms]", "ratio", "conditions", "error", "steps"):
        table.add_column(name, justify="left" if name in ("case", "code") else "right")
    return table


def _cells(entry, ours) -> list[str]:
    if entry.over:
        time = f"over {entry.seconds:.0f} s"
    else:
        time = f"{1e3 * entry.seconds:.3g}" if entry.seconds < 1.0 else f"{1e3 * entry.seconds:.0f}"
    return [
        entry.code,
        time,
        f"{'> ' if entry.over else ''}{entry.seconds / ours.seconds:.3g}",
        f"{entry.measure.worst:.1e}" + ("" if entry.meets else " missed"),
        f"{entry.measure.error:.3e}",
        "-" if entry.steps is None else str(entry.steps),
    ]


if __name__ == "__main__":
    sys.exit(main())
