"""The report as a printer gets it: whole pages of A4, nothing cut, and the command that prints: a
PDF beside the report where a browser prints one, else a sentence."""

import os
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from scenes import STEADY

from comparisons.cli import main
from comparisons.output.page.page import render
from comparisons.output.page.pdf import print_pdf

A4 = (594.96, 841.92)  # points, as a browser rounds them
POINTS_TO_PIXELS = 96.0 / 72.0
MARGIN = 10.0 / 25.4 * 96.0  # pixels to either side

# What is wider than the paper or the box that would scroll it on a screen; what a page break cuts.
CUT = """
(() => {
  const out = [];
  for (const box of document.querySelectorAll(".scroll, td, th, figure, img, p, li")) {
    if (!box.getClientRects().length) continue;
    if (box.getBoundingClientRect().right > innerWidth + 0.5) out.push(box.outerHTML);
    if (box.clientWidth && box.scrollWidth > box.clientWidth + 1) out.push(box.outerHTML);
  }
  return out.map((text) => text.slice(0, 120));
})()
"""

# The white above the table to sign, and the height of the page that it is on.
SIGNED = """
(() => {
  const box = (element) => element.getBoundingClientRect();
  const ends = [...document.querySelectorAll(".answer > :not(.signed)")].map((e) => box(e).bottom);
  const [signed, front] = [".signed", ".front"].map((name) => box(document.querySelector(name)));
  return [signed.top - Math.max(...ends), front.height];
})()
"""
LEAST_LETTERS = 6.0  # points


@pytest.fixture(scope="module")
def levels_file(finish, drawn_only, tmp_path_factory) -> Path:
    """The words of the report of a run with as many levels as there are columns for."""
    page = tmp_path_factory.mktemp("levels") / "report.html"
    outcome = finish({**STEADY, "resolution": {"levels": 6}})
    with drawn_only():
        page.write_text(render(outcome), encoding="utf-8")
    return page


@pytest.mark.parametrize("name", ["wavy_file", "levels_file"])
def test_nothing_is_wider_than_the_paper(tab, request, name):
    page = tab(request.getfixturevalue(name), 1280)
    page.ask("Emulation.setEmulatedMedia", media="print")
    page.ask("Emulation.setScrollbarsHidden", hidden=True)
    page.resize(round(A4[0] * POINTS_TO_PIXELS - 2.0 * MARGIN))
    assert page.value(CUT) == []
    tallest = page.value(
        "Math.max(0, ...[...document.querySelectorAll('figure')].map((f) => f.offsetHeight))"
    )
    assert tallest < A4[1] * POINTS_TO_PIXELS - 100.0  # a figure that a page holds is not cut
    white, first = page.value(SIGNED)
    assert 0.0 <= white < 20.0 and first < A4[1] * POINTS_TO_PIXELS - 2.0 * MARGIN
    for size, text in page.letters():
        assert size >= LEAST_LETTERS, text
    shown = page.value("[...document.querySelectorAll('.hint')].map((e) => e.offsetHeight)")
    assert set(shown) == {0}


def test_a_printed_report_has_pages_of_a4(browser, wavy_file):
    printed = wavy_file.with_name("report.pdf")
    assert print_pdf(wavy_file, printed) == ""
    content = printed.read_bytes()
    boxes = re.findall(rb"/MediaBox \[0 0 ([\d.]+) ([\d.]+)\]", content)
    assert 5 <= len(boxes) <= 8
    for box in boxes:
        assert tuple(map(float, box)) == pytest.approx(A4, abs=0.5)
    assert {path.name for path in wavy_file.parent.iterdir()} == {"report.html", "report.pdf"}


@pytest.fixture
def stub(tmp_path, monkeypatch) -> Callable[..., None]:
    """`stub(script)`: what stands for a browser, a line of a shell, alone on the PATH; or with
    `prepend` before all that is there."""
    program = tmp_path / "bin" / "chromium"
    program.parent.mkdir()

    def written(script: str, prepend: str | None = None) -> None:
        program.write_text(f"#!/bin/sh\n{script}\n", encoding="utf-8")
        program.chmod(0o755)
        monkeypatch.setenv("PATH", str(program.parent), prepend)

    return written


STARTS = "case $1 in --version) exit;; esac; "


@pytest.mark.parametrize(
    ("script", "message"),
    [
        ("exit 1", "no Chromium or Chrome starts here; apt-get install"),
        (STARTS + "sleep 60", "did not end within 1 s"),
        (
            STARTS + 'for a in "$@"; do case $a in --print-to-pdf=*) '
            "printf '%%PDF-1.4 torn' > \"${a#*=}\";; esac; done",
            "left no PDF",
        ),
    ],
    ids=["a stub", "hangs", "torn"],
)
def test_without_a_whole_pdf_there_is_none_and_a_sentence(tmp_path, stub, script, message):
    stub(f"PATH=/usr/bin:/bin; {script}")
    page, target = tmp_path / "page.html", tmp_path / "page.pdf"
    page.write_text("<p>page</p>", encoding="utf-8")
    target.write_bytes(b"before")
    said = print_pdf(page, target, patience=1.0)
    assert message in said and "\n" not in said
    assert target.read_bytes() == b"before"
    assert sorted(p.name for p in tmp_path.iterdir()) == ["bin", "page.html", "page.pdf"]


SCENE = """
roller = {radius = 0.01, rigid = true}
body = {youngs_modulus = 210e9, poissons_ratio = 0.3}
load = {hertz_peak_pressure = 1e9}
resolution = {pitch = "8 um"}
"""
PRINTS = """for a in "$@"; do case $a in --print-to-pdf=*)
printf '%%PDF-1.4\\nprinted\\n%%%%EOF\\n' > "${a#*=}";; esac; done
"""


def test_a_run_is_printed_if_that_is_asked_for(tmp_path: Path, stub, capsys, drawn_only):
    scene, out = tmp_path / "scene.toml", tmp_path / "out"
    scene.write_text(SCENE, encoding="utf-8")
    arguments = ["run", str(scene), "--models", "half-plane", "--out", str(out)]
    stub(PRINTS, os.pathsep)
    with drawn_only():
        assert main([*arguments, "--pdf"]) == 0
        assert (out / "report.pdf").read_text() == "%PDF-1.4\nprinted\n%%EOF\n"
        # what is asked for no more would be that of another run
        assert main(arguments) == 0
    assert not (out / "report.pdf").exists()
    # what somebody else printed there stays
    (out / "report.pdf").write_text("mine")
    assert main(arguments) == main(["report", "--pdf", str(out)]) == 2
    assert (out / "report.pdf").read_text() == "mine"
    (out / "report.pdf").unlink()
    capsys.readouterr()
    stub(f"{STARTS} exit 1")
    with drawn_only():
        assert main([*arguments, "--pdf"]) == 0
    said = capsys.readouterr().err
    assert "ended with 1 and left no PDF" in said
    assert said.count("\n") == 1
    assert (out / "report.html").exists()
