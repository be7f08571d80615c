"""What a cost study has measured, on disk: one file a setting, whole or not at all.

A setting that was measured is not measured again unless scene, program, versions, machine or the
number of repeats differ; the time it took counts as before.
"""

import re
from pathlib import Path

from comparisons.common.cache import keep, kept, tidy
from comparisons.common.provenance import machine
from comparisons.models.level_cache import KINDS, key_of
from comparisons.scenes.scene import ResolvedScene
from comparisons.studies.cost.measure import Measured, Task
from comparisons.studies.cost.solve import Answer

FOLDER = "cost_points"
THREADS = 1  # of a measuring process
LOAD = "load"  # that a prescribed approach takes


def measuring_machine() -> dict:
    """This machine, as a measuring process uses it."""
    return machine() | {"threads": THREADS}


class CostStore:
    """The measured settings that the folder of a study of `scene` holds."""

    def __init__(self, out: Path, scene: ResolvedScene, repeats: int) -> None:
        self.folder = out / FOLDER
        self.key = key_of(scene, measuring_machine(), repeats)

    def load(self, task: Task) -> Measured | None:
        """What was measured of a task, None where that is not there, or of another study."""
        return self._kept(_name(task))

    def save(self, task: Task, measured: Measured) -> None:
        """Keep what was measured, whatever ends this process."""
        self._keep(_name(task), measured)

    def load_per_length(self) -> float | None:
        """That [N/m] of a prescribed approach, None where it is not known yet."""
        return self._kept(LOAD)

    def save_load_per_length(self, load: float) -> None:
        """Keep the load [N/m] of a prescribed approach."""
        self._keep(LOAD, load)

    def tidy(self) -> None:
        """Remove what a process left that was killed while it wrote."""
        tidy(self.folder)

    def _kept(self, name: str) -> object | None:
        return kept(self.folder / f"{name}.npz", self.key, (*KINDS, Measured, Answer))

    def _keep(self, name: str, value: object) -> None:
        keep(self.folder / f"{name}.npz", self.key, value)


def _name(task: Task) -> str:
    """Of a task among those of one study."""
    method = re.sub(r"\W+", "-", task.method)
    return f"{method}_{task.setting!r}{'_halved' if task.halved else ''}"
