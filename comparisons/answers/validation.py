"""The validation comparison of ASME V&V 20 (2009), where measured data were given.

    E = S - D        u_val = sqrt(u_num^2 + u_input^2 + u_D^2)

S is a model's figure, D the measured one; all are relative to D, and expanded uncertainties. The
model error lies within E +- u_val.
"""

import math
from collections.abc import Mapping

from comparisons.assessment.comparison import figures, uncertainties
from comparisons.models.level import ModelRun
from comparisons.models.problem import Problem


def validation_rows(
    problem: Problem,
    runs: Mapping[str, ModelRun],
    scatter: float,
    measured: Mapping[str, float],
    friction: float,
    inputs: Mapping[str, float | None],
) -> dict[str, list[dict]]:
    """By quantity, a row for each model: E, u_num, u_input, u_D and u_val.

    measured  figures of the data, SI; their `scatter` is relative
    inputs    u_input by quantity, None or absent where it was not computed: it counts as none then
    """
    found: dict[str, list[dict]] = {}
    for name, run in runs.items():
        stated = uncertainties(run, problem, friction)
        for quantity, value in figures(run.finest, problem, friction).items():
            data = measured.get(quantity)
            if not data:
                continue
            u_num, u_input = stated[quantity].total * abs(value / data), inputs.get(quantity)
            u_val = math.sqrt(u_num**2 + (u_input or 0.0) ** 2 + scatter**2)
            row = {"friction": friction, "model": name, "E": (value - data) / data, "u_num": u_num}
            row |= {"u_input": u_input, "u_D": scatter, "u_val": u_val}
            found.setdefault(quantity, []).append(row)
    return found
