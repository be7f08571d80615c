"""Maps: what may be asked for, and by what a point is known."""

import pytest

from comparisons.campaigns.maps.map import request_of
from comparisons.common.errors import InputError, SceneError
from comparisons.scenes.files import SCENES


class TestRequest:
    def test_usual_axes_are_what_the_scene_has(self):
        request = request_of("sinusoid", "2x2")
        assert (request.x["group"], request.y["group"]) == ("wavelength_over_a", "rms_slope")

    @pytest.mark.parametrize(
        ("arguments", "what"),
        [
            ({"x": "a_over_width", "y": "a_over_width"}, "--y: is a_over_width, as --x"),
            ({"quantity": "peak"}, "--quantity: there is no peak"),
        ],
    )
    def test_wrong_requests(self, arguments, what):
        with pytest.raises(InputError, match=f"^{what}"):
            request_of(**{"scene": "smooth", "points": "2x2"} | arguments)

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
        with pytest.raises(SceneError, match="which takes finite deformation"):
            _ = request_of("smooth", "2x2", "a_over_radius", "a_over_thickness").points
