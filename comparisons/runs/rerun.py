"""A recorded run repeated from its own record: what moved, by how much, and the table of that.

In: the folder of a run. Out: the repetition, and every figure that moved."""

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from analytic.surface.readers.dropouts import MeasuredProfile
from comparisons.common.errors import ExitStatus, InputError, one_line
from comparisons.common.files import check_writable
from comparisons.common.progress import ProgressCallback, no_progress
from comparisons.common.provenance import digest
from comparisons.figures.figure import Findings
from comparisons.figures.moved import ROUNDING, Item, Moved, Movement, items_of, movement
from comparisons.judging.study import CONVERGED, MODEL_ERROR, Run
from comparisons.models.problem import MOST_LEVELS, Levels
from comparisons.output.arrays import FILE as ARRAYS
from comparisons.output.records import Records
from comparisons.output.result import BUILT_OTHERWISE, FILE, Result, read_result, result_of
from comparisons.output.terminal import STYLES, Printed, plain_table
from comparisons.runs.run import Known, run
from comparisons.scenes.scene import Origin, Scene
from comparisons.scenes.surface import KnownTrace, surface_of

if TYPE_CHECKING:
    from rich.console import RenderableType
    from rich.table import Table

Pair = tuple[object, object]
ADDED = ("name", "profile_info")  # to the tables of a scene in result.json
DIGITS = 9  # of a figure: enough to see what moved by more than rounding


@dataclass(frozen=True, repr=False)
class Repetition(Printed):
    """A repeated run."""

    result: Result  # as recorded
    outcome: Run
    movement: Movement  # of its figures
    # versions and properties of the machine that are not the recorded ones, both
    other: dict[str, Pair]

    @property
    def levels(self) -> tuple[int, int]:
        """Numbers of levels of each model, recorded and repeated."""
        return self.result.record["levels"], self.outcome.record["levels"]

    @property
    def bits(self) -> bool:
        """Whether every recorded hash came out again: pressures equal to the last bit."""
        return self.outcome.record["hashes"] == self.result.record["hashes"]

    @property
    def figures(self) -> Records:
        """Figures that moved, as records."""
        return Records([asdict(moved) for moved in self.movement.moved])

    @property
    def exit_status(self) -> ExitStatus:
        """3: a solver did not converge; 1: a figure moved by more than it states; else 0."""
        if not self.outcome.converged:
            return ExitStatus.NOT_CONVERGED
        return ExitStatus.OUTSIDE_TOLERANCE if self.movement.beyond else ExitStatus.DONE

    def as_dict(self) -> dict:
        """Movement for JSON."""
        return {
            "schema": 1,
            "scene": self.outcome.problem.scene.name,
            "converged": self.outcome.converged,
            **asdict(self.movement),
            "beyond": len(self.movement.beyond),
            "levels": list(self.levels),
            "other": {name: list(pair) for name, pair in self.other.items()},
            "bits": self.bits,
        }

    def tables(self) -> "RenderableType":
        """Tables of what moved, and of what the repetition had that the record had not."""
        from rich.console import Group
        from rich.text import Text

        moved = self.movement.moved
        title = Text(one_line(self.outcome.problem.scene.title), style="bold")
        table = [_table(moved), ""] if moved else []
        style = STYLES["agree" if self.exit_status == 0 else "differ"]
        return Group(title, "", *table, Text(_verdict(self), style=style), *map(Text, _lines(self)))


def rerun(
    folder: Path, out: Path | None = None, callback: ProgressCallback = no_progress
) -> Repetition:
    """Repeat the run in a folder, which is only read; `out` keeps the repetition.
    Raises InputError for a folder without a sound record, or one that may not be written to."""
    result = read_result(folder)
    scene, known = _posed(folder, result)
    if out is not None:
        if out.resolve().is_relative_to(folder.resolve()):
            raise InputError(f"--out: {out} is in the recorded folder; allowed is another folder")
        check_writable(out)
    outcome = run(scene, out, result.models, callback, known=known)
    before, now = (one["versions"] | one["machine"] for one in (result.record, outcome.record))
    names = [name for name in before | now if before.get(name) != now.get(name)]
    return Repetition(
        result=result,
        outcome=outcome,
        movement=movement(_items(result), _items(result_of(outcome))),
        other={name: (before.get(name), now.get(name)) for name in names},
    )


def _posed(folder: Path, result: Result) -> tuple[Scene, Known]:
    """The scene of a recorded run, and what was found out then: surface and answers as they were
    read, for their files may have changed or gone; levels as many as figures took. Raises
    InputError where that cannot be."""
    path = folder / FILE
    tables = {n: part for n, part in result.scene.items() if n not in ADDED and part is not None}
    try:
        scene = Scene.of(tables, Origin(one_line(result.scene["name"]), folder, str(path)))
        trace = None if scene.profile is None else _trace(folder, result)
        cost = result.findings.get(MODEL_ERROR, Findings()).table("cost")
        effects = None if cost is None else cost.columns["levels"].values[0]
        levels = Levels(result.record["levels"], effects)
        for known in (levels.models, effects or 1):
            if known not in range(1, MOST_LEVELS + 1):
                allowed = f"allowed is from 1 to {MOST_LEVELS}"
                raise InputError(f"{path}: levels: is {known!r}; {allowed}")
        answers = result.arrays.answers if scene.answers else None
        return scene, Known(surface_of(scene, trace), answers, levels)
    except InputError:
        raise
    except BUILT_OTHERWISE as error:
        raise InputError(f"{path}: is no record of a run ({error!r}); allowed is one") from error


def _trace(folder: Path, result: Result) -> KnownTrace:
    """The recorded trace, if it is still what was recorded."""
    trace, info = result.arrays.trace(), result.scene["profile_info"]
    if digest(trace.x, trace.height) != result.record["hashes"]["trace"]:
        what = "has another SHA-256 than recorded; allowed is what was recorded"
        raise InputError(f"{folder / ARRAYS}: trace: {what}")
    how = {name: info[name] for name in ("format", "place", "bridged", "trimmed")}
    stretch = info["stretch"] and tuple(info["stretch"])
    return KnownTrace(MeasuredProfile(profile=trace, stretch=stretch, **how), info["sha256"])


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
