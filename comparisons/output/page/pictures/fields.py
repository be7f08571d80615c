"""Subsurface fields of the half-plane and of the whole model, or of the finite elements where there
is no other, on one colour scale; and their difference on its own."""

import json
from collections.abc import Callable
from dataclasses import dataclass
from operator import sub
from typing import TYPE_CHECKING

import numpy as np

from analytic.stress_state import Extremum, StressState
from comparisons.common.numbers import decimal, plain, significant
from comparisons.drawing.field import (
    COVERED,
    ColourScale,
    FieldPanel,
    draw_fields,
    height_to_scale,
    round_bands,
    signed_scale,
)
from comparisons.drawing.style import Picture, picture
from comparisons.figures.quantity import LABELS, WHOLE
from comparisons.studies.study import Run

if TYPE_CHECKING:
    from matplotlib.axes import Axes

NEAR = 0.1  # half-widths: depth of the pictures next to the surface
STRETCHED = 1.25  # inches: their height
FEWEST_ROWS = 4


@dataclass(frozen=True)
class Component:
    """A drawn stress: name in result files, sign and words in the page, colours of its bands."""

    name: str
    symbol: str
    words: str
    colours: str
    signed: bool
    of: Callable[[StressState], np.ndarray]


COMPONENTS = (
    Component("tau1", "τ₁", "principal shear stress", "viridis", False, lambda s: s.tau1),
    Component("txz", "τxz", "orthogonal shear stress", "RdBu_r", True, lambda s: s.txz),
)


@dataclass(frozen=True)
class FieldView:
    """What a picture shows: the window's first `rows` depths, drawn `height` inches tall."""

    rows: int
    height: float
    words: str


def field_pictures(outcome: Run) -> list[Picture]:
    """Of each component one for every friction coefficient; nothing without fields."""
    window = outcome.window
    if window is None:
        return []
    view = FieldView(len(window.z), height_to_scale(window.x, window.z), "under the contact")
    drawn = (_pictures(outcome, component, view) for component in COMPONENTS)
    return [one for pictures in drawn for one in pictures]


def near_surface_pictures(outcome: Run) -> list[Picture]:
    """The principal shear next to a rough surface, depths stretched; one a friction coefficient."""
    window = outcome.window
    if window is None or outcome.problem.scene.profile is None:
        return []
    rows = int(np.count_nonzero(window.z <= NEAR * outcome.problem.hertz.half_width))
    if rows < FEWEST_ROWS or rows == len(window.z):
        return []
    return _pictures(outcome, COMPONENTS[0], FieldView(rows, STRETCHED, "next to the surface"))


def _pictures(outcome: Run, component: Component, view: FieldView) -> list[Picture]:
    """One a friction coefficient, all on the same colour scales."""
    p0 = outcome.problem.hertz.peak_pressure
    fields = [
        {
            name: component.of(level.stress(friction).field)[: view.rows] / p0
            for name, level in outcome.pair(friction).items()
        }
        for friction in outcome.problem.scene.load.friction
    ]
    bands = round_bands([f for models in fields for f in models.values()], component.signed)
    differences = [sub(*models.values()) for models in fields if len(models) > 1]
    other_bands = round_bands(differences, signed=True) if differences else None
    return [
        _picture(outcome, friction, component, view, models, bands, other_bands)
        for friction, models in zip(outcome.problem.scene.load.friction, fields, strict=True)
    ]


def _picture(
    outcome: Run,
    friction: float,
    component: Component,
    view: FieldView,
    fields: dict[str, np.ndarray],
    bands: np.ndarray,
    difference_bands: np.ndarray | None,
) -> Picture:
    hertz, window = outcome.problem.hertz, outcome.window
    x, z = window.x / hertz.half_width, window.z[: view.rows] / hertz.half_width
    panels, levels = [], outcome.pair(friction)
    for name, values in fields.items():
        extreme = levels[name].stress(friction).extremes[component.name]
        mark = extreme.x / hertz.half_width, extreme.z / hertz.half_width
        title = f"{LABELS[name]}: {_largest(outcome, extreme, component)}"
        inside = extreme.z <= window.z[view.rows - 1]
        panels.append(FieldPanel(title, values, mark if inside else None))
    difference, largest = None, ""
    if len(fields) > 1:
        names, of_two = " − ".join(LABELS[name] for name in fields), sub(*fields.values())
        difference = names, signed_scale(f"Δ{component.symbol}/p₀", difference_bands)
        largest = f" {_difference_said(x, z, of_two, difference_bands[-1])}"
    scale = ColourScale(f"{component.symbol}/p₀", bands, component.colours, component.signed)
    drawn, places = draw_fields(x, z, panels, scale, view.height, difference)
    said = "; ".join(panel.title for panel in panels)
    words = f"{component.words.capitalize()} {component.symbol} {view.words}"
    striped = ", stripes what is negative" if component.signed or largest else ""
    cut = any(np.isnan(values).any() for values in fields.values())
    largest += " White: hollows below the mean line, from which z counts." if cut else ""
    if WHOLE in fields:
        largest += " Of the whole model each point stands where it was before loading."
    pointed = {
        "component": COMPONENTS.index(component),
        "friction": outcome.problem.scene.load.friction.index(friction),
        "boxes": [_box(place) for place in places],
        "x": [round(float(end), 6) for end in x[[0, -1]]],
        "z": [round(float(end), 6) for end in z[[0, -1]]],
    }
    words += f", friction {plain(friction)}"
    caption = f"{words}; + marks the largest value{striped}.{largest}"
    return picture(
        drawn, f"{words}. {said}.{largest}", caption, data=False, field=json.dumps(pointed)
    )


def _box(axes: "Axes") -> list[float]:
    """Left, top, width and height of a field as shares of the picture, from its upper left."""
    place = axes.get_position()
    return [round(v, 4) for v in (place.x0, 1.0 - place.y1, place.width, place.height)]


def _difference_said(x: np.ndarray, z: np.ndarray, difference: np.ndarray, end: float) -> str:
    """Where the colours of the difference end, why there, and its largest value."""
    row, column = np.unravel_index(np.nanargmax(np.abs(difference)), difference.shape)
    largest = difference[row, column]
    covers = f", which covers {COVERED:g} % of the points or more, to show what is small"
    reason = covers if abs(largest) > end else ""
    return (
        f"The difference's colours end at ±{significant(end, 2)} p₀{reason}; the largest "
        f"difference at a point of the grid, {significant(largest, 2)} p₀, stands at "
        f"x = {decimal(x[column])} a, z = {significant(z[row], 2)} a."
    )


def _largest(outcome: Run, extreme: Extremum, component: Component) -> str:
    hertz = outcome.problem.hertz
    word = f"largest |{component.symbol}|" if component.signed else "largest"
    return (
        f"{word} {significant(abs(extreme.value) / hertz.peak_pressure)} p₀ at "
        f"x = {decimal(extreme.x / hertz.half_width)} a, "
        f"z = {significant(extreme.z / hertz.half_width, 3)} a"
    )
