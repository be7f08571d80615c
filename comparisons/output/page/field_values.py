"""The fields as numbers in the page, for a reader who points at a picture or cuts a section.

Integers of two bytes at some of the window's points: the half-plane's field, and its difference
from the other model that pictures show. A scale of its own preserves the difference's digits; the
page computes the other model's field from both."""

import base64
import json
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from comparisons.common.numbers import plain
from comparisons.figures.quantity import LABELS
from comparisons.output.page.pictures.stresses import COMPONENTS, Component
from comparisons.studies.study import Run

if TYPE_CHECKING:
    from markupsafe import Markup

MOST_ROWS, MOST_COLUMNS = 48, 480  # of points in the page
WHOLE = 32767  # the largest of two bytes
NOTHING = -32768  # where a field has no value
DIGITS = 6  # of a place


@dataclass(frozen=True)
class Explorer:
    """What the page needs to show values."""

    components: list[tuple[str, str]]  # symbol and words, that the reader may choose
    frictions: list[str]  # the same
    fields: "Markup"  # JSON


def field_explorer(run: Run) -> Explorer | None:
    """None without fields."""
    if run.window is None:
        return None
    from markupsafe import Markup

    half_width, window = run.problem.hertz.half_width, run.window
    rows, columns = _spread(len(window.z), MOST_ROWS), _spread(len(window.x), MOST_COLUMNS)
    frictions = run.problem.scene.load.friction
    last = list(run.levels(frictions[-1]).values())[-1]
    largest = last.stress(frictions[-1]).extremes["tau1"]
    content = {
        "x": _places(window.x[columns] / half_width),
        "z": _places(window.z[rows] / half_width),
        "start": {"x": largest.x / half_width, "z": largest.z / half_width},
        "components": [
            {
                "symbol": component.symbol,
                "fields": [_field(run, component, mu, rows, columns) for mu in frictions],
            }
            for component in COMPONENTS
        ],
    }
    fields = Markup(json.dumps(content, separators=(",", ":")).replace("<", "\\u003c"))
    components = [(component.symbol, component.words) for component in COMPONENTS]
    return Explorer(components, list(map(plain, frictions)), fields)


def _spread(count: int, most: int) -> np.ndarray:
    """Indices of all points, or of every other, third, … one; the last of all is among them."""
    step = -(-(count - 1) // (most - 1))
    return np.arange((count - 1) % step, count, step) if step > 1 else np.arange(count)


def _places(values: np.ndarray) -> list[float]:
    return [float(f"{value:.{DIGITS}g}") for value in values]


def _field(
    run: Run, component: Component, friction: float, rows: np.ndarray, columns: np.ndarray
) -> dict:
    p0 = run.problem.hertz.peak_pressure
    pair = run.pair(friction)
    first, *others = (
        component.of(level.stress(friction).field)[np.ix_(rows, columns)] / p0
        for level in pair.values()
    )
    packed = [_packed(values) for values in (first, *(first - other for other in others))]
    return {
        "models": [LABELS[name] for name in pair],
        "scale": [scale for scale, _ in packed],
        "data": [text for _, text in packed],
    }


def _packed(values: np.ndarray) -> tuple[float, str]:
    """A scale, and the whole multiples of it that a field (m, k) is, row after row."""
    top = float(np.nanmax(np.abs(values), initial=0.0))
    scale = top / WHOLE or 1.0
    whole = np.where(np.isnan(values), NOTHING, np.rint(np.nan_to_num(values) / scale))
    return scale, base64.b64encode(whole.astype("<i2").tobytes()).decode("ascii")
