"""Contact on finite elements beside general finite-element codes, at equal error, in one run.

    python -m comparisons.benchmarks.finite_element_peers [--scikit-fem PYTHON]

A cylinder, waves and roughness on it, pressed on the same blocks with the same meshes
(`fe_peers_cases`), by CalculiX, FreeFEM, getfem and scikit-fem, each as its users would
(`fe_peers_calculix` and so on). Every code runs as a process of its own on one thread. Two times
are taken of the processor: of the solution, from the mesh in memory to the pressures, in a process
that has solved once before, and of a whole process that solves once, with its start, the reading
of the mesh and, in Python, its imports. Meshing is common to all and counts in neither.

Exit status 0 only if a peer is present and ours solves no later than those present at every error
that they reach (`fe_peers_verdict`). Absent peers are named.
"""

import argparse
import os
import sys

from comparisons.benchmarks.finite_element_peers.process import ONE_THREAD

CASES = ("cylinder", "waves", "rough")
GROWTHS = (0.4,)  # with 0.2 codes take longer to the errors that are asked for


def main(arguments: list[str] | None = None) -> int:
    """Print the table and the verdicts; the exit status."""
    options = _options(arguments)
    # before numpy is loaded: it does not ask again
    os.environ.update(ONE_THREAD)
    from rich.console import Console

    from comparisons.benchmarks.finite_element_peers import cases as fe_peers_cases
    from comparisons.benchmarks.finite_element_peers import codes as fe_peers_codes
    from comparisons.benchmarks.finite_element_peers.race import race
    from comparisons.benchmarks.finite_element_peers.verdict import medians, verdicts

    screen = Console(width=140)
    codes = fe_peers_codes.ours()
    for peer in fe_peers_codes.PEERS:
        command = getattr(options, peer.option.strip("-").replace("-", "_"))
        if fe_peers_codes.there(peer, command):
            codes.append(peer.code(command))
        else:
            print(f"skipped: {peer.name} is not there ({command}): {peer.get}", flush=True)
    meshes, shown = _mesh_table(), _verdict_table()
    found = []
    for name in options.cases:
        case = getattr(fe_peers_cases, name)()
        points = race(case, codes, options.growths, options.rounds, options.limit, print)
        for point in points:
            meshes.add_row(case.title, *_cells(point))
        meshes.add_section()
        found += verdicts(case.title, points, fe_peers_codes.OURS)
    for verdict in found:
        shown.add_row(*_verdict_cells(verdict))
    if options.meshes:
        screen.print(meshes)
    screen.print(shown)
    for peer, (solve, whole) in medians(found).items():
        print(f"{peer}: median ratio {solve:.3g} of solutions, {whole:.3g} of whole processes")
    if not found:
        print("no peer is there: nothing is shown")
        return 1
    late = sum(not verdict.holds for verdict in found)
    print(f"ours is later at {late} errors" if late else "ours is never later")
    return 1 if late else 0


def _options(arguments: list[str] | None) -> argparse.Namespace:
    from comparisons.benchmarks.finite_element_peers.codes import PEERS

    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--cases", nargs="+", default=CASES, choices=CASES)
    parser.add_argument("--growths", type=float, nargs="+", default=GROWTHS, help="of the meshes")
    parser.add_argument("--rounds", type=int, default=3, help="processes of each code on a mesh")
    parser.add_argument(
        "--limit", type=float, default=60.0, help="processor seconds for one process"
    )
    parser.add_argument("--meshes", action="store_true", help="also print every mesh's row")
    for peer in PEERS:
        parser.add_argument(peer.option, default=peer.start, help=f"default {peer.start}")
    return parser.parse_args(arguments)


def _mesh_table():
    from rich.table import Table

    table = Table(title="Every mesh")
    names = ("case", "code", "how", "edges", "growth", "unknowns", "steps")
    for name in (*names, "solve [ms]", "whole [ms]", "peak", "pressure"):
        table.add_column(name, justify="left" if name in ("case", "code", "how") else "right")
    return table


def _cells(point) -> list[str]:
    return [
        point.code,
        point.how,
        str(point.edges),
        f"{point.growth:g}",
        str(point.unknowns),
        str(point.steps),
        f"{1e3 * point.solve:.3g}",
        f"{1e3 * point.whole:.3g}",
        *(f"{point.errors[name]:.1e}" for name in ("peak", "pressure")),
    ]


def _verdict_table():
    from rich.table import Table

    table = Table(title="Processor time of one thread at equal error; ratio: the peer's over ours")
    for name in ("case", "error", "at", "peer"):
        table.add_column(name, justify="right" if name == "at" else "left")
    for name in (
        "solve: ours [ms]",
        "peer [ms]",
        "ratio",
        "whole: ours [ms]",
        "peer [ms]",
        "ratio",
    ):
        table.add_column(name, justify="right")
    table.add_column("")
    return table


def _verdict_cells(verdict) -> list[str]:
    def number(value: float | None, scale: float = 1e3) -> str:
        return "not reached" if value is None else f"{scale * value:.3g}"

    def ratio(value: float | None) -> str:
        return "" if value is None else f"{value:.3g}"

    return [
        verdict.case,
        verdict.error,
        f"{verdict.target:g}",
        verdict.peer,
        *map(number, verdict.solve),
        ratio(verdict.ratio),
        *map(number, verdict.whole),
        ratio(verdict.whole_ratio),
        "holds" if verdict.holds else "LATER",
    ]


if __name__ == "__main__":
    sys.exit(main())
