"""Expected time of a run: said once it is known, and written beside its levels as it goes on."""

from collections.abc import Sequence
from contextlib import suppress
from datetime import datetime
from pathlib import Path

from comparisons.common.files import write_whole
from comparisons.common.numbers import with_unit
from comparisons.common.progress import Lasting, ProgressCallback
from comparisons.common.tasks import Tasks
from comparisons.judging.study import Solved
from comparisons.models.plan import forecast
from comparisons.studies import STUDIES

LONG = 60.0  # seconds, by the laws of cost, from which somebody looks what a run is doing
PROGRESS = "progress.txt"
# Beginnings of the tasks' keys; all others are of studies.
PARTS = {
    "both models": ("half_plane-", "finite_element-"),
    "what the half-plane leaves out": ("whole-", "part-"),
    "studies": ("",),
}


def expected(scene: Solved, tasks: Tasks) -> list[str]:
    """Lines on the time of a run's known tasks, on all cores and of the processor, by the laws of
    cost; its levels; why a study is left out."""
    open_tasks, parts = tasks.left(), []
    for name, beginnings in PARTS.items():
        mine = [key for key in open_tasks if key.startswith(beginnings)]
        seconds = sum(open_tasks.pop(key).seconds for key in mine)
        parts += [f"{name} {with_unit(seconds, 's', 2)}"] if seconds else []
    at_once = "1 core" if tasks.at_once == 1 else f"{tasks.at_once:g} cores"
    clock = tasks.seconds_left()
    clock = "less than 1 s" if clock < 1.0 else f"about {with_unit(clock, 's', 2)}"
    of_processor = f"; of the processor: {', '.join(parts)}" if parts else ""
    lines = [f"planned: {clock} on {at_once}{of_processor}"]
    lines.append(forecast(scene.problem, scene.plan).text)
    for study in STUDIES:
        if study.applies(scene) and (why_not := study.needs(scene)) is not None:
            lines.append(f"{study.name} is left out: it {why_not}")
    return lines


def told(
    folder: Path | None, said: Sequence[str], tasks: Tasks, callback: ProgressCallback
) -> ProgressCallback:
    """The callback, which has said what is expected of the tasks, and also writes to `progress.txt`
    in the folder: when the run began, what is expected, and each stage as it begins, with its time
    and the share that is done. Of a run that is expected to be short, and without a folder, what
    comes back is `callback` itself."""
    if tasks.seconds_left() < LONG:
        callback(said[0])
        return callback
    began = f"{datetime.now():%Y-%m-%d %H:%M:%S}"
    if folder is None:
        callback(Lasting(f"{began}: {said[0]}"))
        return callback
    path = folder / PROGRESS
    callback(Lasting(f"{began}: {said[0]}; what is done is in {path}"))
    write_whole(path, "\n".join([f"started {began}", *said, ""]))

    def tell(stage: str) -> None:
        callback(stage)
        share = f"{stage.done:.0%}" if hasattr(stage, "done") else ""
        with suppress(OSError), path.open("a", encoding="utf-8") as file:
            file.write(f"{datetime.now():%H:%M:%S} {share:>4} {stage}\n")

    return tell
