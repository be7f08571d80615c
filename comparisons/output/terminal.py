"""Results as text: a run's figures, verdict, what to do next, time, in 80 columns."""

import io
from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

from comparisons.common.errors import ExitStatus, one_line
from comparisons.common.numbers import percent, with_unit
from comparisons.drawing.blocks import TextTable
from comparisons.figures.quantity import COMPARED, LABELS, error_text
from comparisons.judging.ladder import cost
from comparisons.judging.model_error.show import error_table
from comparisons.judging.presentation import lines_of
from comparisons.judging.study import MODEL_ERROR, Run
from comparisons.judging.verdict.headline import headline, verdicts
from comparisons.output.page.tables.comparison import comparison_table, first_model
from comparisons.output.page.tables.problem import surface_text
from comparisons.studies import STUDIES
from comparisons.studies.answers.show import answer_facts, answer_table, answers_of

if TYPE_CHECKING:
    from rich.console import Console, RenderableType
    from rich.table import Table
    from rich.text import Text

STYLES = {"agree": "cyan", "inconclusive": "yellow", "holds": "bold cyan"}
STYLES |= dict.fromkeys(("differ", "fails", "not converged", "no", "NO"), "bold red")
STYLES |= {"yes": "green"}
# Any terminal shows these.
PLAIN = str.maketrans("µ²−–₀₁×", "u2--01x") | {ord("τ"): "tau", ord("ν"): "nu", ord("β"): "beta"}
PLAIN |= {ord("±"): "+-", ord("σ"): "s", ord("√"): "sqrt", ord("δ"): "delta", ord("κ"): "kappa"}
WIDTH = 80  # columns
HEADS = {"friction": "mu", "half-plane": "half-\nplane", "mostly by, %": "mostly by, %"}
HEADS |= {"layered half-plane": "layered\nhalf-\nplane"}
HEADS |= {"difference": "differ.\n%", "uncertainty": "uncert.\n%", "tolerance": "tol.\n%"}
SHORT = {name: quantity.short.translate(PLAIN) for name, quantity in COMPARED.items()}
COLUMNS = 100  # of text; a notebook's cell is as wide
SUMMARY = 10  # lines
PAGE = '<pre style="font-family: monospace; line-height: 1.2">{code}</pre>'


class Printed(ABC):
    """A result that prints itself as text, and as HTML in a notebook."""

    exit_status = ExitStatus.DONE  # that its command ends with

    @abstractmethod
    def tables(self) -> "RenderableType":
        """Everything that its command prints."""

    @property
    def summary(self) -> str:
        """The last ten lines of these: what they come to."""
        return "\n".join(in_lines(self.tables(), COLUMNS)[-SUMMARY:])

    def __repr__(self) -> str:
        return "\n".join(in_lines(self.tables(), COLUMNS))

    def _repr_html_(self) -> str:
        console = _console(COLUMNS)
        console.print(self.tables(), crop=False)
        return console.export_html(inline_styles=True, code_format=PAGE)


def in_lines(shown: "RenderableType", width: int = WIDTH) -> tuple[str, ...]:
    """Lines of plain text, so many columns wide."""
    console = _console(width)
    console.print(shown, crop=False)
    return tuple(line.rstrip() for line in console.export_text().splitlines())


def _console(width: int) -> "Console":
    from rich.console import Console

    return Console(file=io.StringIO(), width=width, record=True, force_jupyter=False)


def summary(run: Run, details: bool = False) -> "RenderableType":
    """Within what the half-plane is right, verdict, what to do next, tables and times; readable at
    80 columns and without colour.

    details  every compared quantity, where the models agree in all that is judged"""
    from rich.console import Group
    from rich.text import Text

    said = headline(run)
    first = first_lines(run.problem.scene.title, said.within.sentence, verdicts(run, said))
    next_step = Text.assemble(("Next:", "bold"), f"  {said.next.translate(PLAIN)}")
    commands = (Text(text, no_wrap=True, overflow="ignore") for text in said.paste)
    agreement = "" if details else agreement_line(run)
    if not run.plan.compares:
        tables = [_comparison(run)]
    else:
        tables = [Text(agreement.translate(PLAIN)) if agreement else _comparison(run)]
        if run.problem.scene.tolerances:
            tables += ["", _model_errors(run)]
    for answer in answers_of(run):
        tables += ["", *_answer(run, answer)]
    return Group(*first, next_step, *commands, "", *tables, "", _facts(run))


def first_lines(title: str, within: str, said: Iterable[tuple[str, str]]) -> "list[Text]":
    """Title, within what the half-plane is right, and verdicts, each a word or two and why."""
    from rich.text import Text

    lines = [Text(text, style="bold") for text in (one_line(title), within.translate(PLAIN))]
    stamps = (((kind, STYLES.get(kind.lower(), "bold")), why) for kind, why in said)
    return lines + [Text.assemble(stamp, f"  {why.translate(PLAIN)}") for stamp, why in stamps]


def cost_summary(run: Run) -> "RenderableType":
    """Every solved level with its errors and what it took, and the cheapest for each tolerance."""
    from rich.console import Group
    from rich.text import Text

    found = run.findings[cost.NAME]
    table = _brief(cost.table(found))
    said = [Text(line.translate(PLAIN)) for line in cost.notes(found)]
    return Group(Text(one_line(run.problem.scene.title), style="bold"), "", table, "", *said)


def agreement_line(run: Run) -> str:
    """Both models' largest difference, and their largest uncertainty, where they agree in all that
    is judged; else nothing."""
    judged = [row for row in run.compared if row.bounds is not None]
    if not judged or any(row.verdict != "agree" for row in judged):
        return ""
    apart = max(judged, key=lambda row: abs(row.value))
    unsure = max(judged, key=lambda row: row.numerical)
    difference = error_text(apart.value, apart.numerical)
    return (
        f"{first_model(run).capitalize()} and finite elements that assume the same agree: largest "
        "difference "
        f"{difference} ({SHORT[apart.quantity]}), uncertainty {percent(unsure.numerical)}."
    )


def _comparison(run: Run) -> "Table":
    """Both models' figures, or those of the only one."""
    table = _brief(comparison_table(run, brief=True))
    if run.plan.compares:
        table.caption = f"difference: ({first_model(run)} - finite elements) / finite elements"
    return table


def _model_errors(run: Run) -> "Table":
    """Table of the half-plane's errors in what is judged, and what most of each comes from."""
    heads = {"difference": "error\n%", "uncertainty": "+-\n%"}
    table = _brief(error_table(run, brief=True), heads, ("verdict",))
    table.title = "model error of the half-plane"
    table.padding = 0  # what it is mostly made of fits into 80 columns
    return table


def _brief(
    shown: TextTable, heads: Mapping[str, str] = {}, left_out: tuple[str, ...] = ()
) -> "Table":
    """A table of figures in 80 columns."""
    kept = [k for k, name in enumerate(shown.head) if name not in left_out]
    names = [(HEADS | heads).get(shown.head[k], shown.head[k].replace(" ", "\n")) for k in kept]
    first, *numbers = names
    last = numbers.pop() if shown.words or numbers[-1] == "verdict" else ""
    # below heads that say per cent
    rows = [[row[k].replace("< ", "<").removesuffix(" %") for k in kept] for row in shown.rows]
    table = plain_table(first, numbers=numbers, last=last, rows=rows)
    if any(row[-1] == "inconclusive" for row in rows):
        table.padding = 0  # the longest verdict fits into 80 columns
    return table


def _answer(outcome: Run, answer: str) -> "list[RenderableType]":
    """An answer of another code beside its reference, and what is to be said of it."""
    table = _brief(answer_table(outcome, answer, brief=True))
    table.title = f"{answer}, from outside"
    return [table, *(plain_text(f"{n}: {text}") for n, text in answer_facts(outcome, answer))]


def plain_table(
    *words: str, numbers: Iterable[str] = (), last: str = "", rows: Iterable[Iterable[str]] = ()
) -> "Table":
    """Columns of words, of numbers, and a `last` one of words, if any; rows of their cells."""
    from rich import box
    from rich.table import Table

    table = Table(
        box=box.SIMPLE_HEAD,
        padding=(0, 1, 0, 0),
        pad_edge=False,
        show_edge=False,
        title_justify="left",
        title_style="default",
        caption_justify="left",
        caption_style="default",
    )
    # where a terminal is too narrow, cells break: cut short they would be other numbers
    for column in words:
        table.add_column(column, overflow="fold")
    for column in numbers:
        table.add_column(column, justify="right", overflow="fold")
    if last:
        table.add_column(last, overflow="fold")
    for row in rows:
        table.add_row(*map(plain_text, row))
    return table


def plain_text(text: str) -> "Text":
    """Lines that any terminal shows, and in which brackets are no markup; a verdict in colour."""
    from rich.text import Text

    lines = (one_line(line).translate(PLAIN) for line in text.split("\n"))
    return Text("\n".join(lines), style=STYLES.get(text, ""))


def _facts(outcome: Run) -> "Table":
    from rich.table import Table
    from rich.text import Text

    surface, rows = outcome.problem.surface, []
    if surface.info is not None:
        rows.append(("surface", surface_text(surface)))
    for study in STUDIES:
        if study.name in outcome.findings:
            rows += lines_of(study, outcome)
    seconds = {LABELS[name]: sum(run.seconds.values()) for name, run in outcome.runs.items()}
    times = ", ".join(f"{name} {with_unit(time, 's', 3)}" for name, time in seconds.items())
    budget = outcome.data(MODEL_ERROR)
    if budget is not None and budget.seconds:
        times += f", error budget {with_unit(budget.seconds, 's', 3)} summed over cores"
    facts = Table.grid(padding=(0, 2))
    facts.add_column(no_wrap=True)
    facts.add_column(overflow="fold")
    for name, text in [*rows, ("time", times)]:
        facts.add_row(name, Text(text.translate(PLAIN).replace(" %", "%")))
    return facts
