"""Scenes in, results out, as plain functions: tables that print themselves, plots, arrays.

In: a `Scene`, or its name, path or tables. Out: what `comparisons` offers to notebooks and
scripts; figures are those of the command line, in SI units."""

import io
import os
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from operator import itemgetter
from pathlib import Path
from tempfile import TemporaryDirectory
from textwrap import wrap
from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.errors import InputError, nearest
from comparisons.common.files import check_writable, write_whole
from comparisons.common.progress import ProgressCallback, no_progress
from comparisons.common.units import describe
from comparisons.drawing.tables import in_its_unit
from comparisons.figures.figure import Figure, Figures
from comparisons.figures.quantity import LABELS, MODELS, QUANTITIES, models_named
from comparisons.judging import study
from comparisons.output.arrays import RunArrays
from comparisons.output.flat_csv import (
    Row,
    judged_rows,
    right_within,
    rows_of,
    rows_tables,
)
from comparisons.output.page.plots import Plots
from comparisons.output.result import Result, content_of, read_result, result_of
from comparisons.scenes.scene import Scene, with_law, with_tolerance

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from pandas import DataFrame
    from rich.console import Console, RenderableType

AnyScene = Scene | Mapping | str | os.PathLike
"""A scene, its tables, its name or its path."""

SHOWN = 3  # figures of a run that is printed
COLUMNS = 100  # of text; a notebook's cell is as wide
PAGE = '<pre style="font-family: monospace; line-height: 1.2">{code}</pre>'


class Printed(ABC):
    """Prints as text and shows as HTML what `_table` returns for rich."""

    @abstractmethod
    def _table(self) -> "RenderableType": ...

    def __repr__(self) -> str:
        return "\n".join(line.rstrip() for line in self._console().export_text().splitlines())

    def _repr_html_(self) -> str:
        return self._console().export_html(inline_styles=True, code_format=PAGE)

    def _console(self) -> "Console":
        from rich.console import Console

        console = Console(file=io.StringIO(), width=COLUMNS, record=True, force_jupyter=False)
        console.print(self._table(), crop=False)
        return console


class RunFigures(Printed, Figures):
    """Every number of a run that is a result, with its uncertainty and verdict."""

    rows: list[Row]  # the figures as records, one each (`comparisons.output.flat_csv`)

    def frame(self) -> "DataFrame":
        """`rows` as a table of pandas. Raises InputError where pandas is not installed."""
        try:
            from pandas import DataFrame
        except ImportError:
            raise InputError("frame: pandas is not installed; `rows` are records") from None
        return DataFrame(self.rows)

    def _table(self) -> "RenderableType":
        return rows_tables(self.rows, itemgetter("study"), say=str)


@dataclass(frozen=True, repr=False)
class RecordedRun(Printed):
    """A run as its files have it."""

    said: Result
    arrays: RunArrays
    name: str  # its folder, or its scene's name

    @property
    def result(self) -> dict:
        """As result.json has it, SI units."""
        return content_of(self.said)

    @property
    def figures(self) -> RunFigures:
        """Every number that is a result; `figures.of(study="contact")` are some of them."""
        figures = RunFigures(self.said.figures)
        figures.rows = rows_of(self.said, self.name)
        return figures

    def figure(self, quantity: str, source: str, study: str = "contact", **at: float) -> Figure:
        """One of them, by the model or other source that it is of. Raises InputError, with the
        nearest name, where the run has none.

        study  that found it
        at     of several friction coefficients: friction=0.1"""
        figures = self.said.figures
        wanted = {"study": study, "quantity": quantity, "source": _model(source)}
        for field, name in wanted.items():
            names = sorted({getattr(figure, field) for figure in figures})
            figures = figures.of(**{field: name})
            if not figures:
                near, there = nearest(name, names), ", ".join(names)
                raise InputError(f"{field}: is {name}; the nearest here is {near}, of {there}")
        for figure in figures:
            if at.items() <= figure.at.items():
                return figure
        known = ", ".join(_place(figure.at) for figure in figures)
        raise InputError(f"{quantity}: is not known at {_place(at)}; allowed is {known}")

    @property
    def verdict(self) -> str:
        """Of the half-plane here: holds, fails or inconclusive; not compared, not converged."""
        return self.said.verdict

    @property
    def within(self) -> float | None:
        """The least tolerance at which every judged figure holds, relative: the half-plane is right
        within it. None where it is not known."""
        return self.said.within

    def contact(self, model: str = "half-plane") -> dict[str, np.ndarray]:
        """Curves of a model's finest level: x [m], pressure [Pa], gap [m], deformed height [m]."""
        return self.arrays.contact(self._known(model), self.said.deciding_friction)

    def stress(self, model: str = "half-plane", friction: float | None = None) -> dict:
        """Stresses of a model's finest level below the contact, as arrays.

        friction  coefficient; the scene's first by default
        x (k,) and z (m,) [m], z into the rough body from its mean line; sx, sz, txz, tau1 (m, k)
        [Pa], positive in tension; nan outside a rough boundary. Where the body is elastic, the
        stress across the plane is Poisson's ratio times sx + sz."""
        frictions = self.said.scene["load"]["friction"]
        wanted = frictions[0] if friction is None else friction
        stresses = self.arrays.stress(self._known(model), wanted)
        if stresses is None:
            raise InputError(
                "stress: this run has none there; allowed is a scene with [stress], at friction "
                + " or ".join(f"{mu:g}" for mu in frictions)
            )
        return stresses

    def _known(self, model: str) -> str:
        if _model(model) not in self.arrays.models:
            raise InputError(f"model: is {model}; allowed is {' or '.join(self.arrays.models)}")
        return _model(model)

    def _table(self) -> "RenderableType":
        return self.said.shown()


@dataclass(frozen=True, repr=False)
class FinishedRun(RecordedRun):
    """A run that has just been solved; `outcome` is everything that was computed."""

    outcome: study.Run

    @classmethod
    def of(cls, outcome: study.Run) -> "FinishedRun":
        name = str(outcome.directory or outcome.problem.scene.name)
        return cls(result_of(outcome), RunArrays.of(outcome), name, outcome)

    def __repr__(self) -> str:
        """In ten lines: title, the verdict, the first figures and what to do next. A notebook
        shows the tables of the command line."""
        from comparisons.judging.verdict.headline import headline, verdicts

        run, said = self.outcome, headline(self.outcome)
        figures = run.model_errors or run.figures.of(study="contact")
        rows = [_line(figure) for figure in figures if figure.quantity in QUANTITIES]
        left = len(rows) - SHOWN
        more = [f"… {left} more figure{'s' * (left > 1)}"] if left > 0 else []
        first = said.within.sentence, *("  ".join(verdict) for verdict in verdicts(run, said))
        lines = run.problem.scene.title, *first, *rows[:SHOWN], *more, f"Next:  {said.next}"
        wrapped = [part for line in lines for part in wrap(line, COLUMNS)]
        return "\n".join([*wrapped, *said.paste])

    @property
    def plot(self) -> Plots:
        """What draws the run."""
        return Plots(self.outcome)

    def report(self, path: str | os.PathLike) -> Path:
        """Write the report, one page that needs no network; returns its path. Raises InputError
        where there is no folder for it."""
        from comparisons.output.page.page import render

        path = _path(path, "path")
        if not path.parent.is_dir() or path.is_dir():
            raise InputError(f"{path}: is no place for a page; allowed is a file in a folder")
        write_whole(path, render(self.outcome))
        return path

    def _table(self) -> "RenderableType":
        from comparisons.output.terminal import summary

        return summary(self.outcome)


@dataclass(frozen=True, repr=False)
class FigureTable(Printed):
    """Figures of several runs, as records (`comparisons.output.flat_csv`); prints the judged."""

    rows: tuple[Row, ...]

    def _table(self) -> "RenderableType":
        return rows_tables(judged_rows(self.rows), partial(right_within, name="title"))


@dataclass(frozen=True, repr=False)
class Map(Printed):
    """Where the half-plane holds; `content` is that of map.json, in `folder` if it was kept."""

    content: dict
    folder: Path | None

    def plot(self) -> "list[Axes]":
        """The map."""
        from comparisons.grid.map_picture import map_figure

        return _drawn(map_figure, self.content)

    def _table(self) -> "RenderableType":
        from comparisons.grid.map import map_table

        return map_table(self.content, self.folder)


@dataclass(frozen=True, repr=False)
class Sweep(Printed):
    """Scenes at many values of their fields; `content` is that of sweep.json, in `folder`."""

    content: dict
    folder: Path | None

    @property
    def rows(self) -> list[Row]:
        """The figures as records, each with the values of the swept fields."""
        from comparisons.grid.sweep import rows_of_points

        return rows_of_points(self.content)

    def plot(self) -> "list[Axes]":
        """Each figure over the first swept field."""
        from comparisons.grid.sweep_picture import sweep_figure

        return _drawn(sweep_figure, self.content)

    def _table(self) -> "RenderableType":
        from comparisons.grid.table import sweep_table

        return sweep_table(self.content, self.folder)


def run(
    scene: AnyScene,
    models: str | Sequence[str] = MODELS,
    *,
    tolerance: float | None = None,
    law: str | None = None,
    out: str | os.PathLike | None = None,
    progress: ProgressCallback = no_progress,
) -> FinishedRun:
    """Solve a scene, compare the models, judge: what `crosscheck run` does.

    models     half-plane, finite-element, or both
    tolerance  relative, of all that is judged, in place of the scene's own
    law        of elasticity, of every elastic body, in place of their own
    out        folder for the files of the run; None writes none
    progress   gets each stage as it begins
    Raises SceneError for a wrong scene, SolverError where no solution is found.

    >>> steel = {"youngs_modulus": 210e9, "poissons_ratio": 0.3}
    >>> coarse = {
    ...     "roller": {"radius": 8e-3, **steel},
    ...     "body": steel,
    ...     "load": {"per_length": 1e6},
    ...     "tolerance": {"peak_pressure": 0.5, "contact_length": 0.5},
    ...     "resolution": {"pitch": "20 um", "levels": 2},
    ...     "finite_element": {"block": 20},
    ...     "budget": {"effects": False},
    ... }
    >>> both = run(coarse)
    >>> both.verdict
    'holds'
    >>> [figure.verdict for figure in both.figures.of(study="comparison")]
    ['agree', 'agree', None]"""
    from comparisons.runs.run import run as run_scene

    chosen = models_named(models, "models")
    place = _writable(out)
    asked = scene_of(scene)
    if tolerance is not None:
        asked = with_tolerance(asked, tolerance)
    if law is not None:
        asked = with_law(asked, law)
    return FinishedRun.of(run_scene(asked, place, chosen, progress))


def read(folder: str | os.PathLike) -> RecordedRun:
    """A run from the folder that it has left, without solving. InputError where there is none."""
    place = _path(folder, "folder")
    result = read_result(place)
    return RecordedRun(result, result.arrays, str(place))


def compare(*runs: RecordedRun | Sequence[RecordedRun]) -> FigureTable:
    """The figures of runs, or of lists of them, a row each."""
    every = [
        run for given in runs for run in (given if isinstance(given, list | tuple) else [given])
    ]
    if not every or not all(isinstance(run, RecordedRun) for run in every):
        given = next((describe(run) for run in every if not isinstance(run, RecordedRun)), "no run")
        raise InputError(f"compare: is given {given}; allowed are runs, at least one")
    return FigureTable(tuple(row for run in every for row in run.figures.rows))


def cost(
    scene: AnyScene,
    *,
    out: str | os.PathLike | None = None,
    progress: ProgressCallback = no_progress,
) -> FinishedRun:
    """Error against run time of every method that applies: what `crosscheck cost` does, a run by
    all of them. It takes minutes. `out` keeps its files."""
    from comparisons.runs.run import Known
    from comparisons.runs.run import run as run_scene

    place = _writable(out)
    known = Known(all_methods=True)
    return FinishedRun.of(run_scene(scene_of(scene), place, MODELS, progress, known=known))


def map(
    scene: str | os.PathLike,
    points: str = "8x8",
    *,
    x: str | None = None,
    y: str | None = None,
    quantity: str = "peak_pressure",
    workers: int | str | None = None,
    out: str | os.PathLike | None = None,
    progress: ProgressCallback = no_progress,
) -> Map:
    """The half-plane's model error over two dimensionless groups: what `crosscheck map` does.

    scene    a name or a path
    points   along x and y, "NxM"
    x, y     "GROUP" or "GROUP=FROM:TO"; by the scene by default
    workers  processes, one a core by default, or a Dask scheduler's address
    It takes minutes. `out` keeps each point, and goes on from there."""
    from comparisons.grid.map import make_map, request_of

    scene = os.fspath(scene) if isinstance(scene, os.PathLike) else scene
    texts = {"scene": scene, "points": points, "x": x, "y": y, "quantity": quantity}
    for name, text in texts.items():
        if not isinstance(text, str) and not (text is None and name in ("x", "y")):
            raise InputError(f"{name}: is {describe(text)}; allowed is a text")
    request = request_of(**texts)
    with _folder(out, "map") as place:
        content = make_map(request, place, workers, progress)
    return Map(content, None if out is None else place)


def sweep(
    scene: AnyScene | Sequence[AnyScene],
    over: str | Sequence[str] | Mapping[str, Sequence[float | str]] = (),
    models: str | Sequence[str] = "half-plane",
    *,
    workers: int | str | None = None,
    out: str | os.PathLike | None = None,
    progress: ProgressCallback = no_progress,
) -> Sweep:
    """Several scenes, or one at many placements, loads, traces or values of any field: what
    `crosscheck sweep` does.

    over     "position=40", "FIELD=FROM:TO:N", "FIELD=A,B,C", "profile.file=FOLDER", several of
             them, or values by field
    workers  processes, one a core by default, or a Dask scheduler's address
    `out` keeps each point, and goes on from there.

    >>> steel = {"youngs_modulus": 210e9, "poissons_ratio": 0.3}
    >>> smooth = {"roller": {"radius": 8e-3, **steel}, "body": steel, "load": {"per_length": 1e6}}
    >>> loads = sweep(smooth, {"load": [1e6, 4e6]}, workers=1)
    >>> contact = [row for row in loads.rows if row["study"] == "contact"]
    >>> peaks = [row["value"] for row in contact if row["quantity"] == "peak_pressure"]
    >>> round(peaks[1] / peaks[0], 4)
    2.0"""
    from comparisons.grid.sweep import make_sweep, sweep_request

    if isinstance(over, Mapping):
        over = [f"{name}={','.join(f'{v}' for v in values)}" for name, values in over.items()]
    asked = [over] if isinstance(over, str) else list(over)
    scenes = [scene_of(one) for one in (scene if isinstance(scene, list | tuple) else [scene])]
    request = sweep_request(scenes, asked, models_named(models, "models"))
    with _folder(out, "sweep") as place:
        content = make_sweep(request, place, workers, progress)
    return Sweep(content, None if out is None else place)


def scene_of(scene: AnyScene) -> Scene:
    """The scene, checked. Raises SceneError, one line, for anything that is wrong with it.

    >>> scene_of("sinusoid").load.hertz_peak_pressure
    1000000000.0
    >>> scene_of({"roller": {"radius": "8"}})
    Traceback (most recent call last):
    comparisons.common.errors.SceneError: scene: roller.radius: is "8", which has no unit; allowed \
is a length above 0: a number in m or "8.2 mm"
    """
    if isinstance(scene, Mapping):
        return Scene.of(scene)
    if isinstance(scene, str | os.PathLike):
        return Scene.read(scene)
    if not isinstance(scene, Scene):
        allowed = "allowed is a name, a path, tables or a Scene"
        raise InputError(f"scene: is {describe(scene)}; {allowed}")
    return scene


def _writable(out: str | os.PathLike | None) -> Path | None:
    place = _path(out, "out")
    if place is not None:
        check_writable(place)
    return place


def _drawn(draw: Callable, content: object) -> "list[Axes]":
    from comparisons.drawing.style import collected_figures

    with collected_figures():
        return draw(content).axes


def _line(figure: Figure) -> str:
    """A model error, or a model's figure, with what is uncertain of it."""
    said = f"{LABELS[figure.source]} {in_its_unit(figure, QUANTITIES)}"
    if figure.against is not None:
        said = f"{figure.words()}, against the {LABELS[figure.against]}"
    return f"{QUANTITIES[figure.quantity].short:14}  {figure.friction:<6g}  {said}"


def _place(at: Mapping[str, float]) -> str:
    return " and ".join(f"{name} = {value:g}" for name, value in at.items()) or "no other place"


def _model(name: str) -> str:
    """Both ways of writing a model's name, as figures have it."""
    return name.replace("-", "_")


@contextmanager
def _folder(out: str | os.PathLike | None, name: str) -> Iterator[Path]:
    """`out`, or a folder that goes at the block's end."""
    with TemporaryDirectory() as scratch:
        yield _path(out, "out") or Path(scratch) / name


def _path(path: object, name: str) -> Path | None:
    """An argument that names a file or folder; None where it is."""
    if path is not None and not isinstance(path, str | os.PathLike):
        raise InputError(f"{name}: is {describe(path)}; allowed is a path")
    return None if path is None else Path(path)
