"""report.npz: what the report shows and no other file of a run holds, so that it can be redrawn.

In: a finished run. Out: its report.npz; and back from its folder. Levels, exact; two stress
components on the common window, in single precision; the whole model where it is not the scene's
own finite elements; what studies' pictures are drawn from. The mesh comes from mesh.msh, figures
and record from their own files; nothing is solved or meshed."""

import json
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path

import numpy as np

from analytic.stress_state import StressState
from comparisons.common.cache import decoded, encoded, kinds_of
from comparisons.common.errors import InputError
from comparisons.figures.quantity import WHOLE
from comparisons.models.level import Level, ModelRun
from comparisons.models.plan import Plan
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.output.record import read_result, read_table
from comparisons.scenes.scene import Origin, Scene
from comparisons.studies import STUDIES
from comparisons.studies.study import MODEL_ERROR, Run, Solved

FILE = "report.npz"
SCHEMA = 3
REMEDY = "allowed is what this version of crosscheck wrote; crosscheck rerun --out makes one"
LONGEST = 200  # characters of what a library says: zipfile quotes whole headers
MESH = Path("finite_element") / "mesh.msh"
KEPT = ("plan", "window", "runs", "refinement")  # of a Solved


@dataclass(frozen=True)
class ShownField:
    """The components (m, k) [Pa] of a StressState that pictures show, as they show them: in single
    precision."""

    tau1: np.ndarray
    txz: np.ndarray


def save_shown(path: Path, run: Run) -> None:
    """Write report.npz."""
    arrays: dict[str, np.ndarray] = {}
    solved, data = _shown(run)
    scene = solved.problem.scene
    problem = {f.name: getattr(solved.problem, f.name) for f in fields(Problem)}
    problem["scene"] = {"tables": scene.tables, "name": scene.name, "source": scene.source}
    parts = {"problem": problem, "data": data} | {name: getattr(solved, name) for name in KEPT}
    outline = json.dumps({"schema": SCHEMA, "run": encoded(parts, arrays)})
    np.savez(path, outline=np.array(outline), **arrays)  # fields compress to nine tenths only


def read_run(folder: Path, with_mesh: bool = True) -> Run:
    """The run in its folder, as far as its report shows it.

    with_mesh  without it the report cannot be drawn, but reading takes a tenth of the time
    Raises InputError, one line, where the folder does not hold one."""
    if not folder.is_dir():
        raise InputError(f"{folder}: is no folder; allowed is the folder of a finished run")
    result, record = read_result(folder / "result.json"), read_table(folder / "record.json")
    content = _read(folder / FILE)
    try:
        content["problem"] = _problem(content["problem"], folder)
        data = content.pop("data")
        solved = Solved(**content)
        findings = {n: replace(f, data=data.get(n)) for n, f in result.findings.items()}
        run = Run(solved, findings, record, folder)
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
        raise InputError(f"{folder / FILE}: {error}; {REMEDY}") from None
    return _with_mesh(run, folder / MESH) if with_mesh else run


def _problem(parts: dict, folder: Path) -> Problem:
    said = parts.pop("scene")
    scene = Scene.of(said["tables"], Origin(said["name"], folder, said["source"]))
    return Problem(scene, **parts)


def _read(path: Path) -> dict:
    """The parts of a run."""
    of_studies = (study.data for study in STUDIES if study.data)
    kinds = kinds_of(Problem, Plan, Window, ModelRun, ShownField, *of_studies)
    try:
        with np.load(path, allow_pickle=False) as arrays:
            outline = json.loads(str(arrays["outline"]))
            if outline["schema"] == SCHEMA:
                return decoded(outline["run"], arrays, kinds)
    except FileNotFoundError:
        raise InputError(f"{path.parent}: holds no {path.name}; {REMEDY}") from None
    except Exception as error:
        raise InputError(f"{path}: cannot be read: {str(error)[:LONGEST]}; {REMEDY}") from None
    raise InputError(f"{path}: schema: is {outline['schema']}; allowed is {SCHEMA}; {REMEDY}")


def _shown(run: Run) -> tuple[Solved, dict[str, object]]:
    """What is solved and the studies' data, without what no picture and no table shows."""
    runs, frictions = {}, run.problem.scene.load.friction
    wholes = {mu: run.levels(mu)[WHOLE] for mu in frictions if WHOLE in run.levels(mu)}
    drawn = [level for mu in frictions for level in run.pair(mu).values()]
    for name, model in run.runs.items():
        shown = [*drawn, *model.finest.by_friction]
        levels = tuple(_reduced(level, shown) for level in model.levels)
        check = None if model.far_boundary_check is None else _reduced(model.far_boundary_check)
        longer = tuple(map(_reduced, model.longer_increments))
        runs[name] = ModelRun(name, levels, check, longer)
    data = {name: study.data for name, study in run.findings.items() if study.data is not None}
    if MODEL_ERROR in data:
        shown = {friction: _reduced(level, [level]) for friction, level in wholes.items()}
        data[MODEL_ERROR] = replace(data[MODEL_ERROR], wholes=shown, solutions={})
    surface = run.problem.surface
    if surface.info is not None:
        # the trace as read stands in record.json; the file that it came from is not everybody's
        surface = replace(surface, info=replace(surface.info, path=None, trace=None))
    return replace(run.solved, problem=replace(run.problem, surface=surface), runs=runs), data


def _reduced(level: Level, shown: Sequence[Level] = ()) -> Level:
    """A level without its mesh, and without fields where it is not among those that are shown."""
    stresses, with_fields = [], any(level is kept for kept in shown)
    for stress in level.stresses:
        field = _shown_field(stress.field) if with_fields else None
        stresses.append(replace(stress, field=field))
    further = tuple(_reduced(deeper, shown) for deeper in level.further)
    return replace(level, stresses=tuple(stresses), mesh=None, mesh_field=None, further=further)


def _shown_field(field: StressState) -> ShownField:
    return ShownField(*(getattr(field, f.name).astype(np.float32) for f in fields(ShownField)))


def _with_mesh(run: Run, path: Path) -> Run:
    """The run with the finite elements' mesh in its place."""
    model = run.runs.get("finite_element")
    if model is None:
        return run
    from meshes.msh_file import read_msh

    try:
        mesh = read_msh(path)
    except FileNotFoundError:
        raise InputError(f"{path}: is missing; {REMEDY}") from None
    except Exception as error:  # of a file that was cut short meshio may say anything
        raise InputError(f"{path}: cannot be read: {str(error)[:LONGEST]}; {REMEDY}") from None
    model = replace(model, levels=(*model.levels[:-1], replace(model.finest, mesh=mesh)))
    return replace(run, solved=replace(run.solved, runs={**run.runs, model.name: model}))
