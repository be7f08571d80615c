"""A cost study for its reader: what to take, every row, diagrams; as a table and as cost.html."""

from pathlib import Path
from typing import TYPE_CHECKING

from comparisons.common.numbers import integer, percent, with_unit
from comparisons.common.quantities import label
from comparisons.report.figures.style import drawing
from comparisons.report.html import STYLES as POLICY
from comparisons.report.html import rendered
from comparisons.report.terminal import PLAIN, SHORT, STYLES, plain_table
from comparisons.studies.cost.picture import cost_picture
from comparisons.studies.cost.recommend import AssessedRow, Recommendation, scene_sections
from comparisons.studies.cost.result import Cost
from comparisons.studies.cost.study import FAILED, OK

if TYPE_CHECKING:
    from rich.console import RenderableType

SHOWN = ("peak_pressure", "contact_length", "pressure_l2", "tau1_max", "tau1_max_depth")
REDUNDANT = ("contact_ratio",)  # the contact length over a constant
MARK = " *"  # on the Pareto front


def cost_table(cost: Cost) -> "RenderableType":
    """For rich: rows, sentences, references and machine."""
    from rich.console import Group
    from rich.text import Text

    names = shown(cost)
    heads = ("setting", "unknowns", "contact", "with\nstresses", "memory")
    quantities = (SHORT[name].replace(" ", "\n", 1) for name in names)
    table = plain_table("method", numbers=(*heads, *quantities))
    styles = {OK: "", FAILED: STYLES["differ"]}
    for each in cost.assessed:
        style = styles.get(each.row.status, STYLES["inconclusive"])
        table.add_row(*(Text(c.translate(PLAIN), style=style) for c in cells(cost, each, names)))
    lines = [Text(each.sentence.translate(PLAIN)) for each in cost.recommendations]
    small = [*refusals(cost), *notes_of(cost)]
    notes = [Text(line.translate(PLAIN), style="dim") for line in small]
    title = Text(cost.problem.scene.title, style="bold")
    return Group(title, "", table, "", *lines, "", *notes)


def cost_page(cost: Cost) -> str:
    names = shown(cost)
    head = ("method", "setting", "unknowns", "contact", "with stresses", "memory")
    with drawing():
        pictures = [cost_picture(cost, name) for name in cost.references if name not in REDUNDANT]
    return rendered(
        Path(__file__).parent / "cost.html.j2",
        policy=POLICY,
        title=f"Cost: {cost.problem.scene.title}",
        recommendations=[(each.sentence, _settings(cost, each)) for each in cost.recommendations],
        pictures=pictures,
        head=(*head, *map(label, names)),
        rows=[(each.row.status, cells(cost, each, names)) for each in cost.assessed],
        refusals=refusals(cost),
        notes=notes_of(cost),
    )


def _settings(cost: Cost, recommendation: Recommendation) -> list[str]:
    """What to write into the scene, as TOML: a line a model."""
    rows = (recommendation.half_plane, recommendation.finite_element)
    return [_toml(scene_sections(each.row, cost.problem)) for each in rows if each is not None]


def _toml(sections: dict[str, dict]) -> str:
    def written(value: object) -> str:
        return f'"{value}"' if isinstance(value, str) else f"{value!r}"

    return ", ".join(
        f"{name} = {{{', '.join(f'{k} = {written(v)}' for k, v in fields.items())}}}"
        for name, fields in sections.items()
    )


def shown(cost: Cost) -> list[str]:
    """Quantities with a column: the usual ones, and those that the scene judges."""
    judged = cost.problem.scene.tolerance
    names = (*SHOWN, *(name for name in judged if name not in SHOWN))
    return [name for name in names if name in cost.references and name not in REDUNDANT]


def cells(cost: Cost, each: AssessedRow, names: list[str]) -> tuple[str, ...]:
    row, measured = each.row, each.row.measured
    setting = percent(row.setting, digits=1) if row.method.adapted and row.setting else row.label
    if measured is None:
        return (row.method.name, setting, row.status, *[""] * (3 + len(names)))
    stresses = cost.problem.scene.stress is not None
    return (
        row.method.name,
        setting,
        integer(measured.solved.unknowns),
        with_unit(row.seconds(False), "s", 2),
        with_unit(row.seconds(True), "s", 2) if stresses else "",
        with_unit(measured.memory, "byte", 3),
        *(_error(cost, each, name) for name in names),
    )


def _error(cost: Cost, each: AssessedRow, name: str) -> str:
    error, reference = each.errors.get(name), cost.references[name]
    if error is None:
        return "reference" if each.row is reference.row else ""
    text = f"< {percent(reference.floor)}" if error < reference.floor else percent(error)
    if each.row.status != OK:
        return f"{text} {each.row.status}"
    return text + (MARK if each in cost.fronts[name] else "")


def refusals(cost: Cost) -> list[str]:
    """Why settings have no result, a line each."""
    return [
        f"{row.method.name} {row.label if row.setting else ''}".strip()
        + f" {row.status}: {row.because}"
        for row in cost.study.rows
        if row.status != OK
    ]


def notes_of(cost: Cost) -> list[str]:
    """How to read the numbers, the references, and the machine."""
    by_source: dict[str, list[str]] = {}
    for name, reference in cost.references.items():
        if name in REDUNDANT:
            continue
        floor = "" if reference.row is None else f" (known to {percent(reference.floor)})"
        by_source.setdefault(reference.source, []).append(SHORT[name] + floor)
    sources = "; ".join(f"{source}: {', '.join(names)}" for source, names in by_source.items())
    repeats = max((r.measured.repeats for r in cost.study.rows if r.measured), default=0)
    versions = ", ".join(f"{k} {v}" for k, v in cost.versions.items() if v is not None)
    machine = ", ".join(f"{k} {v}" for k, v in cost.machine.items() if v is not None)
    return [
        f"Errors are relative, the largest of any friction coefficient, against {sources}.",
        "*: nothing measured is both cheaper and closer (Pareto front). Seconds are processor time "
        f"of that setting alone: medians of up to {repeats} solutions after one that does not "
        "count.",
        f"Machine: {machine}.",
        f"Versions: {versions}.",
    ]
