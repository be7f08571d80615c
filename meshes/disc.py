"""The mesh of a disc that is held away from the contact, from that of a flat block.

On the rim the x of the surface stays up to KEPT radii. From there on the point in the block counts
on at the rate that it has there, as far as the rim goes: t(x), with t' continuous.

Half or nearly all of a disc of radius R, its contact at 0 and z into it. With p = x + i z in the
disc, q in the half-plane Im q > 0:

    p = q / (1 - i q / 2R),     q = 2R tan(angle / 2) on the rim, which is t(x)

keeps angles. Half circles |q| = Q become arcs around the point opposite the contact: at Q = 2R the
diameter, beyond it circles whose farthest points are 4R^2 / Q away from that point, nearly. Squares
about the block's origin go to these half circles.

A ring about a hub of radius h: lines of equal depth go to circles, r = R exp(-z/R), and upright
lines to rays at the angle t(x). The block's sides meet opposite the contact."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from meshes.block import BlockMesh, MeshError
from meshes.quality import LEAST_ANGLE_ROUGH_DEGREES, check_quality
from meshes.real_shape import sagitta

KEPT = 0.8  # of the radius: half of the surface whose x stays
HELD_OPPOSITE = 0.3  # of the radius: what is held about the point opposite the contact, nearly


def half_disc_size(radius: float) -> float:
    """Half-width and depth [m] of the block that becomes half a disc."""
    return radius * _flat(2.0, *_on_plane())


def opposite_size(radius: float) -> float:
    """Half-width and depth [m] of the block that becomes a disc but for a spot opposite."""
    return radius * _flat(4.0 / HELD_OPPOSITE, *_on_plane())


def ring_size(radius: float, hub: float) -> tuple[float, float]:
    """Half-width and depth [m] of the block that becomes a ring about a `hub` [m]."""
    return radius * _flat(np.pi, *_on_rim()), radius * np.log(radius / hub)


def disc(mesh: BlockMesh, radius: float) -> BlockMesh:
    """Mesh of a disc of `radius` [m] to an arc opposite the contact, from that of a flat block of
    `half_disc_size` or `opposite_size`: base and sides become the arc. MeshError if the block is
    not flat or not as deep as its half-width, or if the elements are not fit to solve on."""
    half = mesh.spec.half_width / radius
    if mesh.shift.any() or mesh.spec.depth != mesh.spec.half_width or half <= KEPT:
        raise MeshError("only a flat block as deep as its half-width can become a disc")
    x, z = mesh.points.T / radius
    r, square = np.hypot(x, z), np.maximum(np.abs(x), z)
    size = _counted(r - square / half * (r - square), _tangent, *_on_plane())
    plane = size * np.exp(1j * np.arctan2(z, x))
    place = plane / (1.0 - 0.5j * plane)
    return _bounded(mesh, radius, radius * np.column_stack([place.real, place.imag]))


def ring(mesh: BlockMesh, radius: float) -> BlockMesh:
    """Mesh of a ring of outer `radius` [m], from that of a flat block of `ring_size`: its base
    becomes the hub's circle, both sides the line from there to the point opposite the contact.
    MeshError if the block is not flat, or if the elements are not fit to solve on."""
    if mesh.shift.any():
        raise MeshError("only a flat block can become a ring")
    x, z = mesh.points.T / radius
    angle = np.sign(x) * _counted(np.abs(x), np.arcsin, *_on_rim())
    inner = np.exp(-z)
    down = 2.0 * np.sin(0.5 * angle) ** 2 * inner - np.expm1(-z)
    return _bounded(mesh, radius, radius * np.column_stack([inner * np.sin(angle), down]))


def _tangent(x: np.ndarray) -> np.ndarray:
    """2 tan(angle / 2) on the rim of a disc of radius 1."""
    return 2.0 * x / (1.0 + np.sqrt(1.0 - x**2))


def _on_plane() -> tuple[float, float]:
    """`_tangent` and its slope at KEPT."""
    cosine = np.sqrt(1.0 - KEPT**2)
    return float(_tangent(KEPT)), float(2.0 / (cosine * (1.0 + cosine)))


def _on_rim() -> tuple[float, float]:
    """The angle and its slope at KEPT."""
    return float(np.arcsin(KEPT)), float(1.0 / np.sqrt(1.0 - KEPT**2))


def _counted(
    x: np.ndarray, near: Callable[[np.ndarray], np.ndarray], value: float, slope: float
) -> np.ndarray:
    """`near` up to KEPT, beyond it on at its slope there, for x >= 0."""
    return near(np.minimum(x, KEPT)) + slope * np.maximum(x - KEPT, 0.0)


def _flat(counted: float, value: float, slope: float) -> float:
    """The x beyond KEPT that counts so."""
    return KEPT + (counted - value) / slope


def _bounded(mesh: BlockMesh, radius: float, real: np.ndarray) -> BlockMesh:
    """The disc with its nodes at `real` (n, 2) [m], the kept part of the rim as its surface."""
    kept = (mesh.points[:, 1] == 0.0) & (np.abs(mesh.points[:, 0]) <= KEPT * radius)
    x = mesh.points[kept, 0]
    shift = real - mesh.points
    shift[kept] = np.column_stack([np.zeros_like(x), sagitta(x, radius)])
    vertices = int(mesh.triangles[:, :3].max()) + 1
    ends = mesh.points[:vertices][kept[:vertices], 0]
    spec = replace(mesh.spec, loaded=(float(ends.min()), float(ends.max())))
    made = replace(mesh, shift=shift, spec=spec)
    check_quality(made, least_angle_degrees=LEAST_ANGLE_ROUGH_DEGREES)
    return made
