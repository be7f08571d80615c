"""`run --pdf`: a PDF beside the report where a browser prints one, else a sentence."""

import os
from pathlib import Path

from comparisons.cli import main

SCENE = """
roller = {radius = 0.01, rigid = true}
body = {youngs_modulus = 210e9, poissons_ratio = 0.3}
load = {hertz_peak_pressure = 1e9}
resolution = {pitch = "8 um"}
"""
PRINTS = """#!/bin/sh
for a in "$@"; do case $a in --print-to-pdf=*)
printf '%%PDF-1.4\\nprinted\\n%%%%EOF\\n' > "${a#*=}";; esac; done
"""


def test_a_run_is_printed_if_that_is_asked_for(tmp_path: Path, monkeypatch, capsys, no_pictures):
    monkeypatch.setattr("comparisons.output.page.page.draw", no_pictures)
    monkeypatch.setattr("comparisons.output.page.pdf.BROWSERS", ("chromium",))
    scene, out = tmp_path / "scene.toml", tmp_path / "out"
    scene.write_text(SCENE, encoding="utf-8")
    arguments = ["run", str(scene), "--models", "half-plane", "--out", str(out)]
    browser = tmp_path / "bin" / "chromium"
    browser.parent.mkdir()
    monkeypatch.setenv("PATH", str(browser.parent), prepend=os.pathsep)
    browser.write_text(PRINTS, encoding="utf-8")
    browser.chmod(0o755)
    assert main([*arguments, "--pdf"]) == 0
    assert (out / "report.pdf").read_text() == "%PDF-1.4\nprinted\n%%EOF\n"
    # what is asked for no more would be that of another run
    assert main(arguments) == 0
    assert not (out / "report.pdf").exists()
    capsys.readouterr()
    # one that prints nothing, and one that does not even start, as Ubuntu's without its snap
    for script, why in (
        ("case $1 in --version) exit 0;; esac; exit 1", "ended with 1 and left no PDF"),
        ("exit 1", "no Chromium or Chrome starts here"),
    ):
        browser.write_text(f"#!/bin/sh\n{script}\n", encoding="utf-8")
        assert main([*arguments, "--pdf"]) == 0
        said = capsys.readouterr().err
        assert why in said
        assert said.count("\n") == 1
        assert (out / "report.html").exists()
