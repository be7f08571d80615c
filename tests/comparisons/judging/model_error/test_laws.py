"""Changes by the law of elasticity: planes through three laws, published solids, scatter."""

from dataclasses import replace

import numpy as np
import pytest
from scenes import STEEL, finite_elements, lawed, problem, resolved, run_of

from analytic.material import Law
from comparisons.judging.effects.catalogue import LAW as EFFECT
from comparisons.judging.effects.laws import open_laws, point_of
from comparisons.judging.rule import values_of
from comparisons.scenes.materials import measured_solids, scaled_law, solids

STRAIN = {"deformation": "finite"}
QUANTITIES = ("peak_pressure", "contact_length")
PEAK = {"quantity": "peak_pressure"}


def scene(body: dict, roller: dict | None = None, **tables: dict) -> dict:
    """A smooth contact at 1.5 GPa."""
    load = {"hertz_peak_pressure": 1.5e9}
    return {"roller": {"radius": 8e-3, **(roller or body)}, "body": body, "load": load, **tables}


@pytest.fixture(scope="module")
def solved_with():
    """`solved_with(law)`: figures of both bodies of that law at finite deformation, coarsely."""
    known: dict[Law, dict[str, float]] = {}

    def solved(law: Law) -> dict[str, float]:
        if law not in known:
            posed = problem(scene(STEEL | lawed(law), finite_element=STRAIN))
            known[law] = values_of(finite_elements(posed), posed)
        return known[law]

    return solved


def test_the_plane_through_three_laws_holds_the_others(solved_with):
    """Solids that are no probe, solved by themselves: within a twentieth of the range in peaks, and
    within a fifth in lengths, which are read between nodes."""
    [law] = open_laws(resolved(scene(STEEL)))
    assert law.bodies == ("body", "roller")
    linear, probes = solved_with(Law()), {n: solved_with(kind) for n, kind in law.probes.items()}
    others = [kind for kind in law.laws if kind not in law.probes.values()]
    for name, close in zip(QUANTITIES, (0.05, 0.2), strict=True):
        changes = {probe: figures[name] / linear[name] - 1.0 for probe, figures in probes.items()}
        low, high = law.range(changes)
        assert low <= min(changes.values()) and max(changes.values()) <= high
        for other in (others[0], others[-1]):
            one = replace(law, solids=(*law.probes.items(), ("other", other)))
            ends = one.range(changes)  # the probes and this one
            change = solved_with(other)[name] / linear[name] - 1.0
            slack = close * (high - low)
            assert low - slack <= change <= high + slack
            assert ends[0] - slack <= change <= ends[1] + slack


def test_a_range_is_that_of_all_solids_where_figures_are_linear():
    [law] = open_laws(resolved(scene(STEEL)))
    slopes, origin = np.array([0.3, -0.7]), np.array(point_of(law.material.law, law.material))

    def change(other: Law) -> float:
        return float((point_of(other, law.material) - origin) @ slopes)

    ends = law.range({name: change(probe) for name, probe in law.probes.items()})
    every = [change(other) for other in law.laws]
    assert ends == pytest.approx((min(every), max(every)), rel=1e-9)


def test_a_body_is_like_solids_of_its_moduli_or_like_any():
    steel, unlike = (
        open_laws(resolved(scene(b)))[0] for b in (STEEL, STEEL | {"poissons_ratio": 0.1})
    )
    kinds = {solid.kind for solid in measured_solids("steel", "iron")}
    assert kinds == {"steel", "iron"} and len(steel.laws) == len(measured_solids("steel", "iron"))
    assert len(unlike.laws) == len(measured_solids()) > len(steel.laws)
    assert unlike.size > steel.size


def test_bodies_of_two_solids_vary_by_themselves():
    laws = open_laws(resolved(scene(STEEL, {"youngs_modulus": 70e9, "poissons_ratio": 0.33})))
    assert [law.bodies for law in laws] == [("body",), ("roller",)]


def test_a_steel_of_no_measured_constants_may_have_those_of_any_measured_steel():
    """Each body varies by itself: another steel of the same moduli need not have the same."""
    alike = {solids()[name].material for name in ("18CrNiMo7-6", "100Cr6")}
    assert len(alike) == 1
    case, ring = {"material": "18CrNiMo7-6"}, {"material": "100Cr6"}
    laws = open_laws(resolved(scene(case, ring)))
    assert [law.bodies for law in laws] == [("body",), ("roller",)]
    assert not any(law.is_scatter for law in laws)
    assert all(len(law.laws) == len(measured_solids("steel")) == 7 for law in laws)
    assert [law.bodies for law in open_laws(resolved(scene(case)))] == [("body", "roller")]


def test_a_known_law_is_not_open_and_measured_constants_scatter():
    assert open_laws(resolved(scene(STEEL | {"law": "hencky"}))) == ()
    [law] = open_laws(resolved(scene({"material": "rail steel"})))
    errors, constants = law.material.law.standard_errors, law.material.law.murnaghan
    assert law.is_scatter
    for place, (moved, share) in enumerate(zip(law.probes.values(), law.shares, strict=True)):
        step = np.subtract(moved.murnaghan, constants)
        assert np.count_nonzero(step) == 1
        assert share * step[place] == pytest.approx(errors[place])
    exact = 2.0 * np.hypot(0.03 * law.shares[0], 0.04 * law.shares[1])
    assert law.scatter((0.03, 0.04)) == pytest.approx(exact)


def test_a_soft_body_lies_between_the_laws_of_rubbers():
    [law] = open_laws(resolved(scene({"youngs_modulus": 3e6, "poissons_ratio": 0.49})))
    assert [kind.name for kind in law.laws] == ["neo-hookean", "hencky"]
    assert [kind.name for kind in law.probes.values()] == ["hencky"]  # the whole model is the other


def test_a_named_solid_decides_what_moduli_leave_open():
    """The error of a measured steel lies in the range of those that its moduli allow for; and it is
    known better."""
    steel = solids()["rail steel"]
    moduli = {name: steel.values[name].value for name in STEEL}
    asked = {"resolution": {"levels": 2}, "budget": {"time": 20.0}}
    asked["tolerance"] = {"peak_pressure": 0.015}
    named, bare = (run_of(scene(b, **asked)) for b in ({"material": "rail steel"}, moduli))
    sure, open_ = (done.figures.one(study="model_error", **PEAK) for done in (named, bare))
    low, high = (open_.value + sign * open_.unknown[EFFECT] for sign in (-1.0, 1.0))
    assert low < sure.value < high and high - low > 4.0 * sure.total
    assert sure.part(EFFECT) is None and open_.part(EFFECT) is not None
    assert (sure.verdict, open_.verdict) == ("holds", "inconclusive")
    whole = open_.scale * (1.0 + open_.value)  # the half-plane's own, whatever the law
    assert whole == pytest.approx(sure.scale * (1.0 + sure.value), rel=1e-6)


def test_laws_are_scaled_by_the_shear_modulus():
    [law] = open_laws(resolved(scene(STEEL)))
    solid = measured_solids("steel", "iron")[0]
    scaled = scaled_law(solid, law.material)
    assert scaled == law.laws[0]
    assert point_of(scaled, law.material) == pytest.approx(point_of(solid.law, solid.material))
