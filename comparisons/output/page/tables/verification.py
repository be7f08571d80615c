"""Why the figures may be trusted: convergence and ASME V&V 20's terms, contact conditions, cost
and record.

In: a run, its figures with their levels. Out: sequences for pictures, and rows of text."""

import re
import shlex
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from operator import attrgetter
from pathlib import Path

from analytic.contact.problem import KKT_TOLERANCE
from comparisons.common.errors import one_line
from comparisons.common.numbers import (
    integer,
    listed,
    percent,
    percent_as_written,
    plain,
    scale_of,
    significant,
    with_unit,
)
from comparisons.common.provenance import PROJECT
from comparisons.drawing.blocks import Names, TextTable
from comparisons.figures.convergence import IRREGULAR, LOWEST_ORDER, REGULAR, Convergence
from comparisons.figures.figure import Figure, Figures, grouped
from comparisons.figures.quantity import (
    COMPARED,
    HYPHENATED,
    LABELS,
    MODELS,
    NORMS,
    QUANTITIES,
    error_text,
    label,
)
from comparisons.figures.uncertainty import COVERAGE
from comparisons.judging import comparison, contact
from comparisons.judging.effects.sampling import EFFECT as SAMPLING
from comparisons.judging.study import Run
from comparisons.models.level import ModelRun
from comparisons.studies import checks

ALL_LEVELS = "all levels together: time"
DIFFERENCE = "difference"  # of both models, in place of one
NO_DATA = "no data"
# Packages that a person who signs wants to know of.
TO_SIGN = ("name, place, date", "signature")  # by hand
SIGNED = ("crosscheck", "python", "numpy", "scipy", "fenics-dolfinx", "petsc4py", "gmsh")
PARTS = {
    "discretisation": "discretisation",
    "iteration": "iteration",
    "domain": "far boundary",
    "increments": "increments",
}
WORDING = tomllib.loads(Path(__file__).with_name("words.toml").read_text(encoding="utf-8"))
_BOUNDS = {"lowest": LOWEST_ORDER, "regular": REGULAR, "irregular": IRREGULAR}
_BOUNDS = {name: plain(value) for name, value in _BOUNDS.items()}
WORDS = tuple((term, text.format(**_BOUNDS)) for term, text in WORDING["convergence"].items())


@dataclass(frozen=True)
class JudgedSequence:
    """A judged figure over the levels, coarse to fine."""

    figure: Figure
    name: str  # quantity, with its friction coefficient where it depends on one
    source: str  # model's name, or DIFFERENCE
    pitches: tuple[float, ...]  # of the pressure elements [m]

    @property
    def known(self) -> Convergence:
        return self.figure.uncertainty.convergence

    @property
    def errors(self) -> list[float]:
        """Distance of each level from the extrapolated value, relative."""
        scale = 1.0 if self.source == DIFFERENCE else self.figure.scale
        return [abs(value - self.known.limit) / scale for value in self.figure.levels]


def judged_sequences(run: Run) -> list[JudgedSequence]:
    """In the order of quantities, then of friction coefficients and models."""
    sequences, frictions = [], run.problem.scene.load.friction
    judged = [name for name in QUANTITIES if name in run.problem.scene.tolerances]
    for quantity, friction in product(judged, frictions):
        name = row_name(run, quantity, friction)
        known = run.figures.of(quantity=quantity, friction=friction) if name else Figures()
        of_models = [known.one(study=contact.NAME, source=model) for model in MODELS]
        for figure in filter(None, (*of_models, known.one(study=comparison.NAME))):
            source = DIFFERENCE if figure.against else figure.source
            levels = run.runs[figure.against or figure.source].levels
            pitches = tuple(level.grid.pitch for level in levels)
            sequences.append(JudgedSequence(figure, name, source, pitches))
    return sequences


def row_name(run: Run, name: str, friction: float) -> str:
    """A quantity and its friction; what does not depend on that is empty but at the first."""
    frictions = run.problem.scene.load.friction
    if not COMPARED[name].needs_stress:
        return label(name) if friction == frictions[0] else ""
    return label(name) + (f", friction {plain(friction)}" if len(frictions) > 1 else "")


def judged_table(run: Run) -> TextTable | None:
    """Orders, extrapolated value and uncertainty of each judged figure; None where none is."""
    head = ("", "finest level", "extrapolated", "formal order", "observed order", "behaviour")
    head += ("safety factor", "discretisation", "coverage")
    rows = tuple(map(_judged, judged_sequences(run)))
    return TextTable("Judged figures under refinement", head, rows) if rows else None


def _judged(sequence: JudgedSequence) -> tuple[str, ...]:
    known = sequence.known
    return (
        f"{sequence.name}, {LABELS.get(sequence.source, sequence.source)}",
        *_texts(sequence.figure, (known.value, known.limit)),
        plain(known.formal_order),
        "none" if known.order is None else significant(known.order, 2),
        known.behaviour,
        "none" if known.safety_factor is None else plain(known.safety_factor),
        percent(sequence.figure.uncertainty.parts["discretisation"]),
        percent_as_written(COVERAGE),
    )


def validation_table(run: Run) -> TextTable | None:
    """Each judged model error as ASME V&V 20 names its parts; None where none is judged."""
    rows = []
    for error in run.model_errors:
        name, friction, inputs = error.quantity, error.friction, error.unknown.get(SAMPLING)
        several = len(run.problem.scene.load.friction) > 1  # a whole model's depends on it
        named = label(name) + (f", friction {plain(friction)}" if several else "")
        size, unsure = error_text(error.value, error.numerical), percent(error.numerical)
        by_inputs = "no trace" if inputs is None else percent(inputs)
        rows.append((named, size, unsure, by_inputs, NO_DATA))
    head = ("", "E", "u_num", "u_input", "u_D")
    return TextTable("In the terms of ASME V&V 20", head, tuple(rows)) if rows else None


def convergence_tables(run: Run) -> list[TextTable]:
    """Every figure over the levels: one table a model, one for the difference."""
    tables = [_of_model(run, model) for model in run.runs.values()]
    if run.plan.compares:
        tables.append(_of_difference(run))
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
    for name, figure in _rows(run, contact.NAME, model.name):
        case = run.solved.case(figure.friction)
        check = case.runs[model.name].far_boundary_check
        checked = {} if check is None else contact.values_of(check, case.problem)
        values = [*figure.levels, *([checked[figure.quantity]] if checked else [])]
        rows.append((name, *_texts(figure, values), *_parts(figure, model)))
    return TextTable(LABELS[model.name].capitalize(), head, tuple(rows))


def _of_difference(run: Run) -> TextTable:
    model, rows = run.runs["finite_element"], []
    for name, figure in _rows(run, comparison.NAME, "half_plane"):
        rows.append((name, *_texts(figure, figure.levels), *_parts(figure, model)))
    return TextTable("Difference of both models", _head(model, with_check=False), tuple(rows))


def _texts(figure: Figure, values: Sequence[float]) -> list[str]:
    """Values of a figure, or of a difference, on its levels."""
    if figure.against is not None:
        signed = figure.quantity not in NORMS
        return [percent(value, digits=3, signed=signed) for value in values]
    scale = scale_of((*figure.levels, *values), QUANTITIES[figure.quantity].unit)
    return [scale.text(value, 5) for value in values]


def _rows(run: Run, study: str, source: str) -> list[tuple[str, Figure]]:
    """The figures of a study that have a row, each with its name there."""
    named = [
        (row_name(run, figure.quantity, friction), figure)
        for friction in run.problem.scene.load.friction
        for figure in run.figures.of(study=study, source=source, friction=friction)
        if figure.levels
    ]
    return [(name, figure) for name, figure in named if name]


def _head(model: ModelRun, with_check: bool) -> tuple[str, ...]:
    """`with_check`: the level of the far-boundary check is a column too."""
    numbered = (f"level {k + 1}" for k in range(len(model.levels)))
    has_check = with_check and model.far_boundary_check is not None
    check = ["level 1, block halved"] if has_check else []
    return ("", *numbered, *check, "order", *(PARTS[name] for name in _known(model)), "total")


def _known(model: ModelRun) -> list[str]:
    """Which of PARTS an uncertainty of the model has."""
    without = [] if model.far_boundary_check is not None else ["domain"]
    without += [] if model.longer_increments else ["increments"]
    return [name for name in PARTS if name not in without]


def _parts(figure: Figure, model: ModelRun) -> tuple[str, ...]:
    """Observed order, parts of the uncertainty, and all of it."""
    known, sizes = figure.uncertainty.convergence, figure.uncertainty.parts
    order = significant(known.order, 2) if known.order is not None else ""
    if known.behaviour != "monotone":
        order = f"{order} {known.behaviour}".strip()
    return (order, *(percent(sizes[name]) for name in _known(model)), percent(figure.numerical))


def check_table(run: Run) -> TextTable:
    """The contact conditions on the finest level, evaluated once more after the solution."""
    known, rows = run.figures.of(study=checks.NAME), []
    for same in grouped(known, attrgetter("quantity")):
        texts = (significant(figure.value, 2) for figure in same)
        rows.append((checks.QUANTITIES[same[0].quantity].label, *texts))
    models = run.runs.values()
    converged = [all(level.converged for level in model.levels) for model in models]
    below = f"all below {significant(KKT_TOLERANCE, 1)} on every level"
    rows.append((below, *("yes" if met else "no" for met in converged)))
    return TextTable("", ("", *(LABELS[name] for name in run.runs)), tuple(rows))


def cost_table(run: Run) -> TextTable:
    """Iterations, unknowns and memory on the finest level, and the time of all levels."""
    columns = [_cost(run, model) for model in run.runs.values()]
    names = dict.fromkeys(name for cells in columns for name in cells if name != ALL_LEVELS)
    rows = ((name, *(cells.get(name, "") for cells in columns)) for name in (*names, ALL_LEVELS))
    head = ("on the finest level", *(LABELS[name] for name in run.runs))
    return TextTable("", head, tuple(rows))


def _cost(run: Run, model: ModelRun) -> dict[str, str]:
    level, counts = model.finest, model.finest.solution.iterations
    # the half-plane's planned levels come first, so that theirs is its own memory; further ones
    # share the process with the finite elements
    last = len(run.problem.pitches) if model.name == "half_plane" else len(model.levels)
    memory = model.levels[min(last, len(model.levels)) - 1].peak_memory
    return {
        "time": with_unit(sum(level.seconds.values()), "s", 3),
        "unknowns": integer(level.unknowns),
        "pressure elements": integer(level.grid.count),
        **{_iterations(name): integer(count) for name, count in counts.items()},
        "peak memory of the process": with_unit(memory, "byte", 3),
        ALL_LEVELS: with_unit(sum(model.seconds.values()), "s", 3),
    }


def _iterations(name: str) -> str:
    """A count of the contact solver in words; `linear_`: of the solution that it starts from."""
    words, start = WORDING["iterations"], name.removeprefix("linear_")
    text = words.get(name) or words[start] + ", linear start" * (start != name)
    return f"contact: {text}"


def signed(run: Run) -> Names:
    """What a person signs who has read the report: the question, how sure, by what and when."""
    scene, made, errors = run.problem.scene, run.record.get("made", {}), run.model_errors
    judged = dict.fromkeys(
        f"{label(e.quantity)} within {percent_as_written(e.tolerance)}" for e in errors
    )
    question = (
        "May the half-plane's figures stand for those of a model with every effect that matters?"
    )
    if not errors:
        question = "What are the figures of this contact? Nothing is judged against a tolerance."
    solved = {n: v for n, v in run.record["versions"].items() if n in SIGNED and v}
    by = ", ".join(f"{name} {value}" for name, value in solved.items())
    rows = [
        ("scene", f"{scene.title} ({one_line(scene.source)})"),
        ("question", question),
        (
            "judged by",
            f"{', '.join(judged)}; friction {listed(scene.load.friction)}" if judged else "",
        ),
        ("uncertainty", f"every stated one covers {percent_as_written(COVERAGE)}"),
        ("solved by", ", ".join(filter(None, (by, f"revision {made.get('revision')}")))),
        ("made", ", ".join(made[name] for name in ("date", "host") if made.get(name))),
    ]
    rows = [row for row in rows if row[1]]
    return Names([*rows, *((name, "") for name in TO_SIGN)])


def record_rows(run: Run) -> list[tuple[str, str]]:
    """Date, host and revision, versions, machine and hashes of the run."""
    record = run.record
    rows = [(name, value) for name, value in record.get("made", {}).items() if value]
    for part in ("versions", "machine"):
        rows.append((part, ", ".join(f"{n} {value}" for n, value in record[part].items() if value)))
    if record.get("seed") is not None:
        rows.append(("seed", str(record["seed"])))
    if record.get("profile"):
        rows.append(("SHA-256 of the profile", record["profile"]["sha256"]))
    for name, value in (record.get("hashes") or {}).items():
        for model, words in HYPHENATED.items():
            name = name.replace(f"{model}_", f"the {words} model's ")
        name = name.replace("run_in_", "the run-in ").replace("_", " ")
        rows.append((f"SHA-256 of {name}", value))
    return rows


def refinement_text(run: Run) -> str:
    """Why refinement ended, with quantities in words."""
    text = run.solved.refinement
    for name in sorted(QUANTITIES, key=len, reverse=True):
        text = re.sub(rf"\b{name}\b", label(name), text)
    return text


def commands(run: Run) -> list[tuple[str, str]]:
    """What to type to get this again."""
    scene, plan = run.problem.scene, run.plan
    launcher = PROJECT / "crosscheck"  # of a checkout, which is on no path
    program = shlex.quote(str(launcher)) if launcher.is_file() else "crosscheck"
    models = "" if plan.compares else f" --models {','.join(plan.models).replace('_', '-')}"
    return [
        ("repeats this run, in the folder of this page", f"{program} rerun ."),
        ("prints this page, in the same folder", f"{program} report --pdf ."),
        ("runs the scene again", f"{program} run {shlex.quote(one_line(scene.source))}{models}"),
    ]
