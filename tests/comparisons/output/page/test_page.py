"""The page as a reader, a browser and a printer meet it: whole, self-contained, in order."""

import base64
import csv
import re
import xml.etree.ElementTree as ElementTree
from html import unescape

import pytest
from scenes import STEADY, WAVY_LAYER, changed, with_fields

from comparisons.figures.quantity import QUANTITIES, label
from comparisons.judging.model_error.show import steps_of, waterfalls
from comparisons.judging.study import Run
from comparisons.output.page.page import render

ROOT = "{http://www.w3.org/2000/svg}"
SECTIONS = ["model-error", "comparison", "contact", "stresses", "yield"]
SECTIONS += ["problem", "convergence", "mesh", "cost", "checks", "skipped", "record"]
LINK = "{http://www.w3.org/1999/xlink}href"


def test_every_tag_is_closed(wavy_page, smooth_outcome, half_plane_page, page_of, unpainted):
    for page in (wavy_page, page_of(render(smooth_outcome)), half_plane_page):
        assert page.open_tags == []
    with pytest.raises(ValueError, match="closes nothing"):
        page_of("<p><b>wrong</p></b>")


def test_nothing_is_loaded_from_anywhere(wavy_page):
    loading = {"src", "srcset", "href", "data", "action", "poster", "background"}
    for tag, name, value in wavy_page.attributes:
        if name in loading and tag != "a":
            assert value.startswith("data:image/svg+xml;base64,"), (tag, name)
        assert not name.startswith("on"), (tag, name)
    assert not re.search(r"https?:|<link|<iframe|@import|url\(", wavy_page.source)


def test_contents_lead_to_every_section_and_each_heading_has_a_name(wavy_page, half_plane_page):
    for page in (wavy_page, half_plane_page):
        names = page.values("id")
        assert len(names) == len(set(names))
        inside = [link for link in page.values("href", "a") if link.startswith("#")]
        assert inside == [f"#{section}" for section in page.sections]
        every, named = (re.findall(head, page.source) for head in ("<h[23]", "<h3 id=|<h2>"))
        assert len(every) == len(named)
        assert {"geometry", "materials", "load"} <= set(names)


def test_curves_are_there_as_csv(wavy_page, wavy_outcome):
    texts = [
        base64.b64decode(link.partition(",")[2]).decode()
        for link in wavy_page.values("href", "a")
        if link.startswith("data:text/csv;")
    ]
    names = wavy_page.values("download")
    assert len(texts) == len(names) >= 6 and all(name.endswith(".csv") for name in names)
    tables = [list(csv.reader(text.splitlines())) for text in texts]
    named = list(zip(names, tables, strict=True))
    [curves] = [table for name, table in named if name.startswith("contact-pressure")]
    column = curves[0].index("p/p₀, half-plane")
    level = wavy_outcome.runs["half_plane"].finest
    shown = {row[column - 1]: row[column] for row in curves[1:]}
    highest = level.solution.pressure.max() / wavy_outcome.problem.hertz.peak_pressure
    assert max(float(text) for text in shown.values() if text) == pytest.approx(highest, rel=1e-5)
    assert {len(row) for row in curves} == {len(curves[0])}
    [steps] = [table for name, table in named if name.startswith("the-half-plane-s-model-error")]
    panels = waterfalls(wavy_outcome)
    assert steps[0] == ["quantity", "step", "relative size"]
    assert {row[0] for row in steps[1:]} == set(panels)
    for title, error in panels.items():
        sizes = {step: float(size) for name, step, size in steps[1:] if name == title}
        assert sizes["model error"] == pytest.approx(error.value, rel=1e-5)
        assert sizes["uncertainty"] == pytest.approx(error.numerical, rel=1e-5)
        steps_up = sum(sizes[step] for step in steps_of(error))
        assert steps_up == pytest.approx(error.value, rel=1e-4, abs=1e-6)


def test_no_script_runs(wavy_page):
    [policy] = [value for value in wavy_page.values("content", "meta") if "default-src" in value]
    assert policy == "default-src 'none'; img-src data:; style-src 'unsafe-inline'"
    assert wavy_page.scripts == []


def test_pictures_are_whole_and_load_nothing_either(wavy_page):
    for image in wavy_page.images:
        drawing = ElementTree.fromstring(base64.b64decode(image["src"].partition(",")[2]))
        assert drawing.tag == f"{ROOT}svg"
        assert drawing.find(f".//{ROOT}path") is not None
        assert drawing.find(f".//{ROOT}pattern") is None  # which prints as coarse pixels
        for element in drawing.iter():
            target = element.get(LINK) or element.get("href") or "#"
            assert target.startswith(("#", "data:image/png;base64,")), target


def test_every_picture_says_in_words_what_it_shows(wavy_page):
    alternatives = [image["alt"] for image in wavy_page.images]
    assert all(len(text) > 40 for text in alternatives)
    assert len(set(alternatives)) == len(alternatives)


def test_a_rough_run_with_friction_has_all_pictures(wavy_page):
    # problem, pressure, close-up, surfaces; two fields and a near-surface one for each of the two
    # friction coefficients; two sections; three meshes; convergence; cost; error budget; what is
    # judged, and the run in one picture
    assert len(wavy_page.images) == 4 + 2 * 3 + 2 + 3 + 1 + 1 + 1 + 2
    assert wavy_page.count("next to the surface") == 2
    assert wavy_page.count("Orthogonal shear stress") == 2
    assert wavy_page.count("over depth") == 2
    assert wavy_page.count("Finite-element mesh") == 3
    assert {"Friction 0", "Friction 0.1"} <= set(wavy_page.headings)


def test_the_answer_comes_first_and_what_checks_it_is_folded_away(wavy_page, wavy_outcome):
    assert wavy_page.sections == SECTIONS
    first, _, _ = wavy_page.source.partition("<nav")
    assert "model errors over their tolerances" in first and "The run in one picture" in first
    for error in wavy_outcome.model_errors:
        assert error.words() in unescape(first).replace("\xa0", " ")
    for name in ("scene", "question", "uncertainty", "solved by", "made", "signature"):
        assert f'<th scope="row">{name}</th>' in first
    for fact in ("R = 10 mm, E = 210 GPa", "hardness of the body</th><td>4 GPa", "Ra 126.5 nm"):
        assert fact in first
    folded = re.findall(r'<details>.*?<section id="([\w-]+)"', wavy_page.source, re.DOTALL)
    assert folded == SECTIONS[SECTIONS.index("problem") :]


def test_one_model_without_fields_shows_what_applies_and_no_more(half_plane_page):
    assert set(SECTIONS) - set(half_plane_page.sections) == {"model-error", "stresses", "mesh"}
    assert len(half_plane_page.images) == 7
    assert "not known: only the half-plane model was run" in half_plane_page.text
    assert "finite elements" not in half_plane_page.text
    assert "neither model" not in half_plane_page.text
    assert "free to slide on a rigid base" in half_plane_page.text
    assert "--models half-plane" in half_plane_page.text


def test_fields_of_one_model_stand_without_a_difference(finish, page_of, unpainted):
    page = page_of(render(finish(STEADY, ("half_plane",))))
    assert page.count("Principal shear stress") == page.count("Orthogonal shear stress") == 1
    assert page.count("over depth") == 2
    assert "largest difference" not in page.text
    [table] = [table for table in page.tables if "over Hertz" in table[0]]
    assert [row[0] for row in table[1:]] == list(map(label, QUANTITIES))


def test_only_tables_and_pictures_scroll_sideways_and_are_named(wavy_page):
    places = re.findall(r'<div class="scroll[^>]*aria-label="(\w*), scrolls', wavy_page.source)
    assert len(places) == wavy_page.source.count('class="scroll"')
    assert places.count("picture") == len(wavy_page.images) and places.count("table") > 5
    assert "tabindex" not in wavy_page.source  # browsers themselves stop where something scrolls


def test_a_title_cannot_add_markup(smooth_outcome: Run, page_of, drawn_only):
    title = '<script>alert("x")</script> & <b>more'
    with drawn_only():
        page = page_of(render(with_fields(smooth_outcome, {"title": title})))
    assert title in page.headings
    assert page.scripts == [] and "<b>" not in page.source
    assert page.open_tags == []


@pytest.mark.filterwarnings("error::RuntimeWarning")  # of uncertainties that are infinite
def test_the_page_of_a_field_of_full_size_stays_small(finish, drawn_only):
    tables = changed(WAVY_LAYER, load={"friction": [0.0, 0.1]}, resolution={"levels": 2})
    tables["stress"] = {"points": [600, 200], "depth": 1.0}
    with drawn_only("fields", "near", "sections"):  # of a page of 4 MB at most
        assert len(render(finish(tables))) < 3_000_000
