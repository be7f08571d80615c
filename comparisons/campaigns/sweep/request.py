"""What a sweep is made of: a scene, values of some of its fields, and the scene of each point."""

import itertools
import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from comparisons.common.errors import InputError
from comparisons.common.provenance import LEVEL_CODE, key_of, program_code, versions
from comparisons.models.level_cache import scene_key
from comparisons.models.problem import problem_of
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import surface_of

POSITION = "load.position"
SHORT = {"position": POSITION, "friction": "load.friction"}  # beside "load", whichever it is
MOST = 10_000  # points
MARGIN = 1.1  # of the contact's reach, that a placement keeps from the ends of the trace
STUDIES = "comparisons/figures", "comparisons/studies", "comparisons/output"
CODE = (*LEVEL_CODE, *STUDIES, __file__)
_RANGE = re.compile(r"([+-]?[\d.]+(?:[eE][+-]?\d+)?)\s*([^:\d]*?)\s*")

Value = float | str


@dataclass(frozen=True)
class SweptField:
    """A field of the scene, as "table.field", and its values as TOML would have them."""

    name: str
    values: tuple[Value, ...]

    @property
    def text(self) -> str:
        return f"{self.name}={','.join(map(str, self.values))}"


@dataclass(frozen=True)
class SweepPoint:
    """One scene of a sweep."""

    values: tuple[Value, ...]  # of the swept fields, in their order
    scene: Scene | None  # None where there is none with these values
    models: tuple[str, ...]
    why: str | None  # why there is none
    key: str  # hash of everything that shapes the answer


@dataclass(frozen=True)
class SweepRequest:
    """A sweep: every combination of the values, those of the last field inside."""

    scene: Scene
    models: tuple[str, ...]
    fields: tuple[SweptField, ...]
    points: tuple[SweepPoint, ...]


def sweep_request(scene: Scene, over: Sequence[str], models: tuple[str, ...]) -> SweepRequest:
    """The sweep that "FIELD=…" ask for.

    over     "position=40" placements along the trace, "FIELD=FROM:TO:N" or "FIELD=A,B,C"
    Raises InputError for anything that is wrong with them, or where no point has a scene."""
    if not over:
        raise InputError("--over: is missing; allowed is FIELD=A,B,C, FIELD=FROM:TO:N, position=N")
    fields = tuple(_swept(option, scene) for option in over)
    names = [field.name for field in fields]
    if len(set(names)) < len(names):
        raise InputError(f"--over: {names[0]} is given twice; allowed is every field once")
    if (count := int(np.prod([len(field.values) for field in fields]))) > MOST:
        raise InputError(f"--over: asks for {count} scenes; allowed are {MOST}")
    program = [versions(), program_code(*CODE), models]
    points = []
    for values in itertools.product(*(field.values for field in fields)):
        changed, why, shape = None, None, []
        try:
            changed = scene.changed(dict(zip(names, values, strict=True)))
            shape = scene_key(changed, surface_of(changed))
        except InputError as error:
            changed, why = None, str(error)
        key = key_of(program, shape, values, why)[:24]
        points.append(SweepPoint(values, changed, models, why, key))
    if all(point.scene is None for point in points):
        raise InputError(points[0].why)
    return SweepRequest(scene, models, fields, tuple(points))


def _swept(given: str, scene: Scene) -> SweptField:
    short, equals, text = given.partition("=")
    name = SHORT.get(short.strip(), short.strip())
    if name == "load":
        name = f"load.{scene.load.kind}"
    if not equals or not text.strip() or "." not in name:
        raise InputError(
            f"--over: is {given!r}; allowed is FIELD=A,B,C, FIELD=FROM:TO:N or position=N, with "
            "FIELD as in body.youngs_modulus, or load, friction or position"
        )
    parts = [part.strip() for part in text.split(":")]
    if len(parts) == 3:
        return SweptField(name, _between(given, *parts))
    if name == POSITION and len(parts) == 1 and text.strip().isdigit():
        return SweptField(name, _placements(int(text), scene))
    values = tuple(_number(part.strip()) for part in text.split(","))
    if len(parts) != 1 or "" in values:
        raise InputError(f"--over: is {given!r}; allowed is FIELD=A,B,C or FIELD=FROM:TO:N")
    return SweptField(name, values)


def _number(text: str) -> Value:
    try:
        return float(text)
    except ValueError:
        return text


def _between(given: str, first: str, last: str, count: str) -> tuple[Value, ...]:
    ends = _RANGE.fullmatch(first), _RANGE.fullmatch(last)
    units = {end[2] for end in ends if end} - {""}
    if not all(ends) or len(units) > 1 or not count.isdigit() or not 2 <= int(count) <= MOST:
        raise InputError(
            f"--over: is {given!r}; allowed is FROM:TO:N, two numbers of one unit and how many "
            f"values, from 2 to {MOST}"
        )
    values = np.linspace(float(ends[0][1]), float(ends[1][1]), int(count))
    numbers = [float(f"{value:.10g}") for value in values]
    unit = "".join(units)
    return tuple(f"{value:.10g} {unit}" if unit else value for value in numbers)


def _placements(count: int, scene: Scene) -> tuple[float, ...]:
    """Positions [m] of the roller, evenly over those where the contact stays on the trace."""
    if scene.profile is None:
        raise InputError("--over: position: a smooth scene is the same everywhere; allowed is a "
                         "scene with a profile")  # fmt: skip
    if not 2 <= count <= MOST:
        raise InputError(f"--over: position={count}; allowed are from 2 to {MOST} placements")
    problem = problem_of(scene)
    surface = problem.surface
    ends = surface.position + surface.profile.x[0], surface.position + surface.profile.x[-1]
    reach = np.multiply(MARGIN, problem.extent)
    first, last = ends[0] - reach[0], ends[1] - reach[1]
    if first >= last:
        raise InputError("--over: position: the contact is as wide as the trace; allowed is a "
                         "longer trace or a lighter load")  # fmt: skip
    return tuple(float(f"{place:.10g}") for place in np.linspace(first, last, count))
