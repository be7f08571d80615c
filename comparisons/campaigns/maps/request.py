"""What a map is made of: a scene, two axes, a quantity; and the scene of each of its points."""

import copy
import hashlib
import json
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from comparisons.campaigns.maps.groups import (
    Axis,
    Origin,
    axis_of,
    counts_of,
    finite_elements,
    tables_with,
    usual_axes,
)
from comparisons.common.cache import Cache
from comparisons.common.errors import InputError, SceneError
from comparisons.common.provenance import LEVEL_CODE, digest, program_code, versions
from comparisons.figures.quantity import HEAT_QUANTITIES, QUANTITIES
from comparisons.scenes.files import find_scene, name_of, read_toml
from comparisons.scenes.resolve import resolve_tables

FOLDER = "map_points"
# Fields that follow from others where a scene does not give them.
FOLLOWING = (("load", "position"), ("profile", "length"), ("profile", "cutoff"), ("heat", "reach"))
# What shapes the answer at a point, beside versions of libraries.
CODE = (
    *LEVEL_CODE,
    "comparisons/figures",
    "comparisons/studies",
    "comparisons/campaigns/maps/groups.py",
    "comparisons/campaigns/maps/groups.toml",
    "comparisons/campaigns/maps/point.py",
)
FINISHED = Path(__file__).parent / "finished"
SIZE = "8x8"


@dataclass(frozen=True)
class PointRequest:
    """A point of a map."""

    # x, y: values of the groups
    x: float
    y: float
    quantity: str  # that the levels are refined for
    tables: dict | None  # the scene, SI; None where there is none with these values
    origin: Origin
    why: str | None  # why there is none
    key: str  # hash of everything that shapes the answer


@dataclass(frozen=True)
class MapRequest:
    """A map."""

    scene: str  # its name or path
    name: str
    tables: dict  # of the scene, SI, without the fields that follow from others
    origin: Origin
    x: Axis
    y: Axis
    quantity: str  # of `comparisons.figures.quantity`, that the map shows

    @property
    def command(self) -> str:
        return (
            f"crosscheck map {self.scene} --points {self.x.count}x{self.y.count} "
            f"--x {self.x} --y {self.y} --quantity {self.quantity}"
        )

    @property
    def finite_element(self) -> dict:
        """[finite_element] of the points, with the assumptions of both groups dropped."""
        return finite_elements(self.tables, (self.x.group, self.y.group))

    @cached_property
    def points(self) -> tuple[PointRequest, ...]:
        """Row by row: y outside, x inside. Raises SceneError where no point can be asked for, with
        what is wrong at the first."""
        program = [versions(), program_code(*CODE)]
        points = tuple(self._point(x, y, program) for y in self.y.values for x in self.x.values)
        if all(point.tables is None for point in points):
            raise SceneError(points[0].why)
        return points

    def _point(self, x: float, y: float, program: list) -> PointRequest:
        values = {self.x.group: x, self.y.group: y}
        tables = why = None
        profile = ""
        try:
            scene = resolve_tables(
                tables_with(self.tables, values, self.origin), name=self.name, **vars(self.origin)
            )
            tables = scene.tables
            if scene.profile is not None:
                profile = digest(scene.profile.x, scene.profile.height)
        except InputError as error:
            why = str(error)
        parts = json.dumps([tables or [why], profile, self.quantity, program], sort_keys=True)
        key = hashlib.sha256(parts.encode()).hexdigest()[:24]
        return PointRequest(x, y, self.quantity, tables, self.origin, why, key)


def point_cache(out: Path) -> Cache:
    return Cache(out / FOLDER, "", {})


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
    given = read_toml(path)
    name = name_of(path)
    origin = Origin(source=scene, folder=path.parent)
    tables = _given_tables(given, name, origin)
    heats = quantity in HEAT_QUANTITIES
    if not heats and quantity not in QUANTITIES:
        allowed = ", ".join((*QUANTITIES, *HEAT_QUANTITIES))
        raise InputError(f"--quantity: there is no {quantity}; allowed are {allowed}")
    needed = "heat" if heats else "stress" if QUANTITIES[quantity].needs_stress else "load"
    if needed not in tables:
        raise InputError(f"--quantity: {quantity} needs a [{needed}] section in {scene}")
    usual = usual_axes(tables, quantity)
    axes = [
        axis_of(asked or default, count, option)
        for asked, default, count, option in zip((x, y), usual, counts, ("--x", "--y"), strict=True)
    ]
    if axes[0].group == axes[1].group:
        raise InputError(f"--y: is {axes[1].group}, as --x; allowed are two groups")
    return MapRequest(scene, name, tables, origin, *axes, quantity)


def _given_tables(given: dict, name: str, origin: Origin) -> dict:
    """The scene in SI without the fields that follow from others: these change along the axes."""
    tables = copy.deepcopy(resolve_tables(given, name=name, **vars(origin)).tables)
    tables["finite_element"] = given.get("finite_element", {})
    for section, field in FOLLOWING:
        if section in tables and field not in given[section]:
            tables[section].pop(field, None)
    if "profile" in tables and given["profile"].get("cutoff") == "auto":
        tables["profile"]["cutoff"] = "auto"
    return tables
