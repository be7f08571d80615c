"""A run that was just solved, as its user gets it: figures, summary, tables, pictures, files.

In: a finished run. Out: a result that prints itself, and keeps everything that was computed."""

import os
from dataclasses import dataclass, replace
from pathlib import Path
from textwrap import wrap
from typing import TYPE_CHECKING

from comparisons.common.errors import ExitStatus
from comparisons.common.files import write_whole
from comparisons.common.progress import Lasting, ProgressCallback, no_progress
from comparisons.drawing.tables import in_its_unit
from comparisons.figures.figure import Figure
from comparisons.figures.quantity import LABELS, QUANTITIES
from comparisons.judging import study
from comparisons.judging.verdict.headline import headline, verdicts
from comparisons.output.junit import junit_of_run
from comparisons.output.result import Result, said_of
from comparisons.output.terminal import COLUMNS, SUMMARY, cost_summary, summary
from comparisons.runs.run import finish

if TYPE_CHECKING:
    from rich.console import RenderableType

    from comparisons.output.page.plots import Plots


@dataclass(frozen=True, repr=False)
class FinishedRun(Result):
    """A run that has just been solved; `outcome` is everything that was computed."""

    outcome: study.Run

    @classmethod
    def of(cls, outcome: study.Run) -> "FinishedRun":
        return cls(**said_of(outcome), outcome=outcome)

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
        """Tables of the command; with `details` every compared quantity, where the models agree."""
        return summary(self.outcome, details)

    @property
    def plot(self) -> "Plots":
        """Pictures of the run."""
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
        from comparisons.output.page.pdf import print_report

        place = self.outcome.directory if folder is None else Path(folder)
        drawn = finish(replace(self.outcome, directory=place), progress)
        if junit is not None:
            write_whole(junit, junit_of_run(self.outcome))
        if pdf and drawn:
            progress("printing the report")
            if why_not := print_report(place):
                progress(Lasting(why_not))
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
        return ExitStatus.DONE if self.converged else ExitStatus.NOT_CONVERGED

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
