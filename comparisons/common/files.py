"""Writing files, and a run's folder of them, so that each appears whole or not at all.

A file is written under a hidden name beside its own and renamed once. A folder that holds this
program's files says so itself: by their first one, JSON with a `schema`. What somebody else wrote
is never replaced."""

import csv
import glob
import io
import json
import os
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path

from comparisons.common.errors import InputError
from comparisons.common.provenance import as_json

OWN_FOLDERS = ("half_plane", "finite_element", "whole")
REPORT, PDF = "report.html", "report.pdf"
# What a run may write, by name or pattern; those of further friction coefficients lie deeper.
OWN_FILES = (
    *("result.json", REPORT, PDF, "run.npz", "run_in_profile.csv", "finite_element/**/mesh.msh"),
    *(f"{m}/**/{name}" for m in OWN_FOLDERS for name in ("contact.csv", "stress.vtu")),
)


def unfinished(out: Path, command: str) -> Path:
    """The folder for what a command into `out` has finished, while the command has not ended: its
    own, so that another one's end leaves it alone."""
    beside = out.parent / f".{out.name}.unfinished"
    # that of a command which began before `out` was made is still good
    return (out / ".unfinished" if out.is_dir() and not beside.is_dir() else beside) / command


def claimed(out: Path, files: tuple[str, ...] = OWN_FILES) -> set[str]:
    """Names of those of the `files` in a folder that this program wrote: of a run those that its
    record lists, else all."""
    with suppress(OSError, ValueError, TypeError, AttributeError):
        content, present = json.loads((out / files[0]).read_bytes()), set(_present(out, files))
        listed = content.get("record", {}).get("files", present)
        return present.intersection(listed) if "schema" in content else set()
    return set()


def holds_comparison(out: Path) -> bool:
    """True where a folder has a finished run of both models."""
    return {f"{model}/contact.csv" for model in OWN_FOLDERS[:2]} <= claimed(out)


def claim(out: Path, name: str) -> None:
    """Note in a run's record that this program wrote a file more."""
    content = json.loads((out / OWN_FILES[0]).read_bytes())
    content["record"]["files"] = sorted({*content["record"]["files"], name})
    write_whole(out / OWN_FILES[0], as_json(content))


def check_writable(out: Path, files: tuple[str, ...] = OWN_FILES) -> None:
    """Raise InputError unless `out` is, or can be made, a folder to write `files` in, by name or
    pattern, and holds none of them that somebody else wrote."""
    with suppress(FileNotFoundError, NotADirectoryError):
        os.lstat(out)  # raises for a name that no file can have
    place = next(path for path in (out, *out.parents) if os.path.lexists(path))
    if not place.is_dir():
        raise _cannot(out, f"{place} is not a folder; allowed is a folder")
    try:
        tempfile.TemporaryFile(dir=place).close()  # which permissions alone do not tell
    except OSError:
        raise _cannot(out, f"{place} is read-only; allowed is a folder to write in") from None
    folders = {name.partition("/")[0] for name in files if "/" in name}
    taken = {name for name in folders if (out / name).is_file()}.union(_present(out, files))
    for name in sorted(taken - claimed(out, files) if taken else ()):
        why = f"no {files[0]} there says that crosscheck wrote {name}"
        raise _cannot(out, f"{why}; allowed is another folder")


def check_file(path: Path) -> None:
    """Raise InputError unless a file can be written there; its folder is made if need be."""
    if path.is_dir():
        raise InputError(f"{path}: cannot be written: is a folder; allowed is a file")
    check_writable(path.parent, ())


def _present(out: Path, patterns: tuple[str, ...]) -> list[str]:
    return [name for one in patterns for name in glob.glob(one, root_dir=out, recursive=True)]


def _cannot(out: Path, why: str) -> InputError:
    return InputError(f"{out}: cannot be written: {why}")


def write_whole(path: Path, content: str | bytes) -> None:
    """Write a file, text as UTF-8, in a folder that is made if need be. Where that fails or is
    interrupted the file stays as it was."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        part.write_bytes(content.encode() if isinstance(content, str) else content)
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)


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
    # inside where that exists: its parent need not be writable, nor on the same file system
    place, prefix = (out, ".part-") if out.is_dir() else (out.parent, f".{out.name}.part-")
    place.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=prefix, dir=place) as folder:
        scratch = Path(folder)
        yield scratch
        made = [str(p.relative_to(scratch)) for p in scratch.rglob("*") if p.is_file()]
        left = claimed(out, files).difference(made)
        for name in sorted(made, key=lambda name: name != files[0]):  # first what claims others
            (out / name).parent.mkdir(parents=True, exist_ok=True)
            os.replace(scratch / name, out / name)
        for name in left:
            (out / name).unlink(missing_ok=True)
            with suppress(OSError):  # holds something
                os.removedirs((out / name).parent)


def publish(out: Path, contents: Mapping[str, str | bytes], files: tuple[str, ...] = ()) -> None:
    """Leave contents by name in `out`, whole, all or none; `files` as for `published`, or these."""
    with published(out, files or tuple(contents)) as folder:
        for name, content in contents.items():
            write_whole(folder / name, content)
