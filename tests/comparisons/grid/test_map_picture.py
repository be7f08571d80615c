"""Maps: pictures and counts show what their points say."""

import numpy as np
import pytest

from comparisons.drawing.style import drawing, svgs
from comparisons.grid.groups import axis_of
from comparisons.grid.map_error import BELOW, INCONCLUSIVE, SIGNIFICANT, points_within, significance
from comparisons.grid.map_picture import map_figure
from comparisons.grid.points import FAILED, SOLVED


def map_of(error, uncertainty: float = 1e-4) -> dict:
    """The content of a map with that error, a function of x and y."""
    x = axis_of("a_over_thickness=0.03:3", 9, "--x")
    y = axis_of("friction_dundurs=0.01:1", 7, "--y")

    def point(x: float, y: float) -> dict:
        figures = {"difference": error(x, y), "uncertainty": uncertainty}
        place = {"x": x, "y": y, "status": SOLVED, "error": SIGNIFICANT}
        return place | {"quantities": {"peak_pressure": figures}}

    return {
        "quantity": "peak_pressure",
        "scene": {"title": "Made"},
        "x": x,
        "y": y,
        "tolerances": [0.01, 0.02, 0.05, 0.1],
        "points": [point(u, v) for v in y["values"] for u in x["values"]],
    }


@pytest.fixture
def made() -> dict:
    return map_of(lambda x, y: 0.02 * (x / 0.3) ** 2 * (y / 0.1))


class TestPicture:
    def drawn(self, content: dict):
        with drawing():
            return map_figure(content).axes[0]

    @pytest.mark.parametrize(
        ("error", "shown"), [(-0.09, "−9.0"), (0.47, "+47"), (-0.0102, "−1.0"), (1e-4, "+0.010")]
    )
    def test_errors_are_stated_in_two_digits(self, error, shown):
        axes = self.drawn(map_of(lambda x, y: error, 1e-9))
        assert {text.get_text() for text in axes.texts} == {shown}

    def test_only_significant_errors_have_a_colour(self, made):
        made["points"][0]["error"] = BELOW
        made["points"][1]["error"] = INCONCLUSIVE
        made["points"][2] = {"x": 0.0, "y": 0.0, "status": FAILED, "why": "…"}
        axes = self.drawn(made)
        cells = axes.patches
        assert len(cells) == 63 - 1
        assert [cell.get_hatch() for cell in cells[:3]] == ["....", "////", None]
        assert [cell.get_facecolor()[3] for cell in cells[:3]] == [0.0, 0.0, 1.0]
        crosses = [line for line in axes.lines if line.get_marker() == "x"]
        assert len(crosses) == 1
        place = np.log10(made["x"]["values"][2]), np.log10(made["y"]["values"][0])
        assert np.allclose(crosses[0].get_xydata(), place)
        words = [text.get_text() for text in axes.get_legend().get_texts()]
        assert words[4:] == [
            "within its uncertainty, below 1 %",
            "within its uncertainty",
            "failed",
        ]

    def test_colours_are_of_the_error(self):
        """One band a colour, and a larger error is darker."""
        axes = self.drawn(map_of(lambda x, y: -0.004 * x / 0.03))
        colours = [cell.get_facecolor()[:3] for cell in axes.patches[:9]]
        brightness = np.array(colours) @ [0.299, 0.587, 0.114]
        assert np.all(np.diff(brightness) <= 0.0) and brightness[-1] < brightness[0] - 0.3

    @pytest.mark.parametrize("sign", [1.0, -1.0])
    def test_lines_are_where_the_error_is_the_tolerance(self, sign):
        axes = self.drawn(map_of(lambda x, y: sign * 0.01 * x / 0.2))
        places = [
            path.vertices[:, 0].mean() for line in axes.collections for path in line.get_paths()
        ]
        assert np.allclose(10.0 ** np.array(sorted(places)), [0.2, 0.4, 1.0, 2.0], rtol=0.02)

    @pytest.mark.parametrize(("largest", "count"), [(0.009, None), (0.03, 2), (0.2, 4)])
    def test_the_legend_names_the_lines_that_are_drawn(self, largest, count):
        legend = self.drawn(map_of(lambda x, y: -largest * x / 4.0)).get_legend()
        words = None if legend is None else [text.get_text() for text in legend.get_texts()]
        lines = [f"error of {share} %" for share in (1, 2, 5, 10)]
        assert words == (None if count is None else lines[:count])

    def test_equal_maps_give_equal_pictures(self, made):
        drawn = svgs(dict.fromkeys(("one", "other"), lambda: map_figure(made)))
        assert drawn["one"] == drawn["other"] and drawn["one"].startswith("<?xml")


@pytest.mark.parametrize(
    ("difference", "uncertainty", "kind"),
    [
        (0.02, 0.01, SIGNIFICANT),
        (-0.02, 0.03, INCONCLUSIVE),
        (0.002, 0.003, BELOW),
        (0.5, None, INCONCLUSIVE),
    ],
)
def test_an_error_is_held_against_its_uncertainty(difference, uncertainty, kind):
    error = {"difference": difference, "uncertainty": uncertainty}
    point = {"status": SOLVED, "quantities": {"peak_pressure": error}}
    assert significance(point, "peak_pressure") == {"error": kind}


def test_points_are_within_a_tolerance_with_all_their_uncertainty():
    content = map_of(lambda x, y: -0.01 * x / 0.3, 0.002)
    inside = sum(0.01 * x / 0.3 + 0.002 <= 0.02 for x in content["x"]["values"])
    assert points_within(content, 0.02) == 7 * inside < 63
    content["points"][0] = {"x": 0.0, "y": 0.0, "status": FAILED, "why": "…"}
    content["points"][1]["quantities"]["peak_pressure"]["uncertainty"] = None
    assert points_within(content, 0.02) == 7 * inside - 2
