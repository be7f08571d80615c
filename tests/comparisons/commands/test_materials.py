"""`crosscheck materials`: the list, one solid, JSON, and a name that no solid has."""

import json

import pytest

from comparisons.cli import main
from comparisons.scenes.materials import solids


def test_every_solid_is_listed(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "160")
    assert main(["materials"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 1 + len(solids())
    steel = next(line for line in lines if line.startswith("rail steel"))
    assert "-248 ± 6.9" in steel and steel.rstrip().endswith("egle-bray")


@pytest.mark.parametrize("name", list(solids()))
def test_one_solid_is_shown_with_all_of_its_sources(name, capsys):
    assert main(["materials", name]) == 0
    shown = " ".join(capsys.readouterr().out.split())
    solid = solids()[name]
    for key in solid.law_sources:
        assert key in shown
    for value in solid.values.values():
        assert all(key in shown for key in value.sources)


def test_json_is_a_list_of_objects_with_names(capsys):
    assert main(["materials", "--json"]) == 0
    entries = json.loads(capsys.readouterr().out)
    assert [entry["name"] for entry in entries] == list(solids())
    for entry in entries:
        sources = {key for value in entry["values"].values() for key in value["sources"]}
        assert sources <= entry["sources"].keys()
    silica = next(entry for entry in entries if entry["name"] == "fused silica")
    assert silica["third_order"]["l"] > 0.0
    assert silica["values"]["density"]["unit"] == "kg/m^3"


def test_json_of_one_solid_by_another_name(capsys):
    assert main(["materials", "Pyrex", "--json"]) == 0
    (entry,) = json.loads(capsys.readouterr().out)
    assert (entry["name"], entry["third_order"]) == ("borosilicate glass", None)


def test_an_unknown_name_is_one_line_with_the_nearest(capsys):
    assert main(["materials", "carbn steel"]) == 2
    captured = capsys.readouterr()
    assert not captured.out
    assert (
        captured.err == "crosscheck: carbn steel: is no known solid; the nearest is carbon steel\n"
    )
