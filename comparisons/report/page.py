"""The report: one page that opens without a network and prints without loss."""

from collections.abc import Callable
from contextlib import nullcontext
from importlib import import_module

from comparisons.common.processes import uncollected
from comparisons.common.tasks import Here, Tasks, tasks_of_copies
from comparisons.figures.quantity import HYPHENATED
from comparisons.report.field_values import field_explorer
from comparisons.report.figures.answers import answer_pictures
from comparisons.report.figures.convergence import convergence_picture
from comparisons.report.figures.cost import cost_picture
from comparisons.report.figures.fields import field_pictures, near_surface_pictures
from comparisons.report.figures.heat import heat_pictures
from comparisons.report.figures.mesh import mesh_pictures
from comparisons.report.figures.model_error import model_error_picture
from comparisons.report.figures.pressures import close_up_picture, pressure_picture
from comparisons.report.figures.problem import problem_picture
from comparisons.report.figures.running_in import running_in_picture
from comparisons.report.figures.sections import bulge_picture, section_pictures
from comparisons.report.figures.statistics import statistics_pictures
from comparisons.report.figures.style import drawing
from comparisons.report.figures.surfaces import surface_picture
from comparisons.report.headline import headline
from comparisons.report.html import inline, rendered
from comparisons.report.tables.answers import answer_facts, answer_table, measured_table
from comparisons.report.tables.bulge import bulge_table
from comparisons.report.tables.comparison import comparison_rows, coupling_table, figure_table
from comparisons.report.tables.convergence import WORDS, judged_table, validation_table
from comparisons.report.tables.heat import heat_facts, heat_table
from comparisons.report.tables.model_error import effects_table, model_error_rows
from comparisons.report.tables.problem import problem_sheet
from comparisons.report.tables.quiescent_zone import zone_table
from comparisons.report.tables.scatter import scatter_table
from comparisons.report.tables.statistics import statistics_tables
from comparisons.report.tables.text import is_shown
from comparisons.report.tables.verification import (
    check_table,
    commands,
    convergence_tables,
    cost_table,
    operator_note,
    operator_table,
    record_rows,
    refinement_text,
)
from comparisons.report.tables.yielding import flow_table
from comparisons.results.outcome import Outcome

# Each gives one picture, a list, or None where it does not apply; about the longest first.
PICTURES: dict[str, Callable[[Outcome], object]] = {
    "fields": field_pictures,
    "near": near_surface_pictures,
    "model_error": model_error_picture,
    "mesh": mesh_pictures,
    "pressure": pressure_picture,
    "sections": section_pictures,
    "convergence": convergence_picture,
    "close_up": close_up_picture,
    "problem": problem_picture,
    "surface": surface_picture,
    "running_in": running_in_picture,
    "bulge": bulge_picture,
    "cost": cost_picture,
    "answers": answer_pictures,
    "statistics": statistics_pictures,
    "heat": heat_pictures,
}


def render(outcome: Outcome, tasks: Tasks | None = None) -> str:
    """The page of a finished run, drawn by `report_tasks`; equal outcomes give equal text."""
    script, policy = inline("field_values.js")
    errors = [] if outcome.budget is None else model_error_rows(outcome)
    return rendered(
        "page.html.j2",
        script=script,
        policy=policy,
        explorer=field_explorer(outcome),
        outcome=outcome,
        scene=outcome.problem.scene,
        headline=headline(outcome),
        models=[HYPHENATED[name] for name in outcome.runs],
        comparisons=[r for r in comparison_rows(outcome) if is_shown(outcome, r.quantity)],
        figure_table=None if outcome.plan.compares else figure_table(outcome),
        sheet=problem_sheet(outcome),
        skipped=[(item.step, item.because) for item in outcome.plan.skipped],
        refinement=refinement_text(outcome),
        convergence=convergence_tables(outcome),
        judged=judged_table(outcome),
        validation=validation_table(outcome),
        words=WORDS,
        coupling=coupling_table(outcome),
        scatter=scatter_table(outcome),
        statistics=statistics_tables(outcome),
        heat=heat_table(outcome),
        heat_facts=outcome.heat and heat_facts(outcome),
        model_errors=[r for r in errors if is_shown(outcome, r.quantity)],
        effects=effects_table(outcome),
        flow=flow_table(outcome),
        zone=zone_table(outcome),
        bulge=bulge_table(outcome),
        answers=[
            (each.name, answer_table(outcome, each), answer_facts(each), measured_table(each))
            for each in outcome.answers
        ],
        checks=check_table(outcome),
        operator=operator_table(outcome),
        operator_note=operator_note(outcome),
        cost=cost_table(outcome),
        record=record_rows(outcome),
        commands=commands(outcome),
        pictures=draw(outcome, tasks),
    )


def report_tasks(outcome: Outcome) -> Tasks:
    """For the pictures and files of a run, side by side; `Here.shared` is the outcome."""
    for name in ("matplotlib.figure", "matplotlib.backends.backend_svg"):
        import_module(name)  # once for all copies
    return tasks_of_copies(outcome)


def draw(outcome: Outcome, tasks: Tasks | None = None) -> dict[str, object]:
    """What each of PICTURES gives."""
    with report_tasks(outcome) if tasks is None else nullcontext(tasks) as tasks:
        for name in PICTURES:
            tasks.add(name, _drawn, name)
        return {name: tasks.result(name) for name in PICTURES}


def _drawn(here: Here, name: str) -> object:
    with drawing(), uncollected():
        return PICTURES[name](here.shared)
