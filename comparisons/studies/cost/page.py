"""cost.html: what to take, the diagrams and every row, on one page that needs no network."""

from html import escape

from comparisons.common.quantities import label
from comparisons.report.figures.style import drawing
from comparisons.report.html import FOLDER
from comparisons.studies.cost.choice import followed
from comparisons.studies.cost.picture import cost_picture
from comparisons.studies.cost.result import Cost
from comparisons.studies.cost.table import NEEDLESS, cells, notes_of, refusals, shown

CSS = FOLDER / "page.css"
POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'"


def cost_page(cost: Cost) -> str:
    """The page."""
    title = f"Cost: {cost.problem.scene.title}"
    parts = [
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">',
        f"<title>{escape(title)}</title>",
        f"<style>\n{CSS.read_text(encoding='utf-8')}\n</style>\n</head>\n<body>",
        f"<header><h1>{escape(title)}</h1></header>\n<main>",
        _section("take", "What to take", _choices(cost)),
        _section("diagrams", "Error over time", _diagrams(cost)),
        _section("rows", "Every setting", _rows(cost)),
        "</main>\n<footer>",
        *(f'<p class="note">{escape(note)}</p>' for note in notes_of(cost)),
        "</footer>\n</body>\n</html>\n",
    ]
    return "\n".join(parts)


def _section(name: str, heading: str, body: str) -> str:
    return f'<section id="{name}">\n<h2>{heading}</h2>\n{body}\n</section>'


def _choices(cost: Cost) -> str:
    """The sentences, and what to write into the scene."""
    items = []
    for choice in cost.choices:
        lines = [
            f"<br><code>{escape(line)}</code>"
            for row in (choice.half_plane, choice.finite_element)
            if row is not None
            for line in [", ".join(_toml(followed(row.row, cost.problem)))]
        ]
        items.append(f"<li>{escape(choice.sentence)}{''.join(lines)}</li>")
    return f"<ul>\n{chr(10).join(items)}\n</ul>"


def _toml(sections: dict[str, dict]) -> list[str]:
    """Sections as lines of a scene."""

    def written(value: object) -> str:
        return f'"{value}"' if isinstance(value, str) else f"{value!r}"

    return [
        f"{name} = {{{', '.join(f'{k} = {written(v)}' for k, v in fields.items())}}}"
        for name, fields in sections.items()
    ]


def _diagrams(cost: Cost) -> str:
    with drawing():
        pictures = [cost_picture(cost, name) for name in cost.references if name not in NEEDLESS]
    figures = [
        f'<figure><div class="scroll picture"><img src="{p.source}" alt="{escape(p.alternative)}">'
        f"</div><figcaption>{escape(p.caption)}</figcaption></figure>"
        for p in pictures
    ]
    return f'<div class="columns">\n{chr(10).join(figures)}\n</div>'


def _rows(cost: Cost) -> str:
    names = shown(cost)
    heads = ("method", "setting", "unknowns", "contact", "with stresses", "memory")
    head = "".join(f'<th scope="col">{escape(h)}</th>' for h in (*heads, *map(label, names)))
    body = []
    for each in cost.assessed:
        first, *rest = cells(cost, each, names)
        columns = "".join(f"<td>{escape(cell)}</td>" for cell in rest)
        body.append(
            f'<tr class="{each.row.status}"><th scope="row">{escape(first)}</th>{columns}</tr>'
        )
    why = "".join(f"<li>{escape(line)}</li>" for line in refusals(cost))
    return (
        f'<div class="scroll"><table><thead><tr>{head}</tr></thead>\n<tbody>\n'
        f'{chr(10).join(body)}\n</tbody></table></div>\n<ul class="note">{why}</ul>'
    )
