"""The [cycles] section: a roller pressed on again and again, or rolled over the body."""

from collections.abc import Iterator
from typing import Annotated, Self

from comparisons.scenes.fields import (
    Extent,
    ExtentField,
    Fraction,
    OneOf,
    SceneSection,
    Whole,
)

TRAVEL = Extent(4.0, in_half_widths=True)  # on a trace
# A smooth body that is rolled over takes a second or two a pass, and many to settle near the limit.
PASSES, ROLLING_PASSES = 5, 20


class CyclesSection(SceneSection):
    """Passes over a body that yields, at small strains, by finite elements."""

    # press: on the same place and off again | roll: over the body; a smooth one is endless, on a
    # trace the roller is pressed on, travels and is lifted
    kind: Annotated[str, OneOf(("press", "roll"))] = "press"
    passes: Annotated[int, Whole(1, 200)] | None = None
    travel: Annotated[Extent, ExtentField()] | None = None  # on a trace, about the roller's place
    # of the first pass's plastic strain: a pass that adds no more is taken to add none
    share: Fraction = 0.01
    levels: Annotated[int, Whole(1, 4)] = 2

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        if self.travel is not None and self.kind == "press":
            yield "travel", 'is given for kind = "press"; allowed with kind = "roll"'

    def completed(self, scene: SceneSection) -> Self:
        rolls, rough = self.kind == "roll", scene.profile is not None
        passes = self.passes or (ROLLING_PASSES if rolls and not rough else PASSES)
        travel = self.travel or (TRAVEL if rolls and rough else None)
        return self.model_copy(update={"passes": passes, "travel": travel})

    def misfits(self, scene: SceneSection) -> Iterator[tuple[str, str]]:
        settings, friction = scene.finite_element, max(scene.load.friction)
        if scene.body.yield_stress is None:
            yield (
                "cycles",
                "is given for a body that does not yield; allowed with body.yield_stress",
            )
        if scene.coating is not None:
            yield "cycles", "is given for a coated body; allowed without [coating]"
        if scene.load.kind == "approach":
            yield "cycles", "is given with load.approach; allowed with per_length"
        if settings.deformation == "finite":
            problem = 'is of small strains; allowed with finite_element.deformation = "linear"'
            yield "cycles", problem
        if settings.far_field == "half-plane":
            yield "cycles", 'needs a body that ends; allowed with finite_element.far_field = "held"'
        if settings.coupled is False and friction:
            yield "cycles", "couples friction; allowed without finite_element.coupled = false"
        if self.kind == "roll" and settings.roller_body == "disc":
            problem = 'is "roll" for a disc; allowed with finite_element.roller_body = "half-plane"'
            yield "cycles.kind", problem
        if self.kind == "roll" and scene.profile is None:
            endless = "an endless body"
            if self.travel is not None:
                problem = f"is given for a smooth body, which is {endless}; allowed with [profile]"
                yield "cycles.travel", problem
            if scene.body.width is not None:
                yield (
                    "body.width",
                    f'is given where cycles.kind = "roll" takes {endless}; allowed without',
                )


SECTION = CyclesSection
