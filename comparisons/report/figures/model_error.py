"""The error budget as stacked bars, one for each quantity: numerics, input, and every effect."""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from comparisons.assessment.effects.catalogue import EFFECTS
from comparisons.common.numbers import given_percent, percent, plain
from comparisons.common.quantities import QUANTITIES, label
from comparisons.report.figures.style import WIDE, Picture, data_uri, figure
from comparisons.results.outcome import Outcome

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

BAR, HEAD, FOOT = 0.27, 0.78, 0.56  # inches: a bar, the legend, an axis with its label
LEFT, RIGHT = 3.3, 0.25  # inches
EMPTY = 1.15  # of the longest bar, where an axis ends
# Okabe and Ito's colours for effects, greys for what is numerical or an estimate; hatched where two
# of them would be one in grey.
LOOKS: dict[str, tuple[str, str]] = {
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
    "estimated only": ("#ffffff", "////"),
}


@dataclass(frozen=True)
class Bar:
    """Of one quantity at one or more friction coefficients: sizes [-] by what they come from."""

    name: str
    parts: dict[str, float]
    own: float
    uncertainty: float
    tolerance: float | None
    is_norm: bool


def budget_picture(outcome: Outcome) -> Picture | None:
    """Judged quantities, other figures and norms, each on a scale of its own; None with one
    model."""
    if outcome.budget is None:
        return None
    bars = budget_bars(outcome)
    sorts = (
        [bar for bar in bars if bar.tolerance],
        [bar for bar in bars if not bar.tolerance and not bar.is_norm],
        [bar for bar in bars if not bar.tolerance and bar.is_norm],
    )
    panels = [panel for panel in sorts if panel]
    tall = HEAD + sum(BAR * len(panel) + FOOT for panel in panels)
    drawn = figure(WIDE, tall)
    edge = tall - HEAD
    for panel in panels:
        height = BAR * len(panel)
        edge -= height
        box = (LEFT / WIDE, edge / tall, (WIDE - LEFT - RIGHT) / WIDE, height / tall)
        _draw(drawn.add_axes(box), panel)
        edge -= FOOT
    present = [name for name in LOOKS if any(b.parts.get(name) for b in bars)]
    _legend(drawn, present, any(b.tolerance for b in bars))
    said = "; ".join(
        f"{bar.name}: own error {_own(bar)}, tolerance {given_percent(bar.tolerance)}"
        for bar in bars
        if bar.tolerance is not None
    )
    return Picture(
        source=data_uri(drawn),
        alternative=f"Stacked bars of what separates the two models and the truth. {said}.",
        caption="What may separate the half-plane from the truth, in per cent of the finite "
        "elements' figure: sizes without their signs, side by side. In grey what is numerical or "
        "owed to the trace, in colour what the half-plane lacks. Diamond: its own error, the "
        "effects with their signs, with its uncertainty; upright line: tolerance.",
        wide=True,
    )


def _own(bar: Bar) -> str:
    return percent(bar.own, signed=not bar.is_norm, uncertainty=bar.uncertainty)


def budget_bars(outcome: Outcome) -> list[Bar]:
    """One for each quantity and friction coefficient; coefficients of equal figures together."""
    rows = outcome.result["model_error"]
    alike: dict[tuple, tuple[Bar, list[float]]] = {}
    for quantity, entries in rows.items():
        for entry in entries:
            bar = _bar(outcome, quantity, entry)
            key = (quantity, tuple(bar.parts.items()), bar.own)
            alike.setdefault(key, (bar, []))[1].append(entry["friction"])
    several = len(outcome.problem.scene.friction) > 1
    bars = []
    for (quantity, *_), (bar, frictions) in alike.items():
        name = label(quantity)
        if several and len(frictions) < len(outcome.problem.scene.friction):
            name += f", μ = {', '.join(plain(friction) for friction in frictions)}"
        bars.append(replace(bar, name=name))
    return bars


def _bar(outcome: Outcome, quantity: str, entry: dict) -> Bar:
    budget = outcome.result["error_budget"]["quantities"][quantity]
    beside = next(each for each in budget if each["friction"] == entry["friction"])
    numerical = beside.get("numerical") or {}
    one, other = numerical.get("half_plane"), numerical.get("finite_element")
    parts = {}
    if one is not None and other is not None:
        parts = {
            "iteration": one["iteration"] + other["iteration"],
            "half-plane's discretisation": one["discretisation"] or 0.0,
            "finite elements' discretisation": other["discretisation"] or 0.0,
            "far boundary": one["domain"] + other["domain"],
        }
    parts["sampling"] = beside["input"] or 0.0
    parts |= {name: abs(entry["effects"].get(name, {}).get("value", 0.0)) for name in EFFECTS}
    parts["interaction"] = abs(entry["interaction"])
    parts["estimated only"] = float(
        np.sqrt(sum(size**2 for size in entry["not_modelled"].values()))
    )
    return Bar(
        quantity,
        parts,
        entry["value"],
        entry["uncertainty"] or 0.0,
        outcome.problem.scene.tolerance.get(quantity),
        QUANTITIES[quantity].of_pair,
    )


def _draw(axes: "Axes", bars: list[Bar]) -> None:
    place = -np.arange(len(bars), dtype=float)
    ends = []
    for y, bar in zip(place, bars, strict=True):
        start = 0.0
        for name, (colour, hatch) in LOOKS.items():
            width = 100.0 * bar.parts.get(name, 0.0)
            if width == 0.0:
                continue  # each would still take a kilobyte of the page
            axes.barh(
                y,
                width,
                left=start,
                height=0.66,
                facecolor=colour,
                edgecolor="#333333",
                hatch=hatch,
                linewidth=0.5,
            )
            start += width
        own, doubt = 100.0 * abs(bar.own), 100.0 * bar.uncertainty
        axes.errorbar(
            own,
            y,
            xerr=[[min(doubt, own)], [doubt]],
            fmt="D",
            markersize=4.0,
            color="#000000",
            markerfacecolor="#ffffff",
            elinewidth=0.9,
            capsize=2.5,
            zorder=4,
        )
        ends += [start, own + doubt]
        if bar.tolerance:
            axes.plot([100.0 * bar.tolerance] * 2, [y - 0.46, y + 0.46], color="#000000", lw=2.0)
            ends.append(100.0 * bar.tolerance)
    axes.set_xlim(0.0, EMPTY * max(ends))
    axes.set_ylim(place[-1] - 0.6, 0.6)
    axes.set_yticks(place, [bar.name for bar in bars])
    axes.tick_params(axis="y", length=0.0)
    axes.grid(False, axis="y")
    whole = "finite elements' norm" if bars[0].is_norm else "finite elements' figure"
    axes.set_xlabel(f"per cent of the {whole}")


def _legend(drawn: "Figure", present: list[str], tolerance: bool) -> None:
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    handles = [
        Patch(
            facecolor=LOOKS[name][0],
            edgecolor="#333333",
            hatch=LOOKS[name][1],
            linewidth=0.5,
            label=EFFECTS[name].label if name in EFFECTS else name,
        )
        for name in present
    ]
    handles.append(
        Line2D([], [], color="#000000", marker="D", markerfacecolor="#ffffff", label="own error")
    )
    if tolerance:
        handles.append(Line2D([], [], color="#000000", lw=2.0, label="tolerance"))
    drawn.legend(handles=handles, loc="upper left", ncols=5, borderaxespad=0.3)
