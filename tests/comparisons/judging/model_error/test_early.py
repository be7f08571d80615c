"""What is said of the half-plane before finite elements are solved."""

from dataclasses import replace

import pytest
from scenes import half_plane_at

from comparisons.judging.model_error.study import early_lines


def lines_of(posed) -> tuple[str, str]:
    return early_lines(posed, half_plane_at(posed))


@pytest.mark.parametrize(
    ("tables", "left"),
    [
        ({}, "peak pressure 0.17 %, contact length 0.16 %, mostly law of elasticity"),
        (
            {"body": {"thickness": 1e-5}},
            "peak pressure 100 % or more, contact length 100 % or more, mostly finite thickness",
        ),
    ],
)
def test_figures_and_what_is_left_out(problem_with, tables, left):
    posed = problem_with(load={"hertz_peak_pressure": 1e8}, **tables)
    figures, beside = lines_of(posed)
    assert figures.startswith("half-plane: peak pressure 100.0 MPa, contact length 27.7")
    assert beside.startswith(f"left out, by estimates at most: {left}")


def test_what_flows_is_said_by_either_switch(problem_with):
    """The answer is the half-plane's, whatever the finite elements of the scene do."""
    posed = problem_with(body={"yield_stress": 4e8})
    switched = posed.scene.unchecked({"finite_element.plastic": True})
    said = lines_of(posed)
    assert lines_of(replace(posed, scene=switched)) == said
    assert said[1].endswith("mostly plastic flow")
