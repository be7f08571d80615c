"""From the files of an answer to its pressures and stresses, or to one line of what is wrong."""

import hashlib

from analytic.surface.readers.source import MAX_BYTES, ProfileError, contents
from comparisons.common.errors import InputError, one_line
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.scenes.studies.answers import AnswerSection
from comparisons.studies.answers.answer import Answer
from comparisons.studies.answers.readers.curves import read_curve

TABLES = (".csv", ".txt", ".dat", ".tsv", ".asc")
LONGEST = 200  # characters of what a library says


def read_answers(problem: Problem, window: Window | None) -> dict[str, tuple[Answer, ...]]:
    """The scene's answers by name, each on its resolutions, coarse to fine.
    Raises InputError for a file that cannot be read, or is none of the scene's kind."""
    named = problem.scene.answers or {}
    return {name: _read(name, source, problem, window) for name, source in named.items()}


def _read(
    name: str, source: AnswerSection, problem: Problem, window: Window | None
) -> tuple[Answer, ...]:
    found = []
    for file in source.file:
        path = problem.scene.folder / file
        try:
            sha256 = hashlib.sha256(contents(path, MAX_BYTES)).hexdigest()
            if path.suffix.lower() in TABLES:
                x, pressure = read_curve(path, source)
                stress = None
            else:
                from comparisons.studies.answers.readers.fields import read_fields

                x, pressure, stress = read_fields(path, source, problem, window)
        except ProfileError as error:
            said = str(error).replace("a profile is a text file", "allowed is a file")
            raise InputError(f"answers.{name}.file: {said}") from None
        except ValueError as error:
            said = one_line(str(error))[:LONGEST]
            raise InputError(f"answers.{name}.file: {path}: {said}") from None
        of_mesh = path.suffix.lower() not in TABLES and source.pressure is None
        found.append(Answer(path.name, sha256, x, pressure, stress, of_mesh))
    return tuple(sorted(found, key=lambda answer: -answer.spacing))
