"""A wrong scene in the working folder of a run that must never begin to solve."""

from collections.abc import Callable
from pathlib import Path

import pytest

from comparisons.cli import main

GOOD = {
    "title": '"A good scene"',
    "roller.radius": '"8.2 mm"',
    "roller.youngs_modulus": '"207 GPa"',
    "roller.poissons_ratio": "0.3",
    "body.youngs_modulus": '"207 GPa"',
    "body.poissons_ratio": "0.3",
    "load.per_length": '"3.85 N/um"',
}


@pytest.fixture(scope="session")
def toml() -> Callable[[dict], str]:
    """`toml(changes)`: GOOD with the changes, as a scene file; None takes a field away."""

    def written(changes: dict) -> str:
        fields = {**GOOD, **changes}.items()
        return "\n".join(f"{name} = {text}" for name, text in fields if text is not None)

    return written


@pytest.fixture(scope="session")
def trace() -> str:
    """What a measured profile's file may hold."""
    return "x,height\n" + "".join(f"{i},{(i * 7) % 5 / 10}\n" for i in range(40))


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    solve_scene = "comparisons.runs.run.solve_scene"
    monkeypatch.setattr(solve_scene, lambda *_: pytest.fail("a wrong scene was solved"))
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def complaint(folder, capsys) -> Callable[..., str]:
    """`complaint(*arguments)`: the one line that the command ends with, after status 2 and without
    a trace of a result."""

    def line(*arguments: str) -> str:
        before = sorted(folder.rglob("*"))
        status = main(list(arguments))
        out, err = capsys.readouterr()
        assert status == 2, err
        assert out == ""
        assert err.startswith("crosscheck: ") and err.endswith("\n") and err.count("\n") == 1
        assert sorted(folder.rglob("*")) == before
        return err.strip()

    return line
