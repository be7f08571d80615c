"""Why the figures may be trusted: refinement, contact conditions, compliance, cost and record."""

import re
import shlex
from itertools import chain, repeat

from analytic.contact.problem import KKT_TOLERANCE
from comparisons.assessment.comparison import figures, uncertainties
from comparisons.assessment.effects.catalogue import EFFECTS
from comparisons.assessment.uncertainty import Uncertainty
from comparisons.common.numbers import integer, percent, plain, scale_of, significant, with_unit
from comparisons.common.quantities import HYPHENATED, LABELS, QUANTITIES, label
from comparisons.models.finite_element.compliance_check import ComplianceCheck
from comparisons.models.level import ModelRun
from comparisons.models.problem import Problem
from comparisons.report.tables.text import TextTable
from comparisons.results.outcome import Outcome

RESIDUALS = {
    "load_balance": "load balance",
    "complementarity": "pressure where there is a gap",
    "penetration": "overlap",
    "negative_pressure": "tension",
    "excess_pressure": "pressure above the hardness",
}


def convergence_tables(outcome: Outcome) -> list[TextTable]:
    """Every figure over the levels: one table a model, one for the norms of the difference."""
    tables = [_of_model(outcome, run) for run in outcome.runs.values()]
    if outcome.plan.compares:
        tables.append(_of_pair(outcome))
    return tables


def _of_model(outcome: Outcome, run: ModelRun) -> TextTable:
    problem, check = outcome.problem, run.far_boundary_check
    columns = len(run.levels) + (check is not None)
    pitch = scale_of([run.levels[0].grid.pitch], "m")
    levels = [*run.levels, *([check] if check else [])]
    rows = [
        ("pitch of the pressure elements", *(pitch.text(v.grid.pitch) for v in levels)),
        ("unknowns", *(integer(v.unknowns) for v in levels)),
        ("time", *(with_unit(sum(v.seconds.values()), "s", 3) for v in levels)),
    ]
    rows = [row + ("",) * (1 + columns + 4 + (check is not None) - len(row)) for row in rows]
    seen = set()
    for friction in problem.scene.friction:
        doubts = uncertainties(run, problem, friction)
        values = [figures(level, problem, friction) for level in levels]
        for name in values[0]:
            quantity = QUANTITIES[name]
            if name == "contact_ratio" or (name in seen and not quantity.needs_stress):
                continue  # the ratio is the length over a constant
            seen.add(name)
            scale = scale_of([v[name] for v in values], quantity.unit)
            where = _where(problem, name, friction)
            rows.append(
                (
                    label(name) + where,
                    *(scale.text(v[name], 5) for v in values),
                    *_doubts(doubts[name], domain=check is not None),
                )
            )
    looked = check is not None
    head = _head(len(run.levels), block=looked, domain=looked)
    return TextTable(LABELS[run.name].capitalize(), head, tuple(rows))


def _of_pair(outcome: Outcome) -> TextTable:
    problem, run = outcome.problem, outcome.runs["finite_element"]
    rows, seen = [], set()
    for pair in outcome.pairs:
        for name in pair.norms[0]:
            quantity = QUANTITIES[name]
            if name in seen and not quantity.needs_stress:
                continue
            seen.add(name)
            where = _where(problem, name, pair.friction)
            rows.append(
                (
                    label(name) + where,
                    *(percent(norms[name], digits=3) for norms in pair.norms),
                    *_doubts(pair.uncertainties[name], domain=run.far_boundary_check is not None),
                )
            )
    head = _head(len(run.levels), block=False, domain=run.far_boundary_check is not None)
    return TextTable("Difference of both models", head, tuple(rows))


def _where(problem: Problem, name: str, friction: float) -> str:
    """Which friction coefficient a figure belongs to, where there are several."""
    several = len(problem.scene.friction) > 1 and QUANTITIES[name].needs_stress
    return f", friction {plain(friction)}" if several else ""


def _head(levels: int, block: bool, domain: bool) -> tuple[str, ...]:
    """`block`: a level with the block halved; `domain`: what it says stands among the doubts."""
    numbered = tuple(f"level {k + 1}" for k in range(levels))
    check = ("level 1, block halved",) if block else ()
    far = ("domain",) if domain else ()
    return ("", *numbered, *check, "order", "discretisation", "iteration", *far, "total")


def _doubts(doubt: Uncertainty, domain: bool) -> tuple[str, ...]:
    """Observed order and the parts of an uncertainty; `domain`: whether that part was looked at."""
    known = doubt.convergence
    order = significant(known.order, 2) if known.order is not None else ""
    if known.behaviour != "monotone":
        order = f"{order} {known.behaviour}".strip()
    return (
        order,
        percent(doubt.discretisation),
        percent(doubt.iteration),
        *([percent(doubt.domain)] if domain else []),
        percent(doubt.total),
    )


def effects_table(outcome: Outcome) -> TextTable | None:
    """What became of each effect that the half-plane lacks; None with one model."""
    if outcome.budget is None:
        return None
    judged, rows = set(outcome.problem.scene.tolerance), []
    for name, effect in outcome.result["error_budget"]["effects"].items():
        estimate = effect["estimate"]
        if effect["status"] == "does not apply":
            continue
        largest = ""
        if estimate is not None:
            sizes = [estimate[q] for q in judged & set(estimate)] or list(estimate.values())
            largest = percent(max(sizes))
        kind = EFFECTS[name]
        rows.append((kind.label, kind.words, effect["status"], largest, effect["because"]))
    head = ("effect", "what the half-plane lacks", "status", "estimate, at most", "because")
    return TextTable("", head, tuple(rows)) if rows else None


def check_table(outcome: Outcome) -> TextTable:
    """The contact conditions on the finest level, evaluated once more after the solution."""
    rows = []
    for name, words in RESIDUALS.items():
        values = [getattr(run.finest.solution.residuals, name) for run in outcome.runs.values()]
        rows.append((words, *(significant(value, 2) for value in values)))
    rows.append(
        (
            f"all below {significant(KKT_TOLERANCE, 1)} on every level",
            *(
                "yes" if all(level.solution.converged for level in run.levels) else "no"
                for run in outcome.runs.values()
            ),
        )
    )
    return TextTable("", ("", *(LABELS[name] for name in outcome.runs)), tuple(rows))


def cost_table(outcome: Outcome) -> TextTable:
    """Iterations, unknowns and memory on the finest level, and the time of all levels."""
    rows: dict[str, list[str]] = {}
    for name, run in outcome.runs.items():
        level = run.finest
        cells = {
            "time": with_unit(sum(level.seconds.values()), "s", 3),
            "unknowns": integer(level.unknowns),
            "pressure elements": integer(level.grid.count),
        }
        for kind, count in level.solution.iterations.items():
            cells[f"contact solver: {kind.replace('_', ' ')}"] = integer(count)
        memory = outcome.result["models"][name][0]["cost"]["peak_memory"]
        cells["peak memory of the process"] = with_unit(memory, "byte", 3)
        for words, text in cells.items():
            rows.setdefault(words, []).append((name, text))
    rows["all levels together: time"] = [
        (name, with_unit(sum(run.seconds.values()), "s", 3)) for name, run in outcome.runs.items()
    ]
    names = list(outcome.runs)
    return TextTable(
        "",
        ("on the finest level", *(LABELS[name] for name in names)),
        tuple((words, *(dict(cells).get(n, "") for n in names)) for words, cells in rows.items()),
    )


def record_rows(outcome: Outcome) -> list[tuple[str, str]]:
    """Versions, machine and hashes of the run."""
    record = outcome.record
    versions = ", ".join(f"{k} {v}" for k, v in record["versions"].items() if v is not None)
    machine = ", ".join(
        f"{name} {value}" for name, value in record["machine"].items() if value is not None
    )
    rows = [("versions", versions), ("machine", machine)]
    if record.get("seed") is not None:
        rows.append(("seed", str(record["seed"])))
    if record.get("profile"):
        rows.append(("SHA-256 of the profile", record["profile"]["sha256"]))
    hashes = record.get("hashes") or {}
    rows += [(f"SHA-256 of {_hashed(name)}", value) for name, value in hashes.items()]
    return rows


def _hashed(name: str) -> str:
    """What a hash of the record is of: a model's pressures, or another array."""
    for model, words in HYPHENATED.items():
        if name.startswith(f"{model}_"):
            return f"the {words} model's {name.removeprefix(f'{model}_').replace('_', ' ')}"
    return name.replace("_", " ")


def refinement_text(outcome: Outcome) -> str:
    """Why refinement ended, with quantities in words."""
    text = outcome.result["refinement"]
    for name in sorted(QUANTITIES, key=len, reverse=True):
        text = re.sub(rf"\b{name}\b", label(name), text)
    return text


def commands(outcome: Outcome) -> list[tuple[str, str]]:
    """What to type to get this again."""
    scene, plan = outcome.problem.scene, outcome.plan
    models = "" if plan.compares else f" --models {','.join(plan.models).replace('_', '-')}"
    return [
        ("repeats this run, in the folder of this page", "crosscheck rerun ."),
        ("draws this page again, in the same folder", "crosscheck report ."),
        ("runs the scene again", f"crosscheck run {shlex.quote(scene.source)}{models}"),
    ]


READING = {
    "neither": "Mesh and body are right: what is left between the models is contact.",
    "mesh": "The mesh is too coarse under the pressures: no other figure is better than it.",
    "modulus": "The finite elements' elastic constants are not those of the other model.",
    "block": "The block is too small, or held too near, to stand for the body.",
    "geometry": "The mesh is right; the body is not judged, its own geometry is in the figures.",
}
FOUND = {
    "neither": "no fault of mesh or body",
    "mesh": "the mesh is too coarse",
    "modulus": "the elastic constants are off",
    "block": "the block is too small",
    "geometry": "no fault of the mesh",
}
HOW = (
    "Displacements under given pressures on the finest level, before any contact, against those of "
    "the nearest analytic surface{datum}. Columns: under a single pressure element, the L2 norm of "
    "the difference; far: without the elements next to the load. Waves: the work of the pressures, "
    "negative where finite elements are stiffer. Both small: mesh and body are right, what is left "
    "is contact error. Short waves off: the mesh. Columns off far from the load, or long waves "
    "only: the block's size. All waves off alike: the elastic constants."
)


def operator_table(outcome: Outcome) -> TextTable | None:
    """Columns and waves of the finest level; None where nothing was checked."""
    check = _check(outcome)
    if check is None:
        return None
    head = ["", "difference", "far"]
    if check.half_plane is not None:
        head.append(f"from the half-plane: what {_listed(check.finite)} does")
    found, effect = check.nearest, check.half_plane
    others = repeat(None) if effect is None else chain(effect.columns, effect.waves)
    rows = []
    for own, other in zip(chain(found.columns, found.waves), others, strict=False):
        if own in found.columns:
            name, far = f"column at x = {with_unit(own.x, 'm', 3)}", percent(own.beyond)
            signed = False
        else:
            name, far = f"waves of {with_unit(own.length, 'm', 3)}", ""
            name, signed = f"{name}, {plain(float(f'{own.elements:.3g}'))} elements", True
        cells = [name, percent(own.difference, signed=signed), far]
        if other is not None:
            cells.append(percent(other.difference, signed=signed))
        rows.append(tuple(cells))
    title = f"Finite elements' compliance before contact: {FOUND[check.verdict]}"
    return TextTable(title, tuple(head), tuple(rows))


def operator_note(outcome: Outcome) -> str:
    """What the table says, and how it is read; empty without one."""
    check = _check(outcome)
    if check is None:
        return ""
    datum = "" if check.datum else ", a constant removed"
    because = check.because[0].upper() + check.because[1:]
    return f"{READING[check.verdict]} {because}. {HOW.format(datum=datum)}"


def _check(outcome: Outcome) -> ComplianceCheck | None:
    run = outcome.runs.get("finite_element")
    return None if run is None else run.finest.operator


def _listed(names: tuple[str, ...]) -> str:
    return " and ".join(f"the {name}" for name in names)
