"""The half-plane's model error as the project states it, held against finite strain solved anew.

    python -m tests.finite_strain_check            the project on every scene
    python -m tests.finite_strain_check --solve    only solves the scenes anew

Each scene is run with its effects, and the stated model error of each figure compared with

    half-plane / independent value - 1

The independent values come from finite elements of quadratic triangles (`solid`, `contact`) that
share nothing with the project's: both bodies neo-Hookean at finite strain, contact on the deformed
surfaces, friction along them, elastic rollers as bodies of their own, as discs where a/R exceeds
0.03. They are kept in values.json; solving anew takes about a minute of processor time a scene.
Within: the two differ by no more than both uncertainties together, the root of the sum of their
squares.

Exit status 0 only if at least 95 % of the figures are, the coverage that uncertainties are stated
with, and none is off by more than three times both.
"""

import argparse
import math
from typing import NamedTuple

import comparisons as crosscheck
from comparisons.api import scene_of
from comparisons.figures.figure import Figures
from tests.finite_strain_check import cases
from tests.harness import Demand, print_demands, print_table

COLUMNS = ("scene", "mu", "figure", "stated %", "+-", "independent %", "+-", "ratio", "within")
COVERAGE, WORST = 0.95, 3.0


class Held(NamedTuple):
    """One figure of a scene: the half-plane's relative error as stated and as found
    independently, with the uncertainties of both."""

    scene: str
    friction: float
    quantity: str
    stated: float
    uncertainty: float
    computed: float
    numerical: float

    @property
    def ratio(self) -> float:
        """Ratio of the difference to both uncertainties: within where it is at most 1."""
        return abs(self.stated - self.computed) / math.hypot(self.uncertainty, self.numerical)


def held(name: str, stated: Figures, independent: dict) -> list[Held]:
    """Every model error that a run has stated beside `independent` figures of `cases.kept`."""
    rows = []
    for error in stated.of(study="model_error", source="half_plane"):
        if error.quantity in cases.QUANTITIES:
            value = stated.one(study="contact", source="half_plane", quantity=error.quantity).value
            known = independent[error.quantity]
            ratio = value / known["value"]
            numerical = ratio * known["uncertainty"] / known["value"]
            of_figure = name, error.friction, error.quantity, error.value, error.numerical
            rows.append(Held(*of_figure, ratio - 1, numerical))
    return rows


def demands(rows: list[Held]) -> list[Demand]:
    """Demands on the figures of all scenes."""
    within, worst = sum(row.ratio <= 1.0 for row in rows), max(row.ratio for row in rows)
    return [
        Demand(within >= COVERAGE * len(rows), f"{within} of {len(rows)} figures are within"),
        Demand(worst <= WORST, f"the worst is off by {worst:.2f} times both uncertainties"),
    ]


def main(arguments: list[str] | None = None) -> int:
    """Print every figure; the exit status."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--scenes", nargs="+", default=list(cases.SCENES), choices=cases.SCENES)
    parser.add_argument("--solve", action="store_true", help="the independent values, anew")
    options = parser.parse_args(arguments)
    if options.solve:
        for name in options.scenes:
            scene = scene_of(cases.SCENES[name])
            task = cases.task_of(scene, scene.load.friction[0])
            levels = cases.levels_of(task)
            meshes = cases.solved(task, levels, print)
            values = cases.read_values() if cases.VALUES.exists() else {}
            cases.write_values(values | {name: cases.kept(meshes, levels)})
        return 0
    values, rows = cases.read_values(), []
    for name in options.scenes:
        rows += held(name, crosscheck.run(cases.SCENES[name]).figures, values[name]["figures"])
    cells = []
    for row in rows:
        percents = (row.stated, row.uncertainty, row.computed, row.numerical)
        numbers = (f"{100.0 * value:+.2f}" for value in percents)
        within = f"{row.ratio:.2f}", "yes" if row.ratio <= 1.0 else "NO"
        cells.append((row.scene, f"{row.friction:g}", row.quantity, *numbers, *within))
    print_table("The half-plane's error, as stated and as found independently", COLUMNS, cells)
    return print_demands(demands(rows))
