"""The report: one page that opens without a network and prints without loss.

A loop over blocks: those that every run has, and those by which each study shows what it finds."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from itertools import groupby

from comparisons.common.numbers import plain
from comparisons.common.processes import uncollected
from comparisons.common.tasks import Here, tasks_of_copies
from comparisons.drawing.blocks import (
    Block,
    Box,
    Bullets,
    Heading,
    Names,
    Note,
    Pictures,
    attempted,
)
from comparisons.drawing.style import drawing
from comparisons.figures.figure import grouped
from comparisons.figures.quantity import HYPHENATED
from comparisons.judging.presentation import parts_of
from comparisons.judging.study import Run
from comparisons.judging.verdict.headline import headline
from comparisons.output.page import IMPORTS
from comparisons.output.page.html import STYLES, rendered
from comparisons.output.page.pictures import answer, contact, problem, refinement, stresses
from comparisons.output.page.pictures.mesh import mesh_pictures
from comparisons.output.page.tables import verification
from comparisons.output.page.tables.comparison import comparison_table, first_model
from comparisons.output.page.tables.problem import facts, problem_items
from comparisons.studies import STUDIES
from comparisons.studies import problem as asked

# Each gives one picture, a list, or None where it does not apply; about the longest first.
PICTURES: dict[str, Callable[[Run], object]] = {
    "fields": stresses.field_pictures,
    "sections": stresses.section_pictures,
    "mesh": mesh_pictures,
    "overview": answer.overview_picture,
    "near": stresses.near_surface_pictures,
    "plastic_strain": stresses.plastic_strain_pictures,
    **{name: draw for study in STUDIES for name, draw in study.pictures.items()},
    "pressure": contact.pressure_picture,
    "close_up": contact.close_up_picture,
    "convergence": refinement.convergence_picture,
    "problem": problem.problem_picture,
    "surface": contact.surface_picture,
    "judged": answer.judged_picture,
}
# Sections with a fixed order, by id; those of other studies follow the stresses. Those from the
# problem on are for reviewers: folded away on a screen, and printed.
ORDER = ("model-error", "comparison", "answers", "contact", "stresses", "", "yield")
FOLDED = ("problem", "convergence", "mesh", "cost", "checks", "skipped", "record")
NOTES = verification.WORDING["how_to_read"]


def render(run: Run) -> str:
    """The page of a finished run; equal runs give equal text."""
    pictures = draw(run)
    shown = [_shown(block, run, pictures) for block in sections(run)]
    [first, *others] = (HYPHENATED[name] for name in run.runs)
    return rendered(
        "page.html.j2",
        policy=STYLES,
        title=run.problem.scene.title,
        headline=headline(run),
        models="half-plane against finite elements" if others else f"{first} model only",
        answer=_shown(_answer(run), run, pictures),
        sections=[block for block in shown if block.items],
        folded=FOLDED,
    )


def _shown(block: Block, run: Run, pictures: Mapping[str, object]) -> Block:
    return replace(block, items=tuple(_filled(block.items, run, pictures)))


def _filled(items: Iterable, run: Run, pictures: Mapping[str, object]) -> Iterator[object]:
    """The items with pictures for their names, and with what functions among them give,
    without boxes that stay empty."""
    for item in items:
        if isinstance(item, Pictures):
            drawn = [one for name in item.names for one in _listed(pictures[name], item.part)]
            yield from [Heading(item.heading)] * bool(drawn and item.heading)
            yield from _abreast(drawn) if item.abreast else drawn
        elif isinstance(item, Box):
            inside = tuple(_filled(item.items, run, pictures))
            yield from [replace(item, items=inside)] * bool(inside)
        elif callable(item):
            name = getattr(item, "func", item).__name__.strip("_")
            made = _listed(attempted(name, partial(item, run)))
            yield from _filled(made, run, pictures)
        else:
            yield item


def _abreast(drawn: list) -> Iterator[object]:
    """Side by side what is narrow."""
    for is_narrow, some in groupby(drawn, lambda one: not getattr(one, "wide", True)):
        items = tuple(some)
        yield from [Box("columns", items)] if is_narrow else items


def _listed(made: object, part: slice | None = None) -> list:
    """Result of a function as a list; of several a part."""
    if isinstance(made, list):
        return made if part is None else made[part]
    return [] if made is None else [made]


def drawn_of(run: Run) -> list[str]:
    """Names of PICTURES without those of studies that the run has not."""
    missing = {n for study in STUDIES if study.name not in run.findings for n in study.pictures}
    return [name for name in PICTURES if name not in missing]


def draw(run: Run) -> dict[str, object]:
    """Results of PICTURES, drawn side by side."""
    names = drawn_of(run)
    for step in IMPORTS:  # once for all copies
        step()
    with drawing(), tasks_of_copies(run) as tasks:
        for name in names:
            tasks.add(name, _drawn, name)
        return {name: attempted(name, partial(tasks.result, name)) for name in names}


def _drawn(here: Here, name: str) -> object:
    with uncollected():
        return PICTURES[name](here.shared)


def sections(run: Run) -> list[Block]:
    """One block a section, which the studies' blocks are parts of."""
    blocks = [*_before(run), *_stresses(run), *_after(run)]
    for study in STUDIES:
        if study.name in run.findings:
            made = attempted(study.name, partial(parts_of, study, run))
            if not isinstance(made, list):
                made = [Block(study.name, (made, Pictures(tuple(study.pictures))), study.name)]
            blocks += made
    order = (*ORDER, *FOLDED)
    blocks.sort(key=lambda block: order.index(block.section if block.section in order else ""))
    return [
        Block(same[0].section, tuple(item for block in same for item in block.items), same[0].title)
        for same in grouped(blocks, lambda block: block.section)
    ]


def _answer(run: Run) -> Block:
    """Beside the verdict: what is judged, the run in one picture, and on paper what is signed."""
    beside = Box("beside", (Pictures(("judged",)), facts))
    signed = Box("signed", (verification.signed,))
    return Block("answer", (beside, Pictures(("overview",)), signed))


def _before(run: Run) -> Iterator[Block]:
    said = run.findings[asked.NAME].statements
    assumed = tuple(words.text for words in said if words.name == asked.ASSUMED)
    picture = Pictures(("problem",)), Heading("Assumptions"), Bullets(assumed)
    columns = Box("columns", (Box("sheet", picture), Box("sheet", (problem_items,))))
    yield Block("problem", (columns,), "Problem")
    if run.plan.compares:
        said, coating = NOTES["comparison"], run.problem.scene.coating
        if first_model(run) != "half-plane":
            said += NOTES["layered"].format("coating" if coating else "finite thickness")
        yield Block("comparison", (comparison_table, Note(said)), "Comparison")
    else:
        yield Block("comparison", (comparison_table,), "Figures")
    beside = Pictures(("close_up", "surface"), abreast=True)
    yield Block("contact", (Pictures(("pressure",)), beside), "Contact")


def _stresses(run: Run) -> Iterator[Block]:
    if run.window is None:
        return
    frictions = run.frictions
    deciding = frictions.index(run.deciding_friction)

    def of_friction(place: int, *names: str) -> Pictures:
        part = slice(place, None, len(frictions))
        return Pictures(names, f"Friction {plain(frictions[place])}", True, part)

    others = [k for k in range(len(frictions)) if k != deciding]
    note = NOTES["fields"] + NOTES["printed"].format(frictions[deciding]) * bool(others)
    near = replace(of_friction(deciding, "near"), heading="", abreast=False)
    down = Box("columns down", (near, Pictures(("sections",))))
    on_screens = Box("on-screens", tuple(of_friction(k, "fields", "near") for k in others))
    items = Note(note), of_friction(deciding, "fields"), down, on_screens
    yield Block("stresses", items, "Subsurface stresses")
    yield Block("yield", (Pictures(("plastic_strain",), abreast=True),), "Yield")


def _after(run: Run) -> Iterator[Block]:
    norms = "; those of a norm are on the norm's own scale" if run.plan.compares else ""
    far = NOTES["far_boundary"] if run.plan.domain_check else ""
    said = NOTES["levels"].format(far=far, norms=norms, refinement=run.solved.refinement)
    items = Pictures(("convergence",)), verification.levels_tables, Note(said), Heading("Words")
    yield Block("convergence", (*items, Names(verification.WORDS)), "Convergence")
    yield Block("mesh", (Box("thirds", (Pictures(("mesh",)),)),), "Mesh")
    skipped = tuple(run.plan.skipped.items())
    yield Block("skipped", (Names(skipped) if skipped else Note("None."),), "Skipped steps")
    yield Block("record", (_record,), "Record")


def _record(run: Run) -> Names:
    return Names(verification.record_rows(run), tuple(verification.commands(run)))
