"""Subsurface fields of both models on one colour scale, and their difference on its own."""

import json
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from analytic.stress_state import Extremum, StressState
from comparisons.common.model_names import LABELS
from comparisons.common.numbers import decimal, plain, significant
from comparisons.report.figures.field_layout import (
    COVERED,
    WIDTH,
    colour_bar,
    cross,
    fill,
    layout,
    round_bands,
)
from comparisons.report.figures.style import Picture, data_uri
from comparisons.results.outcome import Outcome

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LOW, TALL = 0.9, 2.6  # inches: least and greatest height of a field
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
DIFFERENCE_COLOURS = "PuOr_r"


@dataclass(frozen=True)
class View:
    """What a picture shows: the window's first `rows` depths, drawn `height` inches tall."""

    rows: int
    height: float
    words: str


def field_pictures(outcome: Outcome) -> list[tuple[float, list[Picture]]]:
    """For every friction coefficient a picture of each component; nothing without fields."""
    window = outcome.window
    if window is None:
        return []
    height = float(np.clip(WIDTH * np.ptp(window.z) / np.ptp(window.x), LOW, TALL))
    view = View(len(window.z), height, "under the contact")
    by_component = [_pictures(outcome, component, view) for component in COMPONENTS]
    return [
        (friction, [pictures[k] for pictures in by_component])
        for k, friction in enumerate(outcome.problem.scene.friction)
    ]


def near_surface_pictures(outcome: Outcome) -> list[Picture]:
    """The principal shear next to a rough surface, depths stretched; one a friction coefficient."""
    window = outcome.window
    if window is None or outcome.problem.scene.profile is None:
        return []
    rows = int(np.count_nonzero(window.z <= NEAR * outcome.problem.hertz.half_width))
    if rows < FEWEST_ROWS or rows == len(window.z):
        return []
    return _pictures(outcome, COMPONENTS[0], View(rows, STRETCHED, "next to the surface"))


def _pictures(outcome: Outcome, component: Component, view: View) -> list[Picture]:
    """One a friction coefficient, all on the same colour scales."""
    p0 = outcome.problem.hertz.peak_pressure
    fields = [
        {
            name: component.of(run.finest.stress(friction).field)[: view.rows] / p0
            for name, run in outcome.runs.items()
        }
        for friction in outcome.problem.scene.friction
    ]
    bands = round_bands([f for models in fields for f in models.values()], component.signed)
    differences = [
        models["half_plane"] - models["finite_element"] for models in fields if len(models) > 1
    ]
    other_bands = round_bands(differences, signed=True) if differences else None
    return [
        _picture(outcome, friction, component, view, models, bands, other_bands)
        for friction, models in zip(outcome.problem.scene.friction, fields, strict=True)
    ]


def _picture(
    outcome: Outcome,
    friction: float,
    component: Component,
    view: View,
    fields: dict[str, np.ndarray],
    bands: np.ndarray,
    difference_bands: np.ndarray | None,
) -> Picture:
    hertz, window = outcome.problem.hertz, outcome.window
    x, z = window.x / hertz.half_width, window.z[: view.rows] / hertz.half_width
    drawn, places, bars = layout(len(fields), view.height)
    found = []
    for place, (name, values) in zip(places, fields.items(), strict=False):
        extreme = outcome.runs[name].finest.stress(friction).extremes[component.name]
        shown = fill(place, x, z, values, bands, component.colours, component.signed)
        if extreme.z <= window.z[view.rows - 1]:
            cross(place, extreme.x / hertz.half_width, extreme.z / hertz.half_width)
        found.append(f"{LABELS[name]}: {_largest(outcome, extreme, component)}")
        place.set_title(found[-1])
    colour_bar(drawn, bars[0], shown, f"{component.symbol}/p₀", bands)
    largest = ""
    if len(fields) > 1:
        difference = fields["half_plane"] - fields["finite_element"]
        shown = fill(places[-1], x, z, difference, difference_bands, DIFFERENCE_COLOURS, True)
        largest = f" {_difference_said(x, z, difference, difference_bands[-1])}"
        places[-1].set_title("half-plane − finite elements")
        colour_bar(drawn, bars[1], shown, f"Δ{component.symbol}/p₀", difference_bands)
    places[-1].set_xlabel("x/a")
    words = f"{component.words.capitalize()} {component.symbol} {view.words}"
    pointed = {
        "component": COMPONENTS.index(component),
        "friction": outcome.problem.scene.friction.index(friction),
        "boxes": [_box(place) for place in places],
        "x": [round(float(end), 6) for end in x[[0, -1]]],
        "z": [round(float(end), 6) for end in z[[0, -1]]],
    }
    return Picture(
        source=data_uri(drawn),
        alternative=f"{words}, friction {plain(friction)}. {'; '.join(found)}.{largest}",
        caption=(
            f"{words}, friction {plain(friction)}; + marks the largest value"
            f"{', stripes what is negative' if component.signed or largest else ''}.{largest}"
        ),
        field=json.dumps(pointed),
    )


def _box(axes: "Axes") -> list[float]:
    """Left, top, width and height of a field as shares of the picture, from its upper left."""
    place = axes.get_position()
    return [round(v, 4) for v in (place.x0, 1.0 - place.y1, place.width, place.height)]


def _difference_said(x: np.ndarray, z: np.ndarray, difference: np.ndarray, end: float) -> str:
    """Where the colours of the difference end, why there, and its largest value."""
    row, column = np.unravel_index(np.nanargmax(np.abs(difference)), difference.shape)
    largest = difference[row, column]
    reason = (
        f", which covers {COVERED:g} % of the points or more, to show what is small"
        if abs(largest) > end
        else ""
    )
    return (
        f"The difference's colours end at ±{significant(end, 2)} p₀{reason}; the largest "
        f"difference at a point of the grid, {significant(largest, 2)} p₀, stands at "
        f"x = {decimal(x[column])} a, z = {significant(z[row], 2)} a."
    )


def _largest(outcome: Outcome, extreme: Extremum, component: Component) -> str:
    hertz = outcome.problem.hertz
    word = f"largest |{component.symbol}|" if component.signed else "largest"
    return (
        f"{word} {significant(abs(extreme.value) / hertz.peak_pressure)} p₀ at "
        f"x = {decimal(extreme.x / hertz.half_width)} a, "
        f"z = {significant(extreme.z / hertz.half_width, 3)} a"
    )
