"""Writing files, and a run's folder of them, so that each appears whole or not at all.

Unfinished files are inside the folder where it exists: its parent need not be writable, and no file
moves to another file system. Else they are beside it: the folder appears with the results.
"""

import contextlib
import errno
import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from comparisons.common.errors import InputError

# What a run may write; those that a repetition does not write again are removed.
OWN_FOLDERS = ("half_plane", "finite_element")
OWN_FILES = (
    *("result.json", "report.html", "report.npz", "report.pdf", "record.json"),
    *("run_in_profile.csv", "finite_element/mesh.msh"),
    *(f"{model}/{name}" for model in OWN_FOLDERS for name in ("contact.csv", "stress.vtu")),
)
# The same in formats that a run writes when it is asked to, or where a field is large.
OTHER_FILES = tuple(f"{model}/stress.{name}" for model in OWN_FOLDERS for name in ("vtkhdf", "msh"))
PART = ".part"  # ends the name of a file that is not whole yet
ATTEMPTS = 10  # at a folder that another run into the same `out` keeps removing


def unfinished(out: Path) -> Path:
    """The folder of a run's finished levels while the run into `out` has not ended."""
    beside = out.parent / f".{out.name}.unfinished"
    # that of a run which began before `out` was made is still good
    return out / ".unfinished" if out.is_dir() and not beside.is_dir() else beside


def check_writable(out: Path) -> None:
    """Raise InputError unless `out` is, or can be made, a folder to write a run in."""
    try:  # the longest name that is used beside it
        os.lstat(out.parent / f".{out.name}.part-12345678")
    except OSError as error:
        if error.errno == errno.ENAMETOOLONG:
            raise _cannot(out, f"{error.strerror}; allowed is a shorter name") from error
    place = out
    while not os.path.lexists(place) and place != place.parent:
        place = place.parent
    _check_folder(out, place)
    for folder in (unfinished(out), *(out / name for name in OWN_FOLDERS)):
        if os.path.lexists(folder):
            _check_folder(out, folder)
    for name in (*OWN_FILES, *OTHER_FILES):
        if (out / name).is_dir():
            raise _cannot(out, f"{out / name} is a folder; allowed is none")


def _cannot(out: Path, why: str) -> InputError:
    return InputError(f"{out}: cannot be written: {why}")


def _check_folder(out: Path, place: Path) -> None:
    """Raise InputError, which names `out`, unless `place` is a folder to write in, or is gone.

    Permission bits are not enough (root, a read-only file system), so a folder is made there and
    removed. Another run may remove `place` meanwhile, or remove it and make it again.
    """
    for attempt in range(ATTEMPTS):
        if not os.path.lexists(place):
            return
        try:
            tempfile.TemporaryDirectory(prefix=".crosscheck-", dir=place).cleanup()
            return
        except NotADirectoryError as error:
            raise _cannot(out, f"{place} is not a folder; allowed is a folder") from error
        except OSError as error:
            if isinstance(error, FileNotFoundError) and attempt < ATTEMPTS - 1:
                continue
            why = f"{place} ({error.strerror}); allowed is a folder that can"
            raise _cannot(out, why) from error


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """A path to write to: what is there when the block ends replaces `path`; if the block fails or
    is interrupted, `path` stays as it was."""
    part = path.with_name(f".{path.name}.{os.getpid()}{PART}")
    try:
        yield part
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)


def write_whole(path: Path, text: str) -> None:
    """Write a file as UTF-8."""
    with whole_file(path) as part:
        part.write_text(text, encoding="utf-8")


def remove_leftovers(folder: Path) -> None:
    """Remove what a process left that was killed within a `whole_file` of this folder."""
    for part in folder.glob(f".*{PART}"):
        part.unlink(missing_ok=True)


@contextmanager
def published(out: Path, own: tuple[str, ...] = (*OWN_FILES, *OTHER_FILES)) -> Iterator[Path]:
    """A scratch folder whose files replace those of `out`, one by one and whole, at the end.

    own   files that are removed where they are not made again
    If the block fails or is interrupted nothing in `out` changes.
    """
    check_writable(out)
    if out.is_dir():
        scratch = Path(tempfile.mkdtemp(prefix=".part-", dir=out))
    else:
        out.parent.mkdir(parents=True, exist_ok=True)
        scratch = Path(tempfile.mkdtemp(prefix=f".{out.name}.part-", dir=out.parent))
    try:
        yield scratch
        made = sorted(p.relative_to(scratch) for p in scratch.rglob("*") if p.is_file())
        for name in made:
            _move(scratch / name, out / name)
        for name in own:
            if Path(name) not in made:
                (out / name).unlink(missing_ok=True)
        for folder in OWN_FOLDERS:
            with contextlib.suppress(OSError):  # absent, or holds something
                (out / folder).rmdir()
    finally:
        shutil.rmtree(scratch, ignore_errors=True)


def _move(source: Path, target: Path) -> None:
    """Put a file in its place, in a folder that another run may remove while it is empty."""
    for attempt in range(ATTEMPTS):
        target.parent.mkdir(parents=True, exist_ok=True)
        try:
            os.replace(source, target)
            return
        except FileNotFoundError:
            if attempt == ATTEMPTS - 1:
                raise
