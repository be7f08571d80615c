"""The files of a finished run: curves, fields, mesh, arrays, result; then the report."""

from collections.abc import Sequence
from dataclasses import replace
from importlib import import_module
from pathlib import Path

import numpy as np

from comparisons.common.errors import one_line
from comparisons.common.files import REPORT, published, write_whole
from comparisons.common.progress import ProgressCallback, Step
from comparisons.common.provenance import as_json
from comparisons.common.tasks import Here, tasks_of_copies
from comparisons.drawing.blocks import attempted
from comparisons.judging.study import Run
from comparisons.models.level import Level, deformed_height
from comparisons.output.arrays import FILE, RunArrays, levels_by_folder
from comparisons.output.field_files import field_of, scene_text, write_field
from comparisons.output.page import IMPORTS, PAGE
from comparisons.output.result import FILE as RESULT
from comparisons.output.result import result_of
from comparisons.studies import STUDIES
from meshes.block import BlockMesh


def write_files(outcome: Run, callback: ProgressCallback) -> bool:
    """Write the run's folder: everything but the report, whole and at once; then the report, which
    is drawn when nothing that goes wrong can cost a result. Whether it could be."""
    callback(Step("writing results", 0.0))
    with published(outcome.directory) as folder, tasks_of_copies(outcome, IMPORTS) as tasks:
        levels = levels_by_folder(outcome)
        meshed = {name: any(one.mesh for one in of.values()) for name, of in levels.items()}
        first, *others = sorted(levels, key=lambda name: not meshed[name])  # longest first
        for name in levels:
            (folder / name).mkdir(parents=True, exist_ok=True)
        # two lots: nobody hands out a third while this process writes
        tasks.add(first, _write_level, folder, first)
        tasks.add(FILE, _write_others, folder, others)
        for study in STUDIES:
            files = study.files(outcome) if study.name in outcome.findings else {}
            for path, columns in files.items():
                _write_csv(folder / path, ",".join(columns), *columns.values())
        found = result_of(outcome)
        for key in (first, FILE):
            tasks.result(key)
        files = [str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file()]
        record = found.record | {"files": sorted([*files, RESULT, REPORT])}
        write_whole(folder / RESULT, as_json(replace(found, record=record).result))
    callback("drawing the report")
    page = attempted("report", lambda: import_module(PAGE).render(outcome))
    if drawn := isinstance(page, str):
        write_whole(outcome.directory / REPORT, page)
    return drawn


def _write_others(here: Here, folder: Path, names: Sequence[str]) -> None:
    for name in names:
        _write_level(here, folder, name)
    RunArrays.of(here.shared).write(folder / FILE)


def _write_level(here: Here, folder: Path, name: str) -> None:
    """The files of a model's level."""
    outcome, folder = here.shared, folder / name
    levels = levels_by_folder(outcome)[name]
    level, *_ = levels.values()
    write_contact(folder / "contact.csv", outcome, level)
    if outcome.window is not None:
        write_field(folder / "stress.vtu", field_of(outcome, levels))
    if name.split("/")[0] in outcome.runs and level.mesh is not None:
        write_mesh(folder / "mesh.msh", outcome, level.mesh)


def write_mesh(path: Path, outcome: Run, mesh: BlockMesh) -> None:
    """mesh.msh: what was solved on, and the scene that it was made for."""
    from meshes.msh_file import write_msh

    problem = outcome.problem
    said = {"title": problem.scene.title, "units": "m", "scene": scene_text(problem)}
    write_msh(mesh, path, said)


def write_contact(path: Path, outcome: Run, level: Level) -> None:
    """contact.csv: a row for each pressure element, below what made it and of which scene."""
    problem, record = outcome.problem, outcome.record
    program = f"crosscheck {record['versions']['crosscheck']}"
    program += f", {record['made']['revision']}" if record["made"]["revision"] else ""
    columns = level.grid.x, level.solution.pressure, level.solution.gap
    head = f"# {program}: {one_line(problem.scene.title)}\n# scene: {scene_text(problem)}\n"
    head += "x [m],pressure [Pa],gap [m],deformed height [m]"
    _write_csv(path, head, *columns, deformed_height(problem, level))


def _write_csv(path: Path, head: str, *columns: np.ndarray) -> None:
    rows = np.column_stack(columns)
    np.savetxt(path, rows, delimiter=",", fmt="%.12g", header=head, comments="", encoding="utf-8")
