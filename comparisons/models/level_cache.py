"""Finished levels of an unfinished run, so that a run that was stopped goes on.

The folder is hidden in the run's own, or beside it while there is none, and goes when the run has
ended. The key covers all that shapes a level: scene, profile, plan, versions, and the code."""

from pathlib import Path

from comparisons.common.cache import NO_CACHE, Cache, kinds_of
from comparisons.common.files import unfinished
from comparisons.common.provenance import LEVEL_CODE, digest, key_of, program_code, versions
from comparisons.models.level import Level
from comparisons.models.plan import Plan
from comparisons.models.problem import Problem
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import SceneSurface

CODE = (  # of studies those whose answers are cached, too
    *LEVEL_CODE,
    *(f"comparisons/studies/{name}" for name in ("model_error", "scatter", "statistics")),
)


def level_cache(out: Path | None, problem: Problem, plan: Plan, *kinds: type) -> Cache:
    """Levels of the run of `plan` that writes `out`, and dataclasses of other `kinds`;
    None writes and caches nothing."""
    if out is None:
        return NO_CACHE
    shape = scene_key(problem.scene, problem.surface)
    key = key_of(shape, repr(plan), versions(), program_code(*CODE))
    return Cache(unfinished(out), key, kinds_of(Level, *kinds), by_all=True)


def scene_key(scene: Scene, surface: SceneSurface) -> list:
    """What of a scene shapes results: its tables and its profile."""
    profile = surface.profile
    traced = "" if profile is None else digest(profile.x, profile.height)
    return [surface.completed(scene.tables), traced]
