"""The report as a reader, a browser and a printer meet it: the page's text, not how it is made."""

import base64
import math
import re
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from html.parser import HTMLParser

import pytest

from comparisons.cli import app
from comparisons.outcome import Outcome
from comparisons.report.comparison_rows import comparison_rows
from comparisons.report.headline import headline
from comparisons.report.page import render

VOID = {"meta", "img", "source", "br", "hr", "link", "input"}
UNITS = {"GPa": 1e9, "MPa": 1e6, "kPa": 1e3, "Pa": 1.0, "m": 1.0, "mm": 1e-3, "µm": 1e-6}
UNITS |= {"nm": 1e-9, "%": 1e-2, "": 1.0}
ROOT = "{http://www.w3.org/2000/svg}"
LINK = "{http://www.w3.org/1999/xlink}href"


@dataclass
class Page(HTMLParser):
    """A page taken apart; raises ValueError where a tag is closed that is not the last opened."""

    source: str = field(repr=False)
    open_tags: list[str] = field(default_factory=list)
    attributes: list[tuple[str, str, str | None]] = field(default_factory=list)
    images: list[dict] = field(default_factory=list)
    sections: list[str] = field(default_factory=list)
    headings: list[str] = field(default_factory=list)
    text: str = ""
    tables: list[list[list[str]]] = field(default_factory=list)

    def __post_init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.feed(self.source)
        self.close()

    def handle_starttag(self, tag: str, attrs: list) -> None:
        self.attributes += [(tag, name, value) for name, value in attrs]
        if tag == "img":
            self.images.append(dict(attrs))
        if tag == "section":
            self.sections.append(dict(attrs)["id"])
        if tag in ("h1", "h2", "h3"):
            self.headings.append("")
        if tag == "table":
            self.tables.append([])
        if tag == "tr":
            self.tables[-1].append([])
        if tag in ("td", "th"):
            self.tables[-1][-1].append("")
        if tag not in VOID:
            self.open_tags.append(tag)

    def handle_endtag(self, tag: str) -> None:
        if not self.open_tags or self.open_tags.pop() != tag:
            raise ValueError(f"</{tag}> closes nothing")

    def handle_data(self, data: str) -> None:
        if self.open_tags[-1:] == ["style"]:
            return
        self.text += data
        if self.open_tags[-1:] and self.open_tags[-1] in ("h1", "h2", "h3"):
            self.headings[-1] += data
        if self.open_tags[-1:] and self.open_tags[-1] in ("td", "th"):
            self.tables[-1][-1][-1] += data
        if "td" in self.open_tags and self.open_tags[-1] == "span":
            self.tables[-1][-1][-1] += f" | {data}"


@pytest.fixture(scope="module")
def wavy_page(wavy_outcome: Outcome) -> Page:
    return Page(render(wavy_outcome))


@pytest.fixture(scope="module")
def smooth_page(smooth_outcome: Outcome) -> Page:
    return Page(render(smooth_outcome))


@pytest.fixture(scope="module")
def half_plane_page(finish: Callable[..., Outcome]) -> Page:
    return Page(render(finish(WAVY_WITHOUT_FIELD, ("half_plane",))))


STEEL = {"youngs_modulus": 210e9, "poissons_ratio": 0.3}
WAVY_WITHOUT_FIELD = {
    "title": "Wavy",
    "roller": {"radius": 10e-3, "rigid": True},
    "body": {**STEEL, "thickness": 2e-3, "base": "frictionless"},
    "profile": {"kind": "sinusoid", "wavelength": 50e-6, "amplitude": 0.2e-6},
    "load": {"hertz_peak_pressure": 1e9},
}


def number(text: str) -> float:
    """A figure with its unit as printed, in SI."""
    text = text.replace("−", "-").replace("\u202f", "").replace("\u00a0", " ")
    value, _, unit = text.partition(" ")
    return float(value) * UNITS[unit]


def test_every_tag_is_closed_in_order(wavy_page: Page, smooth_page: Page, half_plane_page: Page):
    for page in (wavy_page, smooth_page, half_plane_page):
        assert page.open_tags == []
    with pytest.raises(ValueError, match="closes nothing"):
        Page("<p><b>wrong</p></b>")


def test_nothing_is_loaded_from_anywhere(wavy_page: Page):
    loading = {"src", "srcset", "href", "data", "action", "poster", "background"}
    for tag, name, value in wavy_page.attributes:
        if name in loading:
            assert value.startswith("data:image/svg+xml;base64,"), (tag, name)
        assert not name.startswith("on"), (tag, name)
    assert not re.search(r"https?:|<script|<link|<iframe|@import|url\(", wavy_page.source)


def test_pictures_are_whole_and_load_nothing_either(wavy_page: Page):
    for image in wavy_page.images:
        drawing = ElementTree.fromstring(base64.b64decode(image["src"].partition(",")[2]))
        assert drawing.tag == f"{ROOT}svg"
        assert drawing.find(f".//{ROOT}path") is not None
        for element in drawing.iter():
            target = element.get(LINK) or element.get("href") or "#"
            assert target.startswith(("#", "data:image/png;base64,")), target


def test_every_picture_says_in_words_what_it_shows(wavy_page: Page):
    alternatives = [image["alt"] for image in wavy_page.images]
    assert all(len(text) > 40 for text in alternatives)
    assert len(set(alternatives)) == len(alternatives)


def count(page: Page, word: str) -> int:
    return sum(word in image["alt"] for image in page.images)


def test_a_rough_run_with_friction_has_all_pictures(wavy_page: Page):
    # problem, pressure, close-up, surfaces; two fields and a near-surface one for each of the two
    # friction coefficients; two sections; three meshes; cost; error budget
    assert len(wavy_page.images) == 4 + 2 * 3 + 2 + 3 + 1 + 1
    assert count(wavy_page, "next to the surface") == 2
    assert count(wavy_page, "Orthogonal shear stress") == 2
    assert count(wavy_page, "over depth") == 2
    assert count(wavy_page, "Finite-element mesh") == 3
    assert {"Friction 0", "Friction 0.1"} <= set(wavy_page.headings)


def test_a_smooth_run_has_no_pictures_of_roughness(smooth_page: Page):
    assert len(smooth_page.images) == 4 + 2 + 2 + 3 + 1 + 1
    assert count(smooth_page, "next to the surface") == 0
    assert count(smooth_page, "right-hand edge") == 1
    assert "Ra, Rq" not in smooth_page.text


def test_sections_come_in_the_order_of_a_verification_report(wavy_page: Page):
    assert wavy_page.sections == [
        "problem",
        "comparison",
        "budget",
        "contact",
        "stresses",
        "convergence",
        "mesh",
        "skipped",
        "cost",
        "checks",
        "record",
    ]


def test_one_model_without_fields_shows_what_applies_and_no_more(half_plane_page: Page):
    assert half_plane_page.sections == [
        "problem",
        "comparison",
        "contact",
        "convergence",
        "skipped",
        "cost",
        "checks",
        "record",
    ]
    assert len(half_plane_page.images) == 5
    assert "Only the half-plane model was run" in half_plane_page.text
    assert "finite elements" not in half_plane_page.text
    assert "neither model" not in half_plane_page.text
    assert "free to slide on a rigid base" in half_plane_page.text
    assert "--models half-plane" in half_plane_page.text


def test_the_finite_element_model_alone_has_its_mesh(finish: Callable[..., Outcome]):
    page = Page(render(finish(WAVY_WITHOUT_FIELD, ("finite_element",))))
    assert "mesh" in page.sections
    assert "Only the finite-element model was run" in page.text


def test_fields_of_one_model_stand_without_a_difference(
    finish: Callable[..., Outcome], smooth_tables
):
    page = Page(render(finish(smooth_tables, ("half_plane",))))
    assert count(page, "Principal shear stress") == count(page, "Orthogonal shear stress") == 1
    assert count(page, "over depth") == 2
    assert "largest difference" not in page.text
    [table] = [table for table in page.tables if "over Hertz" in table[0]]
    assert [row[0] for row in table[1:]] == [
        "peak pressure",
        "contact length",
        "contact length over Hertz 2a",
        "largest principal shear stress τ₁",
        "depth of the largest τ₁",
        "largest orthogonal shear stress |τxz|",
    ]


def test_every_number_of_the_comparison_is_on_the_page(wavy_page: Page, wavy_outcome: Outcome):
    labels = {
        "peak_pressure": "peak pressure",
        "contact_length": "contact length",
        "contact_ratio": "contact length over Hertz 2a",
        "tau1_max": "largest principal shear stress τ₁",
        "txz_max_abs": "largest orthogonal shear stress |τxz|",
        "tau1_max_depth": "depth of the largest τ₁",
        "pressure_l2": "pressures, relative L2 difference",
        "tau1_field_near": "τ₁ down to 0.1 a, relative L2 difference",
        "tau1_field_deep": "τ₁ deeper than 0.5 a, relative L2 difference",
    }
    [table] = [table for table in wavy_page.tables if table[0][-1] == "verdict"]
    shown = {}
    for label, frictions, *cells in table[1:]:
        for friction in frictions.split(", "):
            assert (label, float(friction)) not in shown
            shown[label, float(friction)] = [cell.partition(" | ")[0] for cell in cells[:-1]] + [
                cells[-1].removeprefix(" | ")
            ]
    compared = wavy_outcome.result["comparison"]
    assert len(shown) == sum(len(rows) for rows in compared.values())
    for quantity, rows in compared.items():
        for row in rows:
            one, other, difference, uncertainty, tolerance, verdict = shown[
                labels[quantity], row["friction"]
            ]
            for text, value, digits in (
                (one, row["half_plane"], 4),
                (other, row["finite_element"], 4),
                (uncertainty, row["uncertainty"], 2),
                (tolerance, row["tolerance"], 6),
            ):
                if value is None:
                    assert text == ""
                elif abs(value) < 1e-6 and text.startswith("<"):
                    assert text == "< 0.0001 %"
                else:
                    assert number(text) == pytest.approx(value, rel=0.51 * 10.0 ** (1 - digits))
            supported = 0.51 * 10.0 ** (math.floor(math.log10(row["uncertainty"])) - 1)
            shown_to = max(supported, 0.051 * abs(row["difference"]))
            assert number(difference) == pytest.approx(row["difference"], abs=shown_to)
            assert verdict == (row["verdict"] or "")


def test_rows_are_joined_only_where_every_figure_is_the_same(wavy_outcome: Outcome):
    def frictions(outcome: Outcome) -> list[str]:
        return [row.friction for row in comparison_rows(outcome) if row.quantity == "peak_pressure"]

    assert frictions(wavy_outcome) == ["0, 0.1"]
    for change in ({"uncertainty": 0.5}, {"verdict": "differ"}, {"difference": 0.4}):
        last = replace(wavy_outcome.comparisons[-9], **change)
        assert (last.quantity, last.friction) == ("peak_pressure", 0.1)
        rows = (*wavy_outcome.comparisons[:-9], last, *wavy_outcome.comparisons[-8:])
        assert frictions(replace(wavy_outcome, comparisons=rows)) == ["0", "0.1"]


def test_figures_are_also_given_over_those_of_hertz(wavy_page: Page, wavy_outcome: Outcome):
    peak = wavy_outcome.result["comparison"]["peak_pressure"][0]["half_plane"]
    p0 = wavy_outcome.result["hertz"]["peak_pressure"]
    [table] = [table for table in wavy_page.tables if table[0][-1] == "verdict"]
    relative = table[1][2].partition(" | ")[2]
    assert relative.endswith(" p₀")
    assert float(relative.split()[0]) == pytest.approx(peak / p0, rel=1e-3)


def capped(outcome: Outcome, one: float, other: float) -> str:
    """The page with these peaks over the hardness."""
    hardness = outcome.problem.scene.hardness
    peak = replace(
        outcome.comparisons[0], half_plane=one * hardness, finite_element=other * hardness
    )
    assert peak.quantity == "peak_pressure"
    return render(replace(outcome, comparisons=(peak, *outcome.comparisons[1:])))


def test_peaks_that_the_hardness_holds_are_no_evidence(
    wavy_outcome: Outcome, smooth_outcome: Outcome
):
    cell = '<span class="relative">capped in both</span></th>'
    assert capped(wavy_outcome, 1.0, 1.0 - 1e-12).count(cell) == 1
    assert cell not in capped(wavy_outcome, 1.0, 0.999)
    assert cell not in capped(wavy_outcome, 0.999, 1.0)
    assert cell not in render(smooth_outcome)  # without a hardness


def test_words_never_carry_the_names_of_result_files(wavy_page: Page):
    assert not re.search(r"tau1|txz|_max|_l2", wavy_page.text.partition("Left out")[0])


def test_what_scrolls_sideways_can_be_reached_by_keyboard(wavy_page: Page):
    places = re.findall(r'<div class="scroll[^>]*>', wavy_page.source)
    pictures = [place for place in places if "picture" in place.partition(" role")[0]]
    assert len(pictures) == len(wavy_page.images)
    assert all('tabindex="0"' in place and "aria-label=" in place for place in pictures)
    assert wavy_page.text.count("Scroll sideways to see the whole picture") == len(pictures)


def test_convergence_shows_every_level_of_every_model(wavy_page: Page, wavy_outcome: Outcome):
    tables = [table for table in wavy_page.tables if "order" in table[0]]
    assert len(tables) == 3  # one a model, one of the norms of the difference
    for table, run in zip(tables, wavy_outcome.runs.values(), strict=False):
        rows = {row[0]: row[1:] for row in table[1:]}
        for k, level in enumerate(run.levels):
            pitch = number(rows["pitch of the pressure elements"][k])
            assert pitch == pytest.approx(level.grid.pitch, rel=1e-3)
            assert int(number(rows["unknowns"][k])) == level.unknowns
            peak = number(rows["peak pressure"][k])
            assert peak == pytest.approx(level.solution.pressure.max(), rel=1e-4)


def test_what_was_left_out_stands_with_its_reason(wavy_page: Page, wavy_outcome: Outcome):
    assert wavy_outcome.plan.skipped
    for item in wavy_outcome.plan.skipped:
        assert [item.step, item.because] in [row for table in wavy_page.tables for row in table]
    for assumption in wavy_outcome.plan.assumptions:
        assert assumption in wavy_page.text


def test_the_record_names_versions_hashes_and_the_command(wavy_page: Page, wavy_outcome: Outcome):
    assert f"numpy {wavy_outcome.record['versions']['numpy']}" in wavy_page.text
    for value in wavy_outcome.record["hashes"].values():
        assert value in wavy_page.text
    assert "crosscheck run made.toml" in wavy_page.text
    commands = [command.callback.__name__.strip("_") for command in app.registered_commands]
    for named in re.findall(r"crosscheck (\w+) [^ ]*\.toml", wavy_page.text):
        assert named in commands
    assert "crosscheck rerun" not in wavy_page.text


def test_equal_runs_give_equal_pages_whatever_the_settings_of_matplotlib(
    smooth_outcome: Outcome, smooth_page: Page
):
    import matplotlib

    with matplotlib.rc_context({"font.size": 31.0, "axes.grid": False, "lines.linewidth": 9.0}):
        again = render(smooth_outcome)
        assert matplotlib.rcParams["font.size"] == 31.0
    assert again == smooth_page.source


def test_a_title_cannot_add_markup(smooth_outcome: Outcome):
    title = '<script>alert("x")</script> & <b>more'
    scene = replace(smooth_outcome.problem.scene, title=title)
    outcome = replace(smooth_outcome, problem=replace(smooth_outcome.problem, scene=scene))
    page = Page(render(outcome))
    assert title in page.headings
    assert not {"script", "b"} & {tag for tag, _, _ in page.attributes} and "<b>" not in page.source
    assert page.open_tags == []


def test_the_page_of_a_field_of_full_size_stays_small(finish: Callable[..., Outcome]):
    tables = {
        **WAVY_WITHOUT_FIELD,
        "load": {"hertz_peak_pressure": 1e9, "friction": [0.0, 0.1]},
        "stress": {"points": [600, 200], "depth": 1.0},
    }
    assert len(render(finish(tables))) < 4_000_000


def test_the_headline_owns_up_to_a_solver_that_failed(smooth_outcome: Outcome):
    run = smooth_outcome.runs["half_plane"]
    bad = replace(run.finest, solution=replace(run.finest.solution, converged=False))
    runs = {**smooth_outcome.runs, "half_plane": replace(run, levels=(*run.levels[:-1], bad))}
    said = headline(replace(smooth_outcome, runs=runs))
    assert said.kind == "not converged"
    assert "half-plane" in said.sentence
    page = Page(render(replace(smooth_outcome, runs=runs)))
    assert "no conclusion rests on it" in page.text
