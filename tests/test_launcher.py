"""The launcher's promises, held with stand-ins for Debian's python, apt's programs and sudo.

Each test has a checkout of its own, in a folder with a space in its name, that holds the real
`crosscheck` with only the path of the interpreter exchanged. The stand-ins write what they were
asked for to a file `calls`; environment variables tell them how to behave.
"""

import os
import pty
import shutil
import signal
import subprocess
import tempfile
import time
from pathlib import Path
from types import SimpleNamespace

import pytest

from comparisons.output.page.pdf import BROWSERS

PROJECT = Path(__file__).resolve().parents[1]
NOBODY = 65534
SHARED = "-n auto --dist loadfile"
INSTALL = "apt-get install --yes --no-install-recommends"

PYTHON = r"""#!/bin/bash
echo "python $*" >>"$CALLS"
case "$1 ${2-}" in
    "-m venv")
        target=${@: -1}
        mkdir -p "$target/bin"
        touch "$target/pyvenv.cfg"
        cp "$0" "$target/bin/python"
        command=$target/bin/crosscheck
        printf '%s\n' '#!/bin/bash' 'printf "<%s>" "$@"' 'exit ${STATUS:-0}' >"$command"
        chmod +x "$command" ;;
    "-m pip")
        [ "$3" = list ] && printf '%s\n' numpy==1.24.2 rich==15.0 && exit
        for file in "$@"; do [ "${file##*/}" = constraints.txt ] && cat "$file" >>"$CALLS"; done
        echo "pip works" >>"$CALLS"
        sleep "${PIP_SECONDS:-0}"
        echo "${PIP_SAYS-}"
        exit "${PIP_STATUS:-0}" ;;
    "-m pytest") echo "threads=$OMP_NUM_THREADS folder=$PWD arguments=$*"; exit "${STATUS:-0}" ;;
    "-V "*) echo Python 3.12.3 ;;
    "-c import mpi4py"*) [ "${MISSING-}" != python3-dolfinx ] || [ -e "$INSTALLED" ] ;;
esac
"""
DPKG_QUERY = r"""#!/bin/bash
for name in "${@:4}"; do
    if [ "$name" != "${MISSING-}" ] || [ -e "$INSTALLED" ]; then echo installed
    else echo "dpkg-query: no packages found matching $name" >&2; fi
done
"""
APT_GET = r"""#!/bin/bash
echo "apt-get $*" >>"$CALLS"
if [ -n "${APT_LOCK-}" ] && mkdir "$APT_LOCK" 2>/dev/null; then
    echo "E: Unable to lock directory /var/lib/apt/lists/"
    exit 100
fi
if [ "$1" = install ]; then touch "$INSTALLED"; fi
"""
APT_CACHE = r"""#!/bin/bash
[ "$2" = "${UNLISTED-}" ] || echo "$2 | 1 | an archive"
"""
SUDO = r"""#!/bin/bash
[ "$1" = -n ] && shift
[ -n "${SUDO_WORKS-}" ] && exec "$@"
exit 1
"""


class Checkout:
    """A folder with the launcher in it, and how to call it."""

    def __init__(self, base: Path):
        self.base = base
        self.root = base / "check out"
        self.environment = self.root / ".venv"
        self.calls_file = base / "calls"
        tools = base / "tools"
        self.root.mkdir()
        tools.mkdir()
        for name, text in {
            "python3": PYTHON,
            "dpkg-query": DPKG_QUERY,
            "apt-get": APT_GET,
            "apt-cache": APT_CACHE,
            "uname": "#!/bin/bash\necho x86_64\n",
            "sudo": SUDO,
        }.items():
            (tools / name).write_text(text)
            (tools / name).chmod(0o755)
        source = (PROJECT / "crosscheck").read_text()
        line = "system_python=/usr/bin/python3\n"
        assert source.count(line) == 1
        self.script = self.root / "crosscheck"
        self.script.write_text(source.replace(line, f"system_python='{tools}/python3'\n"))
        self.script.chmod(0o755)
        shutil.copy(PROJECT / "pyproject.toml", self.root)
        self.calls_file.touch()
        self.variables = {
            "PATH": f"{tools}:{os.environ['PATH']}",
            "HOME": str(base),
            "CALLS": str(self.calls_file),
            "INSTALLED": str(base / "installed"),
        }

    def start(self, *arguments, script=None, before=(), **variables) -> subprocess.Popen:
        options = {key: variables.pop(key) for key in ("cwd", "stderr") if key in variables}
        return subprocess.Popen(
            [*before, str(script or self.script), *arguments],
            env=self.variables | variables,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            text=True,
            start_new_session=True,
            **({"stderr": subprocess.PIPE, "cwd": self.base} | options),
        )

    def call(self, *arguments, **options) -> subprocess.CompletedProcess:
        process = self.start(*arguments, **options)
        out, err = process.communicate(timeout=60)
        return subprocess.CompletedProcess(process.args, process.returncode, out, err)

    def calls(self, beginning: str = "") -> list[str]:
        return [c for c in self.calls_file.read_text().splitlines() if c.startswith(beginning)]

    def set_ups(self) -> int:
        return len(self.calls("python -m venv"))


@pytest.fixture
def checkout():
    with tempfile.TemporaryDirectory() as folder:
        base = Path(folder)
        base.chmod(0o755)
        yield Checkout(base)


def ordinary_user(checkout: Checkout) -> list[str]:
    """Words before a command so that it does not run as root."""
    if os.geteuid() != 0:
        return []
    for path in (checkout.base, *checkout.base.rglob("*")):
        os.chown(path, NOBODY, NOBODY)
    return ["setpriv", f"--reuid={NOBODY}", f"--regid={NOBODY}", "--clear-groups"]


def test_first_call_sets_up_and_later_calls_only_run(checkout):
    first = checkout.call("run", "hertz")
    assert (first.returncode, first.stdout, first.stderr) == (0, "<run><hertz>", "")
    assert checkout.set_ups() == 1
    seen = checkout.calls()
    second = checkout.call("run", "hertz")
    assert (second.returncode, second.stdout, second.stderr) == (0, "<run><hertz>", "")
    assert checkout.calls() == seen


def test_arguments_and_exit_status_pass_unchanged(checkout):
    awkward = ["a b", "", "*", "--x=$HOME", "test"]
    done = checkout.call(*awkward, STATUS="3")
    assert done.returncode == 3
    assert done.stdout == "".join(f"<{a}>" for a in awkward)


def test_debians_numpy_is_a_constraint_for_pip(checkout):
    checkout.call()
    assert "numpy==1.24.2" in checkout.calls()
    (pip,) = checkout.calls("python -m pip install")
    assert f"--constraint {checkout.environment}/constraints.txt" in pip
    assert pip.endswith(f"--editable {checkout.root}")


def test_works_through_a_link_and_from_another_folder(checkout):
    link = checkout.base / "link"
    link.symlink_to("check out/crosscheck")
    assert checkout.call("a", script=link, cwd="/").stdout == "<a>"
    assert (checkout.environment / "stamp").exists()
    assert checkout.call("b", script="./crosscheck", cwd=checkout.root).stdout == "<b>"
    assert checkout.set_ups() == 1


def test_threads_and_packages_at_home_are_the_users(checkout):
    checkout.call()
    command = checkout.environment / "bin" / "crosscheck"
    command.write_text('#!/bin/bash\necho "${OMP_NUM_THREADS-unset} $PYTHONNOUSERSITE"\n')
    assert checkout.call().stdout == "unset 1\n"
    assert checkout.call(OMP_NUM_THREADS="7").stdout == "7 1\n"


def test_test_command_runs_pytest_in_the_checkout_on_one_thread(checkout):
    done = checkout.call("test", "-k", "a b", OMP_NUM_THREADS="7", STATUS="5", cwd="/")
    assert done.returncode == 5
    expected = f"threads=1 folder={checkout.root} arguments=-m pytest {SHARED} -k a b\n"
    assert done.stdout == expected


def test_first_test_adds_what_only_the_tests_need_once(checkout):
    checkout.call()
    for _ in range(2):
        assert checkout.call("test").returncode == 0
    installs = checkout.calls("python -m pip install")
    assert [i.rpartition(" ")[2] for i in installs] == ["out", "out[test]"]
    assert checkout.set_ups() == 1


@pytest.mark.parametrize("sudo", ["", "yes"])
def test_programs_come_where_installing_is_allowed_and_stop_nothing(checkout, sudo):
    user = ordinary_user(checkout)
    tools = f"{checkout.base}/tools:/usr/bin:/bin"
    browser = any(shutil.which(name, path=tools) for name in BROWSERS)
    missing = ["chromium"] * (not browser)
    missing += ["calculix-ccx"] * (shutil.which("ccx", path=tools) is None)
    done = checkout.call("test", before=user, SUDO_WORKS=sudo, PATH=tools)
    assert done.returncode == 0 and done.stdout.startswith("threads=1")
    expected = [call for name in missing for call in ("apt-get update", f"{INSTALL} {name}")]
    allowed = sudo or not user
    assert checkout.calls("apt-get") == (expected if allowed else [])


@pytest.mark.parametrize(
    ("arguments", "shared"),
    [
        ({"args": ["tests", "tests/fem"]}, True),
        ({"args": ["tests", "pyproject.toml::TestThis::test_that[a-b]"]}, False),
        ({"capture": "no"}, False),
        ({"trace": True}, False),
    ],
)
def test_named_files_and_tests_at_a_terminal_stay_in_one_process(
    pytestconfig, monkeypatch, arguments, shared
):
    monkeypatch.setattr("os.sched_getaffinity", lambda process: range(2))
    option = SimpleNamespace(**{"args": [], "capture": "fd", "trace": False} | arguments)
    config = SimpleNamespace(args=option.args, option=option)
    count = pytestconfig.hook.pytest_xdist_auto_num_workers(config=config)
    assert (count > 0) == shared


def test_continuous_integration_runs_the_test_command(checkout):
    shutil.copytree(PROJECT / ".ci", checkout.root / ".ci")
    done = checkout.call(script=checkout.root / ".ci" / "run", STATUS="5", cwd="/")
    assert done.returncode == 5
    assert done.stdout == f"threads=1 folder={checkout.root} arguments=-m pytest {SHARED}\n"


def test_changed_dependencies_set_up_again_and_tool_settings_do_not(checkout):
    checkout.call()
    project = checkout.root / "pyproject.toml"
    text = project.read_text()
    project.write_text(text.replace("[tool.ruff]\n", "[tool.ruff]\npreview = true\n"))
    checkout.call()
    assert checkout.set_ups() == 1
    assert '"rich' in text
    project.write_text(text.replace('"rich', '"seaborn",\n    "rich'))
    checkout.call()
    assert checkout.set_ups() == 2
    project.write_text(text.replace("force-include = {", "force-include = {a = 'b', "))
    checkout.call()
    assert checkout.set_ups() == 3


def test_moved_checkout_sets_up_again(checkout):
    checkout.call()
    checkout.root = checkout.root.rename(checkout.base / "elsewhere")
    assert checkout.call("a", script=checkout.root / "crosscheck").stdout == "<a>"
    assert checkout.set_ups() == 2


def test_two_first_calls_at_once_set_up_once(checkout):
    both = [checkout.start(name, PIP_SECONDS="0.5") for name in ("a", "b")]
    assert [p.communicate(timeout=60)[0] for p in both] == ["<a>", "<b>"]
    assert checkout.set_ups() == 1


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_interrupted_set_up_starts_afresh(checkout, number):
    process = checkout.start(PIP_SECONDS="30")
    deadline = time.monotonic() + 30
    while not checkout.calls("pip works"):
        assert time.monotonic() < deadline
        time.sleep(0.01)
    (checkout.environment / "half").touch()
    os.killpg(process.pid, number)
    process.communicate(timeout=60)
    assert process.returncode != 0
    assert not (checkout.environment / "stamp").exists()
    assert checkout.call("a").stdout == "<a>"
    assert not (checkout.environment / "half").exists()


def test_failed_pip_shows_what_it_said_last(checkout):
    failed = checkout.call(PIP_STATUS="1", PIP_SAYS="ERROR: no wheel for you")
    assert failed.returncode == 2
    assert "ERROR: no wheel for you\n" in failed.stderr
    assert str(checkout.environment / "setup.log") in failed.stderr
    assert checkout.call("a").stdout == "<a>"


def test_progress_goes_to_a_terminal_only(checkout):
    ours, theirs = pty.openpty()
    process = checkout.start("a", stderr=theirs)
    os.close(theirs)
    assert process.communicate(timeout=60)[0] == "<a>"
    said = os.read(ours, 10000).decode().splitlines()
    os.close(ours)
    assert 3 <= len(said) <= 5
    assert all(line.startswith("crosscheck: ") for line in said)
    assert said[-1] == "crosscheck: ready"


def test_an_environment_of_somebody_elses_is_left_alone(checkout):
    checkout.environment.mkdir()
    (checkout.environment / "pyvenv.cfg").touch()
    cache = checkout.base / "cache"
    assert checkout.call("a", XDG_CACHE_HOME=str(cache)).stdout == "<a>"
    assert os.listdir(checkout.environment) == ["pyvenv.cfg"]
    assert len(list(cache.glob("crosscheck/*/stamp"))) == 1
    checkout.call("a", XDG_CACHE_HOME=str(cache))
    assert checkout.set_ups() == 1


def test_checkout_that_cannot_be_written_uses_the_cache_folder(checkout):
    user = ordinary_user(checkout)
    checkout.root.chmod(0o555)
    assert checkout.call("a", before=user).stdout == "<a>"
    assert not checkout.environment.exists()
    assert len(list(checkout.base.glob(".cache/crosscheck/*/stamp"))) == 1


def test_ordinary_user_without_sudo_is_told_the_line_to_type(checkout):
    user = ordinary_user(checkout)
    done = checkout.call("a", before=user, MISSING="python3-dolfinx")
    assert (done.returncode, done.stdout) == (2, "")
    assert f"sudo sh -c 'apt-get update && {INSTALL} python3-dolfinx python3-venv" in done.stderr
    assert checkout.calls("apt-get") == []
    assert checkout.set_ups() == 0


@pytest.mark.parametrize("sudo", ["", "yes"])
def test_a_system_without_a_package_of_dolfinx_has_a_line_for_its_wheel(checkout, sudo):
    user = ordinary_user(checkout)
    unlisted = {"MISSING": "python3-dolfinx", "UNLISTED": "python3-dolfinx"}
    done = checkout.call("a", before=user, SUDO_WORKS=sudo, **unlisted)
    assert (done.returncode, done.stdout, checkout.set_ups()) == (2, "", 0)
    reason, way = done.stderr.splitlines()
    assert "has no package of dolfinx" in reason
    assert f"sudo sh -c 'apt-get update && {INSTALL} gcc python3-dev python3-venv" in way
    assert "/pip install dolfinx-solver-real && CROSSCHECK_PYTHON=" in way
    assert checkout.calls("apt-get") == ["apt-get update"] * bool(sudo)


def test_ordinary_user_with_sudo_has_what_is_missing_installed_when_no_other_apt_get_runs(checkout):
    nap = checkout.base / "tools" / "sleep"
    nap.write_text('#!/bin/bash\necho "sleep $*" >>"$CALLS"\n')
    nap.chmod(0o755)
    user = ordinary_user(checkout)
    lock = str(checkout.base / "lock")
    done = checkout.call("a", before=user, MISSING="libgl1", SUDO_WORKS="yes", APT_LOCK=lock)
    assert (done.returncode, done.stdout) == (0, "<a>")
    words = [c.split()[0] for c in checkout.calls() if c.startswith(("apt-get", "sleep 5"))]
    assert words == ["apt-get", "sleep", "apt-get", "apt-get"]
    again, install = checkout.calls("apt-get")[1:]
    assert again == "apt-get update"
    assert install.startswith(INSTALL) and " libgl1 " in install


def another_python(checkout: Checkout, prefix: str, imports: bool) -> Path:
    """One of an environment, that imports dolfinx or does not."""
    python = checkout.base / prefix / "bin" / "python"
    python.parent.mkdir(parents=True)
    missing = "" if imports else 'echo "No module named dolfinx" >&2; exit 1'
    case = f'"-c import mpi4py"*) {missing} ;;'
    text = "\n".join(line for line in PYTHON.splitlines() if "-c import mpi4py" not in line)
    python.write_text(text.replace("esac", f"{case}\nesac").replace("python $*", f"{prefix} $*"))
    python.chmod(0o755)
    return python


def test_the_first_python_that_imports_dolfinx_is_taken(checkout):
    bare = another_python(checkout, "bare", imports=False)
    conda = another_python(checkout, "conda", imports=True)
    prefixes = {"CONDA_PREFIX": str(conda.parents[1]), "VIRTUAL_ENV": str(bare.parents[1])}
    done = checkout.call("a", MISSING="python3-dolfinx", **prefixes)
    assert (done.returncode, done.stdout) == (0, "<a>")
    assert len(checkout.calls("conda -m venv")) == 1 and not checkout.calls("apt-get")
    # what is set up stays as long as its Python is there, active or not
    assert checkout.call("b").stdout == "<b>"
    assert len(checkout.calls("conda -m venv")) == 1 and checkout.set_ups() == 0
    # a Python that is named is taken, whatever else is active
    named = str(another_python(checkout, "named", imports=True))
    assert checkout.call("c", CROSSCHECK_PYTHON=named, **prefixes).stdout == "<c>"
    assert len(checkout.calls("named -m venv")) == 1


def test_a_named_python_without_dolfinx_is_told_in_one_line(checkout):
    bare = str(another_python(checkout, "bare", imports=False))
    done = checkout.call("a", CROSSCHECK_PYTHON=bare)
    assert (done.returncode, done.stdout) == (2, "")
    reason, remedy = done.stderr.splitlines()
    assert reason == f"crosscheck: {bare} cannot be used: No module named dolfinx"
    assert "conda env create --file environment.yml" in remedy


def test_dolfinx_from_elsewhere_needs_no_package(checkout):
    python = checkout.base / "tools" / "python3"
    python.write_text(python.read_text().replace("!= python3-dolfinx", "!= none"))
    done = checkout.call("a", MISSING="python3-dolfinx")
    assert (done.returncode, done.stdout) == (0, "<a>")
    assert checkout.calls("apt-get") == []
