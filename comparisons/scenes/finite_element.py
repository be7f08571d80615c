"""The [finite_element] section: which of the half-plane's assumptions the finite elements keep."""

import math
from collections.abc import Iterator
from typing import Annotated, Literal, Self

from pydantic import StrictBool

from comparisons.common.units import DIMENSIONLESS
from comparisons.scenes.fields import Number, SceneSection, optional

BLOCK = 400.0  # half-widths: what a fixed boundary there does to stresses is below 0.3 %
# Poisson's ratio beyond which cubic elements are the default: at 0.4999 quadratic ones leave
# stresses at the edge of a contact half as large again as the largest below it.
QUADRATIC_UP_TO = 0.49


class FiniteElementSection(SceneSection):
    """Which of the half-plane's assumptions the finite elements keep."""

    roller_shape: Literal["parabola", "circle"] = optional("parabola or exact circle", "parabola")
    roller_body: Literal["half-plane", "disc"] = optional(
        "body of an elastic roller: a half-plane, or a sector of its disc", "half-plane"
    )
    coupled: StrictBool | None = optional(
        "sliding traction moves the surfaces; by default as `load.coupled`, and with "
        "friction at finite deformation and where a body flows"
    )
    deformation: Literal["linear", "finite"] = optional(
        "small, with the roughness in the gap; or finite strains of body and roller, "
        "the trace as boundary, the gap on the deformed surface",
        "linear",
    )
    plastic: StrictBool | None = optional(
        "the body flows at `body.yield_stress`; false: elastic bodies are the "
        "question; without it flow is computed where it may matter"
    )
    element: Literal["P1", "P2", "P3"] | None = optional(
        "degree of the displacements; by default P3 above a Poisson's ratio of 0.49 "
        "in a linear body, else P2"
    )
    block: Annotated[float, Number(DIMENSIONLESS, ge=10.0, le=5000.0)] = optional(
        "half-widths that stand for an unbounded body, which ends at a fixed boundary", BLOCK
    )
    growth: Annotated[float, Number(DIMENSIONLESS, ge=0.05, le=0.5)] = optional(
        "of element size per distance from the contact", 0.2
    )

    def broken_rules(self) -> Iterator[tuple[str, str]]:
        if self.nonlinear and self.element not in (None, "P2"):
            cause = "finite_element.deformation" if self.deformation == "finite" else "plastic"
            yield "element", f'is "{self.element}" with {cause}; allowed there is "P2"'

    @property
    def nonlinear(self) -> bool:
        return self.deformation == "finite" or bool(self.plastic)

    @property
    def degree(self) -> int:
        """Degree of the displacements' polynomials."""
        return int(self.element[1:])

    @property
    def most_order(self) -> float:
        """Highest order of pressures and stresses: linear elements have the first alone."""
        return 1.0 if self.element == "P1" else math.inf

    def completed(self, scene: SceneSection) -> Self:
        bodies = [body for body in (scene.roller, scene.body, scene.coating) if body is not None]
        largest = max(body.poissons_ratio for body in bodies if body.poissons_ratio is not None)
        update: dict[str, object] = {}
        if self.element is None:
            cubic = largest > QUADRATIC_UP_TO and not self.nonlinear
            update["element"] = "P3" if cubic else "P2"
        if self.coupled is None:
            # where [load] says so of both models, at finite deformation, and where a body flows
            slides = max(scene.load.friction) > 0.0
            update["coupled"] = scene.load.coupled or (self.nonlinear and slides)
        return self.model_copy(update=update)

    def misfits(self, scene: SceneSection) -> Iterator[tuple[str, str]]:
        coupled, flow = "finite_element.coupled", "finite_element.plastic"
        apart = max(scene.load.friction) > 0.0 and self.coupled is False
        if self.roller_body == "disc" and scene.roller.rigid:
            problem = 'is "disc", but the roller is rigid; allowed with an elastic one'
            yield "finite_element.roller_body", problem
        if self.deformation == "finite" and scene.linear:
            problem = 'is "finite" with law = "linear"; allowed is another law, or "linear"'
            yield "finite_element.deformation", problem
        if self.plastic and scene.body.yield_stress is None:
            yield flow, "is true, but the body has no yield stress; allowed with one"
        if self.deformation == "finite" and apart:
            yield coupled, "is false at finite deformation with friction; allowed is true"
        if self.plastic and scene.load.kind == "approach":
            yield flow, "is true with load.approach; allowed with per_length"
        if self.plastic and apart:
            yield coupled, "is false for a body that yields under friction; allowed is true"
