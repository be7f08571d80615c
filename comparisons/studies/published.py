"""Published figures of the same contact, beside both models.

In: a solved scene with sections [published.NAME]. Out: the difference of each model's figure over
the published one; that of the model that has what the publication has is judged. What is published
has a scatter s, ours an uncertainty U: they agree within s + U and differ beyond s + 3 U."""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from itertools import chain

import numpy as np

from comparisons.common.numbers import percent
from comparisons.common.tasks import Tasks
from comparisons.drawing.blocks import Block, Note, TextTable
from comparisons.figures.figure import Figure, Figures, Findings
from comparisons.figures.quantity import LABELS, MODELS, Quantity
from comparisons.figures.quantity import QUANTITIES as COMPARED
from comparisons.figures.uncertainty import Reading, iteration
from comparisons.judging import contact
from comparisons.judging.rule import judged_by
from comparisons.judging.study import Run, Solved, Study
from comparisons.models.level import Level, Solution
from comparisons.scenes.studies.published import DIMENSIONS, LOWERING, PublishedSection
from comparisons.studies.friction import partial_slip

NAME = "published"
LOWERED = Quantity("lowering of the surface under the roller", "m", formal_order=2.0)
KNOWN = COMPARED | partial_slip.QUANTITIES | {LOWERING: LOWERED}
QUANTITIES = {name: KNOWN[name] for name in DIMENSIONS}
HEAD = ("", "published", *map(LABELS.get, MODELS), "difference", "uncertainty", "verdict", "")
NOTE = """Difference: (ours − published) / published, of the model that has what the publication
has. Its uncertainty is ours; they agree within it and the scatter of what is published, and differ
beyond the scatter by three times it."""


def solve(solved: Solved, before: Mapping[str, Findings], tasks: Tasks) -> Findings:
    studies = [before[name] for name in (contact.NAME, partial_slip.NAME) if name in before]
    known = Figures(chain(*(study.figures for study in studies), _lowering(solved)))
    figures = []
    for name, section in solved.problem.scene.published.items():
        ours = known.of(quantity=section.quantity, against=None)
        ours = [ours.one(source=model) for model in solved.runs]
        last = section.judged_by or [figure.source for figure in ours if figure][-1:]
        figures += [_difference(name, section, f, f.source in last) for f in ours if f]
    return Findings(tuple(figures))


def _difference(name: str, section: PublishedSection, ours: Figure, judged: bool) -> Figure:
    size, stated = section.size, ours.uncertainty
    parts = {cause: part * ours.scale / size for cause, part in stated.parts.items()}
    stated = replace(stated, parts=parts)
    bound = section.spread + 2.0 * stated.total
    return replace(
        ours,
        study=NAME,
        value=(ours.value - size) / size,
        against=name,
        scale=size,
        uncertainty=stated,
        bounds=(-bound, bound) if judged and not section.doubtful else None,
        levels=tuple((value - size) / size for value in ours.levels),
        notes=("judged",) if judged else (),
    )


def _lowering(solved: Solved) -> Iterable[Figure]:
    """Lowering by finite elements of a body that has a base."""
    case, thickness = solved.cases[0], solved.problem.scene.body.thickness
    run = case.runs.get("finite_element")
    if run is None or thickness is None:
        return ()

    def read(level: Level) -> dict[str, float]:
        return {LOWERING: float(np.interp(0.0, level.grid.x, level.displacement))}

    def how(name: str, value: float) -> Reading:
        return Reading(LOWERED.formal_order, value, iteration=iteration(run.finest.solution))

    return judged_by(NAME, [Solution(run.name, run.levels)], read, how, case.at).values()


def table(sections: Mapping[str, PublishedSection], figures: Figures) -> list[tuple[str, ...]]:
    """Rows of HEAD."""
    rows = []
    for name, section in sections.items():
        known = figures.of(study=NAME, against=name)
        sizes = {f.source: f.scale * (1.0 + f.value) for f in known}
        texts = [section.as_published(sizes[model]) if model in sizes else "" for model in MODELS]
        [judged] = [f for f in known if "judged" in f.notes] or [None]
        shown, cells = section.value, ("", "", "not known")
        if judged is not None:
            off, verdict = judged.sized().split(" ± "), judged.verdict
            shown += f" ± {percent(section.spread)}" if section.scatter else ""
            if section.doubtful:
                near = abs(judged.value) <= section.spread + judged.numerical
                verdict = f"{'agree' if near else 'differ'}, doubtful"
            cells = f"{off[0]} %", off[1], verdict
        rows.append((name, shown, *texts, *cells, section.note or ""))
    return rows


def blocks(run: Run) -> list[Block]:
    sections = run.problem.scene.published
    rows = table(sections, run.figures)
    sources = "; ".join(
        f"{name}: {section.source}{'' if section.read else ' (not read itself)'}"
        for name, section in sections.items()
    )
    shown = TextTable("", HEAD, tuple(rows), "comparison prose", words=True)
    return [
        Block("answers", (shown, Note(NOTE), Note(f"Sources. {sources}.")), "Published figures")
    ]


def lines(run: Run) -> list[tuple[str, str]]:
    """A line for each published figure that is judged."""
    known, said = run.figures.of(study=NAME), run.problem.scene.published
    return [
        ("published", f"{f.against} {said[f.against].value}: {f.words()}")
        for f in known
        if f.bounds is not None
    ]


STUDY = Study(
    NAME,
    QUANTITIES,
    solve,
    applies=lambda solved: bool(solved.problem.scene.published),
    blocks=blocks,
    lines=lines,
)
