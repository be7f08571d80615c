"""Maps: groups take their values, the own error is the exact one, rules and pictures say so."""

from pathlib import Path

import numpy as np
import pytest

from analytic.exact.layer_references import layer_references
from analytic.exact.sliding import sliding_from_load
from comparisons.errors import InputError, SceneError
from comparisons.maps.axes import axis_of, counts_of
from comparisons.maps.content import BELOW, MISSING, TOLD, UNCLEAR, known
from comparisons.maps.groups import GROUPS, Origin, tables_with
from comparisons.maps.own_error import OwnError
from comparisons.maps.picture import map_figure, map_picture
from comparisons.maps.point import FAILED, SOLVED, is_open, solve_point
from comparisons.maps.request import Asked, request_of
from comparisons.maps.rule import rule_of
from comparisons.problem import problem_of
from comparisons.report.style import drawing
from comparisons.resolve import resolve_tables

HERE = Origin("made.toml", Path("."))
RIGID = {
    "roller": {"radius": 0.01, "rigid": True},
    "body": {"youngs_modulus": 2e11, "poissons_ratio": 0.3},
    "load": {"hertz_peak_pressure": 1e9},
}
ELASTIC = RIGID | {"roller": {"radius": 0.01, "youngs_modulus": 7e10, "poissons_ratio": 0.2}}
WAVES = {
    "sinusoid": {"kind": "sinusoid", "wavelength": 4e-5, "amplitude": 1e-7},
    "self-affine": {
        "kind": "self-affine",
        "hurst": 0.8,
        "samples": 512,
        "length": 1e-3,
        "rms_height": 2e-7,
    },
    "ground": {
        "kind": "ground",
        "rms_height": 2e-7,
        "samples": 1024,
        "length": 2e-3,
        "shortest_wavelength": 2e-5,
        "roll_off_wavelength": 2e-4,
        "longest_wavelength": 2e-3,
    },
}


def set_to(tables: dict, **values: float):
    """The problem of a scene whose groups have these values."""
    return problem_of(resolve_tables(tables_with(tables, values, HERE), name="m", **vars(HERE)))


def solved(tables: dict) -> dict:
    answer = solve_point(Asked(0.0, 0.0, "peak_pressure", tables, HERE.folder, "m", None, "key"))
    assert answer["found"]["status"] == SOLVED, answer
    return answer["found"]["quantities"]


class TestGroups:
    @pytest.mark.parametrize("name", ["a_over_thickness", "a_over_width"])
    def test_sizes_of_the_body_follow_the_half_width_that_the_curvature_gives(self, name):
        problem = set_to(RIGID, **{name: 0.25}, a_over_radius=0.02)
        size = getattr(problem.scene, name.removeprefix("a_over_"))
        assert problem.hertz.half_width == pytest.approx(0.02 * 0.01, rel=1e-12)
        assert problem.hertz.half_width / size == pytest.approx(0.25, rel=1e-12)
        settings = problem.scene.finite_element
        assert (settings.deformation, settings.roller_shape) == ("finite", "circle")

    def test_friction_moves_the_surfaces_of_the_finite_elements_alone(self):
        problem = set_to(
            ELASTIC | {"load": {"per_length": 1e5, "coupled": True}},
            **{"friction_dundurs": 0.05, "a_over_thickness": 1.0},
        )
        assert problem.scene.friction[0] * abs(problem.dundurs_beta) == pytest.approx(0.05)
        assert problem.scene.finite_element.coupled and not problem.scene.coupled
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
        assert problem.hertz.peak_pressure / scene.hardness == pytest.approx(0.8)
        assert scene.hardness / scene.yielding.stress == pytest.approx(3.0)
        assert scene.finite_element.plastic

    @pytest.mark.parametrize("kind", WAVES)
    def test_waves_take_length_and_slope(self, kind):
        tables = RIGID | {"profile": WAVES[kind], "load": {"hertz_peak_pressure": 5e8}}
        values = {"wavelength_over_a": 0.5, "a_over_radius": 0.004}
        for slope in (None, 0.03):
            asked = values | ({} if slope is None else {"rms_slope": slope})
            problem = set_to(tables, **asked)
            own = problem.scene.tables["profile"]
            name = "wavelength" if kind == "sinusoid" else "shortest_wavelength"
            length = own.get(name, 4.0 * own["length"] / (own.get("samples", 2) - 1))
            assert length / problem.hertz.half_width == pytest.approx(0.5)
            if slope is None:  # a likeness
                plain = resolve_tables(tables, name="m", **vars(HERE))
                slope = plain.profile_info.roughness.rms_slope
            found = problem.scene.profile_info.roughness.rms_slope
            assert found == pytest.approx(slope, rel=0.02 if kind == "sinusoid" else 1e-9)
            assert problem.scene.finite_element.geometry == "rough"
            assert problem.scene.finite_element.gap == "displaced"

    def test_a_held_far_boundary_gives_way_to_the_bodys_own(self):
        tables = RIGID | {"finite_element": {"far_field": "half-plane"}}
        assert set_to(tables, a_over_thickness=1.0).scene.finite_element.far_field == "held"

    @pytest.mark.parametrize(
        ("tables", "group", "what"),
        [
            (RIGID, "rms_slope", "profile:"),
            (RIGID, "modulus_ratio", "roller.rigid:"),
            (RIGID, "peak_pressure_over_hardness", "body.yield_stress:"),
            (ELASTIC, "a_over_radius", "a_over_radius, which takes finite"),
            (
                ELASTIC | {"roller": {"radius": 0.01} | RIGID["body"]},
                "friction_dundurs",
                "body:",
            ),
            (
                {
                    **RIGID,
                    "body": {**RIGID["body"], "thickness": 1e-3},
                    "load": {"approach": 1e-6},
                },
                "a_over_thickness",
                "load.approach:",
            ),
        ],
        ids=lambda value: value if isinstance(value, str) else "",
    )
    def test_what_a_scene_lacks_is_named(self, tables, group, what):
        with pytest.raises(SceneError, match=what):
            set_to(tables, **{group: 0.1})


class TestOwnError:
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
    def test_on_a_layer_is_the_exact_one(self, case):
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
            own = found[name]
            assert abs(own["difference"] - exact[name]) <= own["uncertainty"] <= most
            assert abs(exact[name]) > own["uncertainty"]  # it is told

    def test_of_friction_that_moves_the_surfaces_is_the_exact_one(self):
        problem = set_to(RIGID, friction_dundurs=0.25)
        moved = sliding_from_load(
            problem.hertz.load_per_length,
            0.01,
            problem.modulus,
            problem.scene.friction[0],
            problem.dundurs_beta,
        )
        own = solved(problem.scene.tables)["peak_pressure"]
        exact = problem.hertz.peak_pressure / moved.peak_pressure - 1.0
        assert abs(own["difference"] - exact) <= own["uncertainty"] < 0.1 * abs(exact)

    def test_levels_are_added_while_it_is_not_told(self):
        def one(difference: float, uncertainty: float | None) -> OwnError:
            return OwnError(1.0, 1.0, difference, uncertainty)

        assert is_open(one(-0.3, 0.11)) and not is_open(one(-0.3, 0.09))
        assert is_open(one(0.0, 0.004)) and not is_open(one(0.0, 0.003))
        assert is_open(one(0.1, None))

    def test_what_cannot_be_solved_is_an_answer(self):
        tables = tables_with(RIGID, {"a_over_width": 1.0}, HERE)
        answer = solve_point(Asked(1.0, 1.0, "peak_pressure", tables, HERE.folder, "m", None, "k"))
        assert answer["found"]["status"] == FAILED
        assert "reaches the end of the body" in answer["found"]["why"]


@pytest.fixture
def made(smooth_map) -> dict:
    return smooth_map(lambda x, y: 0.02 * (x / 0.3) ** 2 * (y / 0.1))


@pytest.fixture
def smooth_map():
    """smooth_map(error): the content of a map with that error, of x and y."""

    def content(error, uncertainty: float = 1e-4) -> dict:
        axes = {
            "x": ("a_over_thickness", "a/t", np.geomspace(0.03, 3.0, 9)),
            "y": ("friction_dundurs", "μβ", np.geomspace(0.01, 1.0, 7)),
        }
        points = [
            {
                "x": x,
                "y": y,
                "status": SOLVED,
                "error": TOLD,
                "quantities": {
                    "peak_pressure": {"difference": error(x, y), "uncertainty": uncertainty}
                },
            }
            for y in axes["y"][2]
            for x in axes["x"][2]
        ]
        return {
            "quantity": "peak_pressure",
            "scene": {"title": "Made"},
            **{
                name: {
                    "group": group,
                    "symbol": symbol,
                    "label": "",
                    "logarithmic": True,
                    "values": values.tolist(),
                }
                for name, (group, symbol, values) in axes.items()
            },
            "tolerances": [0.01, 0.02, 0.05, 0.1],
            "points": points,
        }

    return content


def transposed(content: dict) -> dict:
    points = np.array(content["points"], dtype=object)
    turned = points.reshape(7, 9).T.ravel().tolist()
    return content | {"x": content["y"], "y": content["x"], "points": turned}


class TestRule:
    def test_a_power_law_is_found_from_its_good_side(self, made):
        rule = rule_of(made, 0.02)
        assert (rule.group, rule.of, rule.side) == ("a_over_thickness", "friction_dundurs", "below")
        assert rule.exponent == -0.5
        assert 0.94 * 0.3 * 0.1**0.5 < rule.coefficient < 0.3 * 0.1**0.5
        assert rule.inside >= 0.9 * rule.within and rule.largest <= 0.02
        assert rule.law == f"a/t < {rule.coefficient:g} (μβ)^-0.5"
        assert "keeps the peak pressure within 2 % for a/t = 0.03 to 3 and μβ = 0.01" in rule.text

    def test_either_axis_and_end_may_bound(self, smooth_map):
        rule = rule_of(transposed(smooth_map(lambda x, y: -0.02 * (0.3 / x) ** 2)), 0.02)
        assert (rule.group, rule.side, rule.exponent) == ("a_over_thickness", "above", 0.0)
        assert 0.3 < rule.coefficient < 0.33

    def test_errors_that_add_bound_both_groups(self, smooth_map):
        content = smooth_map(lambda x, y: -0.02 * ((x / 0.3) ** 2 + (y / 0.15) ** 2))
        rule = rule_of(content, 0.02)
        assert rule.inside >= 0.8 * rule.within
        assert (rule.group, rule.side, rule.of_span[0]) == ("a_over_thickness", "below", 0.01)
        assert rule.of_span[1] == pytest.approx(0.1)
        assert rule.law.endswith("and μβ <= 0.1")
        values = {"x": content["x"]["values"], "y": content["y"]["values"]}
        held = [
            0.02 * ((x / 0.3) ** 2 + (y / 0.15) ** 2)
            for y in values["y"]
            for x in values["x"]
            if y <= rule.of_span[1] and x < rule.coefficient * y**rule.exponent
        ]
        assert len(held) == rule.inside and max(held) == pytest.approx(rule.largest)
        assert max(held) <= 0.02

    def test_uncertainty_counts(self, smooth_map):
        def error(x, y):
            return 0.02 * (x / 0.3)

        sure, unsure = (rule_of(smooth_map(error, size), 0.02) for size in (1e-6, 0.005))
        assert unsure.coefficient < 0.85 * sure.coefficient

    def test_a_failed_point_ends_its_line(self, made):
        before = rule_of(made, 0.1)
        good = next(
            n
            for n, p in enumerate(made["points"])
            if p["x"] > 0.08 and p["quantities"]["peak_pressure"]["difference"] < 0.01
        )
        made["points"][good] = {"x": 0.0, "y": 0.0, "status": FAILED, "why": "…"}
        after = rule_of(made, 0.1)
        assert after.inside < before.inside
        held = {
            "a_over_thickness": made["x"]["values"][good % 9],
            "friction_dundurs": made["y"]["values"][good // 9],
        }
        own, of = held[after.group], held[after.of]
        limit = after.coefficient * of**after.exponent
        bounded = own < limit if after.side == "below" else own > limit
        assert not (bounded and after.of_span[0] <= of <= after.of_span[1])

    def test_everywhere_and_nowhere(self, smooth_map):
        everywhere = rule_of(smooth_map(lambda x, y: 1e-3), 0.02)
        assert (everywhere.inside, everywhere.coefficient, everywhere.law) == (
            63,
            None,
            "everywhere",
        )
        nowhere = rule_of(smooth_map(lambda x, y: 0.3), 0.02)
        assert (nowhere.inside, nowhere.largest, nowhere.law) == (0, None, "no simple bound")


class TestPicture:
    def drawn(self, content: dict):
        with drawing():
            return map_figure(content).axes[0]

    @pytest.mark.parametrize(
        ("error", "told"), [(-0.09, "−9.0"), (0.47, "+47"), (-0.0102, "−1.0"), (1e-4, "+0.010")]
    )
    def test_errors_are_told_in_two_digits(self, smooth_map, error, told):
        axes = self.drawn(smooth_map(lambda x, y: error, 1e-9))
        assert {text.get_text() for text in axes.texts} == {told}

    def test_only_what_is_told_has_a_colour(self, made):
        made["points"][0]["error"] = BELOW
        made["points"][1]["error"] = UNCLEAR
        made["points"][2] = {"x": 0.0, "y": 0.0, "status": FAILED, "why": "…"}
        made["points"][3] = {"x": 0.0, "y": 0.0, "status": MISSING}
        axes = self.drawn(made)
        cells = axes.patches
        assert len(cells) == 63 - 2
        assert [cell.get_hatch() for cell in cells[:3]] == ["....", "////", None]
        assert [cell.get_facecolor()[3] for cell in cells[:3]] == [0.0, 0.0, 1.0]
        crosses = [line for line in axes.lines if line.get_marker() == "x"]
        assert len(crosses) == 1
        place = np.log10(made["x"]["values"][2]), np.log10(made["y"]["values"][0])
        assert np.allclose(crosses[0].get_xydata(), place)
        words = [text.get_text() for text in axes.get_legend().get_texts()]
        assert words[4:] == [
            "not told from numerical error, below 1 %",
            "not told from numerical error",
            "failed",
            "blank: not computed",
        ]

    def test_colours_are_of_the_error(self, smooth_map):
        """One band a colour, and a larger error is darker."""
        axes = self.drawn(smooth_map(lambda x, y: -0.004 * x / 0.03))
        colours = [cell.get_facecolor()[:3] for cell in axes.patches[:9]]
        brightness = np.array(colours) @ [0.299, 0.587, 0.114]
        assert np.all(np.diff(brightness) <= 0.0) and brightness[-1] < brightness[0] - 0.3

    @pytest.mark.parametrize("sign", [1.0, -1.0])
    def test_lines_are_where_the_error_is_the_tolerance(self, smooth_map, sign):
        axes = self.drawn(smooth_map(lambda x, y: sign * 0.01 * x / 0.2))
        found = [
            path.vertices[:, 0].mean() for line in axes.collections for path in line.get_paths()
        ]
        assert np.allclose(10.0 ** np.array(sorted(found)), [0.2, 0.4, 1.0, 2.0], rtol=0.02)

    @pytest.mark.parametrize(("largest", "count"), [(0.009, None), (0.03, 2), (0.2, 4)])
    def test_the_legend_names_the_lines_that_are_drawn(self, smooth_map, largest, count):
        legend = self.drawn(smooth_map(lambda x, y: -largest * x / 4.0)).get_legend()
        words = None if legend is None else [text.get_text() for text in legend.get_texts()]
        lines = [f"error of {share} %" for share in (1, 2, 5, 10)]
        assert words == (None if count is None else lines[:count])

    def test_equal_maps_give_equal_pictures(self, made):
        text = map_picture(made)
        assert text == map_picture(made) and text.startswith("<?xml")


class TestAsked:
    def test_axes(self):
        axis = axis_of("a-over-thickness=0.1:10", 3, "--x")
        assert (axis.group, axis.values, axis.logarithmic) == (
            "a_over_thickness",
            (0.1, 1.0, 10.0),
            True,
        )
        assert str(axis) == "a_over_thickness=0.1:10"
        axis = axis_of("poissons_ratio", 3, "--x")
        assert (axis.values, axis.logarithmic) == ((0.0, 0.245, 0.49), False)
        assert counts_of("3x12") == (3, 12)

    @pytest.mark.parametrize(
        ("given", "what"),
        [
            ("a_over_thicknes", "--x: there is no group a_over_thicknes; the nearest is a_over_th"),
            ("rms_slope=0.2:0.1", "--x: the range is 0.2:0.1"),
            ("rms_slope=a:b", "--x: the range is a:b"),
            ("rms_slope=0:1", "--x: rms_slope begins at 0"),
            ("rms_slope=1", "--x: is 'rms_slope=1'"),
        ],
    )
    def test_wrong_axes(self, given, what):
        with pytest.raises(InputError, match=f"^{what}"):
            axis_of(given, 3, "--x")

    @pytest.mark.parametrize("given", ["3", "1x3", "3x201", "x", "3x-2"])
    def test_wrong_points(self, given):
        with pytest.raises(InputError, match=r"^--points: is"):
            counts_of(given)

    def test_usual_axes_are_what_the_scene_has(self):
        assert [
            axis.group
            for axis in vars(request_of("sinusoid", "2x2")).values()
            if hasattr(axis, "group")
        ] == ["wavelength_over_a", "rms_slope"]

    @pytest.mark.parametrize(
        ("arguments", "what"),
        [
            ({"x": "a_over_width", "y": "a_over_width"}, "--y: is a_over_width, as --x"),
            ({"quantity": "peak"}, "--quantity: there is no peak"),
            ({"quantity": "tau1_max", "scene": "thickness-friction"}, "--quantity: tau1_max needs"),
            ({"scene": "nothing"}, "nothing: is neither a file nor a scene"),
        ],
    )
    def test_wrong_requests(self, arguments, what):
        with pytest.raises(InputError, match=f"^{what}"):
            request_of(**{"scene": "smooth", "points": "2x2"} | arguments)

    def test_a_point_is_known_by_all_that_shapes_it(self):
        def keys(*arguments: str) -> list[str]:
            return [point.key for point in request_of(*arguments).points]

        axes = ("2x2", "a_over_thickness=1:2", "friction_dundurs=0.1:0.2")
        one = keys("thickness-friction", *axes)
        assert len(set(one)) == 4
        assert keys("thickness-friction", *axes) == one
        wider = keys("thickness-friction", "3x2", "a_over_thickness=1:4", axes[2])
        assert set(one) & set(wider) == {one[0], one[2], one[1], one[3]} & set(wider)
        assert len(set(one) & set(wider)) == 4  # 1 and 2 are points of both
        assert not set(one) & set(keys("thickness-friction", *axes, "contact_length"))
        assert not set(one) & set(keys("curvature-thickness", *axes))

    def test_a_map_without_any_point_is_refused(self):
        with pytest.raises(SceneError, match="which takes finite deformation"):
            _ = request_of("smooth", "2x2", "a_over_radius", "a_over_thickness").points


@pytest.mark.parametrize(
    ("difference", "uncertainty", "kind"),
    [(0.02, 0.01, TOLD), (-0.02, 0.03, UNCLEAR), (0.002, 0.003, BELOW), (0.5, None, UNCLEAR)],
)
def test_what_is_known_of_an_error(difference, uncertainty, kind):
    own = {"difference": difference, "uncertainty": uncertainty}
    found = {"status": SOLVED, "quantities": {"peak_pressure": own}}
    assert known(found, "peak_pressure") == {"error": kind}


def test_every_group_has_words_and_a_span():
    for group in GROUPS.values():
        assert group.symbol and group.label and group.span[0] < group.span[1]
