"""Writing files, and a run's folder of them, so that each appears whole or not at all.

Unfinished files are inside the folder where it exists: its parent need not be writable, and no file
moves to another file system. Else they are beside it: the folder appears with the results."""

import csv
import glob
import io
import json
import os
import shutil
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from time import time

from comparisons.common.errors import InputError

OWN_FOLDERS = ("half_plane", "finite_element", "whole")
REPORT = "report.html"
RECORD = "record.json"  # its "files" are this program's
# of the second friction coefficient, and so on
FURTHER = tuple(f"{model}/friction_*" for model in OWN_FOLDERS)
# What a run may write, by name or pattern, its record first; those that a repetition does not write
# again are removed.
OWN_FILES = (
    *(RECORD, "result.json", REPORT, "run.npz", "report.pdf"),
    *("run_in_profile.csv", "finite_element/mesh.msh", "finite_element/friction_*/mesh.msh"),
    *(f"{m}/{name}" for m in OWN_FOLDERS + FURTHER for name in ("contact.csv", "stress.vtu")),
)
DAY = 86400.0  # s; whoever has not written for so long was killed


def unfinished(out: Path, command: str) -> Path:
    """The folder for what a command into `out` has finished, while the command has not ended: its
    own, so that another one's end leaves it alone."""
    beside = out.parent / f".{out.name}.unfinished"
    # that of a command which began before `out` was made is still good
    return (out / ".unfinished" if out.is_dir() and not beside.is_dir() else beside) / command


def claimed(out: Path, files: tuple[str, ...] = OWN_FILES) -> set[str]:
    """Names of those of the `files` in a folder that this program wrote, as the record there says,
    which is the first of them: a run's lists what it wrote, any other is that of all."""
    record, present = _record(out / files[0]), set(_present(out, files))
    if files[0] != RECORD:
        return present if "schema" in record else set()
    listed = record.get("files")
    return present.intersection(listed) if isinstance(listed, list) else set()


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
    with suppress(FileNotFoundError, NotADirectoryError):
        os.lstat(out)  # raises for a name that no file can have
    place = out
    while not os.path.lexists(place) and place != place.parent:
        place = place.parent
    for folder in (place, *(out / name for name in OWN_FOLDERS)):
        if os.path.lexists(folder) and not folder.is_dir():
            raise _cannot(out, f"{folder} is not a folder; allowed is a folder")
        if folder.is_dir() and not os.access(folder, os.W_OK, effective_ids=True):
            raise _cannot(out, f"{folder} is read-only; allowed is a folder to write in")
    present = _present(out, files)
    ours = claimed(out, files) if present else ()
    for name in present:
        if (out / name).is_dir():
            raise _cannot(out, f"{out / name} is a folder; allowed is none")
        if name not in ours:
            why = f"no record there says that crosscheck wrote {name}"
            raise _cannot(out, f"{why}; allowed is another folder")


def _present(out: Path, patterns: tuple[str, ...]) -> list[str]:
    return [name for pattern in patterns for name in glob.glob(pattern, root_dir=out)]


def _cannot(out: Path, why: str) -> InputError:
    return InputError(f"{out}: cannot be written: {why}")


def _remove_abandoned(paths: Iterable[Path]) -> None:
    """Remove those files and folders that a process left which was killed a day ago."""
    for path in paths:
        with suppress(FileNotFoundError):  # another process has just done with it
            if time() - path.stat().st_mtime > DAY:
                shutil.rmtree(path) if path.is_dir() else path.unlink()


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """A path to write to: what is there when the block ends replaces `path`; if the block fails or
    is interrupted, `path` stays as it was."""
    beside = f".{path.name}."
    part = path.with_name(f"{beside}{os.getpid()}.part")
    _remove_abandoned(path.parent.glob(f"{glob.escape(beside)}*.part"))
    try:
        yield part
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)


def write_whole(path: Path, text: str) -> None:
    """Write a file as UTF-8."""
    with whole_file(path) as part:
        part.write_text(text, encoding="utf-8")


def csv_text(rows: Iterable[Iterable[object]]) -> str:
    """Rows of a table as the text of a CSV file."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()


@contextmanager
def published(out: Path, files: tuple[str, ...] = OWN_FILES) -> Iterator[Path]:
    """A scratch folder whose files replace those of `out`, one by one and whole, at the end.

    files  names or patterns of those that are removed where they are not made again
    If the block fails or is interrupted nothing in `out` changes."""
    check_writable(out, files)
    beside = f".{out.name}.part-"
    place, prefix = (out, ".part-") if out.is_dir() else (out.parent, beside)
    place.mkdir(parents=True, exist_ok=True)
    _remove_abandoned((*out.glob(".part-*"), *out.parent.glob(f"{glob.escape(beside)}*")))
    with tempfile.TemporaryDirectory(prefix=prefix, dir=place) as folder:
        scratch = Path(folder)
        yield scratch
        made = sorted(p.relative_to(scratch) for p in scratch.rglob("*") if p.is_file())
        made.sort(key=lambda name: str(name) != files[0])  # first what claims others
        ours = claimed(out, files)
        for name in made:
            (out / name).parent.mkdir(parents=True, exist_ok=True)
            os.replace(scratch / name, out / name)
        for name in ours - set(map(str, made)):
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
