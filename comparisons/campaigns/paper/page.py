"""paper.html, one page that opens without a network and prints without loss; and the terminal's
table of the claims.

The page's sections are the sources' figures in their order, each picture beside its claims."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING

from comparisons.campaigns.paper import pictures
from comparisons.campaigns.paper.book import SECTIONS, SHORT_FORMULAS
from comparisons.campaigns.paper.claims import (
    FIGURES,
    OUTCOMES,
    POLISHED,
    SCENES,
    SMOOTH,
    SURFACES,
    THEORY,
    UNRUN,
    JudgedClaim,
)
from comparisons.common.numbers import (
    MINUS,
    UNKNOWN,
    given,
    integer,
    percent,
    significant,
    with_unit,
)
from comparisons.common.progress import ProgressCallback
from comparisons.drawing.blocks import TextTable
from comparisons.drawing.curves import load_text
from comparisons.drawing.style import Picture, drawing
from comparisons.figures.figure import Figure
from comparisons.figures.quantity import LABELS, MODELS, QUANTITIES, error_text, label
from comparisons.output.page.html import STYLES, rendered
from comparisons.output.page.pictures.stresses import COMPONENTS, section_pictures
from comparisons.output.terminal import PLAIN, plain_table
from comparisons.output.terminal import STYLES as COLOURS
from comparisons.studies.model_error.catalogue import EFFECTS
from comparisons.studies.study import Run

if TYPE_CHECKING:
    from rich.console import RenderableType

    from comparisons.campaigns.paper.reproduce import Paper

COMPARED = {
    "peak_pressure": "peak pressure",
    "contact_length": "contact length",
    "pressure_l2": "pressure, L2",
    "tau1_max": "largest τ₁",
    "tau1_field_near": "τ₁ down to 0.1 a, L2",
    "tau1_field_deep": "τ₁ from 0.5 a on, L2",
}
DIGITS = 4  # of a number with an uncertainty
PANELS = {"txz": "bcd", "tau1": "efg"}  # of figures 6 and 8 to 10

Block = tuple[str, tuple[str, ...], Sequence[Picture]]  # heading, figures of its claims, pictures
Section = tuple[str, str, list[tuple[str, Sequence[Picture], list[dict]]]]  # number, title, blocks


def paper_page(paper: "Paper", callback: ProgressCallback) -> str:
    problem = paper.runs[SMOOTH].problem
    return rendered(
        Path(__file__).parent / "paper.html.j2",
        policy=STYLES,
        summary=summary(paper.judged),
        claims=[claim_row(judged) for judged in paper.judged],
        sections=sections_of(paper, callback),
        models=_models(paper),
        surfaces=_surfaces(paper),
        paper=paper,
        scene=problem.scene,
        hertz=problem.hertz,
        load=load_text(problem),
        with_unit=with_unit,
        given=given,
    )


def paper_table(paper: "Paper") -> "RenderableType":
    """The claims with their numbers and outcomes, for the terminal."""
    from rich.console import Group
    from rich.text import Text

    models = (*MODELS, THEORY)
    table = plain_table("claim", "figure", numbers=[LABELS.get(m, m) for m in models])
    table.add_column("outcome")
    for row in map(claim_row, paper.judged):
        claim, numbers = row["claim"], (row["by_model"].get(m, "") for m in models)
        cells = (claim.title, claim.figure, *numbers)
        plain = [cell.replace("±", "+-").translate(PLAIN) for cell in cells]
        table.add_row(*plain, Text(row["outcome"], style=COLOURS[row["kind"]]))
    return Group(
        table, "", summary(paper.judged), f"figures and claims {paper.directory / 'paper.html'}"
    )


def summary(judged: Sequence[JudgedClaim]) -> str:
    confirmed, denied, inconclusive = (sum(j.outcome == kind for j in judged) for kind in OUTCOMES)
    return (
        f"Of {len(judged)} claims that numbers can judge, {confirmed} are confirmed and {denied} "
        f"denied; {inconclusive} are inconclusive on the stand-in profiles."
    )


def claim_row(judged: JudgedClaim) -> dict:
    """A judged claim in words: number with uncertainty by model, the same as lines that name their
    model, further numbers as lines, and the kind that names its colours."""
    claim = judged.claim
    by_model = {model: number_text(n, claim.unit) for model, n in judged.numbers.items()}
    besides = {
        f"{words[0].upper()}{words[1:]}": _lines({m: significant(v, 3) for m, v in values.items()})
        for words, values in judged.besides.items()
    }
    return {
        "claim": claim,
        "confirmed": claim.criterion.removeprefix("Confirmed ").split(", ")[0],
        "by_model": by_model,
        "numbers": _lines(by_model),
        "besides": [f"{words}: {'; '.join(lines)}" for words, lines in besides.items()],
        "outcome": judged.outcome,
        "kind": OUTCOMES[judged.outcome],
        "why": judged.why,
        "model_error": judged.model_error and model_error_text(judged.model_error),
    }


def _lines(texts: dict[str, str]) -> tuple[str, ...]:
    """A line a model, or one for both where they say the same."""
    if len(set(texts.values())) == 1 and len(texts) > 1:
        return (f"{next(iter(texts.values()))} (both models)",)
    return tuple(f"{LABELS.get(model, model)} {text}" for model, text in texts.items())


def model_error_text(error: Figure) -> str:
    """What was computed, with its uncertainty, and the most that was not."""
    size = error_text(error.quantity, error.value, error.numerical)
    text = f"{label(error.quantity)} {size} ± {percent(error.numerical)}"
    if error.unknown:
        most = EFFECTS[max(error.unknown, key=error.unknown.get)].label
        left = percent(error.not_modelled)
        text += f"; not modelled, by estimate: at most {left}, {most} most"
    return text


def number_text(number: Figure, unit: str) -> str:
    """Value and uncertainty down to one digit beyond its first, at most DIGITS digits in all."""
    value, uncertainty = number.value, number.numerical
    if not isfinite(uncertainty):
        return f"{significant(value, DIGITS)} ± {UNKNOWN} {unit}".rstrip()
    shown = 3 if uncertainty == 0.0 else DIGITS
    places = shown - 1 - _power(value) if value else shown - 1
    if uncertainty > 0.0:
        places = min(places, 1 - _power(uncertainty))
    if round(uncertainty, places) == 0.0:
        return f"{significant(value, shown)} {unit}".rstrip()
    places = max(places, 0)
    text = f"{value:.{places}f} ± {uncertainty:.{places}f}".replace("-", MINUS)
    return f"{text} {unit}".rstrip()


def _power(value: float) -> int:
    return int(f"{abs(value):.0e}".partition("e")[2])


def sections_of(paper: "Paper", callback: ProgressCallback) -> list[Section]:
    """Every section, its pictures drawn."""
    sections = []
    with drawing():
        for number, title, blocks in _planned(paper.runs):
            drawn = "Seireg's figures" if number in SECTIONS else f"figure {number}"
            callback(f"drawing {drawn}")
            rows = [
                (heading, shown, [claim_row(j) for j in paper.judged if j.claim.figure in figures])
                for heading, figures, shown in blocks
            ]
            sections.append((number, title, rows))
    return sections


def _planned(runs: dict[str, Run]) -> Iterator[tuple[str, str, Iterable[Block]]]:
    """Number, title and blocks of each section; its pictures are drawn as the blocks are read."""
    scales = pictures.scales_of(runs.values())
    yield "1", "Figure 1: pressure on a ground surface", _trace(runs[UNRUN], scales)
    yield "5", "Figure 5: right down to the surface", _axis(runs[SMOOTH])
    for scene in SCENES:
        number, surface = FIGURES[scene], SURFACES[scene]
        yield number, f"Figure {number}: {surface}", _surface(runs[scene], scales, scene)
    yield "11", "Figure 11: principal shear over depth", _depths(runs)
    for section, blocks in zip(SECTIONS.items(), (_rough_spheres(), [SHORT_FORMULAS]), strict=True):
        yield *section, blocks


def _trace(run: Run, scales: pictures.Scales) -> Iterator[Block]:
    yield "Pressures over the trace", ("1",), [pictures.trace_picture(run, scales)]


def _axis(smooth: Run) -> Iterator[Block]:
    draw, shallow = pictures.axis_picture, pictures.SHALLOW
    yield "Figure 5(a): stresses on the axis", ("5(a)",), [draw(smooth, 1.0, 0.0)]
    yield "Figure 5(b): the same next to the surface", ("5(b)",), [draw(smooth, shallow, -0.76)]


def _surface(run: Run, scales: pictures.Scales, scene: str) -> Iterator[Block]:
    """The panels of figures 6 and 8 to 10: pressure, then shear by component."""
    number, surface = FIGURES[scene], SURFACES[scene]
    drawn = pictures.pressure_picture(run, scales, surface)
    yield f"Figure {number}(a): pressure and surfaces under load", (f"{number}(a)",), [drawn]
    for component in reversed(COMPONENTS):  # orthogonal shear first, as in the paper
        letters = PANELS[component.name]
        panels = tuple(f"{number}({letter})" for letter in letters)
        heading = f"Figure {panels[0]} to ({letters[-1]}): {component.words} {component.symbol}"
        yield heading, panels, [pictures.contour_picture(run, component, scales, surface)]


def _depths(runs: dict[str, Run]) -> Iterator[Block]:
    """Principal shear over depth on the verticals that a report shows."""
    panels = {"(a): below the peak asperities": (UNRUN, POLISHED)}
    panels["(b): below the edge of the contact"] = SMOOTH, UNRUN
    for place, (words, scenes) in enumerate(panels.items()):
        drawn = []
        for scene in scenes:
            picture, of = section_pictures(runs[scene])[place], SURFACES[scene].capitalize()
            texts = f"{of}. {picture.alternative}", f"{of}. {picture.caption}"
            drawn.append(replace(picture, alternative=texts[0], caption=texts[1]))
        yield f"Figure 11{words}", (f"11{words[:3]}",), drawn


def _rough_spheres() -> Iterator[Block]:
    yield "Figure 4.5: mean real pressure", ("4.5",), [pictures.real_pressure_picture()]
    yield "Figure 4.6: rough and smooth spheres", ("4.6",), [pictures.spheres_picture()]
    yield "Section 4.8: relative penetration", ("4.9",), ()


def _models(paper: "Paper") -> TextTable:
    rows = []
    for name, run in paper.runs.items():
        for friction in run.problem.scene.load.friction:
            compared = run.figures.of(study="comparison", friction=friction)
            differences = {figure.quantity: _difference(figure) for figure in compared}
            cells = [differences.get(quantity, UNKNOWN) for quantity in COMPARED]
            rows.append((_short(name), f"{friction:g}", *cells))
    head = ("surface", "friction", *COMPARED.values())
    return TextTable("How far the two models are apart", head, tuple(rows))


def _short(scene: str) -> str:
    return scene.removeprefix("ground-").replace("-", " ")


def _difference(figure: Figure) -> str:
    signed = not QUANTITIES[figure.quantity].of_pair
    difference = percent(figure.value, signed=signed, uncertainty=figure.numerical)
    return f"{difference} ({percent(figure.numerical, digits=1)})"


def _surfaces(paper: "Paper") -> TextTable:
    rows = []
    for name, run in paper.runs.items():
        info, profile = run.problem.surface.info, (UNKNOWN,) * 4
        half_plane, finite_element = (of_model.finest for of_model in run.runs.values())
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
