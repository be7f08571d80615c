"""Publishing a run's folder: whole files or none."""

import json
import os
import tempfile
from pathlib import Path

import pytest
from scenes import python

from comparisons.common.errors import InputError
from comparisons.common.files import check_writable, published, unfinished

NOBODY = 65534


def fill(folder, names, text="new"):
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)


def fill_as_run(folder, names, text="new"):
    """Fill a folder with the result of a run that wrote them."""
    fill(folder, names, text)
    result = {"schema": 3, "record": {"files": ["result.json", *names]}, "text": text}
    (folder / "result.json").write_text(json.dumps(result))


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
    fill_as_run(out, ["finite_element/mesh.msh", *further], "old")
    with published(out) as scratch:
        fill_as_run(scratch, [further[0]])
    assert '"text": "new"' in (out / "result.json").read_text()
    assert (out / "notes.txt").read_text() == "old"
    assert not (out / "finite_element").exists()
    assert (out / further[0]).read_text() == "new"
    assert not (out / further[1]).parent.exists()


@pytest.mark.parametrize("error", [RuntimeError, KeyboardInterrupt])
def test_a_failure_changes_nothing(tmp_path, error):
    out = tmp_path / "results"
    fill_as_run(out, ["run.npz"], "old")
    with pytest.raises(error), published(out) as scratch:
        fill(scratch, ["run.npz"])
        raise error
    assert (out / "run.npz").read_text() == "old"
    assert [p.name for p in tmp_path.iterdir()] == ["results"]
    assert {p.name for p in out.iterdir()} == {"result.json", "run.npz"}


@pytest.mark.parametrize(
    ("taken", "out", "why"),
    [
        ("taken", "taken", "not a folder"),
        ("taken", "taken/deeper", "not a folder"),
        ("half_plane", ".", "no result.json there says that crosscheck wrote half_plane"),
        ("result.json/mine", ".", r"no result.json there says that crosscheck wrote result.json"),
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


@pytest.mark.skipif(not Path("/proc/self").exists(), reason="there is no /proc to write in")
def test_a_folder_that_takes_no_files_is_refused_whatever_its_permissions():
    with pytest.raises(InputError, match=r"^/proc/results: cannot be written: /proc is read-only"):
        check_writable(Path("/proc/results"))


def test_the_parent_of_an_existing_folder_need_not_be_writable(unprivileged):
    """Folder like a mount point, where a rename from outside would fail as well."""
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
    fill_as_run(tmp_path, [], "old")
    fill(tmp_path, [name], "mine")
    with pytest.raises(InputError, match=f"no result.json there says that crosscheck wrote {name}"):
        check_writable(tmp_path)
    with pytest.raises(InputError), published(tmp_path) as scratch:
        fill_as_run(scratch, [])
    assert (tmp_path / name).read_text() == "mine"
    assert '"text": "old"' in (tmp_path / "result.json").read_text()


@pytest.mark.parametrize("result", ["", "[]", "{", '{"figures": []}', '{"schema": 3, "record": 3}'])
def test_a_strange_result_claims_nothing(tmp_path, result):
    (tmp_path / "result.json").write_text(result)
    with pytest.raises(InputError, match=r"no result.json there says"):
        check_writable(tmp_path)


KILLED = """
import os, signal, sys
from pathlib import Path
from comparisons.common.files import published
with published(Path(sys.argv[1])) as scratch:
    (scratch / "result.json").write_text("half")
    os.kill(os.getpid(), signal.SIGKILL)
"""


@pytest.mark.parametrize("exists", [False, True])
def test_what_a_killed_run_left_is_hidden(tmp_path, exists):
    out = tmp_path / "out"
    if exists:
        out.mkdir()
    python("-c", KILLED, out)
    assert not (out / "result.json").exists() and [*tmp_path.rglob(".*part-*/result.json")]
    with published(out) as folder:
        fill_as_run(folder, [])
    assert [p.name for p in out.iterdir() if not p.name.startswith(".")] == ["result.json"]
