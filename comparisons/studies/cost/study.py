"""All methods at all their settings, measured one after the other; what fails is a row as well."""

from collections.abc import Callable
from dataclasses import dataclass

from comparisons.common.cache import Cache
from comparisons.common.numbers import with_unit
from comparisons.common.processes import Call, ProcessEnded, fresh_process
from comparisons.common.progress import ProgressCallback, Step, within
from comparisons.models.problem import Problem
from comparisons.studies.cost.cache import name_of
from comparisons.studies.cost.measure import Measured, Refused, Task, measure
from comparisons.studies.cost.methods import (
    METHODS,
    MOST_DENSE,
    Method,
    is_half_plane_problem,
    why_not,
)

# Of a setting's time over the one before.
GROWTH = {"half_plane": 2.5, "finite_element": 3.5}
DENSE_GROWTH = 8.0
# Parts of budget.time, in seconds of the processor, by which each method is done; what one leaves
# the next ones have.
SHARES = (0.03, 0.08, 0.15, 0.2, 0.35, 0.55, 0.75, 0.9)
MOST_OF_REST = 0.25  # that the goes of one setting may take before they are enough
OK, FAILED, SKIPPED = "ok", "failed", "skipped"

# What a task gives; None where its process ended.
Ask = Callable[[Task], Measured | Refused | None]


@dataclass(frozen=True)
class Row:
    """A method at a setting.

    setting   pitch [m] or tolerance; None: the method does not apply
    status    ok | failed | skipped      because  why not ok
    """

    method: Method
    setting: float | None
    status: str
    because: str | None = None
    measured: Measured | None = None

    def seconds(self, stresses: bool) -> float:
        """Of the processor, to the contact alone or to the stresses too."""
        own = self.measured.seconds
        return sum(s for name, s in own.items() if stresses or name != "stresses")

    @property
    def label(self) -> str:
        """The setting in words."""
        if self.setting is None:
            return "–"
        if self.method.adapted:
            return f"to {self.setting:.3g}"
        return with_unit(self.setting, "m", 3)


@dataclass(frozen=True)
class Study:
    """All rows, by method and from coarse to fine, and by method's name what the coarsest setting
    gives with the far boundary at half its distance, where that is needed."""

    rows: tuple[Row, ...]
    far_boundary_check: dict[str, Measured]

    def of(self, name: str) -> tuple[Row, ...]:
        """The good rows of a method."""
        return tuple(r for r in self.rows if r.method.name == name and r.status == OK)


def measured_study(
    problem: Problem,
    repeats: int,
    store: Cache,
    callback: ProgressCallback,
    methods: tuple[Method, ...] = METHODS,
) -> Study:
    """Measure what `store` lacks, and keep it there; in a fresh process for each method, whose
    memory is its own, on one thread."""
    spent, rows, check = 0.0, [], {}
    shares = SHARES[-len(methods) :]
    for number, (share, method) in enumerate(zip(shares, methods, strict=True)):
        because = why_not(method, problem)
        if because is not None:
            rows.append(Row(method, None, SKIPPED, because))
            continue
        left = share * problem.scene.budget.time - spent
        with fresh_process() as call:
            ask = _asked(store, call)
            part = within(callback, number / len(methods), (number + 1) / len(methods))
            found = _series(method, problem, repeats, left, ask, part)
            if _wants_far_boundary_check(method, problem) and found[0].status == OK:
                task = _task(problem, method, found[0].setting, 1, 0.0, half_block=True)
                again = ask(task)
                if isinstance(again, Measured):
                    check[method.name] = again
        rows += found
        spent += sum(row.measured.spent for row in found if row.measured is not None)
    return Study(tuple(rows), check)


def _series(
    method: Method,
    problem: Problem,
    repeats: int,
    left: float,
    ask: Ask,
    callback: ProgressCallback,
) -> list[Row]:
    """The rows of a method, in the seconds of the processor that are left for it."""
    rows, settings, lost = [], method.settings(problem), None
    growth = DENSE_GROWTH if method.dense else GROWTH[method.model]
    expected = 0.0
    for number, setting in enumerate(settings, start=1):
        label = Row(method, setting, OK).label
        name = f"{method.name}: {label} ({number} of {len(settings)})"
        callback(Step(name, (number - 1) / len(settings)))
        count = 0 if method.adapted else problem.grid(setting).count
        if lost is not None:
            rows.append(Row(method, setting, SKIPPED, lost))
        elif method.dense and count > MOST_DENSE:
            because = f"{count} elements; a dense matrix is made of at most {MOST_DENSE}"
            rows.append(Row(method, setting, SKIPPED, because))
        elif expected > left:
            because = (
                f"{expected:.2g} s are more than is left of this method's part of "
                f"{problem.scene.budget.time:g} s (budget.time)"
            )
            rows.append(Row(method, setting, SKIPPED, because))
        else:
            limit = MOST_OF_REST * max(left, 0.0)
            found = ask(_task(problem, method, setting, repeats, limit))
            rows.append(_row(method, setting, found))
            if found is None:
                lost = "the process that measured had ended"
            elif isinstance(found, Measured):
                left -= found.spent
                expected = growth * found.total
    return rows


def _row(method: Method, setting: float, found: Measured | Refused | None) -> Row:
    if found is None:
        return Row(method, setting, FAILED, "the process that measured it ended")
    if isinstance(found, Refused):
        return Row(method, setting, SKIPPED if found.skipped else FAILED, found.because)
    if not found.answer.converged:
        return Row(method, setting, FAILED, "did not converge", found)
    return Row(method, setting, OK, None, found)


def _asked(store: Cache, call: Call) -> Ask:
    """What the store has of a task, else measured by the process that is called, and kept."""

    def ask(task: Task) -> Measured | Refused | None:
        found = store.load(name_of(task))
        if found is None:
            found = _carried_out(call, task)
            if isinstance(found, Measured):
                store.save(name_of(task), found)
        return found

    return ask


def _carried_out(call: Call, task: Task) -> Measured | Refused | None:
    try:
        return call(measure, task)
    except ProcessEnded:
        return None


def _task(
    problem: Problem,
    method: Method,
    setting: float,
    repeats: int,
    limit: float,
    half_block: bool = False,
) -> Task:
    prescribed = problem.scene.load.kind == "approach"
    load = problem.hertz.load_per_length if prescribed else None
    return Task(problem.scene, load, method.name, setting, repeats, limit, half_block)


def _wants_far_boundary_check(method: Method, problem: Problem) -> bool:
    """Whether the finite elements are a reference, whose far boundary counts."""
    scene = problem.scene
    unbounded = scene.thickness is None or scene.width is None
    plain = method.model == "finite_element" and not method.adapted
    return plain and unbounded and not is_half_plane_problem(problem)
