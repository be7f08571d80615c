"""The page over many runs: every run, sorted by any head, by mouse and keyboard, or as it came."""

from dataclasses import replace
from pathlib import Path

import pytest
from scenes import WAVY_LAYER

from comparisons.judging.study import Run
from comparisons.output.page.summary import Report, summary_page
from comparisons.output.result import result_of

ENTER = 13


@pytest.fixture(scope="module")
def rows(wavy_outcome, smooth_outcome, finish) -> list[Report]:
    layer = finish({**WAVY_LAYER, "title": "A <layer> & more"}, ("half_plane",))
    results = map(result_of, (wavy_outcome, layer, smooth_outcome))
    return [Report(result, Path("report.html")) for result in results]


@pytest.fixture(scope="module")
def summary(rows: list[Report], tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("over")
    moved = [
        replace(row, page=place / f"run {number}" / "report.html")
        for number, row in enumerate(rows)
    ]
    page = place / "summary.html"
    page.write_text(summary_page(moved, place), encoding="utf-8")
    return page


def titles(page) -> list[str]:
    return page.value("[...document.querySelectorAll('.runs tbody a')].map((a) => a.textContent)")


def column(page, head: str) -> int:
    heads = page.value("[...document.querySelectorAll('.runs thead th')].map((t) => t.textContent)")
    return heads.index(head)


def test_a_run_has_the_figures_of_its_result(rows: list[Report], wavy_outcome: Run):
    cells, figures = rows[0].cells, wavy_outcome.figures
    slope = figures.one(study="problem", source="scene", quantity="rms_slope")
    assert cells["rms_slope"].value == slope.value
    peaks = figures.of(study="contact", source="finite_element", quantity="peak_pressure")
    assert cells["peak_pressure"].value == max(figure.value for figure in peaks)
    errors = figures.of(study="model_error", quantity="peak_pressure")
    worst = max(errors, key=lambda error: abs(error.value) + error.numerical)
    cell = cells["model_error_peak_pressure"]
    assert cell.value == abs(worst.value)
    assert cell.note.startswith("± ") and cell.note.endswith(" %, tolerance 2 %")
    seconds = sum(wavy_outcome.runs["half_plane"].seconds.values())
    assert cells["seconds_half_plane"].value == pytest.approx(seconds)
    assert "seconds_finite_element" not in rows[1].cells


@pytest.mark.parametrize("width", [1280, 390])
def test_the_summary_fits_and_leads_to_every_report(tab, summary, rows, width):
    page = tab(summary, width)
    assert page.complaints() == []
    assert page.value("document.documentElement.scrollWidth") <= width
    assert titles(page) == [row.title for row in rows]
    links = page.value("[...document.querySelectorAll('a')].map((a) => a.getAttribute('href'))")
    assert links == [f"run%20{number}/report.html" for number in range(3)]


def test_a_head_sorts_and_sorts_back(tab, summary, rows):
    page = tab(summary, 1280)
    at = column(page, "peak pressure")
    by_peak = sorted(rows, key=lambda row: row.cells["peak_pressure"].value)
    ascending = [row.title for row in by_peak]
    assert ascending not in ([row.title for row in rows], [row.title for row in rows][::-1])
    head = f"document.querySelectorAll('.runs thead th')[{at}]"
    page.value(f"{head}.querySelector('button').click()")
    assert titles(page) == ascending
    assert page.value(f"{head}.getAttribute('aria-sort')") == "ascending"
    page.value(f"{head}.querySelector('button').focus()")
    page.press("Enter", ENTER, "\r")
    assert titles(page) == ascending[::-1]
    assert page.value(f"{head}.getAttribute('aria-sort')") == "descending"
    # a run without the figure stands last in either order
    at = column(page, "time, finite elements")
    for _ in range(2):
        page.value(f"document.querySelectorAll('.runs thead button')[{at}].click()")
        assert titles(page)[-1] == "A <layer> & more"
    page.value("document.querySelectorAll('.runs thead button')[0].click()")
    assert titles(page) == sorted(row.title for row in rows)
    assert page.value("document.querySelectorAll('[aria-sort]').length") == 1
