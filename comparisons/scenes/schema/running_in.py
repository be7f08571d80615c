"""The [running_in] section: how a surface is run in before both models press it."""

from collections.abc import Iterator
from typing import Annotated

import numpy as np

from analytic.profile import Profile
from analytic.running_in import SWEEPS
from comparisons.common.errors import SceneError
from comparisons.common.units import LENGTH, LOAD, PRESSURE
from comparisons.scenes.scene import RunningIn
from comparisons.scenes.schema.fields import Length, Number, SceneSection, Several, Whole

PASSES = 15  # of a stroke that does not say how many
MOST_PASSES = 1000  # of a sweep, and sweeps at most


class RunningInSection(SceneSection):
    """Places of the roller one by one (`positions`), or evenly along a `stroke` about its own."""

    hardness: Annotated[float, Number(PRESSURE, above=0.0)] | None = None
    load: Annotated[float, Number(LOAD, above=0.0)] | None = None
    positions: Annotated[tuple[float, ...], Several(Number(LENGTH))] | None = None
    stroke: Length | None = None
    passes: Annotated[int, Whole(2, MOST_PASSES)] | None = None
    sweeps: Annotated[int, Whole(1, MOST_PASSES)] = SWEEPS

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        yield from self.unless_one_of(("positions", "stroke"), " and ")
        if self.positions is not None and self.passes is not None:
            problem = "is given beside positions, which are one pass each; allowed with stroke"
            yield "passes", problem

    def missing(
        self, profile: SceneSection | None, hardness: float | None, load_kind: str
    ) -> Iterator[tuple[str, str]]:
        """What neither this section nor the rest of the scene gives."""
        if profile is None:
            yield "running_in", "is given for a smooth surface; allowed only with [profile]"
        if self.hardness is None and hardness is None:
            where = "here or as body.hardness"
            yield "running_in.hardness", f"is missing; allowed is a pressure above 0, {where}"
        if self.load is None and load_kind == "approach":
            problem = "is missing; allowed is a load per length, which load.approach is not"
            yield "running_in.load", problem

    def travel(self, position: float) -> float:
        """Twice the roller's largest distance from `position` [m]: so much longer is a trace."""
        if self.stroke is not None:
            return self.stroke
        return 2.0 * float(np.abs(np.array(self.positions) - position).max())


def running_in_of(
    table: RunningInSection, hardness: float | None, position: float, placed: Profile, source: str
) -> tuple[RunningIn, dict]:
    """How the scene's surface is run in, and the defaults of fields that the section leaves out.

    hardness  [Pa] of the body, if it has one
    position  [m] of the roller's centre on the trace
    placed    the trace with its x = 0 there
    Raises SceneError where the roller would leave the trace."""
    defaults = {"hardness": hardness} if table.hardness is None else {}
    positions = table.positions
    if positions is None:
        passes = table.passes or PASSES
        defaults["passes"] = passes
        positions = position + table.stroke * np.linspace(-0.5, 0.5, passes)
    first, last = position + placed.x[[0, -1]]
    for place in positions:
        if not first < place < last:
            field, given = "positions", place
            allowed = f"inside the trace, above {first:g} m and below {last:g} m"
            if table.stroke is not None:
                field, given = "stroke", table.stroke
                room = 2.0 * min(position - first, last - position)
                allowed = f"below {room:g} m, to stay on the trace about the roller's centre"
            raise SceneError(f"{source}: running_in.{field}: is {given:g} m; allowed is {allowed}")
    places = tuple(map(float, positions))
    return RunningIn(table.hardness or hardness, table.load, places, table.sweeps), defaults
