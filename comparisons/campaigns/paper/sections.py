"""The page's sections: the paper's figures in its order, each picture beside its claims."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

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
from comparisons.campaigns.paper.pictures.scales import scales_of
from comparisons.campaigns.paper.pictures.stresses import axis_pictures, contour_picture
from comparisons.common.progress import ProgressCallback
from comparisons.drawing.style import Picture, drawing
from comparisons.output.page.pictures.fields import COMPONENTS
from comparisons.output.page.pictures.sections import section_pictures
from comparisons.studies.study import Run

LETTERS = {"txz": "bcd", "tau1": "efg"}


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

    def claims(number: str, letters: str = "") -> tuple[dict, ...]:
        """Of a figure's letters; of the whole figure without any."""
        names = {f"{number}({letter})" for letter in letters} or {number}
        return tuple(claim_row(each) for each in judged if each.claim.figure in names)

    def lettered(number: str, *pictures: tuple[str, Sequence[Picture]]) -> tuple[PaperBlock, ...]:
        """A block a letter, from (a) on."""
        return tuple(
            PaperBlock(f"Figure {number}({letter}): {words}", tuple(drawn), claims(number, letter))
            for letter, (words, drawn) in zip("ab", pictures, strict=False)
        )

    with drawing():
        scales = scales_of(outcomes)
        callback("drawing figure 1")
        trace = PaperBlock(
            "Pressures over the trace", (trace_picture(outcomes[UNRUN], scales),), claims("1")
        )
        found = [Section("1", "Figure 1: pressure on a ground surface", (trace,))]
        callback("drawing figure 5")
        axis, near = axis_pictures(outcomes[SMOOTH])
        blocks = lettered(
            "5", ("stresses on the axis", [axis]), ("the same next to the surface", [near])
        )
        found.append(Section("5", "Figure 5: right down to the surface", blocks))
        for scene in SCENES:
            number, surface = FIGURES[scene], SURFACES[scene]
            callback(f"drawing figure {number}")
            pressure = pressure_picture(outcomes[scene], scales, surface)
            blocks = lettered(number, ("pressure and surfaces under load", [pressure]))
            for component in reversed(COMPONENTS):  # orthogonal shear first, as in the paper
                letters = LETTERS[component.name]
                heading = f"Figure {number}({letters[0]}) to ({letters[-1]}): "
                heading += f"{component.words} {component.symbol}"
                picture = contour_picture(outcomes[scene], component, scales, surface)
                blocks += (PaperBlock(heading, (picture,), claims(number, letters)),)
            found.append(Section(number, f"Figure {number}: {surface}", blocks))
        callback("drawing figure 11")
        blocks = lettered(
            "11",
            ("below the peak asperities", _depths(outcomes, 0, UNRUN, POLISHED)),
            ("below the edge of the contact", _depths(outcomes, 1, SMOOTH, UNRUN)),
        )
        found.append(Section("11", "Figure 11: principal shear over depth", blocks))
        callback("drawing Seireg's figures")
        blocks = (
            PaperBlock("Figure 4.5: mean real pressure", (real_pressure_picture(),), claims("4.5")),
            PaperBlock("Figure 4.6: rough and smooth spheres", (spheres_picture(),), claims("4.6")),
            PaperBlock("Section 4.8: relative penetration", (), claims("4.9")),
        )
        found.append(Section("seireg", "Seireg, chapter 4: rough contact", blocks))
        heat = sum((claims(number) for number in ("5.2", "5.3", "5.5", "ch. 5")), ())
        block = PaperBlock("Short formulas, and the partition", (), heat)
        found.append(Section("seireg-heat", "Seireg, chapter 5: heat", (block,)))
    return tuple(found)


def _depths(outcomes: dict[str, Run], place: int, *scenes: str) -> list[Picture]:
    """Principal shear over depth on one of the verticals that a report shows, by surface."""
    found = []
    for scene in scenes:
        picture, of = section_pictures(outcomes[scene])[place], SURFACES[scene].capitalize()
        said = f"{of}. {picture.alternative}", f"{of}. {picture.caption}"
        found.append(replace(picture, alternative=said[0], caption=said[1]))
    return found
