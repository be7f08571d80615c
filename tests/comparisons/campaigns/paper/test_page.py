"""The paper computed anew at low resolution: what its page, numbers, files and pictures hold."""

import json
import re
from html import unescape
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from comparisons import cli
from comparisons.campaigns.paper import pictures, reproduce
from comparisons.campaigns.paper.claims import OUTCOMES, SCENES, book_claims, claims
from comparisons.campaigns.paper.readings import SLIDING
from comparisons.campaigns.paper.reproduce import FRICTIONS
from comparisons.common.errors import ExitStatus, InputError
from comparisons.figures.quantity import LABELS, MODELS
from comparisons.output.terminal import PLAIN

COARSE = {"resolution.pitch": 80e-6, "stress.points": (40, 20)}
PICTURES = 1 + 2 + 3 * len(SCENES) + 4 + 2


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """The finished paper, its folder, and its figures in the order of the page."""
    figures, real = [], pictures._picture
    with pytest.MonkeyPatch.context() as patch:

        def keep(drawn, *texts, **look):
            figures.append(drawn)
            return real(drawn, *texts, **look)

        patch.setattr(pictures, "_picture", keep)
        out = tmp_path_factory.mktemp("paper") / "out"
        paper = reproduce.paper(out, COARSE, lambda stage: None)
    return SimpleNamespace(paper=paper, out=out, figures=figures)


@pytest.fixture(scope="module")
def page(made) -> str:
    return (made.out / "paper.html").read_text(encoding="utf-8")


def attributes(name: str, page: str) -> list[str]:
    """Values of all attributes of a name, such as "id"."""
    return re.findall(rf' {name}="([^"]*)"', page)


def words_of(page: str) -> str:
    """The text that a reader sees, with plain blanks."""
    text = unescape(re.sub(r"<[^>]*>", " ", page))
    return " ".join(text.split()).replace("\u00a0", " ").replace("\u2060", "")


def test_the_page_holds_every_figure_and_needs_no_network(page):
    sources, alternatives = attributes("src", page), attributes("alt", page)
    assert len(sources) == len(set(alternatives)) == PICTURES == 21
    assert all(source.startswith("data:image/svg+xml;base64,") for source in sources)
    assert min(map(len, alternatives)) > 40
    sections = [place for place in attributes("id", page) if place.startswith("figure-")]
    numbers = ("1", "5", "6", "8", "9", "10", "11", "seireg", "seireg-heat")
    assert sections == [f"figure-{number}" for number in numbers]
    links = attributes("href", page) + attributes("srcset", page)
    assert links and all(link.startswith(("#", "data:")) for link in links)


def test_the_page_holds_every_claim_with_its_outcome(made, page):
    text, places = words_of(page), attributes("id", page)
    assert len(places) == len(set(places))
    for judged in made.paper.judged:
        claim = judged.claim
        assert f"claim-{claim.key}" in places
        assert f"#claim-{claim.key}" in attributes("href", page)
        for words in (claim.text, claim.measure, claim.criterion, judged.why or ""):
            assert " ".join(words.split()) in text
    assert len(made.paper.judged) == len(claims()) + len(book_claims())


def test_on_a_telephone_each_number_of_a_claim_has_its_name(page):
    table = page[page.index('<table class="claims') : page.index("</table>")]
    heads = re.findall(r"<th scope=\"col\">(.*?)</th>", table)
    for row in table.split("<tr ")[1:]:
        assert attributes("data-name", row) == heads[1:]
        assert row.count("<td") == len(heads) - 1


def test_numbers_hold_what_the_page_says(made):
    content = json.loads((made.out / "paper.json").read_text(encoding="utf-8"))
    listed = [*claims(), *book_claims()]
    assert [claim["key"] for claim in content["claims"]] == [c.key for c in listed]
    assert sum(content["outcomes"].values()) == len(content["claims"])
    assert set(content["outcomes"]) == set(OUTCOMES) and set(content["surfaces"]) == set(SCENES)
    for claim, judged in zip(content["claims"], made.paper.judged, strict=True):
        assert set(claim["numbers"]) == set(judged.claim.models)
        assert (claim["why"] is None) == (claim["outcome"] != "inconclusive")
        for model, number in claim["numbers"].items():
            assert number["value"] == judged.numbers[model].value
            assert number["uncertainty"] >= 0.0
    assert content == made.paper.as_dict()


def test_exact_figures_are_met_even_so_coarsely(made):
    numbers = {judged.claim.key: judged.numbers for judged in made.paper.judged}
    for key, exact in (("smooth-tau1", 0.300283), ("smooth-txz", 0.25), ("smooth-depth", 0.786151)):
        for number in numbers[key].values():
            assert abs(number.value - exact) <= max(number.numerical, 2e-3)
    assert numbers["load"]["half_plane"].value == pytest.approx(1.0, abs=1e-8)
    assert numbers["edge-friction"]["finite_element"].value > 1.05


class TestPictures:
    def test_pressures_share_one_scale_and_are_over_hertz(self, made):
        trace, panels = made.figures[0], made.figures[3:15:3]
        limits = {axes.get_ylim() for figure in (trace, *panels) for axes in figure.axes[:1]}
        assert len(limits) == 1
        assert len({figure.axes[1].get_ylim() for figure in panels}) == 1
        for figure, name in zip(panels, SCENES, strict=True):
            run = made.paper.runs[name].runs["half_plane"].finest
            p0 = made.paper.runs[name].problem.hertz.peak_pressure
            above, below = figure.axes
            lines = {line.get_label(): line.get_ydata() for line in above.lines}
            assert {LABELS[name] for name in MODELS} <= set(lines)
            assert max(lines["half-plane"]) == run.solution.pressure.max() / p0
            assert max(lines["half-plane"]) < above.get_ylim()[1]
            assert (above.get_xlabel(), above.get_ylabel()) == ("", "p/p₀")
            assert (below.get_xlabel(), below.get_ylabel()) == ("x/a", "height [µm]")

    def test_the_trace_has_the_papers_axis(self, made):
        axes = made.figures[0].axes[1]
        np.testing.assert_allclose(axes.get_xticks(), [0, 559, 1118, 1677, 2236], atol=1e-6)
        assert "µm" in axes.get_xlabel()
        assert "25 µm" in [text.get_text() for text in axes.texts]

    def test_shear_has_one_scale_for_all_surfaces(self, made):
        for contours in (made.figures[4:15:3], made.figures[5:15:3]):  # orthogonal, principal
            assert len(contours) == len(SCENES)
            bars = [figure.axes[-1] for figure in contours]
            assert len({(bar.get_xlim(), tuple(bar.get_xticks())) for bar in bars}) == 1
            for figure in contours:
                assert len(figure.axes) == len(FRICTIONS) + 1
                assert figure.axes[-2].get_xlabel() == "x/a"
                assert {axes.get_ylabel() for axes in figure.axes[:-1]} == {"z/a"}
                assert any(t.get_text().endswith("/p₀") for t in figure.axes[-1].texts)


@pytest.mark.parametrize("step", ["solve_surfaces", "paper_page"])
def test_an_interrupt_leaves_nothing(monkeypatch, tmp_path, capsys, step):
    def stopped(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(reproduce, "solve_surfaces", lambda *_, **__: {})
    monkeypatch.setattr(reproduce, "claims", tuple)
    monkeypatch.setattr(reproduce, step, stopped)
    assert cli.main(["paper", "--out", str(tmp_path / "out")]) == ExitStatus.INTERRUPTED
    said = "crosscheck: interrupted; nothing was written, the same command starts again\n"
    assert capsys.readouterr() == ("", said)
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_cannot_be_is_refused_before_solving(monkeypatch, tmp_path):
    monkeypatch.setattr(reproduce, "solve_surfaces", None)
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="not a folder"):
        reproduce.paper(tmp_path / "file")


def test_the_model_error_stands_beside_each_claim_of_a_real_contact(made, page):
    content = json.loads((made.out / "paper.json").read_text(encoding="utf-8"))
    claims_in_json = {claim["key"]: claim for claim in content["claims"]}
    for claim in claims():
        error = claims_in_json[claim.key]["model_error"]
        assert (error is None) == (claim.quantity is None)
        if error is not None:
            friction = SLIDING if claim.slides else 0.0
            errors = made.paper.runs[claim.scene].data("model_error")
            assert error["quantity"] == claim.quantity
            assert error["value"] == errors.of(claim.quantity, friction).value
    text = words_of(page)
    assert text.count("Model error of the half-plane in this figure:") == sum(
        claim.quantity is not None for claim in claims()
    )
    # finite deformation was not computed: its estimate stands there
    left = claims_in_json["twice-unrun"]["model_error"]["not_modelled"]
    assert left["finite_strain"] > 0.05
    assert "not modelled, by estimate: at most" in text


@pytest.mark.parametrize("arguments", [[], ["--json"]])
def test_the_command_prints_the_claims(made, monkeypatch, capsys, arguments):
    calls = []

    def reproduced(out: Path, callback, effects):
        assert effects is False
        calls.append(out)
        return made.paper

    monkeypatch.setattr(reproduce, "paper", reproduced)
    assert cli.main(["paper", *arguments]) == ExitStatus.DONE
    out, err = capsys.readouterr()
    assert calls == [Path("results/paper")] and err == ""
    if arguments:
        assert json.loads(out) == made.paper.as_dict()
    else:
        titles = (judged.claim.title.split(",")[0] for judged in made.paper.judged)
        assert all(title.translate(PLAIN) in out.translate(PLAIN) for title in titles)
        assert "inconclusive" in out and "paper.html" in out
