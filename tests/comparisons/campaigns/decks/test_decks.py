"""Decks as text: complete, consistent, and of the scene. FEniCSx' script is solved."""

import re
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest
import scenes

import comparisons as crosscheck
from comparisons.api import scene_of
from comparisons.campaigns.decks.problem import deck_problem
from comparisons.campaigns.decks.write import make_deck
from comparisons.cli import main
from comparisons.common.errors import SceneError
from comparisons.models.posing import problem_of

KNOWN = {  # keywords of CalculiX that a deck may use
    *("HEADING", "INCLUDE", "NODE", "ELEMENT", "NSET", "SURFACE", "EQUATION", "MATERIAL"),
    *("ELASTIC", "HYPERELASTIC", "SOLID SECTION", "SURFACE INTERACTION", "SURFACE BEHAVIOR"),
    *("CONTACT PAIR", "FRICTION", "CHANGE FRICTION", "BOUNDARY", "CLOAD", "STEP", "STATIC"),
    *("END STEP", "NODE FILE", "EL FILE", "CONTACT FILE"),
}
SLIDING = scenes.changed(crosscheck.Scene.read("coated").written, load={"friction": [0.0, 0.1]})


def blocks(folder: Path) -> list[tuple[str, dict[str, str], list[list[str]]]]:
    """Keyword, parameters and data lines, with the text of included files."""
    text = (folder / "job.inp").read_text()
    for name in re.findall(r"\*INCLUDE, INPUT=(\S+)", text):
        text = text.replace(f"*INCLUDE, INPUT={name}\n", (folder / name).read_text())
    cards = []
    for line in text.splitlines():
        if line.startswith("**"):
            continue
        if line.startswith("*"):
            keyword, *settings = [part.strip() for part in line[1:].split(",")]
            parameters = dict((*part.split("="), "")[:2] for part in settings)
            cards.append((keyword, parameters, []))
        elif line.strip():
            cards[-1][2].append([part.strip() for part in line.split(",")])
    return cards


@pytest.mark.parametrize("scene", ["layer", "finite-strain", SLIDING])
def test_a_deck_is_complete(tmp_path, scene):
    resolved = scene_of(scene)
    made = make_deck(resolved, "calculix")
    made.write(tmp_path)
    deck = made.problem
    cards = blocks(tmp_path)
    assert {keyword for keyword, *_ in cards} <= KNOWN
    nodes, elements, sets, surfaces, materials = {}, {}, {}, {}, set()
    for keyword, options, data in cards:
        if keyword == "NODE":
            nodes |= {int(n): (float(x), float(y)) for n, x, y in data}
            sets[options["NSET"]] = [int(row[0]) for row in data]
        elif keyword == "ELEMENT":
            assert options["TYPE"] == "CPE6"
            elements |= {int(e): list(map(int, row)) for e, *row in data}
            sets[options["ELSET"]] = [int(row[0]) for row in data]
        elif keyword == "NSET":
            sets[options["NSET"]] = [int(n) for row in data for n in row]
        elif keyword == "SURFACE":
            surfaces[options["NAME"]] = [(int(e), int(face[1])) for e, face in data]
        elif keyword == "MATERIAL":
            materials.add(options["NAME"])
        elif keyword == "SOLID SECTION":
            assert options["ELSET"] in sets and options["MATERIAL"] in materials
        elif keyword == "BOUNDARY":
            assert all(row[0] in sets for row in data)
        elif keyword == "CONTACT PAIR":
            assert set(data[0]) == set(surfaces) == {"ROUGH_TOP", "ROLLER_TOP"}
        elif keyword == "EQUATION":
            assert data[0] == ["2"] and int(data[1][3]) == max(nodes) and data[1][4] == "2"
            assert int(data[1][0]) in sets["ROLLER_HELD_Y"]
    assert len(nodes) == deck.nodes + 1
    assert set(np.ravel(list(elements.values()))) == set(nodes) - set(sets["REFERENCE"])
    for row in elements.values():  # anticlockwise, with midpoints between their corners
        x, y = np.array([nodes[n] for n in row]).T
        assert (x[1] - x[0]) * (y[2] - y[0]) > (y[1] - y[0]) * (x[2] - x[0])
        bend = np.hypot(x[3:] - 0.5 * (x[:3] + x[[1, 2, 0]]), y[3:] - 0.5 * (y[:3] + y[[1, 2, 0]]))
        assert bend.max() < 0.1 * np.hypot(x[1] - x[0], y[1] - y[0])
    for name, faces in surfaces.items():
        on = {elements[e][k] for e, face in faces for k in (face - 1, face % 3, face + 2)}
        assert on == set(sets[f"{name}_NODES"])
    (load,) = {row[2] for keyword, _, data in cards if keyword == "CLOAD" for row in data}
    assert float(load) == pytest.approx(-1e-3 * problem_of(resolved).hertz.load_per_length)
    steps = [keyword for keyword, *_ in cards].count("STEP")
    slides = [mu for mu in resolved.load.friction if mu]
    assert steps == 1 + len(slides) + deck.finite
    finite = {bool(options.get("NLGEOM")) for keyword, options, _ in cards if keyword == "STEP"}
    assert finite == {deck.finite}
    answer = tomllib.loads((tmp_path / "answer.toml").read_text())
    assert answer["units"] == {"length": "mm", "stress": "MPa"}


def test_a_roller_that_friction_holds_is_let_go_along_x(tmp_path):
    """Tied along both axes, held while it is pressed, then loaded step by step."""
    slip = {"loads": [0.5, -0.25]}
    tables = scenes.changed(scenes.SMOOTH, load={"friction": [0.1, 0.3]}) | {"partial_slip": slip}
    make_deck(scenes.resolved(tables), "calculix").write(tmp_path)
    cards = blocks(tmp_path)
    tied = [data[1][1] for keyword, _, data in cards if keyword == "EQUATION"]
    assert tied.count("1") == tied.count("2") > 0
    loads = [float(r[2]) for word, _, data in cards if word == "CLOAD" for r in data if r[1] == "1"]
    limit = 0.3e-3 * scenes.problem(tables).hertz.load_per_length
    assert loads == pytest.approx([0.5 * limit, -0.25 * limit])
    *_, pressed, first, last = (data for word, _, data in cards if word == "BOUNDARY")
    assert ["REFERENCE", "1", "1"] in pressed
    assert first == last == [["ROUGH_HELD_X", "1", "1"], ["ROUGH_HELD_Y", "2", "2"]]
    [friction] = [data for keyword, _, data in cards if keyword == "FRICTION"]
    assert float(friction[0][0]) == 0.3


def test_a_linear_deck_is_the_scene_in_flatter_form():
    """Heights over, moduli times the same factor: the gap between the two tops is the scene's."""
    problem = scenes.problem(crosscheck.Scene.read("sinusoid").written)
    deck = deck_problem(problem, problem.pitches[0])
    top = deck.rough.points[deck.rough.surface]
    gap = 1e-3 * deck.flatter * (deck.roller.points[deck.roller.surface, 1].max() - top[:, 1])
    inside = abs(1e-3 * top[:, 0]) < problem.extent[1]
    wanted = problem.gap(1e-3 * top[inside, 0]) - problem.first_touch
    assert gap[inside] == pytest.approx(wanted, abs=1e-6 * wanted.max())
    moduli = [body.materials[0].youngs_modulus / deck.flatter for body in deck.bodies.values()]
    assert moduli == pytest.approx([210e9, 210e9])


STRETCHED = scenes.changed(scenes.SMOOTH, load={"friction": 0.3})
YIELDING = crosscheck.Scene.read("yielding").written
TWICE = scenes.changed(YIELDING, load={"friction": [0.0, 0.1]})
STRETCHED |= {"partial_slip": {"load": 0.5, "bulk_stress": 1e8}}


def test_what_a_code_cannot_have_is_refused(tmp_path):
    hencky = scenes.changed(crosscheck.Scene.read("finite-strain").written, body={"law": "hencky"})
    for tables, code, said in (
        (hencky, "calculix", "body.law"),
        (hencky, "fenicsx", "flat ones"),
        (YIELDING, "fenicsx", "finite_element.plastic"),
        (scenes.changed(scenes.SMOOTH, body={"hardness": 3e9}), "calculix", "body.hardness"),
        (STRETCHED, "calculix", "partial_slip.bulk_stress"),
        (TWICE, "calculix", "load.friction: has 2"),
    ):
        with pytest.raises(SceneError, match=said):
            make_deck(scenes.resolved(tables), code)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("level", [1, 2])
def test_the_script_for_fenicsx_solves_the_scene(tmp_path, level):
    """Errors of Hertz's peak pressure and half-width fall with the elements."""
    make_deck(scene_of("smooth"), "fenicsx", level).write(tmp_path)
    subprocess.run([sys.executable, "solve.py"], cwd=tmp_path, check=True, capture_output=True)
    x, pressure = np.loadtxt(tmp_path / "pressure.csv", delimiter=",", skiprows=1).T
    hertz = scenes.problem(crosscheck.Scene.read("smooth").written).hertz
    assert pressure.max() == pytest.approx(1e-6 * hertz.peak_pressure, rel=1e-3 / level)
    exact = np.sqrt(np.maximum(1.0 - (1e-3 * x / hertz.half_width) ** 2, 0.0)) * pressure.max()
    assert np.sqrt(np.mean((pressure - exact) ** 2)) < 0.03 / level * pressure.max()


def test_the_command_says_where_the_deck_is(tmp_path, capsys):
    out = tmp_path / "deck"
    assert main(["deck", "layer", "--for", "calculix", "--out", str(out)]) == 0
    assert str(out / "README.md") in capsys.readouterr().out
    assert f"--answer calculix={out}/answer.toml" in (out / "README.md").read_text()
    assert main(["deck", "layer", "--for", "calculix", "--out", str(out), "--level", "0"]) == 2
