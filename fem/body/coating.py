"""A coating on a body: its triangles, and the elastic constants of all triangles."""

from dataclasses import dataclass

import numpy as np

from analytic.material import Material, ThermalMaterial
from meshes.block import BlockMesh


@dataclass(frozen=True)
class Coating:
    """A layer of another `material`, elastic or thermal; `thickness` [m] as in the flat mesh."""

    material: Material | ThermalMaterial
    thickness: float

    def __post_init__(self) -> None:
        if not 0.0 < self.thickness < np.inf:
            raise ValueError(f"a coating's thickness must be positive, not {self.thickness:g} m")


def coated_triangles(mesh: BlockMesh, coating: Coating | None) -> np.ndarray:
    """(m,) whether a triangle belongs to the coating."""
    if coating is None:
        return np.zeros(len(mesh.triangles), dtype=bool)
    from fem.body.surface import SAME_POINT

    height = mesh.points[mesh.triangles[:, :3], 1] - coating.thickness
    slack = SAME_POINT * mesh.spec.depth
    crossing = (height.min(axis=1) < -slack) & (height.max(axis=1) > slack)
    if crossing.any():
        raise ValueError(
            f"{np.count_nonzero(crossing)} elements of the mesh cross the coating's lower side "
            f"at a depth of {coating.thickness:g} m: mesh the block with edges along it"
        )
    return height.mean(axis=1) < 0.0


def relative_constants(
    material: Material, coating: Coating | None, coated: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Lame's constants mu and lambda (m,) of each triangle over Young's modulus of the body."""
    surface = coating.material if coating else material
    ratio = surface.youngs_modulus / material.youngs_modulus
    modulus = np.where(coated, ratio, 1.0)
    nu = np.where(coated, surface.poissons_ratio, material.poissons_ratio)
    return modulus * 0.5 / (1.0 + nu), modulus * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))
