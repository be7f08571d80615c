"""result.json and report.npz of schema 2, read for one release: the map from old paths to figures.

In: a content of schema 2. Out: the same as a Result; the parts of an old report.npz as those of a
new one. Goes with the release after the one that writes schema 3."""

from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import fields, replace
from functools import partial
from math import inf
from types import SimpleNamespace

from comparisons.figures.convergence import Convergence
from comparisons.figures.figure import (
    Column,
    Figure,
    Findings,
    Part,
    SampleSpread,
    Series,
    Statement,
    columns_of,
    figures_of,
)
from comparisons.figures.quantity import MODELS, QUANTITIES
from comparisons.figures.uncertainty import Uncertainty, numerical
from comparisons.models.finite_element.compliance_check import ComplianceColumn
from comparisons.models.plan import Plan
from comparisons.output.result_json import Result
from comparisons.scenes.surface import SceneSurface
from comparisons.studies import checks, comparison, contact, problem, running_in
from comparisons.studies.answers import study as answers
from comparisons.studies.friction import coupling
from comparisons.studies.friction.coupling import Couplings
from comparisons.studies.heat import study as heat
from comparisons.studies.model_error import account
from comparisons.studies.scatter import study as scatter
from comparisons.studies.statistics import study as statistics
from comparisons.studies.study import CONVERGED, MODEL_ERROR, WHY_NOT, Solved
from comparisons.studies.subsurface import bulge
from comparisons.studies.subsurface import quiescent_zone as zone
from comparisons.studies.subsurface import yielding as flow

SCHEMA = 2
STRESS = ("tau1_max", "txz_max_abs", "von_mises_max")
ITSELF = Uncertainty({"itself": 1.0})
Items = Iterator[Figure | Series | Statement]


def result_of_schema_2(old: Mapping) -> Result:
    """Raises LookupError, TypeError or ValueError where it is built otherwise."""
    findings, kinds = {}, (Figure, Series, Statement)
    for name, read in READERS.items():
        items = list(read(old))
        if items:
            findings[name] = Findings(*(tuple(i for i in items if isinstance(i, k)) for k in kinds))
    validity = old["validity"]
    verdict = validity["verdict"] if old["comparison"] else "not compared"
    return Result(old["scene"], {}, verdict, validity["why"], (), findings)


def _entries(old: Mapping) -> Iterator[tuple[str, int, dict, dict[str, float]]]:
    for model, entries in old["models"].items():
        for n, entry in enumerate(entries):
            yield model, n, entry, {"friction": entry["friction"]}


def _number(value: float | None) -> float:
    return inf if value is None else float(value)


def _stated(parts: Mapping[str, float | None]) -> Uncertainty:
    names = ("iteration", "discretisation", "domain", "increments")
    return numerical(*(_number(parts.get(name, 0.0)) for name in names))


def _total(size: float | None, value: float | None = None) -> Uncertainty:
    """A total uncertainty, over the size of a value where it is absolute."""
    return Uncertainty({"numerical": _number(size) / (abs(value or 0.0) or 1.0)})


def _within(tolerance: float | None) -> tuple[float, float] | None:
    return None if tolerance is None else (-tolerance, tolerance)


def _columns(rows: Sequence[Mapping], units: Mapping[str, str]) -> dict[str, Column]:
    """Columns of rows that are alike, by the units of those that are wanted."""
    return {name: Column(tuple(row[name] for row in rows), u) for name, u in units.items()}


def _contact(old: Mapping) -> Items:
    a, p0 = old["hertz"]["half_width"], old["hertz"]["peak_pressure"]
    budget = (old["error_budget"] or {}).get("quantities", {})
    hardness, exact = old["scene"]["body"].get("hardness"), "approach" not in old["scene"]["load"]
    for model, n, entry, at in _entries(old):
        solution, known, stress = entry["contact"], entry["uncertainty"], entry["stress"] or {}
        stated = {name: _stated(parts) for name, parts in known.items()}
        worst = max(stated.values(), key=lambda u: u.total)
        values = {n: solution[n] for n in contact.QUANTITIES if solution.get(n) is not None}
        values |= {name: stress[name] for name in STRESS if stress}
        places = {name: tuple(stress[f"{name}_at"]) for name in STRESS if stress}
        places["peak_pressure"] = (solution["peak_position"],)
        if stress:
            values["tau1_max_depth"] = _depth(old, model, n, stress)
        for name, value in values.items():
            unit = a if "length" in name or "depth" in name else p0
            scale, sure = abs(value) or unit, stated.get(contact.AS_UNCERTAIN.get(name, name))
            if name in budget and name in stated:
                sure = replace(sure, convergence=_convergence(budget[name][n], model, value, scale))
            if name == "peak_position":
                scale = a
                sure = Uncertainty({"discretisation": entry["cost"]["levels"][-1]["pitch"] / a})
            elif sure is None:
                sure = Uncertainty() if name == "load_per_length" and exact else worst
            capped = (
                name == "peak_pressure" and hardness and value >= contact.AT_HARDNESS * hardness
            )
            yield Figure(
                *(contact.NAME, name, model, value, at, None, scale, sure),
                place=places.get(name),
                notes=("capped",) if capped else (),
            )
        if n == 0:
            yield from _of_model(model, entry, stated)


def _of_model(model: str, entry: Mapping, stated: Mapping[str, Uncertainty]) -> Items:
    """What is the same at every friction coefficient."""
    patches = entry["contact"]["patches"]
    length = sum(stop - start for start, stop in patches)
    edges = (stated["contact_length"].total * length,) * len(patches)
    ends = zip(*patches, strict=True)
    columns = (Column(tuple(map(float, values)), "m", edges) for values in ends)
    yield Series("patches", dict(zip(("start", "stop"), columns, strict=True)), model)
    levels = _columns(entry["cost"]["levels"], dict.fromkeys(("pitch", "unknowns", "seconds"), ""))
    yield Series("levels", levels, model, is_account=True)
    yield Statement(CONVERGED, "yes" if entry["checks"][CONVERGED] else "no", model)
    if why := entry["contact"].get("approach_why"):
        yield Statement("no approach", why, model)


def _depth(old: Mapping, model: str, n: int, stress: Mapping) -> float:
    """Below the boundary, where the comparison has it; else below the mean line."""
    compared = old["comparison"].get("tau1_max_depth")
    return compared[n][model] if compared else stress["tau1_max_at"][1]


def _convergence(entry: Mapping, model: str, value: float, scale: float) -> Convergence | None:
    known = entry.get("numerical", {}).get(model)
    if known is None:
        return None
    names = ("formal_order", "order", "safety_factor")
    left = _number(known["discretisation"]) * scale
    behaviour = known["convergence"]
    more = {name: known[name] for name in names}
    return Convergence(value, known["limit"], left, behaviour=behaviour, **more)


def _comparison(old: Mapping) -> Items:
    for name, rows in old["comparison"].items():
        for row in rows:
            yield Figure(
                *(comparison.NAME, name, "half_plane", row["difference"]),
                at={"friction": row["friction"]},
                against="finite_element",
                scale=abs(row["finite_element"] or 0.0) or 1.0,
                uncertainty=_total(row["uncertainty"]),
                bounds=_within(row["tolerance"]),
            )


def _coupling(old: Mapping) -> Items:
    a = old["hertz"]["half_width"]
    for model, _, entry, at in _entries(old):
        changes, known = entry.get("normal_tangential_coupling"), entry["uncertainty"]
        if model != "half_plane" or changes is None:
            continue
        stated = {name: _stated(parts) for name, parts in known.items()}
        worst = max(stated.values(), key=lambda u: u.total)
        yield Statement(CONVERGED, "yes" if changes[CONVERGED] else "no", "half_plane", at)
        for name, change in changes.items():
            if not isinstance(change, dict) or "difference" not in change:
                continue
            sure = stated.get("contact_length" if name == coupling.SHIFT else name, worst)
            scale = a if name == coupling.SHIFT else abs(change["value"] or 0.0) or 1.0
            for value, against in ((change["value"], None), (change["difference"], "uncoupled")):
                if value is not None:
                    key = coupling.NAME, name, "half_plane", value, at, against, scale, sure
                    yield Figure(*key)


def _model_error(old: Mapping) -> Items:
    budget = old["error_budget"] or {}
    for name, rows in old["model_error"].items():
        inputs = {e["friction"]: e["input"] for e in budget["quantities"][name]}
        for row in rows:
            at = {"friction": row["friction"]}
            parts = [
                Part(n, e["value"], _number(e["uncertainty"]), e["moves_maximum"])
                for n, e in row["effects"].items()
            ]
            parts += [Part(account.INTERACTION, row["interaction"]), Part("jump", row["jump"])]
            if inputs[row["friction"]] is not None:
                parts.append(Part(account.SAMPLING, inputs[row["friction"]]))
            yield Figure(
                *(MODEL_ERROR, name, "half_plane", row["value"], at, "whole"),
                uncertainty=_total(row["uncertainty"]),
                unknown=row["not_modelled"],
                bounds=_within(row["tolerance"]),
                parts=tuple(parts),
                place=row["maximum_moves"] and tuple(row["maximum_moves"]),
            )
            moved = {
                f"pressure_{key}": row[key]
                for key in ("shift", "stretch", "mean_shift")
                if key in row
            }
            moved |= {account.LEFT: row["value_after_shift"]} if moved else {}
            yield from figures_of(MODEL_ERROR, "half_plane", moved, ITSELF, at)
    if budget:
        yield from _budget(budget)


def _budget(budget: Mapping) -> Items:
    effects = budget["effects"]
    unknown = dict.fromkeys(QUANTITIES)
    rows = [{"effect": n} | unknown | (e["estimate"] or {}) | e for n, e in effects.items()]
    columns = dict.fromkeys(("effect", "status", "because", *QUANTITIES), "")
    yield Series("effects", _columns(rows, columns), is_account=True)
    cost = {"levels": Column((budget["levels"],)), "seconds": Column((budget["cost"]["seconds"],))}
    yield Series("cost", cost, "whole", is_account=True)
    for name, key in (("not split", "unsplit"), ("left out", "left_out")):
        if budget[key] is not None:
            yield Statement(name, budget[key])


def _problem(old: Mapping) -> Items:
    yield from figures_of(problem.NAME, problem.HERTZ, old["hertz"])
    yield from figures_of(problem.NAME, problem.SCENE, old["groups"])
    if old["profile"]:
        surface = old["profile"]
        filters = {name: surface[name] for name in ("cutoff", "short_cutoff")}
        yield from figures_of(problem.NAME, problem.PRESSED, surface["pressed"] | filters)
        yield from figures_of(problem.NAME, problem.STANDARD, surface["standard"] or {})
    yield from (Statement("assumed", text) for text in old["validity"]["assumes"])
    yield from (Statement("skipped", s["because"], s["step"]) for s in old["skipped"])
    yield Statement("refinement", old["refinement"])


def _running_in(old: Mapping) -> Items:
    account_of = old["running_in"]
    if account_of is None:
        return
    names = [name for name in running_in.QUANTITIES if name in account_of]
    values = {name: account_of[name] for name in names}
    yield from figures_of(running_in.NAME, "half_plane", values)
    for source in (running_in.BEFORE, running_in.AFTER):
        yield from figures_of(running_in.NAME, source, account_of[f"roughness_{source}"])
    yield Series("passes", {"volume": Column(tuple(account_of["volume_by_pass"]), "m^2")})
    yield Statement(CONVERGED, "yes" if account_of[CONVERGED] else "no")


def _checks(old: Mapping) -> Items:
    sure = Uncertainty({"iteration": checks.KKT_TOLERANCE})
    for model, n, entry, _ in _entries(old):
        for name in checks.QUANTITIES if n == 0 else ():
            yield Figure(checks.NAME, name, model, entry["checks"][name], uncertainty=sure)


def _scatter(old: Mapping) -> Items:
    counts = old["scatter_samples"]
    if counts is not None:
        numbers = {name: counts[name] for name in ("samples", "solutions", "failed", "pitch")}
        yield Series(scatter.SAMPLES, columns_of([numbers], {"pitch": "m"}))
    if counts is not None and counts["why"] is not None:
        yield Statement("first failure", counts["why"])
    for name, rows in (old["scatter"] or {}).items():
        for row in rows:
            spread = row["mean"], row["standard_deviation"], tuple(row["interval"]), row["shares"]
            named, samples = (name, row["friction"], row["nominal"]), counts["solutions"]
            yield scatter.scattered(*named, SampleSpread(*spread), samples - counts["failed"])


def _yield(old: Mapping) -> Items:
    known = old["yield"]
    scene = {name: known[name] for name in flow.QUANTITIES if name in known}
    source = "half_plane" if "half_plane" in old["models"] else MODELS[1]
    yield from figures_of(flow.NAME, "scene", scene)
    yield Statement("flow", known["flow"])
    if known["beyond_doubt"]:
        yield Statement(flow.BEYOND_DOUBT, known["beyond_doubt"], source)
    for n, entry in enumerate(known["by_friction"]):
        at = {"friction": entry["friction"]}
        stated = old["models"][source][n]["uncertainty"]
        yield Statement("read", entry["from"], source, at)
        from_field = entry["from"] == flow.FIELD
        sure = _stated(stated["tau1_max" if from_field else "peak_pressure"])
        if not from_field and old["profile"] is not None:
            sure = replace(sure, parts=dict(sure.parts) | {"from the peak": flow.FROM_PEAK})
        values = {name: entry[name] for name in flow.QUANTITIES if name in entry}
        limit = {"shakedown_limit": values.pop("shakedown_limit")}
        yield from figures_of(flow.NAME, source, values, sure, at)
        yield from figures_of(flow.NAME, "scene", limit, None, at)
        yield Statement("read", entry["from"], source, at)


def _zones(old: Mapping) -> Items:
    zones = old.get("quiescent_zone") or {}
    if "why" in zones:
        yield Statement(WHY_NOT, zones["why"])
        return
    for model, entries in zones.items():
        for entry in entries:
            at = {"friction": entry["friction"]}
            for name in zone.QUANTITIES:
                value, size = entry[name]["value"], entry[name]["uncertainty"]
                yield from figures_of(zone.NAME, model, {name: value}, _total(size, value), at)
            yield Statement(zone.STATE, entry["status"], model, at)
            rows = [row | {"state": row["status"]} for row in entry["asperities"]]
            yield zone.asperity_series(rows, model, at)


def _bulges(old: Mapping) -> Items:
    known = old.get("bulge")
    if known is not None and known["why"] is not None:
        yield Statement(WHY_NOT, known["why"])
    stated = {"height": "uncertainty", "half_plane": "uncertainty", "end": "end_uncertainty"}
    stated |= {"energy": "energy_uncertainty"}
    for entry in (known or {}).get("by_friction", ()):
        at = {"friction": entry["friction"]}
        for name in bulge.QUANTITIES:
            values = entry[name] if name == "energy_ahead" else {bulge.MODEL: entry[name]}
            size = entry[stated[name]] if name in stated else None
            for source, value in values.items():
                sure = _total(size, value)
                yield from figures_of(bulge.NAME, source, {name: value}, sure, at)
        size = (_number(entry["uncertainty"]),) * len(entry["rise"])
        curve = {
            "distance": Column(tuple(entry["distance"]), "m"),
            "rise": Column(tuple(entry["rise"]), "m", size),
        }
        yield Series(bulge.CURVE, curve, bulge.MODEL, at)
        if patches := entry["patches"]:
            names = [n for n in patches[0] if n not in ("uncertainty", "end_uncertainty")]
            columns = _columns(patches, dict.fromkeys(names, ""))
            sizes = tuple(_number(row["uncertainty"]) for row in patches)
            columns["height"] = replace(columns["height"], uncertainty=sizes)
            yield Series(bulge.PATCHES, columns, bulge.MODEL, at)


def _statistics(old: Mapping) -> Items:
    known = old.get("statistics")
    if known is None:
        return
    loads = known["loads"]
    sizes = {
        f"figures.{source}.{name}": [
            abs(row[share][name] * row["figures"][source][name]) for row in loads
        ]
        for source, share in (("random", "scatter"), ("trace", "grid"))
        for name in statistics.FIGURES
    }
    sizes["difference"] = [row["uncertainty"] for row in loads]
    unsure = {"grid", "scatter", "uncertainty"}
    rows = [statistics.flat({k: v for k, v in row.items() if k not in unsure}) for row in loads]
    yield statistics.series_of("summits", list(map(statistics.flat, known["summits"])))
    yield statistics.series_of("loads", rows, sizes)
    for model, patches in known["patches"].items():
        rows = list(map(statistics.flat, patches))
        yield statistics.series_of("patches", rows, source=model)
    yield Series("traces", {"traces": Column((known["traces"],))})


def _answers(old: Mapping) -> Items:
    for answer, content in old.get("answers", {}).items():
        for name, rows in content["comparison"].items():
            for row in rows:
                stated, total = row["own_uncertainty"], _number(row["uncertainty"])
                parts = (
                    {"model": total} if stated is None else {"model": total - stated, "own": stated}
                )
                of_row = answers.AnswerRow(
                    *(name, row["friction"], row["answer"], row["reference"], row["difference"]),
                    *(Uncertainty(parts), row["tolerance"]),
                )
                yield from of_row.figures(answer, content["reference"])
        yield from figures_of(answers.NAME, answer, {"load_balance": content["balance"]}, ITSELF)
        yield from figures_of(answers.NAME, answer, {"spacing": content["spacing"]})
        by_model = [{"model": model} | row for model, row in content["conditions"].items()]
        measured = [
            {"quantity": name} | row for name, rows in content["validation"].items() for row in rows
        ]
        tables = {answers.CONDITIONS: by_model, answers.HINTS: content["hints"]}
        yield from answers.tables_of(answer, tables | {answers.VALIDATION: measured})


def _heat(old: Mapping) -> Items:
    known = old.get("heat")
    if known is None:
        return
    at = {"friction": known["friction"]}
    for name, number in known["peclet"].items():
        yield from figures_of(heat.NAME, name, {"peclet_number": number}, None, at)
    for row in known["figures"].values():
        last = [list(sizes.values())[-1] for sizes in (row["elastic"], row["values"]) if sizes]
        parts = [Part(n, e["value"], e["uncertainty"]) for n, e in row["effects"].items()]
        if row["by_pressure"] is not None:
            parts.append(Part(heat.OTHER_PRESSURES, row["by_pressure"]))
        sizes = row["values"], row["own"], max(map(abs, last)) or 1.0, row["difference"]
        of_row = heat.HeatRow(
            row["quantity"], *sizes, tuple(parts), row["tolerance"], row["elastic"]
        )
        yield from of_row.figures(known["friction"])
    for rule, values in known["rules"].items():
        yield from figures_of(heat.NAME, rule, values, None, at)
    yield from (Statement("the finite elements have", text) for text in known["contains"])


READERS: dict[str, Callable[[Mapping], Items]] = {
    contact.NAME: _contact,
    comparison.NAME: _comparison,
    coupling.NAME: _coupling,
    MODEL_ERROR: _model_error,
    problem.NAME: _problem,
    running_in.NAME: _running_in,
    checks.NAME: _checks,
    scatter.NAME: _scatter,
    flow.NAME: _yield,
    zone.NAME: _zones,
    bulge.NAME: _bulges,
    statistics.NAME: _statistics,
    answers.NAME: _answers,
    heat.NAME: _heat,
}


def kinds_of_schema_2(kinds: Mapping[str, object]) -> dict[str, object]:
    """What makes the dataclasses of an old report.npz, some as `kinds` are; of those that are gone
    their fields."""
    changed = {
        "ResolvedScene": _scene,
        "Plan": partial(Plan, increments_check=False),
        "Uncertainty": numerical,
        "Convergence": Convergence,
        "Column": ComplianceColumn,
        "InputScatter": lambda pitch, x, band, **_: scatter.PressureBand(pitch, x, band),
        "HeatStudy": lambda **row: heat.HeatStudy(*(row[f.name] for f in fields(heat.HeatStudy))),
    }
    return defaultdict(lambda: SimpleNamespace, {**kinds, **changed})


def _scene(**old: object) -> dict[str, object]:
    """What was one with its surface."""
    surface = SceneSurface(
        old["profile"], old["profile_info"], old["position"], run_in=old["run_in"]
    )
    return {name: old[name] for name in ("tables", "name", "source")} | {"surface": surface}


def parts_of_schema_2(
    old: Mapping, findings: Mapping[str, Findings]
) -> tuple[dict, dict[str, object], dict[str, Findings]]:
    """Of an old outcome: the parts of a Solved, the data of its studies, and their
    `findings`, with the levels of figures and their convergence, which only the outcome has."""
    solved = {name: old[name] for name in ("problem", "plan", "window", "runs")}
    posed = Solved(**solved)
    data = {
        coupling.NAME: Couplings(old["couplings"]),
        MODEL_ERROR: old["budget"],
        scatter.NAME: old["scatter"],
        answers.NAME: answers.OutsideAnswers(
            {answer.name: answer.answers for answer in old["answers"] or ()}
        ),
        heat.NAME: old["heat"],
        flow.NAME: flow.flow_assessment(posed.problem, posed.runs),
    }
    figures = list(contact.solve(posed, {}, None).figures)
    for pair in old["pairs"]:
        for name, stated in pair.uncertainties.items():
            levels = tuple(level[name] for level in pair.differences)
            key = (comparison.NAME, name, "half_plane", levels[-1], {"friction": pair.friction})
            figures.append(Figure(*key, "finite_element", uncertainty=stated, levels=levels))
    known = {figure.key: figure for figure in figures}
    joined = dict(findings)
    for study in {contact.NAME, comparison.NAME} & set(findings):
        figures = []
        for figure in findings[study].figures:
            same = known.get(figure.key, figure)
            figures.append(replace(figure, levels=same.levels, uncertainty=same.uncertainty))
        joined[study] = replace(findings[study], figures=tuple(figures))
    return solved, data, joined
