"""Writing files, and a run's folder of them, so that each appears whole or not at all.

Unfinished files are inside the folder where it exists: its parent need not be writable, and no file
moves to another file system. Else they are beside it: the folder appears with the results."""

import csv
import fcntl
import glob
import io
import json
import os
import shutil
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager, suppress
from pathlib import Path

from comparisons.common.errors import InputError

OWN_FOLDERS = ("half_plane", "finite_element", "whole")
REPORT = "report.html"
# of the second friction coefficient, and so on
FURTHER = tuple(f"{model}/friction_*" for model in OWN_FOLDERS)
# What a run may write, by name or pattern; those that a repetition does not write again are
# removed.
OWN_FILES = (
    *("result.json", REPORT, "run.npz", "report.pdf", "record.json"),
    *("run_in_profile.csv", "finite_element/mesh.msh", "finite_element/friction_*/mesh.msh"),
    *(f"{m}/{name}" for m in OWN_FOLDERS + FURTHER for name in ("contact.csv", "stress.vtu")),
)
RECORD = "record.json"  # of a run: its "files" are this program's
# Those whose own record is <name>.json.
STUDIES = ("benchmarks", "cost", "map", "stability", "sweep", "verify")
RECORDS = (RECORD, *(f"{name}.json" for name in STUDIES))
PART = ".part"  # ends the name of a file that is not whole yet


def unfinished(out: Path, command: str) -> Path:
    """The folder for what a command into `out` has finished, while the command has not ended: its
    own, so that another one's end leaves it alone."""
    return _unfinished(out) / command


def _unfinished(out: Path) -> Path:
    beside = out.parent / f".{out.name}.unfinished"
    # that of a command which began before `out` was made is still good
    return out / ".unfinished" if out.is_dir() and not beside.is_dir() else beside


def claimed(out: Path, together: tuple[str, ...] = ()) -> set[str]:
    """Names of the files in a folder that this program wrote, as the records there say.

    together  names of files that are written together; a study's record among them is the record
              of all"""
    names: set[str] = set()
    record = _record(out / RECORD)
    if "hashes" in record:
        files = record.get("files")
        names |= {RECORD, *map(str, files)} if isinstance(files, list | tuple) else set()
    for study in STUDIES:
        if "schema" in _record(out / f"{study}.json"):
            names |= {path.name for path in out.glob(f"{study}*")}
            names |= set(together) if f"{study}.json" in together else set()
    return names


def holds_comparison(out: Path) -> bool:
    """Whether a folder has a finished run of both models."""
    return {f"{model}/contact.csv" for model in OWN_FOLDERS[:2]} <= claimed(out)


def claim(out: Path, name: str) -> None:
    """Note in a run's record that this program wrote a file more."""
    record = _record(out / RECORD)
    if name not in (files := record.get("files", ())):
        record = record | {"files": sorted([*files, name])}
        text = json.dumps(record, indent=1, ensure_ascii=False) + "\n"
        write_whole(out / RECORD, text)


def _record(path: Path) -> dict:
    """A JSON object in a file; empty where there is none."""
    with suppress(OSError, ValueError):
        content = json.loads(path.read_bytes())
        return content if isinstance(content, dict) else {}
    return {}


def check_writable(out: Path, files: tuple[str, ...] = OWN_FILES) -> None:
    """Raise InputError unless `out` is, or can be made, a folder to write `files` in, by name or
    pattern, and holds none of them that somebody else wrote."""
    place = out
    while not os.path.lexists(place) and place != place.parent:
        place = place.parent
    _check_folder(out, place)
    for folder in (_unfinished(out), *(out / name for name in OWN_FOLDERS)):
        if os.path.lexists(folder):
            _check_folder(out, folder)
    present = _present(out, files)
    for name in present:
        if (out / name).is_dir():
            raise _cannot(out, f"{out / name} is a folder; allowed is none")
    if present:
        with _alone_in(out):
            ours = claimed(out, files)
            foreign = [n for n in present if n not in ours and os.path.lexists(out / n)]
        if foreign:
            why = f"no record there says that crosscheck wrote {foreign[0]}"
            raise _cannot(out, f"{why}; allowed is another folder")


@contextmanager
def _locked(path: Path, how: int) -> Iterator[bool | None]:
    """Lock a file or folder to the block's end: whether it is; None where a disk has no locks."""
    is_locked, number = True, None
    try:
        number = os.open(path, os.O_RDONLY)
        fcntl.flock(number, how)
    except (BlockingIOError, FileNotFoundError):
        is_locked = False
    except OSError:
        is_locked = None
    try:
        yield is_locked
    finally:
        if number is not None:
            os.close(number)


def _alone_in(out: Path) -> AbstractContextManager[bool | None]:
    """Wait until no other run compares or replaces the folder's files."""
    return _locked(out, fcntl.LOCK_EX)


def _present(out: Path, patterns: tuple[str, ...]) -> list[str]:
    return [name for pattern in patterns for name in glob.glob(pattern, root_dir=out)]


def _cannot(out: Path, why: str) -> InputError:
    return InputError(f"{out}: cannot be written: {why}")


def _check_folder(out: Path, place: Path) -> None:
    """Raise InputError, which names `out`, unless `place` is a folder to write in, or is gone.
    Permission bits are not enough (root, a read-only file system), so a folder is made there and
    removed. Another run may remove `place` meanwhile."""
    try:
        os.rmdir(tempfile.mkdtemp(prefix=".crosscheck-", dir=place))  # opens no file
    except NotADirectoryError as error:
        raise _cannot(out, f"{place} is not a folder; allowed is a folder") from error
    except OSError as error:
        if os.path.lexists(place):
            why = f"{place} ({error.strerror}); allowed is a folder that can"
            raise _cannot(out, why) from error


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """A path to write to: what is there when the block ends replaces `path`; if the block fails or
    is interrupted, `path` stays as it was."""
    part = path.with_name(f".{path.name}.{os.getpid()}{PART}")
    _remove_abandoned(path.parent.glob(f".{glob.escape(path.name)}.*{PART}"))
    part.touch()
    with _held(part):
        try:
            yield part
            os.replace(part, path)
        finally:
            part.unlink(missing_ok=True)


@contextmanager
def _held(path: Path) -> Iterator[bool]:
    """Lock an unfinished file or folder until the block, or this process, ends. Whether it is held,
    and still there: another process may have taken it for abandoned just before."""
    with _locked(path, fcntl.LOCK_EX | fcntl.LOCK_NB) as is_locked:
        yield is_locked is not False and path.exists()


def _remove_abandoned(parts: Iterable[Path]) -> None:
    """Remove unfinished files and folders whose process was killed: nobody holds them."""
    for part in parts:
        with suppress(OSError), _locked(part, fcntl.LOCK_EX | fcntl.LOCK_NB) as is_locked:
            if is_locked and part.is_dir():
                shutil.rmtree(part)
            elif is_locked:
                part.unlink()


def write_whole(path: Path, text: str) -> None:
    """Write a file as UTF-8."""
    with whole_file(path) as part:
        part.write_text(text, encoding="utf-8")


def csv_text(rows: Iterable[Iterable[object]]) -> str:
    """Rows of a table as the text of a CSV file."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()


def remove_leftovers(folder: Path) -> None:
    """Remove what a process left that was killed within a `whole_file` of this folder."""
    for part in folder.glob(f".*{PART}"):
        part.unlink(missing_ok=True)


@contextmanager
def published(out: Path, files: tuple[str, ...] = OWN_FILES) -> Iterator[Path]:
    """A scratch folder whose files replace those of `out`, one by one and whole, at the end.

    files  names or patterns of those that are removed where they are not made again
    If the block fails or is interrupted nothing in `out` changes."""
    check_writable(out, files)
    with _scratch(out) as scratch:
        yield scratch
        made = sorted(p.relative_to(scratch) for p in scratch.rglob("*") if p.is_file())
        made.sort(key=lambda name: str(name) not in RECORDS)  # first what claims the others
        out.mkdir(exist_ok=True)
        with _alone_in(out):
            ours = claimed(out, files)
            for name in made:
                (out / name).parent.mkdir(parents=True, exist_ok=True)
                os.replace(scratch / name, out / name)
            for name in ours & set(_present(out, files)):
                if Path(name) not in made:
                    (out / name).unlink(missing_ok=True)
            for folder in (*_present(out, FURTHER), *OWN_FOLDERS):
                with suppress(OSError):  # absent, or holds something
                    (out / folder).rmdir()


def publish(out: Path, contents: Mapping[str, str | bytes], files: tuple[str, ...] = ()) -> None:
    """Leave contents by name in `out`, whole, all or none; `files` as for `published`, or these."""
    with published(out, files or tuple(contents)) as folder:
        for name, content in contents.items():
            data = content.encode() if isinstance(content, str) else content
            (folder / name).write_bytes(data)


@contextmanager
def _scratch(out: Path) -> Iterator[Path]:
    """A new folder for unfinished files of `out`; those of killed processes are removed."""
    beside = f".{out.name}.part-"
    while True:
        place, prefix = (out, ".part-") if out.is_dir() else (out.parent, beside)
        place.mkdir(parents=True, exist_ok=True)
        left = [*out.glob(".part-*"), *out.parent.glob(f"{glob.escape(beside)}*")]
        _remove_abandoned(left)
        scratch = Path(tempfile.mkdtemp(prefix=prefix, dir=place))
        with _held(scratch) as held:
            if held:
                try:
                    yield scratch
                finally:
                    shutil.rmtree(scratch, ignore_errors=True)
                return
