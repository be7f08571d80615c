"""The report's page taken apart: its text, tags, tables and pictures, not how it is made."""

from collections.abc import Callable
from dataclasses import dataclass, field
from html.parser import HTMLParser

import pytest
from matplotlib import pyplot
from scenes import WAVY_LAYER

from comparisons.drawing import style
from comparisons.drawing.style import collected_figures
from comparisons.judging.study import Run
from comparisons.output.page.page import render

VOID = {"meta", "img", "source", "br", "hr", "link", "input"}


@dataclass
class Page(HTMLParser):
    """A page taken apart; raises ValueError where a tag is closed that is not the last opened."""

    source: str = field(repr=False)
    open_tags: list[str] = field(default_factory=list)
    attributes: list[tuple[str, str, str | None]] = field(default_factory=list)
    images: list[dict] = field(default_factory=list)
    sections: list[str] = field(default_factory=list)
    headings: list[str] = field(default_factory=list)
    text: str = ""
    scripts: list[str] = field(default_factory=list)
    tables: list[list[list[str]]] = field(default_factory=list)

    def __post_init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.feed(self.source)
        self.close()

    def handle_starttag(self, tag: str, attrs: list) -> None:
        self.attributes += [(tag, name, value) for name, value in attrs]
        if tag == "img":
            self.images.append(dict(attrs))
        if tag == "section":
            self.sections.append(dict(attrs)["id"])
        if tag in ("h1", "h2", "h3"):
            self.headings.append("")
        if tag == "table":
            self.tables.append([])
        if tag == "tr":
            self.tables[-1].append([])
        if tag in ("td", "th"):
            self.tables[-1][-1].append("")
        if tag not in VOID:
            self.open_tags.append(tag)

    def handle_endtag(self, tag: str) -> None:
        if not self.open_tags or self.open_tags.pop() != tag:
            raise ValueError(f"</{tag}> closes nothing")

    def handle_data(self, data: str) -> None:
        if self.open_tags[-1:] == ["script"]:
            self.scripts.append(data)
        if self.open_tags[-1:] in (["style"], ["script"]):
            return
        # what only keeps a line from ending there
        data = data.replace("\u2060", "").replace("\u00a0", " ")
        self.text += data
        if self.open_tags[-1:] and self.open_tags[-1] in ("h1", "h2", "h3"):
            self.headings[-1] += data
        if self.open_tags[-1:] and self.open_tags[-1] in ("td", "th"):
            self.tables[-1][-1][-1] += data
        if "td" in self.open_tags and self.open_tags[-1] == "span":
            self.tables[-1][-1][-1] += f" | {data}"

    def values(self, name: str, *tags: str) -> list[str]:
        """Values of the attribute of that name, of all tags or of these."""
        return [v for tag, n, v in self.attributes if n == name and (not tags or tag in tags)]

    def count(self, word: str) -> int:
        """Number of pictures whose words for them hold this one."""
        return sum(word in image["alt"] for image in self.images)


@pytest.fixture(scope="session")
def page_of() -> type[Page]:
    """`page_of(source)`: a page taken apart."""
    return Page


def drawn(draw: Callable, outcome: Run) -> tuple[list, object]:
    """The figures that a function draws of a run, and what it returns."""
    with collected_figures() as figures:
        made = draw(outcome)
        for figure in figures:
            figure.draw_without_rendering()
    for figure in figures:
        pyplot.close(figure)
    return figures, made


@pytest.fixture(scope="session")
def drawn_by() -> Callable:
    return drawn


@pytest.fixture(scope="session")
def half_plane_outcome(finish: Callable[..., Run]) -> Run:
    return finish(WAVY_LAYER, ("half_plane",))


@pytest.fixture(scope="session")
def rendered() -> Callable[[Run], str]:
    """`rendered(outcome)`: its page; drawn once for each of these fixtures' runs."""
    pages: dict[int, tuple[Run, str]] = {}

    def page(outcome: Run) -> str:
        if id(outcome) not in pages:
            pages[id(outcome)] = outcome, render(outcome)
        return pages[id(outcome)][1]

    return page


@pytest.fixture(scope="session")
def wavy_page(wavy_outcome: Run, rendered: Callable[[Run], str]) -> Page:
    return Page(rendered(wavy_outcome))


@pytest.fixture
def unpainted(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pictures are made with their words and curves, and no image of them."""
    monkeypatch.setattr(style, "svg", lambda drawn: "")


@pytest.fixture(scope="session")
def half_plane_page(half_plane_outcome: Run, rendered: Callable[[Run], str]) -> Page:
    return Page(rendered(half_plane_outcome))
