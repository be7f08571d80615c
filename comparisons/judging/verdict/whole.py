"""The figures to use where the half-plane's are not good enough.

In: a run of both models. Out: the whole model's as a clause, and why some are withheld."""

import math

import numpy as np

from comparisons.common.numbers import percent, plain, with_unit
from comparisons.figures.quantity import QUANTITIES, WHOLE, label
from comparisons.judging import yielding
from comparisons.judging.effects.catalogue import EFFECTS, FLOW
from comparisons.judging.model_error.show import figure_of_whole
from comparisons.judging.study import LADDER, MODEL_ERROR, Run

SHEARS = ("tau1_max", "txz_max_abs")


def figures_of_whole(run: Run) -> str:
    """The figures to use instead, at the largest friction, each with its uncertainty; before them
    those that are not known to their tolerance, or that the body cannot bear, and why."""
    friction, known = max(run.problem.scene.load.friction), run.figures.of(study=LADDER)
    offered, withheld = [], {}
    for error in run.model_errors.of(friction=friction):
        of_whole = known.one(source=WHOLE, quantity=error.quantity, friction=friction) or error
        unsure, value = of_whole.total, figure_of_whole(run, error)
        borne = _borne(run, friction) if error.quantity in SHEARS else math.inf
        size = with_unit(value, QUANTITIES[error.quantity].unit)
        figure = f"{label(error.quantity)} {size} ± {percent(unsure)}"
        if value > borne:
            why = f"more than the body bears, {with_unit(borne, 'Pa')}"
            withheld.setdefault(why, []).append(figure)
        elif not unsure <= error.tolerance:
            why = "finer levels take more budget.time"
            if of_whole.not_modelled > of_whole.numerical:
                why = f"{EFFECTS[of_whole.largest_unknown].label} is not modelled"
            withheld.setdefault(f"not known to the tolerance ({why})", []).append(figure)
        else:
            offered.append(figure)
    where = f" (friction {plain(friction)})" if len(run.problem.scene.load.friction) > 1 else ""
    said = f"take the whole model's {', '.join(offered)}" if offered else "take no figure"
    words = (f"{', '.join(figures)}: {why}" for why, figures in withheld.items())
    return "; ".join([*words, f"{said}{where}"])


def _borne(run: Run, friction: float) -> float:
    """The largest shear [Pa] that a body bears which flows in the whole model: by von Mises, with
    what it has hardened by; infinite where the flow stress is not known."""
    body = run.problem.scene.body
    if body.yield_stress is None or FLOW not in run.data(MODEL_ERROR).selection.whole:
        return math.inf
    flow = body.flow_stress()
    wanted = {"study": yielding.NAME, "quantity": yielding.PLASTIC_STRAIN, "source": WHOLE}
    strain = run.figures.one(**wanted, friction=friction)
    if strain is None:
        hardens = flow.slope(np.zeros(1))[0] or flow.kinematic
        return math.inf if hardens else flow.yield_stress / 3.0**0.5
    most = strain.value * (1.0 + strain.numerical)
    # Prager's back stress in tension is H' times the plastic strain
    return float(flow.stress(most) + flow.kinematic * most) / 3.0**0.5
