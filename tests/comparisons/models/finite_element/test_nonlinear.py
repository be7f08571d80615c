"""Finite deformation of a scene: by either solver, and where contact ends with the pressures."""

from dataclasses import replace
from types import SimpleNamespace
from unittest.mock import patch

import numpy as np
import pytest
from scenes import STEEL, finite_elements, problem

from comparisons.models.finite_element import level as finite_element_level_module
from comparisons.models.finite_element import nonlinear as finite_element_nonlinear
from comparisons.models.finite_element.nonlinear import pressed_finitely
from comparisons.models.posing import problem_of
from comparisons.scenes.scene import Scene
from fem.nonlinear import finite_deformation
from fem.solver.mumps import FemError

RIGID = {
    "roller": {"radius": 8e-3, "rigid": True},
    "body": STEEL,
    "load": {"hertz_peak_pressure": 2e9},
}
COMPUTED = {"kind": "sinusoid", "wavelength": 50e-6, "amplitude": 0.1e-6}
WHOLE = SimpleNamespace(rough=SimpleNamespace(body=None))


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
    with patch.object(finite_element_nonlinear, "finite_contact", return_value=finite):
        return pressed_finitely(problem, WHOLE, grid, linear, problem.constraints(), None)


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
        "finite_element": {"deformation": "finite", "coupled": True, "block": 20.0, **shape},
    }
    posed = problem(tables)
    led = finite_elements(posed).solution
    with (
        patch.object(finite_element_nonlinear, "solve_with_model", side_effect=FemError),
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
        "finite_element": {"deformation": "finite", "roller_shape": "circle"},
    }
    posed = problem(tables)
    half_widths, peaks = [], []
    for pitch in posed.pitches[:2]:
        level = finite_elements(posed, pitch)
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
    """Of a body capped at 0.7 times Hertz's peak: shears differ as the strains do."""
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
            stress = level.stress
            shears[deformation] = stress.extremes["txz"].value
        left.append(abs(shears["finite"] / shears["linear"] - 1.0))
    # under friction the difference changes its sign between these loads
    assert left[0] < 0.03 and left[1] < (4e-3 if friction else 0.4 * left[0])
