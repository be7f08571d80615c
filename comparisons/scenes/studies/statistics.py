"""The [statistics] section: theories of rough contact beside the solved one."""

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field, StrictBool, StrictInt

from comparisons.scenes.fields import Length, SceneSection, Several, optional

METALS = ("ferrous", "nonferrous")


class StatisticsSection(SceneSection):
    """Theories of rough contact beside the solved one. It needs `[profile]`."""

    STEP = "statistics of rough contact"
    traces: Annotated[StrictInt, Field(ge=4, le=256)] = Field(
        8, description="random ones with the profile's spectrum that are solved"
    )
    seed: Annotated[StrictInt, Field(ge=0, le=2**32 - 1)] = Field(0, description="of these traces")
    cutoffs: Annotated[tuple[Length, ...], Several()] | None = optional(
        "filters under which summits are counted; chosen by default"
    )
    metal: Literal[METALS] = Field(
        METALS[0], description="of the body: h/R up to which an asperity is elastic"
    )
    lubricated: StrictBool = Field(
        False, description="whether it is: h/R from which an asperity cuts"
    )

    def misfits(self, scene: SceneSection) -> Iterator[tuple[str, str]]:
        if scene.profile is None:
            yield "statistics", "is given for a smooth surface; allowed only with [profile]"


SECTION = StatisticsSection
