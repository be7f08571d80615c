"""paper.html: one page that opens without a network and prints without loss."""

from pathlib import Path
from typing import TYPE_CHECKING

from comparisons.campaigns.paper.claim_table import claim_row, summary
from comparisons.campaigns.paper.sections import Section
from comparisons.common.numbers import UNKNOWN, given, integer, percent, significant, with_unit
from comparisons.drawing.blocks import TextTable
from comparisons.drawing.curves import load_text
from comparisons.figures.figure import Figure
from comparisons.figures.quantity import QUANTITIES
from comparisons.output.page.html import STYLES, rendered

if TYPE_CHECKING:
    from comparisons.campaigns.paper.reproduce import Paper

SHOWN = {
    "peak_pressure": "peak pressure",
    "contact_length": "contact length",
    "pressure_l2": "pressure, L2",
    "tau1_max": "largest τ₁",
    "tau1_field_near": "τ₁ down to 0.1 a, L2",
    "tau1_field_deep": "τ₁ from 0.5 a on, L2",
}


def paper_page(paper: "Paper", sections: tuple[Section, ...]) -> str:
    problem = next(iter(paper.outcomes.values())).problem
    return rendered(
        Path(__file__).parent / "paper.html.j2",
        policy=STYLES,
        summary=summary(paper.judged),
        claims=[claim_row(claim) for claim in paper.judged],
        sections=sections,
        models=_models(paper),
        surfaces=_surfaces(paper),
        paper=paper,
        scene=problem.scene,
        hertz=problem.hertz,
        load=load_text(problem),
        with_unit=with_unit,
        given=given,
    )


def _models(paper: "Paper") -> TextTable:
    rows = []
    for name, outcome in paper.outcomes.items():
        for friction in outcome.problem.scene.load.friction:
            compared = outcome.figures.of(study="comparison", friction=friction)
            differences = {figure.quantity: _difference(figure) for figure in compared}
            cells = [differences.get(quantity, UNKNOWN) for quantity in SHOWN]
            rows.append((_short(name), f"{friction:g}", *cells))
    head = ("surface", "friction", *SHOWN.values())
    return TextTable("How far the two models are apart", head, tuple(rows))


def _short(scene: str) -> str:
    return scene.removeprefix("ground-").replace("-", " ")


def _difference(figure: Figure) -> str:
    signed = not QUANTITIES[figure.quantity].of_pair
    difference = percent(figure.value, signed=signed, uncertainty=figure.numerical)
    return f"{difference} ({percent(figure.numerical, digits=1)})"


def _surfaces(paper: "Paper") -> TextTable:
    rows = []
    for name, outcome in paper.outcomes.items():
        info = outcome.problem.surface.info
        half_plane, finite_element = (run.finest for run in outcome.runs.values())
        profile = (UNKNOWN,) * 4
        if info is not None:
            lengths = info.roughness.ra, info.roughness.rq, info.spacing
            ra, rq, spacing = (with_unit(length, "m", 3) for length in lengths)
            profile = (ra, rq, significant(info.roughness.rms_slope, 2), spacing)
        unknowns = (integer(level.unknowns) for level in (half_plane, finite_element))
        pitch = with_unit(half_plane.grid.pitch, "m", 3)
        rows.append((_short(name), *profile, pitch, *unknowns))
    head = ("surface", "Ra", "Rq", "rms slope", "sampling interval", "pressure element, finest")
    head += ("unknowns, half-plane", "unknowns, finite elements")
    return TextTable("Surfaces, and how finely they were solved", head, tuple(rows))
