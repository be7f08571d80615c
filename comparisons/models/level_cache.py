"""Finished levels of an unfinished run, so that a run that was stopped goes on.

The folder is hidden in the run's own, or beside it while there is none, and goes when the run has
ended. The key covers all that shapes a level: scene, profile, plan, versions, and the code."""

from pathlib import Path

from comparisons.common.cache import NO_CACHE, Cache, kinds_of
from comparisons.common.files import unfinished
from comparisons.common.provenance import LEVEL_CODE, digest, key_of, program_code, versions
from comparisons.models.level import Level
from comparisons.models.plan import Plan
from comparisons.scenes.scene import ResolvedScene

CODE = (  # of studies those whose answers are cached, too
    *LEVEL_CODE,
    *(f"comparisons/studies/{name}" for name in ("model_error", "scatter", "statistics")),
)


def level_cache(out: Path | None, scene: ResolvedScene, plan: Plan, *kinds: type) -> Cache:
    """Levels of the run of `plan` for `scene` that writes `out`, and dataclasses of other `kinds`;
    None writes and caches nothing."""
    if out is None:
        return NO_CACHE
    key = key_of(scene_key(scene), repr(plan), versions(), program_code(*CODE))
    return Cache(unfinished(out), key, kinds_of(Level, *kinds), by_all=True)


def scene_key(scene: ResolvedScene) -> list:
    """What of a scene shapes results: its tables and its profile."""
    profile = "" if scene.profile is None else digest(scene.profile.x, scene.profile.height)
    return [scene.tables, profile]
