"""A recorded run repeated from its own record: what moved, by how much, and the table of that.

In: the folder of a run. Out: the repetition, and every figure that moved."""

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from comparisons.common.errors import ExitStatus, InputError, one_line
from comparisons.common.files import check_writable
from comparisons.common.progress import ProgressCallback, no_progress
from comparisons.figures.moved import ROUNDING, Item, Moved, Movement, items_of, movement
from comparisons.judging.study import CONVERGED, Run
from comparisons.output.arrays import RunArrays
from comparisons.output.record import Record, read_record
from comparisons.output.result_json import Result, result_of
from comparisons.output.terminal import STYLES, plain_table
from comparisons.runs.run import Known, run

if TYPE_CHECKING:
    from rich.console import RenderableType
    from rich.table import Table

Pair = tuple[object, object]
DIGITS = 9  # of a figure: enough to see what moved by more than rounding


@dataclass(frozen=True)
class Repetition:
    """A repeated run."""

    record: Record
    outcome: Run
    movement: Movement  # of its figures
    levels: tuple[int, int]  # of each model, recorded and repeated
    # versions and properties of the machine that are not the recorded ones, both
    other: dict[str, Pair]
    bits: bool  # whether every recorded hash came out again: pressures equal to the last bit

    @property
    def exit_status(self) -> ExitStatus:
        """3: a solver did not converge; 1: a figure moved by more than it states; else 0."""
        if not self.outcome.converged:
            return ExitStatus.NOT_CONVERGED
        return ExitStatus.OUTSIDE_TOLERANCE if self.movement.beyond else ExitStatus.DONE

    def as_dict(self) -> dict:
        """For JSON."""
        return {
            "schema": 1,
            "scene": self.record.scene.name,
            "converged": self.outcome.converged,
            **asdict(self.movement),
            "beyond": len(self.movement.beyond),
            "levels": list(self.levels),
            "other": {name: list(pair) for name, pair in self.other.items()},
            "bits": self.bits,
        }


def rerun(
    folder: Path, out: Path | None = None, callback: ProgressCallback = no_progress
) -> Repetition:
    """Repeat the run in a folder, which is only read; `out` keeps the repetition.
    Raises InputError for a folder without a sound record, or one that may not be written to."""
    record = read_record(folder)
    if out is not None:
        if out.resolve().is_relative_to(folder.resolve()):
            raise InputError(f"--out: {out} is in the recorded folder; allowed is another folder")
        check_writable(out)
    answers = None
    if record.scene.answers:  # as they were read: their files may have changed or gone
        answers = RunArrays.read(folder).answers
    known = Known(record.surface, answers, record.levels)
    outcome = run(record.scene, out, record.models, callback, known=known)
    now = outcome.record
    return Repetition(
        record=record,
        outcome=outcome,
        movement=movement(_items(record.result), _items(result_of(outcome))),
        levels=(record.levels.models, now["levels"]),
        other=_unlike(record.versions, now["versions"]) | _unlike(record.machine, now["machine"]),
        bits=now["hashes"] == record.hashes,
    )


def _items(result: Result) -> dict[str, Item]:
    """All that is compared of a result: figures and series, the numbers of its scene, the verdict,
    and what converged."""
    said = {
        f"{study}.{CONVERGED} {said.source} {said.at or ''}".strip(): said.text
        for study, findings in result.findings.items()
        for said in findings.statements
        if said.name == CONVERGED
    }
    numbers = dict(_numbers(result.scene, "scene"))
    return items_of(result.findings, numbers | said | {"verdict": result.verdict})


def _numbers(table: object, path: str) -> Iterator[tuple[str, float | bool]]:
    """Every number and truth below a table by its path."""
    if isinstance(table, dict):
        for name, item in table.items():
            yield from _numbers(item, f"{path}.{name}")
    elif isinstance(table, list):
        for number, item in enumerate(table):
            yield from _numbers(item, f"{path}[{number}]")
    elif isinstance(table, int | float):
        yield path, table


def _unlike(before: dict, now: dict) -> dict[str, Pair]:
    names = dict.fromkeys([*before, *now])
    return {n: (before.get(n), now.get(n)) for n in names if before.get(n) != now.get(n)}


def rerun_summary(repetition: Repetition) -> "RenderableType":
    """What moved, and what the repetition had that the record had not."""
    from rich.console import Group
    from rich.text import Text

    moved = repetition.movement.moved
    title = Text(one_line(repetition.outcome.problem.scene.title), style="bold")
    table = [_table(moved), ""] if moved else []
    style = STYLES["agree" if repetition.exit_status == 0 else "differ"]
    verdict = Text(_verdict(repetition), style=style)
    return Group(title, "", *table, verdict, *map(Text, _lines(repetition)))


def _table(moved: tuple[Moved, ...]) -> "Table":
    from rich.text import Text

    numbers = ("recorded", "repeated", "relative\nchange", "stated\nuncert.")
    table = plain_table("figure", numbers=numbers)
    for row in moved:
        change = "" if row.change is None else f"{row.change:+.2e}"
        stated = f"{row.stated:.2e}" if row.stated else "none"
        cells = (row.name, _value(row.recorded), _value(row.repeated), change, stated)
        style = STYLES["differ"] if row.beyond else ""
        table.add_row(*(Text(cell, style=style) for cell in cells))
    return table


def _value(value: object) -> str:
    if value is None:
        return "absent"
    if isinstance(value, tuple):
        return f"{len(value)} value{'s' * (len(value) != 1)}"
    return f"{value:.{DIGITS}g}" if isinstance(value, float) else str(value)


def _verdict(repetition: Repetition) -> str:
    moved, beyond = repetition.movement.moved, repetition.movement.beyond
    if not repetition.outcome.converged:
        return "NOT CONVERGED  a solver did not converge."
    if beyond:
        return (
            f"MOVED  {_count(len(beyond), 'figure')} moved by more than the stated uncertainty: "
            f"{', '.join(row.name for row in beyond[:3])}{', …' if len(beyond) > 3 else ''}."
        )
    if moved:
        return f"REPEATED  {_count(len(moved), 'figure')} moved, within the stated uncertainty."
    return "REPEATED  no figure moved."


def _lines(repetition: Repetition) -> list[str]:
    movement, (before, now) = repetition.movement, repetition.levels
    same = f"{_count(movement.same, 'figure')} equal to the last digit"
    if movement.rounding:
        same += f", {movement.rounding} more to a relative {ROUNDING:g}"
    lines = [f"{same}{'; pressures the same to the last bit' if repetition.bits else ''}."]
    if movement.new:
        lines.append(f"{_count(movement.new, 'figure')} that the record does not have.")
    if before != now:
        refinement = repetition.outcome.solved.refinement
        lines.append(f"Recorded on {before} levels, repeated on {now}: {refinement}.")
    if repetition.other:
        known = {n: ["unknown" if v is None else v for v in p] for n, p in repetition.other.items()}
        parts = (f"{name} {before}, now {now}" for name, (before, now) in known.items())
        lines.append(f"Other than recorded: {'; '.join(parts)}.")
    return lines


def _count(number: int, name: str) -> str:
    return f"{number} {name}{'s' * (number != 1)}"
