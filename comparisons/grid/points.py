"""Many scenes, one table: the points of a grid of scenes, and who solves them.

In: axes, which are names with values, and how a scene takes one value of each. Out: what solving
finds at every combination, in order, the last axis inside. A point is a task, the work of one
process on one thread; it is on disk as soon as it is done."""

import itertools
import math
import os
from abc import abstractmethod
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from comparisons.common.cache import Cache
from comparisons.common.errors import ExitStatus, InputError, SceneError, one_line
from comparisons.common.executors import cluster
from comparisons.common.files import check_writable, publish
from comparisons.common.numbers import is_whole
from comparisons.common.processes import ProcessWorker, cores
from comparisons.common.progress import ProgressCallback, Step
from comparisons.common.provenance import as_json, key_of, program_code, versions
from comparisons.common.tasks import ProcessEnded, Tasks, called
from comparisons.drawing.style import NamedPictures, svgs
from comparisons.output.terminal import Printed
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import scene_key, surface_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SOLVED, FAILED = "solved", "failed"
UNCONVERGED = "not converged"  # verdict of a run
DIED = "the process that solved it died"
SCENE, TRACE = "scene", "profile.file"  # axes of several scenes, and of several traces
FILE_AXES = SCENE, TRACE

Value = float | str
Asked = str | tuple[str, ...]


@dataclass(frozen=True)
class Point:
    """One scene of a grid."""

    at: Mapping[str, Value]  # by axis
    asked: Asked  # models, or a quantity: what is asked there
    scene: Scene | None  # None where there is none with these values
    why: str | None  # why there is none
    key: str  # hash of everything that shapes the result


@dataclass(frozen=True)
class Request:
    """A grid that is asked for: the content of its JSON file but for what is found, and the points
    in their order."""

    content: dict
    points: tuple[Point, ...]


def points_of(
    axes: Mapping[str, Sequence[Value]],
    scene_at: Callable[[Mapping[str, Value]], Scene],
    asked: Asked,
    code: Sequence[str],
) -> tuple[Point, ...]:
    """Every combination of the axes' values, those of the last one inside.

    scene_at  the scene with these values; raises InputError where there is none
    code      modules and folders of the project whose code shapes the results
    Raises SceneError for a value with which there is no scene."""
    program = [versions(), program_code(*code), asked]
    points = []
    for values in itertools.product(*axes.values()):
        at, scene, why, shape = dict(zip(axes, values, strict=True)), None, None, []
        try:
            scene = scene_at(at)
            shape = scene_key(scene, surface_of(scene, standard=False))
        except InputError as error:
            scene, why = None, str(error)
        points.append(Point(at, asked, scene, why, key_of(program, shape, why)[:24]))
    refuse_values(points, {point.key: point.why for point in points})
    return tuple(points)


def refuse_values(points: Sequence[Point], whys: Mapping[str, str | None]) -> None:
    """Raise SceneError for a value of an axis that no point may have; of files only where all are
    wrong: one that is wrong among others fails alone.

    whys  by the points' keys: why they may not be, None of those that may"""
    for axis in points[0].at:
        by_value: dict[str, list[str | None]] = {}
        for point in points:
            by_value.setdefault(str(point.at[axis]), []).append(whys.get(point.key))
        wrong = {value: reasons[0] for value, reasons in by_value.items() if all(reasons)}
        if wrong and (axis not in FILE_AXES or len(wrong) == len(by_value)):
            value, why = next(iter(wrong.items()))
            raise SceneError(f"{why} (at {axis} = {value})")


Solve = Callable[[Point], dict]  # the result at a point that has a scene
WhyNot = Callable[[Point], str | None]  # why a point cannot be solved, None where it may


def failed(why: object, is_wrong: bool = False) -> dict:
    """The result where there is none; `is_wrong`: there is no such scene, or it cannot be posed."""
    return {"status": FAILED, "why": one_line(str(why) or type(why).__name__), "wrong": is_wrong}


def failures(points: Iterable[dict]) -> Counter[str]:
    """How many of a campaign's points failed, by why."""
    return Counter(point["why"] for point in points if point["status"] == FAILED)


@dataclass(frozen=True, repr=False)
class Grid(Printed):
    """Results at all points: `content` of its JSON file, in `folder` if it was kept."""

    FILES: ClassVar[tuple[str, ...]]  # that there may be, the JSON file first

    content: dict
    folder: Path | None

    @property
    def exit_status(self) -> ExitStatus:
        """3 where a solver did not converge, or found nothing, at a point."""
        unsolved = any(
            point.get("verdict") == UNCONVERGED
            or (point["status"] == FAILED and not point["wrong"])
            for point in self.content["points"]
        )
        return ExitStatus.NOT_CONVERGED if unsolved else ExitStatus.DONE

    @abstractmethod
    def pictures(self) -> "dict[str, Callable[[], Figure]]":
        """Functions that draw each picture, by name."""

    def texts(self) -> dict[str, str]:
        """Contents of the other files, by name."""
        return {self.FILES[0]: as_json(self.content)}

    @property
    def plot(self) -> NamedPictures:
        """`plot.NAME()` for each of `pictures`."""
        return NamedPictures(**self.pictures())

    def told(self) -> list[str]:
        """How many points failed, by why, and the files that were written."""
        whys = failures(self.content["points"])
        lines = [f"failed, {count}: {why}" for why, count in whys.most_common()]
        if self.folder is None:
            return lines
        there = [str(self.folder / name) for name in self.FILES if (self.folder / name).is_file()]
        return [*lines, f"written: {', '.join(there)}"]

    def write(self, folder: str | os.PathLike) -> None:
        """Write the files into a folder."""
        drawn = svgs({f"{name}.svg": draw for name, draw in self.pictures().items()})
        publish(Path(folder), self.texts() | drawn, self.FILES)


@contextmanager
def tasks_by(workers: int | str | None, kept: Cache) -> Iterator[Tasks]:
    """Tasks on so many processes, one a core (None), or on a Dask cluster, by its address. Raises
    InputError for other workers."""
    text = str(cores() if workers is None else workers)
    if is_whole(text):
        if int(text) < 1:
            raise InputError(f"--workers: is {text}; allowed is from 1 on")
        with Tasks(ProcessWorker, int(text), kept) as tasks:
            yield tasks
        return
    if "://" not in text:
        raise InputError(
            f"--workers: is {text!r}; allowed is a number, or a Dask scheduler's address "
            "such as tcp://host:8786"
        )
    with cluster(text) as opens, Tasks(opens, math.inf, kept) as tasks:
        yield tasks


def solved_in(
    out: Path,
    files: tuple[str, ...],
    points: Sequence[Point],
    solve: Solve,
    workers: int | str | None,
    callback: ProgressCallback,
    why_not: WhyNot = lambda point: point.why,
) -> list[dict]:
    """The result at every point. Points that `out` has are not solved again, others are kept there;
    one that kills its process has failed.

    files    that are to be written in `out`; the points are kept under the first one's name
    workers  as `tasks_by` takes them
    why_not  what is known before any is solved
    Raises InputError for what cannot be written, SceneError for a value that no point may have."""
    what, keys = files[0].partition(".")[0], {point.key: point for point in points}
    cache = Cache(out / f"{what}_points", "", {})
    with tasks_by(workers, cache) as tasks:
        check_writable(out, files)
        left, whys = [key for key in keys if cache.load(key) is None], {}
        for number, key in enumerate(left, start=1):
            callback(Step(f"{what}: checking {number} of {len(left)} points", 0.0))
            whys[key] = why_not(keys[key])
        refuse_values(points, whys)
        for key, why in whys.items():
            if why is not None:
                cache.save(key, failed(why, is_wrong=True))
        callback(Step(f"{what}: 0 of {len(keys)} points", 0.0))
        for point in points:
            tasks.add(point.key, called, answered, solve, point, seconds=1.0)
        for number, key in enumerate(tasks.as_done(keys), start=1):
            try:
                tasks.result(key)
            except ProcessEnded:
                cache.save(key, failed(DIED))
            callback(Step(f"{what}: {number} of {len(keys)} points", number / len(keys)))
    return [cache.load(point.key) for point in points]


def answered(solve: Solve, point: Point) -> dict:
    """The result at a point. What is refused, and what solvers and numbers run into, is a result;
    what is wrong with the machine is raised."""
    try:
        return solve(point)
    except (ValueError, ArithmeticError, RuntimeError) as error:
        return failed(error, isinstance(error, InputError))
