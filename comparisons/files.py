"""Writing a run's folder so that every file appears whole or not at all."""

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from comparisons.errors import InputError

# What a run may leave; on a repetition, those that it does not write again are removed.
OWN_FILES = (
    "result.json",
    "report.html",
    "record.json",
    "half_plane/contact.csv",
    "half_plane/stress.vtu",
    "finite_element/contact.csv",
    "finite_element/stress.vtu",
    "finite_element/mesh.msh",
)


def check_writable(out: Path) -> None:
    """Raise InputError unless `out` is, or can be made, a folder to write in.

    Permission bits do not tell (of root, of a read-only file system), so a folder is made and
    removed where the first new one would be.
    """
    place = out
    while not os.path.lexists(place) and place != place.parent:
        place = place.parent
    if not place.is_dir():
        raise InputError(f"{out}: cannot be written: {place} is not a folder; allowed is a folder")
    try:
        tempfile.TemporaryDirectory(prefix=".crosscheck-", dir=place).cleanup()
    except OSError as error:
        raise InputError(
            f"{out}: cannot be written: {place} ({error.strerror}); allowed is a folder that can"
        ) from error


@contextmanager
def published(out: Path) -> Iterator[Path]:
    """A scratch folder whose files replace those of `out`, one by one and whole, at the end.

    If the block fails or is interrupted nothing in `out` changes.
    """
    check_writable(out)
    out.parent.mkdir(parents=True, exist_ok=True)
    scratch = Path(tempfile.mkdtemp(prefix=f".{out.name}-", dir=out.parent))
    try:
        yield scratch
        made = sorted(p.relative_to(scratch) for p in scratch.rglob("*") if p.is_file())
        out.mkdir(exist_ok=True)
        for name in made:
            (out / name).parent.mkdir(exist_ok=True)
            os.replace(scratch / name, out / name)
        for name in OWN_FILES:
            if Path(name) not in made:
                (out / name).unlink(missing_ok=True)
        for folder in ("half_plane", "finite_element"):
            if (out / folder).is_dir() and not any((out / folder).iterdir()):
                (out / folder).rmdir()
    finally:
        shutil.rmtree(scratch, ignore_errors=True)
