"""result.json, schema 3: every figure with its meaning, series and statements, the verdict.

In: a finished run. Out: the content of its result.json; and back, what such a content says.

    figures[]     study, quantity, source, at, value, unit; against, scale, uncertainty, bounds,
                  verdict, parts, not_modelled, spread, place, levels, notes where there are any
    series[]      study, name, source, at; columns: values by name, units, uncertainty
    statements[]  study, name, source, at, text

Units are SI. What is unknown is null; what is empty is left out."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from functools import cached_property
from math import inf

from comparisons.common.numbers import finite
from comparisons.figures.convergence import Convergence
from comparisons.figures.figure import (
    Column,
    Figure,
    Figures,
    Findings,
    Part,
    SampleSpread,
    Series,
    Statement,
)
from comparisons.figures.uncertainty import COVERAGE, Uncertainty
from comparisons.output.headline import headline, verdict_of
from comparisons.studies import meaning
from comparisons.studies.study import Run

SCHEMA = 3
RECORDED = ("made", "versions", "machine", "seed", "hashes")  # of record.json


@dataclass(frozen=True)
class Result:
    """What result.json says."""

    scene: dict  # as resolved, SI units
    record: dict
    verdict: str  # holds | fails | inconclusive | not compared | not converged
    why: str
    next: tuple[str, ...]  # what would decide or improve it, as text to paste
    found: Mapping[str, Findings]  # by study

    @cached_property
    def figures(self) -> Figures:
        return Figures(figure for found in self.found.values() for figure in found.figures)


def result_of(run: Run) -> Result:
    verdict, why = verdict_of(run)
    record = {name: run.record[name] for name in RECORDED}
    scene = run.problem.surface.as_dict(run.problem.scene)
    return Result(scene, record, verdict, why, headline(run).paste, run.found)


def content_of(run: Run) -> dict:
    """The content of a run's result.json."""
    result = result_of(run)
    found = result.found.items()
    return {
        "schema": SCHEMA,
        "scene": result.scene,
        "record": result.record,
        "verdict": result.verdict,
        "why": result.why,
        "next": list(result.next),
        "coverage": COVERAGE,
        "figures": [_figure(figure) for figure in result.figures],
        "series": [_series(study, each) for study, known in found for each in known.series],
        "statements": [
            _named(study, each) | {"text": each.text}
            for study, known in found
            for each in known.statements
        ],
    }


def read_content(content: Mapping) -> Result:
    """What a content says. Raises LookupError, TypeError or ValueError where it is built
    otherwise."""
    if not _of_kind(content, "figures", list):
        raise ValueError("figures: has none")
    studies: dict[str, tuple[list, list, list]] = {}
    for figure in Figures(map(_read_figure, content["figures"])):
        studies.setdefault(figure.study, ([], [], []))[0].append(figure)
    for place, (name, read) in enumerate(
        (("series", _read_series), ("statements", _read_statement)), start=1
    ):
        for entry in _of_kind(content, name, list):
            studies.setdefault(entry["study"], ([], [], []))[place].append(read(entry))
    return Result(
        scene=_of_kind(content, "scene", dict),
        record=_of_kind(content, "record", dict),
        verdict=_of_kind(content, "verdict", str),
        why=_of_kind(content, "why", str),
        next=tuple(content["next"]),
        found={name: Findings(*map(tuple, parts)) for name, parts in studies.items()},
    )


def _of_kind(content: Mapping, name: str, kind: type) -> object:
    if not isinstance(content[name], kind):
        raise TypeError(f"{name}: is {content[name]!r}")
    return content[name]


def _figure(figure: Figure) -> dict:
    content = {
        "study": figure.study,
        "quantity": figure.quantity,
        "source": figure.source,
        "against": figure.against,
        "at": dict(figure.at),
        "value": figure.value,
        "unit": "" if figure.against else meaning(figure).unit,
        "scale": figure.scale,
        "uncertainty": _uncertainty(figure.uncertainty),
        "convergence": figure.uncertainty and _convergence(figure.uncertainty.convergence),
        "bounds": figure.bounds and list(figure.bounds),
        "verdict": figure.verdict,
        "parts": {part.name: _part(part) for part in figure.parts},
        "not_modelled": dict(figure.unknown),
        "spread": figure.spread and asdict(figure.spread),
        "place": figure.place and list(figure.place),
        "levels": list(figure.levels),
        "notes": list(figure.notes),
    }
    needed = ("study", "quantity", "source", "at", "value", "unit", "scale")
    return finite({n: v for n, v in content.items() if n in needed or v not in (None, {}, [])})


def _uncertainty(stated: Uncertainty | None) -> dict | None:
    return None if stated is None else {"total": stated.total, **stated.parts}


def _convergence(known: Convergence | None) -> dict | None:
    return None if known is None else asdict(known)


def _part(part: Part) -> dict:
    content = asdict(part)
    del content["name"]
    return {n: value for n, value in content.items() if value is not None and value is not False}


def _named(study: str, item: Series | Statement) -> dict:
    return {"study": study, "name": item.name, "source": item.source, "at": dict(item.at)}


def _series(study: str, series: Series) -> dict:
    columns = series.columns.items()
    stated = {name: list(c.uncertainty) for name, c in columns if c.uncertainty is not None}
    content = _named(study, series) | {
        "columns": {name: list(column.values) for name, column in columns},
        "units": {name: column.unit for name, column in columns},
    }
    content |= {"uncertainty": stated} if stated else {}
    return finite(content | ({"is_account": True} if series.is_account else {}))


def _read_figure(entry: Mapping) -> Figure:
    stated, spread = entry.get("uncertainty"), entry.get("spread")
    if stated is not None:
        known = entry.get("convergence")
        parts = {name: _number(size) for name, size in stated.items() if name != "total"}
        known = known and Convergence(**known | {"uncertainty": _number(known["uncertainty"])})
        stated = Uncertainty(parts, known)
    parts = [Part(name, **content) for name, content in entry.get("parts", {}).items()]
    place, bounds = entry.get("place"), entry.get("bounds")
    return Figure(
        study=entry["study"],
        quantity=entry["quantity"],
        source=entry["source"],
        value=_number(entry["value"]),
        at=dict(entry["at"]),
        against=entry.get("against"),
        scale=entry["scale"],
        uncertainty=stated,
        unknown=dict(entry.get("not_modelled", {})),
        bounds=bounds and (bounds[0], bounds[1]),
        parts=tuple(parts),
        spread=spread and SampleSpread(**spread | {"interval": tuple(spread["interval"])}),
        place=place and tuple(place),
        levels=tuple(map(_number, entry.get("levels", ()))),
        notes=tuple(entry.get("notes", ())),
    )


def _read_series(entry: Mapping) -> Series:
    stated, units = entry.get("uncertainty", {}), entry["units"]
    columns = {
        name: Column(
            _of_one_kind(values),
            units[name],
            tuple(map(_number, stated[name])) if name in stated else None,
        )
        for name, values in entry["columns"].items()
    }
    account = entry.get("is_account", False)
    return Series(entry["name"], columns, entry["source"], dict(entry["at"]), account)


def _of_one_kind(values: list) -> tuple:
    """Numbers or texts, None where there is none."""
    known = [value for value in values if value is not None]
    kinds = str if known and isinstance(known[0], str) else int | float
    if not all(isinstance(value, kinds) for value in known):
        raise TypeError(f"a column is {values!r}")
    return tuple(values)


def _read_statement(entry: Mapping) -> Statement:
    return Statement(entry["name"], entry["text"], entry["source"], dict(entry["at"]))


def _number(value: float | None) -> float:
    """JSON has no infinity: what is unknown."""
    return inf if value is None else float(value)
