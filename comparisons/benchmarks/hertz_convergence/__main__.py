"""How the finite elements' error of Hertz's contact falls with unknowns and with time.

    python -m comparisons.benchmarks.hertz_convergence

Equal edges under equal hats with displacements of degree 1, 2 and 3, more hats to an edge, a block
of 400 half-widths in place of the far field, and meshes that the contact chooses itself. Elements
grow away from equal edges by less the finer they are; on meshes of the fewest unknowns, which the
chosen ones are measured by, as steeply as those.

One thread; times hold gmsh's process, meshing, assembly, factorisation and contact, not the
stresses, and not the loading of libraries, which a first solution of each degree takes beforehand.

Exit status 0 only if the demands named below hold.
"""

import argparse
import os
import sys
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from comparisons.benchmarks.hertz_convergence.runs import Run, adapted, equal_edges
from comparisons.models.finite_element.adaptive import GROWTH

TOLERANCES = (1e-2, 3e-3, 1e-3, 3e-4, 1e-4)
# Error of the peak pressure, and the seconds of the processor that it may take at most.
WANTED = ((1e-3, 1.0), (1e-4, 10.0))
LEAST_RATIO = 3.5  # unknowns of equal edges over those of adapted ones at the same pressure
# Orders of equal edges of degree 2 in the number of edges: highest node, L2; then of adapted hats
# in their number, L2.
ORDERS = ((2.0, 0.4), (1.0, 0.15), (-2.0, 0.4))
_FEWEST = "degree 2, steep growth"
_ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


@dataclass(frozen=True)
class Method:
    """Runs of one method, coarse to fine."""

    name: str
    runs: tuple[Run, ...]

    def order(self, size: str, error: str) -> float:
        """Slope of log error over log size, least squares; both are names of fields of `Run`."""
        sizes, errors = ([getattr(run, name) for run in self.runs] for name in (size, error))
        return float(np.polyfit(np.log(sizes), np.log(errors), 1)[0])

    def cheapest(self, error: str, wanted: float) -> Run | None:
        """The coarsest run that has the error wanted, as all finer ones have."""
        found = None
        for run in reversed(self.runs):
            if getattr(run, error) > wanted:
                break
            found = run
        return found


def methods(finest: int, tolerances: tuple[float, ...]) -> list[Method]:
    """All methods; equal edges up to `finest` on half of the contact."""
    counts = [count for count in (5, 10, 20, 40, 80, 160) if count <= finest]

    def series(name: str, run: Callable[[float], Run], sizes: list) -> Method:
        return Method(name, tuple(run(size) for size in sizes))

    for degree in (1, 2, 3):
        equal_edges(counts[0], degree)
    found = [
        series(f"degree {degree}", lambda n, degree=degree: equal_edges(n, degree), counts)
        for degree in (1, 2, 3)
    ]
    found += [
        series(
            f"degree {degree}, {hats} hats an edge",
            lambda n, degree=degree, hats=hats: equal_edges(n, degree, hats),
            counts[:-1],
        )
        for degree, hats in ((2, 2), (3, 2), (3, 3))
    ]
    found += [
        series("degree 2, block of 400 a", lambda n: equal_edges(n, far_field=False), counts),
        series(_FEWEST, lambda n: equal_edges(n, growth=GROWTH), counts),
    ]
    found += [
        series(
            f"degree {degree}, adapted",
            lambda tolerance, degree=degree: adapted(tolerance, degree),
            sorted(tolerances, reverse=True),
        )
        for degree in (2, 3)
    ]
    return found


def unknowns_ratio(equal: Method, other: Method) -> list[tuple[float, float]]:
    """For each run of `other` its L2 error, and how many times its unknowns `equal` needs for it.

    On straight lines between the logarithms of the runs of `equal`, and beyond by the last one.
    """
    errors = np.log([run.hats for run in equal.runs])
    unknowns = np.log([run.unknowns for run in equal.runs])
    found = []
    for run in other.runs:
        at = np.log(run.hats)
        k = int(np.clip(np.searchsorted(-errors, -at) - 1, 0, len(errors) - 2))
        share = (at - errors[k]) / (errors[k + 1] - errors[k])
        needed = np.exp(unknowns[k] + share * (unknowns[k + 1] - unknowns[k]))
        found.append((run.hats, float(needed / run.unknowns)))
    return found


def demands(found: dict[str, Method]) -> list[tuple[bool, str]]:
    """What is asked, and whether it holds."""
    verdicts = []
    for wanted, seconds in WANTED:
        runs = [
            (run.seconds, method.name, run)
            for method in found.values()
            if (run := method.cheapest("peak", wanted)) is not None
        ]
        took, name, run = min(runs, default=(np.inf, "no method", None), key=lambda row: row[0])
        size = "" if run is None else f", {run.unknowns} unknowns"
        text = f"{wanted:g} in peak pressure in {took:.2f} s ({name}{size}), at most {seconds:g} s"
        verdicts.append((took <= seconds, text))
    equal, own = found["degree 2"], found["degree 2, adapted"]
    slopes = (
        -equal.order("size", "node"),
        -equal.order("size", "hats"),
        own.order("count", "hats"),
    )
    names = ("highest node in edges", "pressure L2 in edges", "adapted pressure L2 in hats")
    for slope, (order, slack), name in zip(slopes, ORDERS, names, strict=True):
        text = f"order of the {name} {slope:.2f}, wanted {order:g} within {slack:g}"
        verdicts.append((abs(slope - order) <= slack, text))
    ratios = unknowns_ratio(found[_FEWEST], own)
    least = min(ratio for _, ratio in ratios)
    each = ", ".join(f"{ratio:.1f} at {error:.1e}" for error, ratio in ratios)
    text = f"equal edges need {each} times the unknowns, at least {LEAST_RATIO:g}"
    return [*verdicts, (least >= LEAST_RATIO, text)]


def table(found: list[Method]) -> str:
    """All runs as text."""
    columns = ("node", "peak", "half_width", "hats", "curve", "tau1")
    heads = ("node", "peak", "half-width", "L2 hats", "L2 smooth", "tau1")
    lines = [
        f"{'':25} {'size':>7} {'unknowns':>8} {'hats':>5} {'cpu s':>6} {'wall s':>6} "
        + " ".join(f"{head:>10}" for head in heads)
    ]
    for method in found:
        for run in method.runs:
            errors = " ".join(f"{getattr(run, name):10.1e}" for name in columns)
            lines.append(
                f"{method.name:25} {run.size:7g} {run.unknowns:8d} {run.count:5d} "
                f"{run.seconds:6.2f} {run.wall:6.2f} {errors}"
            )
        orders = [method.order("unknowns", name) for name in columns]
        fitted = " ".join(f"{order:10.2f}" for order in orders)
        lines.append(f"{'  order in unknowns':62} {fitted}")
    return "\n".join(lines)


def main(arguments: list[str] | None = None) -> int:
    """Print the table and what it shows; the exit status."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--finest", type=int, default=80, help="equal edges on half of the contact")
    parser.add_argument("--tolerances", type=float, nargs="+", default=TOLERANCES)
    given = parser.parse_args(arguments)
    found = methods(given.finest, tuple(given.tolerances))
    print(table(found) + "\n")
    wrong = 0
    for holds, text in demands({method.name: method for method in found}):
        print("holds " if holds else "FAILS ", text)
        wrong += not holds
    return 1 if wrong else 0


if __name__ == "__main__":
    if os.environ.get("OMP_NUM_THREADS") != "1":
        # Their own threads are counted when libraries are loaded.
        again = [
            sys.executable,
            "-m",
            "comparisons.benchmarks.hertz_convergence",
            *sys.argv[1:],
        ]
        os.execve(sys.executable, again, os.environ | dict.fromkeys(_ONE_THREAD, "1"))
    sys.exit(main())
