"""Finite deformation of a scene: by either solver, and where contact ends with the pressures; flow
at finite strains, of which a light load is that of small strains; the change of peak pressure and
length by a law of elasticity, as `peak_change` has it, under a rigid roller."""

from dataclasses import replace
from functools import cache
from types import SimpleNamespace
from unittest.mock import patch

import numpy as np
import pytest
from scenes import RIGID_PAIR, STEEL, changed, finite_elements, lawed, problem

from analytic.material import Law, Material
from analytic.material.third_order import LENGTH_OVER_PEAK, peak_change
from comparisons.models.finite_element import level as finite_element_level_module
from comparisons.models.finite_element import loaded
from comparisons.models.finite_element.loaded import pressed_finitely
from comparisons.models.posing import problem_of
from comparisons.scenes.materials import solids
from comparisons.scenes.scene import Scene
from fem.nonlinear import finite_deformation
from fem.solver.mumps import FemError

RIGID = RIGID_PAIR | {"load": {"hertz_peak_pressure": 2e9}}
COMPUTED = {"kind": "sinusoid", "wavelength": 50e-6, "amplitude": 0.1e-6}


def pressed(problem, shift: float):
    """Strained pressures in every node, on the trace of a scene moved by `shift` [m]."""
    grid = problem.grid(problem.pitches[0])
    alone = np.where(np.arange(len(grid.x)) == len(grid.x) // 2, 1.0, 0.0)
    linear = SimpleNamespace(pressure=alone)
    finite = SimpleNamespace(pressure=np.ones(len(grid.x)))
    profile = problem.surface.profile
    if profile is not None:
        end = profile.x[-1] - grid.x[-1] - shift
        surface = replace(problem.surface, profile=profile.shifted(end))
        problem = replace(problem, surface=surface)
    with patch.object(loaded, "finite_contact", return_value=finite):
        return pressed_finitely(SimpleNamespace(problem=problem, grid=grid, solution=linear))


@pytest.mark.parametrize(
    ("profile", "pitches", "words"),
    [(None, 0, "elements$"), (COMPUTED, 9, "elements$"), (COMPUTED, 1, "trace: take a longer one")],
)
def test_it_is_told_what_ends_there(profile, pitches, words):
    posed = problem(RIGID if profile is None else RIGID | {"profile": profile})
    with pytest.raises(FemError, match=f"reaches beyond the .*{words}"):
        pressed(posed, pitches * posed.pitches[0])


ELASTIC = {"radius": 8e-3, **STEEL}
DISC = {"roller_body": "disc", "roller_shape": "circle"}
SMALL = {"growth": 0.5, "block": 50.0}  # few elements far from the contact


@pytest.mark.parametrize(
    ("roller", "shape"), [(RIGID["roller"], {}), (ELASTIC, {}), (ELASTIC, DISC)]
)
def test_the_linear_factors_lead_where_newtons_method_does(roller, shape):
    """To the same contact of a rough body under friction, rigid roller or elastic, which turns
    where it is a disc. Newton's method moves the bodies back to the end here."""
    tables = {
        "roller": roller,
        "body": {**STEEL, "youngs_modulus": 100e9},
        "load": {"hertz_peak_pressure": 1.5e9, "friction": 0.2},
        "profile": COMPUTED,
        "finite_element": {"deformation": "finite", "coupled": True, **SMALL, **shape},
    }
    posed = problem(tables)
    led = finite_elements(posed).solution
    with (
        patch.object(loaded, "solve_with_model", side_effect=FemError),
        patch.object(finite_deformation, "ASIDE", 1e-5),
    ):
        other = finite_elements(posed).solution
    assert led.iterations["newton_steps"] == 0 < led.iterations["corrections"]
    assert other.iterations["corrections"] == 0 < other.iterations["newton_steps"]
    assert led.converged and other.converged
    scale = other.pressure.max()
    np.testing.assert_allclose(led.pressure, other.pressure, atol=1e-5 * scale)
    assert led.approach == pytest.approx(other.approach, rel=1e-6)


def test_a_body_that_deforms_finitely_is_not_pressed_linearly_as_well(monkeypatch):
    monkeypatch.setattr(finite_element_level_module, "pressed_linearly", lambda *arguments: 1 / 0)
    posed = problem_of(Scene.read("finite-strain"))
    assert finite_elements(posed).solution.converged


def test_rubber_pressed_to_two_thirds_of_the_rollers_radius():
    """A bonded layer half a radius thick, nearly incompressible: the linear solution inverts
    elements, and the half-plane's contact would reach around the roller."""
    radius = 35e-3
    tables = {
        "roller": {"radius": radius, "rigid": True},
        "body": {"youngs_modulus": 0.275e6, "poissons_ratio": 0.475, "thickness": 17.5e-3},
        "load": {"per_length": 13.6e3},
    }
    half_widths, peaks = [], []
    for number, growth in enumerate([0.5, 0.2]):
        switches = {"deformation": "finite", "roller_shape": "circle", "growth": growth}
        posed = problem(tables | {"finite_element": switches})
        level = finite_elements(posed, posed.pitches[number])
        solution = level.solution
        assert solution.converged and solution.iterations["increments"] > 1
        assert solution.load == pytest.approx(13.6e3, rel=1e-9)
        half_widths.append(0.5 * np.ptp(level.patches) / radius)
        peaks.append(solution.pressure.max())
    assert half_widths == pytest.approx([0.666, 0.666], abs=2e-3)
    assert peaks[1] == pytest.approx(419e3, rel=5e-3)
    assert peaks[0] == pytest.approx(peaks[1], rel=1e-2)


@pytest.mark.parametrize("friction", [0.0, 0.2])
def test_a_cap_holds_by_deformed_area_and_small_loads_are_the_linear_theorys(friction):
    """The hardness is 0.7 times Hertz's peak: shears differ as the strains do."""
    left = []
    for curvature in (0.08, 0.02):
        peak = 0.5 * curvature * 210e9 / 0.91
        tables = {
            "roller": {"radius": 8e-3, "rigid": True},
            "body": {"youngs_modulus": 210e9, "poissons_ratio": 0.3, "hardness": 0.7 * peak},
            "load": {"hertz_peak_pressure": peak, "friction": friction},
            "stress": {"points": [30, 20]},
        }
        shears = {}
        for deformation in ("linear", "finite"):
            switches = {"deformation": deformation, "coupled": friction > 0.0}
            scene = problem(tables | {"finite_element": switches})
            level = finite_elements(scene, scene.hertz.half_width / 20.0, fields=True)
            pressure = level.solution.pressure
            assert level.solution.converged
            assert pressure.max() == pytest.approx(0.7 * peak, rel=1e-12)
            assert np.count_nonzero(pressure > 0.7 * peak * (1.0 - 1e-9)) > 30
            shears[deformation] = level.stress.extremes["txz"].value
        left.append(abs(shears["finite"] / shears["linear"] - 1.0))
    # under friction the difference changes its sign between these loads
    assert left[0] < 0.03 and left[1] < (4e-3 if friction else 0.4 * left[0])


LIGHT = {
    "roller": {"radius": 0.8, "rigid": True},
    "body": {**STEEL, "yield_stress": 1e8, "law": "hencky"},
    "load": {"hertz_peak_pressure": 2.4e8, "friction": 0.1},
    "resolution": {"elements": 4, "levels": 2},
    "stress": {"points": [20, 10]},
}
COATING = {"thickness": 1e-3, "youngs_modulus": 300e9, "poissons_ratio": 0.25, "law": "hencky"}


def level_of(deformation, coating):
    settings = {"plastic": True, "deformation": deformation, **SMALL}
    scene = LIGHT | ({"coating": coating} if coating else {})
    return finite_elements(problem(changed(scene, finite_element=settings)), fields=True)


@pytest.mark.parametrize("coating", [None, COATING], ids=["bare", "coated"])
def test_at_light_loads_finite_strains_are_small(coating):
    small, finite = (level_of(deformation, coating) for deformation in ("linear", "finite"))
    assert small.plastic_strain == pytest.approx(finite.plastic_strain, rel=0.02) != 0.0
    assert finite.contact_length == pytest.approx(small.contact_length, rel=2e-3)
    peaks = [level.solution.pressure.max() for level in (small, finite)]
    assert peaks[1] == pytest.approx(peaks[0], rel=2e-3)
    largest = [level.stress.extremes["tau1"].value for level in (small, finite)]
    assert np.isfinite([level.stress.maxima["txz"] for level in (small, finite)]).all()
    assert largest[1] == pytest.approx(largest[0], rel=5e-3)
    assert finite.mesh_field.others["residual_von_mises"].max() > 1e6
    assert finite.material is not None and small.material is None


@pytest.mark.parametrize("deformation", ["linear", "finite"])
def test_no_shear_is_larger_than_the_metal_bears(deformation):
    """Without hardening that is Y/sqrt 3; over J, where Kirchhoff's stress flows."""
    posed = problem(
        {
            "roller": {"radius": 8e-3, "rigid": True},
            "body": {**STEEL, "yield_stress": 340e6},
            "load": {"hertz_peak_pressure": 1.3e9, "friction": 0.2},
            "stress": {"points": [120, 40]},
            "finite_element": {"plastic": True, "deformation": deformation},
            "resolution": {"pitch": "20 um"},
        }
    )
    level = finite_elements(posed, fields=True)
    bulk = posed.scene.body.material.bulk_modulus
    compressed = level.solution.pressure.max() / bulk if deformation == "finite" else 0.0
    stress = level.stress
    for name, most in (("tau1", 340e6 / 3**0.5), ("txz", 340e6 / 3**0.5), ("von_mises", 340e6)):
        assert abs(stress.extremes[name].value) <= most * np.exp(compressed) * (1.0 + 1e-12)
    assert stress.extremes["tau1"].value == pytest.approx(340e6 / 3**0.5, rel=0.01)


RATIO = 0.05  # half-width over radius


@cache
def under_rigid_roller(material: Material) -> tuple[float, float]:
    """Peak pressure [Pa] and contact length [m]."""
    body = {"youngs_modulus": material.youngs_modulus, "poissons_ratio": material.poissons_ratio}
    tables = {
        "roller": {"radius": 5e-3, "rigid": True},
        "body": body | lawed(material.law),
        "load": {"hertz_peak_pressure": 0.5 * RATIO * material.plane_strain_modulus},
        "finite_element": {"deformation": "finite"},
    }
    posed = problem(tables)
    level = finite_elements(posed)
    return float(level.solution.pressure.max()), level.contact_length


def changes(material: Material) -> tuple[float, float]:
    """Changes of peak pressure and length from the neo-Hookean law, over p0/E."""
    neo_hookean = Material(material.youngs_modulus, material.poissons_ratio, Law())
    strain = 0.5 * RATIO * material.plane_strain_modulus / material.youngs_modulus
    pairs = zip(under_rigid_roller(material), under_rigid_roller(neo_hookean), strict=True)
    return tuple((value / plain - 1.0) / strain for value, plain in pairs)


@pytest.mark.parametrize(
    "name", ["carbon steel", "aluminium alloy", "tungsten", "niobium", "fused silica", "PMMA"]
)
def test_measured_laws_change_a_contact_as_their_constants_say(name):
    """Changes are of first order in the load; the rest is of the next order, 3 % of strain here."""
    material = solids()[name].material
    expected = peak_change(material.law, material)
    peak, length = changes(material)
    assert peak == pytest.approx(expected, rel=0.2, abs=0.1)
    assert length == pytest.approx(LENGTH_OVER_PEAK * peak, rel=0.3, abs=0.1)


@pytest.mark.parametrize("law", [Law("hencky"), Law("st-venant-kirchhoff")])
@pytest.mark.parametrize("poissons_ratio", [0.1, 0.3, 0.45])
def test_other_laws_too(law, poissons_ratio):
    material = Material(2e9, poissons_ratio, law)
    peak, _ = changes(material)
    assert peak == pytest.approx(peak_change(law, material), rel=0.04)


def test_the_third_constant_has_no_part_in_plane_strain():
    material = solids()["carbon steel"].material
    ell, m, _ = material.law.murnaghan
    law = Law("murnaghan", (ell, m, 0.0))
    without = Material(material.youngs_modulus, material.poissons_ratio, law)
    assert under_rigid_roller(without) == under_rigid_roller(material)
