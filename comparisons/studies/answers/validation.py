"""The validation comparison of ASME V&V 20 (2009), where measured data were given.

    E = S - D        u_val = sqrt(u_num^2 + u_input^2 + u_D^2)

S is a model's figure, D the measured one; all are relative to D, and expanded uncertainties. The
model error lies within E +- u_val."""

import math
from collections.abc import Mapping

from comparisons.figures.figure import Figures
from comparisons.models.level import ModelRun
from comparisons.models.problem import Problem
from comparisons.studies.contact import uncertainties, values_of
from comparisons.studies.scatter.study import by_inputs


def validation_rows(
    problem: Problem,
    runs: Mapping[str, ModelRun],
    measured: Mapping[float, Mapping[str, float]],
    u_data: float,
    scattered: Figures,
) -> dict[str, list[dict]]:
    """By quantity, a row for each friction coefficient and model.

    measured  the data's figures by friction and quantity, SI; `u_data` is their relative scatter
    scattered  the half-plane's by uncertain inputs; where one is not known, u_input is None and
               counts as none"""
    found: dict[str, list[dict]] = {}
    for friction, data in measured.items():
        for name, run in runs.items():
            stated = uncertainties(run, problem, friction)
            for quantity, value in values_of(run.finest, problem, friction).items():
                if not data.get(quantity):
                    continue
                ratio = value / data[quantity]
                inputs = scattered.one(quantity=quantity, friction=friction)
                u_num = abs(ratio) * stated[quantity].total
                u_input = abs(ratio) * by_inputs(inputs) if inputs else None
                row = {"friction": friction, "model": name, "E": ratio - 1.0, "u_num": u_num}
                u_val = math.hypot(u_num, u_input or 0.0, u_data)
                row |= {"u_input": u_input, "u_D": u_data, "u_val": u_val}
                found.setdefault(quantity, []).append(row)
    return found
