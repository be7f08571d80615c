"""Outcomes of an input, and which of them are defects."""

import io
import re
import signal
import traceback
from collections.abc import Callable
from pathlib import Path

import numpy as np
from rich.console import Console

from comparisons.common.errors import InputError, SolverError
from comparisons.output.plausibility import warnings_about, warnings_about_result
from comparisons.output.terminal import summary
from comparisons.runs.run import run
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import surface_of

PATIENCE = 20.0  # seconds of processor for one input
LONGEST_LINE = 1500  # characters


class Refusal(Exception):
    """A defect in how an input was refused or resolved."""


def resolve(path: Path) -> str:
    """Outcome of a scene that is read, checked and resolved."""
    scene = Scene.read(path)
    surface = surface_of(scene)
    warnings_about(scene, surface)
    if scene.profile is not None:
        figures = surface.info.as_dict()
        roughness = [v for v in figures["roughness"].values() if isinstance(v, float)]
        values = (surface.profile.x, surface.profile.height, [surface.info.length, *roughness])
        if not all(np.all(np.isfinite(array)) for array in values):
            raise Refusal("a resolved profile is not finite")
    return "resolved"


def solve(path: Path) -> str:
    """Outcome of a scene that is solved by the half-plane."""
    result = run(Scene.read(path), None, ("half_plane",))
    warnings_about_result(result)
    shown = Console(file=io.StringIO(), width=100)
    shown.print(summary(result))
    if re.search(r"\b(nan|inf)\b", shown.file.getvalue()):
        raise Refusal("the table shows a number that is none")
    return "solved" if result.converged else "not converged"


def _check_line(line: str, path: Path) -> None:
    if path.name not in line:
        raise Refusal(f"the line names no file: {line}")
    if "\n" in line or not line.isprintable() or len(line) > LONGEST_LINE:
        raise Refusal(f"not one line: {line[:LONGEST_LINE]}")
    if re.search(r"(?<![\w/])(nan|inf) (m|by|to)\b", re.sub(r"[\"'][^\"']*[\"']", "", line)):
        raise Refusal(f"a number that is none: {line}")


def outcome(work: Callable[[Path], str], path: Path) -> tuple[str, str]:
    """The outcome of one input in a word, and of a defect its account."""

    def too_long(number: int, frame: object) -> None:
        raise Refusal(f"takes more than {PATIENCE:g} s of processor")

    signal.signal(signal.SIGPROF, too_long)
    signal.setitimer(signal.ITIMER_PROF, PATIENCE)
    try:
        return work(path), ""
    except (InputError, SolverError) as error:
        try:
            _check_line(str(error), path)
        except Refusal as defect:
            return "DEFECT", str(defect)
        return "refused", ""
    except Refusal as defect:
        return "DEFECT", str(defect)
    except BaseException as error:
        if isinstance(error, KeyboardInterrupt):
            raise
        places = [
            f"{Path(f.filename).name}:{f.lineno}" for f in traceback.extract_tb(error.__traceback__)
        ]
        return "DEFECT", f"{type(error).__name__}: {error} ({' '.join(places[-4:])})"
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
