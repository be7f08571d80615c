"""The pages beside the README say what the program does: names, numbers, commands, links."""

import re
import shlex

import pytest
from scenes import PROJECT, page_rows

from comparisons.api import run
from comparisons.figures.convergence import IRREGULAR, LOWEST_ORDER, REGULAR, TWO_GRIDS
from comparisons.figures.figure import Figure
from comparisons.figures.uncertainty import DOMAIN, PRESSURE_PER_RESIDUAL
from comparisons.judging.effects.catalogue import EFFECTS
from comparisons.judging.effects.selection import SHARE_OF_TOLERANCE
from comparisons.judging.model_error.refinement import SHARE_OF_TOLERANCE as SHARE_OF_EFFECTS
from comparisons.scenes.fields import file_fields
from comparisons.scenes.finite_element import BLOCK
from comparisons.scenes.scene import Scene, sections_of
from comparisons.scenes.schema.reference import with_fields
from comparisons.studies import STUDIES

PAGES = {path.stem: path for path in (PROJECT / "comparisons" / "docs").glob("*.md")}
README = (PROJECT / "README.md").read_text(encoding="utf-8")
TEXT = {name: path.read_text(encoding="utf-8") for name, path in PAGES.items()}


NAMES = re.compile(r"`(\w+)`").findall
SECTIONS = sections_of(Scene)


@pytest.mark.parametrize("name", PAGES)
def test_links_lead_somewhere_and_the_readme_leads_here(name):
    for path, text in ((PAGES[name], TEXT[name]), (PROJECT / "README.md", README)):
        for link, heading in re.findall(r"\]\(([^)#]*)#?([^)]*)\)", text):
            page = path.parent / link if link else path
            assert page.exists(), link
            if heading:
                pattern = rf"^## {heading.replace('-', ' ')}$"
                assert re.search(pattern, page.read_text(), re.MULTILINE | re.IGNORECASE)
    assert f"](comparisons/docs/{name}.md)" in README


@pytest.mark.parametrize("name", PAGES)
def test_commands_are_the_programs(name):
    from typer.main import get_command

    from comparisons.cli import app

    commands = get_command(app).commands
    for text in re.findall(r"(?:`|^)\./crosscheck ([^`\n]+)", TEXT[name], re.MULTILINE):
        command, *rest = shlex.split(text)
        if command in ("test", "COMMAND") or command.startswith("-"):
            continue
        options = {option for parameter in commands[command].params for option in parameter.opts}
        assert {word for word in rest if word.startswith("-")} <= options | {"--help"}


class TestVerdict:
    def test_every_effect_has_its_row(self):
        labels = [effect.label for effect in EFFECTS.values()]
        assert [name for name, *_ in page_rows(TEXT["verdict"], "effect")] == labels

    def test_numbers_are_those_of_the_program(self):
        text = TEXT["verdict"]
        assert "times 2000" in text and PRESSURE_PER_RESIDUAL == 2000
        assert "2.4 times what half the block changes" in text and round(DOMAIN, 1) == 2.4
        assert "between 1/2 and the formal one" in text and LOWEST_ORDER == 0.5
        assert "times a factor of safety, 1.25" in text and REGULAR == 1.25
        assert "else 3" in text and IRREGULAR == 3
        assert "On two levels it is 3 times their difference" in text and TWO_GRIDS == 3
        assert "exceeds a tenth of a tolerance" in text and SHARE_OF_TOLERANCE == 0.1
        assert "less than a third of the tolerance" in text
        assert pytest.approx(1 / 3) == SHARE_OF_EFFECTS

    def test_verdicts_are_those_that_a_run_gives(self):
        assert [word.strip("`").lower() for word, _ in page_rows(TEXT["verdict"], "verdict")] == [
            "holds",
            "fails",
            "inconclusive",
        ]


class TestReference:
    def test_fields_are_as_the_scene_has_them(self):
        """`python -m comparisons.scenes.schema.reference` writes them anew."""
        assert with_fields(TEXT["reference"]) == TEXT["reference"]
        heads = re.findall(r"^### \[(\w+)", TEXT["reference"], re.M)
        assert sorted(heads) == sorted(SECTIONS)

    def test_quantities_are_those_of_the_studies(self):
        """Those that several studies share are named at the first."""
        listed, study = {}, ""
        for first, quantities, _ in page_rows(TEXT["reference"], "study"):
            study = first.strip("`") or study
            listed.setdefault(study, set()).update(re.findall(r"`(\w+)`", quantities))
        assert list(listed) == [study.name for study in STUDIES]
        others = set(listed)  # a row may say "those of `contact`"
        for study in STUDIES:
            assert listed[study.name] - others <= study.quantities.keys()
        named = set().union(*listed.values())
        assert {name for study in STUDIES for name in study.quantities} <= named

    def test_entries_of_the_result_file_are_those_of_a_result(self):
        """A half-plane's run has most fields; the others are those of a model error."""
        result = run("smooth", models="half-plane").result
        page = TEXT["reference"]
        entries = [name for cell, _ in page_rows(page, "entry") for name in NAMES(cell)]
        assert sorted(entries) == sorted(result)
        of_figures = page_rows(page, "field of a figure")
        fields = [name for cell, _ in of_figures for name in NAMES(cell)]
        assert {name for figure in result["figures"] for name in figure} <= set(fields)
        assert set(fields) == set(Figure.__dataclass_fields__) - {"unknown"} | {
            *("unit", "convergence", "verdict", "not_modelled")
        }


class TestMethod:
    def test_the_block_is_as_wide_as_it_says(self):
        assert "400 a wide and deep" in TEXT["method"] and BLOCK == 400

    def test_fields_that_drop_an_assumption_are_a_scenes(self):
        named = set(re.findall(r"`(body|finite_element|load)\.(\w+)", TEXT["method"]))
        assert len(named) >= 7
        for section, field in named:
            assert field in file_fields(SECTIONS[section])


def test_the_changelog_has_the_version_that_is_here():
    version = re.search(r'^version = "([^"]+)"', (PROJECT / "pyproject.toml").read_text(), re.M)[1]
    heads = re.findall(r"^## (\S+)", TEXT["changelog"], re.M)
    assert version in heads[:2]
