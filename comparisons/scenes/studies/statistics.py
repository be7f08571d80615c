"""The [statistics] section: theories of rough contact beside the solved one."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field, StrictBool, StrictInt

from comparisons.scenes.fields import Length, SceneSection, Several, optional

METALS = ("ferrous", "nonferrous")


class StatisticsSection(SceneSection):
    """Theories of rough contact beside the solved one. It needs `[profile]`."""

    STEP = "statistics of rough contact"
    traces: Annotated[StrictInt, Field(ge=4, le=256)] = optional(
        "random ones with the profile's spectrum that are solved", 8
    )
    seed: Annotated[StrictInt, Field(ge=0, le=2**32 - 1)] = optional("of these traces", 0)
    cutoffs: Annotated[tuple[Length, ...], Several()] | None = optional(
        "filters under which summits are counted; chosen by default"
    )
    metal: Literal[METALS] = optional("of the body, for the h/R of elastic asperities", METALS[0])
    lubricated: StrictBool = optional("whether it is: h/R from which an asperity cuts", False)

    def misfits(self, scene: SceneSection) -> Iterator[tuple[str, str]]:
        if scene.profile is None:
            yield "statistics", "is given for a smooth surface; allowed only with [profile]"


SECTION = StatisticsSection
