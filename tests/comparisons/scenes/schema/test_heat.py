"""The [heat] section: its defaults, what moves, and what it refuses."""

import subprocess
import sys

import pytest
from scenes import PROJECT, SMOOTH, changed, problem, resolved

from comparisons.common.errors import SceneError
from comparisons.models.plan import make_plan
from comparisons.scenes.scene import Scene
from comparisons.studies.heat.half_space import check_heat, reach_of

CONSTANTS = {"conductivity": 46.0, "density": 7850.0, "specific_heat": 460.0}
STEEL = {
    f"{body}_{name}": value for body in ("body", "roller") for name, value in CONSTANTS.items()
}
HOT = changed(SMOOTH, load={"friction": 0.1}, heat={"speed": "1 m/s", **STEEL})


def test_defaults():
    heat = resolved(HOT).heat
    assert resolved(resolved(HOT).tables).heat == heat
    assert heat.body.diffusivity == pytest.approx(46.0 / (7850.0 * 460.0))
    assert reach_of(problem(HOT)) == SMOOTH["roller"]["radius"]
    assert resolved(SMOOTH).heat is None


@pytest.mark.parametrize(
    ("ratio", "body", "roller"),
    [(2.0, -1.0, 0.0), (-2.0, 0.0, 1.0), (0.1, -10.5, -9.5), (-1.0, 0.5, 1.5)],
)
def test_the_roller_drags_the_body_towards_x(ratio, body, roller):
    heat = resolved(changed(HOT, heat={"slide_to_roll": ratio})).heat
    assert heat.velocities == pytest.approx((body, roller))


@pytest.mark.parametrize(
    ("fields", "said"),
    [
        ({"speed": 0}, "heat.speed: is 0; allowed is a speed above 0"),
        ({"body_conductivity": "-46 W/m/K"}, 'heat.body_conductivity: is "-46 W/m/K"; allowed is'),
        ({"roller_density": "7850 kg"}, 'heat.roller_density: is "7850 kg"'),
        ({"slide_to_roll": 0}, "slides nowhere; allowed is from -2 to 2"),
        ({"slide_to_roll": 3}, "heat.slide_to_roll: is 3"),
        ({"base": "insulated"}, "heat.base: is given for a half-plane"),
        ({"coating_density": 1e3}, "heat.coating_density: is given for a body without one"),
        ({"conductivity": 46}, "heat.conductivity: is no known field; the nearest is"),
    ],
)
def test_refused(fields, said):
    with pytest.raises(SceneError) as error:
        resolved(changed(HOT, heat=fields))
    assert said in str(error.value)
    assert "\n" not in str(error.value)


STRESSED = changed(HOT, heat={"stresses": True, "body_expansion": "12 um/m/K"}, stress={})


@pytest.mark.parametrize("expansion", ["12 um/m/K", "12e-6 1/K", "12 ppm/K", 12e-6])
def test_thermal_stresses_are_asked_for(expansion):
    heat = resolved(changed(STRESSED, heat={"body_expansion": expansion})).heat
    assert (heat.body_expansion, heat.coating_expansion) == (pytest.approx(12e-6), None)
    assert resolved(HOT).heat.body_expansion is None


COAT = {"thickness": 1e-5, "youngs_modulus": 4e11, "poissons_ratio": 0.2}
FINITE = {"deformation": "finite", "coupled": True}
OF_COAT = {f"coating_{name}": value for name, value in CONSTANTS.items()}


@pytest.mark.parametrize(
    ("sections", "said"),
    [
        ({"heat": {"body_expansion": "-1 um/m/K"}}, 'body_expansion: is "-1 um/m/K"; allowed'),
        ({"heat": {"body_expansion": 0.1}}, "is 0.1; allowed is a coefficient of thermal"),
        ({"heat": {"body_expansion": "12 um/m"}}, 'heat.body_expansion: is "12 um/m"'),
        ({"heat": {"stresses": False}}, "is given without use; allowed with stresses = true"),
        ({"heat": {"coating_expansion": 1e-5}}, "coating_expansion: is given for a body without"),
        ({"coating": COAT, "heat": OF_COAT}, "coating_expansion: is missing; allowed is a"),
        ({"body": {"width": "4 mm"}}, "heat.stresses: is true for a body of finite width"),
        (
            {"finite_element": {"gap": "displaced"}},
            "is true beside a rough boundary or a",
        ),
        ({"finite_element": {"element": "P1"}}, "is true with linear elements; allowed with"),
        ({"finite_element": FINITE}, "is true beside a nonlinear body; allowed"),
    ],
)
def test_thermal_stresses_refused(sections, said):
    with pytest.raises(SceneError) as error:
        resolved(changed(STRESSED, **sections))
    assert said in str(error.value) and "\n" not in str(error.value)


def test_thermal_stresses_take_what_they_need():
    with pytest.raises(SceneError, match=r"is true without \[stress\]; allowed with it"):
        resolved({name: table for name, table in STRESSED.items() if name != "stress"})
    bare = {name: value for name, value in STRESSED["heat"].items() if name != "body_expansion"}
    with pytest.raises(SceneError, match=r"heat\.body_expansion: is missing for stresses = true"):
        resolved(STRESSED | {"heat": bare})
    for fields in ({"slide_to_roll": -2.0}, {"speed": 1e-3}):
        slow = problem(changed(STRESSED, heat=fields))
        with pytest.raises(SceneError, match=r"is true at a Peclet number of .* 0\.05 or more"):
            check_heat(slow)


def test_refused_by_the_rest_of_the_scene():
    with pytest.raises(SceneError, match=r"heat: is given without friction; allowed with load\."):
        resolved(changed(HOT, load={"friction": 0.0}))
    coated = {"coating": {"thickness": 1e-5, "youngs_modulus": 4e11, "poissons_ratio": 0.2}}
    with pytest.raises(SceneError, match=r"heat\.coating_conductivity: is missing; allowed is a"):
        resolved(HOT | coated)


@pytest.mark.parametrize(
    ("fields", "said"),
    [
        ({"speed": 5e7}, r"a Peclet number of 1\.07e\+09 of the body: heat would reach no depth"),
        ({"speed": 1e-6}, r"allowed is 4\.68e-05 m/s to 468 m/s here, Peclet numbers from 0\.001"),
        ({"reach": 1e-4}, r"heat\.reach: is 0\.0001 m; allowed is at least"),
        (
            {"reach": 0.1},
            r"is 0\.1 m in a roller at rest; allowed is at most 0\.0\d+ m, 1\.2",
        ),
    ],
)
def test_what_no_temperature_can_be_computed_for(fields, said):
    with pytest.raises(SceneError, match=said):
        check_heat(problem(changed(HOT, heat=fields)))


def test_a_scene_without_heat_says_so_and_loads_none_of_it():
    plan = make_plan(problem(SMOOTH), ("half_plane",))
    assert "frictional heat" in {skipped.step for skipped in plan.skipped}
    assert "frictional heat" not in {
        skipped.step for skipped in make_plan(problem(HOT), ("half_plane",)).skipped
    }
    code = (
        "import sys; from comparisons.runs.run import run; import comparisons.output.page.page\n"
        "from comparisons.scenes.scene import Scene\n"
        "run(Scene.read('smooth'), None, ('half_plane',))\n"
        "print([name for name in sys.modules if name.startswith(('analytic.heat', 'fem.heat'))])"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=PROJECT, capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == "[]"


def test_the_library_scene():
    assert Scene.read("frictional-heat").heat.velocities == (-1.0, 0.0)
