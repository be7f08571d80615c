"""Scenes and materials that tests start from, and the places of the files that they read."""

import json
import os
import pickle
import subprocess
import sys
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partialmethod
from itertools import takewhile
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING
from unittest.mock import patch

import numpy as np

if TYPE_CHECKING:
    from analytic.material import Law
    from comparisons.figures.figure import Figure, Part
    from comparisons.judging.study import Run
    from comparisons.models.level import Level, Solution
    from comparisons.models.model import Model
    from comparisons.models.problem import Levels, Problem
    from comparisons.scenes.scene import Scene

PROJECT = Path(__file__).resolve().parents[1]
DATA = PROJECT / "tests/data"
PROFILES = PROJECT / "comparisons/scenes/library/profiles"
MEASURED = PROJECT.parent / "shared/profiles"  # other people's: tests without them are skipped

STEEL = {"youngs_modulus": 210e9, "poissons_ratio": 0.3}
STEEL_HEAT = {"conductivity": 46.0, "density": 7850.0, "specific_heat": 460.0}
# Of a [heat] section whose two bodies conduct alike.
BOTH_CONDUCT = {f"{b}_{name}": v for b in ("body", "roller") for name, v in STEEL_HEAT.items()}
RUBBER = {"youngs_modulus": 3e6, "poissons_ratio": 0.45}
# A known law of elasticity: the whole model is solved with no other.
NEO_HOOKEAN = {"law": "neo-hookean"}
KNOWN_STEEL, KNOWN_RUBBER = STEEL | NEO_HOOKEAN, RUBBER | NEO_HOOKEAN
# Smooth bodies of steel, the roller elastic or rigid.
STEEL_PAIR = {"roller": {"radius": 8e-3, **STEEL}, "body": STEEL}
RIGID_PAIR = {"roller": {"radius": 8e-3, "rigid": True}, "body": STEEL}
SMOOTH = {
    "title": "Smooth",
    "roller": {"radius": 7.5706e-3, **STEEL},
    "body": dict(STEEL),
    "load": {"per_length": 3.55e6},
    "finite_element": {"plastic": False},  # steel flows at such stresses
}
# A part of the ground surface, under friction.
GROUND = {
    "roller": {"radius": 7.5706e-3, **STEEL},
    "body": dict(STEEL),
    "profile": {"file": str(PROFILES / "ground_unrun.csv"), "x_unit": "um", "z_unit": "um"}
    | {"form": "none"},
    "load": {"per_length": 0.6e6, "friction": 0.1, "position": "1118 um"},
}
# Sliding, and the heat of it.
HOT = SMOOTH | {"load": {"per_length": 3.55e6, "friction": 0.1}}
HOT |= {"heat": {"speed": "1 m/s", **BOTH_CONDUCT}}
# Constants of Murnaghan's law, as a scene may have them.
CONSTANTS = {"l": "-150 GPa", "m": -600e9, "n": -700e9}
# With a field of few points, and nothing beside the two models.
QUICK = SMOOTH | {"stress": {"points": [120, 40]}, "budget": {"effects": False}}
# Of runs that are finished without finite elements: smooth with a field; rough with a hardness and
# two friction coefficients; and a rough layer without a field.
STEADY = STEEL_PAIR | {
    "title": "Smooth roller on a smooth half-plane",
    "load": {"per_length": 1e6},
    "stress": {"points": [60, 20]},
}
WAVY = {
    "title": "Wavy body",
    "roller": {"radius": 10e-3, **STEEL},
    "body": {**STEEL, "hardness": 4e9},
    "profile": {"kind": "sinusoid", "wavelength": 50e-6, "amplitude": 0.2e-6},
    "load": {"hertz_peak_pressure": 1e9, "friction": [0.0, 0.1]},
    "stress": {"points": [60, 20]},
}
WAVY_LAYER = {
    "title": "Wavy",
    "roller": {"radius": 10e-3, "rigid": True},
    "body": {**STEEL, "thickness": 2e-3, "base": "frictionless"},
    "profile": {"kind": "sinusoid", "wavelength": 50e-6, "amplitude": 0.2e-6},
    "load": {"hertz_peak_pressure": 1e9},
}
# Finished runs by what they are of, the latest of this session.
RUNS: "dict[tuple, Run]" = {}
MOST_RUNS = 12
# Solved levels by what they are of, the latest of this session.
LEVELS: "dict[bytes, dict[float, Level]]" = {}
MOST_LEVELS = 48


def reference(name: str) -> dict:
    """High-precision values of tests/data by the name of their file."""
    return json.loads((DATA / f"{name}.json").read_text(encoding="utf-8"))


def python(
    *words: object, cwd: Path = PROJECT, env: Mapping[str, str] = os.environ, **variables: str
) -> subprocess.CompletedProcess:
    """Run another process of this Python, which finds the project from any folder; with more
    variables. It gets nothing of what MPI, used in this process, would hand on."""
    return subprocess.run(
        [sys.executable, *map(str, words)],
        cwd=cwd,
        env={**env, "PYTHONPATH": str(PROJECT), **variables},
        capture_output=True,
        text=True,
    )


def changed(tables: dict, **sections: dict) -> dict:
    """The tables with some fields of some sections replaced, or added."""
    return tables | {name: tables.get(name, {}) | fields for name, fields in sections.items()}


def exact_layer(case: dict, nu: float) -> tuple[dict, dict[str, float]]:
    """The scene of a row of `analytic.exact.layers.TABLE`, as tables, and its exact peak pressure
    [Pa] and contact length [m]."""
    radius, thickness, modulus = 0.1, 1e-3, 200e9 / (1.0 - nu**2)
    load, peak = float(case["P_R_over_Eprime_t2"]), float(case["p0_R_over_Eprime_t"])
    body = {"youngs_modulus": 200e9, "poissons_ratio": nu, "base": case["base"]}
    tables = {
        "roller": {"radius": radius, "rigid": True},
        "body": body | {"thickness": thickness},
        "load": {"per_length": load * modulus * thickness**2 / radius},
    }
    length = 2.0 * float(case["a_over_t"]) * thickness
    return tables, {"peak_pressure": peak * modulus * thickness / radius, "contact_length": length}


def as_toml(tables: dict) -> str:
    """The file of such tables, their title first."""
    lines = [f"title = {json.dumps(tables['title'])}"]
    for name, table in tables.items():
        if isinstance(table, dict):
            lines += [f"[{name}]", *(f"{field} = {json.dumps(v)}" for field, v in table.items())]
    return "\n".join(lines)


def page_rows(page: str, heading: str) -> list[list[str]]:
    """Cells of the table on a page of documentation whose first column is called `heading`."""
    lines = page.splitlines()
    start = next(n for n, line in enumerate(lines) if line.startswith(f"| {heading} |")) + 2
    table = takewhile(lambda line: line.startswith("|"), lines[start:])
    return [[cell.strip() for cell in line.strip("|").split(" | ")] for line in table]


def resolved(tables: dict, name: str = "made", folder: Path = Path(".")) -> "Scene":
    """The scene that a file of these tables describes."""
    from comparisons.scenes.scene import Origin, Scene

    return Scene.of(tables, Origin(name, folder, f"{name}.toml"))


def asked_in_python(line: str, scene: "Scene") -> "Scene":
    """The scene that a line such as `crosscheck.run(scene, tolerance=0.05)` runs."""
    from comparisons.scenes.scene import with_law, with_tolerance

    def run(changed: "Scene", tolerance: float | None = None, law: str | None = None) -> "Scene":
        changed = changed if law is None else with_law(changed, law)
        return changed if tolerance is None else with_tolerance(changed, tolerance)

    return eval(line, {"scene": scene, "crosscheck": SimpleNamespace(run=run)})


def judging(scene: "Scene", tolerance: dict[str, float]) -> "Scene":
    """The scene that judges by these tolerances alone."""
    names = type(scene.tolerance).model_fields
    return scene.unchecked({f"tolerance.{name}": tolerance.get(name) for name in names})


def problem(tables: dict) -> "Problem":
    """The mechanical problem that a scene file of these tables poses."""
    from comparisons.models.posing import problem_of

    return problem_of(resolved(tables))


def run_of(
    scene: "dict | Scene", *models: str, levels: "Levels | None" = None, **sections: dict
) -> "Run":
    """The finished run of a scene, or of tables with some fields of sections changed, by both
    models or those named; nothing is written. Tests that ask for the same one share it, and of
    others the levels that are the same. No other elements are solved to show what they cost.

    levels  so many, in place of those that figures take"""
    from comparisons.figures.quantity import MODELS
    from comparisons.models.model import Model
    from comparisons.runs.run import Known, run

    solve = Model._solved
    scene = resolved(changed(scene, **sections)) if isinstance(scene, dict) else scene
    key = json.dumps(scene.tables), scene.folder, models, levels
    if key not in RUNS:
        while len(RUNS) >= MOST_RUNS:
            RUNS.pop(next(iter(RUNS)))
        with (
            patch("comparisons.models.model.Model._solved", partialmethod(_solved_once, solve)),
            patch("comparisons.judging.ladder.cost.other_elements", lambda *_: {}),
        ):
            RUNS[key] = run(scene, None, models or MODELS, known=Known(levels=levels))
    return RUNS[key]


def _solved_once(
    model: "Model", solve: Callable, here: object, problem: "Problem", pitch: float, stages: object
) -> dict[float, "Level"]:
    """Levels that `solve`, the model's own, has solved once: neither how a scene is judged, what it
    is held against nor the time that it is given changes them."""
    tables = problem.scene.tables
    others = "title", "tolerance", "budget", "answers"
    tables = {n: t for n, t in tables.items() if n not in others}
    # effects of finite elements are the scene's
    effects = sorted(model.effects) if model.solver == "analytic" else []
    fields = model.fields and problem.window is not None
    how = model.solver, effects, model.half_block, model.times, fields
    posed = replace(problem, scene=None, levels=None)
    key = pickle.dumps((how, json.dumps(tables), problem.scene.budget.memory, posed, pitch))
    if key not in LEVELS:
        while len(LEVELS) >= MOST_LEVELS:
            LEVELS.pop(next(iter(LEVELS)))
        LEVELS[key] = solve(model, here, problem, pitch, stages)
    return LEVELS[key]


def finite_elements(
    posed: "Problem", pitch: float | None = None, fields: bool = False, **refinement: object
) -> "Level":
    """The finite elements on one level at the first friction coefficient, the coarsest unless a
    pitch [m] is given; with the fields of [stress] if asked for. `refinement` is further of its
    own."""
    from comparisons.common.progress import Stages
    from comparisons.models.finite_element.level import finite_element_level
    from comparisons.models.finite_element.mesh import Refinement

    posed = _at_first(posed, fields)
    asked = Refinement(pitch or posed.pitches[0], **refinement)
    return next(iter(finite_element_level(posed, asked, Stages()).values()))


def half_plane_at(posed: "Problem", pitch: float | None = None, fields: bool = False) -> "Level":
    """The half-plane on one level, as `finite_elements` has theirs."""
    from comparisons.common.progress import Stages
    from comparisons.models.analytic import analytic_level

    posed = _at_first(posed, fields)
    grid = posed.grid(pitch or posed.pitches[0])
    levels = analytic_level(posed, posed.half_plane_effects, grid, Stages(), fields)
    return next(iter(levels.values()))


def _at_first(posed: "Problem", fields: bool) -> "Problem":
    """A problem at its first friction coefficient alone."""
    posed = posed.under(posed.scene.load.friction[0])
    return posed if fields else replace(posed, window=None)


def lawed(law: "Law") -> dict[str, object]:
    """Fields of a body of that law of elasticity."""
    constants = law.murnaghan and dict(zip("lmn", law.murnaghan, strict=True))
    return {"law": law.name} | ({"murnaghan": constants} if constants else {})


def hat_nodes(x0: float, pitch: float, count: int) -> np.ndarray:
    """x (count + 2,) [m] of the nodes of equal hats at x0 + i pitch, with their outer feet."""
    return x0 + pitch * np.arange(-1, count + 1)


def refound(run: "Run", study: str, **changes: object) -> "Run":
    """A finished run with other findings of a study: its figures, series, statements or data."""
    return replace(run, findings={**run.findings, study: replace(run.findings[study], **changes)})


def posed(run: "Run", **changes: object) -> "Run":
    """A finished run of another problem or plan, with the same findings."""
    return replace(run, solved=replace(run.solved, **changes))


def with_levels(run: "Run", runs: dict[str, "Solution"]) -> "Run":
    """A finished run whose models have other levels in every case, with the same findings."""
    return posed(run, cases=tuple(replace(case, runs=runs) for case in run.solved.cases))


def with_fields(run: "Run", fields: dict[str, object]) -> "Run":
    """A finished run that says so of its scene, with the same findings."""
    scene = run.problem.scene.unchecked(fields)
    return posed(run, problem=replace(run.problem, scene=scene))


def compared_verdicts(run: "Run") -> set[str]:
    """Verdicts on the differences of both models that have a tolerance."""
    return {row.verdict for row in run.figures.of(study="comparison") if row.tolerance}


def without_cost(result: dict) -> dict:
    """The content of a result.json without what may differ from run to run."""
    differs = ("made", "command", "files")
    record = {name: part for name, part in result["record"].items() if name not in differs}
    series = [series for series in result["series"] if "is_account" not in series]
    return result | {"record": record, "series": series, "printed": None}  # which has times


def unconverged(run: "Run", model: str) -> "Run":
    """A finished run whose model did not converge on its finest level."""
    from comparisons.judging import contact

    levels_of = run.runs[model]
    solution = replace(levels_of.finest.solution, converged=False)
    levels = (*levels_of.levels[:-1], replace(levels_of.finest, solution=solution))
    failed = with_levels(run, {**run.runs, model: replace(levels_of, levels=levels)})
    said = contact.solve(failed.solved, {}, None).statements
    return refound(failed, contact.NAME, statements=said)


def budgeted(run: "Run", budget: object) -> "Run":
    """A finished run whose model errors are those of another error budget."""
    from comparisons.judging.model_error.study import NAME, findings_of

    findings = findings_of(budget, run.problem)
    return replace(run, findings={**run.findings, NAME: findings})


def judged(
    quantity: str = "peak_pressure",
    value: float = 0.001,
    uncertainty: float = 0.002,
    not_modelled: dict[str, float] | None = None,
    tolerance: float = 0.02,
    friction: float = 0.0,
    parts: tuple["Part", ...] = (),
) -> "Figure":
    """A model error of the half-plane; all sizes relative."""
    from comparisons.figures.figure import Figure
    from comparisons.figures.uncertainty import Uncertainty

    return Figure(
        study="model_error",
        quantity=quantity,
        source="half_plane",
        value=value,
        at={"friction": friction},
        against="whole",
        uncertainty=Uncertainty({"numerical": uncertainty}),
        unknown=not_modelled or {},
        bounds=(-tolerance, tolerance),
        parts=parts,
    )
