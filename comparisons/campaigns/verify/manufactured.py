"""Observed orders of the displacement and of its energy, by the method of manufactured solutions.

    u_x = a(z) sin(K x + PHASE),   u_z = b(z) cos(K x + PHASE),   a = b = 0 at z = 1

with the body force and the boundary tractions that it takes. In a coating a and b continue with
such slopes that displacement and traction are continuous at its lower side. Requirement: in L2
orders 2, 3, 4 for degrees 1, 2, 3 and one less in the energy norm, each within 0.1 on both sides.
Reference: the exact solution, integrated with a rule of degree 8 on each element. A body of
quadratic edges is solved as it is: the exact solution has no boundary, so that how well the edges
follow a profile does not enter."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from analytic.material import Material
from comparisons.campaigns.cases import CaseFigures, Trial, bounded, order_figure
from fem.body.elasticity import Coating, ElasticBody, Support, elastic_body
from fem.body.exact_load import AREA, AREA_WEIGHT, forces_of
from fem.body.triangle import gradients, jacobians, shapes
from meshes.block import BlockMesh, structured
from meshes.real_shape import roughen

BODY, COAT = Material(3.0, 0.3), Material(12.0, 0.2)
THICKNESS = 0.25
K, PHASE = 1.7, 0.3
# Across the block: from 32 to 64 the order of linear elements is still 1.93 to 1.95.
CELLS = {1: (64, 128), 2: (32, 64), 3: (32, 64)}
MARGIN = 0.1  # of the orders
LARGEST = {1: (6e-4, 8e-2), 2: (6e-6, 3e-3), 3: (6e-8, 3e-5)}  # of both norms, on the finer mesh


def profiles(z: np.ndarray | float) -> np.ndarray:
    """a, b, then their first and second derivatives (3, 2, ...), in the body."""
    a = (1 - z) * np.cos(2 * z)
    b = (1 - z) * (1 + np.sin(1.5 * z))
    a_z = -np.cos(2 * z) - 2 * (1 - z) * np.sin(2 * z)
    b_z = -(1 + np.sin(1.5 * z)) + 1.5 * (1 - z) * np.cos(1.5 * z)
    a_zz = 4 * np.sin(2 * z) - 4 * (1 - z) * np.cos(2 * z)
    b_zz = -3 * np.cos(1.5 * z) - 2.25 * (1 - z) * np.sin(1.5 * z)
    return np.array([[a, b], [a_z, b_z], [a_zz, b_zz]])


@dataclass(frozen=True)
class Exact:
    """The solution on a body of `material`, with a coating of `coat` down to `thickness`."""

    material: Material
    coat: Material | None = None
    thickness: float = 0.0

    def _parts(self, x: object, z: object):
        """mu, lambda, the derivatives of a and b, sine and cosine."""
        (a, b), (a_z, b_z), second = profiles(z)
        bulk, shear = self.material.lame_constants
        if self.coat is not None:
            coated = z < self.thickness
            (ai, bi), (ai_z, bi_z), _ = profiles(self.thickness)
            coat_bulk, coat_shear = self.coat.lame_constants
            twist = shear / coat_shear * (ai_z - K * bi) + K * bi - ai_z
            down = (bulk - coat_bulk) * K * ai + (bulk + 2 * shear) * bi_z
            down = down / (coat_bulk + 2 * coat_shear) - bi_z
            above = np.where(coated, z - self.thickness, 0.0)
            a, b = a + twist * above, b + down * above
            a_z, b_z = a_z + twist * coated, b_z + down * coated
            shear, bulk = np.where(coated, coat_shear, shear), np.where(coated, coat_bulk, bulk)
        angle = K * x + PHASE
        return shear, bulk, (a, b), (a_z, b_z), second, np.sin(angle), np.cos(angle)

    def displacement(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """u (..., 2)."""
        _, _, (a, b), _, _, sine, cosine = self._parts(x, z)
        return np.stack([a * sine, b * cosine], axis=-1)

    def gradient(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """d u / d(x, z) (..., 2, 2)."""
        _, _, (a, b), (a_z, b_z), _, sine, cosine = self._parts(x, z)
        of_x = np.stack([K * a * cosine, a_z * sine], axis=-1)
        return np.stack([of_x, np.stack([-K * b * sine, b_z * cosine], axis=-1)], axis=-2)

    def stress(self, x: np.ndarray, z: np.ndarray) -> tuple[np.ndarray, ...]:
        """sx, sz, txz."""
        shear, bulk, (a, b), (a_z, b_z), _, sine, cosine = self._parts(x, z)
        mean = bulk * (K * a + b_z)
        return (
            (mean + 2 * shear * K * a) * cosine,
            (mean + 2 * shear * b_z) * cosine,
            shear * (a_z - K * b) * sine,
        )

    def body_force(self, x: np.ndarray, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Force per volume along x and z."""
        shear, bulk, (a, b), (a_z, b_z), (a_zz, b_zz), sine, cosine = self._parts(x, z)
        along = K * ((bulk + 2 * shear) * K * a + bulk * b_z) - shear * (a_zz - K * b_z)
        down = -K * shear * (a_z - K * b) - bulk * K * a_z - (bulk + 2 * shear) * b_zz
        return along * sine, down * cosine


def errors(body: ElasticBody, moved: np.ndarray, exact: Exact) -> tuple[float, float]:
    """L2 norm [m^2] and energy norm [N^(1/2)] of the error."""
    nodes, value = body.points[body.mesh.triangles], moved[body.elements]
    place = np.einsum("mac,qa->mqc", nodes, shapes(AREA))
    volume = np.abs(np.linalg.det(jacobians(nodes, AREA))) * AREA_WEIGHT
    off = np.einsum("mac,qa->mqc", value, shapes(AREA, body.degree))
    off = off - exact.displacement(*np.moveaxis(place, -1, 0))
    slope = gradients(nodes, value, AREA) - exact.gradient(*np.moveaxis(place, -1, 0))
    strain = 0.5 * (slope + np.swapaxes(slope, -1, -2))
    shear, nu = body.shear_modulus[:, None], body.poissons_ratio[:, None]
    bulk = 2.0 * shear * nu / (1.0 - 2.0 * nu)
    trace = strain[..., 0, 0] + strain[..., 1, 1]
    energy = 2.0 * shear * (strain**2).sum(axis=(-1, -2)) + bulk * trace**2
    return tuple(np.sqrt([np.sum(volume[..., None] * off**2), np.sum(volume * energy)]))


def skewed(cells: int) -> BlockMesh:
    """A block without right angles, alike on every level; nodes in line at z = 0, THICKNESS, 1."""
    line = np.linspace(-1, 1, cells + 1)
    mesh = structured(line, line[cells // 2 :])
    x, z = mesh.points.T
    fading = z * (THICKNESS - z) * (1 - z)
    points = np.column_stack([x + 2.0 * fading * (1 - x**2), z + 0.8 * fading * np.sin(2 * x)])
    corner = mesh.triangles[:, :3]
    points[mesh.triangles[:, 3:]] = 0.5 * (points[corner] + points[np.roll(corner, -1, axis=1)])
    return replace(mesh, points=points)


def wave(height: float, x: np.ndarray) -> np.ndarray:
    return height * np.sin(4.0 * x + 0.4)


def rough_coated(cells: int) -> BlockMesh:
    """Rough above, straight along the coating's lower side."""
    mesh = skewed(cells)
    x, z = mesh.points.T
    share = np.maximum(0.0, 1.0 - z / THICKNESS)
    return replace(mesh, shift=np.column_stack([np.zeros_like(x), -wave(0.03, x) * share]))


BODIES: dict[str, tuple[Callable[[int], BlockMesh], Coating | None]] = {
    "flat": (skewed, None),
    "rough": (lambda cells: roughen(skewed(cells), partial(wave, 0.05)), None),
    "coated": (skewed, Coating(COAT, THICKNESS)),
    "rough and coated": (rough_coated, Coating(COAT, THICKNESS)),
}


def errors_of(kind: str, cells: int, degree: int) -> tuple[float, float]:
    mesh, coating = BODIES[kind]
    exact = Exact(BODY, COAT, THICKNESS) if coating else Exact(BODY)
    body = elastic_body(mesh(cells), BODY, Support(), degree=degree, coating=coating)
    load = forces_of(body.mesh, exact.stress, exact.body_force, degree)
    return errors(body, body.solve(load), exact)


def manufactured_cases(bodies: Iterable[tuple[str, int]]) -> list[Trial]:
    model, group, solve = "finite_element", "manufactured", manufactured_figures
    return [Trial(group, f"{k}, P{d}", model, partial(solve, k, d)) for k, d in bodies]


def manufactured_figures(kind: str, degree: int) -> CaseFigures:
    coarse, fine = (np.array(errors_of(kind, cells, degree)) for cells in CELLS[degree])
    orders, reference = np.log2(coarse / fine), "manufactured displacement"
    figures = []
    for k, (norm, expected) in enumerate((("L2", degree + 1), ("energy", degree))):
        error, high = float(fine[k]), LARGEST[degree][k]
        figures += [
            order_figure(f"{norm}: order", orders[k], expected, MARGIN, reference),
            bounded(f"{norm}: error", error, high, reference),
        ]
    return tuple(figures)
