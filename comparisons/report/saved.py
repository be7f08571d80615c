"""report.npz: what the report shows and no other file of a run holds, so that it can be redrawn.

Two stress components on the common window and the figures of all levels, exact; the whole model
where it is not the scene's own finite elements. The mesh comes
from mesh.msh, figures and record from their own files; nothing is solved or meshed."""

import json
from collections import defaultdict
from dataclasses import dataclass, fields, replace
from functools import partial
from pathlib import Path

import numpy as np

from comparisons.common.cache import DAMAGED, decoded, encoded, kinds_of
from comparisons.common.errors import InputError
from comparisons.figures.quantity import WHOLE
from comparisons.models.level import Level, ModelRun
from comparisons.models.plan import Plan
from comparisons.models.problem import Problem
from comparisons.results.outcome import Outcome
from comparisons.results.recorded_run import check_schema, read_table
from comparisons.results.result_json import SCHEMA as RESULT_SCHEMA
from comparisons.scenes.scene import Origin, Scene
from comparisons.scenes.surface import SceneSurface

FILE = "report.npz"
SCHEMA = 3  # 2 had the surface in the scene
REMEDY = "allowed is what this version of crosscheck wrote; crosscheck rerun --out makes one"
LONGEST = 200  # characters of what a library says: zipfile quotes whole headers
MESH = Path("finite_element") / "mesh.msh"
# Of an outcome: in other files, or not shown.
ELSEWHERE = ("problem", "result", "record", "directory")


@dataclass(frozen=True)
class ShownField:
    """The components (m, k) [Pa] of a StressState that pictures show."""

    tau1: np.ndarray
    txz: np.ndarray


def save_shown(path: Path, outcome: Outcome) -> None:
    """Write report.npz."""
    arrays: dict[str, np.ndarray] = {}
    shown = _shown(outcome)
    parts = {f.name: getattr(shown, f.name) for f in fields(Outcome) if f.name not in ELSEWHERE}
    scene = shown.problem.scene
    said = {"tables": scene.tables, "name": scene.name, "source": scene.source}
    parts["problem"] = {f.name: getattr(shown.problem, f.name) for f in fields(Problem)}
    parts["problem"] |= {"scene": said}
    outline = json.dumps({"schema": SCHEMA, "outcome": encoded(parts, arrays)})
    np.savez(path, outline=np.array(outline), **arrays)  # fields compress to nine tenths only


def read_outcome(folder: Path, with_mesh: bool = True) -> Outcome:
    """The outcome in a run's folder, as far as its report shows it.

    with_mesh  without it the report cannot be drawn, but reading takes a tenth of the time
    Raises InputError, one line, where the folder does not hold one."""
    if not folder.is_dir():
        raise InputError(f"{folder}: is no folder; allowed is the folder of a finished run")
    result, record = (read_table(folder / name) for name in ("result.json", "record.json"))
    check_schema(folder / "result.json", result, RESULT_SCHEMA)
    parts = _read(folder / FILE)
    try:
        said = parts["problem"].pop("scene")
        scene = Scene.of(said["tables"], Origin(said["name"], folder, said["source"]))
        parts["problem"] = Problem(scene=scene, **parts["problem"])
        outcome = Outcome(**parts, result=result, record=record, directory=folder)
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
        raise InputError(f"{folder / FILE}: {error}; {REMEDY}") from None
    return _with_mesh(outcome, folder / MESH) if with_mesh else outcome


def _read(path: Path) -> dict:
    try:
        with np.load(path, allow_pickle=False) as arrays:
            outline = json.loads(str(arrays["outline"]))
            kinds = kinds_of(Outcome, ShownField)
            if outline["schema"] == SCHEMA:
                return decoded(outline["outcome"], arrays, kinds)
            if outline["schema"] == SCHEMA - 1:
                # of kinds that are gone their fields; a plan that knew no increments checked none
                kinds |= {"Plan": partial(Plan, increments_check=False)}
                kinds = defaultdict(lambda: dict, kinds)
                return _of_schema_2(decoded(outline["outcome"], arrays, kinds))
    except FileNotFoundError:
        raise InputError(f"{path.parent}: holds no {path.name}; {REMEDY}") from None
    except DAMAGED as error:
        raise InputError(f"{path}: cannot be read: {str(error)[:LONGEST]}; {REMEDY}") from None
    raise InputError(f"{path}: schema: is {outline['schema']}; allowed is {SCHEMA}; {REMEDY}")


def _of_schema_2(parts: dict) -> dict:
    """The parts as now: a scene held its surface, of classes that are gone."""
    scene = parts["problem"]["scene"]
    surface = SceneSurface(
        scene["profile"], scene["profile_info"], scene["position"], run_in=scene["run_in"]
    )
    return parts | {"problem": parts["problem"] | {"surface": surface}}


def _shown(outcome: Outcome) -> Outcome:
    """The outcome without what no picture and no table shows."""
    runs, frictions = {}, outcome.problem.scene.load.friction
    wholes = {mu: outcome.levels(mu)[WHOLE] for mu in frictions if WHOLE in outcome.levels(mu)}
    drawn = [level for mu in frictions for level in outcome.pair(mu).values()]
    for name, run in outcome.runs.items():
        shown = [level is run.finest or any(level is d for d in drawn) for level in run.levels]
        levels = tuple(map(_reduced, run.levels, shown))
        check = None if run.far_boundary_check is None else _reduced(run.far_boundary_check)
        longer = tuple(map(_reduced, run.longer_increments))
        runs[name] = ModelRun(name, levels, check, longer)
    budget = outcome.budget
    if budget is not None:
        shown = {friction: _reduced(level, True) for friction, level in wholes.items()}
        budget = replace(budget, wholes=shown)
    surface = outcome.problem.surface
    if surface.info is not None:
        # the trace as read stands in record.json; the file that it came from is not everybody's
        surface = replace(surface, info=replace(surface.info, path=None, trace=None))
    problem = replace(outcome.problem, surface=surface)
    return replace(outcome, problem=problem, runs=runs, budget=budget)


def _reduced(level: Level, with_fields: bool = False) -> Level:
    """A level without its mesh, and without fields or with those that are shown."""
    stresses = []
    for stress in level.stresses:
        field = ShownField(stress.field.tau1, stress.field.txz) if with_fields else None
        stresses.append(replace(stress, field=field))
    return replace(level, stresses=tuple(stresses), mesh=None, mesh_field=None)


def _with_mesh(outcome: Outcome, path: Path) -> Outcome:
    """The outcome with the finite elements' mesh in its place."""
    run = outcome.runs.get("finite_element")
    if run is None:
        return outcome
    from meshes.msh_file import read_msh

    try:
        mesh = read_msh(path)
    except FileNotFoundError:
        raise InputError(f"{path}: is missing; {REMEDY}") from None
    except Exception as error:  # of a file that was cut short meshio may say anything
        raise InputError(f"{path}: cannot be read: {str(error)[:LONGEST]}; {REMEDY}") from None
    run = replace(run, levels=(*run.levels[:-1], replace(run.finest, mesh=mesh)))
    return replace(outcome, runs={**outcome.runs, run.name: run})
