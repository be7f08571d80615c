"""The pages beside the README say what the program does: names, numbers, commands, links."""

import re
import shlex
from pathlib import Path

import pytest

from comparisons.figures.convergence import IRREGULAR, LOWEST_ORDER, REGULAR, TWO_GRIDS
from comparisons.figures.uncertainty import DOMAIN, PRESSURE_PER_RESIDUAL
from comparisons.scenes.finite_element import HELD_BLOCK
from comparisons.scenes.scene import Origin, Scene
from comparisons.studies.model_error.catalogue import EFFECTS
from comparisons.studies.model_error.error_budget import SHARE_OF_TOLERANCE as SHARE_OF_EFFECTS
from comparisons.studies.model_error.selection import SHARE_OF_TOLERANCE

PROJECT = Path(__file__).resolve().parents[1]
PAGES = {path.stem: path for path in (PROJECT / "comparisons" / "docs").glob("*.md")}
README = (PROJECT / "README.md").read_text(encoding="utf-8")
TEXT = {name: path.read_text(encoding="utf-8") for name, path in PAGES.items()}


def rows(page: str, heading: str) -> list[list[str]]:
    """Cells of the table whose first column is called `heading`."""
    lines = TEXT[page].splitlines()
    start = next(n for n, line in enumerate(lines) if line.startswith(f"| {heading} |"))
    found = []
    for line in lines[start + 2 :]:
        if not line.startswith("|"):
            break
        found.append([cell.strip() for cell in line.strip("|").split(" | ")])
    return found


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

    known = set(get_command(app).commands) | {"test"}
    for command in re.findall(r"`\./crosscheck ([^`]+)`", TEXT[name]):
        assert shlex.split(command)[0] in known


class TestVerdict:
    def test_every_effect_has_its_row(self):
        labels = [effect.label for effect in EFFECTS.values()]
        assert [name for name, *_ in rows("verdict", "effect")] == labels

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
        assert [word.strip("`").lower() for word, _ in rows("verdict", "verdict")] == [
            "holds",
            "fails",
            "inconclusive",
        ]


class TestMethod:
    def test_the_block_is_as_wide_as_it_says(self):
        assert "400 a wide and deep" in TEXT["method"] and HELD_BLOCK == 400

    def test_fields_that_drop_an_assumption_are_a_scenes(self):
        """Each is known: a value that it cannot have is refused with what is allowed."""
        tables = {
            "roller": {"radius": 8e-3, "youngs_modulus": 210e9, "poissons_ratio": 0.3},
            "body": {"youngs_modulus": 210e9, "poissons_ratio": 0.3},
            "load": {"per_length": 1e6},
        }
        named = set(re.findall(r"`((?:body|finite_element|load)\.\w+)", TEXT["method"]))
        assert len(named) >= 8
        for section, field in (name.split(".") for name in named):
            wrong = {**tables, section: {**tables.get(section, {}), field: []}}
            with pytest.raises(Exception, match=rf"{section}\.{field}: ") as refusal:
                Scene.of(wrong, Origin("made", Path("."), "made.toml"))
            assert "unknown" not in str(refusal.value)


def test_the_changelog_has_the_version_that_is_here():
    version = re.search(r'^version = "([^"]+)"', (PROJECT / "pyproject.toml").read_text(), re.M)[1]
    heads = re.findall(r"^## (\S+)", TEXT["changelog"], re.M)
    assert version in heads[:2]
