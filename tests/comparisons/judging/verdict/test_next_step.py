"""The next step offered is a command: it is typed as it stands, and its scene is posed.

Runs are stated, not solved: a half-plane on one level, which stands for the finite elements, too,
what `selected_effects` and `flow_assessment` say of it, and model errors that are drawn."""

import random
import shlex
from dataclasses import replace
from functools import cache
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from scenes import (
    DATA,
    KNOWN_RUBBER,
    KNOWN_STEEL,
    STEEL,
    as_toml,
    asked_in_python,
    half_plane_at,
    judged,
)

from analytic.contact.problem import ContactError
from comparisons import cli
from comparisons.commands.arguments import LAUNCHED_AS
from comparisons.common.errors import InputError
from comparisons.figures.figure import Findings, Part, Statement
from comparisons.figures.quantity import MODELS
from comparisons.figures.uncertainty import Uncertainty
from comparisons.judging import contact, yielding
from comparisons.judging.effects.catalogue import LAW, SAMPLING
from comparisons.judging.effects.selection import ASKED, selected_effects
from comparisons.judging.model_error.model_error import INPUTS
from comparisons.judging.model_error.refinement import ErrorBudget
from comparisons.judging.study import CONVERGED, MODEL_ERROR, Case, Run, Solved
from comparisons.judging.verdict.headline import kind_of
from comparisons.judging.verdict.next_step import Offer, next_of, pasted
from comparisons.models.level import Solution
from comparisons.models.plan import make_plan
from comparisons.models.posing import problem_of
from comparisons.models.problem import Problem
from comparisons.scenes.files import scene_names
from comparisons.scenes.materials import solids
from comparisons.scenes.scene import Scene, with_settings

SHIPPED = [*scene_names(), *map(str, sorted((DATA / "contacts").glob("*.toml")))]
OPTIONS = {"--law", "--models", "--tolerance"}
KINDS = OPTIONS | {"body.material", "body.yield_stress", "budget.effects", "budget.time"}
KINDS |= {"finite_element.plastic", "load.per_length", "roller.material", "roller.support"}
KINDS |= {f"resolution.{name}" for name in ("elements", "nodes", "pitch")}
NAMES = ("PEEK", "100Cr6", *["carbon steel"] * 3)
BODIES = [STEEL, KNOWN_STEEL, KNOWN_RUBBER, {"youngs_modulus": 90e9, "poissons_ratio": 0.2}]
BODIES += [{"material": name} for name in NAMES]
COATING = {"thickness": 5e-6, "youngs_modulus": 3e11, "poissons_ratio": 0.2}
# Of errors, over the tolerance: sizes, uncertainties, ranges by the law.
ERRORS = (0.0, 0.3, 0.98, -3.0), (1e-3, 1e-3, 0.1, 2.0, np.inf), (0.0, 0.0, 3.0)


def maybe(draw: random.Random, *values: object) -> object:
    """One of the values, or with as much chance as two of them None."""
    return draw.choice([None, None, *values])


def tables(draw: random.Random) -> dict:
    """Tables of a scene that may or may not be one."""
    body, roller = dict(draw.choice(BODIES)), {"radius": 8e-3} | draw.choice(BODIES)
    strain = draw.choice([1e-4, 2e-3, 2e-2])
    known = body if "material" not in body else solids()[body["material"]].values
    modulus = known["youngs_modulus"]
    peak = strain * getattr(modulus, "value", modulus)
    load = {"hertz_peak_pressure": peak, "friction": draw.choice([[0.0], [0.1], [0.0, 0.3]])}
    profile = maybe(draw, {"kind": "self-affine", "samples": 200, "hurst": 0.8, "seed": 3})
    if draw.random() < 0.4:
        roller = {"radius": 8e-3, "rigid": True}
    elif support := maybe(draw, "opposite"):
        roller["support"] = support
    body["yield_stress"] = maybe(draw, peak * draw.choice([0.05, 0.3, 2.0]))
    body["hardness"] = maybe(draw, peak * draw.uniform(0.9, 4.0))
    body["thickness"] = maybe(draw, 2e-3)
    if roller.get("rigid") and body["thickness"] and draw.random() < 0.5:
        load = {"approach": 1e-6, "friction": load["friction"]}
    if profile:  # about six times as long as the contact
        profile |= {"length": 0.4 * strain, "rms_height": 4e-4 * strain**2}
    if profile and draw.random() < 0.4:
        profile |= {"periodic": True}
        del roller["radius"]
        load = {"mean_pressure": draw.choice([0.01, 0.5]) * peak, "friction": load["friction"]}
    sections = {
        "roller": roller,
        "body": body,
        "coating": COATING if draw.random() < 0.1 else None,
        "profile": profile,
        "load": load,
        "tolerance": maybe(draw, {"peak_pressure": 0.01}, {"contact_length": 0.3}),
        "finite_element": maybe(draw, {"deformation": "finite"}, {"plastic": True}),
        "budget": maybe(draw, {"effects": False}, {"effects": "all"}, {"time": 2.0, "memory": 3e8}),
        "resolution": draw.choice([{"pitch": 2e-3 * strain}, {"elements": 3.0}, {"nodes": 64}]),
    }
    sections = {name: table for name, table in sections.items() if table}
    return {n: {f: v for f, v in t.items() if v is not None} for n, t in sections.items()}


def posed(scene: Scene) -> Problem | None:
    """Problem, None of a scene that has no contact; the load of an approach is none of its own."""
    try:
        return problem_of(scene, load=1e5 if scene.load.kind == "approach" else None)
    except (InputError, ContactError):
        return None


def stated(draw: random.Random, problem: Problem) -> Run:
    """A run with drawn model errors and what may become of the effects on its way."""
    scene = problem.scene
    plan = make_plan(problem, MODELS if draw.random() < 0.95 else MODELS[:1])
    levels = (half_plane_at(problem),) * 2  # certain
    runs = {name: Solution(name, levels) for name in plan.models}
    cases = tuple(Case(problem.under(mu), runs) for mu in problem.scene.load.friction)
    solved = Solved(problem, plan, cases)
    findings = {contact.NAME: contact.solve(solved, {}, None)}
    if draw.random() < 0.05:
        findings[contact.NAME] = Findings(statements=(Statement(CONVERGED, "no"),))
    if plan.compares:
        selection = selected_effects(solved, ())
        what = draw.random()
        if what < 0.3:
            why = draw.choice(["the whole has no solution", f"cannot change a verdict ({ASKED})"])
            selection = selection.without(selection.added, why)
        elif what < 0.6:
            why = "flow is taken at small strains: finite ones take 400 s more (budget.time)"
            added = selection.added & {"finite_strain"}
            selection = replace(selection.without(added, why), time=543.0)
        if scene.profile and draw.random() < 0.1:
            sizes = dict.fromkeys(scene.tolerances, draw.choice([0.05, np.inf]))
            selection = replace(
                selection,
                impossible=selection.impossible | {SAMPLING: "few samples"},
                estimates=selection.estimates | {SAMPLING: sizes},
            )
        size, sure, law = (draw.choice(of) for of in ERRORS)
        errors = [
            judged(
                quantity,
                tolerance * size * draw.uniform(0.9, 1.02),
                tolerance * sure,
                {LAW: tolerance * law} if law and selection.laws else {},
                friction=friction,
                parts=(Part(LAW, 0.0, tolerance * law),) if law and selection.laws else (),
            )
            for quantity, tolerance in scene.tolerances.items()
            if quantity in ("peak_pressure", "contact_length")
            for friction in scene.load.friction
        ]
        if draw.random() < 0.1:
            scatter = Uncertainty({"numerical": 0.0, INPUTS: 2.0})
            errors = [replace(e, uncertainty=scatter, unknown={}, parts=()) for e in errors]
        if draw.random() < 0.03:
            errors = []
        budget = ErrorBudget(selection, 2, None, tuple(errors))
        figures = tuple(budget.figures(scene.tolerances))
        findings[MODEL_ERROR] = Findings(figures, data=budget)
    findings[yielding.NAME] = yielding.solve(solved, findings, None)
    return Run(solved, findings, {}, None)


@pytest.fixture
def typed(monkeypatch, tmp_path):
    """`typed(line)`: scene and models of a command, as it is typed after another one."""
    monkeypatch.setattr(cli, "get_command", cache(cli.get_command))
    monkeypatch.setattr("comparisons.models.analytic.unresolved_crest", lambda *_: 0.0)
    monkeypatch.setattr("comparisons.models.posing.SEARCH_HATS", 500)
    taken = []

    def solve_scene(scene, directory, models, *further):
        taken.append((scene, models))
        raise InputError("not solved")

    monkeypatch.setattr("comparisons.runs.run.solve_scene", solve_scene)
    monkeypatch.chdir(tmp_path)

    def type_in(line: str) -> tuple[Scene, tuple[str, ...]] | None:
        program, *words = shlex.split(line)
        assert program == "crosscheck" and cli.main(words) == 2
        return taken.pop() if taken else None

    return type_in


def check(run: Run, typed) -> set[str]:
    """Each offer is a command that the scene takes, and another than before; or a sentence.
    Returns the fields and options that it sets."""
    scene, sets = run.problem.scene, set()
    for offer in next_of(run, kind_of(run)):
        lines = pasted(run, offer)
        assert len(lines) == bool(offer.is_known and (offer.settings or offer.options))
        for line in lines:
            asked = scene.command[:3]
            assert asked == tuple(shlex.split(line)[: len(asked)])
            wanted, models = typed(line) if asked else (asked_in_python(line, scene), MODELS)
            assert wanted.tables != scene.tables or models != run.plan.models, line
            assert posed(wanted) is not None
            sets |= {*(text.partition("=")[0] for text in offer.settings), *offer.options}
        if "--tolerance" in offer.options:
            held = float(offer.options["--tolerance"])
            assert all(figure.reach <= held for figure in run.model_errors)
    return sets


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: Path(path).stem)
def test_shipped_scenes_and_contacts_take_what_they_are_offered(path, typed):
    scene, _ = typed(shlex.join(("crosscheck", "run", path)))
    for seed in range(2):
        check(stated(random.Random(f"{Path(path).stem} {seed}"), posed(scene)), typed)


def test_the_command_is_the_users_own_with_what_is_offered_in_its_place(typed, monkeypatch):
    monkeypatch.setenv(LAUNCHED_AS, "./crosscheck")
    options = "--set budget.time=20 --tolerance=1% --out 'a b' --set=friction=0.2"
    scene, _ = typed(f"crosscheck run smooth {options}")
    run = SimpleNamespace(problem=SimpleNamespace(scene=scene))
    offer = Offer("finer", ("budget.time=600",), {"--tolerance": "0.02"})
    kept = "./crosscheck run smooth --out 'a b' --set friction=0.2"
    assert pasted(run, offer) == (f"{kept} --set budget.time=600 --tolerance 0.02",)


def test_two_hundred_random_scenes_take_every_kind_of_offer(typed, tmp_path):
    number, said = 0, set()
    for seed in range(10**6):
        draw, path = random.Random(seed), tmp_path / f"{seed}.toml"
        path.write_text(as_toml({"title": "Drawn"} | tables(draw)))
        options = draw.choice(["", "", "--out there --set budget.time=99", "--tolerance=1%"])
        asked = typed(f"crosscheck run {path} {options}")
        if asked and (problem := posed(asked[0])) is not None:
            if seed % 7 == 0:  # from Python
                problem = replace(problem, scene=with_settings(problem.scene, ()))
            said |= check(stated(draw, problem), typed)
            number += 1
        if number == 200:
            break
    assert said >= KINDS
