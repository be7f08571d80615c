"""What a cost study has measured, on disk: one file a setting, whole or not at all.

A setting that was measured is not measured again unless scene, program, versions, machine or the
number of repeats differ; the time it took counts as before.
"""

import re
from pathlib import Path

from comparisons.common.cache import Cache, kinds_of
from comparisons.common.provenance import LEVEL_CODE, key_of, machine, program_code, versions
from comparisons.models.level_cache import scene_key
from comparisons.scenes.scene import ResolvedScene
from comparisons.studies.cost.measure import Measured, Task

FOLDER = "cost_points"
CODE = (
    *LEVEL_CODE,
    *(f"comparisons/studies/cost/{name}.py" for name in ("measure", "methods", "solve")),
)
THREADS = 1  # of a measuring process
LOAD = "load"  # that a prescribed approach takes


def measuring_machine() -> dict:
    """This machine, as a measuring process uses it."""
    return machine() | {"threads": THREADS}


def cost_cache(out: Path, scene: ResolvedScene, repeats: int) -> Cache:
    """Measured settings of a study of `scene`, under `name_of` their task, and the load [N/m] of a
    prescribed approach, under LOAD."""
    program = versions(), program_code(*CODE)
    key = key_of(scene_key(scene), measuring_machine(), repeats, *program)
    return Cache(out / FOLDER, key, kinds_of(Measured))


def name_of(task: Task) -> str:
    """The name of a task among those of one study."""
    method = re.sub(r"\W+", "-", task.method)
    return f"{method}_{task.setting!r}{'_half_block' if task.half_block else ''}"
