"""What a sweep is made of.

In: a scene, and "FIELD=…" as a user asks for values of its fields. Out: the grid of its scenes."""

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from comparisons.campaigns.grid import Point, Value, points_of
from comparisons.common.errors import InputError
from comparisons.common.provenance import LEVEL_CODE
from comparisons.models.problem import problem_of
from comparisons.scenes.scene import Scene

POSITION = "load.position"
SHORT = {"position": POSITION, "friction": "load.friction"}  # beside "load", whichever it is
MOST = 10_000  # points
MARGIN = 1.1  # of the contact's reach, that a placement keeps from the ends of the trace
CODE = (*LEVEL_CODE, *(f"comparisons/{name}" for name in ("figures", "studies", "output")))
CODE += tuple(f"comparisons/campaigns/{n}.py" for n in ("grid", "sweep/request", "sweep/study"))
_RANGE = re.compile(r"([+-]?[\d.]+(?:[eE][+-]?\d+)?)\s*([^:\d]*?)\s*")


@dataclass(frozen=True)
class SweepRequest:
    """A sweep: every combination of the values, those of the last field inside."""

    scene: Scene
    models: tuple[str, ...]
    fields: dict[str, tuple[Value, ...]]  # values by "table.field", as TOML would have them
    points: tuple[Point, ...]

    @property
    def command(self) -> str:
        values = (f"{name}={','.join(map(str, values))}" for name, values in self.fields.items())
        over = " ".join(f"--over {text!r}" for text in values)
        return f"crosscheck sweep {self.scene.source} {over}"


def sweep_request(scene: Scene, over: Sequence[str], models: tuple[str, ...]) -> SweepRequest:
    """The sweep that "FIELD=…" ask for.

    over     "position=40" placements along the trace, "FIELD=FROM:TO:N" or "FIELD=A,B,C"
    Raises InputError for anything that is wrong with them, or where no point has a scene."""
    if not over:
        raise InputError("--over: is missing; allowed is FIELD=A,B,C, FIELD=FROM:TO:N, position=N")
    fields: dict[str, tuple[Value, ...]] = {}
    for option in over:
        name, values = _swept(option, scene)
        if name in fields:
            raise InputError(f"--over: {name} is given twice; allowed is every field once")
        fields[name] = values
    if (count := int(np.prod([len(values) for values in fields.values()]))) > MOST:
        raise InputError(f"--over: asks for {count} scenes; allowed are {MOST}")
    return SweepRequest(scene, models, fields, points_of(fields, scene.changed, models, CODE))


def _swept(option: str, scene: Scene) -> tuple[str, tuple[Value, ...]]:
    """Name of a field as "table.field", and its values."""
    short, equals, text = option.partition("=")
    name = SHORT.get(short.strip(), short.strip())
    if name == "load":
        name = f"load.{scene.load.kind}"
    if not equals or not text.strip() or "." not in name:
        raise InputError(
            f"--over: is {option!r}; allowed is FIELD=A,B,C, FIELD=FROM:TO:N or position=N, with "
            "FIELD as in body.youngs_modulus, or load, friction or position"
        )
    parts = [part.strip() for part in text.split(":")]
    if len(parts) == 3:
        return name, _between(option, *parts)
    if name == POSITION and len(parts) == 1 and text.strip().isdigit():
        return name, _placements(int(text), scene)
    values = tuple(_number(part.strip()) for part in text.split(","))
    if len(parts) != 1 or "" in values:
        raise InputError(f"--over: is {option!r}; allowed is FIELD=A,B,C or FIELD=FROM:TO:N")
    return name, values


def _number(text: str) -> Value:
    try:
        return float(text)
    except ValueError:
        return text


def _between(option: str, first: str, last: str, count: str) -> tuple[Value, ...]:
    ends = _RANGE.fullmatch(first), _RANGE.fullmatch(last)
    units = {end[2] for end in ends if end} - {""}
    if not all(ends) or len(units) > 1 or not count.isdigit() or not 2 <= int(count) <= MOST:
        raise InputError(
            f"--over: is {option!r}; allowed is FROM:TO:N, two numbers of one unit and how many "
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
