"""Evidence for the figures: convergence, contact conditions and record.

In: a run, its figures with their levels. Out: rows of text."""

import shlex
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path

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
from comparisons.figures.figure import Figure, Figures
from comparisons.figures.quantity import COMPARED, HYPHENATED, LABELS, NORMS, QUANTITIES, label
from comparisons.figures.uncertainty import COVERAGE
from comparisons.judging import contact
from comparisons.judging.study import Run
from comparisons.models.level import Solution

TO_SIGN = ("name, place, date", "signature")  # by hand
PARTS = {name: name for name in ("discretisation", "iteration", "domain", "increments")}
PARTS["domain"] = "far boundary"
REPEATED = ("domain", "increments")  # parts by a coarsest level that is solved again
WORDING = tomllib.loads(Path(__file__).with_name("words.toml").read_text(encoding="utf-8"))
_BOUNDS = {"lowest": LOWEST_ORDER, "regular": REGULAR, "irregular": IRREGULAR}
_BOUNDS = {name: plain(value) for name, value in _BOUNDS.items()}
WORDS = tuple((term, text.format(**_BOUNDS)) for term, text in WORDING["convergence"].items())


def levels_tables(run: Run) -> list[TextTable]:
    """Every figure over the levels, its limit, and the parts of its uncertainty: one table a model,
    which begins with how its levels were solved, and one for the difference."""
    tables = []
    for name, model in run.runs.items():
        figures = run.figures.of(study=contact.NAME, source=name)
        tables.append(_levels_table(run, LABELS[name].capitalize(), model, figures, _solved(model)))
    if run.plan.compares:
        model, title = run.runs["finite_element"], "Difference of both models"
        tables.append(_levels_table(run, title, model, run.compared))
    return tables


def _levels_table(
    run: Run, title: str, model: Solution, figures: Figures, before: Sequence[tuple[str, ...]] = ()
) -> TextTable:
    """Figures on the levels of a model, below rows of texts on each level."""
    parts = [name for name in PARTS if name not in REPEATED or model.repeated.get(name)]
    head = ("", *(f"level {k + 1}" for k in range(len(model.levels))), "extrapolated", "order")
    head += (*(PARTS[name] for name in parts), "total")
    rows = [row + ("",) * (len(head) - len(row)) for row in before]
    for figure in figures:
        if not (figure.levels and (name := row_name(run, figure.quantity, figure.friction))):
            continue
        known, stated = figure.uncertainty.convergence, figure.uncertainty.parts
        sizes = [percent(stated[part]) for part in parts]
        if known.safety_factor is not None:
            sizes[0] += f"\nfactor {plain(known.safety_factor)}"
        texts = *_texts(figure, (*figure.levels, known.limit)), _order(known), *sizes
        rows.append((name, *texts, percent(figure.numerical)))
    return TextTable(title, head, tuple(rows))


def _solved(model: Solution) -> list[tuple[str, ...]]:
    """Elements, unknowns, counts of the contact solver and time of each level."""
    levels, pitch = model.levels, scale_of([model.levels[0].grid.pitch], "m")
    counts = [level.solution.iterations for level in levels]
    return [
        ("pitch of the pressure elements", *(pitch.text(v.grid.pitch) for v in levels)),
        ("pressure elements", *(integer(level.grid.count) for level in levels)),
        ("unknowns", *(integer(level.unknowns) for level in levels)),
        *(
            (_iterations(name), *(integer(of[name]) if name in of else "" for of in counts))
            for name in dict.fromkeys(name for of in counts for name in of)
        ),
        ("time", *(with_unit(sum(level.seconds.values()), "s", 3) for level in levels)),
    ]


def _iterations(name: str) -> str:
    """A count of the contact solver in words; `linear_`: of the solution that it starts from."""
    words, start = WORDING["iterations"], name.removeprefix("linear_")
    text = words.get(name) or words[start] + ", linear start" * (start != name)
    return f"contact: {text}"


def _texts(figure: Figure, values: Sequence[float]) -> list[str]:
    """Values of a figure, or of a difference, on its levels."""
    if figure.against is not None:
        signed = figure.quantity not in NORMS
        return [percent(value, digits=3, signed=signed) for value in values]
    scale = scale_of(values, QUANTITIES[figure.quantity].unit)
    return [scale.text(value, 5) for value in values]


def _order(known: Convergence) -> str:
    """Observed order, and how the levels follow each other; below it the formal one."""
    observed = [] if known.order is None else [significant(known.order, 2)]
    said = " ".join([*observed, *[known.behaviour] * (known.behaviour != "monotone")])
    return f"{said}\nformal {plain(known.formal_order)}"


def row_name(run: Run, name: str, friction: float) -> str:
    """A quantity and its friction; what does not depend on that is empty but at the first."""
    frictions = run.frictions
    if not COMPARED[name].needs_stress:
        return label(name) if friction == frictions[0] else ""
    return label(name) + (f", friction {plain(friction)}" if len(frictions) > 1 else "")


def signed(run: Run) -> Names:
    """Rows that a person signs who has read the report: question, how sure, by what and when."""
    scene, errors, made = run.problem.scene, run.model_errors, run.record.get("made", {})
    judged = dict.fromkeys(
        f"{label(e.quantity)} within {percent_as_written(e.tolerance)}" for e in errors
    )
    question = "What are the figures of this contact? Nothing is judged against a tolerance."
    if errors:
        question = "May the half-plane's figures stand for those of a model with every effect that "
        question += f"matters, {', '.join(judged)}, at friction {listed(scene.load.friction)}?"
    rows = [
        ("scene", f"{scene.title} ({one_line(scene.source)})"),
        ("question", question),
        ("uncertainty", f"every stated one covers {percent_as_written(COVERAGE)}"),
        ("solved by", _listed(run.record["versions"])),
        ("made", _listed(made)),
    ]
    return Names([*rows, *((name, "") for name in TO_SIGN)])


def record_rows(run: Run) -> list[tuple[str, str]]:
    """Date, host and revision, versions, machine and hashes of the run."""
    record = run.record
    rows = [(name, value) for name, value in record.get("made", {}).items() if value]
    rows += [(part, _listed(record[part])) for part in ("versions", "machine")]
    if record.get("seed") is not None:
        rows.append(("seed", str(record["seed"])))
    for name, value in (record.get("hashes") or {}).items():
        for model, words in HYPHENATED.items():
            name = name.replace(f"{model}_", f"the {words} model's ")
        name = name.replace("run_in_", "the run-in ").replace("_", " ")
        rows.append((f"SHA-256 of {name}", value))
    return rows


def _listed(known: Mapping[str, object]) -> str:
    return ", ".join(f"{name} {value}" for name, value in known.items() if value)


def commands(run: Run) -> list[tuple[str, str]]:
    """Commands that give this again."""
    scene, plan = run.problem.scene, run.plan
    launcher = PROJECT / "crosscheck"  # of a checkout, which is on no path
    program = shlex.quote(str(launcher)) if launcher.is_file() else "crosscheck"
    models = "" if plan.compares else f" --models {','.join(plan.models).replace('_', '-')}"
    return [
        ("repeats this run, in the folder of this page", f"{program} rerun ."),
        ("prints this page, in the same folder", f"{program} report --pdf ."),
        ("runs the scene again", f"{program} run {shlex.quote(one_line(scene.source))}{models}"),
    ]
