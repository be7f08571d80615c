"""A point of a map: its model error is the exact one where that is known."""

import numpy as np
import pytest

from analytic.exact.layers import layer_references
from analytic.exact.sliding import sliding_from_load
from comparisons.campaigns.grid import FAILED, SOLVED, Point, answered
from comparisons.campaigns.maps.groups import scene_with
from comparisons.campaigns.maps.point import is_open, solve_point
from comparisons.figures.figure import Figure
from comparisons.figures.uncertainty import Uncertainty
from comparisons.models.posing import problem_of
from comparisons.scenes.scene import Scene

RIGID = {
    "roller": {"radius": 0.01, "rigid": True},
    "body": {"youngs_modulus": 2e11, "poissons_ratio": 0.3},
    "load": {"hertz_peak_pressure": 1e9},
}


def found_at(scene: Scene) -> dict:
    return answered(solve_point, Point({}, "peak_pressure", scene, None, "key"))


def solved(scene: Scene) -> dict:
    point = found_at(scene)
    assert point["status"] == SOLVED, point
    return point["quantities"]


class TestModelError:
    LAYERS = tuple(
        case
        for case in layer_references()
        if (case.half_width, case.poissons_ratio, case.base)
        in (
            (0.1, 0.3, "bonded"),
            (0.25, 0.45, "bonded"),
            (1.0, None, "frictionless"),
            (4.0, 0.3, "bonded"),
        )
    )

    @pytest.mark.parametrize("case", LAYERS, ids=lambda case: f"{case.base}-{case.half_width}")
    def test_on_a_layer_it_is_the_exact_one(self, case):
        """Hertz's figures under the load that gives an exact contact, over that contact's."""
        smooth = 2.0 * np.sqrt(case.load / np.pi)  # a/t
        nu = 0.3 if case.poissons_ratio is None else case.poissons_ratio
        body = RIGID["body"] | {"poissons_ratio": nu, "thickness": 1.0, "base": case.base}
        errors = solved(scene_with(Scene.of(RIGID | {"body": body}), {"a_over_thickness": smooth}))
        exact = {
            "peak_pressure": 0.5 * smooth / case.peak_pressure - 1.0,
            "contact_length": smooth / case.half_width - 1.0,
        }
        for name, most in (("peak_pressure", 2e-4), ("contact_length", 4e-3)):
            error = errors[name]
            assert abs(error["difference"] - exact[name]) <= error["uncertainty"] <= most
            assert abs(exact[name]) > error["uncertainty"]

    def test_of_friction_that_moves_the_surfaces_it_is_the_exact_one(self):
        problem = problem_of(scene_with(Scene.of(RIGID), {"friction_dundurs": 0.25}))
        moved = sliding_from_load(
            problem.hertz.load_per_length,
            0.01,
            problem.modulus,
            problem.scene.load.friction[0],
            problem.dundurs_beta,
        )
        error = solved(problem.scene)["peak_pressure"]
        exact = problem.hertz.peak_pressure / moved.peak_pressure - 1.0
        assert abs(error["difference"] - exact) <= error["uncertainty"] < 0.1 * abs(exact)

    @pytest.mark.parametrize(
        ("difference", "uncertainty", "expected"),
        [(-0.3, 0.11, True), (-0.3, 0.09, False), (0.0, 0.004, True), (0.0, 0.003, False),
         (0.1, np.inf, True)],
    )  # fmt: skip
    def test_levels_are_added_while_the_uncertainty_would_show(
        self, difference, uncertainty, expected
    ):
        stated = Uncertainty({"numerical": uncertainty})
        error = Figure("map", "peak_pressure", "half_plane", difference, uncertainty=stated)
        assert is_open(error) is expected

    def test_what_cannot_be_solved_is_an_answer(self):
        point = found_at(scene_with(Scene.of(RIGID), {"a_over_width": 1.0}))
        assert point["status"] == FAILED
        assert "reaches the end of the body" in point["why"]
