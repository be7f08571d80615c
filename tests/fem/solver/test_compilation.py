"""The just-in-time compiler: silent when cold, idle once it has run, unharmed by a stop."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from scenes import PROJECT, python

from fem.solver.compilation import (
    STALE_SECONDS,
    c_function,
    compiled,
    remove_leftovers,
    uninterrupted,
)
from fem.solver.mumps import FemError

SCRIPT = """
import sys
import numpy as np
from analytic.material import Material
from fem.body.elasticity import Support, elastic_body
from meshes.block import BlockMesh, BlockSpec, add_midpoints

vertices = np.array([[-1.0, 0.0], [0.0, 0.0], [1.0, 0.0], [-1.0, 1.0], [0.0, 1.0], [1.0, 1.0]])
corners = np.array([[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]])
points, triangles = add_midpoints(vertices, corners)
spec = BlockSpec(1.0, 1.0, np.array([[-1.0, 1.0]]), 1.0)
material = Material(1.0, float(sys.argv[1]))
shifts = 0.0 * points, 0.1 * (1.0 - points[:, 1:]) * [0.0, 1.0]
for shift in shifts[: int(sys.argv[2])]:
    body = elastic_body(BlockMesh(points, triangles, shift, spec), material, Support())
    assert np.isfinite(body.solve(np.ones_like(points))).all()
"""


def start(cache, poissons_ratio=0.3, bodies=1) -> subprocess.Popen:
    """Compiles the form of a body with straight edges, and of one with curved ones."""
    environment = os.environ | {"XDG_CACHE_HOME": str(cache), "PYTHONPATH": str(PROJECT)}
    return subprocess.Popen(
        [sys.executable, "-c", SCRIPT, str(poissons_ratio), str(bodies)],
        env=environment,
        cwd=PROJECT,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


def run(cache, poissons_ratio=0.3, bodies=1):
    process = start(cache, poissons_ratio, bodies)
    output, complaint = process.communicate()
    assert process.returncode == 0, complaint
    return output + complaint


def test_a_cold_compile_is_silent_and_serves_later_processes(tmp_path):
    """Later processes may have bodies of other materials."""
    assert run(tmp_path, bodies=2) == ""
    compiled = {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*.so")}
    assert compiled
    assert run(tmp_path, 0.25, bodies=2) == ""
    assert {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*.so")} == compiled


def unmarked(cache) -> list[Path]:
    """Sources that are being compiled, or left over."""
    sources = cache.rglob("libffcx_*.c")
    return [source for source in sources if not source.with_suffix(".c.cached").exists()]


def wait_for_a_source(cache) -> None:
    deadline = time.monotonic() + 60.0
    while not unmarked(cache):
        assert time.monotonic() < deadline
        time.sleep(0.01)


def test_an_interrupt_lets_the_compiler_end(tmp_path):
    """Ctrl-C in a terminal: the compiler gets it too."""
    process = start(tmp_path)
    wait_for_a_source(tmp_path)
    os.killpg(process.pid, signal.SIGINT)
    _, complaint = process.communicate(timeout=60)
    assert complaint.endswith("KeyboardInterrupt\n")
    assert process.returncode == -signal.SIGINT
    assert unmarked(tmp_path) == []
    assert run(tmp_path) == ""


def test_what_a_killed_process_left_is_cleared_away(tmp_path):
    process = start(tmp_path)
    wait_for_a_source(tmp_path)
    os.killpg(process.pid, signal.SIGKILL)
    process.communicate(timeout=60)
    left = unmarked(tmp_path)
    assert left
    for source in left:
        os.utime(source, (time.time() - 2.0 * STALE_SECONDS,) * 2)
    assert run(tmp_path) == ""
    assert unmarked(tmp_path) == []


def test_work_in_progress_and_finished_work_are_left_alone(tmp_path):
    for name, age in (("young", 0.5), ("ready", 2.0), ("old", 2.0)):
        source = tmp_path / f"libffcx_forms_{name}.c"
        source.touch()
        os.utime(source, (time.time() - age * STALE_SECONDS,) * 2)
    (tmp_path / "libffcx_forms_ready.c.cached").touch()
    remove_leftovers(tmp_path)
    assert {path.stem for path in tmp_path.glob("*.c")} == {
        "libffcx_forms_young",
        "libffcx_forms_ready",
    }


def test_an_interrupt_is_held_back_and_then_comes():
    done = []
    with pytest.raises(KeyboardInterrupt), uninterrupted():
        signal.raise_signal(signal.SIGINT)
        done.append("all")
    assert done == ["all"]
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    assert signal.SIGINT not in signal.pthread_sigmask(signal.SIG_BLOCK, ())


def test_another_process_at_the_same_form_is_waited_for(monkeypatch, tmp_path):
    monkeypatch.setattr("fem.compat.form_cache", lambda: tmp_path)
    busy = [True, True, False]

    def make():
        if busy.pop(0):
            raise TimeoutError("not ready after 10 s")
        return "form"

    assert compiled(make) == "form"
    stale = tmp_path / "libffcx_forms_stale.c"
    stale.touch()
    os.utime(stale, (time.time() - 2.0 * STALE_SECONDS,) * 2)
    assert compiled(lambda: "another") == "another"
    assert stale.exists()  # no process has waited for it
    busy[:] = [True, False]
    assert compiled(make) == "form"
    assert not stale.exists()
    busy[:] = [True] * 100
    with pytest.raises(TimeoutError):
        compiled(make)
    assert 10.0 * (100 - len(busy)) > STALE_SECONDS


def test_pkg_resources_is_not_loaded_for_a_version_alone():
    """But is itself where something else of it is wanted."""
    pytest.importorskip("pkg_resources")
    quick = "with compat.quick_versions():\n    import pkg_resources"
    script = f"""
import sys, numpy
from fem import compat
{quick}
assert pkg_resources.get_distribution("numpy").version == numpy.__version__
assert "pkg_resources" not in sys.modules
{quick}
assert pkg_resources.parse_version("1.10") > pkg_resources.parse_version("1.9")
import pkg_resources
print(hasattr(pkg_resources, "WorkingSet"))
"""
    process = python("-W", "ignore", "-c", script)
    assert process.stdout == "True\n", process.stderr


@pytest.fixture
def cache(monkeypatch, tmp_path):
    """An empty cache of compiled code, and none in this process."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    c_function.cache_clear()
    yield tmp_path / "fenics"
    c_function.cache_clear()


def test_c_is_compiled_once_and_again_where_it_changes(cache, tmp_path, capfd):
    source, scaled = tmp_path / "scale.c", []
    code = "void scale(long n, double by, double *x) {{ for (long i = 0; i < n; i++) x[i] *= {}; }}"
    for text, ready in (("by", 1), ("by", 1), ("by * by", 2)):
        source.write_text(code.format(text))
        c_function.cache_clear()
        x = np.array([1.0, 2.0])
        c_function(source, "scale")(2, 3.0, x)
        scaled.append(list(x))
        assert len(list(cache.iterdir())) == ready  # nothing else is left there
    assert scaled == [[3.0, 6.0], [3.0, 6.0], [9.0, 18.0]]
    assert capfd.readouterr() == ("", "")


def test_c_that_does_not_compile_is_said_and_leaves_nothing(cache, tmp_path):
    source = tmp_path / "wrong.c"
    source.write_text("void wrong(long n) { return missing; }")
    with pytest.raises(FemError, match=r"wrong\.c does not compile"):
        c_function(source, "wrong")
    assert not list(cache.iterdir())
