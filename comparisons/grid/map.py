"""A map: what is asked for, its points solved, and map.json, which holds all that a map shows.

In: a scene, two axes and a quantity as `crosscheck map` takes them, or the name of a map that comes
with the project. Out: map.json, which says nothing of when or where it was computed; its picture;
a table."""

import json
import os
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from comparisons.common.errors import InputError
from comparisons.common.numbers import percent_as_written
from comparisons.common.progress import ProgressCallback, no_progress
from comparisons.common.provenance import JUDGING_CODE, LEVEL_CODE, versions
from comparisons.figures.quantity import QUANTITIES, label
from comparisons.grid.groups import (
    axis_of,
    counts_of,
    finite_elements,
    scene_with,
    usual_axes,
)
from comparisons.grid.map_error import (
    BELOW,
    INCONCLUSIVE,
    SIGNIFICANT,
    TOLERANCES,
    points_within,
    significance,
    solve_point,
)
from comparisons.grid.map_picture import Mark, map_figure
from comparisons.grid.mark import mark_of
from comparisons.grid.points import FAILED, SOLVED, Grid, Request, points_of, solved_in
from comparisons.models.problem import Problem
from comparisons.output.records import Records
from comparisons.scenes.files import find_scene, name_of, read_toml
from comparisons.scenes.scene import Origin, Scene, with_settings

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.text import Text

SCHEMA = 2
FINISHED = Path(__file__).parent / "finished"
SIZE = "8x8"
KINDS = {  # of points, in words
    SIGNIFICANT: "with a larger error than its numerical uncertainty",
    BELOW: "below the first tolerance",
    INCONCLUSIVE: "inconclusive",
    FAILED: "failed",
}
# What shapes the result at a point, beside versions of libraries.
CODE = (*LEVEL_CODE, *JUDGING_CODE, "comparisons/grid/points.py")
CODE += tuple(f"comparisons/grid/{n}" for n in ("groups.py", "groups.toml", "map_error.py"))


def request_of(
    scene: str,
    points: str = SIZE,
    x: str | None = None,
    y: str | None = None,
    quantity: str = "peak_pressure",
    settings: Sequence[str] = (),
) -> Request:
    """The map that the arguments of `crosscheck map` ask for.

    scene     of a finished map, or as for `crosscheck run`
    points    "NxM"
    x, y      "GROUP" or "GROUP=FROM:TO"
    settings  FIELD=VALUE each, beside the scene's file
    Raises InputError for anything that is wrong with them, SceneError for a value without scene."""
    counts = counts_of(points)
    finished = FINISHED / f"{scene}.toml"
    path = finished if os.path.isfile(finished) else find_scene(scene)  # of any length
    asked = Scene.of(read_toml(path), Origin(name_of(path), path.parent, scene))
    posed = with_settings(asked, settings)
    if quantity not in QUANTITIES:
        raise InputError(f"--quantity: there is no {quantity}; allowed are {', '.join(QUANTITIES)}")
    if QUANTITIES[quantity].needs_stress and posed.stress is None:
        raise InputError(f"--quantity: {quantity} needs a [stress] section in {scene}")
    usual = usual_axes(posed)
    across = axis_of(usual[0] if x is None else x, counts[0], "--x")
    up = axis_of(usual[1] if y is None else y, counts[1], "--y")
    if across["group"] == up["group"]:
        raise InputError(f"--y: is {up['group']}, as --x; allowed are two groups")
    axes = {axis["group"]: axis["values"] for axis in (up, across)}  # row by row
    # [budget] limits runs alone; what follows in [finite_element] changes with groups
    tables = {name: table for name, table in posed.tables.items() if name != "budget"}
    tables["finite_element"] = posed.written.get("finite_element", {})
    points = "x".join(map(str, counts))
    spans = (f"{a['group']}={a['values'][0]:g}:{a['values'][-1]:g}" for a in (across, up))
    options = f"--points {points} --x {next(spans)} --y {next(spans)} --quantity {quantity}"
    content = {
        "schema": SCHEMA,
        "command": f"crosscheck map {posed.named} {options}",
        "scene": tables,
        "finite_element": finite_elements(posed, axes),
        "quantity": quantity,
        "x": across,
        "y": up,
        "tolerances": list(TOLERANCES),
    }

    def scene_at(at: Mapping[str, float]) -> Scene:  # what is set second is set on the first
        return scene_with(posed, {axis["group"]: at[axis["group"]] for axis in (across, up)})

    return Request(content, points_of(axes, scene_at, quantity, CODE))


def make_map(
    request: Request,
    out: Path,
    workers: int | str | None = None,
    callback: ProgressCallback = no_progress,
    marked: Problem | None = None,
) -> "Map":
    """The map, in `out`, where the points are computed that it does not have.

    workers  as `tasks_by` takes them
    marked   a scene of the user's on the picture
    Raises InputError for what cannot be mapped or written."""
    asked = request.content
    mark = marked and mark_of(asked, marked)  # before anybody waits for the points
    answers = solved_in(out, Map.FILES, request.points, solve_point, workers, callback)
    points = [
        {name: point.at[asked[name]["group"]] for name in "xy"}
        | answer
        | significance(answer, asked["quantity"])
        for point, answer in zip(request.points, answers, strict=True)
    ]
    content = asked | {"points": points, "versions": versions()}
    callback("map: picture")
    made = Map(content, out, mark)
    made.write(out)
    return made


def finished_names() -> tuple[str, ...]:
    return tuple(sorted(path.stem for path in FINISHED.glob("*.json")))


def finished_map(name: str) -> dict:
    return json.loads((FINISHED / f"{name}.json").read_text(encoding="utf-8"))


def show_finished(name: str, quantity: str, marked: Problem | None, out: Path) -> "Map":
    """A map that comes with the project, written to `out`; nothing is solved. Raises InputError for
    a quantity that it does not have, and what cannot be written."""
    content = finished_map(name)
    solved = [point for point in content["points"] if point["status"] == SOLVED]
    allowed = [name for name in QUANTITIES if all(name in p["quantities"] for p in solved)]
    if quantity not in allowed:
        raise InputError(
            f"--quantity: {quantity} is not on this map; allowed are {', '.join(allowed)}"
        )
    points = [point | significance(point, quantity) for point in content["points"]]
    content |= {"quantity": quantity, "points": points}
    made = Map(content, out, marked and mark_of(content, marked))
    made.write(out)
    return made


@dataclass(frozen=True, repr=False)
class Map(Grid):
    """Where the half-plane holds."""

    FILES = "map.json", "map.svg"

    mark: Mark | None = None

    @property
    def figures(self) -> Records:
        """The model error at each point, in the quantity that the map shows, as records."""
        axes, quantity = {n: self.content[n]["group"] for n in "xy"}, self.content["quantity"]
        records = []
        for point in self.content["points"]:
            at = {group: point[name] for name, group in axes.items()}
            at |= {"status": point["status"], "quantity": quantity}
            records.append(at | point.get("quantities", {}).get(quantity, {}))
        return Records(records)

    def pictures(self) -> "dict[str, Callable[[], Figure]]":
        return {"map": partial(map_figure, self.content, self.mark)}

    def tables(self) -> "Text":
        """How many points are within each tolerance, and of which kind."""
        from rich.text import Text

        content, points = self.content, self.content["points"]
        kinds = Counter(point.get("error", point["status"]) for point in points)
        within = ", ".join(
            f"{percent_as_written(t)} at {points_within(content, t)}" for t in content["tolerances"]
        )
        counts = ", ".join(f"{kinds[kind]} {words}" for kind, words in KINDS.items() if kinds[kind])
        lines = [
            f"model error of the half-plane, {label(content['quantity'])}: within {within} points",
            f"{len(points)} points: {counts}",
            f"made by: {content['command']}",
            *self.told(),
        ]
        return Text("\n".join(lines))
