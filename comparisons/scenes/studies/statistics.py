"""The [statistics] section: theories of rough contact beside the solved one."""

from collections.abc import Iterator
from typing import Annotated

from comparisons.common.units import LENGTH
from comparisons.scenes.fields import Number, OneOf, SceneSection, Several, Truth, Whole

METALS = ("ferrous", "nonferrous")


class StatisticsSection(SceneSection):
    """Random traces, cut-offs of the table of summits, and which thresholds of h/R hold."""

    STEP = "statistics of rough contact"
    traces: Annotated[int, Whole(4, 256)] = 8
    seed: Annotated[int, Whole(0, 2**32 - 1)] = 0
    cutoffs: Annotated[tuple[float, ...], Several(Number(LENGTH, above=0.0))] | None = None
    metal: Annotated[str, OneOf(METALS)] = METALS[0]
    lubricated: Annotated[bool, Truth()] = False

    def misfits(self, scene: SceneSection) -> Iterator[tuple[str, str]]:
        if scene.profile is None:
            yield "statistics", "is given for a smooth surface; allowed only with [profile]"


SECTION = StatisticsSection
