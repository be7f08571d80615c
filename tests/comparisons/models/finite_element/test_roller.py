"""Support of an elastic roller, and what that changes in its contact; the real boundary of a rough
body: the trace under every pressure element, on every level."""

from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest
from scenes import STEEL, changed, finite_elements, problem

from comparisons.common.errors import SceneError
from comparisons.common.progress import Stages
from comparisons.judging.effects.catalogue import estimates
from comparisons.judging.effects.estimates import Shown
from comparisons.models.finite_element.bodies import BodyCache, bodies_of
from comparisons.models.finite_element.mesh import Refinement, block_spec, rough_mesh
from comparisons.models.plan import make_plan
from comparisons.models.problem import Problem
from meshes.block import BlockMesh, real_points
from meshes.build import build_block
from meshes.quality import scaled_jacobians
from tests.finite_strain_check.figures import figures
from tests.finite_strain_check.solve import HUB, OPPOSITE, RING, Task, solutions

RADIUS = 10e-3
POLYMER = {"youngs_modulus": 3e9, "poissons_ratio": 0.4}
SUPPORTS = {
    "sector": None,
    "opposite": "opposite",
    "half disc": "half disc",
    "hub of 0.3": {"hub": 0.3 * RADIUS},
    "hub of 0.5": {"hub": 0.5 * RADIUS},
    "ring of the check": {"hub": HUB * RADIUS},
}


def posed(material: str, curvature: float, support: object, **switches: object) -> Problem:
    roller = {"polymer": POLYMER, "steel": STEEL}[material]
    compliance = sum((1 - b["poissons_ratio"] ** 2) / b["youngs_modulus"] for b in (roller, STEEL))
    body = {"roller_body": "disc", "roller_shape": "circle", "deformation": "finite"}
    tables = {
        "roller": {"radius": RADIUS, **roller},
        "body": dict(STEEL),
        "load": {"hertz_peak_pressure": 0.5 * curvature / compliance},
        "finite_element": body | switches,
    }
    return problem(tables if support is None else changed(tables, roller={"support": support}))


@lru_cache
def half_plane_off(material: str, curvature: float, support: str) -> float:
    """Error of the half-plane's peak pressure, relative to that of the disc."""
    scene = posed(material, curvature, SUPPORTS[support])
    level = finite_elements(scene, scene.hertz.half_width / 24.0)
    assert level.solution.converged
    return float(scene.hertz.peak_pressure / level.solution.pressure.max() - 1.0)


@pytest.mark.parametrize(
    ("support", "off"),
    [
        ("opposite", -0.0162),
        ("half disc", -0.0200),
        ("hub of 0.3", -0.0266),
        ("hub of 0.5", -0.0389),
        ("sector", -0.0358),
    ],
)
def test_supports_of_a_polymer_roller(support, off):
    assert half_plane_off("polymer", 0.15, support) == pytest.approx(off, abs=7e-4)


@pytest.mark.parametrize(("material", "curvature"), [("polymer", 0.15), ("steel", 0.1)])
def test_their_spread_lies_within_its_estimate_and_not_far(material, curvature):
    scene = posed(material, curvature, None)
    peak = scene.hertz.peak_pressure
    bound = estimates(scene, Shown(peak, peak))["roller_support"]["peak_pressure"]
    named = ("opposite", "half disc", "hub of 0.3", "hub of 0.5")
    off = {name: half_plane_off(material, curvature, name) for name in (*named, "sector")}
    spread = max(abs(off[name] - off["sector"]) for name in named)
    assert 0.5 * bound < spread < bound


def test_it_is_known_where_the_scene_says_it_or_nothing_bends():
    rigid = problem({"roller": {"radius": RADIUS, "rigid": True}, "body": dict(STEEL),
                     "load": {"per_length": 1e6}})  # fmt: skip
    for scene in (posed("steel", 0.05, "opposite"), rigid):
        assert "roller_support" not in estimates(scene, Shown(1e9, 1e9))


@pytest.mark.parametrize("support", ["sector", "opposite", "hub of 0.3"])
def test_the_check_of_the_far_boundary_leaves_a_disc_as_it_is_held(support):
    """Else it would measure another support: 10 % in place of 0.02 %."""
    scene = posed("polymer", 0.15, SUPPORTS[support])
    plan, body_cache = make_plan(scene, ("finite_element",)), BodyCache()
    pitch, near = scene.hertz.half_width / 5.0, np.array([[-1.0, 1.0]]) * scene.hertz.half_width
    pairs = [
        bodies_of(scene, Refinement(pitch, half_block), near, Stages(), body_cache)
        for half_block in (False, True)
    ]
    assert plan.domain_check and pairs[0].rough.support != pairs[1].rough.support
    assert pairs[0].roller.support == pairs[1].roller.support
    assert np.array_equal(pairs[0].roller.held, pairs[1].roller.held)


def test_there_is_no_far_boundary_where_every_body_has_its_own():
    scene = posed("polymer", 0.15, "opposite")
    bounded = scene.scene.changed({"body.thickness": 5e-3, "body.width": 40e-3})
    assert not make_plan(problem(bounded.written), ("finite_element",)).domain_check


@pytest.mark.parametrize("support", ["opposite", "ring of the check"])
def test_an_independent_code_finds_the_same_with_that_support(support):
    """Its own elements at finite strain, its ring cut open opposite the contact."""
    curvature, half_width = 0.15, 100.0  # um
    flat, bodies = np.linspace(-9e3, 9e3, 101), ((210.0, 0.3), (3.0, 0.4))
    named = {"opposite": OPPOSITE, "ring of the check": RING}[support]
    unloaded = Task(flat, 0.0 * flat, *bodies, half_width / curvature, 0.0, support=named)
    peak = 0.5 * curvature * unloaded.modulus
    task = replace(unloaded, load=0.5 * np.pi * half_width * peak)
    *_, last = solutions(task, (8.0,), 200.0)
    other = float(peak / figures(*last).peak - 1.0)
    assert half_plane_off("polymer", curvature, support) == pytest.approx(other, abs=1e-3)
    # which the stated error covers where the scene does not say the support
    stated = half_plane_off("polymer", curvature, "sector")
    scene = posed("polymer", curvature, None)
    bound = estimates(scene, Shown(1e9, 1e9))["roller_support"]["peak_pressure"]
    assert abs(other - stated) < bound
    assert support != "opposite" or abs(other - stated) > 0.5 * bound


@pytest.mark.parametrize(
    ("written", "said"),
    [
        ("disc", r"finite_element\.roller_body: .* finite_element\.roller_body = \"half-plane\" w"),
        ("half-plane", r"load\.hertz_peak_pressure: .* or budget\.effects = false, without the d"),
    ],
)
def test_pressures_beyond_a_disc_are_an_error_of_what_the_scene_has(written, said):
    """A disc is an effect of the whole model, too."""
    scene = posed("polymer", 0.5, "opposite", roller_shape="parabola", roller_body=written)
    whole = replace(scene, scene=scene.scene.unchecked({"finite_element.roller_body": "disc"}))
    with pytest.raises(SceneError, match=said) as refused:
        finite_elements(whole)
    reached = np.abs(scene.extent).max()
    assert reached == pytest.approx(1.5 * scene.hertz.half_width, rel=1e-2)
    numbers = f"reach to {reached:.3g} m from the middle, 1.5 Hertz half-widths; a disc bears"
    assert f"{numbers} them up to 0.006 m, 0.6 of roller.radius" in str(refused.value)


HALF_WIDTH = 100e-6
# A wave whose troughs are where the contact ends: a boundary that comes back to the mean line
# beside the contact touches the roller there.
WAVE, SLOPE = 2.0 * HALF_WIDTH, 0.005
SINUSOID = {
    "kind": "sinusoid",
    "wavelength": WAVE,
    "amplitude": np.sqrt(2.0) * SLOPE * WAVE / (2.0 * np.pi),
}


def problem_with(profile: dict, **finite_element) -> Problem:
    tables = {
        "roller": {"radius": 100.0 * HALF_WIDTH, "rigid": True},
        "body": {"youngs_modulus": 200e9, "poissons_ratio": 0.3},
        "load": {"hertz_peak_pressure": 1.0989e9},
        "profile": profile,
        "finite_element": {"deformation": "finite", **finite_element},
    }
    return problem(tables)


def mesh_of(problem: Problem, pitch: float, contact: float = 0.7) -> BlockMesh:
    """Mesh of a level on which contact is predicted on this part of the smooth one."""
    patches = contact * problem.hertz.half_width * np.array([[-1.0, 1.0]])
    return rough_mesh(problem, build_block(block_spec(problem, Refinement(pitch), patches)))


@pytest.mark.parametrize("level", [1, 4])
def test_every_hat_lies_on_the_trace(level):
    """Predicted contact or not: at finite deformation it may reach farther."""
    problem = problem_with(SINUSOID)
    pitch = problem.pitches[0] / 2.0 ** (level - 1)
    x = problem.grid(pitch).x
    mesh = mesh_of(problem, pitch)
    top = np.flatnonzero(mesh.points[:, 1] == 0.0)
    at, z = real_points(mesh)[top].T
    under = (at >= x[0] - pitch) & (at <= x[-1] + pitch)
    assert np.count_nonzero(under) > 2 * len(x)
    amplitude = SINUSOID["amplitude"]
    wave = amplitude * np.cos(2.0 * np.pi * at[under] / WAVE)
    assert np.abs(z[under] + wave).max() < 1e-4 * amplitude


@pytest.mark.parametrize(
    ("slope", "length", "seed", "levels"),
    [(0.1, 2e-3, 3, 4), (0.2, 2e-3, 3, 4), (0.2, 6e-3, 5, 2)],
)
def test_fading_roughness_leaves_elements_fit_on_every_level(slope, length, seed, levels):
    """Refinement must not make them worse, as it does where the fading gets shorter with it; nor
    do high long waves fade steeply: at the contact's ends they stand far above the mean line."""
    waves = {"kind": "self-affine", "hurst": 1.0, "rms_slope": slope, "seed": seed}
    ends = {"samples": round(length / 1e-6) + 1, "length": length, "shortest_wavelength": 2e-5}
    problem = problem_with(waves | ends)
    for pitch in problem.pitches[0] / 2.0 ** np.arange(levels):
        mesh = mesh_of(problem, pitch)
        assert scaled_jacobians(real_points(mesh), mesh.triangles).min() > 0.35


def test_finite_deformation_takes_no_factorisation_of_its_own():
    """A few tens of back-substitutions by the linear bodies' factors."""
    problem = problem_with(SINUSOID, roller_shape="circle")
    peaks = []
    for pitch in problem.pitches[0] / np.array([4.0, 8.0]):
        level = finite_elements(problem, pitch)
        counts = level.solution.iterations
        assert level.solution.converged
        assert counts["newton_steps"] == 0
        assert counts["corrections"] <= 30
        peaks.append(level.solution.pressure.max())
    assert peaks[1] == pytest.approx(peaks[0], rel=2e-4)


def test_friction_coefficients_and_rollers_share_rough_bodies_and_profiles_do_not():
    one = problem_with(SINUSOID)
    scene = one.scene
    sliding = {"load.friction": (0.1,), "finite_element.roller_body": "disc"}
    other = replace(one, scene=scene.unchecked(sliding))
    higher = replace(one.surface.profile, height=1.5 * one.surface.profile.height)
    third = replace(one, surface=replace(one.surface, profile=higher))
    held, patches, rough = BodyCache(), np.array([one.extent]), []
    for posed in (one, other, third):
        refinement = Refinement(posed.pitches[0])
        rough.append(bodies_of(posed, refinement, patches, Stages(), held).rough)
    assert rough[1] is rough[0] and rough[2] is not rough[0]
    assert rough[2].points[:, 1].min() < 1.4 * rough[0].points[:, 1].min() < 0.0
