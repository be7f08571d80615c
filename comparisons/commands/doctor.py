"""`crosscheck doctor`: what works here, by importing it and solving something tiny with it."""

import os
import platform
import signal
import subprocess
import sys
import tomllib
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from comparisons.commands.arguments import json_option
from comparisons.commands.output import progress, show_either
from comparisons.common.errors import ExitStatus
from comparisons.common.progress import Step

if TYPE_CHECKING:
    from rich.table import Table

PATIENCE = 60.0  # s; the first trial that compiles a form takes twenty
MODELS = {"half-plane": "half-plane", "finite elements": "finite-element"}
REMEDY = "./crosscheck installs everything anew once its folder .venv is removed."


@dataclass(frozen=True)
class Finding:
    """Finding on an item: whether it works, and its version or what is wrong."""

    name: str
    ok: bool
    detail: str


@cache
def _known() -> dict:
    return tomllib.loads(Path(__file__).with_name("doctor.toml").read_text(encoding="utf-8"))


def trials() -> dict[str, str]:
    """Programs by item, a process each: they print its version if it works, and fail otherwise."""
    contact = _known()["contact"]
    of_models = {name: f"MODEL = {model!r}\n{contact}" for name, model in MODELS.items()}
    return _known()["items"] | of_models


def doctor(as_json: Annotated[bool, json_option("the findings as JSON")] = False) -> int:
    """Show what is installed, what is missing, and how to get it."""
    from comparisons.common.provenance import PROJECT, revision

    findings = [Finding("Python", True, f"{platform.python_version()}, {sys.executable}")]
    findings.append(Finding("crosscheck", True, f"{revision() or 'no revision'}, {PROJECT}"))
    with progress() as callback, ThreadPoolExecutor(2) as pool:
        programs = trials()
        for number, finding in enumerate(pool.map(attempt, programs, programs.values()), start=1):
            findings.append(finding)
            callback(Step(f"tried {finding.name}", number / len(programs)))
    works = all(finding.ok for finding in findings)
    show_either(as_json, lambda: list(map(asdict, findings)), lambda: findings_table(findings))
    if not (works or as_json):
        print(REMEDY)
    return ExitStatus.DONE if works else ExitStatus.SOMETHING_MISSING


def attempt(name: str, program: str, patience: float = PATIENCE) -> Finding:
    """Run a trial for at most `patience` seconds."""
    command = [sys.executable, "-P", "-c", program]
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, errors="replace", timeout=patience,
            stdin=subprocess.DEVNULL, env=os.environ | _known()["environment"]
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        return Finding(name, False, f"does not answer within {patience:g} s")
    if done.returncode == 0:
        return Finding(name, True, done.stdout.strip().splitlines()[-1])
    if done.returncode < 0:
        return Finding(name, False, f"crashes ({signal.Signals(-done.returncode).name})")
    lines = done.stderr.strip().splitlines() or [f"ends with {done.returncode}"]
    return Finding(name, False, lines[-1])


def findings_table(findings: Sequence[Finding]) -> "Table":
    from comparisons.output.terminal import plain_table

    rows = ((one.name, "yes" if one.ok else "no", one.detail) for one in findings)
    return plain_table("item", "works", "version, or what is wrong", rows=rows)
