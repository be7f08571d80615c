"""Lint, format and type hints, so that the test command checks them too."""

import ast
import subprocess
import sys

import pytest
from scenes import PROJECT

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


def missing_hints(source: str) -> list[str]:
    """Public functions with arguments, or a result, that have no type hint."""
    missing = []
    for function in public_functions(ast.parse(source)):
        signature = function.args
        arguments = [*signature.posonlyargs, *signature.args, *signature.kwonlyargs]
        arguments += [signature.vararg, signature.kwarg]
        hints = [a.annotation for a in arguments if a and a.arg not in ("self", "cls")]
        if None in (*hints, function.returns):
            missing.append(f"{function.lineno} {function.name}")
    return missing


def test_public_functions_have_type_hints():
    without = {str(path): missing_hints(path.read_text()) for path in MODULES}
    assert MODULES and not any(without.values()), {k: v for k, v in without.items() if v}
    assert missing_hints("class C:\n    def f(self, *, x) -> int: ...") == ["2 f"]
