"""run.npz: the arrays of a run, beside its result.json.

In: a finished run. Out: the file; and back from its folder. Arrays by name, of each folder with
curves, such as half_plane:

    x, z                              [m] points that every model's stresses stand at
    half_plane/x, …                   [m], [Pa] columns of contact.csv: CURVES
    half_plane/sx (friction 0.1), …   [Pa] stresses (m, k) at the points: COMPONENTS; in the file in
                                      single precision
    trace_x, trace_height             [m] of a rough surface, as read or made
    profile_x, profile_height         [m] the same as pressed, before any running-in
    answers                           JSON: answers from outside as they were read, whose arrays
                                      are a0, a1, …"""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Self

import numpy as np

from analytic.profile import Profile
from analytic.stress_state import StressState
from comparisons.common.cache import decoded, encoded, kinds_of
from comparisons.common.errors import InputError
from comparisons.judging.study import Run
from comparisons.models.level import Level, deformed_height
from comparisons.scenes.surface import SceneSurface
from comparisons.studies.answers.answer import Answer
from comparisons.studies.answers.show import answers_of

FILE = "run.npz"
CURVES = ("x", "pressure", "gap", "deformed_height")
COMPONENTS = ("sx", "sz", "txz")
LONGEST = 200  # characters of what a library says: zipfile quotes whole headers


@dataclass(frozen=True)
class RunArrays:
    """Arrays of a run along x, and below."""

    arrays: Mapping[str, np.ndarray]  # by name
    answers: Mapping[str, tuple[Answer, ...]]  # from outside, by name, each on its resolutions

    @classmethod
    def of(cls, run: Run) -> Self:
        """Arrays of a finished run, in full precision."""
        arrays = {} if run.window is None else {"x": run.window.x, "z": run.window.z}
        for folder, levels in levels_by_folder(run).items():
            level, *_ = levels.values()
            columns = (level.grid.x, level.solution.pressure, level.solution.gap)
            columns = (*columns, deformed_height(run.problem, level))
            arrays |= {f"{folder}/{n}": c for n, c in zip(CURVES, columns, strict=True)}
            for friction, level in levels.items() if run.window is not None else ():
                for name in COMPONENTS:
                    arrays[_stress(folder, name, friction)] = getattr(level.stress.field, name)
        for name, profile in traces_of(run.problem.surface).items():
            arrays |= {f"{name}_x": profile.x, f"{name}_height": profile.height}
        return cls(arrays, answers_of(run))

    @classmethod
    def read(cls, folder: Path) -> Self:
        """Read those in a run's folder. Raises InputError, one line, where there are none."""
        allowed = f"allowed is {FILE} as the run wrote it: run the scene again"
        try:
            with np.load(folder / FILE, allow_pickle=False) as file:
                arrays = {name: file[name] for name in file.files}
            answers = json.loads(str(arrays.pop("answers")))
            return cls(arrays, decoded(answers, arrays, kinds_of(Answer)))
        except Exception as error:  # zipfile, zlib, numpy and json have errors of their own
            said = f"{folder / FILE}: cannot be read: {str(error)[:LONGEST]}"
            raise InputError(f"{said}; {allowed}") from None

    def write(self, path: Path) -> None:
        """Write run.npz; stresses take half of the space so, and compress to nine tenths only."""
        arrays: dict[str, np.ndarray] = {}
        answers = json.dumps(encoded(dict(self.answers), arrays))
        for name, values in self.arrays.items():
            arrays[name] = values.astype(np.float32) if values.ndim > 1 else values
        np.savez(path, answers=np.array(answers), **arrays)

    @property
    def models(self) -> list[str]:
        """Names of those that there are curves of."""
        return list(dict.fromkeys(name.split("/")[0] for name in self.arrays if "/" in name))

    def contact(self, model: str, friction: float) -> dict[str, np.ndarray]:
        """Curves of a model at a friction coefficient: CURVES, in SI units."""
        folder = self._folder(model, friction)
        return {name: self.arrays[f"{folder}/{name}"] for name in CURVES}

    def stress(self, model: str, friction: float) -> dict[str, np.ndarray] | None:
        """Stresses of a model at a friction coefficient, [Pa], positive in tension: x (k,) and z
        (m,) [m], COMPONENTS and tau1 (m, k); None where there are none."""
        folder = self._folder(model, friction)
        parts = [self.arrays.get(_stress(folder, name, friction)) for name in COMPONENTS]
        if parts[0] is None:
            return None
        places = {name: self.arrays[name] for name in ("x", "z")}
        tau1 = StressState(*parts).tau1
        return places | dict(zip(COMPONENTS, parts, strict=True)) | {"tau1": tau1}

    def trace(self) -> Profile:
        """Trace of a rough surface, as read or made."""
        return Profile(self.arrays["trace_x"], self.arrays["trace_height"])

    def _folder(self, model: str, friction: float) -> str:
        own = _further(model, friction)
        return own if f"{own}/x" in self.arrays else model


def traces_of(surface: SceneSurface) -> dict[str, Profile]:
    """A rough surface's trace as read or made, and its profile as pressed, before it is run in."""
    if surface.profile is None:
        return {}
    pressed = surface.profile if surface.run_in is None else surface.run_in.before
    return {"trace": surface.info.trace, "profile": pressed}


def levels_by_folder(run: Run) -> dict[str, dict[float, Level]]:
    """The finest levels that share a contact, by friction, by the folders of their files; those of
    another contact, where friction changes it, below the first's."""
    levels: dict[str, dict[float, Level]] = {}
    for friction in run.frictions:
        for name, level in run.levels(friction).items():
            first = next(iter(levels.get(name, {}).values()), level)
            folder = name if first.shares_contact(level) else _further(name, friction)
            levels.setdefault(folder, {})[friction] = level
    return levels


def _further(model: str, friction: float) -> str:
    return f"{model}/friction_{friction:g}"


def _stress(folder: str, name: str, friction: float) -> str:
    return f"{folder}/{name} (friction {friction:g})"
