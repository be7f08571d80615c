"""The finite elements' compliance before contact: right where it is, and each error by its name."""

from dataclasses import replace

import numpy as np
import pytest
from scenes import STEEL, changed, resolved

from analytic.grid import HatGrid
from analytic.operators.half_plane import HalfPlane
from comparisons.common.progress import Stages
from comparisons.models.finite_element import bodies as finite_element_bodies
from comparisons.models.finite_element import compliance_check as operator_difference
from comparisons.models.finite_element import mesh as finite_element_mesh
from comparisons.models.finite_element.bodies import BodyCache, bodies_of
from comparisons.models.finite_element.compliance_check import (
    ComplianceCheck,
    ComplianceColumn,
    Differences,
    Wave,
    judged,
    no_check,
    operator_check,
)
from comparisons.models.finite_element.contact import mutual_compliance
from comparisons.models.finite_element.level import LevelOptions, finite_element_level
from comparisons.models.finite_element.mesh import Refinement
from comparisons.models.plan import make_plan
from comparisons.models.posing import problem_of
from comparisons.scenes.scene import Scene
from fem.body.elasticity import elastic_body

SMOOTH = {
    "title": "Smooth",
    "roller": {"radius": 8e-3, "rigid": True},
    "body": STEEL,
    "load": {"per_length": 1e6},
}
HALF_WIDTH = 2.1e-4
ELASTIC = {"rigid": False, "youngs_modulus": 210e9, "poissons_ratio": 0.2}
SINUSOID = {"kind": "sinusoid", "wavelength": 50e-6, "amplitude": 0.4e-6}


def scene(**sections):
    return resolved(changed(SMOOTH, **sections))


def checked(case) -> ComplianceCheck:
    problem = problem_of(case)
    plan, refinement = make_plan(problem, ("finite_element",)), Refinement(problem.pitches[0])
    asked = LevelOptions(check=True)
    level = finite_element_level(problem, plan, refinement, None, Stages(), options=asked)
    return level.operator


def differences(waves: dict[float, float], beyond: float = 1e-4) -> Differences:
    columns = (ComplianceColumn(0.0, 2.0 * beyond, beyond), ComplianceColumn(1.0, 1e-5, 1e-6))
    return Differences(columns, tuple(Wave(1e-6 * n, n, off) for n, off in waves.items()))


RIGHT = {4.0: -0.05, 8.0: -0.01, 20.0: -2e-3, 80.0: -3e-4}


class TestVerdict:
    @pytest.mark.parametrize(
        ("waves", "beyond", "word"),
        [
            (RIGHT, 1e-4, "neither"),
            (RIGHT | {4.0: -0.16}, 1e-4, "mesh"),
            (RIGHT | {8.0: -0.06}, 1e-4, "mesh"),
            (RIGHT | {4.0: 0.2, 8.0: 0.06}, 1e-4, "neither"),  # no mesh makes a body softer
            ({n: off - 0.1 for n, off in RIGHT.items()}, 0.05, "modulus"),
            ({n: off + 0.1 for n, off in RIGHT.items()}, 0.05, "modulus"),
            ({n: off - 0.01 for n, off in RIGHT.items()}, 1e-4, "neither"),
            ({4.0: -0.6, 8.0: -0.6, 20.0: -0.4, 80.0: -0.2}, 0.2, "mesh"),
            (RIGHT, 6e-3, "block"),
            ({4.0: -0.05}, 1e-4, "neither"),  # room for no other wave
        ],
    )
    def test_by_figures(self, waves, beyond, word):
        assert judged(differences(waves, beyond), ())[0] == word

    def test_a_body_that_the_surface_is_not_of_is_not_judged(self):
        word, because = judged(differences(RIGHT, 0.1), ("the rough boundary",))
        assert word == "geometry" and because.endswith(
            "the analytic surface does not model the rough boundary"
        )
        shared = differences({n: off + 0.1 for n, off in RIGHT.items()}, 1e-4)
        assert judged(shared, ("the rough boundary",))[0] == "neither"


class Softer:
    """A half-plane softer by a tenth, with a datum of its own, in place of finite elements."""

    def __init__(self, grid: HatGrid, modulus: float) -> None:
        self.half_plane = HalfPlane(grid.count, grid.pitch, modulus / 1.1, datum=1.0)

    def apply_all(self, pressures: np.ndarray) -> np.ndarray:
        return np.stack([self.half_plane.apply(pressure) for pressure in pressures.T], axis=1)


def test_a_known_difference_is_told_exactly_whatever_the_datum():
    problem = problem_of(scene())
    grid = problem.grid(problem.pitches[0])
    model = HalfPlane(grid.count, grid.pitch, problem.modulus)
    ranges = HALF_WIDTH * np.array([[-0.9, -0.2], [0.0, 0.8]])
    check = operator_check(problem, Softer(grid, problem.modulus), model, grid, ranges)
    for column in check.nearest.columns:
        assert column.difference == pytest.approx(0.1, rel=1e-9)
        assert 0.01 < column.beyond < column.difference
        assert np.any((ranges[:, 0] < column.x) & (column.x < ranges[:, 1]))
    waves = check.nearest.waves
    assert [wave.elements for wave in waves][:2] == [4.0, 8.0] and len(waves) == 5
    assert [wave.difference for wave in waves] == pytest.approx([0.1] * 5, rel=1e-9)
    assert waves[-1].length == pytest.approx(1.7 * HALF_WIDTH, rel=0.1)
    assert check.verdict == "modulus" and not check.datum and check.half_plane is None


class TestScenes:
    """Figures of right meshes and bodies, on the coarsest level."""

    @pytest.mark.parametrize(
        ("case", "shortest", "beyond"),
        [
            (scene(), 0.05, 1e-3),
            (scene(profile=SINUSOID), 0.05, 1e-3),
            (scene(body={"poissons_ratio": 0.4999}), 0.01, 1e-4),  # cubic
            (scene(body={"poissons_ratio": 0.4999}, finite_element={"element": "P2"}), 0.1, 4e-3),
            (scene(load={"friction": 0.3}, finite_element={"coupled": True}), 0.05, 2e-3),
            (scene(finite_element={"far_field": "half-plane"}), 0.05, 1e-3),
            (Scene.read("yielding"), 0.05, 1e-3),
        ],
    )
    def test_mesh_and_body_are_right(self, case, shortest, beyond):
        check = checked(case.unchecked({"finite_element.plastic": False}))
        assert check.verdict == "neither"
        waves = [wave.difference for wave in check.nearest.waves]
        assert -shortest < waves[0] < waves[1] < waves[2] < 0.0 and abs(waves[-1]) < 5e-3
        assert max(column.beyond for column in check.nearest.columns) < beyond
        assert check.half_plane is None and check.finite == ()

    @pytest.mark.parametrize(
        ("case", "finite", "datum", "column", "wave"),
        [
            (scene(body={"thickness": HALF_WIDTH}), "thickness", True, 0.42, -0.22),
            (scene(body={"thickness": 1e-3}, roller=ELASTIC), "thickness", False, 0.047, -0.039),
            (Scene.read("coated"), "coating", False, 0.05, -0.22),
        ],
    )
    def test_what_a_finite_body_does_is_told_apart(self, case, finite, datum, column, wave):
        check = checked(case)
        assert (check.verdict, check.finite, check.datum) == ("neither", (finite,), datum)
        assert max(row.difference for row in check.nearest.columns) < 0.02
        assert max(abs(row.difference) for row in check.nearest.waves) < 0.05
        half_plane = check.half_plane
        assert max(c.difference for c in half_plane.columns) == pytest.approx(column, rel=0.3)
        worst = max((row.difference for row in half_plane.waves), key=abs)
        assert worst == pytest.approx(wave, rel=0.3)

    @pytest.mark.parametrize(
        ("case", "count"),
        [
            (scene(profile=SINUSOID, finite_element={"geometry": "rough"}), 2),
            (scene(finite_element={"gap": "displaced"}), 1),
            (scene(body={"width": 20 * HALF_WIDTH, "thickness": 10 * HALF_WIDTH}), 1),
        ],
    )
    def test_geometry_of_its_own(self, case, count):
        check = checked(case)
        assert check.verdict == "geometry" and len(check.not_modelled) == count
        # a roller's normal leans by up to a/R; the sides are ten half-widths away
        assert 5e-3 < max(column.beyond for column in check.nearest.columns) < 0.03

    def test_a_body_that_slides_bears_no_pressure_that_leans(self):
        body = {"thickness": 1e-3, "width": 4e-3, "base": "frictionless"}
        leaning = scene(body=body, finite_element={"gap": "displaced"})
        assert no_check(scene(body=body)) is None
        plan = make_plan(problem_of(leaning), ("finite_element",))
        [skipped] = [s for s in plan.skipped if s.step == "check of the compliance before contact"]
        assert skipped.because == no_check(leaning)
        assert checked(leaning) is None


class TestSpoilt:
    """Each error alone, by its name."""

    @pytest.mark.parametrize("part", [1.1, 0.9])
    @pytest.mark.parametrize("poissons_ratio", [0.3, 0.4999])
    def test_a_wrong_modulus(self, part, poissons_ratio, monkeypatch):
        def wrong(mesh, material, support, **options):
            stiffer = replace(material, youngs_modulus=part * material.youngs_modulus)
            return elastic_body(mesh, stiffer, support, **options)

        monkeypatch.setattr(finite_element_bodies, "elastic_body", wrong)
        case = scene(body={"poissons_ratio": poissons_ratio}, finite_element={"element": "P2"})
        check = checked(case)
        assert check.verdict == "modulus"
        assert check.nearest.waves[-1].difference == pytest.approx(1.0 / part - 1.0, abs=6e-3)

    def test_a_wrong_modulus_of_a_layer(self, monkeypatch):
        def wrong(mesh, material, support, **options):
            stiffer = replace(material, youngs_modulus=1.1 * material.youngs_modulus)
            return elastic_body(mesh, stiffer, support, **options)

        monkeypatch.setattr(finite_element_bodies, "elastic_body", wrong)
        assert checked(scene(body={"thickness": HALF_WIDTH})).verdict == "modulus"

    @pytest.mark.parametrize(
        "case", [scene(), scene(body={"thickness": HALF_WIDTH}), scene(profile=SINUSOID)]
    )
    def test_edges_of_four_pressure_elements(self, case, monkeypatch):
        monkeypatch.setattr(finite_element_mesh, "EDGES_PER_HAT", 0.25)
        assert checked(case).verdict == "mesh"

    @pytest.mark.parametrize("poissons_ratio", [0.3, 0.4999])
    def test_linear_elements(self, poissons_ratio):
        body = {"poissons_ratio": poissons_ratio}
        assert checked(scene(body=body, finite_element={"element": "P1"})).verdict == "mesh"

    @pytest.mark.parametrize("profile", [None, SINUSOID])
    def test_a_small_block(self, profile):
        sections = {} if profile is None else {"profile": profile}
        check = checked(scene(finite_element={"block": 10.0}, **sections))
        assert check.verdict == "block"
        assert abs(check.nearest.waves[-1].difference) < 5e-3


def test_columns_at_once_are_columns_one_by_one():
    problem = problem_of(
        scene(roller=ELASTIC, load={"friction": 0.3}, finite_element={"coupled": True})
    )
    plan, refinement = make_plan(problem, ("finite_element",)), Refinement(problem.pitches[0])
    grid, patches = problem.grid(problem.pitches[0]), HALF_WIDTH * np.array([[-1.0, 1.0]])
    bodies = bodies_of(problem, plan, refinement, patches, Stages(), BodyCache())
    operator = mutual_compliance(problem, bodies, grid)
    assert len(operator.parts) == 2 and operator.coupled
    pressures = np.random.default_rng(4).uniform(size=(grid.count, 3))
    one_by_one = np.stack([operator.apply(pressure) for pressure in pressures.T], axis=1)
    assert operator.apply_all(pressures) == pytest.approx(one_by_one, rel=1e-11)


def test_packets_lie_where_the_mesh_is_refined():
    refined = np.zeros(400, dtype=bool)
    refined[[*range(20, 60), *range(250, 290), 390]] = True
    packet = operator_difference._packet(refined, 371, 8.0)
    assert np.flatnonzero(packet).min() >= 250 and np.flatnonzero(packet).max() < 290
    assert packet.max() == 1.0 and np.abs(packet).sum() > 4.0
