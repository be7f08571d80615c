"""The pages beside the README say what the program does: names, numbers, commands, links; they are
a site that opens from disk, in short plain sentences."""

import re
import shlex
from collections.abc import Iterator

import pytest
from scenes import PROJECT, page_rows, python

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

DOCS = PROJECT / "comparisons" / "docs"
PAGES = {str(path.relative_to(DOCS).with_suffix("")): path for path in sorted(DOCS.rglob("*.md"))}
SITE = DOCS / "site" / "mkdocs.yml"
README = (PROJECT / "README.md").read_text(encoding="utf-8")
TEXT = {name: path.read_text(encoding="utf-8") for name, path in PAGES.items()}
NAMES = re.compile(r"`(\w+)`").findall
# Words of the program's makers that no reader knows.
PRIVATE = (
    r"\brungs?\b|comes? along|beyond doubt|best door|for who |\boutcomes?\b|takes? dolfinx"
    r"|the whole(?= (?:is|has|on|at|was)\b)|the whole's|\bplaces?\b(?! of\b)"
)
SECTIONS = sections_of(Scene)


def anchor(heading: str) -> str:
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


@pytest.mark.parametrize("path", [PROJECT / "README.md", *PAGES.values()], ids=lambda p: p.stem)
def test_links_lead_somewhere(path):
    for link, heading in re.findall(r"\]\(([^)#]*)#?([^)]*)\)", path.read_text(encoding="utf-8")):
        page = path.parent / link if link else path
        assert page.exists(), link
        if heading:
            heads = re.findall(r"^#+ (.+)$", page.read_text(encoding="utf-8"), re.MULTILINE)
            assert heading in map(anchor, heads)


def test_the_site_is_built_strictly_and_opens_from_disk_without_a_network(tmp_path):
    """Every page is listed, every link and anchor leads somewhere; no page loads from the net."""
    pytest.importorskip("material", reason="mkdocs-material is not installed: extra `docs`")
    done = python("-m", "mkdocs", "build", "--strict", "-f", SITE, "-d", tmp_path)
    assert done.returncode == 0, done.stderr
    pages = {
        str(path.relative_to(tmp_path).with_suffix("")): path for path in tmp_path.rglob("*.html")
    }
    assert pages.keys() == {*PAGES, "404"} and "index" in pages
    tag = re.compile(r"<(?:script|img|link|iframe)[^>]+(?:src|href)=\"?([^\s\">]+)")
    for name, page in pages.items():
        loaded = tag.findall(page.read_text(encoding="utf-8"))
        assert [address for address in loaded if address.startswith(("http", "//"))] == []
        for address in loaded if name != "404" else ():
            assert (page.parent / address.partition("?")[0]).exists(), address


def words(text: str) -> int:
    return sum(any(map(str.isalnum, word)) for word in text.split())


def test_pages_are_read_in_one_sitting():
    evidence = [text for name, text in TEXT.items() if name.startswith("evidence/")]
    assert words(TEXT["user_guide"]) <= 3000 and words(TEXT["limits"]) <= 900
    assert sum(map(words, evidence)) <= 6000
    bullets = re.findall(r"^- (.+)$", TEXT["limits"], re.MULTILINE)
    assert len(bullets) > 20 and max(map(words, bullets)) <= 40


def sentences(text: str) -> Iterator[str]:
    """Sentences of a page without its tables, code and headings."""
    text = re.sub(r"^```(?s:.*?)^```$|^(?:    |[|#<]).*$", "", text, flags=re.MULTILINE)
    text = re.sub(r"\]\([^)]*\)", "]", text)
    for paragraph in re.split(r"\n\s*\n|\n\s*(?:[-*]|\d+\.) ", text):
        yield from re.split(r"[.!?][\"*)]*\s+", " ".join(paragraph.split()))


@pytest.mark.parametrize("text", [README, *TEXT.values()], ids=["README", *TEXT])
def test_sentences_are_short_and_in_the_fields_words(text):
    """Tables, code and headings are left out."""
    found = list(sentences(text))
    assert [sentence for sentence in found if words(sentence) > 35] == []
    private = re.compile(PRIVATE, re.IGNORECASE)
    assert [sentence for sentence in found if private.search(sentence)] == []


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
        assert with_fields(TEXT["scene_fields"]) == TEXT["scene_fields"]
        heads = re.findall(r"^## \[(\w+)", TEXT["scene_fields"], re.M)
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
