"""Why the figures may be trusted: refinement, contact conditions, compliance, cost and record."""

import re
import shlex

from analytic.contact.problem import KKT_TOLERANCE
from comparisons.common.errors import one_line
from comparisons.common.numbers import integer, percent, plain, scale_of, significant, with_unit
from comparisons.drawing.blocks import TextTable
from comparisons.figures.figure import Figure
from comparisons.figures.quantity import HYPHENATED, LABELS, QUANTITIES, label
from comparisons.models.finite_element.compliance_check import ComplianceCheck
from comparisons.models.level import ModelRun
from comparisons.output.page.tables.convergence import row_name
from comparisons.output.page.tables.text import wording
from comparisons.studies import comparison, contact
from comparisons.studies.contact import values_of
from comparisons.studies.study import Run

ALL_LEVELS = "all levels together: time"


def convergence_tables(run: Run) -> list[TextTable]:
    """Every figure over the levels: one table a model, one for the norms of the difference."""
    tables = [_of_model(run, model) for model in run.runs.values()]
    if run.plan.compares:
        tables.append(_of_pair(run))
    return tables


def _of_model(run: Run, model: ModelRun) -> TextTable:
    check = model.far_boundary_check
    levels = [*model.levels, *([check] if check else [])]
    pitch = scale_of([model.levels[0].grid.pitch], "m")
    head = _head(model, with_check=True)
    rows = [
        ("pitch of the pressure elements", *(pitch.text(v.grid.pitch) for v in levels)),
        ("unknowns", *(integer(v.unknowns) for v in levels)),
        ("time", *(with_unit(sum(v.seconds.values()), "s", 3) for v in levels)),
    ]
    rows = [row + ("",) * (len(head) - len(row)) for row in rows]
    for friction in run.problem.scene.load.friction:
        checked = {} if check is None else values_of(check, run.problem, friction)
        for figure in _rows(run, contact.NAME, model.name, friction):
            known = [checked[figure.quantity]] if checked else []
            values = [*figure.levels, *known]
            scale = scale_of(values, QUANTITIES[figure.quantity].unit)
            numbers = (scale.text(value, 5) for value in values)
            name = row_name(run, figure.quantity, friction)
            rows.append((name, *numbers, *_parts(figure, model)))
    return TextTable(LABELS[model.name].capitalize(), head, tuple(rows))


def _of_pair(run: Run) -> TextTable:
    model, rows = run.runs["finite_element"], []
    for friction in run.problem.scene.load.friction:
        for figure in _rows(run, comparison.NAME, "half_plane", friction):
            shown = {"digits": 3, "signed": not QUANTITIES[figure.quantity].of_pair}
            numbers = (percent(value, **shown) for value in figure.levels)
            name = row_name(run, figure.quantity, friction)
            rows.append((name, *numbers, *_parts(figure, model)))
    return TextTable("Difference of both models", _head(model, with_check=False), tuple(rows))


def _rows(run: Run, study: str, source: str, friction: float) -> list[Figure]:
    """The figures of a study that have a row at a friction coefficient."""
    known = run.figures.of(study=study, source=source, friction=friction)
    return [
        figure
        for figure in known
        if figure.levels and row_name(run, figure.quantity, friction) and run.shows(figure.quantity)
    ]


def _head(run: ModelRun, with_check: bool) -> tuple[str, ...]:
    """`with_check`: the level of the far-boundary check is a column too."""
    checked = run.far_boundary_check is not None
    numbered = (f"level {k + 1}" for k in range(len(run.levels)))
    check = ["level 1, block halved"] if checked and with_check else []
    far = ["far boundary"] if checked else []
    increments = ["increments"] if run.longer_increments else []
    parts = "discretisation", "iteration", *far, *increments
    return ("", *numbered, *check, "order", *parts, "total")


def _parts(figure: Figure, run: ModelRun) -> tuple[str, ...]:
    """Observed order and parts of an uncertainty, those that the run has."""
    known, sizes = figure.uncertainty.convergence, figure.uncertainty.parts
    order = significant(known.order, 2) if known.order is not None else ""
    if known.behaviour != "monotone":
        order = f"{order} {known.behaviour}".strip()
    domain = [] if run.far_boundary_check is None else [sizes["domain"]]
    increments = [sizes["increments"]] if run.longer_increments else []
    parts = sizes["discretisation"], sizes["iteration"], *domain, *increments, figure.numerical
    return (order, *map(percent, parts))


def check_table(outcome: Run) -> TextTable:
    """The contact conditions on the finest level, evaluated once more after the solution."""
    runs = outcome.runs.values()
    rows = []
    for name, words in wording()["residuals"].items():
        values = [getattr(run.finest.solution.residuals, name) for run in runs]
        rows.append((words, *(significant(value, 2) for value in values)))
    converged = [all(level.solution.converged for level in run.levels) for run in runs]
    below = f"all below {significant(KKT_TOLERANCE, 1)} on every level"
    rows.append((below, *("yes" if each else "no" for each in converged)))
    return TextTable("", ("", *(LABELS[name] for name in outcome.runs)), tuple(rows))


def cost_table(outcome: Run) -> TextTable:
    """Iterations, unknowns and memory on the finest level, and the time of all levels."""
    columns = {name: _cost(outcome, run) for name, run in outcome.runs.items()}
    names = dict.fromkeys(name for cells in columns.values() for name in cells)
    names = [*(name for name in names if name != ALL_LEVELS), ALL_LEVELS]
    rows = tuple((name, *(cells.get(name, "") for cells in columns.values())) for name in names)
    return TextTable("", ("on the finest level", *(LABELS[name] for name in columns)), rows)


def _cost(outcome: Run, run: ModelRun) -> dict[str, str]:
    level, counts = run.finest, run.finest.solution.iterations
    # the half-plane's planned levels come first, so that theirs is its own memory; further ones
    # share the process with the finite elements
    last = len(outcome.problem.pitches) if run.name == "half_plane" else len(run.levels)
    memory = run.levels[min(last, len(run.levels)) - 1].peak_memory
    return {
        "time": with_unit(sum(level.seconds.values()), "s", 3),
        "unknowns": integer(level.unknowns),
        "pressure elements": integer(level.grid.count),
        **{f"contact solver: {k.replace('_', ' ')}": integer(n) for k, n in counts.items()},
        "peak memory of the process": with_unit(memory, "byte", 3),
        ALL_LEVELS: with_unit(sum(run.seconds.values()), "s", 3),
    }


def record_rows(outcome: Run) -> list[tuple[str, str]]:
    """Date, host and revision, versions, machine and hashes of the run."""
    record = outcome.record
    rows = [(name, value) for name, value in record.get("made", {}).items() if value]
    for part in ("versions", "machine"):
        rows.append((part, ", ".join(f"{n} {value}" for n, value in record[part].items() if value)))
    if record.get("seed") is not None:
        rows.append(("seed", str(record["seed"])))
    if record.get("profile"):
        rows.append(("SHA-256 of the profile", record["profile"]["sha256"]))
    hashes = record.get("hashes") or {}
    return rows + [(f"SHA-256 of {_hashed(name)}", value) for name, value in hashes.items()]


def _hashed(name: str) -> str:
    """What a hash of the record is of: a model's pressures, or another array."""
    for model, words in HYPHENATED.items():
        name = name.replace(f"{model}_", f"the {words} model's ")
    return name.replace("_", " ")


def refinement_text(outcome: Run) -> str:
    """Why refinement ended, with quantities in words."""
    text = outcome.solved.refinement
    for name in sorted(QUANTITIES, key=len, reverse=True):
        text = re.sub(rf"\b{name}\b", label(name), text)
    return text


def commands(outcome: Run) -> list[tuple[str, str]]:
    """What to type to get this again."""
    scene, plan = outcome.problem.scene, outcome.plan
    models = "" if plan.compares else f" --models {','.join(plan.models).replace('_', '-')}"
    return [
        ("repeats this run, in the folder of this page", "crosscheck rerun ."),
        ("draws this page again, in the same folder", "crosscheck report ."),
        ("runs the scene again", f"crosscheck run {shlex.quote(one_line(scene.source))}{models}"),
    ]


def operator_table(outcome: Run) -> TextTable | None:
    """Columns and waves of the finest level; None where nothing was checked."""
    check = _check(outcome)
    if check is None:
        return None
    head = ["", "difference", "far"]
    found, effect = check.nearest, check.half_plane
    if effect is not None:
        finite = " and ".join(f"the {name}" for name in check.finite)
        head.append(f"from the half-plane: what {finite} does")
    rows = [
        [f"column at x = {with_unit(c.x, 'm', 3)}", percent(c.difference), percent(c.beyond)]
        for c in found.columns
    ]
    for wave in found.waves:
        elements = plain(float(f"{wave.elements:.3g}"))
        row = f"waves of {with_unit(wave.length, 'm', 3)}, {elements} elements"
        rows.append([row, percent(wave.difference, signed=True), ""])
    if effect is not None:
        moved = [percent(c.difference) for c in effect.columns]
        moved += [percent(w.difference, signed=True) for w in effect.waves]
        rows = [[*row, cell] for row, cell in zip(rows, moved, strict=True)]
    verdict = wording()["compliance"][check.verdict][0]
    title = f"Finite elements' compliance before contact: {verdict}"
    return TextTable(title, tuple(head), tuple(map(tuple, rows)))


def operator_note(outcome: Run) -> str:
    """What the table says, and how it is read; empty without one."""
    check = _check(outcome)
    if check is None:
        return ""
    datum = "" if check.datum else ", a constant removed"
    because = check.because[0].upper() + check.because[1:]
    verdict, how = wording()["compliance"][check.verdict][1], wording()["how_to_read"]["compliance"]
    return f"{verdict} {because}. {how.format(datum=datum)}"


def _check(outcome: Run) -> ComplianceCheck | None:
    run = outcome.runs.get("finite_element")
    return None if run is None else run.finest.operator
