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
    # what somebody else printed there stays
    (out / "report.pdf").write_text("mine")
    assert main(arguments) == main(["report", "--pdf", str(out)]) == 2
    assert (out / "report.pdf").read_text() == "mine"
    (out / "report.pdf").unlink()
    capsys.readouterr()
    browser.write_text("#!/bin/sh\ncase $1 in --version) exit;; esac; exit 1\n", encoding="utf-8")
    assert main([*arguments, "--pdf"]) == 0
    said = capsys.readouterr().err
    assert "ended with 1 and left no PDF" in said
    assert said.count("\n") == 1
    assert (out / "report.html").exists()
