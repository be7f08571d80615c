"""Cost studies: what is measured, by what errors are measured, what is recommended and follows."""

import io
import json
import re
from html import unescape

import pytest
from scenes import SMOOTH, changed, resolved

from analytic.exact.hertz import hertz_from_load
from comparisons.campaigns.cost import methods as cost_methods
from comparisons.campaigns.cost.cost import cost
from comparisons.campaigns.cost.measure import FOLDER, OK
from comparisons.campaigns.cost.methods import FINEST, METHODS
from comparisons.campaigns.cost.recommend import scene_sections
from comparisons.campaigns.cost.show import cells, content_of, cost_table, shown
from comparisons.cli import main
from comparisons.output.terminal import PLAIN
from comparisons.runs.run import run
from comparisons.studies.contact import values_of

HERTZ = hertz_from_load(3.55e6, 7.5706e-3, 210e9 / 0.91 / 2.0)
BY_NAME = {method.name: method for method in METHODS}
SMALL = (FINEST, BY_NAME["P2"])


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    """A whole study of two methods at three and two settings, and its folder."""
    folder = tmp_path_factory.mktemp("cost") / "out"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(cost_methods, "HALF_PLANE_PITCHES", (2.0, 1.0, 0.5))
        patch.setattr(cost_methods, "FINITE_ELEMENT_PITCHES", (2.0, 1.0))
        return cost(resolved(SMOOTH), folder, 2, methods=SMALL), folder


class TestWholeStudy:
    def test_every_setting_is_a_row_measured_by_hertz(self, small):
        study, _ = small
        assert [r.method.name for r in study.rows] == ["hats, FFT"] * 3 + ["P2"] * 2
        for row in study.rows:
            assert row.status == OK and row.measured.repeats == 2
            peak = row.measured.values[0]["peak_pressure"]
            exact = abs(peak / HERTZ.peak_pressure - 1.0)
            assert row.errors["peak_pressure"].value == pytest.approx(exact, rel=1e-6)
            assert 0.0 < exact < 2e-3
        assert study.references["peak_pressure"].source == "exact (Hertz)"

    def test_time_stages_and_memory(self, small):
        study, _ = small
        half_plane, finite = study.rows[:3], study.rows[3:]
        assert set(finite[0].measured.seconds) >= {"mesh", "assembly", "factorisation", "contact"}
        assert 0.0 < half_plane[-1].seconds(True) < finite[-1].seconds(True) < 5.0
        assert 2e7 < half_plane[-1].measured.memory < finite[-1].measured.memory

    def test_the_recommendation_followed_meets_the_tolerance(self, small, tmp_path, monkeypatch):
        """By what `run` makes of it: at that level, and where it ends."""
        monkeypatch.setattr("comparisons.output.page.page.render", lambda *_: "")
        study, _ = small
        choice = study.recommendations[-1]
        assert choice.quantity == "all" and choice.finite_element is not None
        for picked in (choice.half_plane, choice.finite_element):
            wanted = picked.method.model
            sections = scene_sections(picked, study.problem)
            outcome = run(resolved(changed(SMOOTH, **sections)), tmp_path / wanted, (wanted,))
            level = outcome.runs[wanted].levels[sections["resolution"]["levels"] - 1]
            assert level.grid.pitch == pytest.approx(picked.setting, rel=1e-12)
            reached = values_of(level, outcome.problem, 0.0)
            for name, exact in (
                ("peak_pressure", HERTZ.peak_pressure),
                ("contact_length", 2.0 * HERTZ.half_width),
            ):
                figure = outcome.figures.one(study="contact", quantity=name)
                assert abs(figure.value / exact - 1.0) <= study.problem.scene.tolerances[name]
                error = abs(reached[name] / exact - 1.0)
                assert error == pytest.approx(picked.errors[name].value, rel=0.02, abs=1e-9)
                assert error <= study.problem.scene.tolerances[name]

    def test_files(self, small):
        study, folder = small
        assert {p.name for p in folder.iterdir()} == {"cost.json", "cost.html", FOLDER}
        content = json.loads((folder / "cost.json").read_text())
        assert content == json.loads(json.dumps(content_of(study)))
        assert len(content["rows"]) == 5 and content["machine"]["threads"] == 1
        last = content["recommendations"][-1]
        assert content["rows"][last["finite_element"]["row"]]["method"] == "P2"
        assert "peak_pressure" in content["rows"][0]["best_for"] + content["rows"][2]["best_for"]

    def test_page_needs_no_network_and_has_all_rows_and_sentences(self, small):
        study, folder = small
        page = unescape((folder / "cost.html").read_text())
        assert "http://" not in page and "https://" not in page and "<script" not in page
        assert page.count('<tr class="ok">') == 5
        assert page.count("data:image/svg+xml") == 3
        for choice in study.recommendations:
            assert choice.sentence in page
        assert """finite_element = {element = "P2", growth = 0.""" in page

    def test_table(self, small):
        from rich.console import Console

        study, _ = small
        console = Console(width=140, record=True, file=io.StringIO())
        console.print(cost_table(study))
        text = console.export_text()
        assert "For all tolerances of the scene take the half-plane (hats, FFT" in text
        assert "threads 1" in text and "exact (Hertz)" in text

    def test_a_narrow_terminal_breaks_no_number(self, small):
        from rich.console import Console

        study, _ = small
        console = Console(width=80, record=True, file=io.StringIO())
        console.print(cost_table(study))
        lines = console.export_text().splitlines()
        assert max(map(len, lines)) <= 80
        text = " ".join(" ".join(lines).split())
        for row in study.rows:
            for cell in cells(study, row, shown(study)):
                assert " ".join(cell.translate(PLAIN).split()) in text

    def test_what_to_write_into_a_scene_is_short(self, small):
        _, folder = small
        page = unescape((folder / "cost.html").read_text())
        pitches = re.findall(r"pitch = (\S+ \S+)", page)
        assert pitches and all(re.fullmatch(r'"[0-9.]+ [um]?m",', text) for text in pitches)


class TestCommand:
    @pytest.mark.parametrize(
        ("arguments", "words"),
        [
            (["cost", "smoth"], "the nearest scene is smooth"),
            (["cost", "smooth", "--repeats", "0"], "--repeats: is 0; allowed is 1 or more"),
            (["cost", "smooth", "--out", "/dev/null/there"], "/dev/null is not a folder"),
        ],
    )
    def test_wrong_input(self, arguments, words, capsys):
        assert main(arguments) == 2
        out, err = capsys.readouterr()
        assert out == "" and words in err and err.count("\n") == 1

    def test_an_interrupt_leaves_nothing(self, monkeypatch, tmp_path):
        def stopped(*arguments):
            raise KeyboardInterrupt

        monkeypatch.setattr("comparisons.campaigns.cost.cost.measured_study", stopped)
        with pytest.raises(KeyboardInterrupt, match="the same command goes on from there"):
            cost(resolved(SMOOTH), tmp_path / "out", 1)
        assert list(tmp_path.iterdir()) == []

    def test_a_runs_own_files_stay_beside_it(self, small, monkeypatch, tmp_path):
        (tmp_path / "result.json").write_text("{}")
        monkeypatch.setattr(
            "comparisons.campaigns.cost.cost.measured_study",
            lambda *a: small[0].rows,
        )
        monkeypatch.setattr("comparisons.campaigns.cost.cost.cost_page", lambda study: "")
        cost(resolved(SMOOTH), tmp_path, 1)
        assert {p.name for p in tmp_path.iterdir()} == {"result.json", "cost.json", "cost.html"}
