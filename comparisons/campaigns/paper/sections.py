"""The page's sections: the paper's figures in its order, each picture beside its claims."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

from comparisons.campaigns.paper.claim_table import claim_row
from comparisons.campaigns.paper.claims.claim_list import (
    FIGURES,
    POLISHED,
    SCENES,
    SMOOTH,
    SURFACES,
    UNRUN,
)
from comparisons.campaigns.paper.claims.judgement import JudgedClaim
from comparisons.campaigns.paper.pictures.pressure import pressure_picture, trace_picture
from comparisons.campaigns.paper.pictures.rough_spheres import (
    real_pressure_picture,
    spheres_picture,
)
from comparisons.campaigns.paper.pictures.scales import Scales, scales_of
from comparisons.campaigns.paper.pictures.stresses import SHALLOW, axis_picture, contour_picture
from comparisons.common.progress import ProgressCallback
from comparisons.drawing.style import Picture, drawing
from comparisons.output.page.pictures.stresses import COMPONENTS, section_pictures
from comparisons.studies.study import Run

LETTERS = {"txz": "bcd", "tau1": "efg"}
BOOK = "seireg"  # begins the names of sections

# A block: heading, figures of its claims, and what draws its pictures.
Plan = tuple[str, tuple[str, ...], Callable[[], Sequence[Picture]]]


@dataclass(frozen=True)
class PaperBlock:
    """Pictures with the claims that rest on them."""

    heading: str
    pictures: tuple[Picture, ...]
    claims: tuple[dict, ...]


@dataclass(frozen=True)
class Section:
    number: str
    title: str
    blocks: tuple[PaperBlock, ...]


def sections_of(
    outcomes: dict[str, Run], judged: tuple[JudgedClaim, ...], callback: ProgressCallback
) -> tuple[Section, ...]:
    """Draw every figure."""
    sections = []
    with drawing():
        for number, title, plans in _planned(outcomes):
            drawn = "Seireg's figures" if number.startswith(BOOK) else f"figure {number}"
            callback(f"drawing {drawn}")
            blocks = []
            for heading, figures, draw in plans:
                claims = [claim_row(j) for j in judged if j.claim.figure in figures]
                blocks.append(PaperBlock(heading, tuple(draw()), tuple(claims)))
            sections.append(Section(number, title, tuple(blocks)))
    return tuple(sections)


def _planned(outcomes: dict[str, Run]) -> Iterator[tuple[str, str, list[Plan]]]:
    """Number, title and blocks of each section."""
    scales, smooth = scales_of(outcomes), outcomes[SMOOTH]
    trace = "Pressures over the trace", ("1",), lambda: [trace_picture(outcomes[UNRUN], scales)]
    yield "1", "Figure 1: pressure on a ground surface", [trace]
    plans = [
        _panel("5(a)", "stresses on the axis", lambda: [axis_picture(smooth, 1.0, 0.0)]),
        _panel(
            "5(b)", "the same next to the surface", lambda: [axis_picture(smooth, SHALLOW, -0.76)]
        ),
    ]
    yield "5", "Figure 5: right down to the surface", plans
    for scene in SCENES:
        number, surface = FIGURES[scene], SURFACES[scene]
        yield number, f"Figure {number}: {surface}", list(_surface(outcomes[scene], scales, scene))
    peaks = partial(_depths, outcomes, 0, UNRUN, POLISHED)
    edge = partial(_depths, outcomes, 1, SMOOTH, UNRUN)
    plans = [
        _panel("11(a)", "below the peak asperities", peaks),
        _panel("11(b)", "below the edge of the contact", edge),
    ]
    yield "11", "Figure 11: principal shear over depth", plans
    plans = [
        ("Figure 4.5: mean real pressure", ("4.5",), lambda: [real_pressure_picture()]),
        ("Figure 4.6: rough and smooth spheres", ("4.6",), lambda: [spheres_picture()]),
        ("Section 4.8: relative penetration", ("4.9",), tuple),
    ]
    yield BOOK, "Seireg, chapter 4: rough contact", plans
    plan = "Short formulas, and the partition", ("5.2", "5.3", "5.5", "ch. 5"), tuple
    yield f"{BOOK}-heat", "Seireg, chapter 5: heat", [plan]


def _panel(number: str, words: str, draw: Callable[[], Sequence[Picture]]) -> Plan:
    return f"Figure {number}: {words}", (number,), draw


def _surface(outcome: Run, scales: Scales, scene: str) -> Iterator[Plan]:
    """The panels of figures 6 and 8 to 10: pressure, then shear by component."""
    number, surface = FIGURES[scene], SURFACES[scene]
    draw = partial(pressure_picture, outcome, scales, surface)
    yield _panel(f"{number}(a)", "pressure and surfaces under load", lambda: [draw()])
    for component in reversed(COMPONENTS):  # orthogonal shear first, as in the paper
        panels = tuple(f"{number}({letter})" for letter in LETTERS[component.name])
        heading = f"Figure {panels[0]} to ({LETTERS[component.name][-1]}): "
        heading += f"{component.words} {component.symbol}"
        contours = partial(contour_picture, outcome, component, scales, surface)
        yield heading, panels, lambda contours=contours: [contours()]


def _depths(outcomes: dict[str, Run], place: int, *scenes: str) -> list[Picture]:
    """Principal shear over depth on one of the verticals that a report shows, by surface."""
    pictures = []
    for scene in scenes:
        picture, of = section_pictures(outcomes[scene])[place], SURFACES[scene].capitalize()
        said = f"{of}. {picture.alternative}", f"{of}. {picture.caption}"
        pictures.append(replace(picture, alternative=said[0], caption=said[1]))
    return pictures
