"""Files that SurfaceTopography reads, and what is said where it cannot or is not there."""

import hashlib
import importlib.util
import json
import sys
import zipfile
from importlib import metadata

import numpy as np
import pytest
from text_profiles import refused

import analytic.surface.readers.child as child
import analytic.surface.readers.instruments as module
import analytic.surface.readers.source as source
from analytic.surface.readers.instruments import (
    AbsentReaderError,
    install_command,
    read_instrument_file,
)
from analytic.surface.readers.source import ProfileError

HAS_READER = importlib.util.find_spec("SurfaceTopography") is not None
needs_reader = pytest.mark.skipif(
    not HAS_READER, reason="SurfaceTopography is not installed: pip install crosscheck[surface]"
)
HEIGHTS = np.random.default_rng(6).standard_normal((5, 7)) * 1e-7
MAIN = """<?xml version="1.0" encoding="UTF-8"?>
<p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2"><Record1>
<Revision>ISO5436 - 2000</Revision><FeatureType>{feature}</FeatureType><Axes>
<CX><AxisType>I</AxisType><DataType>D</DataType><Increment>1.5e-6</Increment><Offset>0</Offset></CX>
<CY><AxisType>I</AxisType><DataType>D</DataType><Increment>2.5e-6</Increment><Offset>0</Offset></CY>
<CZ><AxisType>A</AxisType><DataType>D</DataType><Increment>1</Increment><Offset>0</Offset></CZ>
</Axes></Record1><Record3><MatrixDimension><SizeX>{columns}</SizeX><SizeY>{rows}</SizeY>
<SizeZ>1</SizeZ></MatrixDimension><DataLink><PointDataLink>bindata/data.bin</PointDataLink>
<MD5ChecksumPointData>{checksum}</MD5ChecksumPointData></DataLink></Record3>
<Record4><ChecksumFile>md5checksum.hex</ChecksumFile></Record4></p:ISO5436_2>
"""


def write_x3p(path, heights: np.ndarray) -> None:
    """A map (rows, columns) [m] in the format of ISO 25178-72, NaN where it is undefined."""
    data = heights.astype("<f8").tobytes()
    main = MAIN.format(
        feature="SUR",
        columns=heights.shape[1],
        rows=heights.shape[0],
        checksum=hashlib.md5(data).hexdigest(),
    ).encode()
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("main.xml", main)
        archive.writestr("bindata/data.bin", data)
        archive.writestr("md5checksum.hex", f"{hashlib.md5(main).hexdigest()} *main.xml")


@needs_reader
def test_x3p(tmp_path):
    heights = HEIGHTS.copy()
    heights[3, 2] = np.nan
    write_x3p(tmp_path / "map.x3p", heights)
    field = read_instrument_file(tmp_path / "map.x3p")
    assert field.is_map
    np.testing.assert_allclose(field.heights, heights, rtol=1e-14)
    np.testing.assert_allclose(field.pitch, (1.5e-6, 2.5e-6), rtol=1e-14)
    assert field.unit == 1.0
    assert field.format.startswith("x3p, by SurfaceTopography ")


@needs_reader
@pytest.mark.usefixtures("one_reader")
def test_the_sizes_of_an_mi_file_are_in_metres(tmp_path):
    """The library names the unit of its heights for both: 20 um would be 20 pm long."""
    head = {"fileType": "Image", "xPixels": 8, "yPixels": 8, "xLength": 2e-5, "yLength": 4e-5}
    head |= {"scanUp": "FALSE", "bufferLabel": "Topography", "bufferUnit": "um", "bufferRange": 2.0}
    lines = "".join(f"{name:14}{value}\n" for name, value in head.items())
    counts = np.arange(64, dtype="<i2").reshape(8, 8)
    (tmp_path / "a.mi").write_bytes(f"{lines}data          BINARY\n".encode() + counts.tobytes())
    field = read_instrument_file(tmp_path / "a.mi")
    assert field.format == f"mi, by SurfaceTopography {metadata.version('SurfaceTopography')}"
    assert field.pitch == pytest.approx((2.5e-6, 5e-6), rel=1e-12)
    assert np.ptp(field.heights) == pytest.approx(63 / 32768 * 2e-6, rel=1e-12)


@needs_reader
@pytest.mark.usefixtures("one_reader")
@pytest.mark.parametrize(
    ("content", "words"),
    [
        (bytes(range(1, 100)), "is of no format that is known; allowed is text of columns"),
        (b"\x00\x01" * 16, "is of no format that is known"),  # 4 x 4 heights of terrain
        (b"PK\x05\x06" + bytes(18), "is of no format"),
        (b"\x02\0\0\0\x01\0\0\0\0\0\0\0\xff\xff" * 80, "is of no format"),  # as mat begins
    ],
)
def test_unknown_files(tmp_path, content, words):
    (tmp_path / "file.bin").write_bytes(content)
    message = str(refused(tmp_path / "file.bin", read_instrument_file))
    assert words in message or "damaged" in message


@needs_reader
@pytest.mark.usefixtures("one_reader")
def test_a_truncated_file(tmp_path):
    write_x3p(tmp_path / "map.x3p", HEIGHTS)
    whole = (tmp_path / "map.x3p").read_bytes()
    (tmp_path / "map.x3p").write_bytes(whole[: len(whole) // 2])
    refused(tmp_path / "map.x3p", read_instrument_file)


def worker(monkeypatch, program: str) -> None:
    monkeypatch.setattr(module, "WORKER", ("-c", program))


def complaint(tmp_path) -> str:
    path = tmp_path / "map.opd"
    path.write_bytes(b"\x00")
    return str(refused(path, read_instrument_file))


def test_without_the_library_the_message_says_how_to_get_it(tmp_path, monkeypatch):
    hidden = "import runpy, sys; sys.modules['SurfaceTopography'] = None"
    worker(monkeypatch, f"{hidden}; runpy.run_path({module.WORKER[-1]!r}, run_name='__main__')")
    message = complaint(tmp_path)
    assert "which is not installed (import of SurfaceTopography" in message
    assert message.endswith(f"to install it: {install_command()}")
    with pytest.raises(AbsentReaderError):
        read_instrument_file(tmp_path / "map.opd")


@pytest.mark.parametrize(
    ("program", "said"),
    [
        ("import os; os.kill(os.getpid(), 11)", "crashes on it (SIGSEGV; it said nothing)"),
        ("raise MemoryError('no room')", "crashes on it: MemoryError: no room"),
        ("import time; time.sleep(60)", "SurfaceTopography has not read it within 2 s"),
    ],
)
def test_a_reader_that_crashes_or_hangs_is_a_message(tmp_path, monkeypatch, program, said):
    monkeypatch.setattr(child, "PATIENCE", 2.0)
    worker(monkeypatch, program)
    assert complaint(tmp_path).endswith(said)


ANSWER = """
import json, sys
import numpy as np
print("a reader's chatter")
np.savez(sys.argv[2], heights=np.array([1.0, 4.0, 9.0]), x=np.array([0.0, 2.0, 3.0]))
print(json.dumps({"format": "made", "version": "1", "pitch": None, "unit": %s, "unit_name": %r}))
"""


def test_an_uneven_scan_comes_in_metres(tmp_path, monkeypatch):
    worker(monkeypatch, ANSWER % (1e-6, "um"))
    (tmp_path / "scan").write_bytes(b"\x00")
    trace = read_instrument_file(tmp_path / "scan")
    np.testing.assert_allclose(trace.heights, [1e-6, 4e-6, 9e-6])
    np.testing.assert_allclose(trace.x, [0.0, 2e-6, 3e-6])
    assert (trace.pitch, trace.unit, trace.format) == (None, 1e-6, "made, by SurfaceTopography 1")


def test_a_channel_that_is_no_height_is_refused(tmp_path, monkeypatch):
    worker(monkeypatch, ANSWER % ("None", "V"))
    assert complaint(tmp_path).endswith("counts in 'V', which is no length; a profile has heights")


def test_an_archive_that_unpacks_to_too_much_is_not_unpacked(tmp_path, monkeypatch):
    monkeypatch.setattr(module, "_ask", lambda path, target: pytest.fail("unpacked"))
    monkeypatch.setattr(source, "MAX_UNPACKED", 10**6)
    path = tmp_path / "map.x3p"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("bindata/data.bin", bytes(2 * 10**6))
    assert path.stat().st_size < 10**4
    with pytest.raises(ProfileError, match=r"unpacks to 0\.002 GB; allowed are 0\.001 GB"):
        read_instrument_file(path)


def test_another_interpreter_may_have_a_newer_library(tmp_path, monkeypatch):
    python = tmp_path / "python"
    answer = {"format": "new", "version": "9", "pitch": [1, 1], "unit": 1e-6, "unit_name": "um"}
    (tmp_path / "worker.py").write_text(
        "import sys\nimport numpy\nnumpy.savez(sys.argv[2], heights=[1.0, 2.0])\n"
        f"print({json.dumps(json.dumps(answer))})\n"
    )
    lines = ["#!/bin/sh", "shift 2", f'exec {sys.executable} {tmp_path / "worker.py"} "$@"']
    python.write_text("\n".join(lines) + "\n")
    python.chmod(0o755)
    (tmp_path / "new.dat").write_bytes(b"\x00\x01")
    monkeypatch.setenv("CROSSCHECK_SURFACE_PYTHON", str(python))
    assert read_instrument_file(tmp_path / "new.dat").format == "new, by SurfaceTopography 9"
    monkeypatch.setenv("CROSSCHECK_SURFACE_PYTHON", str(tmp_path / "none"))
    with pytest.raises(ProfileError, match=r"none, which cannot be run \(No such file"):
        read_instrument_file(tmp_path / "new.dat")
