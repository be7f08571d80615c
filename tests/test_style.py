"""Lint, format and type hints, so that the test command checks them too."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

PROJECT = Path(__file__).resolve().parents[1]
PACKAGES = ("analytic", "meshes", "fem", "comparisons")
MODULES = sorted(path for name in PACKAGES for path in (PROJECT / name).rglob("*.py"))


@pytest.mark.parametrize("check", [["check"], ["format", "--check", "--diff"]], ids=lambda c: c[0])
def test_ruff_finds_nothing(check):
    done = subprocess.run(
        [sys.executable, "-m", "ruff", *check, "--no-cache", "."],
        cwd=PROJECT,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout + done.stderr


def public_functions(tree: ast.Module):
    """Functions of a module, and methods of its classes, whose names do not begin with `_`."""
    for node in tree.body:
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
            yield from public_functions(node)
        elif isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
            yield node


def missing_hints(function: ast.FunctionDef) -> list[str]:
    """Names of the arguments without a type hint, and `return` where that lacks one."""
    given = function.args
    arguments = [*given.posonlyargs, *given.args, *given.kwonlyargs, given.vararg, given.kwarg]
    missing = [
        argument.arg
        for argument in arguments
        if argument and not argument.annotation and argument.arg not in ("self", "cls")
    ]
    return missing if function.returns else [*missing, "return"]


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        ("def f(x: int, *, y: str = '') -> None: ...", []),
        ("def f(x, *, y, **z): ...", ["x", "y", "z", "return"]),
        ("class C:\n    def f(self, x) -> int: ...", ["x"]),
        ("def _f(x): ...\nclass _C:\n    def f(self): ...", []),
    ],
)
def test_missing_hints_are_seen(source, expected):
    found = [name for f in public_functions(ast.parse(source)) for name in missing_hints(f)]
    assert found == expected


def test_public_functions_have_type_hints():
    without = [
        f"{path.relative_to(PROJECT)}:{function.lineno} {function.name}: {', '.join(missing)}"
        for path in MODULES
        for function in public_functions(ast.parse(path.read_text()))
        if (missing := missing_hints(function))
    ]
    assert MODULES
    assert not without, "\n".join(without)
