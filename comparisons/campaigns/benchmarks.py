"""Published contact benchmarks: the scenes of the library's `benchmarks`, solved as `run` does.

In: their scenes, each with what is published of it ([published.NAME]). Out: one table of published
figures, both models' and the verdicts; benchmarks.json, JUnit. A figure that is marked doubtful
is shown with its difference and decides nothing."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, partial
from typing import TYPE_CHECKING

from comparisons.campaigns.cases import Campaign, Trial
from comparisons.figures.figure import Figure, Figures
from comparisons.figures.quantity import MODELS
from comparisons.output.terminal import plain_table
from comparisons.scenes.files import benchmark_names
from comparisons.scenes.scene import Scene
from comparisons.studies.published import HEAD, NAME, table

if TYPE_CHECKING:
    from rich.console import RenderableType


def cases() -> list[Trial]:
    return [
        Trial("benchmark", name, "both", partial(figures_of_benchmark, name))
        for name in benchmark_names()
    ]


def figures_of_benchmark(name: str) -> Iterator[Figure]:
    """Figures of both models that are held to what is published of a benchmark."""
    from comparisons.runs.run import solve_scene

    yield from solve_scene(Scene.read(name), None, MODELS).figures.of(study=NAME)


@dataclass(frozen=True, repr=False)
class Benchmarks(Campaign):
    """All benchmarks, solved."""

    @cached_property
    def published(self) -> Mapping[str, list[tuple[str, ...]]]:
        """Rows of HEAD by benchmark."""
        return {
            row.case.name: table(Scene.read(row.case.name).published, Figures(row.figures))
            for row in self.rows
        }

    def as_dict(self) -> dict:
        """Results as JSON, with a table of texts, a row for each published figure."""
        columns = ("published_figure", *HEAD[1:-1], "note")
        rows = [
            {"benchmark": name} | dict(zip(columns, row, strict=True))
            for name, rows in self.published.items()
            for row in rows
        ]
        return super().as_dict() | {"table": rows}

    def tables(self) -> "RenderableType":
        from rich.console import Group

        shown, notes = plain_table(HEAD[0], numbers=HEAD[1:-1]), []
        for name, rows in self.published.items():
            shown.add_row(f"[bold]{name}")
            for row in rows:
                shown.add_row(f"  {row[0]}", *row[1:-1])
            notes += [f"{name}, {row[0]}: {row[-1]}" for row in rows if row[-1]]
        return Group(shown, *notes, *self.verdict_lines())
