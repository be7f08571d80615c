"""The error budget as stacked bars, one for each quantity: numerics, sampling, and every effect."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from comparisons.assessment.effects.catalogue import EFFECTS
from comparisons.common.numbers import given_percent
from comparisons.common.quantities import QUANTITIES, label
from comparisons.report.figures import style
from comparisons.report.tables.text import error_text, grouped, listed
from comparisons.results.outcome import Outcome

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

BAR, HEAD, FOOT = 0.27, 0.78, 0.56  # inches: a bar, the legend, an axis with its label
LEFT, RIGHT = 3.3, 0.25  # inches
EMPTY = 1.15  # of the longest bar, where an axis ends
NOT_MODELLED = "not modelled (estimate)"
INK = "#000000"
# Colour and hatch of each part. Okabe and Ito's colours for effects, greys for what is numerical or
# an estimate; hatched where two of them would be one in grey.
PART_LOOKS: dict[str, tuple[str, str]] = {
    "iteration": ("#333333", ""),
    "half-plane's discretisation": ("#808080", ""),
    "finite elements' discretisation": ("#b5b5b5", "////"),
    "far boundary": ("#d9d9d9", "...."),
    "sampling": ("#ffffff", "||||"),
    "finite_size": ("#0072B2", ""),
    "coating": ("#56B4E9", "xxxx"),
    "rough_boundary": ("#009E73", "\\\\\\\\"),
    "deformed_gap": ("#E69F00", ""),
    "exact_circle": ("#F0E442", ""),
    "finite_roller": ("#CC79A7", "oo"),
    "normal_tangential_coupling": ("#56B4E9", "++"),
    "finite_strain": ("#D55E00", "xx"),
    "plastic_flow": ("#F0E442", "\\\\\\\\"),
    "interaction": ("#f2e2d0", "----"),
    NOT_MODELLED: ("#ffffff", "////"),
}


@dataclass(frozen=True)
class ErrorBar:
    """A quantity at one or more friction coefficients.

    parts        relative sizes without sign, by what they come from
    error        model error of the half-plane with its `uncertainty`
    """

    quantity: str
    name: str
    parts: dict[str, float]
    error: float
    uncertainty: float
    tolerance: float | None

    @property
    def is_norm(self) -> bool:
        return QUANTITIES[self.quantity].of_pair


def model_error_picture(outcome: Outcome) -> style.Picture | None:
    """Judged quantities, other figures and norms, each on its own scale; None with one model."""
    if outcome.budget is None:
        return None
    bars = error_bars(outcome)
    judged = [bar for bar in bars if bar.tolerance]
    figures = [bar for bar in bars if not bar.tolerance and not bar.is_norm]
    norms = [bar for bar in bars if not bar.tolerance and bar.is_norm]
    panels = [panel for panel in (judged, figures, norms) if panel]
    heights = [(FOOT if place else HEAD, BAR * len(panel)) for place, panel in enumerate(panels)]
    drawn = style.figure(style.WIDE, sum(map(sum, heights)) + FOOT)
    for axes, panel in zip(style.stacked(drawn, heights, LEFT, RIGHT), panels, strict=True):
        _draw(axes, panel)
    present = [name for name in PART_LOOKS if any(bar.parts.get(name) for bar in bars)]
    _legend(drawn, present, bool(judged))
    said = "; ".join(
        f"{bar.name}: {error_text(bar.quantity, bar.error, bar.uncertainty)}, "
        f"tolerance {given_percent(bar.tolerance)}"
        for bar in judged
    )
    return style.Picture(
        source=style.data_uri(drawn),
        alternative=f"Stacked bars of the half-plane's errors. Model error of {said}.",
        caption="Errors of the half-plane by their source, in per cent of the finite elements' "
        "figure: sizes without their signs, side by side. Grey: numerical, or from the sampling of "
        "the trace; colour: effects that the half-plane does not model. Diamond: model error, to "
        "which the effects add with their signs, and its uncertainty; upright line: tolerance.",
        wide=True,
    )


def error_bars(outcome: Outcome) -> list[ErrorBar]:
    """One for each quantity and friction coefficient; coefficients of equal figures together."""
    scene, bars = outcome.problem.scene, []
    for quantity, errors in outcome.result["model_error"].items():
        budget = outcome.result["error_budget"]["quantities"][quantity]
        parts = {entry["friction"]: _numerical(entry) for entry in budget}
        for error in errors:
            parts[error["friction"]] |= _effects(error)
        for same in grouped(
            errors, lambda e, p=parts: (tuple(p[e["friction"]].items()), e["value"])
        ):
            frictions = [error["friction"] for error in same]
            some = len(frictions) < len(scene.friction)
            name = label(quantity) + (f", μ = {listed(frictions)}" if some else "")
            error = same[0]["value"], same[0]["uncertainty"] or 0.0
            tolerance = scene.tolerance.get(quantity)
            bars.append(ErrorBar(quantity, name, parts[frictions[0]], *error, tolerance))
    return bars


def _numerical(entry: dict) -> dict[str, float]:
    """Of an entry of the error budget."""
    found, models = {}, entry.get("numerical") or {}
    if models and None not in models.values():
        one, other = models["half_plane"], models["finite_element"]
        found = {
            "iteration": one["iteration"] + other["iteration"],
            "half-plane's discretisation": one["discretisation"] or 0.0,
            "finite elements' discretisation": other["discretisation"] or 0.0,
            "far boundary": one["domain"] + other["domain"],
        }
    return found | {"sampling": entry["input"] or 0.0}


def _effects(error: dict) -> dict[str, float]:
    """Of a model error."""
    effects = error["effects"]
    return {
        **{name: abs(effects[name]["value"]) if name in effects else 0.0 for name in EFFECTS},
        "interaction": abs(error["interaction"]),
        NOT_MODELLED: float(np.sqrt(sum(size**2 for size in error["not_modelled"].values()))),
    }


def _look(part: str) -> dict:
    colour, hatch = PART_LOOKS[part]
    return {"facecolor": colour, "hatch": hatch, "edgecolor": "#333333", "linewidth": 0.5}


def _draw(axes: "Axes", bars: list[ErrorBar]) -> None:
    place = -np.arange(len(bars), dtype=float)
    ends = []
    for y, bar in zip(place, bars, strict=True):
        start = 0.0
        for part in PART_LOOKS:
            width = 100.0 * bar.parts.get(part, 0.0)
            if width > 0.0:  # each would still take a kilobyte of the page
                axes.barh(y, width, left=start, height=0.66, **_look(part))
                start += width
        error, uncertainty = 100.0 * abs(bar.error), 100.0 * bar.uncertainty
        ends_of = {"xerr": [[min(uncertainty, error)], [uncertainty]], "capsize": 2.5}
        diamond = {"fmt": "D", "markersize": 4.0, "color": INK, "markerfacecolor": "#ffffff"}
        axes.errorbar(error, y, **ends_of, **diamond, elinewidth=0.9, zorder=4)
        ends += [start, error + uncertainty]
        if bar.tolerance:
            axes.plot([100.0 * bar.tolerance] * 2, [y - 0.46, y + 0.46], color=INK, lw=2.0)
            ends.append(100.0 * bar.tolerance)
    axes.set_xlim(0.0, EMPTY * max(ends))
    style.horizontal_bars(axes, place, [bar.name for bar in bars])
    axes.set_xlabel(f"per cent of the finite elements' {'norm' if bars[0].is_norm else 'figure'}")


def _legend(drawn: "Figure", present: list[str], tolerance: bool) -> None:
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    handles = [
        Patch(**_look(part), label=EFFECTS[part].label if part in EFFECTS else part)
        for part in present
    ]
    diamond = {"marker": "D", "markerfacecolor": "#ffffff", "label": "model error"}
    handles.append(Line2D([], [], color=INK, **diamond))
    if tolerance:
        handles.append(Line2D([], [], color=INK, lw=2.0, label="tolerance"))
    drawn.legend(handles=handles, loc="upper left", ncols=5, borderaxespad=0.3)
