"""paper.html: one page that opens without a network and prints without loss."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from comparisons.assessment.verdict import Comparison
from comparisons.common.numbers import UNKNOWN, given, integer, percent, significant, with_unit
from comparisons.report.html import FOLDER as REPORT
from comparisons.report.html import UNIT
from comparisons.report.tables.problem import load_text
from comparisons.studies.paper.sections import Section
from comparisons.studies.paper.words import row_of, summary

if TYPE_CHECKING:
    from comparisons.studies.paper.reproduce import Paper

FOLDER = Path(__file__).parent
SHOWN = {
    "peak_pressure": "peak pressure",
    "contact_length": "contact length",
    "pressure_l2": "pressure, L2",
    "tau1_max": "largest τ₁",
    "tau1_field_near": "τ₁ down to 0.1 a, L2",
    "tau1_field_deep": "τ₁ from 0.5 a on, L2",
}


@dataclass(frozen=True)
class Table:
    """A table in words."""

    title: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


def paper_page(paper: "Paper", sections: tuple[Section, ...]) -> str:
    """The page."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined
    from markupsafe import Markup

    environment = Environment(
        loader=FileSystemLoader(FOLDER),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["tight"] = lambda text: UNIT.sub("\u00a0", text)  # no line ends there
    css = "\n".join((at / "page.css").read_text(encoding="utf-8") for at in (REPORT, FOLDER))
    return environment.get_template("page.html.j2").render(
        css=Markup(css),
        summary=summary(paper.judged),
        about=_about(paper),
        claims=[row_of(each) for each in paper.judged],
        sections=sections,
        models=_models(paper),
        surfaces=_surfaces(paper),
        conditions=_conditions(paper),
        files=(
            "The stresses stand in the folder subsurf, one file a surface, stress and friction, "
            "in the manner of the paper's own program: a line a layer, the header last. "
            "All numbers of this page: paper.json."
        ),
    )


def _about(paper: "Paper") -> list[str]:
    outcome = next(iter(paper.outcomes.values()))
    hertz = outcome.problem.hertz
    return [
        "Bailey and Sayles computed pressures and subsurface stresses of a smooth roller on ground "
        "steel, before and after running and polished. Here the same scenes are solved by the "
        "half-plane method that they used and by finite elements, their figures drawn again, and "
        "each claim that a number can judge is judged beside the picture that bears it.",
        f"All surfaces are pressed by {load_text(outcome.problem)}: Hertz's "
        f"p₀ = {with_unit(hertz.peak_pressure, 'Pa')} and a = {with_unit(hertz.half_width, 'm')}. "
        "Stresses are over p₀, lengths over a, and every kind of picture has one scale for all "
        "surfaces.",
        "The paper's traces were never published as numbers, nor its modulus and radius. The three "
        "rough profiles are computed stand-ins; where they were made to show a figure of the "
        "paper, that they show it proves nothing, and the claim is left untold. A confirmed claim "
        "holds on these stand-ins, a denied one fails on them: neither is a word on the paper's "
        "own surfaces.",
    ]


def _models(paper: "Paper") -> Table:
    rows = []
    for name, outcome in paper.outcomes.items():
        for friction in outcome.problem.scene.friction:
            found = {c.quantity: c for c in outcome.comparisons if c.friction == friction}
            cells = [
                _difference(found[quantity]) if quantity in found else UNKNOWN for quantity in SHOWN
            ]
            rows.append((_short(name), f"{friction:g}", *cells))
    head = ("surface", "friction", *SHOWN.values())
    return Table("How far the two models are apart", head, tuple(rows))


def _short(scene: str) -> str:
    return scene.removeprefix("ground-").replace("-", " ")


def _difference(row: Comparison) -> str:
    signed = row.half_plane is not None
    found = percent(row.difference, signed=signed, uncertainty=row.uncertainty)
    return f"{found} ({percent(row.uncertainty, digits=1)})"


def _surfaces(paper: "Paper") -> Table:
    rows = []
    for name, outcome in paper.outcomes.items():
        info = outcome.problem.scene.profile_info
        half_plane, finite_element = (run.finest for run in outcome.runs.values())
        profile = (UNKNOWN,) * 4
        if info is not None:
            profile = (
                with_unit(info.roughness.ra, "m", 3),
                with_unit(info.roughness.rq, "m", 3),
                significant(info.roughness.rms_slope, 2),
                with_unit(info.spacing, "m", 3),
            )
        rows.append(
            (
                _short(name),
                *profile,
                with_unit(half_plane.grid.pitch, "m", 3),
                integer(half_plane.unknowns),
                integer(finite_element.unknowns),
            )
        )
    head = (
        "surface",
        "Ra",
        "Rq",
        "rms slope",
        "sampling interval",
        "pressure element, finest",
        "unknowns, half-plane",
        "unknowns, finite elements",
    )
    return Table("Surfaces, and how finely they were solved", head, tuple(rows))


def _conditions(paper: "Paper") -> list[tuple[str, str]]:
    problem = next(iter(paper.outcomes.values())).problem
    scene = problem.scene
    return [
        ("load", load_text(problem)),
        ("radius of relative curvature (assumed)", given(scene.roller_radius, "m")),
        ("Young's modulus of both bodies (assumed)", given(scene.body.youngs_modulus, "Pa")),
        ("Poisson's ratio of both bodies (assumed)", f"{scene.body.poissons_ratio:g}"),
        ("friction coefficients", ", ".join(f"{mu:g}" for mu in scene.friction)),
        ("time taken", with_unit(paper.seconds, "s", 2)),
    ]
