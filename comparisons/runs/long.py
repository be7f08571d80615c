"""What a long run says before it begins, and writes beside its finished levels as it goes on."""

from contextlib import suppress
from datetime import datetime
from pathlib import Path

from comparisons.common.files import write_whole
from comparisons.common.numbers import with_unit
from comparisons.common.progress import Lasting, ProgressCallback
from comparisons.models.forecast import Forecast

LONG = 60.0  # seconds, by the laws of cost, from which somebody looks what a run is doing
PROGRESS = "progress.txt"


def recorded(
    folder: Path | None, planned: Forecast, said: str, callback: ProgressCallback
) -> ProgressCallback:
    """The callback, which also writes to `progress.txt` in the folder: when the run began, what is
    said of it, what each of the levels to begin with is expected to take, and flow, and each stage
    as it begins, with its time and the share that is done. Of a run that is expected to be short,
    and without a folder, `callback` itself."""
    if planned.seconds_asked < LONG:
        return callback
    levels = ", ".join(
        f"level {number} {with_unit(level.seconds, 's', 2)}"
        for number, level in enumerate(planned.levels[: planned.asked], 1)
    )
    if planned.seconds_of_flow:
        levels += f", flow {with_unit(planned.seconds_of_flow, 's', 2)}"
    began = f"started {datetime.now():%Y-%m-%d %H:%M:%S}"
    expected = f"expected of one process: {levels}"
    if folder is None:
        callback(Lasting(f"{began}; {expected}"))
        return callback
    path = folder / PROGRESS
    callback(Lasting(f"{began}; {expected}; what is done is in {path}"))
    folder.mkdir(parents=True, exist_ok=True)
    solved = ", ".join(sorted(kept.stem for kept in folder.glob("*.npz"))) or "nothing"
    write_whole(path, f"{began}\n{said}\n{expected}\nsolved before: {solved}\n")

    def tell(stage: str) -> None:
        callback(stage)
        share = f"{stage.done:.0%}" if hasattr(stage, "done") else ""
        with suppress(OSError), path.open("a", encoding="utf-8") as file:
            file.write(f"{datetime.now():%H:%M:%S} {share:>4} {stage}\n")

    return tell
