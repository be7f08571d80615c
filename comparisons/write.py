"""The files of a finished run: curves, fields, mesh, result, record, report."""

from pathlib import Path

import numpy as np

from analytic.plane_stress import PlaneStress
from comparisons.deformed import deformed_height
from comparisons.files import published
from comparisons.level import Level, ModelRun
from comparisons.outcome import Outcome
from comparisons.problem import Problem
from comparisons.rank import is_first
from comparisons.record import as_json
from comparisons.scene import ResolvedScene
from comparisons.stages import Listener


def write_files(outcome: Outcome, listener: Listener) -> None:
    """Write everything into the run's folder; whole files, all at the end, by one process."""
    if not is_first():
        return
    listener("writing results")
    with published(outcome.directory) as folder:
        for name, run in outcome.runs.items():
            (folder / name).mkdir()
            write_contact(folder / name / "contact.csv", outcome.problem, run.finest)
            if outcome.window is not None:
                write_stress(folder / name / "stress.vtu", outcome, run)
            if run.finest.mesh is not None:
                from meshes.store import write_msh

                write_msh(run.finest.mesh, folder / name / "mesh.msh")
        if outcome.problem.scene.worn is not None:
            write_run_in_profile(folder / "run_in_profile.csv", outcome.problem.scene)
        (folder / "result.json").write_text(as_json(outcome.result), encoding="utf-8")
        (folder / "record.json").write_text(as_json(outcome.record), encoding="utf-8")
        listener("drawing the report")
        from comparisons.report.page import render

        (folder / "report.html").write_text(render(outcome), encoding="utf-8")


def write_contact(path: Path, problem: Problem, level: Level) -> None:
    """contact.csv: position, pressure, gap and deformed height at every pressure element."""
    columns = np.column_stack(
        [
            level.grid.x,
            level.solution.pressure,
            level.solution.gap,
            deformed_height(problem, level),
        ]
    )
    np.savetxt(
        path,
        columns,
        delimiter=",",
        fmt="%.12g",
        header="x [m],pressure [Pa],gap [m],deformed height [m]",
        comments="",
    )


def write_run_in_profile(path: Path, scene: ResolvedScene) -> None:
    """run_in_profile.csv: the trace as it was given along x, its height before and after."""
    worn = scene.worn
    after = worn.profile.height
    columns = np.column_stack([worn.profile.x + scene.position, after + worn.lowering, after])
    np.savetxt(
        path,
        columns,
        delimiter=",",
        fmt="%.12g",
        header="x [m],height before running-in [m],height [m]",
        comments="",
    )


def write_stress(path: Path, outcome: Outcome, run: ModelRun) -> None:
    """stress.vtu: stresses at the model's own points, which lie in the plane y = 0.

    Arrays sx, sz, sy, txz, tau1, von_mises [Pa] for the first friction coefficient; further
    coefficients add arrays with the coefficient in the name. Where the body yields there are
    also what flow leaves behind when the roller is gone.
    """
    import meshio

    level, arrays = run.finest, {}
    nu = outcome.problem.scene.body.poissons_ratio
    if level.mesh_field is not None:
        plane, stresses = level.mesh_field.points, level.mesh_field.stresses
        cells, nu = level.mesh_field.triangles, level.mesh_field.poissons_ratio
        kind = "triangle6"
    else:
        x, z = np.meshgrid(outcome.window.x, outcome.window.z)
        plane = np.column_stack([x.ravel(), z.ravel()])
        stresses = {
            s.friction: PlaneStress(s.field.sx.ravel(), s.field.sz.ravel(), s.field.txz.ravel())
            for s in level.stresses
        }
        rows, columns = x.shape
        corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
        cells = np.column_stack([corner, corner + 1, corner + columns + 1, corner + columns])
        kind = "quad"
    points = np.column_stack([plane[:, 0], np.zeros(len(plane)), plane[:, 1]])
    for index, (friction, stress) in enumerate(stresses.items()):
        suffix = "" if index == 0 else f" (friction {friction:g})"
        for name, values in {
            "sx": stress.sx,
            "sz": stress.sz,
            "sy": stress.sy(nu),
            "txz": stress.txz,
            "tau1": stress.tau1,
            "von_mises": stress.von_mises(nu),
        }.items():
            arrays[name + suffix] = values
    if level.mesh_field is not None:
        arrays |= level.mesh_field.others
    meshio.write(path, meshio.Mesh(points, [(kind, cells)], point_data=arrays))
