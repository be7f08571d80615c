"""A run as what its user gets: figures, curves, a summary, tables, pictures, files.

In: a run that was just solved, or what its folder says. Out: results that print themselves."""

import os
from collections.abc import Mapping
from dataclasses import dataclass, replace
from operator import itemgetter
from pathlib import Path
from textwrap import wrap
from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.errors import ExitStatus, InputError, nearest
from comparisons.common.files import write_whole
from comparisons.common.progress import Lasting, ProgressCallback, no_progress
from comparisons.drawing.tables import in_its_unit
from comparisons.figures.figure import Figure, Figures
from comparisons.figures.quantity import LABELS, QUANTITIES
from comparisons.judging import study
from comparisons.judging.verdict.headline import headline, verdicts
from comparisons.output.flat_csv import Records, Row, rows_of, rows_tables
from comparisons.output.junit import junit_of_run
from comparisons.output.result import Result, content_of, result_of
from comparisons.output.terminal import COLUMNS, SUMMARY, Printed, cost_summary, summary
from comparisons.runs.run import finish

if TYPE_CHECKING:
    from rich.console import RenderableType

    from comparisons.output.page.plots import Plots


class RunFigures(Printed, Figures):
    """Every number of a run that is a result, with its uncertainty and verdict."""

    rows: list[Row]  # the figures as records, one each (`comparisons.output.flat_csv`)
    frame = Records.frame

    def tables(self) -> "RenderableType":
        return rows_tables(self.rows, itemgetter("study"), say=str)


@dataclass(frozen=True, repr=False)
class RecordedRun(Printed):
    """A run as its files have it."""

    said: Result
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
        return self.said.arrays.contact(self._known(model), self.said.deciding_friction)

    def stress(self, model: str = "half-plane", friction: float | None = None) -> dict:
        """Stresses of a model's finest level below the contact, as arrays.

        friction  coefficient; the scene's first by default
        x (k,) and z (m,) [m], z into the rough body from its mean line; sx, sz, txz, tau1 (m, k)
        [Pa], positive in tension; nan outside a rough boundary. Where the body is elastic, the
        stress across the plane is Poisson's ratio times sx + sz."""
        frictions = self.said.scene["load"]["friction"]
        wanted = frictions[0] if friction is None else friction
        stresses = self.said.arrays.stress(self._known(model), wanted)
        if stresses is None:
            raise InputError(
                "stress: this run has none there; allowed is a scene with [stress], at friction "
                + " or ".join(f"{mu:g}" for mu in frictions)
            )
        return stresses

    def _known(self, model: str) -> str:
        known = self.said.arrays.models
        if _model(model) not in known:
            raise InputError(f"model: is {model}; allowed is {' or '.join(known)}")
        return _model(model)

    @property
    def summary(self) -> str:
        """Title, the verdict and what follows, in ten lines."""
        return "\n".join(self.said.summary[:SUMMARY])

    def tables(self) -> "RenderableType":
        return self.said.shown()


@dataclass(frozen=True, repr=False)
class FinishedRun(RecordedRun):
    """A run that has just been solved; `outcome` is everything that was computed."""

    outcome: study.Run

    @classmethod
    def of(cls, outcome: study.Run) -> "FinishedRun":
        name = str(outcome.directory or outcome.problem.scene.name)
        return cls(result_of(outcome), name, outcome)

    @property
    def exit_status(self) -> ExitStatus:
        return self.outcome.exit_status

    @property
    def summary(self) -> str:
        """Title, the verdict, the first figures and what to do next, in ten lines."""

        run, said = self.outcome, headline(self.outcome)
        figures = run.model_errors or run.figures.of(study="contact")
        rows = [_line(figure) for figure in figures if figure.quantity in QUANTITIES]
        first = said.within.sentence, *("  ".join(verdict) for verdict in verdicts(run, said))
        head = _wrapped(run.problem.scene.title, *first)
        tail = [*_wrapped(f"Next:  {said.next}"), *said.paste]
        room = SUMMARY - len(head) - len(tail)
        if len(rows) > room:
            rows[max(room - 1, 0) :] = [f"… {len(rows) - max(room - 1, 0)} more figures"]
        return "\n".join([*head, *rows, *tail])

    def __repr__(self) -> str:
        """The summary; a notebook shows the tables."""
        return self.summary

    def tables(self, details: bool = False) -> "RenderableType":
        """Those of the command; with `details` every compared quantity, where the models agree."""
        return summary(self.outcome, details)

    @property
    def plot(self) -> "Plots":
        """What draws the run."""
        from comparisons.output.page.plots import Plots

        return Plots(self.outcome)

    def write(
        self,
        folder: str | os.PathLike | None = None,
        *,
        junit: Path | None = None,
        pdf: bool = False,
        progress: ProgressCallback = no_progress,
    ) -> bool:
        """Write the run's files. Returns whether its report could be drawn. Raises InputError where
        they cannot be written.

        folder  None is the one that it was solved for, if any
        junit   file for JUnit XML
        pdf     print the report, too, where a browser does"""
        from comparisons.output.page.pdf import NoPdfError, print_report

        place = self.outcome.directory if folder is None else Path(folder)
        drawn = finish(replace(self.outcome, directory=place), progress)
        if junit is not None:
            write_whole(junit, junit_of_run(self.outcome))
        if pdf and drawn:
            progress("printing the report")
            try:
                print_report(place)
            except NoPdfError as error:
                progress(Lasting(str(error)))
        return drawn

    def report(self, path: str | os.PathLike) -> Path:
        """Write the report, one page that needs no network; returns its path."""
        from comparisons.output.page.page import render

        write_whole(Path(path), render(self.outcome))
        return Path(path)


class MethodCosts(FinishedRun):
    """A run by all methods, for what each costs."""

    @property
    def exit_status(self) -> ExitStatus:
        return ExitStatus.DONE if self.outcome.converged else ExitStatus.NOT_CONVERGED

    def tables(self) -> "RenderableType":
        return cost_summary(self.outcome)


def _line(figure: Figure) -> str:
    """A model error, or a model's figure, with what is uncertain of it."""
    said = f"{LABELS[figure.source]} {in_its_unit(figure, QUANTITIES)}"
    if figure.against is not None:
        said = f"{figure.words()}, against the {LABELS[figure.against]}"
    return f"{QUANTITIES[figure.quantity].short:14}  {figure.friction:<6g}  {said}"


def _wrapped(*lines: str) -> list[str]:
    return [part for line in lines for part in wrap(line, COLUMNS)]


def _place(at: Mapping[str, float]) -> str:
    return " and ".join(f"{name} = {value:g}" for name, value in at.items()) or "no other place"


def _model(name: str) -> str:
    """Both ways of writing a model's name, as figures have it."""
    return name.replace("-", "_")
