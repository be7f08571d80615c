"""Many runs as one tidy table: wide, or a row a figure.

In: the result.json of runs. Out: CSV, or records.

Wide, a row for each run, friction coefficient and quantity:
  run, scene, title      folder, name, title
  friction, quantity     what the row is of
  unit                   of the next two, SI; empty for ratios
  half_plane, finite_element   the figure by each model, empty where it is of a pair
  difference, uncertainty, tolerance   relative, as result.json has them
  verdict                of the row; validity: of the run
  model_error, model_error_uncertainty   of the half-plane, relative
  model_error_verdict    holds, fails or inconclusive; empty without a tolerance
  effect_…               what of model_error is due to each assumption, relative, with the signs
                         of the report; empty where not computed
  interaction            what these change jointly beyond their sum, in the same way
  answer, answer_figure  name of an answer from outside, and its figure; its row has the model's
                         figure, and what the answer differs from that by
  a_over_radius, …       the run's dimensionless groups

Long, a row for each figure of every study: study, quantity, source, against and friction name it;
`value` in `unit`, or relative to the reference; `uncertainty` and `not_modelled` relative, `low`
and `high` the bounds of what is judged.

What is unknown is empty in a CSV."""

import math
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from comparisons.common.errors import InputError, one_line
from comparisons.common.files import csv_text, write_whole
from comparisons.figures.figure import Figure, Figures, grouped
from comparisons.figures.quantity import MODELS, QUANTITIES
from comparisons.output.record import read_result
from comparisons.output.result_json import Result
from comparisons.studies import STUDIES, comparison, contact, meaning
from comparisons.studies import problem as asked
from comparisons.studies.answers import study as answers
from comparisons.studies.model_error.account import INTERACTION, JUMP
from comparisons.studies.model_error.catalogue import EFFECTS, UNKNOWN
from comparisons.studies.model_error.laws import EFFECT as LAW_OF_ELASTICITY
from comparisons.studies.study import MODEL_ERROR

FILE = "result.json"
EFFECT_COLUMNS = {
    name: f"effect_{name}" for name in EFFECTS if name not in UNKNOWN or name == LAW_OF_ELASTICITY
}
FORMULA = ("=", "+", "-", "@")  # a cell that begins so is computed by spreadsheets
COLUMNS = (
    *("run", "scene", "title", "friction", "quantity", "unit", "half_plane", "finite_element"),
    *("difference", "uncertainty", "tolerance", "verdict", "validity"),
    *("model_error", "model_error_uncertainty", "model_error_verdict"),
    *EFFECT_COLUMNS.values(),
    *("interaction", "jump", "answer", "answer_figure"),
    *asked.GROUPS,
)

LONG_COLUMNS = (
    *("run", "scene", "title", "study", "quantity", "unit", "source", "against", "friction"),
    *("value", "uncertainty", "not_modelled", "low", "high", "verdict"),
)

Row = dict[str, str | float | None]


def tidy_rows(folders: Iterable[Path], long: bool = False) -> list[Row]:
    """The rows of every run in or below the folders, each with all COLUMNS; `long`: LONG_COLUMNS.
    Raises InputError, one line, for a folder without runs and for a result that cannot be read."""
    rows = long_rows if long else rows_of
    paths = _results(folders)
    return [row for path in paths for row in rows(read_result(path), one_line(str(path.parent)))]


def as_csv(rows: Iterable[Row], columns: Sequence[str] = COLUMNS) -> str:
    """The table as comma-separated values, with a header.
    Neither a terminal nor a spreadsheet obeys a text of it: control characters are written as
    escapes, and an apostrophe stands before what would be a formula."""
    return csv_text([columns, *([harmless(row[name]) for name in columns] for row in rows)])


def harmless(value: object) -> object:
    """A cell that neither a terminal nor a spreadsheet obeys."""
    if not isinstance(value, str):
        return value
    text = one_line(value)
    return f"'{text}" if text.startswith(FORMULA) else text


def check_ending(path: Path) -> None:
    """Raise InputError, one line, unless a table can be written to a file of this name."""
    if path.suffix != ".csv":
        raise InputError(f"{path}: ends with {path.suffix or 'nothing'}; allowed is .csv")
    if path.is_dir():
        raise InputError(f"{path}: is a folder; allowed is a file")
    if not path.parent.is_dir():
        raise InputError(f"{path}: {path.parent} is no folder; allowed is one that is there")


def write_table(path: Path, rows: list[Row], columns: Sequence[str] = COLUMNS) -> None:
    """Write the table as CSV; whole or not at all."""
    check_ending(path)
    write_whole(path, as_csv(rows, columns))


def _results(folders: Iterable[Path]) -> list[Path]:
    """Every result in or below the folders, once, in the order of their paths."""
    results: dict[Path, Path] = {}
    for folder in folders:
        if not folder.is_dir():
            raise InputError(f"{folder}: is no folder; allowed is one that runs have left")
        every = sorted(folder.rglob(FILE))  # what is hidden is being written
        below = [p for p in every if "/." not in f"/{p.relative_to(folder).as_posix()}"]
        if not below:
            raise InputError(f"{folder}: holds no run; allowed is a folder with {FILE} below it")
        for path in below:
            results.setdefault(path.resolve(), path)
    return list(results.values())


def rows_of(result: Result, run: str) -> list[Row]:
    """The wide rows of one run, each with all COLUMNS."""
    figures = result.figures
    groups = figures.of(study=asked.NAME, source=asked.SCENE)
    common = _run(result, run) | {"validity": result.verdict}
    common |= {figure.quantity: figure.value for figure in groups}
    compared = figures.of(study=comparison.NAME)
    rows = _compared(figures, compared) if compared else _of_one_model(figures)
    every = [*rows, *_of_studies(figures), *_of_answers(figures)]
    return [{name: (common | row).get(name) for name in COLUMNS} for row in every]


def long_rows(result: Result, run: str) -> list[Row]:
    """A row a figure, of every study, each with all LONG_COLUMNS."""
    common, rows = _run(result, run), []
    for figure in result.figures:
        low, high = figure.bounds or (None, None)
        row = common | _judged(figure) | {"low": low, "high": high}
        names = ("study", "source", "against", "value", "not_modelled")
        row |= {name: getattr(figure, name) for name in names}
        row |= {"unit": ""} if figure.against else {}
        rows.append({name: row[name] for name in LONG_COLUMNS})
    return rows


def _run(result: Result, run: str) -> Row:
    return {"run": run, "scene": result.scene["name"], "title": result.scene["title"]}


def _judged(figure: Figure) -> Row:
    """What every row says of its figure."""
    return {
        "quantity": figure.quantity,
        "unit": meaning(figure).unit,
        "friction": figure.friction,
        "uncertainty": _known(figure.numerical),
        "tolerance": figure.tolerance,
        "verdict": figure.verdict,
    }


def _known(size: float) -> float | None:
    return size if math.isfinite(size) else None


def _by_quantity(figures: Iterable[Figure]) -> list[Figure]:
    order = list(QUANTITIES)
    return sorted(figures, key=lambda figure: order.index(figure.quantity))


def _compared(figures: Figures, compared: Figures) -> Iterator[Row]:
    for difference in _by_quantity(compared):
        wanted = {"quantity": difference.quantity, "at": difference.at}
        error = figures.one(study=MODEL_ERROR, **wanted)
        models = figures.of(study=contact.NAME, **wanted)
        # an effect that raises the finite elements' figure makes the half-plane's too low
        sign = 1.0 if QUANTITIES[difference.quantity].of_pair else -1.0
        parts = {part.name: part.value for part in error.parts}
        yield {
            **_judged(difference),
            **{figure.source: figure.value for figure in models},
            "difference": difference.value,
            "model_error": error.value,
            "model_error_uncertainty": _known(error.numerical),
            "model_error_verdict": error.verdict,
            **{c: sign * parts[name] for name, c in EFFECT_COLUMNS.items() if name in parts},
            "interaction": sign * parts[INTERACTION],
            "jump": parts[JUMP],
        }


def _of_one_model(figures: Figures) -> Iterator[Row]:
    """A run of a single model: its figures, and their uncertainty."""
    known = figures.of(study=contact.NAME)
    for same in grouped(known, lambda figure: (figure.source, figure.friction)):
        for figure in _by_quantity(f for f in same if f.quantity in QUANTITIES):
            yield {**_judged(figure), figure.source: figure.value}


def _of_studies(figures: Figures) -> Iterator[Row]:
    """What studies have found by both models and put into the table."""
    tabled = {(study.name, name) for study in STUDIES for name in study.tabled}
    known = [f for f in figures if (f.study, f.quantity) in tabled and f.source in MODELS]
    for same in grouped(known, lambda figure: (figure.study, figure.quantity)):
        values = [figure for figure in same if figure.against is None]
        difference = next((figure for figure in same if figure.against), None)
        base = difference or max(values, key=lambda figure: figure.numerical)
        sizes = {figure.source: figure.value for figure in values}
        yield {**_judged(base), **sizes, "difference": difference and difference.value}


def _of_answers(figures: Figures) -> Iterator[Row]:
    known = figures.of(study=answers.NAME)
    differences = [figure for figure in known if figure.against]
    for same in grouped(differences, lambda figure: figure.source):
        for difference in _by_quantity(same):
            wanted = {"quantity": difference.quantity, "at": difference.at, "against": None}
            answer = known.one(source=difference.source, **wanted)
            model = answer and figures.one(study=contact.NAME, source=difference.against, **wanted)
            yield {
                **_judged(difference),
                "answer": difference.source,
                "answer_figure": answer and answer.value,
                "difference": difference.value,
                difference.against: model and model.value,
            }
