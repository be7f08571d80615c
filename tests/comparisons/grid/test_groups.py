"""Groups of a map, its axes and what may be asked for; and its points: by what they are known, and
that their model error is the exact one where that is known."""

import numpy as np
import pytest

from analytic.exact.layers import layer_references
from analytic.exact.sliding import sliding_from_load
from comparisons.common.errors import InputError, SceneError
from comparisons.grid.groups import axis_of, counts_of, scene_with
from comparisons.grid.map import request_of
from comparisons.grid.map_error import solve_point
from comparisons.grid.points import FAILED, SOLVED, Point, answered
from comparisons.models.posing import problem_of
from comparisons.scenes.files import SCENES
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import surface_of

RIGID = {
    "roller": {"radius": 0.01, "rigid": True},
    "body": {"youngs_modulus": 2e11, "poissons_ratio": 0.3},
    "load": {"hertz_peak_pressure": 1e9},
}
ELASTIC = RIGID | {"roller": {"radius": 0.01, "youngs_modulus": 7e10, "poissons_ratio": 0.2}}
LENGTHS = {"shortest_wavelength": 2e-5, "roll_off_wavelength": 2e-4, "longest_wavelength": 2e-3}
WAVES = {
    "sinusoid": {"wavelength": 4e-5, "amplitude": 1e-7},
    "self-affine": {"hurst": 0.8, "samples": 512, "length": 1e-3, "rms_height": 2e-7},
    "ground": {"rms_height": 2e-7, "samples": 1024, "length": 2e-3, **LENGTHS},
}


SOME = (
    (0.1, 0.3, "bonded"),
    (0.25, 0.45, "bonded"),
    (1.0, None, "frictionless"),
    (4.0, 0.3, "bonded"),
)
LAYERS = [c for c in layer_references() if (c.half_width, c.poissons_ratio, c.base) in SOME]


def set_to(tables: dict, **values: float):
    """The problem of a scene whose groups have these values."""
    return problem_of(scene_with(Scene.of(tables), values))


class TestGroups:
    @pytest.mark.parametrize("name", ["a_over_thickness", "a_over_width"])
    def test_sizes_of_the_body_follow_the_half_width_that_the_curvature_gives(self, name):
        problem = set_to(RIGID, **{name: 0.25}, a_over_radius=0.02)
        size = getattr(problem.scene.body, name.removeprefix("a_over_"))
        assert problem.hertz.half_width == pytest.approx(0.02 * 0.01, rel=1e-12)
        assert problem.hertz.half_width / size == pytest.approx(0.25, rel=1e-12)
        settings = problem.scene.finite_element
        assert (settings.deformation, settings.roller_shape) == ("finite", "circle")

    def test_friction_moves_the_surfaces_of_the_finite_elements_alone(self):
        problem = set_to(
            ELASTIC | {"load": {"per_length": 1e5, "coupled": True}},
            **{"friction_dundurs": 0.05, "a_over_thickness": 1.0},
        )
        assert problem.scene.load.friction[0] * abs(problem.dundurs_beta) == pytest.approx(0.05)
        assert problem.scene.finite_element.coupled and not problem.scene.load.coupled
        assert problem.hertz.load_per_length == pytest.approx(1e5)

    def test_materials_take_their_constants(self):
        scene = set_to(ELASTIC, poissons_ratio=0.42, modulus_ratio=3.0).scene
        assert scene.body.poissons_ratio == 0.42
        assert scene.roller.youngs_modulus == pytest.approx(3.0 * scene.body.youngs_modulus)
        assert scene.roller.poissons_ratio == 0.2

    def test_hardness_and_yield_stress_keep_their_ratio(self):
        body = RIGID["body"] | {"hardness": 3e9, "yield_stress": 1e9}
        tables = RIGID | {"body": body}
        problem = set_to(tables, peak_pressure_over_hardness=0.8, poissons_ratio=0.2)
        scene = problem.scene
        assert problem.hertz.peak_pressure / scene.body.hardness == pytest.approx(0.8)
        assert scene.body.hardness / scene.body.yield_stress == pytest.approx(3.0)
        assert scene.finite_element.plastic

    @pytest.mark.parametrize("kind", WAVES)
    def test_waves_take_length_and_slope(self, kind):
        tables = RIGID | {
            "profile": {"kind": kind, **WAVES[kind]},
            "load": {"hertz_peak_pressure": 5e8},
        }
        values = {"wavelength_over_a": 0.5, "a_over_radius": 0.004}
        for slope in (None, 0.03):
            asked = values | ({} if slope is None else {"rms_slope": slope})
            problem = set_to(tables, **asked)
            section = problem.surface.completed(problem.scene.tables)["profile"]
            name = "wavelength" if kind == "sinusoid" else "shortest_wavelength"
            length = section.get(name, 4.0 * section["length"] / (section.get("samples", 2) - 1))
            assert length / problem.hertz.half_width == pytest.approx(0.5)
            if slope is None:  # a likeness
                slope = surface_of(Scene.of(tables)).info.roughness.rms_slope
            measured = problem.surface.info.roughness.rms_slope
            assert measured == pytest.approx(slope, rel=0.02 if kind == "sinusoid" else 1e-9)
            assert problem.rough_boundary

    def test_a_coating_follows_half_width_and_modulus_of_the_body(self):
        coated = ELASTIC | {"coating": {"thickness": 1e-5, **RIGID["body"]}}
        problem = set_to(coated, coating_over_a=0.2, coating_modulus_ratio=0.5)
        coating, half_width = problem.scene.coating, problem.hertz.half_width
        assert coating.thickness == pytest.approx(0.2 * half_width)
        assert coating.youngs_modulus == pytest.approx(0.5 * RIGID["body"]["youngs_modulus"])

    @pytest.mark.parametrize(
        ("tables", "group", "what"),
        [
            (RIGID, "rms_slope", "profile:"),
            (RIGID, "modulus_ratio", "roller.rigid:"),
            (RIGID, "peak_pressure_over_hardness", "body.yield_stress:"),
            (RIGID, "coating_over_a", r"coating: is missing; allowed for its groups is \[coating"),
            (ELASTIC, "a_over_radius", "a_over_radius, which needs finite"),
            (ELASTIC | {"roller": {"radius": 0.01} | RIGID["body"]}, "friction_dundurs", "body:"),
            (
                {**RIGID, "body": {**RIGID["body"], "thickness": 1e-3}, "load": {"approach": 1e-6}},
                "poissons_ratio",
                "load.approach:",
            ),
        ],
        ids=lambda value: value if isinstance(value, str) else "",
    )
    def test_what_is_missing_in_a_scene_is_named(self, tables, group, what):
        with pytest.raises(SceneError, match=what):
            set_to(tables, **{group: 0.1})


def test_axes():
    axis = axis_of("a-over-thickness=0.1:10", 3, "--x")
    assert (axis["group"], axis["logarithmic"]) == ("a_over_thickness", True)
    assert axis["values"] == [0.1, 1.0, 10.0]
    axis = axis_of("poissons_ratio", 3, "--x")
    assert (axis["values"], axis["logarithmic"]) == ([0.0, 0.245, 0.49], False)
    assert counts_of("3x12") == (3, 12)


def found_at(scene: Scene) -> dict:
    return answered(solve_point, Point({}, "peak_pressure", scene, None, "key"))


def solved(scene: Scene) -> dict:
    point = found_at(scene)
    assert point["status"] == SOLVED, point
    return point["quantities"]


class TestModelError:
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

    def test_what_cannot_be_solved_is_an_answer(self):
        point = found_at(scene_with(Scene.of(RIGID), {"a_over_width": 1.0}))
        assert point["status"] == FAILED
        assert "reaches the end of the body" in point["why"]


class TestRequest:
    def test_usual_axes_are_what_the_scene_has(self):
        content = request_of("sinusoid", "2x2").content
        assert [content[axis]["group"] for axis in "xy"] == ["wavelength_over_a", "rms_slope"]

    def test_stresses_take_a_window(self, tmp_path):
        text = (SCENES / "smooth.toml").read_text().partition("[stress]")
        (tmp_path / "bare.toml").write_text(text[0] + text[2].partition("\n\n")[2])
        with pytest.raises(InputError, match=r"^--quantity: tau1_max needs"):
            request_of(str(tmp_path / "bare.toml"), "2x2", quantity="tau1_max")

    def test_a_point_is_known_by_all_that_shapes_it(self):
        def keys(*arguments: str) -> list[str]:
            return [point.key for point in request_of(*arguments).points]

        axes = ("2x2", "a_over_thickness=1:2", "friction_dundurs=0.1:0.2")
        one = keys("thickness-friction", *axes)
        assert len(set(one)) == 4
        assert keys("thickness-friction", *axes) == one
        wider = keys("thickness-friction", "3x2", "a_over_thickness=1:4", axes[2])
        assert len(set(one) & set(wider)) == 4  # 1 and 2 are points of both
        assert not set(one) & set(keys("thickness-friction", *axes, "contact_length"))
        assert not set(one) & set(keys("curvature-thickness", *axes))

    def test_a_map_without_any_point_is_refused(self):
        with pytest.raises(SceneError, match="which needs finite deformation"):
            request_of("smooth", "2x2", "a_over_radius", "a_over_thickness")
