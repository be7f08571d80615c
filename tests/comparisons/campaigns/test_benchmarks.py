"""Published benchmarks: the form of what is published, and two of them solved."""

import json

import pytest
from scenes import STEEL, changed, resolved

from comparisons.campaigns import benchmarks
from comparisons.campaigns.cases import carry_out
from comparisons.cli import main
from comparisons.common.errors import SceneError
from comparisons.common.progress import no_progress
from comparisons.scenes.files import benchmark_names, scene_names
from comparisons.scenes.scene import Scene

STATED = {"quantity": "peak_pressure", "value": "9.351 MPa", "source": "a manual"}
PLAIN = {
    "roller": {"radius": 4e-3, **STEEL},
    "body": STEEL,
    "load": {"per_length": 1e4},
    "published": {"p0": STATED},
}


def carried_out(out):
    how = out, None, no_progress, benchmarks.Benchmarks
    return carry_out("benchmarks", benchmarks.cases(), *how)


@pytest.fixture(scope="module")
def solved(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(benchmarks, "benchmark_names", lambda: ["vm191", "vm272"])
        return carried_out(tmp_path_factory.mktemp("benchmarks"))


def test_published_figures_agree_but_for_the_doubtful_one(solved):
    assert solved.holds and [row.case.name for row in solved.rows] == ["vm191", "vm272"]
    verdicts = {f"{name} {row[0]}": row[6] for name, rows in solved.tables.items() for row in rows}
    assert verdicts == {
        "vm191 target, 2b": "agree",
        "vm191 Mechanical APDL, 2b": "differ, doubtful",
        "vm272 2a": "agree",
        "vm272 p0": "agree",
        "vm272 stick, 2c": "agree",
    }


def test_both_models_are_shown_in_the_published_unit(solved):
    [_, peak, stick] = solved.tables["vm272"]
    assert peak[1] == "9.351 MPa"
    for texts, size, unit in ((peak[2:4], 9.351, "MPa"), (stick[2:4], 0.9930, "mm")):
        for text in texts:
            assert text.split()[1] == unit
            assert float(text.split()[0]) == pytest.approx(size, rel=2e-3)


def test_a_figure_beyond_its_scatter_differs(tmp_path, monkeypatch):
    scene = Scene.read("vm272").changed({"published.p0.value": "9.400 MPa"})
    monkeypatch.setattr(Scene, "read", lambda name: scene)
    monkeypatch.setattr(benchmarks, "benchmark_names", lambda: ["vm272"])
    campaign = carried_out(tmp_path)
    assert not campaign.holds and "p0" in str(campaign.tables)


def test_every_benchmark_says_what_is_published_and_where():
    names = benchmark_names()
    assert len(names) >= 10 and not set(names) & set(scene_names())
    for name in names:
        scene = Scene.read(name)
        assert scene.published and scene.title
        assert Scene.of(scene.tables).tables == scene.tables  # what a record repeats
        for section in scene.published.values():
            assert section.size > 0.0 and 0.0 < section.spread < 0.2 and len(section.source) > 20


def test_they_are_listed(capsys):
    assert main(["scenes", "--benchmarks", "--json"]) == 0
    assert list(json.loads(capsys.readouterr().out)) == benchmark_names()


@pytest.mark.parametrize(("value", "spread"), [("9.351 MPa", 5e-4 / 9.351), ("30 mm", 0.5 / 30)])
def test_scatter_is_at_least_that_of_the_digits(value, spread):
    quantity = "peak_pressure" if "Pa" in value else "contact_length"
    scene = resolved(
        changed(PLAIN, published={"p0": STATED | {"value": value, "quantity": quantity}})
    )
    assert scene.published["p0"].spread == pytest.approx(spread)


@pytest.mark.parametrize(
    ("entry", "said"),
    [
        ({"value": "9.351"}, 'published.p0.value: is "9.351", which has no unit'),
        ({"value": "9.351 mm"}, "published.p0.value: .*mm.*; allowed is a number and its unit"),
        ({"value": "-1 MPa"}, "published.p0.value: is -1 MPa; allowed is a size above 0"),
        ({"quantity": "weight"}, "published.p0.quantity: is .weight.; allowed is"),
        ({"doubtful": True}, "published.p0.note: is missing beside doubtful = true"),
        ({"sources": "x"}, "published.p0.sources: is no known field; the nearest is"),
    ],
)
def test_what_is_no_published_figure_is_one_line(entry, said):
    with pytest.raises(SceneError, match=said):
        resolved(changed(PLAIN, published={"p0": STATED | entry}))
