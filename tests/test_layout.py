"""Who may import whom, what is imported late, what lies at the top level, which names resolve.

    analytic  <-  meshes  <-  fem  <-  comparisons

`meshes` and `fem` use of `analytic` only its data types, so that the finite-element answer cannot
lean on the solutions that it checks. Inside a package each room of `ROOMS` imports only rooms to
its right, and no modules import each other in a circle, not even for type hints. Whatever is slow
to import, or may be absent, is imported inside the function that needs it.
"""

import ast
import fnmatch
import importlib.metadata
import os
import pkgutil
import re
import shutil
import subprocess
import tomllib
from functools import cache
from graphlib import TopologicalSorter
from pathlib import Path

import pytest
from scenes import PROJECT, python

DATA_TYPES = {"analytic.material", "analytic.stress_state", "analytic.profile"}
# What each package may import of ours: whole packages, or single modules.
MAY_IMPORT = {
    "analytic": {"analytic"},
    "meshes": {"meshes"} | DATA_TYPES,
    "fem": {"fem", "meshes"} | DATA_TYPES,
    "comparisons": {"comparisons", "fem", "meshes", "analytic"},
}
# Rooms of a package, folders or modules at its root: each may import those to its right.
ROOMS = {
    "analytic": "running_in exact heat layers statistics contact stress operators surface "
    "grid profile stress_state material numerics",
    "fem": "heat nonlinear contact compliance stress body solver compat",
    "comparisons": "cli commands examples api campaigns grid runs output studies judging drawing "
    "models scenes figures common",
}
MOST_ENTRIES = 16  # of a folder
# scipy.signal with its scipy.stats takes a sixth of a second
HEAVY = "basix dolfinx ffcx gmsh matplotlib meshio mpi4py petsc4py pyvista ufl vtk vtkmodules"
HEAVY = {*HEAVY.split(), "scipy.signal"}
AT_TOP = {"README.md", "CITATION.cff", "crosscheck", "environment.yml", "pyproject.toml", "tests"}
AT_TOP |= set(MAY_IMPORT)
MODULES = sorted(path for package in MAY_IMPORT for path in (PROJECT / package).rglob("*.py"))


def dotted_name(path: Path) -> str:
    parts = path.relative_to(PROJECT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def imported(tree: ast.AST, package: str):
    """Names that a module in `package` imports; `from a import b` counts as `a.b`."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            above = package.split(".")[: len(package.split(".")) + 1 - node.level]
            origin = ".".join([*(above if node.level else []), *filter(None, [node.module])])
            yield from (f"{origin}.{alias.name}" for alias in node.names)
        elif (
            isinstance(node, ast.Call)
            and ast.unparse(node.func).split(".")[-1] in ("import_module", "__import__")
            and node.args
            and isinstance(node.args[0], ast.Constant)
        ):
            yield str(node.args[0].value)


def is_within(name: str, allowed: set[str]) -> bool:
    return any(name == a or name.startswith(f"{a}.") for a in allowed)


def forbidden(source: str, package: str) -> list[str]:
    """Imports against the arrows in a module that lies in `package`."""
    return [
        name
        for name in imported(ast.parse(source), package)
        if is_within(name, set(MAY_IMPORT))
        and not is_within(name, MAY_IMPORT[package.split(".")[0]])
    ]


def package_of(path: Path) -> str:
    return dotted_name(path.parent / "__init__.py")


def test_imports_follow_the_arrows():
    against = {str(path): forbidden(path.read_text(), package_of(path)) for path in MODULES}
    assert {path: names for path, names in against.items() if names} == {}


def imports_of_ours(path: Path) -> set[str]:
    """Modules of the project that a module imports: early, late, or for type hints alone."""
    names = set()
    for name in imported(ast.parse(path.read_text()), package_of(path)):
        while name and name not in BY_NAME:
            name = name.rpartition(".")[0]
        names |= {name} - {""}
    return names - {dotted_name(path)}


def room(name: str) -> tuple[str, str]:
    package, _, rest = name.partition(".")
    return package, rest.split(".")[0]


def against_the_order(name: str, other: str) -> bool:
    (package, here), (others, there) = room(name), room(other)
    order = ROOMS.get(package, "").split() if package == others else ()
    return here in order and there in order and order.index(there) < order.index(here)


BY_NAME = {dotted_name(path): path for path in MODULES}


@cache
def graph() -> dict[str, set[str]]:
    """Imports of ours by each module."""
    return {name: imports_of_ours(path) for name, path in BY_NAME.items()}


def test_no_import_runs_against_the_order():
    assert [f"{a} -> {b}" for a in graph() for b in graph()[a] if against_the_order(a, b)] == []


def test_every_room_has_its_place_in_the_order():
    for package, order in ROOMS.items():
        inside = {room(name)[1] for name in graph() if name.startswith(f"{package}.")}
        assert inside == set(order.split())


def test_no_modules_import_each_other():
    tuple(TopologicalSorter(graph()).static_order())


def test_tests_of_fem_need_nothing_of_comparisons():
    sources = [path.read_text() for path in (PROJECT / "tests/fem").rglob("*.py")]
    names = [name for source in sources for name in imported(ast.parse(source), "tests.fem")]
    assert [name for name in names if is_within(name, {"comparisons"})] == []


@pytest.mark.parametrize("folder", sorted({path.parent for path in MODULES}), ids=str)
def test_a_folder_is_read_at_a_glance(folder):
    names = {p.name for p in folder.iterdir() if not p.name.startswith((".", "__pycache__"))}
    names -= {"__init__.py", "py.typed"}
    assert len(names) <= MOST_ENTRIES
    heads = [name.split("_")[0] for name in names if name.endswith(".py") and "_" in name[1:]]
    heads = [head for head in heads if head]
    assert [head for head in set(heads) if heads.count(head) > 2] == []


def resolves(name: str) -> bool:
    """True for the dotted name of a folder, a module, or what stands in one."""
    if (PROJECT / name.replace(".", "/")).is_dir():
        return True
    try:
        return pkgutil.resolve_name(name) is not None
    except (ImportError, AttributeError):
        return False


def test_names_of_modules_in_words_resolve():
    """Names in docstrings, comments and pages; `package.module` or `package.module.name`."""
    sources = [
        *MODULES,
        *(PROJECT / "tests").rglob("*.py"),
        *PROJECT.rglob("comparisons/docs/*.md"),
    ]
    pattern = re.compile(rf"`((?:{'|'.join(MAY_IMPORT)})(?:\.\w+)+)`")
    named = {
        (str(path.relative_to(PROJECT)), name)
        for path in sources
        for name in pattern.findall(path.read_text())
    }
    assert [(path, name) for path, name in sorted(named) if not resolves(name)] == []
    assert len(named) > 50


def test_a_class_has_its_name_to_itself():
    """A reader who looks for a class finds one in the project."""
    where: dict[str, list[str]] = {}
    for name, path in BY_NAME.items():
        for node in ast.parse(path.read_text()).body:
            if isinstance(node, ast.ClassDef):
                where.setdefault(node.name, []).append(name)
    assert {name: places for name, places in where.items() if len(places) > 1} == {}


def test_importing_every_module_loads_nothing_heavy():
    """Also by way of somebody else's module."""
    names = [dotted_name(path) for path in MODULES if path.stem != "__main__"]
    code = f"import importlib, sys\nfor n in {names!r}: importlib.import_module(n)\n"
    done = python("-c", f"{code}print(*set(sys.modules) & {HEAVY!r})")
    assert (done.returncode, done.stdout.strip()) == (0, ""), done.stderr


def project_table() -> dict:
    return tomllib.loads((PROJECT / "pyproject.toml").read_text())


def test_packages_are_the_folders_with_python_in_them():
    listed = project_table()["tool"]["hatch"]["build"]["targets"]["wheel"]["packages"]
    folders = {path.name for path in PROJECT.iterdir() if (path / "__init__.py").exists()}
    assert set(listed) == folders == set(MAY_IMPORT)


def test_command_leads_to_the_function_that_it_names():
    command = project_table()["project"]["scripts"]["crosscheck"]
    function = importlib.metadata.EntryPoint("crosscheck", command, "console_scripts").load()
    assert callable(function)


def test_top_level_holds_only_what_belongs_there():
    """Files under version control there; without git, all but what it is to ignore."""
    listing = ""
    if shutil.which("git"):
        command = ["git", "ls-files", "-z"]
        listing = subprocess.run(command, cwd=PROJECT, capture_output=True, text=True).stdout
    names = {name.split("/")[0] for name in listing.split("\0") if name}
    if not names:  # of a repository around a tarball there are none
        ignored = [line.strip("/") for line in (PROJECT / ".gitignore").read_text().splitlines()]
        names = {n for n in os.listdir(PROJECT) if not any(fnmatch.fnmatch(n, i) for i in ignored)}
    assert {name for name in names if not name.startswith(".")} == AT_TOP


def test_the_citation_is_of_this_project():
    """Checks that need no parser of YAML; `cffconvert --validate` checks the rest."""
    lines = (PROJECT / "CITATION.cff").read_text().splitlines()
    citation = dict(
        line.split(": ", 1) for line in lines if not line.startswith(" ") and ": " in line
    )
    project = project_table()["project"]
    assert citation["cff-version"] == "1.2.0" and "authors:" in lines
    assert (citation["title"], citation["version"]) == (project["name"], project["version"])
    assert citation["abstract"] == f"{project['description']}."
    papers = (PROJECT / "comparisons/docs/method.md").read_text()
    for line in lines:
        name, _, value = line.strip().partition(": ")
        if line.startswith(" ") and name in ("title", "volume", "year", "start", "end"):
            assert value in papers
