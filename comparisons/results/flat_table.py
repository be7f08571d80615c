"""Many runs as one tidy table: a row for each run, friction coefficient and quantity.

Columns
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

What is unknown is empty in a CSV and null in a Parquet file."""

import csv
import io
from collections.abc import Iterable, Mapping
from importlib import import_module
from pathlib import Path

from comparisons.common.errors import InputError, one_line
from comparisons.common.files import whole_file, write_whole
from comparisons.figures.quantity import QUANTITIES
from comparisons.results.recorded_run import check_schema, read_table
from comparisons.results.result_json import SCHEMA
from comparisons.studies.heat.figures import UNITS
from comparisons.studies.model_error.catalogue import EFFECTS

FILE = "result.json"
GROUPS = (
    *("a_over_thickness", "a_over_radius", "a_over_width", "rms_slope", "max_slope"),
    *("friction_dundurs", "peak_pressure_over_hardness"),
)
EFFECT_COLUMNS = {name: f"effect_{name}" for name in EFFECTS if name != "law_of_elasticity"}
FORMULA = ("=", "+", "-", "@")  # a cell that begins so is computed by spreadsheets
TEXTS = ("run", "scene", "title", "quantity", "unit", "verdict", "validity", "model_error_verdict")
TEXTS += ("answer",)
COLUMNS = (
    *("run", "scene", "title", "friction", "quantity", "unit", "half_plane", "finite_element"),
    *("difference", "uncertainty", "tolerance", "verdict", "validity"),
    *("model_error", "model_error_uncertainty", "model_error_verdict"),
    *EFFECT_COLUMNS.values(),
    *("interaction", "jump", "answer", "answer_figure"),
    *GROUPS,
)

Row = dict[str, str | float | None]


def tidy_rows(folders: Iterable[Path]) -> list[Row]:
    """The rows of every run in or below the folders, each with all COLUMNS.
    Raises InputError, one line, for a folder without runs and for a result that cannot be read."""
    return [row for path in _results(folders) for row in _rows_in(path)]


def as_csv(rows: Iterable[Row]) -> str:
    """The table as comma-separated values, with a header.
    Neither a terminal nor a spreadsheet obeys a text of it: control characters are written as
    escapes, and an apostrophe stands before what would be a formula."""
    return csv_text([COLUMNS, *([harmless(row[name]) for name in COLUMNS] for row in rows)])


def csv_text(rows: Iterable[Iterable[object]]) -> str:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()


def harmless(value: object) -> object:
    """A cell that neither a terminal nor a spreadsheet obeys."""
    if not isinstance(value, str):
        return value
    text = one_line(value)
    return f"'{text}" if text.startswith(FORMULA) else text


def check_ending(path: Path) -> None:
    """Raise InputError, one line, unless a table can be written to a file of this name."""
    if path.suffix not in (".csv", ".parquet"):
        raise InputError(f"{path}: ends with {path.suffix or 'nothing'}; allowed is .csv, .parquet")
    if path.is_dir():
        raise InputError(f"{path}: is a folder; allowed is a file")
    if not path.parent.is_dir():
        raise InputError(f"{path}: {path.parent} is no folder; allowed is one that is there")
    if path.suffix == ".parquet":
        try:
            import_module("pyarrow")
            import_module("pyarrow.parquet")
        except ImportError as error:
            why = f"Parquet takes pyarrow, which is not installed ({error})"
            remedy = "allowed is .csv, or python -m pip install pyarrow"
            raise InputError(f"{path}: {why}; {remedy}") from error


def write_table(path: Path, rows: list[Row]) -> None:
    """Write the table as CSV or Parquet, whichever the file's ending says; whole or not at all."""
    check_ending(path)
    if path.suffix == ".csv":
        write_whole(path, as_csv(rows))
        return
    import pyarrow as pa
    from pyarrow import parquet

    schema = pa.schema([(n, pa.string() if n in TEXTS else pa.float64()) for n in COLUMNS])
    with whole_file(path) as part:
        parquet.write_table(pa.Table.from_pylist(rows, schema=schema), part)


def _results(folders: Iterable[Path]) -> list[Path]:
    """Every result in or below the folders, once, in the order of their paths."""
    found: dict[Path, Path] = {}
    for folder in folders:
        if not folder.is_dir():
            raise InputError(f"{folder}: is no folder; allowed is one that runs have left")
        every = sorted(folder.rglob(FILE))  # what is hidden is being written
        below = [p for p in every if "/." not in f"/{p.relative_to(folder).as_posix()}"]
        if not below:
            raise InputError(f"{folder}: holds no run; allowed is a folder with {FILE} below it")
        for path in below:
            found.setdefault(path.resolve(), path)
    return list(found.values())


def rows_of(result: Mapping, run: str) -> list[Row]:
    """The rows of one run's result, each with all COLUMNS."""
    common = {
        "run": run,
        "scene": result["scene"]["name"],
        "title": result["scene"]["title"],
        "validity": result["validity"]["verdict"],
        **result["groups"],
    }
    rows = _compared(result) if result.get("comparison") else _of_one_model(result)
    every = [*rows, *_of_heat(result.get("heat")), *_of_answers(result)]
    return [{name: (common | row).get(name) for name in COLUMNS} for row in every]


def _rows_in(path: Path) -> list[Row]:
    result = read_table(path)
    try:
        check_schema(path, result, SCHEMA)
        rows = rows_of(result, one_line(str(path.parent)))
    except (KeyError, TypeError, AttributeError, IndexError) as error:
        raise InputError(f"{path}: is no result of a run ({error!r}); allowed is one") from error
    for row in rows:
        for name in COLUMNS:
            kinds = str if name in TEXTS else int | float
            if row[name] is not None and not isinstance(row[name], kinds):
                given = f"{row['quantity']}: {name}: is {row[name]!r}"
                raise InputError(f"{path}: {given}; allowed is what a run wrote")
    return rows


def _compared(result: Mapping) -> Iterable[Row]:
    for quantity, rows in result["comparison"].items():
        errors = {row["friction"]: row for row in result["model_error"][quantity]}
        for row in rows:
            error = errors[row["friction"]]
            # an effect that raises the finite elements' figure makes the half-plane's too low
            sign = 1.0 if QUANTITIES[quantity].of_pair else -1.0
            yield {
                **row,
                "quantity": quantity,
                "unit": QUANTITIES[quantity].unit,
                "model_error": error["value"],
                "model_error_uncertainty": error["uncertainty"],
                "model_error_verdict": error["verdict"],
                **{EFFECT_COLUMNS[n]: sign * e["value"] for n, e in error["effects"].items()},
                "interaction": sign * error["interaction"],
                "jump": error["jump"],
            }


def _of_heat(heat: Mapping | None) -> Iterable[Row]:
    """Temperatures, the part of the heat that enters the body, stresses, by both models."""
    for name, row in heat["figures"].items() if heat else ():
        alone = max(row["own"].values()) if row["uncertainty"] is None else row["uncertainty"]
        own = {"friction": heat["friction"], "unit": UNITS.get(name, "K"), "uncertainty": alone}
        yield {**row, **row["values"], **own}


def _of_answers(result: Mapping) -> Iterable[Row]:
    for name, answer in result.get("answers", {}).items():
        for quantity, rows in answer["comparison"].items():
            for row in rows:
                own = {"answer": name, "answer_figure": row["answer"], "quantity": quantity}
                unit = QUANTITIES[quantity].unit
                yield row | own | {"unit": unit, answer["reference"]: row["reference"]}


def _of_one_model(result: Mapping) -> Iterable[Row]:
    """A run of a single model: its figures, and their own uncertainty."""
    for model, entries in result["models"].items():
        for entry in entries:
            for quantity, figure in QUANTITIES.items():
                value = None if figure.of_pair else _figure(entry, quantity)
                if value is None:
                    continue
                yield {
                    "friction": entry["friction"],
                    "quantity": quantity,
                    "unit": figure.unit,
                    model: value,
                    "uncertainty": entry["uncertainty"].get(quantity, {}).get("total"),
                }


def _figure(entry: Mapping, quantity: str) -> float | None:
    stress = entry["stress"] or {}
    if quantity == "tau1_max_depth":
        return stress["tau1_max_at"][1] if stress else None
    return entry["contact"].get(quantity, stress.get(quantity))
