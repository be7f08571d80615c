"""crosscheck's steps as plain functions, for notebooks and scripts: scene in, result out.

    from comparisons import api

A scene is the name of one that comes along, the path of a TOML file, or its tables as a dict:

>>> scene = {
...     "title": "Steel on steel",
...     "roller": {"radius": "8.2 mm", "youngs_modulus": "207 GPa", "poissons_ratio": 0.3},
...     "body": {"youngs_modulus": "207 GPa", "poissons_ratio": 0.3},
...     "load": {"hertz_peak_pressure": "1 GPa", "friction": [0.0, 0.1]},
...     "stress": {"points": [60, 20]},
... }
>>> found = run(scene, models="half-plane")
>>> peak = found.figure("peak_pressure", "half_plane", friction=0.1)
>>> round(peak.value / 1e9, 4)
1.0

Results print as the tables of the command line; in a notebook they are shown as such. All figures
are those of `result.json`, in SI units. Nothing is written unless a folder is given.

>>> print(found)  # doctest: +ELLIPSIS
Steel on steel
...
peak pressure   0, 0.1  1.000 GPa ...

`found.plot` draws, `found.rows` is a table for pandas: `pandas.DataFrame(found.rows)`.

>>> axes = found.plot.pressure()
>>> axes[0].get_ylabel()
'p/p₀'
>>> [round(r["half_plane"], 3) for r in found.rows if r["quantity"] == "contact_ratio"]
[1.0, 1.0]"""

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from comparisons.api.results import CostStudy, FigureTable, FinishedRun, Map, Sweep
from comparisons.common.errors import InputError
from comparisons.common.files import check_writable
from comparisons.common.progress import ProgressCallback, no_progress
from comparisons.common.units import describe
from comparisons.figures.quantity import MODELS, models_named
from comparisons.output.field_files import AUTOMATIC, FORMATS
from comparisons.scenes.files import find_scene, read_toml
from comparisons.scenes.scene import Scene, with_tolerance

__all__ = ["compare", "cost", "load", "map", "read", "report", "run", "sweep", "tables"]

AnyScene = Scene | Mapping | str | os.PathLike
"""A scene as loaded, as tables, by its name or by its path."""


def load(scene: AnyScene, tolerance: float | None = None) -> Scene:
    """The scene, checked, in SI units.

    scene      a name, a path, or tables as TOML has them (paths in them count from here)
    tolerance  relative, of all that is judged, in place of the scene's own
    Raises SceneError, one line, for anything that is wrong with it.

    >>> load("sinusoid").load.hertz_peak_pressure
    1000000000.0
    >>> load("smooth").changed("load.friction", 0.2).load.friction
    (0.2,)
    >>> load({"roller": {}})
    Traceback (most recent call last):
    comparisons.common.errors.SceneError: scene: roller.radius: is missing; allowed is a length \
above 0: a number in m or "8.2 mm"
    """
    if isinstance(scene, Mapping):
        scene = Scene.of(scene)
    elif isinstance(scene, str | os.PathLike):
        scene = Scene.read(scene)
    elif not isinstance(scene, Scene):
        allowed = "allowed is a name, a path, tables or what load returns"
        raise InputError(f"scene: is {describe(scene)}; {allowed}")
    return scene if tolerance is None else with_tolerance(scene, tolerance)


def tables(scene: str | os.PathLike) -> dict:
    """A scene's tables as its file has them, to be changed and run; a profile's file by its whole
    path, so that they hold anywhere.

    >>> changed = tables("smooth")
    >>> changed["load"]["friction"] = 0.2
    >>> load(changed).load.friction
    (0.2,)"""
    path = find_scene(scene)
    found = read_toml(path)
    profile = found.get("profile")
    if isinstance(profile, dict) and isinstance(profile.get("file"), str):
        profile["file"] = str((path.parent / profile["file"]).resolve())
    return found


def run(
    scene: AnyScene,
    models: str | Sequence[str] = MODELS,
    *,
    tolerance: float | None = None,
    out: str | os.PathLike | None = None,
    fields: str = AUTOMATIC,
    progress: ProgressCallback = no_progress,
) -> FinishedRun:
    """Solve a scene, compare the models, judge: what `crosscheck run` does.

    models    half-plane, finite-element, or both
    out       folder for the files of the run; None writes none
    fields    format of the stress fields in files: auto, vtu, vtkhdf, msh
    progress  gets each stage as it begins
    Raises SceneError for a wrong scene, SolverError where no solution is found.

    >>> steel = {"youngs_modulus": 210e9, "poissons_ratio": 0.3}
    >>> coarse = {
    ...     "roller": {"radius": 8e-3, **steel},
    ...     "body": steel,
    ...     "load": {"per_length": 1e6},
    ...     "tolerance": {"peak_pressure": 0.5, "contact_length": 0.5},
    ...     "resolution": {"pitch": "20 um", "levels": 2},
    ...     "finite_element": {"block": 20},
    ...     "budget": {"effects": False},
    ... }
    >>> found = run(coarse)
    >>> found.verdict
    'holds'
    >>> [figure.verdict for figure in found.figures.of(study="comparison")]
    ['agree', 'agree', None, None]"""
    from comparisons.runs.run import run as run_scene

    chosen = models_named(models, "models")
    place = _place(out, "out")
    if fields not in (words := (AUTOMATIC, *FORMATS)):
        raise InputError(f"fields: is {describe(fields)}; allowed is {', '.join(words)}")
    if place is not None:
        check_writable(place)
    return FinishedRun(run_scene(load(scene, tolerance), place, chosen, progress, fields))


def read(folder: str | os.PathLike) -> FinishedRun:
    """A run from the folder that it has left, without solving. InputError where there is none."""
    from comparisons.output.page.saved import read_run

    return FinishedRun(read_run(_place(folder, "folder")))


def compare(*runs: FinishedRun) -> FigureTable:
    """The figures of several runs, a row for each run, friction coefficient and quantity."""
    if not runs:
        raise InputError("compare: is given no run; allowed is at least one")
    return FigureTable(tuple(row for each in runs for row in each.rows))


def cost(
    scene: AnyScene,
    *,
    repeats: int = 3,
    out: str | os.PathLike | None = None,
    progress: ProgressCallback = no_progress,
) -> CostStudy:
    """Error against run time of every method that applies: what `crosscheck cost` does. It takes
    minutes. `out` keeps what was measured, and goes on from there."""
    from comparisons.campaigns.cost.cost import cost as measured

    if not isinstance(repeats, int):
        raise InputError(f"repeats: is {describe(repeats)}; allowed is a whole number from 1")
    with TemporaryDirectory() as scratch:
        place = _place(out, "out") or Path(scratch) / "cost"
        return CostStudy(measured(load(scene), place, repeats, progress))


def map(
    scene: str | os.PathLike,
    points: str = "8x8",
    *,
    x: str | None = None,
    y: str | None = None,
    quantity: str = "peak_pressure",
    workers: int | str | None = None,
    out: str | os.PathLike | None = None,
    progress: ProgressCallback = no_progress,
) -> Map:
    """The half-plane's model error over two dimensionless groups: what `crosscheck map` does.

    scene    a name or a path
    points   along x and y, "NxM"
    x, y     "GROUP" or "GROUP=FROM:TO"; by the scene by default
    workers  processes, one a core by default, or a Dask scheduler's address
    It takes minutes. `out` keeps each point, and goes on from there."""
    from comparisons.campaigns.maps.make import make_map
    from comparisons.campaigns.maps.request import request_of

    scene = os.fspath(scene) if isinstance(scene, os.PathLike) else scene
    given = {"scene": scene, "points": points, "x": x, "y": y, "quantity": quantity}
    for name, text in given.items():
        if not isinstance(text, str) and not (text is None and name in ("x", "y")):
            raise InputError(f"{name}: is {describe(text)}; allowed is a text")
    request = request_of(**given)
    with TemporaryDirectory() as scratch:
        place = _place(out, "out") or Path(scratch) / "map"
        content = make_map(request, place, workers, progress)
    return Map(content, None if out is None else place)


def sweep(
    scene: AnyScene,
    over: str | Sequence[str] | Mapping[str, Sequence[float | str]],
    models: str | Sequence[str] = "half-plane",
    *,
    workers: int | str | None = None,
    out: str | os.PathLike | None = None,
    progress: ProgressCallback = no_progress,
) -> Sweep:
    """One scene at many placements, loads, or values of any field: what `crosscheck sweep` does.

    over     "position=40", "FIELD=FROM:TO:N", "FIELD=A,B,C", several of them, or values by field
    workers  processes, one a core by default, or a Dask scheduler's address
    `out` keeps each point, and goes on from there.

    >>> steel = {"youngs_modulus": 210e9, "poissons_ratio": 0.3}
    >>> smooth = {"roller": {"radius": 8e-3, **steel}, "body": steel, "load": {"per_length": 1e6}}
    >>> found = sweep(smooth, {"load": [1e6, 4e6]}, workers=1)
    >>> peaks = [row["half_plane"] for row in found.rows if row["quantity"] == "peak_pressure"]
    >>> round(peaks[1] / peaks[0], 4)
    2.0"""
    from comparisons.campaigns.sweep.request import sweep_request
    from comparisons.campaigns.sweep.study import make_sweep

    if isinstance(over, Mapping):
        over = [f"{name}={','.join(f'{v}' for v in values)}" for name, values in over.items()]
    asked = [over] if isinstance(over, str) else list(over)
    request = sweep_request(load(scene), asked, models_named(models, "models"))
    with TemporaryDirectory() as scratch:
        folder = Path(scratch) / "sweep" if out is None else Path(out)
        content = make_sweep(request, folder, workers, progress)
    return Sweep(content, None if out is None else folder)


def report(found: FinishedRun, path: str | os.PathLike) -> Path:
    """Write the report of a run, one page that needs no network; returns its path. Raises
    InputError where there is no folder for it."""
    from comparisons.common.files import write_whole
    from comparisons.output.page.page import render

    path = _place(path, "path")
    if not path.parent.is_dir() or path.is_dir():
        raise InputError(f"{path}: is no place for a page; allowed is a file in a folder")
    write_whole(path, render(found.outcome))
    return path


def _place(given: object, name: str) -> Path | None:
    """An argument that names a file or folder; None where it is."""
    if given is not None and not isinstance(given, str | os.PathLike):
        raise InputError(f"{name}: is {describe(given)}; allowed is a path")
    return None if given is None else Path(given)
