"""The model error of the half-plane by real finite elements: against exact layers, and as it
scales."""

import json
from collections.abc import Callable
from dataclasses import replace
from unittest.mock import patch

import pytest
from scenes import KNOWN_STEEL, exact_layer, refound, resolved, run_of

from analytic.exact.layers import TABLE
from comparisons.common.errors import ExitStatus
from comparisons.figures.figure import Figure, Part
from comparisons.figures.quantity import MODELS
from comparisons.figures.uncertainty import Uncertainty
from comparisons.judging.effects.catalogue import EFFECTS
from comparisons.judging.study import Run
from comparisons.judging.verdict.headline import kind_of, validity
from comparisons.models.finite_element import level
from comparisons.runs.run import run
from comparisons.scenes.scene import Scene
from meshes.block import MeshError

RIGID = {"radius": 10e-3, "rigid": True}
PEAK = {"quantity": "peak_pressure", "friction": 0.0}


def effects_of(error: Figure) -> list[Part]:
    return [part for part in error.parts if part.name in EFFECTS]


def smooth(peak_pressure: float, **tables: dict) -> dict:
    return {
        "roller": RIGID,
        "body": KNOWN_STEEL,
        "load": {"hertz_peak_pressure": peak_pressure},
        "tolerance": {"peak_pressure": 0.004, "contact_length": 0.1},
        "finite_element": {"plastic": False},  # steel flows at the higher of them
    } | tables


THICK_PLATE = {
    "roller": {"radius": 25e-3, "youngs_modulus": 200e9, "poissons_ratio": 0.3},
    "body": {"youngs_modulus": 200e9, "poissons_ratio": 0.3, "thickness": 40e-3},
    "load": {"per_length": 1e4},
    "stress": {"depth": 1.5, "points": [60, 20]},
}
CASES = [
    (case, nu)
    for case in json.loads(TABLE.read_text())["cases"]
    for nu in ([0.3] if case["nu"] == "any" else [float(case["nu"])])
    if (nu, case["a_over_t"] == "0.25") in [(0.3, False), (0.4999, True)]
]


@pytest.mark.parametrize(
    ("case", "nu"), CASES, ids=[f"{c['base']}-{c['a_over_t']}-{nu}" for c, nu in CASES]
)
def test_of_a_layer_it_is_the_exact_one_within_its_uncertainty(case, nu):
    tables, exact = exact_layer(case, nu)
    outcome = run_of(tables | {"budget": {"effects": False}})
    hertz, errors = outcome.problem.hertz, outcome.figures.of(study="model_error")
    half_plane = {"peak_pressure": hertz.peak_pressure, "contact_length": 2.0 * hertz.half_width}
    for quantity, true in exact.items():
        stated, error = errors.one(quantity=quantity), half_plane[quantity] / true - 1.0
        assert stated.value == pytest.approx(error, abs=stated.numerical)
        assert stated.numerical < 0.006
        # and it is the body's doing, measured against the same block without an end
        body = stated.part("finite_size")
        assert -body.value == pytest.approx(error, abs=stated.numerical + body.uncertainty)
        assert stated.part("interaction").value == 0.0


def test_a_thick_plate_counts_against_a_body_that_ends_farther_away():
    """743 half-widths thick: by the layer's own operator largest shears rise by 0.15 %."""
    outcome = run_of(THICK_PLATE)
    wanted = {"quantity": "tau1_max", "study": "layered", "source": "operators"}
    layer = outcome.figures.one(**wanted, against=None).value
    exact = layer / outcome.problem.hertz.tau1_max - 1.0
    part = outcome.model_errors.one(quantity="tau1_max").part("finite_size")
    assert exact == pytest.approx(0.001448, abs=3e-6)
    assert part.value == pytest.approx(exact, rel=0.1) and part.uncertainty < 0.5 * exact


@pytest.fixture
def outcomes() -> list[Run]:
    """Peak pressures, and so a/R and p/E, of one to two."""
    return [run_of(smooth(pressure)) for pressure in (2.0e9, 4.0e9)]


class TestSmooth:
    def test_finite_deformation_is_computed(self, outcomes):
        for outcome in outcomes:
            budget = outcome.data("model_error")
            assert budget.selection.added == {"finite_strain"}
            assert status_of(outcome, "exact_circle")[0] == "negligible"
            assert budget.unsplit is None and budget.levels >= 2

    def test_an_effect_of_first_order_doubles(self, outcomes):
        errors = [outcome.figures.one(study="model_error", **PEAK) for outcome in outcomes]
        one, other = (error.part("finite_strain").value for error in errors)
        assert 1.85 < other / one < 2.15

    def test_the_verdict_is_taken_from_it(self, outcomes):
        """Both models agree to 3e-4, and the half-plane is off by eight times as much."""
        last = outcomes[1]
        row = last.figures.one(study="comparison", quantity="peak_pressure")
        stated = last.figures.one(study="model_error", **PEAK)
        assert row.verdict == "agree" and abs(row.value) < 3e-4
        assert stated.value == pytest.approx(-0.0024, abs=0.0006) and stated.numerical < 6e-4
        errors = last.data("model_error").figures({"peak_pressure": 1e-3})
        assert validity([error for error in errors if error.bounds]) == "fails"

    def test_the_exit_status_counts_both_tables(self, outcomes):
        """The models agree; with this model error the half-plane holds, fails, or neither."""

        def status(model_error, difference=1e-4):
            sure, last = Uncertainty({"numerical": 1e-4}), outcomes[1]
            errors = [
                replace(error, value=model_error, uncertainty=sure, unknown={})
                for error in last.findings["model_error"].figures
            ]
            rows = [
                replace(row, value=difference, uncertainty=sure)
                for row in last.findings["comparison"].figures
            ]
            last = refound(last, "model_error", figures=tuple(errors))
            return refound(last, "comparison", figures=tuple(rows)).exit_status

        bound = outcomes[1].model_errors[0].tolerance
        assert status(1e-3) == ExitStatus.DONE
        assert status(bound) == status(1e-3, bound) == ExitStatus.INCONCLUSIVE
        for shown in (status(-3.0 * bound), status(1e-3, 3.0 * bound), status(-3.0 * bound, bound)):
            assert shown == ExitStatus.OUTSIDE_TOLERANCE

    def test_models_and_comparison_are_those_without_effects(self, outcomes):
        plain = run_of(smooth(2.0e9, budget={"effects": False}))
        for study in ("contact", "comparison", "problem"):
            assert plain.findings[study].figures == outcomes[0].findings[study].figures
        assert plain.data("model_error").selection.added == frozenset()
        assert kind_of(plain) == "inconclusive"


def status_of(outcome: Run, effect: str) -> tuple[str, str]:
    """Status of an effect, and its reason."""
    rows = outcome.findings["model_error"].table("effects").rows()
    return next((row["status"], row["because"]) for row in rows if row["effect"] == effect)


def test_where_the_half_plane_is_exact_it_has_no_error_and_holds():
    """A large roller under a light load: a/R and p/E of a thousandth and less."""
    tolerance = {"peak_pressure": 0.001, "contact_length": 0.01}
    outcome = run_of(smooth(1e8, roller={"radius": 0.1, "rigid": True}, tolerance=tolerance))
    for quantity in ("peak_pressure", "contact_length"):
        stated = outcome.figures.one(study="model_error", quantity=quantity)
        computed = sum(abs(effect.value) for effect in effects_of(stated))  # p/E is not zero
        assert abs(stated.value) <= stated.numerical + computed < 0.02
    assert kind_of(outcome) == "holds"


def run_without(tables: dict, cannot: Callable[[Scene], bool]) -> Run:
    """The run of a scene where some scenes of its finite elements have no mesh."""
    solve = level.finite_element_level

    def solved(problem, *arguments, **others):
        if cannot(problem.scene):
            raise MeshError("no mesh\nis possible")
        return solve(problem, *arguments, **others)

    with patch.object(level, "finite_element_level", solved):
        return run(resolved(tables), None, MODELS)


def test_an_effect_that_cannot_be_solved_is_not_modelled_with_its_reason():
    outcome = run_without(smooth(2.0e9), lambda s: s.finite_element.deformation == "finite")
    budget = outcome.data("model_error")
    selection = budget.selection
    assert selection.impossible["finite_strain"] == "no mesh is possible"
    assert selection.added == frozenset()
    assert effects_of(outcome.figures.one(study="model_error", **PEAK)) == []
    assert "finite_strain" in selection.not_modelled("peak_pressure")
    assert status_of(outcome, "finite_strain") == ("not computed", "no mesh is possible")


def test_without_a_solution_free_of_effects_nothing_is_split():
    body = {**KNOWN_STEEL, "thickness": 1e-3}
    outcome = run_without(smooth(1.0e9, body=body), lambda scene: scene.body.thickness is None)
    budget = outcome.data("model_error")
    assert budget.unsplit == "no mesh is possible" and budget.levels >= 2
    row = outcome.figures.one(study="comparison", quantity="peak_pressure")
    stated, whole = outcome.figures.one(study="model_error", **PEAK), budget.wholes[0]
    assert effects_of(stated) == [] and stated.part("interaction").value == 0.0
    assert "finite_strain" in budget.selection.added
    levels = outcome.runs["half_plane"].levels  # that on the same pressure elements
    half_plane = next(one for one in levels if one.grid == whole.grid)
    peaks = [float(one.solution.pressure.max()) for one in (half_plane, whole)]
    assert stated.value == pytest.approx(peaks[0] / peaks[1] - 1.0, abs=stated.numerical)
    assert abs(stated.value - row.value) > 1e-4


def test_variants_that_were_solved_before_an_interruption_are_not_solved_again(tmp_path):
    solve, solved = level.finite_element_level, []

    def counted(problem, *arguments, **others):
        if problem.scene.finite_element.element == "P2":  # others are shown for what they cost
            solved.append(problem)
        if len(solved) == stop:
            raise KeyboardInterrupt
        return solve(problem, *arguments, **others)

    scene = resolved(smooth(2.0e9))
    with (
        patch.object(level, "finite_element_level", counted),
        patch("comparisons.runs.write.write_files"),
    ):
        stop = 6  # levels and the half-size block are four; the budget's second level
        with pytest.raises(KeyboardInterrupt):
            run(scene, tmp_path / "out", MODELS)
        first, stop = len(solved), None
        again = run(scene, tmp_path / "out", MODELS)
        once = run(scene, tmp_path / "other", MODELS)
    assert again.figures == once.figures
    # the scene's own, the far-boundary check, and finite deformation on the budget's levels
    levels = len(once.runs["finite_element"].levels) + 1 + once.data("model_error").levels
    assert len(solved) - first == 2 * levels - (first - 1)
