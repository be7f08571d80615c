"""What a map is made of: a scene, two axes, a quantity; and the scene of each of its points."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from comparisons.campaigns.grid import Point, points_of
from comparisons.campaigns.maps.groups import (
    Axis,
    axis_of,
    counts_of,
    finite_elements,
    scene_with,
    usual_axes,
)
from comparisons.common.errors import InputError
from comparisons.common.provenance import LEVEL_CODE
from comparisons.figures.quantity import HEAT_QUANTITIES, QUANTITIES
from comparisons.scenes.files import find_scene, name_of, read_toml
from comparisons.scenes.scene import Origin, Scene

# What shapes the answer at a point, beside versions of libraries.
CODE = (
    *LEVEL_CODE,
    "comparisons/figures",
    "comparisons/studies",
    "comparisons/campaigns/grid.py",
    "comparisons/campaigns/maps/groups.py",
    "comparisons/campaigns/maps/groups.toml",
    "comparisons/campaigns/maps/point.py",
)
FINISHED = Path(__file__).parent / "finished"
SIZE = "8x8"


@dataclass(frozen=True)
class MapRequest:
    """A map."""

    scene: Scene
    x: Axis
    y: Axis
    quantity: str  # of `comparisons.figures.quantity`, that the map shows

    @property
    def command(self) -> str:
        return (
            f"crosscheck map {self.scene.source} --points {self.x.count}x{self.y.count} "
            f"--x {self.x} --y {self.y} --quantity {self.quantity}"
        )

    @property
    def finite_element(self) -> dict:
        """[finite_element] of the points, with the assumptions of both groups dropped."""
        return finite_elements(self.scene, (self.x.group, self.y.group))

    @property
    def tables(self) -> dict:
        """Of the scene, SI, without [budget], which limits runs alone; [finite_element] as the
        scene gives it: what follows there changes with groups."""
        tables = {name: table for name, table in self.scene.tables.items() if name != "budget"}
        return tables | {"finite_element": self.scene.given.get("finite_element", {})}

    @cached_property
    def points(self) -> tuple[Point, ...]:
        """Row by row: y outside, x inside. Raises SceneError where no point can be asked for, with
        what is wrong at the first."""
        axes = {axis.group: axis.values for axis in (self.y, self.x)}
        return points_of(axes, self._scene_at, self.quantity, CODE)

    def _scene_at(self, at: Mapping[str, float]) -> Scene:
        return scene_with(self.scene, {axis.group: at[axis.group] for axis in (self.x, self.y)})


def request_of(
    scene: str,
    points: str = SIZE,
    x: str | None = None,
    y: str | None = None,
    quantity: str = "peak_pressure",
) -> MapRequest:
    """The map that the arguments of `crosscheck map` ask for.

    scene   of a finished map, or as for `crosscheck run`
    points  "NxM"
    x, y    "GROUP" or "GROUP=FROM:TO"
    Raises InputError for anything that is wrong with them.
    """
    counts = counts_of(points)
    finished = FINISHED / f"{scene}.toml"
    path = finished if finished.is_file() else find_scene(scene)
    posed = Scene.of(read_toml(path), Origin(name_of(path), path.parent, scene))
    heats = quantity in HEAT_QUANTITIES
    if not heats and quantity not in QUANTITIES:
        allowed = ", ".join((*QUANTITIES, *HEAT_QUANTITIES))
        raise InputError(f"--quantity: there is no {quantity}; allowed are {allowed}")
    needed = "heat" if heats else "stress" if QUANTITIES[quantity].needs_stress else "load"
    if getattr(posed, needed) is None:
        raise InputError(f"--quantity: {quantity} needs a [{needed}] section in {scene}")
    usual = usual_axes(posed, quantity)
    axes = [
        axis_of(asked or default, count, option)
        for asked, default, count, option in zip((x, y), usual, counts, ("--x", "--y"), strict=True)
    ]
    if axes[0].group == axes[1].group:
        raise InputError(f"--y: is {axes[1].group}, as --x; allowed are two groups")
    return MapRequest(posed, *axes, quantity)
