"""report.npz: what the report shows and no other file of a run holds, so that it can be redrawn.

Two stress components on the common window and the figures of all levels, exact; the whole model
where it is not the scene's own finite elements. The mesh comes
from mesh.msh, figures and record from their own files; nothing is solved or meshed."""

import json
from dataclasses import dataclass, fields, replace
from pathlib import Path

import numpy as np

from comparisons.common.cache import DAMAGED, decoded, encoded, kinds_of
from comparisons.common.errors import InputError
from comparisons.figures.quantity import WHOLE
from comparisons.models.level import Level, ModelRun
from comparisons.models.problem import Problem
from comparisons.results.outcome import Outcome
from comparisons.results.recorded_run import check_schema, read_table
from comparisons.results.result_json import SCHEMA as RESULT_SCHEMA

FILE = "report.npz"
SCHEMA = 2  # 1 had another account of convergence
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
    parts["problem"] = {f.name: getattr(shown.problem, f.name) for f in fields(Problem)}
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
        parts["problem"] = Problem(**parts["problem"])
        outcome = Outcome(**parts, result=result, record=record, directory=folder)
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
        raise InputError(f"{folder / FILE}: {error}; {REMEDY}") from None
    return _with_mesh(outcome, folder / MESH) if with_mesh else outcome


def _read(path: Path) -> dict:
    try:
        with np.load(path, allow_pickle=False) as arrays:
            outline = json.loads(str(arrays["outline"]))
            if outline["schema"] == SCHEMA:
                return decoded(outline["outcome"], arrays, kinds_of(Outcome, ShownField))
    except FileNotFoundError:
        raise InputError(f"{path.parent}: holds no {path.name}; {REMEDY}") from None
    except DAMAGED as error:
        raise InputError(f"{path}: cannot be read: {str(error)[:LONGEST]}; {REMEDY}") from None
    raise InputError(f"{path}: schema: is {outline['schema']}; allowed is {SCHEMA}; {REMEDY}")


def _shown(outcome: Outcome) -> Outcome:
    """The outcome without what no picture and no table shows."""
    runs, frictions = {}, outcome.problem.scene.friction
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
    scene = outcome.problem.scene
    if scene.profile_info is not None:
        # the trace as read stands in record.json; the file that it came from is not everybody's
        scene = replace(scene, profile_info=replace(scene.profile_info, path=None, trace=None))
    return replace(outcome, problem=replace(outcome.problem, scene=scene), runs=runs, budget=budget)


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
