"""Where the body begins to flow, in words and as a table."""

from comparisons.common.numbers import percent, plain, significant, with_unit
from comparisons.studies.study import Run, TextTable
from comparisons.studies.yielding import NAME, FlowAssessment


def flow_sentence(outcome: Run) -> str:
    """The one thing to know of flow beside the verdict, without its full stop."""
    flow = outcome.data(NAME)
    if flow.beyond_doubt:
        return flow.beyond_doubt
    worst = flow.worst
    where = f" at friction {plain(worst.friction)}" if len(flow.checks) > 1 else ""
    where += "" if worst.from_field else ", by the peak pressure (no [stress])"
    if flow.ratio is None:
        shear = with_unit(worst.tau1, "Pa", 2)
        return f"elastic; first flow at a shear yield below {shear}{where}"
    stress = with_unit(flow.yield_stress, "Pa", 3)
    third = "" if outcome.problem.scene.body.yield_stress else ", a third of the hardness"
    largest = f"the half-plane's largest shear is {significant(flow.ratio, 2)} times that of first "
    largest += f"flow{where} (Y = {stress}{third})"
    if flow.flow == "cap":
        return f"flow is the cap alone, at {percent(worst.at_hardness)} of the contact; {largest}"
    return f"{'the finite elements flow' if flow.flow == 'plastic' else 'elastic'}; {largest}"


def flow_table(outcome: Run) -> TextTable:
    """Figures of flow by friction coefficient; without a yield stress its first rows alone."""
    flow = outcome.data(NAME)
    rows = [
        ("largest principal shear stress τ₁", *(with_unit(c.tau1, "Pa") for c in flow.checks)),
        ("von Mises", *(with_unit(c.von_mises, "Pa") for c in flow.checks)),
        ("found", *("in the field" if c.from_field else "by the peak" for c in flow.checks)),
    ]
    if flow.yield_stress is not None:
        rows += _of_yield_stress(flow)
    head = ("", *(f"friction {plain(check.friction)}" for check in flow.checks))
    return TextTable(flow_sentence(outcome), head, tuple(rows))


def _of_yield_stress(flow: FlowAssessment) -> list[tuple[str, ...]]:
    shear = 0.5 * flow.yield_stress
    ratios = [check.over_first_flow(flow.yield_stress) for check in flow.checks]
    rows = [
        ("over first flow, Tresca", *(significant(tresca, 3) for tresca, _ in ratios)),
        ("over first flow, von Mises", *(significant(mises, 3) for _, mises in ratios)),
        ("contact at the hardness or above", *(percent(c.at_hardness) for c in flow.checks)),
        ("peak pressure over k = Y/2", *(significant(c.peak / shear, 3) for c in flow.checks)),
        ("elastic shakedown up to", *(significant(c.shakedown, 3) for c in flow.checks)),
    ]
    if flow.slope_index is not None:
        indices = (
            ("plasticity index, summits", flow.summit_index),
            ("plasticity index, slope", flow.slope_index),
        )
        rows += [(words, *(significant(value, 3) for _ in ratios)) for words, value in indices]
    return rows
