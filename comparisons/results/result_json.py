"""The content of result.json, by the names that other people's scripts rely on."""

import math
from collections.abc import Mapping
from dataclasses import asdict

from comparisons.figures.quantity import QUANTITIES
from comparisons.figures.uncertainty import COVERAGE, Uncertainty
from comparisons.figures.verdict import Comparison
from comparisons.models.forecast import forecast
from comparisons.models.level import Level, ModelRun, StressResult
from comparisons.models.plan import Plan, no_coupling
from comparisons.models.problem import Problem
from comparisons.models.running_in import running_in_account
from comparisons.studies.contact import uncertainties
from comparisons.studies.coupling import Coupling
from comparisons.studies.model_error.catalogue import COUPLED, EFFECTS, KINEMATIC
from comparisons.studies.model_error.error_budget import ErrorBudget
from comparisons.studies.model_error.selection import law_leaned_on
from comparisons.studies.model_error.sideways import sideways_shift
from comparisons.studies.model_error.validity import validity_verdict
from comparisons.studies.scatter.figures import InputScatter
from comparisons.studies.yielding import flow_assessment

SCHEMA = 2  # 1 had the half-plane's model error inside `budget`, and `assumptions`


def result_of(
    problem: Problem,
    plan: Plan,
    runs: dict[str, ModelRun],
    comparisons: tuple[Comparison, ...],
    refinement: str,
    couplings: tuple[Coupling, ...] = (),
    budget: ErrorBudget | None = None,
    scatter: InputScatter | None = None,
) -> dict:
    """All figures of a run: SI units, None for what is unknown.

    refinement  why it stopped
    couplings   of the half-plane, one a friction coefficient
    budget      of the comparison, None for one model
    scatter     of uncertain inputs"""
    hertz = problem.hertz
    tolerance_checks = [] if budget is None else budget.tolerance_checks(problem.scene.tolerances)
    flow = flow_assessment(problem, runs)
    verdict, why = validity_verdict(tolerance_checks)
    if budget is not None:
        why += law_leaned_on(budget.selection, problem.scene)
        verdict, why = flow.judged(verdict, why)
    by_quantity = {name: [] for name in QUANTITIES}
    for row in comparisons:
        figures, name = asdict(row), row.quantity
        del figures["quantity"]
        if budget is not None:
            exceeds = _exceeds(budget, problem.scene.tolerances, name)
            figures["not_modelled_exceeds_tolerance"] = exceeds
        by_quantity[name].append(figures)
    return {
        "schema": SCHEMA,
        "scene": problem.surface.as_dict(problem.scene),
        "profile": problem.surface.info and problem.surface.info.surface(),
        "running_in": running_in_account(problem.surface),
        "groups": _groups(problem, runs),
        "hertz": {
            "half_width": hertz.half_width,
            "peak_pressure": hertz.peak_pressure,
            "reduced_modulus": hertz.combined_modulus,
            "tau1_max": hertz.tau1_max,
            "tau1_max_depth": hertz.tau1_max_depth,
        },
        "models": {
            name: [_model(problem, run, mu, couplings) for mu in problem.scene.load.friction]
            for name, run in runs.items()
        },
        "comparison": {name: rows for name, rows in by_quantity.items() if rows},
        "model_error": {} if budget is None else model_error_content(problem, runs, budget),
        "error_budget": budget and error_budget_content(problem, runs, comparisons, budget),
        "scatter": scatter and scatter.by_quantity(),
        "scatter_samples": scatter and scatter.counts(),
        "yield": flow.as_dict(),
        "validity": {"verdict": verdict, "why": why, "assumes": list(plan.assumptions)},
        "plan": forecast(problem, plan).as_dict(),
        "refinement": refinement,
        "skipped": [asdict(skipped) for skipped in plan.skipped],
    }


def _groups(problem: Problem, runs: dict[str, ModelRun]) -> dict[str, float | None]:
    scene, info, half_width = problem.scene, problem.surface.info, problem.hertz.half_width
    body, roughness = scene.body, info and info.roughness
    peak = max(float(run.finest.solution.pressure.max()) for run in runs.values())
    return {
        "a_over_thickness": body.thickness and half_width / body.thickness,
        "a_over_radius": half_width / scene.roller.radius,
        "a_over_width": body.width and half_width / body.width,
        "rms_slope": None if roughness is None else roughness.rms_slope,
        "max_slope": None if roughness is None else roughness.max_slope,
        "friction_dundurs": max(scene.load.friction) * problem.dundurs_beta,
        "peak_pressure_over_hardness": body.hardness and peak / body.hardness,
    }


def _model(
    problem: Problem, run: ModelRun, friction: float, couplings: tuple[Coupling, ...]
) -> dict:
    level, own = run.finest, {"operator": _operator(run)}
    if run.name == "half_plane":
        own = _coupling(problem, friction, couplings)
    return {
        "friction": friction,
        "contact": _contact(problem, run.name, level),
        "stress": _stress(level.stress(friction)),
        "uncertainty": {
            name: {
                "iteration": u.iteration,
                "discretisation": u.discretisation if len(run.levels) > 2 else None,
                "domain": u.domain,
                "increments": u.increments,
                "total": u.total if len(run.levels) > 2 else None,
            }
            for name, u in uncertainties(run, problem, friction).items()
        },
        "checks": asdict(level.solution.residuals) | {"converged": level.solution.converged},
        "cost": {
            "seconds": run.seconds,
            "iterations": level.solution.iterations,
            "unknowns": level.unknowns,
            "peak_memory": _peak_memory(problem, run),
            "levels": [_cost_of(level) for level in run.levels],
        },
        **own,
    }


def _operator(run: ModelRun) -> dict | None:
    """The compliance before contact: of the finest level, and the verdicts of all."""
    checks = [level.operator for level in run.levels]
    if checks[-1] is None:
        return None
    return checks[-1].as_dict() | {"levels": [c and c.verdict for c in checks]}


def _cost_of(level: Level) -> dict:
    """One level: what it took, and what the laws said before it was meshed."""
    laws = ("expected_seconds", "expected_memory") if level.mesh is not None else ()
    return {
        "pitch": level.grid.pitch,
        "unknowns": level.unknowns,
        "seconds": sum(level.seconds.values()),
        **{name: getattr(level, name) for name in laws},
    }


def _coupling(problem: Problem, friction: float, couplings: tuple[Coupling, ...]) -> dict:
    """What normal-tangential coupling changes, or why it changes nothing."""
    found = next((c for c in couplings if c.friction == friction), None)
    why = no_coupling(problem, friction) if found is None else found.why
    return {
        "normal_tangential_coupling": found and found.as_dict(),
        "normal_tangential_coupling_why": why,
    }


def _contact(problem: Problem, model: str, level: Level) -> dict:
    solution = level.solution
    approach, why = _approach(problem, model, level)
    return {
        "load_per_length": solution.load,
        "approach": approach,
        "approach_why": why,
        "peak_pressure": float(solution.pressure.max()),
        "peak_position": float(level.grid.x[solution.pressure.argmax()]),
        "contact_length": level.contact_length,
        "contact_ratio": level.contact_length / (2.0 * problem.hertz.half_width),
        "contact_ratio_extent": level.contact_length / level.extent,
        "patches": level.patches.tolist(),
    }


def _approach(problem: Problem, model: str, level: Level) -> tuple[float | None, str | None]:
    """Approach from first touch [m], where both bodies have a datum; else why not."""
    if model == "half_plane":
        return None, "the displacement of a half-plane is known but for a constant"
    if problem.scene.body.thickness is None:
        return None, "the body is unbounded: the value would grow with the size of its mesh"
    if not problem.scene.roller.rigid:
        return None, "the elastic roller is unbounded: its share has no datum"
    return level.solution.approach - problem.first_touch, None


def _stress(stress: StressResult | None) -> dict | None:
    if stress is None:
        return None
    names = {"tau1": "tau1_max", "txz": "txz_max_abs", "von_mises": "von_mises_max"}
    found = {}
    for key, name in names.items():
        extreme = stress.extremes[key]
        found |= {name: abs(extreme.value), f"{name}_at": [extreme.x, extreme.z]}
    return found


def _peak_memory(problem: Problem, run: ModelRun) -> int:
    """Largest memory of the process [bytes] by the time the model was done.
    The half-plane's planned levels come first, so that theirs is its own; further levels share
    the process with the finite elements."""
    last = len(problem.pitches) if run.name == "half_plane" else len(run.levels)
    return run.levels[min(last, len(run.levels)) - 1].peak_memory


def model_error_content(
    problem: Problem, runs: dict[str, ModelRun], budget: ErrorBudget
) -> dict[str, list[dict]]:
    """By quantity and friction; relative to the whole model, None: unknown or not judged."""
    tolerance = problem.scene.tolerances
    verdicts = {(c.quantity, c.friction): c.verdict for c in budget.tolerance_checks(tolerance)}
    found: dict[str, list[dict]] = {}
    for error in budget.model_errors:
        found.setdefault(error.quantity, []).append(
            {
                "friction": error.friction,
                "value": error.value,
                "uncertainty": _known(error.uncertainty),
                "effects": {
                    name: asdict(effect) | {"uncertainty": _known(effect.uncertainty)}
                    for name, effect in error.effects.items()
                },
                "interaction": error.interaction,
                "jump": error.jump,
                "maximum_moves": error.moved,
                "not_modelled": budget.selection.not_modelled(error.quantity),
                "not_modelled_exceeds_tolerance": _exceeds(budget, tolerance, error.quantity),
                "tolerance": tolerance.get(error.quantity),
                "verdict": verdicts.get((error.quantity, error.friction)),
            }
        )
    for entry in found.get("pressure_l2", ()):
        entry |= _sideways(runs, budget.wholes.get(entry["friction"]))
    return found


def _exceeds(budget: ErrorBudget, tolerance: Mapping[str, float], quantity: str) -> bool | None:
    """Whether effects that no model has may exceed a tolerance; None where nothing is judged."""
    return budget.beyond(quantity, tolerance) is not None if quantity in tolerance else None


def _sideways(runs: dict[str, ModelRun], whole: Level | None) -> dict[str, float]:
    """How far the whole model's peaks lie beside the half-plane's, and what else they differ by."""
    other = runs["finite_element"].finest if whole is None else whole
    own = runs["half_plane"].beside(other).solution.pressure
    found = sideways_shift(other.grid, own, other.solution.pressure)
    return {
        "shift": found.shift,
        "stretch": found.stretch,
        "mean_shift": found.mean,
        "value_after_shift": found.left,
    }


def error_budget_content(
    problem: Problem, runs: dict[str, ModelRun], rows: tuple[Comparison, ...], budget: ErrorBudget
) -> dict:
    """What became of every effect; by quantity numerical and sampling parts, relative, or None."""
    stated = {
        mu: {model: uncertainties(run, problem, mu) for model, run in runs.items()}
        for mu in problem.scene.load.friction
    }
    quantities: dict[str, list[dict]] = {}
    for row in rows:
        name, friction = row.quantity, row.friction
        entry: dict = {"friction": friction}
        if row.half_plane is not None:
            of_models = stated[friction].items()
            entry["numerical"] = {model: _numerical(own[name]) for model, own in of_models}
        entry["input"] = budget.sampling.get(friction, {}).get(name)
        error = budget.of(name, friction)
        entry["validation"] = {  # by the names of ASME V&V 20, expanded uncertainties
            "E": error.value,
            "u_num": _known(error.uncertainty),
            "u_input": entry["input"],
            "u_D": None,  # no measured data enter
        }
        quantities.setdefault(name, []).append(entry)
    return {
        "effects": {name: _effect(name, budget) for name in EFFECTS},
        "levels": budget.levels,
        "unsplit": budget.unsplit,
        "left_out": budget.left_out,
        "cost": {"seconds": budget.seconds},
        "quantities": quantities,
    }


def _effect(name: str, budget: ErrorBudget) -> dict:
    """What became of an effect, and by what estimate."""
    selection = budget.selection
    if name in selection.contained:
        status, why = "contained", "the scene's own finite elements have it"
    elif name in selection.added:
        status, why = "computed", "its estimate exceeds a tenth of a tolerance"
    elif name in selection.impossible:
        status, why = "not computed", selection.impossible[name]
    elif name in selection.negligible:
        status, why = "negligible", "its estimate is below a tenth of every tolerance"
    elif name == COUPLED and name in selection.estimates:  # with friction, it cannot be without
        status, why = "contained", f"it is a part of {EFFECTS['finite_strain'].label}"
    elif name in KINEMATIC:
        status, why = "does not apply", f"it counts in {EFFECTS['finite_strain'].label}"
    else:
        status, why = "does not apply", "it does not apply, or has no size"
    return {"status": status, "because": why, "estimate": selection.estimates.get(name)}


def _numerical(uncertainty: Uncertainty) -> dict:
    convergence = uncertainty.convergence
    return {
        "iteration": uncertainty.iteration,
        "discretisation": _known(uncertainty.discretisation),
        "domain": uncertainty.domain,
        "increments": uncertainty.increments,
        "convergence": convergence.behaviour,
        "formal_order": convergence.formal_order,
        "order": convergence.order,
        "limit": convergence.limit,
        "safety_factor": convergence.safety_factor,
        "coverage": COVERAGE,
    }


def _known(value: float) -> float | None:
    return value if math.isfinite(value) else None
