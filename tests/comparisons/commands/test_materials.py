"""`crosscheck materials`: the list, one solid, JSON, and a name that no solid has."""

import json
from math import inf

import pytest
from scenes import PROJECT, page_rows
from strain_limits import strain_limit

from analytic.material.third_order import peak_change
from comparisons.cli import main
from comparisons.commands.materials import solids_table
from comparisons.scenes.materials import ANY, WIDER, bounding_solids, solids

PAGE = (PROJECT / "comparisons/docs/reference.md").read_text(encoding="utf-8")


def test_the_page_has_the_table_that_the_command_prints():
    columns = [list(column.cells) for column in solids_table(list(solids().values())).columns]
    assert page_rows(PAGE, "solid") == [list(row) for row in zip(*columns, strict=True)]


def test_the_page_has_the_changes_of_a_contact_and_the_limits_of_strain():
    measured = [solid for solid in solids().values() if solid.has_constants]
    rows = page_rows(PAGE, "of")
    assert [row[0] for row in rows] == [solid.name for solid in measured]
    for solid, (_, *cells) in zip(measured, rows, strict=True):
        law, material = solid.law, solid.material
        ratios = [constant / material.shear_modulus for constant in law.murnaghan]
        assert cells[:3] == [f"{ratio:.2f}" for ratio in ratios]
        assert cells[3] == f"{peak_change(law, material):+.2f}"
        limit = strain_limit(law, material)
        shear = "none" if limit.shear == inf else f"{limit.shear:.2f}"
        assert cells[6:] == [f"{limit.compression:.2f}", shear]


def test_the_page_has_the_solids_that_bound_a_class():
    known = sorted({*(solid.kind for solid in solids().values()), *WIDER.values(), ANY})
    for kind, *names in page_rows(PAGE, "bounded class"):
        if kind != "rubber":
            assert names == [solid.name for solid in bounding_solids(kind, 210e9, 0.3)]
    assert [row[0] for row in page_rows(PAGE, "bounded class")] == known


def test_every_solid_is_listed(capsys):
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
    words = [word for text in (solid.note, solid.missing) for word in text.split()]
    assert all(word in shown for word in words)
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
    assert silica["law"]["murnaghan"][0] > 0.0
    assert silica["values"]["density"]["unit"] == "kg/m^3"


def test_json_of_one_solid_by_another_name(capsys):
    assert main(["materials", "Pyrex", "--json"]) == 0
    (entry,) = json.loads(capsys.readouterr().out)
    assert (entry["name"], entry["law"]) == ("borosilicate glass", None)
    assert entry["bounded_by"] == ["fused silica", "aluminium alloy"]


def test_an_unknown_name_is_one_line(complaint):
    said = 'crosscheck: carbn steel: is no known solid; did you mean "carbon steel"?'
    assert complaint("materials", "carbn steel") == said
