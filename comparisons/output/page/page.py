"""The report: one page that opens without a network and prints without loss."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import nullcontext
from dataclasses import replace
from importlib import import_module

from comparisons.common.processes import uncollected
from comparisons.common.tasks import Here, Tasks, tasks_of_copies
from comparisons.drawing.blocks import Box, Heading, Pictures
from comparisons.drawing.style import Picture, drawing
from comparisons.figures.quantity import HYPHENATED
from comparisons.output.headline import headline
from comparisons.output.page.blocks import sections
from comparisons.output.page.field_values import field_explorer
from comparisons.output.page.html import inline, rendered
from comparisons.output.page.pictures.contact import (
    close_up_picture,
    pressure_picture,
    surface_picture,
)
from comparisons.output.page.pictures.mesh import mesh_pictures
from comparisons.output.page.pictures.problem import problem_picture
from comparisons.output.page.pictures.refinement import convergence_picture, cost_picture
from comparisons.output.page.pictures.stresses import (
    field_pictures,
    near_surface_pictures,
    section_pictures,
)
from comparisons.studies import STUDIES
from comparisons.studies.study import Run

# Each gives one picture, a list, or None where it does not apply; about the longest first.
PICTURES: dict[str, Callable[[Run], object]] = {
    "fields": field_pictures,
    "near": near_surface_pictures,
    "mesh": mesh_pictures,
    "pressure": pressure_picture,
    "sections": section_pictures,
    "convergence": convergence_picture,
    "close_up": close_up_picture,
    "problem": problem_picture,
    "surface": surface_picture,
    "cost": cost_picture,
} | {name: draw for study in STUDIES for name, draw in study.pictures.items()}


def render(outcome: Run, tasks: Tasks | None = None) -> str:
    """The page of a finished run, drawn by `report_tasks`; equal runs give equal text."""
    script, policy = inline("field_values.js")
    explorer, pictures = field_explorer(outcome), draw(outcome, tasks)
    blocks = sections(outcome, explorer)
    shown = [replace(block, items=tuple(_filled(block.items, pictures))) for block in blocks]
    [first, *others] = (HYPHENATED[name] for name in outcome.runs)
    return rendered(
        "page.html.j2",
        script=script,
        policy=policy,
        explorer=explorer,
        title=outcome.problem.scene.title,
        headline=headline(outcome),
        models="half-plane against finite elements" if others else f"{first} model only",
        sections=[block for block in shown if block.items],
    )


def _filled(items: Iterable, pictures: Mapping[str, object]) -> Iterator[object]:
    """The items with pictures in the place of their names, without boxes that stay empty."""
    for item in items:
        if isinstance(item, Pictures):
            drawn = [each for name in item.names for each in _listed(pictures[name])]
            drawn = drawn if item.part is None else drawn[item.part]
            yield from [Heading(item.heading)] * bool(drawn and item.heading)
            yield from [Box("columns", tuple(drawn))] if drawn and item.abreast else drawn
        elif isinstance(item, Box):
            inside = tuple(_filled(item.items, pictures))
            yield from [replace(item, items=inside)] * bool(inside)
        else:
            yield item


def _listed(drawn: object) -> list[Picture]:
    """What a function of PICTURES gave, as a list."""
    return drawn if isinstance(drawn, list) else [] if drawn is None else [drawn]


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
