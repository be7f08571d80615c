"""Pressures and stresses from the files of an answer, or one line of what is wrong."""

import hashlib
from pathlib import Path

import numpy as np

from analytic.surface.readers.source import MAX_BYTES, ProfileError, contents
from analytic.surface.readers.text import read_table
from comparisons.common.errors import InputError, one_line
from comparisons.models.problem import Problem
from comparisons.scenes.studies.answers import AnswerSection
from comparisons.studies.answers.answer import Answer
from comparisons.studies.answers.fields import checked, read_fields

TABLES = (".csv", ".txt", ".dat", ".tsv", ".asc")
LONGEST = 200  # characters of what a library says


def read_answers(problem: Problem) -> dict[str, tuple[Answer, ...]]:
    """The scene's answers by name, each on its resolutions, coarse to fine.
    Raises InputError for a file that cannot be read, or is none of the scene's kind."""
    named = problem.scene.answers or {}
    return {name: _read(name, source, problem) for name, source in named.items()}


def _read(name: str, source: AnswerSection, problem: Problem) -> tuple[Answer, ...]:
    answers = []
    for file in source.file:
        path, known = problem.scene.folder / file, {}
        is_table = path.suffix.lower() in TABLES
        try:
            sha256 = hashlib.sha256(contents(path, MAX_BYTES)).hexdigest()
            if is_table:
                curves, known["columns"] = _read_curve(path, source)
            else:
                curves, known = read_fields(path, source, problem)
        except ProfileError as error:
            said = str(error).replace("a profile is a text file", "allowed is a file")
            raise InputError(f"answers.{name}.file: {said}") from None
        except ValueError as error:
            said = one_line(str(error))[:LONGEST]
            raise InputError(f"answers.{name}.file: {path}: {said}") from None
        known["of_mesh"] = not is_table and source.pressure is None
        x, pressure, *shear = curves
        known["shear"] = shear[0] if shear else None
        answers.append(Answer(path.name, sha256, x, pressure, **known))
    return tuple(sorted(answers, key=lambda answer: -answer.spacing))


def _read_curve(path: Path, source: AnswerSection) -> tuple[tuple[np.ndarray, ...], str]:
    """x (n,) [m], ascending, pressure (n,) [Pa] and, where the source has it, traction in a table;
    the names of these columns."""
    columns = (*source.columns, *(source.shear or ()))
    table = read_table(path, MAX_BYTES, one_column=False, columns=columns)
    lost = np.flatnonzero(np.isnan(table.numbers).any(axis=1))
    if len(lost):
        raise table.error(int(lost[0]), "holds no number; allowed are x and pressure")
    x, pressure, *shear = table.numbers.T
    if not _one_way(x) and _one_way(pressure):
        one, other = source.columns
        raise ValueError(
            "its first column goes to and fro and its second one way: are they swapped? allowed "
            f"is x before pressure, columns = {[other, one]}"
        )
    names = table.names or ("",) * table.numbers.shape[1]
    tractions = (
        values * source.unit("stress", name)
        for values, name in zip((pressure, *shear), names[1:], strict=True)
    )
    x = x * source.unit("length", names[0]) - source.x_origin
    return checked(x, *tractions), ", ".join(table.names)


def _one_way(values: np.ndarray) -> bool:
    steps = np.diff(values)
    return bool(np.all(steps > 0.0) or np.all(steps < 0.0))
