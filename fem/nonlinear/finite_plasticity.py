"""A metal that flows at finite strains and rotations: by the logarithmic strain.

The strain E = 1/2 ln C has an additive plastic part; yield function, return mapping, hardening and
state are those of `fem.nonlinear.plasticity`, with E in place of the small strain (Miehe, Apel and
Lambrecht 2002, see `fem.nonlinear.log_strain`). Without flow this is Hencky's law. Flow keeps the
volume exactly, since tr E = ln J. The flow stress bounds Kirchhoff's stress, J times Cauchy's.

All terms are integrated at the three points of flow: quadratic triangles then do not lock at
finite strains either. Plastic strains are in the axes of the undeformed body."""

import numpy as np
from scipy.sparse import bsr_matrix, csr_matrix

from fem.body.elasticity import ElasticBody
from fem.body.sums import nodal_sums
from fem.nonlinear.log_strain import LogStrain
from fem.nonlinear.plasticity import ElasticPlastic, PlasticBody, PlasticState, PlasticStep

CHUNK = 8192  # elements whose tangents are formed at once


class FinitePlasticBody(PlasticBody):
    """As `PlasticBody`, at finite strains: displacements (n, 2) [m] of any size that invert no
    element. FemError where one is inverted.

    state   plastic part of the logarithmic strain at the points, xx, zz, xz"""

    def __init__(self, body: ElasticBody, metal: ElasticPlastic) -> None:
        super().__init__(body, metal)
        self._elastic = np.zeros((2, 3, 3))  # of the metal, and of what is coated
        materials = metal.elastic, body.surface_material
        for matrix, material in zip(self._elastic, materials, strict=True):
            lame, shear = material.lame_constants
            matrix += shear * np.diag([2.0, 2.0, 1.0])
            matrix[:2, :2] += lame
        elements, count = body.elements, len(body.nodes)
        pair = elements[:, :, None].astype(np.int64) * count + elements[:, None, :]
        pairs, self._place = np.unique(pair, return_inverse=True)
        self._place, self._column = self._place.ravel(), pairs % count
        self._start = np.searchsorted(pairs // count, np.arange(count + 1))

    def strain(self, displacement: np.ndarray) -> np.ndarray:
        """Logarithmic Exx, Ezz, 2 Exz (3m, 3) of a displacement (n, 2) [m]."""
        return LogStrain(self.gradient(displacement)).strain

    def linearised(self, displacement: np.ndarray) -> tuple[np.ndarray, csr_matrix]:
        """Internal force (n, 2) [N/m] and its derivative (2n, 2n) [Pa] at a displacement (n, 2).
        For the step from the accepted state; rows of held components are as all others."""
        strain, step, conjugate = self._at(displacement)
        return self._balanced(strain, conjugate), self._tangent(strain, step, conjugate)

    def force(self, displacement: np.ndarray) -> np.ndarray:
        """The internal force alone."""
        strain, _, conjugate = self._at(displacement)
        return self._balanced(strain, conjugate)

    def stress(
        self, displacement: np.ndarray, state: PlasticState
    ) -> tuple[np.ndarray, np.ndarray]:
        """Cauchy's sx, sz, txz (3m, 3) and sy (3m,) [Pa] under a displacement (n, 2) [m]."""
        strain = LogStrain(self.gradient(displacement))
        conjugate, across = self.conjugate_stress(strain.strain, state)
        first, _ = _first_piola(strain, conjugate)
        cauchy = first @ strain.deformed.transpose(0, 2, 1) / strain.volume[:, None, None]
        inside = np.column_stack([cauchy[:, 0, 0], cauchy[:, 1, 1], cauchy[:, 0, 1]])
        return inside, across / strain.volume

    def _at(self, displacement: np.ndarray) -> tuple[LogStrain, PlasticStep, np.ndarray]:
        """The strain, the step from the accepted state, and the stress conjugate to the strain."""
        strain = LogStrain(self.gradient(displacement))
        step = self._mapped(strain.strain)
        return strain, step, self.conjugate_stress(strain.strain, step.state)[0]

    def _balanced(self, strain: LogStrain, conjugate: np.ndarray) -> np.ndarray:
        first, _ = _first_piola(strain, conjugate)
        weighted = (first * self.areas.reshape(-1, 1, 1)).reshape(-1, 3, 2, 2)
        nodal = (self._slopes @ weighted.transpose(0, 1, 3, 2)).sum(axis=1)
        return nodal_sums(self.body.elements, nodal, len(self.body.nodes))

    def _tangent(self, strain: LogStrain, step: PlasticStep, conjugate: np.ndarray) -> csr_matrix:
        inner = self._elastic[self._coated.astype(int)]
        inner[step.yields] -= step.softening
        material = strain.tangent(conjugate, inner) * self.areas.reshape(-1, 1, 1)
        _, piola = _first_piola(strain, conjugate)
        piola *= self.areas.reshape(-1, 1, 1)
        count = len(self.body.elements)
        blocks = np.empty((count, 6, 6, 4))
        for begin in range(0, count, CHUNK):
            some = slice(begin, min(begin + CHUNK, count))
            points = slice(3 * some.start, 3 * some.stop)
            blocks[some] = _element_tangents(
                *(self._slopes[some], strain.deformed[points], material[points], piola[points])
            )
        blocks = blocks.reshape(-1, 4)
        total = [np.bincount(self._place, one, len(self._column)) for one in blocks.T]
        data = np.stack(total, axis=-1).reshape(-1, 2, 2)
        return bsr_matrix((data, self._column, self._start), self._stiffness.shape).tocsr()


def _first_piola(strain: LogStrain, conjugate: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """P = F S and S (k, 2, 2) [Pa] of the stress (k, 3) conjugate to the logarithmic strain."""
    piola = strain.piola(conjugate)[:, [[0, 2], [2, 1]]]
    return strain.deformed @ piola, piola


def _element_tangents(
    slopes: np.ndarray, deformed: np.ndarray, material: np.ndarray, piola: np.ndarray
) -> np.ndarray:
    """Tangents (m, 6, 6, 4) [Pa], for two nodes xx, xz, zx, zz, of m elements with slopes (m, 3, 6,
    2) [1/m] of their shape functions; at 3m points F (2, 2), dS by Green's strain (3, 3) and S
    (2, 2) times the point's area."""
    count = len(slopes)
    f = deformed.reshape(count, 3, 2, 2)
    green = np.empty((count, 3, 3, 6, 2))  # Green's strain by the nodes' displacements
    along_x, along_z = slopes[..., 0, None], slopes[..., 1, None]
    f_x, f_z = f[..., None, :, 0], f[..., None, :, 1]
    green[:, :, 0], green[:, :, 1] = along_x * f_x, along_z * f_z
    green[:, :, 2] = along_z * f_x + along_x * f_z
    green = green.reshape(count, 3, 3, 12)
    moved = (material.reshape(count, 3, 3, 3) @ green).reshape(count, 9, 12)
    block = green.reshape(count, 9, 12).transpose(0, 2, 1) @ moved
    block = block.reshape(count, 6, 2, 6, 2).transpose(0, 1, 3, 2, 4).reshape(count, 6, 6, 4)
    turned = (slopes @ piola.reshape(count, 3, 2, 2)) @ slopes.transpose(0, 1, 3, 2)
    turned = turned.sum(axis=1)
    block[..., 0] += turned
    block[..., 3] += turned
    return block
