"""Result of a run in its folder: result.json, schema 3, and run.npz with its arrays.

In: a finished run, or the folder of one. Out: the `Result` that both give, and its files.

    scene         as resolved, and what became of its profile
    record        what a repetition needs beside it: when, where and by which revision the run was
                  made, versions, machine, seed, hashes, levels, command, files of the folder
    figures[]     study, quantity, source, at, value, unit; against, scale, uncertainty, bounds,
                  verdict, parts, not_modelled, spread, place, levels, notes where there are any
    series[]      study, name, source, at; columns: values by name, units, uncertainty
    statements[]  study, name, source, at, text

Units are SI. What is unknown is null; what is empty is left out."""

import json
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, field
from functools import cached_property, partial
from itertools import takewhile
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.errors import InputError, nearest, one_line, printable
from comparisons.common.numbers import finite
from comparisons.figures.convergence import Convergence
from comparisons.figures.figure import (
    Column,
    Figure,
    Findings,
    Part,
    SampleSpread,
    Series,
    Statement,
)
from comparisons.figures.quantity import MODELS
from comparisons.figures.uncertainty import COVERAGE, Uncertainty
from comparisons.judging import contact
from comparisons.judging.ladder.study import ESCALATE_TO, SUFFICES
from comparisons.judging.study import LADDER, Found, Run
from comparisons.judging.verdict.headline import headline
from comparisons.output.arrays import RunArrays
from comparisons.output.records import RunFigures
from comparisons.output.terminal import SUMMARY, Printed, in_lines, summary
from comparisons.studies import meaning

if TYPE_CHECKING:
    from rich.text import Text

FILE = "result.json"
SCHEMA = 3
SAID = {"scene": dict, "record": dict, "within": int | float | None, "within_words": str}
SAID |= {"verdict": str, "why": str}
RECORDED = {"levels": int} | dict.fromkeys(("hashes", "machine", "versions"), dict)
# What is raised where a content is built otherwise than a run writes it.
BUILT_OTHERWISE = (ArithmeticError, AttributeError, LookupError, TypeError, ValueError)


@dataclass(frozen=True, repr=False)
class Result(Found, Printed):
    """Result that a finished run and its folder both give."""

    name: str  # the folder's, or the scene's
    scene: dict  # as resolved, SI units
    record: dict
    within: float | None  # the least tolerance at which every judged figure holds; None: unknown
    within_words: str  # a sentence: which figure makes it, or why it is not known
    verdict: str  # holds | fails | inconclusive | not compared | not converged
    why: str
    next: tuple[str, ...]  # what would decide or improve it, as text to paste
    findings: Mapping[str, Findings]  # by study
    say: Callable[[], tuple[str, ...]] = field(compare=False, repr=False)
    load: Callable[[], RunArrays] = field(compare=False, repr=False)

    @cached_property
    def printed(self) -> tuple[str, ...]:
        """Lines that the run printed."""
        return self.say()

    @cached_property
    def arrays(self) -> RunArrays:
        """Curves, stresses, traces. Raises InputError where a folder's cannot be read."""
        return self.load()

    @cached_property
    def figures(self) -> RunFigures:
        """Every number that is a result; `figures.of(study="contact")` are some of them."""
        figures = RunFigures(f for study in self.findings.values() for f in study.figures)
        common = {"run": self.name, "scene": self.scene["name"], "title": self.scene["title"]}
        figures.common = common | {"within": self.within}
        return figures

    @property
    def frictions(self) -> list[float]:
        return self.scene["load"]["friction"]

    @property
    def models(self) -> tuple[str, ...]:
        """Names of the models that were run, of half_plane and finite_element."""
        solved = {figure.source for figure in self.figures.of(study=contact.NAME)}
        return tuple(name for name in MODELS if name in solved)

    def figure(self, quantity: str, source: str, study: str = "contact", **at: float) -> Figure:
        """One of them, by the model or other source that it is of. Raises InputError, with the
        nearest name, where the run has none.

        study  that found it
        at     of several friction coefficients: friction=0.1"""
        figures = self.figures
        wanted = {"study": study, "quantity": quantity, "source": _model(source)}
        for part, name in wanted.items():
            names = sorted({getattr(figure, part) for figure in figures})
            figures = figures.of(**{part: name})
            if not figures:
                near, there = nearest(name, names), ", ".join(names)
                raise InputError(f"{part}: is {name}; the nearest here is {near}, of {there}")
        for figure in figures:
            if at.items() <= figure.at.items():
                return figure
        known = ", ".join(_place(figure.at) for figure in figures)
        raise InputError(f"{quantity}: is not known at {_place(at)}; allowed is {known}")

    def contact(self, model: str = "half-plane") -> dict[str, np.ndarray]:
        """Curves of a model's finest level: x [m], pressure [Pa], gap [m], deformed height [m]."""
        return self.arrays.contact(self._known(model), self.deciding_friction)

    def stress(self, model: str = "half-plane", friction: float | None = None) -> dict:
        """Stresses of a model's finest level below the contact, as arrays.

        friction  coefficient; the scene's first by default
        x (k,) and z (m,) [m], z into the rough body from its mean line; sx, sz, txz, tau1 (m, k)
        [Pa], positive in tension; nan outside a rough boundary. Where the body is elastic, the
        stress across the plane is Poisson's ratio times sx + sz."""
        wanted = self.frictions[0] if friction is None else friction
        stresses = self.arrays.stress(self._known(model), wanted)
        if stresses is None:
            raise InputError(
                "stress: this run has none there; allowed is a scene with [stress], at friction "
                + " or ".join(f"{mu:g}" for mu in self.frictions)
            )
        return stresses

    def _known(self, model: str) -> str:
        known = self.arrays.models
        if _model(model) not in known:
            raise InputError(f"model: is {model}; allowed is {' or '.join(known)}")
        return _model(model)

    @property
    def summary(self) -> str:
        """Title, the verdict and what to do next, in at most ten lines."""
        return "\n".join(takewhile(bool, self.printed[:SUMMARY]))

    def tables(self) -> "Text":
        """Lines that the run printed; a terminal obeys nothing of them."""
        from rich.text import Text

        return Text("\n".join(map(printable, self.printed)), no_wrap=True, overflow="ignore")

    @property
    def result(self) -> dict:
        """The content of result.json."""
        findings, ladder = self.findings.items(), self.findings.get(LADDER, Findings())
        return {
            "schema": SCHEMA,
            **{name: getattr(self, name) for name in SAID},
            "next": list(self.next),
            "printed": list(self.printed),
            "suffices": ladder.said(SUFFICES),
            "escalate_to": ladder.said(ESCALATE_TO),
            "coverage": COVERAGE,
            "figures": [_figure(figure) for figure in self.figures],
            "series": [_series(study, item) for study, known in findings for item in known.series],
            "statements": [
                _named(study, item) | {"text": item.text}
                for study, known in findings
                for item in known.statements
            ],
        }


def result_of(run: Run) -> Result:
    return Result(**said_of(run))


def said_of(run: Run) -> dict[str, object]:
    """The fields of a finished run's `Result`."""
    said = headline(run)
    return {
        "name": str(run.directory or run.problem.scene.name),
        "scene": run.problem.surface.as_dict(run.problem.scene),
        "record": run.record,
        "within": said.within.size,
        "within_words": said.within.sentence,
        "verdict": said.kind,
        "why": said.sentence,
        "next": said.paste,
        "findings": run.findings,
        "say": lambda: in_lines(summary(run)),
        "load": partial(RunArrays.of, run),
    }


def read_result(folder: Path) -> Result:
    """Read the result in a run's folder. Raises InputError, one line, where there is none."""
    path = folder / FILE
    try:
        content = json.loads(path.read_bytes(), parse_constant=_no_number)
        schema = content.get("schema")
        if schema == SCHEMA:
            return _result(content, folder)
    except FileNotFoundError:
        allowed = "allowed is the folder of a finished run"
        raise InputError(f"{folder}: holds no {FILE}; {allowed}") from None
    except (*BUILT_OTHERWISE, OSError, RecursionError) as error:
        raise InputError(f"{path}: is no result of a run ({error!r}); allowed is one") from error
    raise InputError(f"{path}: schema: is {schema}; allowed is {SCHEMA}: run the scene again")


def _no_number(name: str) -> None:
    """Refuse NaN and the infinities, which Python reads, and no run writes."""
    raise ValueError(f"{name} is no number")


def _result(content: Mapping, folder: Path) -> Result:
    lists = dict.fromkeys(("figures", "series", "statements"), list)
    for table, kinds in ((content, SAID | lists), (content["record"], RECORDED)):
        for name, kind in kinds.items():
            if not isinstance(table[name], kind):
                raise TypeError(f"{name}: is of another kind")
    readers = {"figures": _read_figure, "series": _read_series, "statements": _read_statement}
    studies: dict[str, tuple[list, list, list]] = {}
    for place, (kind, read) in enumerate(readers.items()):
        for entry in content[kind]:
            studies.setdefault(entry["study"], ([], [], []))[place].append(read(entry))
    result = Result(
        name=one_line(str(folder)),
        **{name: content[name] for name in SAID},
        next=tuple(map(str, content["next"])),
        say=partial(tuple, map(str, content["printed"])),
        findings={name: Findings(*map(tuple, parts)) for name, parts in studies.items()},
        load=partial(RunArrays.read, folder),
    )
    if not result.figures:  # which raises ValueError, too, where two have one name
        raise ValueError("figures: has none")
    return result


def _place(at: Mapping[str, float]) -> str:
    return " and ".join(f"{name} = {value:g}" for name, value in at.items()) or "no other place"


def _model(name: str) -> str:
    """Both ways of writing a model's name, as figures have it."""
    return name.replace("-", "_")


def _figure(figure: Figure) -> dict:
    content, stated = asdict(figure), figure.uncertainty
    content |= {
        "unit": "" if figure.against else meaning(figure).unit,
        "uncertainty": stated and {"total": stated.total, **stated.parts},
        "convergence": stated and stated.convergence and asdict(stated.convergence),
        "verdict": figure.verdict,
        "parts": {
            part.pop("name"): {n: v for n, v in part.items() if v is not None and v is not False}
            for part in content["parts"]
        },
        "not_modelled": content.pop("unknown"),
    }
    needed = ("study", "quantity", "source", "at", "value", "unit", "scale")
    return finite({n: v for n, v in content.items() if n in needed or v not in (None, {}, ())})


def _named(study: str, item: Series | Statement) -> dict:
    return {"study": study, "name": item.name, "source": item.source, "at": dict(item.at)}


def _series(study: str, series: Series) -> dict:
    columns = series.columns.items()
    stated = {name: c.uncertainty for name, c in columns if c.uncertainty is not None}
    content = _named(study, series) | {
        "columns": {name: column.values for name, column in columns},
        "units": {name: column.unit for name, column in columns},
    }
    content |= {"uncertainty": stated} if stated else {}
    return finite(content | ({"is_account": True} if series.is_account else {}))


def _read_figure(entry: Mapping) -> Figure:
    place, bounds, spread = (entry.get(name) for name in ("place", "bounds", "spread"))
    parts = entry.get("parts", {}).items()
    return Figure(
        **{name: entry[name] for name in ("study", "quantity", "source", "scale")},
        value=_number(entry["value"]),
        at=dict(entry["at"]),
        against=entry.get("against"),
        uncertainty=_read_uncertainty(entry),
        unknown={n: _number(size) for n, size in entry.get("not_modelled", {}).items()},
        bounds=bounds and (bounds[0], bounds[1]),
        parts=tuple(Part(name, **content) for name, content in parts),
        spread=spread and SampleSpread(**spread | {"interval": tuple(spread["interval"])}),
        place=place and tuple(place),
        levels=tuple(map(_number, entry.get("levels", ()))),
        notes=tuple(entry.get("notes", ())),
    )


def _read_uncertainty(entry: Mapping) -> Uncertainty | None:
    stated, known = entry.get("uncertainty"), entry.get("convergence")
    if stated is None:
        return None
    known = known and Convergence(**known | {"uncertainty": _number(known["uncertainty"])})
    return Uncertainty({n: _number(size) for n, size in stated.items() if n != "total"}, known)


def _read_series(entry: Mapping) -> Series:
    stated, columns = entry.get("uncertainty", {}), {}
    for name, values in entry["columns"].items():
        known = [value for value in values if value is not None]
        kinds = str if known and isinstance(known[0], str) else int | float
        if not all(isinstance(value, kinds) for value in known):
            raise TypeError("a column is of several kinds")
        sizes = tuple(map(_number, stated[name])) if name in stated else None
        columns[name] = Column(tuple(values), entry["units"][name], sizes)
    account = entry.get("is_account", False)
    return Series(entry["name"], columns, entry["source"], dict(entry["at"]), account)


def _read_statement(entry: Mapping) -> Statement:
    return Statement(entry["name"], entry["text"], entry["source"], dict(entry["at"]))


def _number(value: float | None) -> float:
    """JSON has no infinity: what is unknown."""
    return inf if value is None else float(value)
