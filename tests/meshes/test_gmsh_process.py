"""Failures around the gmsh process: crashes, time-outs, orphans."""

import os
import signal
import subprocess
import sys
import textwrap
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scenes import PROJECT

from meshes import build
from meshes.block import BlockSpec, MeshError
from tests.harness import mesh_seconds

SPEC = BlockSpec(20.0, 40.0, np.array([[-1.0, 1.0]]), 0.1)


def worker(monkeypatch, code):
    monkeypatch.setattr(build, "WORKER", (sys.executable, "-c", textwrap.dedent(code)))


@pytest.mark.parametrize(
    ("code", "words"),
    [
        ("import os, signal; os.kill(os.getpid(), signal.SIGSEGV)", "gmsh crashed .SIGSEGV."),
        ("import sys; print('first'); print('bad curve', file=sys.stderr); sys.exit(1)",
         "gmsh failed: bad curve"),
        ("import sys; sys.stdin.close(); sys.exit(1)", "gmsh failed: it said nothing"),
        ("print('half a mesh')", "gmsh failed: it said nothing"),
    ],
)  # fmt: skip
def test_each_failure_is_one_clear_error(monkeypatch, code, words):
    worker(monkeypatch, code)
    with pytest.raises(MeshError, match=words) as caught:
        build.build_block(SPEC)
    assert "\n" not in str(caught.value)


def test_a_killed_process_is_no_wrong_input(monkeypatch, tmp_path):
    """A mesh is tried once more; then the error says what the system does."""
    code = f"""
        import os
        with open({str(tmp_path / "n")!r}, "a") as starts:
            starts.write("k")
        os.kill(os.getpid(), 9)
    """
    worker(monkeypatch, code)
    with pytest.raises(MemoryError, match="gmsh was killed"):
        build.build_block(SPEC)
    assert (tmp_path / "n").read_text() == "kk"


def test_the_time_of_a_mesh_is_known_while_its_process_waits():
    """Then the system does not count it yet."""
    build.close_workers()
    build.build_block(SPEC)
    once = mesh_seconds()
    build.build_block(SPEC)
    assert 0.0 < once < mesh_seconds()
    build.close_workers()
    assert mesh_seconds() == 0.0


def test_time_out_stops_the_process(monkeypatch):
    worker(monkeypatch, "import time; time.sleep(60)")
    build.start_worker()
    process = build.idle[-1].process
    monkeypatch.setattr(build, "TIMEOUT", 0.2)
    with pytest.raises(MeshError, match=r"not done after 0.2 s"):
        build.build_block(SPEC)
    assert process.returncode == -signal.SIGKILL


def test_a_hole_in_the_mesh_is_refused(monkeypatch):
    def holed(task):
        vertices, triangles = run_worker(task)
        return vertices, triangles[:-1]

    run_worker = build.run_worker
    monkeypatch.setattr(build, "run_worker", holed)
    with pytest.raises(MeshError, match=r"triangles cover 0\.99"):
        build.build_block(SPEC)


def process_id():
    (waiting,) = build.idle
    return waiting.process.pid


def test_one_process_makes_all_meshes_alike():
    build.close_workers()
    first = build.build_block(SPEC)
    served = process_id()
    other = build.build_block(replace(SPEC, depth=30.0))
    again = build.build_block(SPEC)
    assert process_id() == served
    assert len(other.points) != len(first.points)
    np.testing.assert_array_equal(again.points, first.points)
    np.testing.assert_array_equal(again.triangles, first.triangles)


def test_another_process_follows_one_that_failed_or_was_killed(monkeypatch):
    first = build.build_block(SPEC)
    served = process_id()
    outline = build.outline
    with monkeypatch.context() as patch:
        patch.setattr(build, "outline", lambda *_: replace(outline(SPEC), regions=((1, 2, 3),)))
        with pytest.raises(MeshError, match=r"gmsh failed: .+"):
            build.build_block(SPEC)
    assert not build.idle
    build.build_block(SPEC)
    assert process_id() != served
    os.kill(process_id(), signal.SIGKILL)
    build.idle[0].process.wait()
    np.testing.assert_array_equal(build.build_block(SPEC).points, first.points)


def test_a_forked_process_starts_its_own():
    build.build_block(SPEC)
    served = process_id()
    child = os.fork()
    if child == 0:
        status = 1
        try:
            build.build_block(SPEC)
            status = int(process_id() == served)
        finally:
            os._exit(status)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
    build.build_block(SPEC)
    assert process_id() == served


def test_launchers_of_parallel_runs_are_hidden_from_gmsh(monkeypatch):
    monkeypatch.setenv("OMPI_COMM_WORLD_SIZE", "4")
    monkeypatch.setenv("PMIX_RANK", "1")
    worker(
        monkeypatch,
        """
        import os, sys
        names = sorted(n for n in os.environ if n.startswith(("OMPI_", "PMI")))
        sys.exit("saw " + " ".join(names))
        """,
    )
    with pytest.raises(MeshError, match=r"gmsh failed: saw$"):
        build.build_block(SPEC)


def alive(pid):
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0]
    except (FileNotFoundError, ProcessLookupError):
        return False
    return state != "Z"


def children(pid):
    return [int(p) for p in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_no_orphan_is_left_however_the_caller_ends(how):
    caller = subprocess.Popen(
        [
            sys.executable,
            "-c",
            "import numpy as np\n"
            "from meshes.block import BlockSpec\n"
            "from meshes.build import build_block\n"
            "build_block(BlockSpec(2e5, 4e5, np.array([[-9e4, 9e4]]), 1.0, 0.05))\n",
        ],
        cwd=PROJECT,
        stderr=subprocess.DEVNULL,
    )
    try:
        deadline = time.monotonic() + 20.0
        while not (processes := children(caller.pid)) and time.monotonic() < deadline:
            time.sleep(0.02)
        (gmsh,) = processes
        while b"libgmsh" not in Path(f"/proc/{gmsh}/maps").read_bytes():
            time.sleep(0.02)
        os.kill(caller.pid, how)
        caller.wait(timeout=10.0)
        while alive(gmsh) and time.monotonic() < deadline:
            time.sleep(0.02)
        assert not alive(gmsh)
    finally:
        caller.kill()
        caller.wait()
