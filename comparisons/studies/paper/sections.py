"""The page's sections: the paper's figures in its order, each picture beside its claims."""

from dataclasses import dataclass

from comparisons.common.progress import ProgressCallback
from comparisons.report.figures.fields import COMPONENTS
from comparisons.report.figures.style import Picture, drawing
from comparisons.results.outcome import Outcome
from comparisons.studies.paper.claims.claims import Judged
from comparisons.studies.paper.pictures.depth import (
    axis_pictures,
    edge_section_picture,
    peak_section_picture,
)
from comparisons.studies.paper.pictures.pressure import pressure_picture, trace_picture
from comparisons.studies.paper.pictures.scales import scales_of
from comparisons.studies.paper.pictures.shear import contour_picture, isometric_picture
from comparisons.studies.paper.surfaces import FIGURES, SCENES, SMOOTH, SURFACES, UNRUN
from comparisons.studies.paper.words import Row, row_of

LETTERS = {"txz": "bcd", "tau1": "efg"}


@dataclass(frozen=True)
class Block:
    """Pictures with the claims that they bear."""

    heading: str
    pictures: tuple[Picture, ...]
    claims: tuple[Row, ...]


@dataclass(frozen=True)
class Section:
    """One figure of the paper."""

    number: str
    title: str
    blocks: tuple[Block, ...]

    @property
    def pictures(self) -> tuple[Picture, ...]:
        return tuple(picture for block in self.blocks for picture in block.pictures)


def sections_of(
    outcomes: dict[str, Outcome], judged: tuple[Judged, ...], callback: ProgressCallback
) -> tuple[Section, ...]:
    """Draw every figure."""
    with drawing():
        scales = scales_of(outcomes)
        callback("drawing figure 1")
        found = [
            Section(
                "1",
                "Figure 1: pressure on a ground surface",
                (
                    Block(
                        "Pressures over the trace",
                        (trace_picture(outcomes[UNRUN], scales),),
                        _claims(judged, "1"),
                    ),
                ),
            )
        ]
        callback("drawing figure 5")
        found.append(_axis_section(outcomes[SMOOTH], judged))
        for scene in SCENES:
            callback(f"drawing figure {FIGURES[scene]}")
            outcome, number = outcomes[scene], FIGURES[scene]
            of = SURFACES[scene]
            blocks = [
                Block(
                    f"Figure {number}(a): pressure and surfaces under load",
                    (pressure_picture(outcome, scales, of),),
                    _claims(judged, number, "a"),
                )
            ]
            for component in reversed(COMPONENTS):  # the paper's order: orthogonal shear first
                letters = LETTERS[component.name]
                heading = (
                    f"Figure {number}({letters[0]}) to ({letters[-1]}): {component.words} "
                    f"{component.symbol}"
                )
                pictures = (
                    isometric_picture(outcome, component, scales, of),
                    contour_picture(outcome, component, scales, of),
                )
                blocks.append(Block(heading, pictures, _claims(judged, number, letters)))
            found.append(Section(number, f"Figure {number}: {of}", tuple(blocks)))
        callback("drawing figure 11")
        found.append(_depth_section(outcomes, judged))
    return tuple(found)


def _axis_section(smooth: Outcome, judged: tuple[Judged, ...]) -> Section:
    return Section(
        "5",
        "Figure 5: right down to the surface",
        tuple(
            Block(f"Figure 5({letter}): {words}", (picture,), _claims(judged, "5", letter))
            for letter, words, picture in zip(
                "ab",
                ("stresses on the axis", "the same next to the surface"),
                axis_pictures(smooth),
                strict=True,
            )
        ),
    )


def _depth_section(outcomes: dict[str, Outcome], judged: tuple[Judged, ...]) -> Section:
    parts = (
        ("a", "below the peak asperities", peak_section_picture),
        ("b", "below the edge of the contact", edge_section_picture),
    )
    return Section(
        "11",
        "Figure 11: principal shear over depth",
        tuple(
            Block(f"Figure 11({letter}): {words}", (draw(outcomes),), _claims(judged, "11", letter))
            for letter, words, draw in parts
        ),
    )


def _claims(judged: tuple[Judged, ...], number: str, letters: str = "") -> tuple[Row, ...]:
    """Of a figure's letters; of the whole figure without any."""
    names = {f"{number}({letter})" for letter in letters} or {number}
    return tuple(row_of(each) for each in judged if each.claim.figure in names)
