"""The face: scenes in, results out, as plain functions; the command line and notebooks are thin
skins over it.

In: a `Scene`, or its name, path or tables. Out: results that print themselves, each with `figures`
as records, a `summary` of ten lines, the `exit_status` of its command, `write(folder)`, and `plot`
where it has pictures. Numbers are in SI units."""

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from comparisons.common.errors import InputError, check_finite_elements
from comparisons.common.files import check_writable, holds_comparison
from comparisons.common.progress import Lasting, ProgressCallback, no_progress
from comparisons.common.tasks import Opens
from comparisons.common.units import describe
from comparisons.figures.quantity import MODELS, models_named
from comparisons.judging.study import Run
from comparisons.output.flat_csv import FigureTable, tidy_rows
from comparisons.output.plausibility import warnings_about, warnings_about_result
from comparisons.output.result import Result, read_result
from comparisons.runs import run as runs
from comparisons.runs.finished import FinishedRun, MethodCosts
from comparisons.scenes.scene import Scene, with_law, with_tolerance
from comparisons.scenes.surface import surface_of

if TYPE_CHECKING:
    from comparisons.campaigns.cases import Campaign
    from comparisons.campaigns.decks.write import Deck
    from comparisons.grid.map import Map
    from comparisons.grid.sweep import Sweep
    from comparisons.runs.rerun import Repetition

AnyScene = Scene | Mapping | str | os.PathLike
"""A scene, its tables, its name or its path."""
Tolerance = float | str | None


def run(
    scene: AnyScene,
    models: str | Sequence[str] = MODELS,
    *,
    tolerance: Tolerance = None,
    law: str | None = None,
    out: str | os.PathLike | None = None,
    files: bool = True,
    workers: str | None = None,
    progress: ProgressCallback = no_progress,
) -> FinishedRun:
    """Solve a scene, compare the models, judge: what `crosscheck run` does.

    models     half-plane, finite-element, or both
    tolerance  relative, such as 0.05 or "5%", of all that is judged, in place of the scene's own
    law        of elasticity, of every elastic body, in place of their own
    out        folder for the files of the run; None writes none
    files      whether they are written now, or left to `write`: until then what is solved is kept
               beside the folder, and a run that is stopped goes on from there
    workers    a Dask scheduler's address: it solves the samples of [scatter]
    progress   gets each stage as it begins
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
    >>> both = run(coarse)
    >>> both.verdict
    'holds'
    >>> [figure.verdict for figure in both.figures.of(study="comparison")]
    ['agree', 'agree', None]"""
    from comparisons.common.executors import cluster

    chosen, asked = models_named(models), scene_of(scene, tolerance, law)
    with cluster(workers) if workers else nullcontext() as opens:
        solved = FinishedRun.of(_solved(asked, chosen, out, progress, opens))
    if files:
        solved.write(progress=progress)
    return solved


def cost(
    scene: AnyScene,
    *,
    out: str | os.PathLike | None = None,
    progress: ProgressCallback = no_progress,
) -> MethodCosts:
    """Error against run time of every method that applies: what `crosscheck cost` does, a run by
    all of them. It takes minutes. `out` keeps its files."""
    models = MODELS if find_spec("dolfinx") else MODELS[:1]
    solved = MethodCosts.of(_solved(scene_of(scene), models, out, progress, all_methods=True))
    solved.write(progress=progress)
    return solved


def plan(
    scene: AnyScene,
    models: str | Sequence[str] = MODELS,
    *,
    tolerance: Tolerance = None,
    law: str | None = None,
) -> list[str]:
    """Say what `run` would do, and how long it would take, in lines."""
    asked, chosen = scene_of(scene, tolerance, law), models_named(models)
    return runs.planned(asked, surface_of(asked), chosen)


def read(folder: str | os.PathLike) -> Result:
    """A run from the folder that it has left, without solving. InputError where there is none."""
    return read_result(Path(folder))


def rerun(
    folder: str | os.PathLike,
    *,
    out: str | os.PathLike | None = None,
    progress: ProgressCallback = no_progress,
) -> "Repetition":
    """Repeat a run from the folder that it has left: what `crosscheck rerun` does."""
    from comparisons.runs.rerun import rerun as repeat

    return repeat(Path(folder), None if out is None else Path(out), progress)


def table(*folders: str | os.PathLike) -> FigureTable:
    """The figures of all runs in or below folders, a row each."""
    return FigureTable(tidy_rows([Path(folder) for folder in folders]))


def compare(*runs: Result | Sequence[Result]) -> FigureTable:
    """The figures of runs, or of lists of them, a row each."""
    lists = (given if isinstance(given, list | tuple) else [given] for given in runs)
    return FigureTable([row for runs in lists for run in runs for row in run.figures.rows], "title")


def map(
    scene: str | os.PathLike,
    points: str | None = None,
    *,
    x: str | None = None,
    y: str | None = None,
    quantity: str | None = None,
    settings: Sequence[str] = (),
    mark: str | None = None,
    again: bool = False,
    workers: int | str | None = None,
    out: str | os.PathLike | None = None,
    progress: ProgressCallback = no_progress,
) -> "Map":
    """The half-plane's model error over two dimensionless groups: what `crosscheck map` does.

    scene     a name or a path, or the name of a finished map, which is shown as it is unless
              something else is asked of it, or `again`
    points    along x and y, "NxM"; 8x8 by default
    x, y      "GROUP" or "GROUP=FROM:TO"; by the scene by default
    quantity  to show; by default the finished map's, or the peak pressure
    settings  other values of fields of the scene, FIELD=VALUE each
    mark      name or path of a scene that is marked on the map
    workers   processes, one a core by default, or a Dask scheduler's address
    It takes minutes. `out` keeps each point, and goes on from there."""
    from comparisons.grid import map as grid
    from comparisons.grid.mark import problem_named, unlike

    name, marked = os.fspath(scene), None if mark is None else problem_named(mark)
    is_finished = name in grid.finished_names()
    as_it_is = not (again or settings) and (points, x, y, workers) == (None,) * 4
    if quantity is None:
        quantity = grid.finished_map(name)["quantity"] if is_finished else "peak_pressure"
    with _folder(out, "map") as folder:
        if is_finished and as_it_is:
            made = grid.show_finished(name, quantity, marked, folder)
        else:
            check_finite_elements()
            size = grid.SIZE if points is None else points
            request = grid.request_of(name, size, x, y, quantity, settings)
            made = grid.make_map(request, folder, workers, progress, marked)
    if marked and (why := unlike(made.content, marked)):
        why = f"{marked.scene.name} is not the map's scene: {why}"
        progress(Lasting(f"--mark: {why}; the map's errors are those of its own"))
    return made if out else replace(made, folder=None)


def sweep(
    scene: AnyScene | Sequence[AnyScene],
    over: str | Sequence[str] | Mapping[str, Sequence[float | str]] = (),
    models: str | Sequence[str] = "half-plane",
    *,
    workers: int | str | None = None,
    out: str | os.PathLike | None = None,
    progress: ProgressCallback = no_progress,
) -> "Sweep":
    """Several scenes, or one at many positions, loads, traces or values of any field: what
    `crosscheck sweep` does.

    over     "position=40", "FIELD=FROM:TO:N", "FIELD=A,B,C", "profile.file=FOLDER", several of
             them, or values by field
    workers  processes, one a core by default, or a Dask scheduler's address
    `out` keeps each point, and goes on from there.

    >>> steel = {"youngs_modulus": 210e9, "poissons_ratio": 0.3}
    >>> smooth = {"roller": {"radius": 8e-3, **steel}, "body": steel, "load": {"per_length": 1e6}}
    >>> loads = sweep(smooth, {"load": [1e6, 4e6]}, workers=1)
    >>> contact = [row for row in loads.figures.rows if row["study"] == "contact"]
    >>> peaks = [row["value"] for row in contact if row["quantity"] == "peak_pressure"]
    >>> round(peaks[1] / peaks[0], 4)
    2.0"""
    from comparisons.grid.sweep import make_sweep, sweep_request
    from comparisons.grid.table import warnings_of

    if isinstance(over, Mapping):
        over = [f"{name}={','.join(f'{v}' for v in values)}" for name, values in over.items()]
    asked = [over] if isinstance(over, str) else list(over)
    scenes = [scene_of(one) for one in (scene if isinstance(scene, list | tuple) else [scene])]
    chosen = models_named(models)
    request = sweep_request(scenes, asked, chosen)
    if "finite_element" in chosen:
        check_finite_elements()
    with _folder(out, "sweep") as folder:
        made = make_sweep(request, folder, workers, progress)
    _warn(warnings_of(made.content), progress)
    return made if out else replace(made, folder=None)


def verify(
    *,
    benchmarks: bool = False,
    out: str | os.PathLike | None = None,
    junit: Path | None = None,
    progress: ProgressCallback = no_progress,
) -> "Campaign":
    """Hold both models to exact solutions: what `crosscheck verify` does.

    benchmarks  published ones instead
    junit       file for JUnit XML"""
    from comparisons.campaigns.benchmarks import Benchmarks, cases
    from comparisons.campaigns.cases import carry_out
    from comparisons.campaigns.verify.run import verify as verify_all

    with _folder(out, "verify") as folder:
        if benchmarks:
            return carry_out("benchmarks", cases(), folder, junit, progress, Benchmarks)
        return verify_all(folder, junit, progress)


def stability(
    *,
    out: str | os.PathLike | None = None,
    junit: Path | None = None,
    progress: ProgressCallback = no_progress,
) -> "Campaign":
    """Solve stiff and extreme cases: what `crosscheck stability` does."""
    from comparisons.campaigns.cases import carry_out
    from comparisons.campaigns.robustness import all_cases

    with _folder(out, "stability") as folder:
        return carry_out("stability", all_cases(), folder, junit, progress)


def deck(
    scene: AnyScene, code: str, *, level: int = 1, out: str | os.PathLike | None = None
) -> "Deck":
    """A scene as input of another code, calculix or fenicsx: what `crosscheck deck` does.

    level  of the scene's refinement, 1 the coarsest, whose elements the contact gets"""
    from comparisons.campaigns.decks.write import make_deck

    made = make_deck(scene_of(scene), code, level)
    if out is not None:
        made.write(Path(out))
    return made


def scene_of(scene: AnyScene, tolerance: Tolerance = None, law: str | None = None) -> Scene:
    """The scene, checked. Raises SceneError, one line, for anything that is wrong with it.

    >>> scene_of("sinusoid").load.hertz_peak_pressure
    1000000000.0
    >>> scene_of({"roller": {"radius": "8"}})
    Traceback (most recent call last):
    comparisons.common.errors.SceneError: scene: roller.radius: is "8", which has no unit; allowed \
is a length above 0: a number in m or "8.2 mm"
    """
    if isinstance(scene, Mapping):
        scene = Scene.of(scene)
    elif isinstance(scene, str | os.PathLike):
        scene = Scene.read(scene)
    elif not isinstance(scene, Scene):
        allowed = "allowed is a name, a path, tables or a Scene"
        raise InputError(f"scene: is {describe(scene)}; {allowed}")
    if law is not None:
        scene = with_law(scene, law)
    return scene if tolerance is None else with_tolerance(scene, tolerance)


def _solved(
    scene: Scene,
    models: tuple[str, ...],
    out: str | os.PathLike | None,
    progress: ProgressCallback,
    opens: Opens | None = None,
    all_methods: bool = False,
) -> Run:
    folder = None if out is None else Path(out)
    if folder is not None:
        check_writable(folder)
        if len(models) == 1 and holds_comparison(folder):
            said = "this run of one model replaces a comparison; --out keeps both"
            progress(Lasting(f"{folder}: {said}"))
    surface = surface_of(scene)
    _warn(warnings_about(scene, surface), progress)  # before anybody waits for the solution
    known = runs.Known(surface, all_methods=all_methods)
    solved = runs.solve_scene(scene, folder, models, progress, opens, known)
    _warn(warnings_about_result(solved), progress)
    return solved


def _warn(warnings: Iterable[str], progress: ProgressCallback) -> None:
    for warning in warnings:
        progress(Lasting(f"plausibility warning: {warning}"))


@contextmanager
def _folder(out: str | os.PathLike | None, name: str) -> Iterator[Path]:
    """`out`, or a folder that goes at the block's end."""
    with TemporaryDirectory() as scratch:
        yield Path(scratch, name) if out is None else Path(out)
