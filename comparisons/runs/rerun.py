"""A recorded run once more, from its own record: what moved, and by how much more than stated."""

import json
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path

from comparisons.common.errors import ExitStatus, InputError
from comparisons.common.files import check_writable
from comparisons.common.mpi import from_first, is_first
from comparisons.common.progress import ProgressCallback, no_progress
from comparisons.common.provenance import as_json
from comparisons.results.changes import Movement, movement
from comparisons.results.outcome import Outcome
from comparisons.results.recorded_run import Record, read_record
from comparisons.runs.run import run

Pair = tuple[object, object]


@dataclass(frozen=True)
class Repetition:
    """A repeated run.

    movement  of its figures
    levels    of each model, recorded and repeated
    other     versions and properties of the machine that are not the recorded ones, both
    bits      whether every recorded hash came out again: pressures equal to the last bit
    """

    record: Record
    outcome: Outcome
    movement: Movement
    levels: tuple[int, int]
    other: dict[str, Pair]
    bits: bool

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

    Raises InputError for a folder without a record, with a broken one, or one that may not be
    written to.
    """
    record = from_first(lambda: read_record(folder))
    with _place(folder, out) as place:
        outcome = run(record.scene, place, record.models, callback)
    now = outcome.record
    return Repetition(
        record=record,
        outcome=outcome,
        movement=movement(record.figures, json.loads(as_json(outcome.result))),
        levels=(record.levels, now["levels"]),
        other=_unlike(record.versions, now["versions"]) | _unlike(record.machine, now["machine"]),
        bits=now["hashes"] == record.hashes,
    )


@contextmanager
def _place(folder: Path, out: Path | None) -> Iterator[Path]:
    """Where the repetition goes: `out`, or a folder that is dropped with it."""
    if out is not None:
        from_first(lambda: _check_other(folder, out))
        yield out
        return
    scratch = Path(from_first(lambda: tempfile.mkdtemp(prefix="crosscheck-")))
    try:
        yield scratch / "again"
    except KeyboardInterrupt:
        raise KeyboardInterrupt from None  # no level is kept to go on from
    finally:
        if is_first():
            shutil.rmtree(scratch, ignore_errors=True)


def _check_other(folder: Path, out: Path) -> None:
    """Raise InputError unless `out` can be written and is not, nor lies in, the recorded folder."""
    recorded, wanted = folder.resolve(), out.resolve()
    if recorded == wanted or recorded in wanted.parents:
        raise InputError(f"--out: {out} is in the recorded folder; allowed is another folder")
    check_writable(out)


def _unlike(before: dict, now: dict) -> dict[str, Pair]:
    names = dict.fromkeys([*before, *now])
    return {n: (before.get(n), now.get(n)) for n in names if before.get(n) != now.get(n)}
