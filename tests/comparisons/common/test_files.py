"""Publishing a run's folder: whole files or none."""

import json
import os
import tempfile
from pathlib import Path
from time import time

import pytest
from scenes import python

from comparisons.common.errors import InputError
from comparisons.common.files import DAY, check_writable, claim, claimed, published, unfinished

NOBODY = 65534


def fill(folder, names, text="new"):
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)


def fill_as_run(folder, names, text="new"):
    """The same with the record of a run that wrote them."""
    fill(folder, names, text)
    record = {"hashes": {}, "files": [*names, "record.json"]}
    (folder / "record.json").write_text(json.dumps(record))


def test_files_appear_at_the_end(tmp_path):
    out = tmp_path / "deep" / "results"
    with published(out) as scratch:
        fill(scratch, ["result.json", "half_plane/contact.csv"])
        assert not out.exists()
    assert (out / "half_plane/contact.csv").read_text() == "new"
    assert [p.name for p in out.parent.iterdir()] == ["results"]


def test_what_a_repetition_no_longer_makes_is_removed_and_strangers_stay(tmp_path):
    out = tmp_path / "results"
    further = [f"whole/friction_{friction}/stress.vtu" for friction in ("0.1", "0.2")]
    fill(out, ["notes.txt"], "old")
    fill_as_run(out, ["result.json", "finite_element/mesh.msh", *further], "old")
    with published(out) as scratch:
        fill_as_run(scratch, ["result.json", further[0]])
    assert (out / "result.json").read_text() == "new"
    assert (out / "notes.txt").read_text() == "old"
    assert not (out / "finite_element").exists()
    assert (out / further[0]).read_text() == "new"
    assert not (out / further[1]).parent.exists()


@pytest.mark.parametrize("error", [RuntimeError, KeyboardInterrupt])
def test_a_failure_changes_nothing(tmp_path, error):
    out = tmp_path / "results"
    fill_as_run(out, ["result.json"], "old")
    with pytest.raises(error), published(out) as scratch:
        fill(scratch, ["result.json"])
        raise error
    assert (out / "result.json").read_text() == "old"
    assert [p.name for p in tmp_path.iterdir()] == ["results"]
    assert {p.name for p in out.iterdir()} == {"result.json", "record.json"}


@pytest.mark.parametrize(
    ("taken", "out", "why"),
    [
        ("taken", "taken", "not a folder"),
        ("taken", "taken/deeper", "not a folder"),
        ("half_plane", ".", "half_plane is not a folder; allowed is a folder"),
        ("result.json/mine", ".", r"result\.json is a folder"),
    ],
)
def test_what_is_in_the_way_is_refused_and_stays(tmp_path, taken, out, why):
    fill(tmp_path, [taken], "mine")
    with pytest.raises(InputError, match=why):
        check_writable(tmp_path / out)
    assert (tmp_path / taken).read_text() == "mine"


@pytest.fixture
def unprivileged():
    """A new folder, and for the test a user whom permission bits hold back."""
    with tempfile.TemporaryDirectory() as folder:
        user = os.geteuid()
        if user == 0:
            os.chown(folder, NOBODY, NOBODY)
            os.seteuid(NOBODY)
        try:
            yield Path(folder)
        finally:
            os.seteuid(user)
            os.chmod(folder, 0o700)


def test_a_folder_without_permission_is_refused(unprivileged):
    unprivileged.chmod(0o500)
    with pytest.raises(InputError, match=r"results: cannot be written: .* is read-only"):
        check_writable(unprivileged / "results")


def test_the_parent_of_an_existing_folder_need_not_be_writable(unprivileged):
    """As of a mount point, where a rename from outside would fail as well."""
    out = unprivileged / "results"
    out.mkdir()
    unprivileged.chmod(0o500)
    check_writable(out)
    with published(out) as scratch:
        assert scratch.parent == unfinished(out, "run").parents[1] == out
        fill(scratch, ["result.json", "half_plane/contact.csv"])
    assert sorted(p.name for p in out.iterdir()) == ["half_plane", "result.json"]


@pytest.mark.parametrize("name", ["report.pdf", "run_in_profile.csv", "finite_element/stress.vtu"])
def test_somebody_elses_file_is_neither_replaced_nor_removed(tmp_path, name):
    fill_as_run(tmp_path, ["result.json"], "old")
    fill(tmp_path, [name], "mine")
    with pytest.raises(InputError, match=f"no record there says that crosscheck wrote {name}"):
        check_writable(tmp_path)
    with pytest.raises(InputError), published(tmp_path) as scratch:
        fill_as_run(scratch, ["result.json"])
    assert (tmp_path / name).read_text() == "mine"
    assert (tmp_path / "result.json").read_text() == "old"


@pytest.mark.parametrize("record", ["", "[]", "{", '{"schema": 2}', '{"hashes": {}, "files": 3}'])
def test_a_strange_record_claims_nothing(tmp_path, record):
    fill(tmp_path, ["result.json"], "mine")
    (tmp_path / "record.json").write_text(record)
    with pytest.raises(InputError, match="no record there says"):
        check_writable(tmp_path)


def test_a_file_added_later_is_claimed(tmp_path):
    fill_as_run(tmp_path, ["result.json"])
    fill(tmp_path, ["report.pdf"])
    claim(tmp_path, "report.pdf")
    assert claimed(tmp_path) == {"result.json", "record.json", "report.pdf"}


KILLED = """
import os, signal, sys
from pathlib import Path
from comparisons.common.files import published, whole_file
out = Path(sys.argv[1])
with whole_file(out.parent / "page.html") as part, published(out) as scratch:
    part.write_text("half")
    (scratch / "result.json").write_text("half")
    os.kill(os.getpid(), signal.SIGKILL)
"""


@pytest.mark.parametrize("exists", [False, True])
def test_what_a_killed_run_left_is_hidden_and_goes_after_a_day(tmp_path, exists):
    out = tmp_path / "out"
    if exists:
        out.mkdir()
    python("-c", KILLED, out)
    assert not (out / "result.json").exists() and not (tmp_path / "page.html").exists()
    [scratch] = tmp_path.rglob("*.part-*")
    for age in (0.0, 2.0 * DAY):
        os.utime(scratch, 2 * (time() - age,))
        with published(out) as folder:
            fill_as_run(folder, ["result.json"])
        assert scratch.exists() == (age < DAY)
