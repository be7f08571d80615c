"""What a rough contact on finite elements costs beside the factorisation that it stands on.

    python -m comparisons.benchmarks.contact_after_factorisation

Self-affine surfaces of a scene that comes along, one a seed, on the first level of refinement that
has at least so many unknowns. The contact is everything that follows the factorisation up to the
pressures: nodal forces of the hats, the prediction, every back-substitution and every solution of
the model. Medians of repeats, one thread.

Exit status 0 only if every contact converged and none took more than half of its factorisation.
"""

import argparse
import os
import sys

LEAST_UNKNOWNS = 75_000
MOST_OF_FACTORISATION = 0.5
SCENE = "self-affine"
_ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def main(arguments: list[str] | None = None) -> int:
    """Print one row a seed; the exit status."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--seeds", type=int, default=12, help="surfaces")
    parser.add_argument("--repeats", type=int, default=3, help="timed runs of each")
    parser.add_argument("--unknowns", type=int, default=LEAST_UNKNOWNS, help="at least so many")
    options = parser.parse_args(arguments)
    # before numpy is loaded: it does not ask again
    os.environ.update(dict.fromkeys(_ONE_THREAD, "1"))
    from rich.console import Console
    from rich.table import Table

    table = Table(title=f"contact on finite elements, scene {SCENE} with other seeds")
    for name in ("seed", "unknowns", "hats", "applications", "factorisation s", "contact s"):
        table.add_column(name, justify="right")
    table.add_column("ratio", justify="right")
    holds = True
    for seed in range(1, options.seeds + 1):
        levels = _levels(seed, options.unknowns, options.repeats)
        solution = levels[0].solution
        factorisation, contact = (_median(levels, name) for name in ("factorisation", "contact"))
        ratio = contact / factorisation
        holds = holds and solution.converged and ratio <= MOST_OF_FACTORISATION
        table.add_row(
            str(seed),
            f"{levels[0].unknowns}",
            f"{levels[0].grid.count}",
            f"{solution.iterations['applications']}" + ("" if solution.converged else " (open)"),
            f"{factorisation:.3f}",
            f"{contact:.3f}",
            f"{ratio:.2f}",
        )
    Console(width=120).print(table)
    print("holds" if holds else "FAILS", f"contact at most {MOST_OF_FACTORISATION} of it")
    return 0 if holds else 1


def _levels(seed: int, unknowns: int, repeats: int) -> list:
    """A level of the seed's surface, its stress window left out, solved so many times."""
    from pathlib import Path

    from comparisons.common.progress import Stages
    from comparisons.models.finite_element.level import finite_element_level
    from comparisons.models.finite_element.mesh import Refinement
    from comparisons.models.plan import make_plan
    from comparisons.models.problem import problem_of
    from comparisons.scenes.files import find_scene, read_toml
    from comparisons.scenes.resolve import resolve_tables

    tables = dict(read_toml(find_scene(SCENE)))
    tables.pop("stress")
    tables["profile"] = tables["profile"] | {"seed": seed}
    scene = resolve_tables(tables, name=f"seed-{seed}", folder=Path("."), source=SCENE)
    problem = problem_of(scene)
    plan = make_plan(problem, ("finite_element",))

    def level(pitch: float):
        return finite_element_level(problem, plan, Refinement(pitch), None, Stages())

    pitch = problem.pitches[0]
    while level(pitch).unknowns < unknowns:
        pitch *= 0.5
    return [level(pitch) for _ in range(repeats)]


def _median(levels: list, stage: str) -> float:
    """Seconds of a stage."""
    import statistics

    return statistics.median(level.seconds[stage] for level in levels)


if __name__ == "__main__":
    sys.exit(main())
