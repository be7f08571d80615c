"""The layers: who may import whom, what is imported late, and what lies at the top level.

    analytic  <-  meshes  <-  fem  <-  comparisons

`meshes` and `fem` use of `analytic` only its data types, so that the finite-element answer cannot
lean on the solutions that it checks. Whatever is slow to import, or may be absent, is imported
inside the function that needs it.
"""

import ast
import fnmatch
import importlib.metadata
import json
import os
import shutil
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import pytest

PROJECT = Path(__file__).resolve().parents[1]
DATA_TYPES = {"analytic.material", "analytic.stress_state", "analytic.profile"}
# What each package may import of ours: whole packages, or single modules.
MAY_IMPORT = {
    "analytic": {"analytic"},
    "meshes": {"meshes"} | DATA_TYPES,
    "fem": {"fem", "meshes"} | DATA_TYPES,
    "comparisons": {"comparisons", "fem", "meshes", "analytic"},
}
HEAVY = {
    "basix",
    "dolfinx",
    "ffcx",
    "gmsh",
    "matplotlib",
    "meshio",
    "mpi4py",
    "petsc4py",
    "pyvista",
    "ufl",
    "vtk",
    "vtkmodules",
}
AT_TOP = {"README.md", "crosscheck", "pyproject.toml", "tests", *MAY_IMPORT}
MODULES = sorted(path for package in MAY_IMPORT for path in (PROJECT / package).rglob("*.py"))


def dotted_name(path: Path) -> str:
    parts = path.relative_to(PROJECT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def is_type_checking(node: ast.AST) -> bool:
    """An `if TYPE_CHECKING:` block, which never runs."""
    return isinstance(node, ast.If) and ast.unparse(node.test).endswith("TYPE_CHECKING")


def statements(node: ast.AST, into_functions: bool):
    """Everything below `node`; without what stands in functions or never runs, if so asked."""
    for child in ast.iter_child_nodes(node):
        late = isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda)
        if into_functions or not (late or is_type_checking(child)):
            yield child
            yield from statements(child, into_functions)


def imported(tree: ast.AST, package: str, into_functions: bool = True):
    """Names that a module in `package` imports; `from a import b` counts as `a.b`."""
    for node in statements(tree, into_functions):
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


def heavy_at_import(source: str, package: str) -> list[str]:
    """Heavy modules that importing a module in `package` would load at once."""
    names = imported(ast.parse(source), package, into_functions=False)
    return [name for name in names if is_within(name, HEAVY)]


def package_of(path: Path) -> str:
    return dotted_name(path.parent / "__init__.py")


@pytest.mark.parametrize(
    ("package", "source"),
    [
        ("analytic", "import fem"),
        ("analytic.exact", "from ...fem import elasticity"),
        ("meshes", "from analytic import contact"),
        ("meshes", "import analytic"),
        ("fem", "def f():\n    from analytic.exact.hertz import field"),
        ("fem", "import importlib\nimportlib.import_module('comparisons.runs.run')"),
        ("fem", "if TYPE_CHECKING:\n    from comparisons.scenes.scene import Scene"),
    ],
)
def test_an_import_against_the_arrows_is_seen(package, source):
    assert len(forbidden(source, package)) == 1


@pytest.mark.parametrize(
    ("package", "source"),
    [
        ("analytic.exact", "from ..material import Material\nimport scipy"),
        ("fem", "from analytic import profile\nfrom analytic.material import Material"),
        ("fem", "from meshes.block import BlockMesh\nfrom . import compat"),
        ("comparisons", "from analytic.contact.problem import solve\nimport fem.body.elasticity"),
    ],
)
def test_an_import_along_the_arrows_is_let_through(package, source):
    assert forbidden(source, package) == []


@pytest.mark.parametrize(
    ("source", "count"),
    [
        ("import gmsh", 1),
        ("try:\n    from dolfinx import fem\nexcept ImportError:\n    pass", 1),
        ("class A:\n    from matplotlib import pyplot", 1),
        ("def f():\n    import pyvista", 0),
        ("if TYPE_CHECKING:\n    from dolfinx.mesh import Mesh", 0),
        ("import fem.body.elasticity, ufly", 0),
    ],
)
def test_a_heavy_import_is_seen(source, count):
    assert len(heavy_at_import(source, "fem")) == count


@pytest.mark.parametrize("path", MODULES, ids=dotted_name)
def test_imports_follow_the_arrows(path):
    assert forbidden(path.read_text(), package_of(path)) == []


@pytest.mark.parametrize("path", MODULES, ids=dotted_name)
def test_heavy_imports_stand_inside_functions(path):
    assert heavy_at_import(path.read_text(), package_of(path)) == []


def heavy_after(code: str) -> list[str]:
    """Heavy modules that are loaded when `code` has run in a fresh interpreter."""
    report = f"import json, sys; print(json.dumps(sorted(set(sys.modules) & {HEAVY!r})))"
    done = subprocess.run(
        [sys.executable, "-c", f"{code}\n{report}"], cwd=PROJECT, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout.splitlines()[-1])


def test_a_loaded_heavy_module_is_reported():
    assert heavy_after("import sys; sys.modules['gmsh'] = sys") == ["gmsh"]


def test_importing_every_module_loads_nothing_heavy():
    """Also by way of somebody else's module."""
    names = [dotted_name(path) for path in MODULES if path.stem != "__main__"]
    assert heavy_after(f"import importlib\nfor n in {names!r}: importlib.import_module(n)") == []


def test_help_loads_nothing_heavy():
    code = """
import sys
from comparisons.cli import main
sys.argv = ["crosscheck", "--help"]
try:
    main()
except SystemExit as end:
    assert not end.code, end.code
"""
    assert heavy_after(code) == []


def project_table() -> dict:
    return tomllib.loads((PROJECT / "pyproject.toml").read_text())


def test_packages_are_the_folders_with_python_in_them():
    listed = project_table()["tool"]["hatch"]["build"]["targets"]["wheel"]["packages"]
    folders = {path.name for path in PROJECT.iterdir() if (path / "__init__.py").exists()}
    assert set(listed) == folders == set(MAY_IMPORT)


def test_every_folder_of_modules_is_a_package():
    assert [p for p in MODULES if not (p.parent / "__init__.py").exists()] == []


def test_wheel_holds_every_file_of_the_packages(tmp_path):
    """Scenes, profiles and templates too: an installed crosscheck works without the checkout."""
    source = tmp_path / "source"
    for package in MAY_IMPORT:
        unwanted = shutil.ignore_patterns("__pycache__")
        shutil.copytree(PROJECT / package, source / package, ignore=unwanted)
    for name in ("pyproject.toml", ".gitignore"):
        shutil.copy(PROJECT / name, source)
    subprocess.run(
        [sys.executable, "-m", "hatchling", "build", "--target", "wheel", "--directory", tmp_path],
        cwd=source,
        check=True,
        capture_output=True,
    )
    (wheel,) = tmp_path.glob("*.whl")
    with zipfile.ZipFile(wheel) as archive:
        packed = {name for name in archive.namelist() if ".dist-info/" not in name}
    files = (path for package in MAY_IMPORT for path in (source / package).rglob("*"))
    assert packed == {str(path.relative_to(source)) for path in files if path.is_file()}


def test_command_leads_to_the_function_that_it_names():
    command = project_table()["project"]["scripts"]["crosscheck"]
    function = importlib.metadata.EntryPoint("crosscheck", command, "console_scripts").load()
    assert callable(function)


def top_level() -> set[str]:
    """Names at the top level under version control; without git, all but what it is to ignore."""
    listing = (
        subprocess.run(["git", "ls-files", "-z"], cwd=PROJECT, capture_output=True, text=True)
        if shutil.which("git")
        else None
    )
    if listing and listing.returncode == 0:
        return {name.split("/")[0] for name in listing.stdout.split("\0") if name}
    ignored = [line.strip("/") for line in (PROJECT / ".gitignore").read_text().splitlines()]
    names = os.listdir(PROJECT)
    return {n for n in names if not any(fnmatch.fnmatch(n, pattern) for pattern in ignored)}


def test_top_level_holds_only_what_belongs_there():
    assert {name for name in top_level() if not name.startswith(".")} == AT_TOP
