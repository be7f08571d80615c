"""Files of stresses in the manner of SUBSURF: written, read again, refused where broken."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

from analytic.exact.hertz import hertz_stress
from comparisons.common.errors import InputError
from comparisons.studies.paper.subsurf import (
    DECIMALS,
    PARTS,
    TITLE,
    SubsurfFile,
    read_subsurf,
    write_subsurf,
)
from comparisons.studies.paper.subsurf_mesh import subsurf_files

POSITIVE = st.floats(1e-12, 1e12)
TEXT = st.text(st.characters(codec="utf-8", categories=("L", "N", "P", "S")), min_size=1)


def header_for(shape: tuple[int, int], **contact) -> dict:
    layers, columns = shape
    return {
        "profile": {"file": 'a "quoted" µ-trace.csv', "samples": 2237},
        "contact": {"peak_pressure": 4e9, "half_width": 5e-4, **contact},
        "stress": {
            "component": "principal shear over peak_pressure",
            "friction": 0.1,
            "columns": columns,
            "layers": layers,
            "x_first": -6.25e-4,
            "x_step": 1.0 / 3.0,
            "z_first": 0.0,
            "z_step": 5e-6,
        },
    }


def example() -> SubsurfFile:
    return SubsurfFile(np.array([[0.0, -0.5, 1.25], [0.1, 1e-9, -1e-9]]), header_for((2, 3)))


@settings(max_examples=60, deadline=None)
@given(
    stress=arrays(float, array_shapes(min_dims=2, max_dims=2), elements=st.floats(-1e3, 1e3)),
    number=POSITIVE,
    words=TEXT,
)
def test_a_file_read_again_is_what_was_written(tmp_path_factory, stress, number, words):
    path = tmp_path_factory.mktemp("subsurf") / "field.txt"
    content = SubsurfFile(stress, header_for(stress.shape, radius=number, note=words, count=7))
    write_subsurf(path, content)
    found = read_subsurf(path)
    assert found.header == content.header  # every digit of a float, ints as ints
    np.testing.assert_array_equal(found.stress, np.round(stress, DECIMALS) + 0.0)
    text = path.read_bytes()
    write_subsurf(path, found)
    assert path.read_bytes() == text


def test_layers_come_first_and_the_header_last(tmp_path):
    path = tmp_path / "field.txt"
    write_subsurf(path, example())
    lines = path.read_text().splitlines()
    assert lines[0] == "0.00000 -0.50000 1.25000"
    assert lines[1] == "0.10000 0.00000 0.00000"  # no sign of what rounds to nothing
    assert lines[2] == TITLE
    headings = [line for line in lines[3:] if line.startswith("[")]
    assert headings == [f"[{part}]" for part in PARTS]
    assert lines[-1] == "z_step = 5e-06"


def test_places_follow_from_the_header(tmp_path):
    path = tmp_path / "field.txt"
    write_subsurf(path, example())
    found = read_subsurf(path)
    np.testing.assert_allclose(found.x, -6.25e-4 + np.arange(3) / 3.0)
    np.testing.assert_allclose(found.z, [0.0, 5e-6])


def test_windows_line_ends_are_read(tmp_path):
    path = tmp_path / "field.txt"
    write_subsurf(path, example())
    path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
    np.testing.assert_array_equal(read_subsurf(path).stress[0], [0.0, -0.5, 1.25])


@pytest.mark.parametrize(
    ("old", "new", "fragment"),
    [
        (f"{TITLE}\n", "", f"has no line {TITLE}; allowed is a whole file"),
        ("0.00000 -0.50000 1.25000\n", "", f"has 1 layers above {TITLE}; allowed are 2"),
        ("-0.50000 ", "", "line 1: has 2 numbers; allowed are 3"),
        ("-0.50000", "half", "line 1: holds no numbers alone"),
        ("-0.50000", "nan", "line 1: holds no numbers alone"),
        ("-0.50000", "1_0", "line 1: holds no numbers alone"),
        ("columns = 3", "columns = 0", "columns is 0; allowed is a whole number from 1 on"),
        ("columns = 3", "columns = 3.0", "columns is 3.0; allowed is a whole number"),
        ("columns = 3\n", "", "the header lacks columns of [stress]"),
        ("columns = 3", "columns = three", "line 13: the value is three"),
        ("columns = 3", "columns: 3", "line 13: is 'columns: 3'; allowed in the header"),
        ("columns = 3", "columns = 3\ncolumns = 3", "line 14: is 'columns = 3'"),
        ("friction = 0.1", "friction = inf", "line 12: the value is inf"),
        ("friction = 0.1", 'friction = "a tenth"', "friction of [stress] is 'a tenth'"),
        ("x_step = 0.3333333333333333", "x_step = -1.0", "x_step of [stress] is -1.0; allowed is"),
        ("peak_pressure = 4000000000.0", "peak_pressure = 0", "peak_pressure of [contact] is 0"),
        ("[contact]", "[contacts]", "line 7: is the part contacts; allowed are profile, contact"),
        ("[contact]", "[profile]", "line 7: is the part profile; allowed are"),
        ("[stress]", "", "the header lacks component of [stress]"),
    ],
)
def test_a_broken_file_is_refused_in_one_line(tmp_path, old, new, fragment):
    path = tmp_path / "field.txt"
    write_subsurf(path, example())
    text = path.read_text()
    assert text.count(old) >= 1
    path.write_text(text.replace(old, new, 1))
    with pytest.raises(InputError) as error:
        read_subsurf(path)
    message = str(error.value)
    assert message.startswith(f"{path}: ") and "allowed" in message and "\n" not in message
    assert fragment in message


def test_what_is_no_file_of_text_is_refused(tmp_path):
    (tmp_path / "bytes").write_bytes(b"\xff\xfe\x00")
    for name, fragment in (("none", "no regular file"), ("bytes", "not UTF-8"), (".", "regular")):
        with pytest.raises(InputError, match=fragment):
            read_subsurf(tmp_path / name)


@settings(max_examples=80, deadline=None)
@given(st.binary(max_size=200) | st.text(max_size=200).map(lambda text: text.encode()))
def test_anything_else_is_refused_as_input(tmp_path_factory, content):
    path = tmp_path_factory.mktemp("any") / "field.txt"
    path.write_bytes(content)
    with pytest.raises(InputError):
        read_subsurf(path)


@pytest.mark.parametrize(
    ("stress", "header", "fragment"),
    [
        (np.array([[np.nan]]), header_for((1, 1)), "finite"),
        (np.zeros((2, 3)), header_for((3, 2)), "layers and columns"),
        (np.zeros((1, 1)), header_for((1, 1), note="two\nlines"), "one line"),
        (np.zeros((1, 1)), header_for((1, 1), radius=np.inf), "finite"),
        (np.zeros((1, 1)), {"stress": header_for((1, 1))["stress"]}, "lacks contact"),
    ],
)
def test_what_could_not_be_read_again_is_not_written(tmp_path, stress, header, fragment):
    with pytest.raises(ValueError, match=fragment):
        write_subsurf(tmp_path / "field.txt", SubsurfFile(stress, header))
    assert list(tmp_path.iterdir()) == []


def test_files_of_a_run_hold_its_stresses_over_hertz(smooth_outcome, tmp_path):
    files = subsurf_files(smooth_outcome, columns=21, layers=11)
    assert set(files) == {"made-tau1-mu0.txt", "made-txz-mu0.txt"}
    hertz = smooth_outcome.problem.hertz
    for name, content in files.items():
        write_subsurf(tmp_path / name, content)
        found = read_subsurf(tmp_path / name)
        assert found.stress.shape == (11, 21)
        assert found.x[0] == pytest.approx(-1.25 * hertz.half_width)
        assert found.z[-1] == pytest.approx(hertz.half_width)
        exact = hertz_stress(hertz, found.x, found.z[:, None])
        expected = getattr(exact, "tau1" if "tau1" in name else "txz") / hertz.peak_pressure
        np.testing.assert_allclose(found.stress, expected, atol=2e-3)
        assert found.header["contact"]["peak_pressure"] == hertz.peak_pressure
        assert found.header["stress"]["friction"] == 0.0


def test_the_mesh_stands_centred_under_the_pressures(wavy_outcome):
    run = wavy_outcome.runs["half_plane"]
    beside = replace(run.finest, patches=np.array([[1e-4, 2e-4], [2.5e-4, 3e-4]]))
    moved = replace(run, levels=(*run.levels[:-1], beside))
    outcome = replace(wavy_outcome, runs={**wavy_outcome.runs, "half_plane": moved})
    content = next(iter(subsurf_files(outcome, columns=5, layers=3).values()))
    assert content.x.mean() == pytest.approx(2e-4)
    assert "sinusoid" in content.header["profile"]["file"]
