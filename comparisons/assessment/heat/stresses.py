"""The largest stresses of contact and heat together by both models, and their difference."""

from comparisons.assessment.convergence import grid_convergence
from comparisons.assessment.heat.figures import HeatFigure
from comparisons.assessment.uncertainty import far_boundary, iteration
from comparisons.assessment.verdict import judge
from comparisons.models.level import ModelRun
from comparisons.models.problem import Problem
from comparisons.models.thermal_stress import HeatedStress, half_plane_stress
from comparisons.models.window import Window

FORMAL_ORDER = 1.0  # next to the ends of contact, where the fluxes are infinite


def stress_figures(
    problem: Problem, runs: dict[str, ModelRun], window: Window
) -> tuple[tuple[HeatFigure, ...], dict[str, HeatedStress]]:
    """The figures, and each model's stresses on the finest level. A stress is measured by the
    larger one with heat and without, as heat may cancel it; a depth by the contact's half-width."""
    histories, moved = {}, {}
    if "half_plane" in runs:
        levels = runs["half_plane"].levels
        histories["half_plane"] = [half_plane_stress(problem, each, window) for each in levels]
    if "finite_element" in runs:
        from comparisons.models.finite_element.thermal_stress import finite_element_stress

        levels = runs["finite_element"].levels
        coarse, *_ = own = [finite_element_stress(problem, each, window) for each in levels]
        histories["finite_element"] = own
        smaller = finite_element_stress(problem, levels[0], window, beyond=0.5).figures
        for name, (value, _) in coarse.figures.items():
            moved[name] = far_boundary(smaller[name][0], value)
    finest = {model: history[-1] for model, history in histories.items()}
    figures = []
    for name, pair in list(finest.values())[-1].figures.items():
        size = problem.hertz.half_width if "depth" in name else max(map(abs, pair))
        shown, elastic = ({m: s.figures[name][k] for m, s in finest.items()} for k in range(2))
        own = {}
        for model, history in histories.items():
            values = [each.figures[name][0] for each in history]
            left = grid_convergence(values, FORMAL_ORDER).uncertainty
            left += moved[name] if model == "finite_element" else 0.0
            own[model] = left / size + iteration(runs[model].finest)
        compared = {}
        if len(finest) == 2:
            difference = (shown["half_plane"] - shown["finite_element"]) / size
            judged = sum(own.values()), problem.scene.heat.tolerance
            compared = dict(zip(("uncertainty", "tolerance"), judged, strict=True))
            compared |= {"difference": difference, "verdict": judge(difference, *judged)}
        figures.append(HeatFigure(name, shown, own, elastic=elastic, **compared))
    return tuple(figures), finest
