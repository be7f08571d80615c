"""Error against run time: every solved level of every model beside the best figures there are.

In: a solved scene and what it was judged by. Out: a row for each level with its errors, seconds and
memory; the cheapest setting for each tolerance; one table and one picture.

Errors are relative, the largest of any friction coefficient, against the whole model; where nothing
was compared, against the finest level of the last model. No error below the reference's uncertainty
is known. Where the finite elements drop an assumption of the half-plane, its model error counts:
more time does not help. Every run shows the levels that it has solved, one of both models other
elements on the coarsest, too. `crosscheck cost` adds other operators, coarser and finer levels.
Seconds are those of the stages of a level."""

import math
import re
from collections.abc import Mapping
from itertools import takewhile
from operator import itemgetter
from typing import TYPE_CHECKING

from analytic.contact.problem import ContactError
from comparisons.common.errors import InputError, SolverError, defect, one_line
from comparisons.common.numbers import percent, percent_as_written, with_unit
from comparisons.common.tasks import LAST, Tasks
from comparisons.drawing import style
from comparisons.drawing.blocks import Block, Box, Note, Pictures, TextTable
from comparisons.drawing.curves import joint_legend
from comparisons.drawing.tables import stated_text
from comparisons.figures.figure import (
    Column,
    Figures,
    Findings,
    Series,
    Statement,
    columns_of,
    grouped,
)
from comparisons.figures.quantity import LABELS, MAIN, MODELS, QUANTITIES, WHOLE, label
from comparisons.judging import contact
from comparisons.judging.effects.catalogue import contained
from comparisons.judging.ladder import candidates
from comparisons.judging.rule import values_of
from comparisons.judging.study import LADDER, MODEL_ERROR, Run, Solved, Study
from comparisons.models.level import Level, flowing_contact
from comparisons.models.model import Model
from comparisons.models.problem import Problem
from fem.solver.mumps import FemError
from meshes.block import MeshError

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# What a method says that cannot solve a scene.
EXPECTED = InputError, SolverError, ContactError, FemError, MeshError
NAME, ROWS, CHEAPEST = "cost", "levels", "cheapest"  # study, and its series
LEAST = 1e-7  # smaller errors are drawn there
HEIGHT = 3.4  # inches, of the picture
MARKS = "oDv^<sPX"  # of models
KINDS = dict(zip(("analytic", "finite elements"), MODELS, strict=True))  # by solver
Levels = tuple[str, str, Mapping[float, Level]]  # model, kind, one model's level by friction
# Fields of finite elements that assume small, elastic strains.
LINEAR = {"finite_element.deformation": "linear", "finite_element.plastic": False}
COLUMNS = ("model", "kind", "pitch", "elements", "unknowns", "seconds", "peak_memory")
NOTE = """Errors are relative, the largest of any friction coefficient. Grey in the picture is what
is not known of the reference. A star is the cheapest setting that meets all tolerances, as every
finer one of its model does. Seconds are of one level, on one core."""


Methods = dict[Model, tuple[int, ...]]  # numbers of the levels that models are added on


def other_elements(problem: Problem, *numbers: int) -> Methods:
    """P1 and P3 on levels of these numbers; none where only P2 elements solve the scene."""
    own = LABELS["finite_element"]
    return {
        _method(f"{own}, {element}", sets={"finite_element.element": element}): numbers
        for element in (() if problem.scene.finite_element.nonlinear else ("P1", "P3"))
    }


def methods_of(problem: Problem) -> Methods:
    """Methods that `crosscheck cost` asks for and apply, beside what every run solves; level 0 is
    coarser than the first."""
    plane, own = LABELS["half_plane"], LABELS["finite_element"]
    half_plane = _method(plane, "analytic", problem.half_plane_effects)
    methods = {half_plane: (0, 4, 5), _method(own): (0,)} | other_elements(problem, 0, 1, 2)
    if problem.scene.finite_element.nonlinear:
        methods[_method(f"{own}, linear", sets=LINEAR)] = 1, 2
    for one in candidates.CANDIDATES:
        if held := one.carries(problem, contained(problem.scene), 0.0):
            methods[_method(f"{plane}, {one.label}", "analytic", held)] = 1, 2, 3
    return methods


def _method(
    label: str,
    solver: str = "finite elements",
    effects: frozenset[str] = frozenset(),
    sets: Mapping[str, object] = {},
) -> Model:
    return Model(f"cost-{'-'.join(label.split())}", solver, effects, label=label, sets=sets)


def begin(solved: Solved, tasks: Tasks) -> None:
    """Make known what is solved for this alone, while the finite elements are."""
    if tuple(solved.runs) == MODELS[:1]:
        _asked(solved, tasks)


def _asked(solved: Solved, tasks: Tasks) -> list[tuple[Model, int, str]]:
    """Models, numbers of levels and keys of their tasks, those that fit the budget of time."""
    problem, left, asked = solved.problem, solved.problem.time, []
    methods = other_elements(problem, 1) if solved.plan.compares else {}
    methods = methods_of(problem) if solved.all_methods else methods
    patches = flowing_contact(problem) if methods else None
    for model, numbers in methods.items():
        for number in numbers if KINDS[model.solver] in solved.plan.models else ():
            left -= model.cost(problem, number, patches).seconds
            if left > 0.0:
                key = model.announce(tasks, problem, number, patches, LAST)
                asked.append((model, number, key))
    return asked


def solve(solved: Solved, before: Mapping[str, Findings], tasks: Tasks) -> Findings:
    """A row a level. The reference's own has no error, nor has what a level does not know."""
    found, said = _levels_of_run(solved, before), []
    reference = found[-1]
    for model, number, key in _asked(solved, tasks):
        try:
            levels = tasks.result(key)
            converged = all(level.converged for level in levels.values())
            why = "" if converged else "did not converge"
        except Exception as error:  # costs its row alone
            why = one_line(str(error) if isinstance(error, EXPECTED) else defect(error))
        if why:
            pitch = with_unit(solved.problem.pitch_of(number), "m", 3)
            said.append(Statement("left out", f"{model.label} at {pitch}: {why}"))
        else:
            found.append((model.label, KINDS[model.solver], levels))
    words, exact, floors = _references(solved, before)
    rows = []
    for name, kind, levels in found:
        level = levels[max(levels)]
        size = level.grid.pitch, level.grid.count, level.unknowns
        took = sum(level.seconds.values()), level.peak_memory
        errors = {} if levels is reference[2] else _errors(solved, levels, exact)
        row = dict(zip(COLUMNS, (name, kind, *size, *took), strict=True))
        rows.append(row | {quantity: errors.get(quantity) for quantity in exact})
    rows.sort(key=lambda row: (row["model"], -row["pitch"]))
    measures = (f"{QUANTITIES[n].short} of {words}, known to {percent(floors[n])}" for n in exact)
    said += [Statement("reference", "; ".join(measures))] if exact else []
    units = {"pitch": "m", "seconds": "s", "peak_memory": "byte"}
    table = Series(ROWS, columns_of(rows, units), is_account=True)
    chosen = _chosen(rows, floors, solved.problem.scene.tolerances)
    return Findings((), (table, chosen), tuple(said), floors)


def _levels_of_run(solved: Solved, before: Mapping[str, Findings]) -> list[Levels]:
    """Levels of the run's models, and of the whole model if it is another: the last is the best."""
    levels, cases = [], solved.cases
    for name, run in solved.runs.items():
        for number in range(len(run.levels)):
            same = {case.friction: case.runs[name].levels[number] for case in cases}
            levels.append((LABELS[name], name, same))
    budget = before[MODEL_ERROR].data if MODEL_ERROR in before else None
    if budget is not None and budget.selection.added:
        wholes = {c.friction: whole for c, whole in zip(cases, budget.wholes, strict=True)}
        levels.append((LABELS[WHOLE], "finite_element", wholes))
    return levels


def _chosen(
    rows: list[dict], floors: Mapping[str, float], tolerances: Mapping[str, float]
) -> Series:
    """The cheapest settings for each tolerance, and for all of them."""
    tolerances = {name: size for name, size in tolerances.items() if name in floors}
    aims = [{n: t} for n, t in tolerances.items()] + [tolerances] * (len(tolerances) > 1)
    best = {}
    for aim in aims:
        words = (f"{QUANTITIES[n].short} to {percent_as_written(t)}" for n, t in aim.items())
        settings = []
        for row in cheapest(rows, aim, floors):
            pitch, seconds = with_unit(row["pitch"], "m", 3), with_unit(row["seconds"], "s", 2)
            settings.append(f"{row['model']} at {pitch}, {seconds}")
        best[", ".join(words)] = "; ".join(settings) or "none that is solved"
    chosen = {"aim": Column(tuple(best)), "setting": Column(tuple(best.values()))}
    return Series(CHEAPEST, chosen, is_account=True)


def _references(
    solved: Solved, before: Mapping[str, Findings]
) -> tuple[str, dict[str, list[float]], dict[str, float]]:
    """The whole model where it was judged, else the last model's finest level, in words; by
    quantity its figures [SI], one a friction coefficient, and their largest relative
    uncertainty."""
    words, known = f"the {LABELS[WHOLE]}", {}  # by quantity, values and figures as uncertain
    if LADDER in before:
        errors = Figures(before[MODEL_ERROR].figures).of(source="half_plane")
        unsure = Figures(before[LADDER].figures).of(source=WHOLE)
        for name in MAIN:
            mine, left = errors.of(quantity=name), unsure.of(quantity=name)
            if len(mine) == len(left) == len(solved.cases):
                known[name] = [error.scale for error in mine], left
    if not known:
        name, run = next(reversed(solved.runs.items()))
        words = f"{LABELS[name]} at {with_unit(run.finest.grid.pitch, 'm', 3)}"
        figures = Figures(before[contact.NAME].figures).of(source=name)
        every = {quantity: figures.of(quantity=quantity) for quantity in MAIN}
        known = {name: ([f.value for f in mine], mine) for name, mine in every.items() if mine}
    exact = {name: values for name, (values, _) in known.items()}
    floors = {name: max(f.numerical for f in left) for name, (_, left) in known.items()}
    return words, exact, floors


def _errors(
    solved: Solved, levels: Mapping[float, Level], exact: Mapping[str, list[float]]
) -> dict[str, float]:
    found = [values_of(levels[case.friction], case.problem) for case in solved.cases]
    return {
        name: max(abs(of[name] / best - 1.0) for of, best in zip(found, values, strict=True))
        for name, values in exact.items()
        if all(name in of for of in found)
    }


def cheapest(rows: list[dict], aim: Mapping[str, float], floors: Mapping[str, float]) -> list[dict]:
    """Row, of each kind of model, of the fewest seconds that meets the tolerances not by chance:
    all finer ones of its model do, and the finest of those with its assumptions; or none."""

    def meets(row: dict) -> bool:
        return all(row[name] + floors[name] <= most for name, most in aim.items())

    judged = [row for row in rows if None not in [row[name] for name in aim]]
    met: list[dict] = []
    for mine in grouped(judged, lambda row: row["model"]):
        like = [row for row in judged if _limit(row) == _limit(mine[0])]
        if meets(min(like, key=lambda row: row["pitch"])):
            met += takewhile(meets, reversed(mine))
    return [min(some, key=itemgetter("seconds")) for some in grouped(met, lambda row: row["kind"])]


def _limit(row: Mapping[str, object]) -> str:
    """The model to which a row's would converge."""
    return re.sub(", P[13]$", "", row["model"])


def table(findings: Findings) -> TextTable:
    """All rows, from coarse to fine."""
    columns = findings.table(ROWS).columns
    names = [name for name in columns if name in MAIN]
    errors = [["reference" if e is None else percent(e) for e in columns[n].values] for n in names]
    shown = ("model", "pitch", "seconds", "peak_memory")
    model, pitch, time, memory = (stated_text(columns[name]) for name in shown)
    head = ("model", "pitch", *map(label, names), "time", "memory")
    return TextTable("", head, tuple(zip(model, pitch, *errors, time, memory, strict=True)))


def notes(findings: Findings) -> list[str]:
    """Notes: what errors are measured by, what is left out, the cheapest for each tolerance."""
    said = [f"{one.name}: {one.text}" for one in findings.statements]
    chosen = findings.table(CHEAPEST).rows()
    return said + [f"cheapest for {row['aim']}: {row['setting']}" for row in chosen]


def blocks(run: Run) -> list[Block]:
    findings = run.findings[NAME]
    said = " ".join(f"{line[0].upper()}{line[1:]}." for line in notes(findings))
    shown = Box("on-screens", (Pictures((NAME,)),))  # too wide to be read on paper
    return [Block("cost", (shown, table(findings), Note(f"{NOTE} {said}")), "Cost")]


def picture(run: Run) -> style.Picture | None:
    """Error against seconds, a panel a quantity: a line a model, the tolerance, what the reference
    leaves unknown."""
    findings = run.findings[NAME]
    names = [name for name in findings.table(ROWS).columns if name in MAIN]
    if not names:
        return None
    from matplotlib.ticker import LogLocator

    drawn = style.figure(style.THIRD * len(names), HEIGHT)
    panels = drawn.subplots(1, len(names), sharex=True, sharey=True, squeeze=False)[0]
    for axes, name in zip(panels, names, strict=True):
        _draw(axes, run, name)
    rows, floors = findings.table(ROWS).rows(), findings.data.values()
    shown = [row[name] for row in rows for name in names if row[name] is not None]
    shown = [size for size in (*shown, *floors) if LEAST < size < math.inf] or [LEAST]
    panels[0].set(ylim=(0.3 * min(shown), 3.0 * max(shown)), ylabel="error / reference")
    for axis in (panels[0].xaxis, panels[0].yaxis):
        axis.set_major_formatter(style.in_powers_of_ten)
        # all nine take half of the picture's time
        axis.set_minor_locator(LogLocator(subs=(2.0, 5.0)))
    drawn.subplots_adjust(left=0.65 / drawn.get_figwidth(), right=0.985, bottom=0.15, top=0.76)
    joint_legend(drawn, 2 * len(names) - 1)
    said = "; ".join(notes(findings))
    return style.picture(drawn, f"Error against time of every solved level. {said}.", NOTE)


def _draw(axes: "Axes", run: Run, name: str) -> None:
    rows = [row for row in run.findings[NAME].table(ROWS).rows() if row[name] is not None]
    tolerance = run.problem.scene.tolerances.get(name)
    floor = run.findings[NAME].data[name]
    for model, mark in zip(dict.fromkeys(row["model"] for row in rows), MARKS, strict=False):
        mine = [row for row in rows if row["model"] == model]
        errors = [max(row[name], LEAST) for row in mine]
        look = {"linestyle": "-" if mine[0]["kind"] == "half_plane" else "--", "marker": mark}
        axes.plot([row["seconds"] for row in mine], errors, label=model, **look)
    if tolerance is not None:
        axes.axhline(tolerance, label="tolerance", **style.REFERENCE)
        stars = cheapest(rows, {name: tolerance}, {name: floor})
        look = {"linestyle": "none", "marker": "*", "markersize": 13, "color": "black"}
        places = [row["seconds"] for row in stars], [max(row[name], LEAST) for row in stars]
        axes.plot(*places, label="cheapest", zorder=3.0, **look)
    if LEAST < floor < math.inf:
        axes.axhspan(LEAST, floor, facecolor="#eceff1", zorder=0, label="reference uncertain")
    axes.set(xscale="log", yscale="log", xlabel="time [s]")
    axes.xaxis.set_label_coords(0.5, -0.15)  # as matplotlib, which measures all numbers for it
    axes.yaxis.set_label_coords(-0.16, 0.5)
    axes.set_title(label(name))


STUDY = Study(
    name=NAME,
    quantities={},
    solve=solve,
    begin=begin,
    blocks=blocks,
    pictures={NAME: picture},
)
