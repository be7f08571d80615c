"""A point of a map: its model error is the exact one where that is known."""

from pathlib import Path

import numpy as np
import pytest

from analytic.exact.layers import layer_references
from analytic.exact.sliding import sliding_from_load
from comparisons.models.problem import problem_of
from comparisons.scenes.resolve import resolve_tables
from comparisons.studies.maps.groups import Origin, tables_with
from comparisons.studies.maps.point import PointError, solve_point
from comparisons.studies.maps.request import PointRequest
from comparisons.studies.points import FAILED, SOLVED

HERE = Origin("made.toml", Path("."))
RIGID = {
    "roller": {"radius": 0.01, "rigid": True},
    "body": {"youngs_modulus": 2e11, "poissons_ratio": 0.3},
    "load": {"hertz_peak_pressure": 1e9},
}


def found_at(tables: dict) -> dict:
    point = PointRequest(0.0, 0.0, "peak_pressure", tables, HERE.folder, "m", None, "key")
    return solve_point(point)["found"]


def solved(tables: dict) -> dict:
    found = found_at(tables)
    assert found["status"] == SOLVED, found
    return found["quantities"]


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
        found = solved(tables_with(RIGID | {"body": body}, {"a_over_thickness": smooth}, HERE))
        exact = {
            "peak_pressure": 0.5 * smooth / case.peak_pressure - 1.0,
            "contact_length": smooth / case.half_width - 1.0,
        }
        for name, most in (("peak_pressure", 2e-4), ("contact_length", 4e-3)):
            error = found[name]
            assert abs(error["difference"] - exact[name]) <= error["uncertainty"] <= most
            assert abs(exact[name]) > error["uncertainty"]

    def test_of_friction_that_moves_the_surfaces_it_is_the_exact_one(self):
        tables = tables_with(RIGID, {"friction_dundurs": 0.25}, HERE)
        problem = problem_of(resolve_tables(tables, name="m", **vars(HERE)))
        moved = sliding_from_load(
            problem.hertz.load_per_length,
            0.01,
            problem.modulus,
            problem.scene.friction[0],
            problem.dundurs_beta,
        )
        error = solved(problem.scene.tables)["peak_pressure"]
        exact = problem.hertz.peak_pressure / moved.peak_pressure - 1.0
        assert abs(error["difference"] - exact) <= error["uncertainty"] < 0.1 * abs(exact)

    @pytest.mark.parametrize(
        ("difference", "uncertainty", "is_open"),
        [(-0.3, 0.11, True), (-0.3, 0.09, False), (0.0, 0.004, True), (0.0, 0.003, False),
         (0.1, None, True)],
    )  # fmt: skip
    def test_levels_are_added_while_the_uncertainty_would_show(
        self, difference, uncertainty, is_open
    ):
        assert PointError(1.0, 1.0, difference, uncertainty).is_open is is_open

    def test_what_cannot_be_solved_is_an_answer(self):
        found = found_at(tables_with(RIGID, {"a_over_width": 1.0}, HERE))
        assert found["status"] == FAILED
        assert "reaches the end of the body" in found["why"]
