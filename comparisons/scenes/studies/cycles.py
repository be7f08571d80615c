"""The [cycles] section: a roller pressed on again and again, or rolled over the body."""

from collections.abc import Iterator
from typing import Annotated

from comparisons.scenes.fields import (
    Extent,
    ExtentField,
    Fraction,
    OneOf,
    SceneSection,
    Whole,
)

TRAVEL = Extent(4.0, in_half_widths=True)


class CyclesSection(SceneSection):
    """Passes over a body that yields, at small strains, by finite elements."""

    # press: on the same place and off again | roll: pressed on, over the body, and off
    kind: Annotated[str, OneOf(("press", "roll"))] = "press"
    passes: Annotated[int, Whole(1, 100)] = 5
    travel: Annotated[Extent, ExtentField()] | None = None  # of "roll", about the roller's place
    # of the first pass's plastic strain: a pass that adds no more is taken to add none
    share: Fraction = 0.01
    levels: Annotated[int, Whole(1, 4)] = 2

    def distance(self, half_width: float) -> float:
        """What the roller travels [m] where the Hertz half-width is `half_width` [m]."""
        return (self.travel or TRAVEL).metres(half_width) if self.kind == "roll" else 0.0

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        if self.travel is not None and self.kind == "press":
            yield "travel", 'is given for kind = "press"; allowed with kind = "roll"'

    def misfits(self, scene: SceneSection) -> Iterator[tuple[str, str]]:
        settings, friction = scene.finite_element, max(scene.load.friction)
        if scene.body.yield_stress is None:
            yield "cycles", "is given for a body that does not yield; allowed with body.yield_stress"
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
        if settings.roller_body == "disc" and self.kind == "roll":
            problem = 'rolls a half-plane\'s body; allowed with roller_body = "half-plane"'
            yield "cycles.kind", problem


SECTION = CyclesSection
