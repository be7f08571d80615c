"""A study on the page and in the terminal, by default.

In: a study and a finished run. Out: its pictures, a table of its figures, facts and a note; a line.
What else a study shows, its own `blocks` and `lines` say."""

from collections.abc import Mapping

from comparisons.drawing.blocks import Block, Heading, Names, Note, Pictures
from comparisons.drawing.tables import facts_of, figure_table, in_context, in_words, line_of
from comparisons.figures.figure import Figure
from comparisons.figures.quantity import LABELS, Quantity
from comparisons.judging.study import CONVERGED, WHY_NOT, Run, Study


def parts_of(study: Study, run: Run) -> list[Block]:
    """Parts of a study's page: pictures; a table of what models say and of what is compared with
    them; as names and values what it states and what others say; how to read that."""
    if study.blocks is not None or not study.title:
        return study.blocks(run) if study.blocks else []
    quantities, (by_models, others) = _shown(study), _figures(study, run)
    names = None if study.shown is None else {*study.shown, WHY_NOT}
    said = [
        words
        for words in run.findings[study.name].statements
        if (words.name, words.text) != (CONVERGED, "yes") and (names is None or words.name in names)
    ]
    facts = in_words(said) + study.facts(run) + facts_of(others, quantities, study.sources)
    note = study.note(run) if callable(study.note) else study.note
    below = in_context(run.problem.hertz, quantities)
    table = figure_table(by_models, quantities, study.caption(run), below)
    items = (
        *[Heading(study.title)] * bool(study.section),
        Pictures(tuple(study.pictures), abreast=True),
        *[table] * bool(by_models),
        *[Names(facts)] * bool(facts),
        *[Note(note)] * bool(note),
    )
    return [Block(study.section or study.name.replace("_", "-"), items, study.title)]


def lines_of(study: Study, run: Run) -> list[tuple[str, str]]:
    """Lines of the terminal: what the study judges, or its first figure, or why there is none."""
    if study.lines is not None or not study.title:
        return study.lines(run) if study.lines else []
    by_models, others = _figures(study, run)
    text = line_of(by_models or others, _shown(study))
    if not text and (why := run.findings[study.name].said(WHY_NOT)) is not None:
        text = f"{WHY_NOT}: {why}"
    return [(study.name.replace("_", " "), text + study.advice(run))] if text else []


def _figures(study: Study, run: Run) -> tuple[list[Figure], list[Figure]]:
    """Figures of models and of what is compared with one; and those of other sources."""
    known = [f for f in run.findings[study.name].figures if f.quantity in _shown(study)]
    compared = {name for f in known if f.against for name in (f.source, f.against)}
    models = {*LABELS, *compared}
    return tuple([f for f in known if (f.source in models) == wanted] for wanted in (True, False))


def _shown(study: Study) -> Mapping[str, Quantity]:
    """Quantities in the order in which they are shown."""
    names = study.quantities if study.shown is None else study.shown
    return {name: study.quantities[name] for name in names if name in study.quantities}
