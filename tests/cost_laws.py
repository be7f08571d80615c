"""The laws of cost beside what levels of finite elements take, over all shipped scenes.

    python -m tests.cost_laws [SCENE ...] [--levels N]

Every level is solved in a process of its own, on one thread, with its stresses. Printed are its
unknowns, processor seconds and peak memory, and expected over measured. By these laws levels are
planned and refused (`comparisons.models.finite_element.mesh`); no clock may do that.

Exit status 0 only if every ratio is within WITHIN of 1, either way, where a level takes LEAST
seconds or more: a shorter one is mostly the start of its process.
"""

import argparse
from concurrent.futures import ProcessPoolExecutor
from itertools import chain, product
from multiprocessing import get_context
from typing import NamedTuple

from comparisons.scenes.files import scene_names
from tests import harness

WITHIN = 2.0
LEAST = 1.0  # s
LEVELS = 3
LAWS = {"unknowns": ".0f", "seconds": ".2f", "memory": ".0f"}  # and how they are printed


class LevelCost(NamedTuple):
    """One level: (expected, measured) each; unknowns, processor seconds, MB at the peak."""

    level: str
    unknowns: tuple[float, float]
    seconds: tuple[float, float]
    memory: tuple[float, float]

    def ratio(self, law: str) -> float:
        """Expected over measured."""
        expected, measured = getattr(self, law)
        return expected / measured


def level_cost(name: str, number: int) -> LevelCost:
    """Solve the finite elements' level `number` of a shipped scene."""
    from comparisons.common.progress import Stages, peak_memory
    from comparisons.models.finite_element.level import finite_element_level
    from comparisons.models.finite_element.mesh import Refinement, expected_unknowns
    from comparisons.models.posing import problem_of
    from comparisons.scenes.scene import Scene

    problem = problem_of(Scene.read(name))
    refinement = Refinement(problem.pitches[0] / 2.0 ** (number - 1))
    begin = harness.processor_seconds()
    level, *_ = finite_element_level(problem, refinement, Stages()).values()
    seconds = harness.processor_seconds() - begin
    unknowns = expected_unknowns(problem, refinement, level.patches), level.unknowns
    memory = level.expected_memory / 1e6, peak_memory() / 1e6
    return LevelCost(f"{name} {number}", unknowns, (level.expected_seconds, seconds), memory)


def level_costs(names: list[str], levels: int) -> list[LevelCost]:
    """Costs of each scene's first levels."""
    costs = []
    for name, number in product(names, range(1, levels + 1)):
        with ProcessPoolExecutor(1, get_context("spawn")) as alone:
            costs.append(alone.submit(level_cost, name, number).result())
    return costs


def demands(rows: list[LevelCost]) -> list[harness.Demand]:
    """Demand that every law is within WITHIN, of the levels that take LEAST or more."""
    long = [row for row in rows if row.seconds[1] >= LEAST]
    demanded = []
    for law in LAWS:
        ratios = [row.ratio(law) for row in long] or [1.0]
        text = f"expected over measured {law}: {min(ratios):.2f} to {max(ratios):.2f}"
        holds = min(ratios) >= 1.0 / WITHIN and max(ratios) <= WITHIN
        demanded.append(harness.Demand(holds, f"{text} (within a factor of {WITHIN:g})"))
    return demanded


def main(arguments: list[str] | None = None) -> int:
    """Print the levels and the demands; the exit status."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("scenes", nargs="*", default=scene_names())
    parser.add_argument("--levels", type=int, default=LEVELS)
    options = parser.parse_args(arguments)
    rows, cells = level_costs(options.scenes, options.levels), []
    for row in rows:
        measured = (f"{getattr(row, law)[1]:{form}}" for law, form in LAWS.items())
        ratios = (f"{row.ratio(law):.2f}" for law in LAWS)
        cells.append((row.level, *chain(*zip(measured, ratios, strict=True))))
    columns = ("level", "unknowns", "ratio", "seconds", "ratio", "MB", "ratio")
    harness.print_table("finite elements, one level in a process", columns, cells)
    return harness.print_demands(demands(rows))


if __name__ == "__main__":
    harness.run_on_one_thread(main)
