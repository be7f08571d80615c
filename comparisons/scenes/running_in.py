"""The [running_in] section: how a surface is run in before both models press it."""

from collections.abc import Iterator
from typing import Annotated, Self

import numpy as np
from pydantic import Field, StrictInt

from comparisons.common.units import LENGTH, LOAD
from comparisons.scenes.fields import Length, Number, Pressure, SceneSection, Several, optional

PASSES = 15  # of a stroke that does not say how many
MOST_PASSES = 1000  # of a sweep, and sweeps at most


Positions = Annotated[tuple[Annotated[float, Number(LENGTH)], ...], Several()]
Passes = Annotated[StrictInt, Field(ge=2, le=MOST_PASSES)]


class RunningInSection(SceneSection):
    """Running-in before the scene starts: the roller is pressed on at positions along the trace
    with the pressure capped, and what flows is taken off."""

    hardness: Pressure | None = optional("pressure at which asperities flow; by default the body's")
    load: Annotated[float, Number(LOAD, gt=0.0)] | None = optional("by default the scene's")
    positions: Positions | None = optional("positions on the trace one by one")
    stroke: Length | None = optional("range of the roller about its position; or `positions`")
    passes: Passes | None = optional("positions along the stroke; 15 by default")
    sweeps: Annotated[StrictInt, Field(ge=1, le=MOST_PASSES)] = optional("over all, at most", 10)

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        yield from self.unless_one_of(("positions", "stroke"))
        if self.positions is not None and self.passes is not None:
            problem = "is given beside positions, which are one pass each; allowed with stroke"
            yield "passes", problem

    def misfits(self, scene: SceneSection) -> Iterator[tuple[str, str]]:
        if scene.profile is None:
            yield "running_in", "is given for a smooth surface; allowed only with [profile]"
        if self.hardness is None and scene.body.hardness is None:
            where = "here or as body.hardness"
            yield "running_in.hardness", f"is missing; allowed is a pressure above 0, {where}"
        if self.load is None and scene.load.kind == "approach":
            problem = "is missing; allowed is a load per length, which load.approach is not"
            yield "running_in.load", problem

    def completed(self, scene: SceneSection) -> Self:
        passes = self.passes if self.stroke is None else self.passes or PASSES
        hardness = self.hardness or scene.body.hardness
        return self.model_copy(update={"hardness": hardness, "passes": passes})

    def travel(self, position: float) -> float:
        """Twice the roller's largest distance from `position` [m]: so much longer is a trace."""
        if self.stroke is not None:
            return self.stroke
        return 2.0 * float(np.abs(np.array(self.positions) - position).max())

    def places(self, position: float) -> tuple[float, ...]:
        """The roller's centre [m] on the trace, in order, where the scene's own is `position`."""
        if self.positions is not None:
            return self.positions
        return tuple((position + self.stroke * np.linspace(-0.5, 0.5, self.passes)).tolist())
