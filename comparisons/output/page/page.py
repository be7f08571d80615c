"""The report: one page that opens without a network and prints without loss."""

from collections.abc import Callable
from contextlib import nullcontext
from importlib import import_module

from comparisons.common.processes import uncollected
from comparisons.common.tasks import Here, Tasks, tasks_of_copies
from comparisons.drawing.style import drawing
from comparisons.figures.quantity import HYPHENATED
from comparisons.models.forecast import forecast
from comparisons.output.headline import headline
from comparisons.output.page.field_values import field_explorer
from comparisons.output.page.html import inline, rendered
from comparisons.output.page.pictures.answers import answer_pictures
from comparisons.output.page.pictures.convergence import convergence_picture
from comparisons.output.page.pictures.cost import cost_picture
from comparisons.output.page.pictures.fields import field_pictures, near_surface_pictures
from comparisons.output.page.pictures.heat import heat_pictures
from comparisons.output.page.pictures.mesh import mesh_pictures
from comparisons.output.page.pictures.model_error import model_error_picture
from comparisons.output.page.pictures.pressures import close_up_picture, pressure_picture
from comparisons.output.page.pictures.problem import problem_picture
from comparisons.output.page.pictures.running_in import running_in_picture
from comparisons.output.page.pictures.sections import section_pictures
from comparisons.output.page.pictures.statistics import statistics_pictures
from comparisons.output.page.pictures.surfaces import surface_picture
from comparisons.output.page.tables.answers import (
    answer_facts,
    answer_table,
    compared_answers,
    measured_table,
)
from comparisons.output.page.tables.comparison import comparison_rows, coupling_table, figure_table
from comparisons.output.page.tables.convergence import WORDS, judged_table, validation_table
from comparisons.output.page.tables.heat import heat_facts, heat_table
from comparisons.output.page.tables.model_error import effects_table, model_error_rows
from comparisons.output.page.tables.problem import problem_sheet
from comparisons.output.page.tables.scatter import scatter_table
from comparisons.output.page.tables.statistics import statistics_tables
from comparisons.output.page.tables.text import is_shown
from comparisons.output.page.tables.verification import (
    check_table,
    commands,
    convergence_tables,
    cost_table,
    operator_note,
    operator_table,
    record_rows,
    refinement_text,
)
from comparisons.output.page.tables.yielding import flow_table
from comparisons.studies import STUDIES
from comparisons.studies.study import Run

# Each gives one picture, a list, or None where it does not apply; about the longest first.
PICTURES: dict[str, Callable[[Run], object]] = {
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
    "cost": cost_picture,
    "answers": answer_pictures,
    "statistics": statistics_pictures,
    "heat": heat_pictures,
} | {name: draw for study in STUDIES for name, draw in study.pictures.items()}


def render(outcome: Run, tasks: Tasks | None = None) -> str:
    """The page of a finished run, drawn by `report_tasks`; equal runs give equal text."""
    script, policy = inline("field_values.js")
    return rendered(
        "page.html.j2",
        script=script,
        policy=policy,
        explorer=field_explorer(outcome),
        outcome=outcome,
        forecast=forecast(outcome.problem, outcome.plan).text,
        samples=outcome.data("scatter"),
        heat_stresses=bool(outcome.data("heat") and outcome.data("heat").stresses),
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
        heat_facts=heat_facts(outcome),
        model_errors=[r for r in model_error_rows(outcome) if is_shown(outcome, r.quantity)],
        effects=effects_table(outcome),
        flow=flow_table(outcome),
        blocks=[block for s in STUDIES if s.name in outcome.found for block in s.blocks(outcome)],
        answers=[
            (each.name, answer_table(outcome, each), answer_facts(each), measured_table(each))
            for each in compared_answers(outcome)
        ],
        checks=check_table(outcome),
        operator=operator_table(outcome),
        operator_note=operator_note(outcome),
        cost=cost_table(outcome),
        record=record_rows(outcome),
        commands=commands(outcome),
        pictures=draw(outcome, tasks),
    )


def report_tasks(outcome: Run) -> Tasks:
    """For the pictures and files of a run, side by side; `Here.shared` is the run."""
    for name in ("matplotlib.figure", "matplotlib.backends.backend_svg"):
        import_module(name)  # once for all copies
    return tasks_of_copies(outcome)


def draw(outcome: Run, tasks: Tasks | None = None) -> dict[str, object]:
    """What each of PICTURES gives."""
    with report_tasks(outcome) if tasks is None else nullcontext(tasks) as tasks:
        for name in PICTURES:
            tasks.add(name, _drawn, name)
        return {name: tasks.result(name) for name in PICTURES}


def _drawn(here: Here, name: str) -> object:
    with drawing(), uncollected():
        return PICTURES[name](here.shared)
