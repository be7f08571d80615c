"""The real boundary of a rough body: the trace under every pressure element, on every level."""

from dataclasses import replace

import numpy as np
import pytest
from scenes import finite_elements, problem

from comparisons.common.progress import Stages
from comparisons.models.finite_element.bodies import BodyCache, bodies_of
from comparisons.models.finite_element.mesh import Refinement, block_spec, rough_mesh
from comparisons.models.problem import Problem
from meshes.block import BlockMesh, real_points
from meshes.build import build_block
from meshes.quality import scaled_jacobians

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
    """Of a level on which contact is predicted on this part of the smooth one."""
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
