"""Twelve contacts as practitioners bring them: each names its solids, and says what decides it.

All are solved in the table of measured figures; here those that take a few seconds."""

import re

import pytest
from scenes import DATA, PROJECT, asked_in_python, run_of

from comparisons.judging.verdict.headline import headline, kind_of, within_of
from comparisons.models.posing import problem_of
from comparisons.scenes.scene import Scene, with_tolerance

CONTACTS = sorted((DATA / "contacts").glob("*.toml"))
PAGE = PROJECT / "comparisons/docs/evidence/contacts.md"


def tabled() -> dict[str, str]:
    """Verdicts by the names of the files, as the page has them."""
    text = PAGE.read_text(encoding="utf-8")
    return dict(re.findall(r"^\| `([a-z-]+)` \| [^|]* \| (\w+) \|", text, re.MULTILINE))


def test_all_are_in_the_table_and_at_least_ten_are_decided():
    verdicts = tabled()
    assert list(verdicts) == [path.stem for path in CONTACTS] and len(verdicts) == 12
    assert sum(verdict in ("HOLDS", "FAILS") for verdict in verdicts.values()) >= 10


@pytest.mark.parametrize("path", CONTACTS, ids=lambda path: path.stem)
def test_each_names_its_solids_and_keeps_the_default_tolerance(path):
    scene = Scene.read(str(path))
    assert scene.body.solid and (scene.roller.rigid or scene.roller.solid)
    assert "tolerance" not in scene.written


def small(name: str) -> Scene:
    """The scene of a contact, or the shipped one, with a field of few points."""
    contact = DATA / f"contacts/{name}.toml"
    scene = Scene.read(contact if contact.exists() else name)
    return scene.changed("stress.points", [60, 20])


@pytest.mark.parametrize("name", ["nylon-gear", "thin-strip", "rail"])
def test_verdicts_are_those_of_the_table(name):
    scene = small(name)
    said = headline(run_of(scene))
    assert said.kind.upper() == tabled()[name]
    assert all(problem_of(asked_in_python(line, scene)) for line in said.paste) and said.next


@pytest.mark.parametrize(
    ("name", "usual"),
    # the seal by the law of elasticity
    [("smooth", "fails"), ("thin-strip", "fails"), ("peek-seal", "inconclusive")],
)
def test_a_run_at_what_the_half_plane_is_right_within_holds_and_none_below(name, usual):
    scene = small(name)
    run = run_of(scene)
    size = within_of(run).size
    assert kind_of(run) == usual and size > 0.02
    at = run_of(with_tolerance(scene, size))
    least = within_of(at).size
    assert kind_of(at) == "holds" and least <= (1.0 + 1e-12) * size
    # effects that cannot change the usual verdict, but this one, are computed then
    assert (least < (1.0 - 1e-12) * size) == (name == "thin-strip")
    assert kind_of(run_of(with_tolerance(scene, 0.99 * least))) != "holds"
