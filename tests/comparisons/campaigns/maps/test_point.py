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
from comparisons.studies.heat.half_space import HEAT_QUANTITIES

RIGID = {
    "roller": {"radius": 0.01, "rigid": True},
    "body": {"youngs_modulus": 2e11, "poissons_ratio": 0.3},
    "load": {"hertz_peak_pressure": 1e9},
}

STEEL = {"conductivity": 46.0, "density": 7850.0, "specific_heat": 460.0}
HEAT = {f"{body}_{name}": value for body in ("body", "roller") for name, value in STEEL.items()}
HEAT |= {"roller_conductivity": 1e-6, "roller_density": 2e-4}  # an insulator
HEAT |= {"speed": 1.0, "slide_to_roll": 2.0}
COATED_HEAT = {f"coating_{name}": HEAT[f"body_{name}"] for name in STEEL}


def found_at(scene: Scene, quantity: str = "peak_pressure") -> dict:
    return answered(solve_point, Point({}, quantity, scene, None, "key"))[0]


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
        "groups",
        [
            {"peclet": 1.0, "a_over_thickness": 1.5},
            {"peclet": 4.0, "a_over_thickness": 2.5},
            {"peclet": 2.0, "coating_over_a": 0.15, "conductivity_ratio": 0.1},
            {"peclet": 30.0, "coating_over_a": 0.05, "conductivity_ratio": 5.0},
        ],
    )
    def test_of_heat_it_is_the_exact_one(self, groups):
        """All heat of Hertz's contact enters a slab or a coated half-space: by the resistance of
        their surfaces at each wave number, on a long line."""
        coating = {"thickness": 1e-5, "youngs_modulus": 2e11, "poissons_ratio": 0.3}
        tables = RIGID | {"heat": HEAT, "load": RIGID["load"] | {"friction": [0.1]}}
        tables |= {"coating": coating} if "coating_over_a" in groups else {}
        tables["heat"] = HEAT | (COATED_HEAT if "coating_over_a" in groups else {})
        point = found_at(scene_with(Scene.of(tables), groups), "flash_temperature")
        assert point["status"] == SOLVED, point
        error = point["quantities"]["flash_temperature"]
        step, ring = 1.0 / 256, 2**18
        x = step * (np.arange(ring) - ring // 4)  # half-widths
        wave = 2.0 * np.pi * np.fft.rfftfreq(ring, step)
        wave[0] = wave[1]
        conductivity = {"body": 1.0, "coating": groups.get("conductivity_ratio", 1.0)}
        root = {  # a coating of the body's heat capacity
            name: np.sqrt(wave**2 + 2j * wave * groups["peclet"] / k)
            for name, k in conductivity.items()
        }
        half_space = 1.0 / root["body"]
        if "a_over_thickness" in groups:
            whole = np.tanh(root["body"] / groups["a_over_thickness"]) * half_space
        else:
            across = np.tanh(root["coating"] * groups["coating_over_a"])
            above = conductivity["coating"] * root["coating"]
            whole = (half_space + across / above) / (1.0 + above * half_space * across)

        def largest(resistance: np.ndarray) -> float:
            resistance[0] = 0.0
            flux = np.fft.rfft(np.sqrt(np.clip(1.0 - x**2, 0.0, None)))
            rise = np.fft.irfft(flux * resistance, ring)
            return (rise - rise[ring // 4 - 20 * 256])[np.abs(x) < 1.0].max()

        exact = largest(half_space) / largest(whole) - 1.0
        assert abs(error["difference"] - exact) <= error["uncertainty"] + 1e-3
        assert error["uncertainty"] < 0.05 * abs(exact)
        assert set(point["quantities"]) == set(HEAT_QUANTITIES)

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
