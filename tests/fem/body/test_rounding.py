"""Stiffnesses at their worst: residuals are rounding, even compression comes out exactly.

LAPACK's test ratio, ||b - A x|| / (||A|| ||x|| eps), is below 30 whatever the condition of A is
(Anderson et al. 1999, LAPACK working note 41). Even compression, u_z = depth - z, is a state that
elements of any shape represent; the condition may magnify its rounding. It needs no force inside,
and on the top the resultant of M = 2 G (1 - nu) / (1 - 2 nu)."""

from functools import lru_cache

import numpy as np
import pytest
from scipy.sparse import csr_matrix
from scipy.sparse.linalg import norm

from analytic.material import Material
from fem.body import elasticity
from fem.body.elasticity import Coating, ElasticBody, Support, elastic_body
from fem.body.surface import hat_forces
from fem.solver.mumps import SymmetricFactor
from meshes.block import BlockMesh, BlockSpec
from meshes.build import build_block
from meshes.real_shape import roughen

EPS = np.finfo(float).eps
THRESHOLD = 30.0  # LAPACK's own for its test ratios
GIVEN_BACK = 1e-8  # error of even compression
STEEL = Material(207e9, 0.3)
INTERFACE = 0.2  # [m] lower side of a coating
# Half-width, depth, refined on |x| <=, edge there, growth [m].
BLOCKS = {
    "plain": (40.0, 40.0, 1.5, 0.1, 0.3),
    "grading of 1e7": (1.0, 1.0, 1e-6, 1e-7, 0.5),
    "thin": (40.0, 0.1, 1.5, 0.1, 0.3),
    "coated": (40.0, 40.0, 1.5, 0.1, 0.3),
    "rough": (8.0, 8.0, 3.0, 0.05, 0.3),
}


def wave(x: np.ndarray) -> np.ndarray:
    """A sinusoid of rms slope 1 on the refined range."""
    return np.exp(-((x / 2.0) ** 8)) * np.sqrt(2.0) / np.pi * np.cos(np.pi * x)


@lru_cache
def mesh_named(name: str) -> BlockMesh:
    half_width, depth, reach, edge, growth = BLOCKS[name]
    interface = INTERFACE if name == "coated" else None
    refined = np.array([[-reach, reach]])
    mesh = build_block(BlockSpec(half_width, depth, refined, edge, growth, interface=interface))
    return roughen(mesh, wave) if name == "rough" else mesh


def residual_ratio(body: ElasticBody) -> float:
    """The larger one of random forces and of the forces of a hat."""
    matrix, x = csr_matrix(body.stiffness()), body.surface.x
    hats = np.linspace(0.25 * x[0], 0.25 * x[-1], 7)
    one_hat = np.zeros(body.nodes.shape)
    one_hat[body.surface.point] = hat_forces(body.surface, hats)[:, 2].toarray().reshape(-1, 2)
    ratios = []
    for load in (np.random.default_rng(5).standard_normal(body.nodes.shape), one_hat):
        load[body.held] = 0.0
        moved = body.solve(load).ravel()
        residual = np.abs(load.ravel() - matrix @ moved).sum()
        ratios.append(residual / (norm(matrix, 1) * np.abs(moved).sum() * EPS))
    return max(ratios)


def compression_errors(body: ElasticBody) -> tuple[float, float, float]:
    """Of the displacement, relative; forces inside as a test ratio; of the resultant, relative."""
    material, matrix = body.material, csr_matrix(body.stiffness())
    moved = np.zeros(body.nodes.shape)
    moved[:, 1] = body.mesh.spec.depth - body.nodes[:, 1]
    moved[body.held] = 0.0
    force = (matrix @ moved.ravel()).reshape(-1, 2)
    top, inside = body.surface.point, ~body.held
    inside[top] = False
    ratio = np.abs(force[inside]).max() / (norm(matrix, 1) * np.abs(moved).max() * EPS)
    nu, width = material.poissons_ratio, 2.0 * body.mesh.spec.half_width
    resultant = width * 2.0 * material.shear_modulus * (1.0 - nu) / (1.0 - 2.0 * nu)
    load = np.zeros_like(force)
    load[top] = force[top]
    error = np.abs(body.solve(load) - moved).max() / np.abs(moved).max()
    return error, ratio, abs(force[top, 1].sum() / resultant - 1.0)


def clamped(
    mesh: str, material: Material = STEEL, degree: int = 2, ratio: float | None = None
) -> ElasticBody:
    """A body held on its base and sides; `ratio`, how many times as stiff as steel a coating is."""
    coating = ratio and Coating(Material(ratio * 207e9, 0.2), INTERFACE)
    support = Support("bonded", "fixed")
    return elastic_body(mesh_named(mesh), material, support, degree=degree, coating=coating)


def confined(mesh: str, nu: float = 0.3, degree: int = 2) -> ElasticBody:
    """A body on a frictionless base between rollers."""
    support = Support("frictionless", "rollers")
    return elastic_body(mesh_named(mesh), Material(207e9, nu), support, degree=degree)


@pytest.mark.parametrize(
    "body",
    [
        ("plain",),
        ("plain", Material(1.0, 0.0)),
        ("plain", Material(1.0, 0.4999)),
        ("plain", Material(1.0, 0.5 - 1e-9), 3),
        ("grading of 1e7",),
        ("thin",),
        ("rough",),
        ("plain", Material(1e-12, 0.3)),
        ("coated", STEEL, 2, 1e6),
        ("coated", STEEL, 2, 1e-6),
    ],
    ids=str,
)
def test_residuals_are_rounding_and_the_stiffness_is_symmetric(body):
    made = clamped(*body)
    matrix = csr_matrix(made.stiffness())
    assert abs(matrix - matrix.T).max() <= 1e-14 * abs(matrix).max()
    assert residual_ratio(made) < THRESHOLD


@pytest.mark.parametrize(
    "body",
    [
        ("plain",),
        ("plain", 0.4999),
        ("plain", 0.4999, 3),
        ("plain", 0.3, 1),
        ("grading of 1e7",),
        ("rough",),
    ],
    ids=str,
)
def test_even_compression_is_given_back(body):
    error, ratio, resultant = compression_errors(confined(*body))
    assert error < GIVEN_BACK and ratio < THRESHOLD and resultant < GIVEN_BACK


def test_a_factor_in_32_bits_is_seen(monkeypatch):
    original = SymmetricFactor.solve

    def rounded(self, load: np.ndarray) -> np.ndarray:
        return original(self, load).astype(np.float32).astype(float)

    monkeypatch.setattr(SymmetricFactor, "solve", rounded)
    assert residual_ratio(clamped("plain")) > 1e3 * THRESHOLD


def test_a_wrong_stiffness_is_seen(monkeypatch):
    """Equations that are solved exactly are no proof that they are the right ones."""
    original = elasticity.relative_constants

    def stiffer(*constants: object) -> tuple[np.ndarray, np.ndarray]:
        shear, lame = original(*constants)
        return shear, 1.01 * lame

    monkeypatch.setattr(elasticity, "relative_constants", stiffer)
    assert compression_errors(confined("plain"))[2] > 1e3 * GIVEN_BACK
    assert residual_ratio(clamped("plain")) < THRESHOLD
