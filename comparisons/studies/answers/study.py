"""Answers from outside beside the models.

In: the scene's answers, read from their files or before, and the solved models. Out: each one's
figures and judged differences from the last model, and what else is to be said of it."""

from collections.abc import Mapping
from dataclasses import dataclass

from comparisons.common.tasks import Tasks
from comparisons.figures.figure import Figures, Findings
from comparisons.studies.answers import show
from comparisons.studies.answers.answer import NAME, QUANTITIES, Answer, ComparedAnswer
from comparisons.studies.answers.compare import compare_answers
from comparisons.studies.study import SCATTER, Solved, Study


@dataclass(frozen=True)
class ComparedAnswers:
    """All of a scene."""

    answers: tuple[ComparedAnswer, ...]


def begin(solved: Solved, tasks: Tasks) -> None:
    """Raises InputError for a file that cannot be read, before anything is solved."""
    _read(solved, tasks)


def _read(solved: Solved, tasks: Tasks) -> Mapping[str, tuple[Answer, ...]]:
    if solved.answers is not None:
        return solved.answers
    from comparisons.studies.answers.readers.files import read_answers

    return tasks.held(NAME, NAME, lambda: read_answers(solved.problem, solved.window))


def solve(solved: Solved, before: Mapping[str, Findings], tasks: Tasks) -> Findings:
    scattered = Figures(before[SCATTER].figures if SCATTER in before else ())
    answers = compare_answers(solved, _read(solved, tasks), scattered)
    found = [each.findings() for each in answers]
    return Findings(
        tuple(figure for each in found for figure in each.figures),
        tuple(series for each in found for series in each.series),
        data=ComparedAnswers(answers),
    )


STUDY = Study(
    name=NAME,
    quantities=QUANTITIES,
    solve=solve,
    applies=lambda solved: bool(solved.problem.scene.answers),
    begin=begin,
    data=ComparedAnswers,
    blocks=show.blocks,
    pictures={"answers": show.answer_pictures},
)
