"""What the functions of `comparisons.api` return: figures, tables that print themselves, plots."""

import io
from abc import ABC, abstractmethod
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from comparisons.campaigns.cost.recommend import Cost
from comparisons.common.errors import InputError
from comparisons.figures.figure import Figure, Figures
from comparisons.output.flat_csv import Row, rows_of
from comparisons.output.headline import verdict_of
from comparisons.output.page.plots import Plots
from comparisons.output.result_json import content_of, result_of
from comparisons.studies import study

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from rich.console import Console, RenderableType

    from comparisons.models.level import Level

COLUMNS = 100  # of text; a notebook's cell is as wide
PAGE = '<pre style="font-family: monospace; line-height: 1.2">{code}</pre>'


class Printed(ABC):
    """Prints as text and shows as HTML what `_table` returns for rich."""

    @abstractmethod
    def _table(self) -> "RenderableType": ...

    def __repr__(self) -> str:
        return "\n".join(map(str.rstrip, self._console().export_text().splitlines()))

    def _repr_html_(self) -> str:
        return self._console().export_html(inline_styles=True, code_format=PAGE)

    def _console(self) -> "Console":
        from rich.console import Console

        console = Console(file=io.StringIO(), width=COLUMNS, record=True, force_jupyter=False)
        console.print(self._table())
        return console


@dataclass(frozen=True, repr=False)
class FinishedRun(Printed):
    """A finished run; `outcome` is everything that was computed."""

    outcome: study.Run

    @property
    def result(self) -> dict:
        """As result.json has it, SI units."""
        return content_of(self.outcome)

    @property
    def figures(self) -> Figures:
        """Every number that is a result, with its uncertainty and verdict."""
        return self.outcome.figures

    def figure(
        self, quantity: str, source: str, study: str = "contact", **at: float
    ) -> Figure | None:
        """One of them, by the model or other source that it is of; None where the run has none.

        study  that found it
        at     of several friction coefficients: friction=0.1"""
        source, wanted = source.replace("-", "_"), {"study": study, "quantity": quantity}
        known = self.figures.of(source=source, **wanted)
        return next((f for f in known if at.items() <= f.at.items()), None)

    @property
    def verdict(self) -> str:
        """Of the half-plane here: holds, fails or inconclusive; not compared, not converged."""
        return verdict_of(self.outcome)[0]

    @property
    def rows(self) -> list[Row]:
        """The figures as records, one a friction coefficient and quantity
        (`comparisons.output.flat_csv`)."""
        name = str(self.outcome.directory or self.outcome.problem.scene.name)
        return rows_of(result_of(self.outcome), name)

    @property
    def plot(self) -> Plots:
        """What draws the run."""
        return Plots(self.outcome)

    def contact(self, model: str = "half_plane") -> dict[str, np.ndarray]:
        """Curves of a model's finest level: x [m], pressure [Pa], gap [m], deformed height [m]."""
        from comparisons.models.level import deformed_height

        level = self._level(model)
        return {
            "x": level.grid.x,
            "pressure": level.solution.pressure,
            "gap": level.solution.gap,
            "deformed_height": deformed_height(self.outcome.problem, level),
        }

    def stress(self, model: str = "half_plane", friction: float | None = None) -> dict:
        """Stresses of a model's finest level below the contact, as arrays.

        friction  coefficient; the scene's first by default
        x (k,) and z (m,) [m], z into the rough body from its mean line; sx, sz, txz, tau1 (m, k)
        [Pa], positive in tension; nan outside a rough boundary. Where the body is elastic, the
        stress across the plane is Poisson's ratio times sx + sz."""
        level = self._level(model)
        frictions = self.outcome.problem.scene.load.friction
        found = level.stress(frictions[0] if friction is None else friction)
        if found is None:
            raise InputError(
                "stress: this run has none there; allowed is a scene with [stress], at friction "
                + " or ".join(f"{mu:g}" for mu in frictions)
            )
        window, names = self.outcome.window, ("sx", "sz", "txz", "tau1")
        depth = {"x": window.x, "z": window.z}
        return depth | {name: np.asarray(getattr(found.field, name)) for name in names}

    def _level(self, model: str) -> "Level":
        levels = self.outcome.levels(self.outcome.deciding_friction)
        if model not in levels:
            raise InputError(f"model: is {model}; allowed is {' or '.join(levels)}")
        return levels[model]

    def _table(self) -> "RenderableType":
        from comparisons.output.terminal import summary

        return summary(self.outcome)


@dataclass(frozen=True, repr=False)
class FigureTable(Printed):
    """Figures of several runs, as records (`comparisons.output.flat_csv`)."""

    rows: tuple[Row, ...]

    def _table(self) -> "RenderableType":
        from comparisons.common.numbers import percent, with_unit
        from comparisons.output.terminal import PLAIN, SHORT, plain_table

        numbers = ("mu", "half-plane", "finite elements", "model error")
        table = plain_table("run", "quantity", numbers=numbers)
        for row in self.rows:
            values = (row["half_plane"], row["finite_element"])
            cells = ["" if v is None else with_unit(v, row["unit"]) for v in values]
            error = row["model_error"]
            cells.append("" if error is None else percent(error, signed=True))
            head = (row["title"], SHORT[row["quantity"]], f"{row['friction']:g}")
            table.add_row(*(cell.translate(PLAIN) for cell in (*head, *cells)))
        return table


@dataclass(frozen=True, repr=False)
class CostStudy(Printed):
    """Error against time of every method on one scene."""

    study: Cost

    def plot(self, quantity: str = "peak_pressure") -> "list[Axes]":
        """The diagram of a quantity."""
        from comparisons.campaigns.cost.picture import cost_picture
        from comparisons.drawing.style import collected_figures

        if quantity not in self.study.references:
            allowed = ", ".join(self.study.references)
            raise InputError(f"quantity: is {quantity}; allowed is {allowed}")
        with collected_figures() as drawn:
            cost_picture(self.study, quantity)
        return drawn[0].axes

    def _table(self) -> "RenderableType":
        from comparisons.campaigns.cost.show import cost_table

        return cost_table(self.study)


@dataclass(frozen=True, repr=False)
class Map(Printed):
    """Where the half-plane holds; `content` is that of map.json, in `folder` if it was kept."""

    content: dict
    folder: Path | None

    def plot(self) -> "list[Axes]":
        """The map."""
        from comparisons.campaigns.maps.picture import map_figure
        from comparisons.drawing.style import collected_figures

        with collected_figures():
            return map_figure(self.content).axes

    def _table(self) -> "RenderableType":
        from comparisons.campaigns.maps.content import map_table

        return map_table(self.content, self.folder)


@dataclass(frozen=True, repr=False)
class Sweep(Printed):
    """One scene at many values of its fields; `content` is that of sweep.json, in `folder`."""

    content: dict
    folder: Path | None

    @property
    def rows(self) -> list[Row]:
        """The figures as records, each with the values of the swept fields."""
        names = [each["field"] for each in self.content["over"]]
        return [
            dict(zip(names, point["values"], strict=True)) | row
            for point in self.content["points"]
            for row in point["rows"]
        ]

    def plot(self) -> "list[Axes]":
        """Each figure over the first swept field."""
        from comparisons.campaigns.sweep.pictures import sweep_figure
        from comparisons.drawing.style import collected_figures

        with collected_figures():
            return sweep_figure(self.content).axes

    def _table(self) -> "RenderableType":
        from comparisons.campaigns.sweep.study import sweep_table

        return sweep_table(self.content, self.folder)
