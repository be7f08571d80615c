"""The [heat] section: its defaults, what moves, and what no temperature can be computed for."""

import pytest
from scenes import HOT, SMOOTH, changed, problem, resolved

from comparisons.common.errors import SceneError
from comparisons.studies.heat.half_space import check_heat, reach_of

STRESSED = changed(HOT, heat={"stresses": True, "body_expansion": "12 um/m/K"}, stress={})


def test_defaults():
    heat = resolved(HOT).heat
    assert resolved(resolved(HOT).tables).heat == heat
    assert heat.body.diffusivity == pytest.approx(46.0 / (7850.0 * 460.0))
    assert heat.body_expansion is None
    assert reach_of(problem(HOT)) == SMOOTH["roller"]["radius"]
    assert resolved(SMOOTH).heat is None


@pytest.mark.parametrize(
    ("ratio", "body", "roller"),
    [(2.0, -1.0, 0.0), (-2.0, 0.0, 1.0), (0.1, -10.5, -9.5), (-1.0, 0.5, 1.5)],
)
def test_the_roller_drags_the_body_towards_x(ratio, body, roller):
    heat = resolved(changed(HOT, heat={"slide_to_roll": ratio})).heat
    assert heat.velocities == pytest.approx((body, roller))


@pytest.mark.parametrize("expansion", ["12 um/m/K", "12e-6 1/K", "12 ppm/K", 12e-6])
def test_thermal_stresses_are_asked_for(expansion):
    heat = resolved(changed(STRESSED, heat={"body_expansion": expansion})).heat
    assert (heat.body_expansion, heat.coating_expansion) == (pytest.approx(12e-6), None)


@pytest.mark.parametrize(
    ("tables", "fields", "said"),
    [
        (HOT, {"speed": 5e7}, r"a Peclet number of 1\.07e\+09 of the body: heat would reach no"),
        (HOT, {"speed": 1e-6}, r"allowed is 4\.68e-05 m/s to 468 m/s here, Peclet numbers from"),
        (HOT, {"reach": 1e-4}, r"heat\.reach: is 0\.0001 m; allowed is at least"),
        (HOT, {"reach": 0.1}, r"is 0\.1 m in a roller at rest; allowed is at most 0\.0\d+ m, 1\.2"),
        (STRESSED, {"slide_to_roll": -2.0}, r"is true at a Peclet number of .* 0\.05 or more"),
        (STRESSED, {"speed": 1e-3}, r"is true at a Peclet number of .* 0\.05 or more"),
    ],
)
def test_what_no_temperature_can_be_computed_for(tables, fields, said):
    with pytest.raises(SceneError, match=said):
        check_heat(problem(changed(tables, heat=fields)))
