"""Publishing a run's folder: whole files or none."""

import os

import pytest

from comparisons.errors import InputError
from comparisons.files import check_writable, published


def fill(folder, names, text="new"):
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)


def test_files_appear_at_the_end(tmp_path):
    out = tmp_path / "deep" / "results"
    with published(out) as scratch:
        fill(scratch, ["result.json", "half_plane/contact.csv"])
        assert not out.exists()
    assert (out / "half_plane/contact.csv").read_text() == "new"
    assert [p.name for p in out.parent.iterdir()] == ["results"]


def test_what_a_repetition_no_longer_makes_is_removed_and_strangers_stay(tmp_path):
    out = tmp_path / "results"
    fill(out, ["result.json", "finite_element/mesh.msh", "notes.txt"], "old")
    with published(out) as scratch:
        fill(scratch, ["result.json"])
    assert (out / "result.json").read_text() == "new"
    assert (out / "notes.txt").read_text() == "old"
    assert not (out / "finite_element").exists()


@pytest.mark.parametrize("error", [RuntimeError, KeyboardInterrupt])
def test_a_failure_changes_nothing(tmp_path, error):
    out = tmp_path / "results"
    fill(out, ["result.json"], "old")
    with pytest.raises(error), published(out) as scratch:
        fill(scratch, ["result.json"])
        raise error
    assert (out / "result.json").read_text() == "old"
    assert [p.name for p in tmp_path.iterdir()] == ["results"]


def test_a_file_in_the_way_is_refused(tmp_path):
    (tmp_path / "taken").write_text("mine")
    for out in (tmp_path / "taken", tmp_path / "taken" / "deeper"):
        with pytest.raises(InputError, match="not a folder"):
            check_writable(out)
    assert (tmp_path / "taken").read_text() == "mine"


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_a_folder_without_permission_is_refused(tmp_path):
    tmp_path.chmod(0o500)
    with pytest.raises(InputError, match="no permission"):
        check_writable(tmp_path / "results")
