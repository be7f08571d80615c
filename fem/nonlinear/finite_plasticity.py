"""A metal that flows at finite strains and rotations: F = Fe Fp, and logarithmic elastic strain.

    E = 1/2 ln (Q'CQ),   Q = exp(-dev ep),   ep = ln Up, dev in the plane

Up is the stretch of Fp, all that a metal without directions remembers of its flow. F Q is Fe but
for the stretch across the plane, which is left in the plastic strain before a step. From there the
return mapping, hardening and stress are those of `fem.nonlinear.plasticity`, with E in place of the
small strain; a step that adds dep to the plastic strain ends with Up = |exp(dep) Q^-1| (Eterovic
and Bathe 1990, Int. J. Numer. Methods Eng. 30, 1099-1114; Simo 1992, Comput. Methods Appl. Mech.
Eng. 99, 61-112). Without flow this is Hencky's law. Flow keeps the volume exactly, since tr E =
ln J. The flow stress bounds Kirchhoff's stress, J times Cauchy's, however far the metal flows.

With Q = I, where 1/2 ln C itself is a sum of both parts (Miehe, Apel and Lambrecht 2002), the shear
that a metal without hardening bears falls by a fifth until a plastic strain of 1 and by a half
until 2. Kinematic hardening, whose back stress needs the sum, is still mapped so.

All terms are integrated at the three points of flow: quadratic triangles then do not lock at
finite strains either. Plastic strains are in the axes of the undeformed body."""

from dataclasses import replace

import numpy as np
from scipy.sparse import bsr_matrix, csr_matrix

from fem.body.elasticity import ElasticBody
from fem.body.sums import nodal_sums
from fem.nonlinear.log_strain import LogStrain
from fem.nonlinear.plasticity import (
    ElasticPlastic,
    PlasticBody,
    PlasticState,
    PlasticStep,
    return_mapping,
    stress_of,
)

CHUNK = 8192  # elements whose tangents are formed at once
UNCHANGED = 1e-3  # change of F that leaves an elastic element its tangent: a part of the stiffness


class FinitePlasticBody(PlasticBody):
    """`PlasticBody` at finite strains: displacements (n, 2) [m] of any size that invert no element.
    FemError where one is inverted.

    state   logarithmic plastic strain ep at the points, xx, zz, xz"""

    def __init__(self, body: ElasticBody, metal: ElasticPlastic) -> None:
        super().__init__(body, metal)
        self._elastic = np.zeros((2, 3, 3))  # of the metal, and of what is coated
        materials = metal.elastic, body.surface_material
        for matrix, material in zip(self._elastic, materials, strict=True):
            lame, shear = material.lame_constants
            matrix += shear * np.diag([2.0, 2.0, 1.0])
            matrix[:2, :2] += lame
        self._known: tuple = (None, None, None)  # accepted state, displacement and the last `_at`
        elements, count = body.elements, len(body.nodes)
        pair = elements[:, :, None].astype(np.int64) * count + elements[:, None, :]
        pairs, self._place = np.unique(pair, return_inverse=True)
        self._place, self._column = self._place.ravel(), pairs % count
        self._start = np.searchsorted(pairs // count, np.arange(count + 1))
        # tangents of the elements, where they were formed, and of which it flowed then
        self._blocks = np.empty((len(elements), 6, 6, 4))
        self._linearised_at = np.full((len(self.points), 2, 2), np.inf)
        self._flowed = np.zeros(len(elements), dtype=bool)

    def strain(self, displacement: np.ndarray) -> np.ndarray:
        """Logarithmic Exx, Ezz, 2 Exz (3m, 3) of a displacement (n, 2) [m]."""
        return LogStrain(self.gradient(displacement)).strain

    def step(self, displacement: np.ndarray) -> PlasticStep:
        """The step from the accepted state to a displacement (n, 2) [m]."""
        _, step, _, unflowed = self._at(displacement)
        strain = step.state.strain
        if unflowed is not None:
            strain = _in_turn(self.state.strain, strain)
        return replace(step, state=replace(step.state, strain=strain))

    def linearised(self, displacement: np.ndarray) -> tuple[np.ndarray, csr_matrix]:
        """Internal force (n, 2) [N/m] and its derivative (2n, 2n) [Pa] at a displacement (n, 2).
        For the step from the accepted state; rows of held components are as all others."""
        strain, step, conjugate, unflowed = self._at(displacement)
        slopes = self._slopes_of(unflowed)
        force = self._balanced(slopes, strain, conjugate)
        return force, self._tangent(slopes, strain, step, conjugate)

    def force(self, displacement: np.ndarray) -> np.ndarray:
        """The internal force alone."""
        strain, _, conjugate, unflowed = self._at(displacement)
        return self._balanced(self._slopes_of(unflowed), strain, conjugate)

    def bearable(self, equivalent: np.ndarray, mean: np.ndarray) -> np.ndarray:
        """See `PlasticBody`; of Cauchy's stress: that of Kirchhoff over J, K ln J = J mean."""
        kirchhoff = super().bearable(equivalent, mean)
        return kirchhoff * np.exp(-mean / self.metal.elastic.bulk_modulus)

    def stress(
        self, displacement: np.ndarray, state: PlasticState
    ) -> tuple[np.ndarray, np.ndarray]:
        """Cauchy's sx, sz, txz (3m, 3) and sy (3m,) [Pa] under a displacement (n, 2) [m]."""
        unflowed, left = self._unflowed(state)
        strain = self._strain(displacement, unflowed)
        conjugate, across = stress_of(self._shear, self._ratio, strain.strain, left)
        first, _ = _first_piola(strain, conjugate)
        cauchy = first @ strain.deformed.transpose(0, 2, 1) / strain.volume[:, None, None]
        inside = np.column_stack([cauchy[:, 0, 0], cauchy[:, 1, 1], cauchy[:, 0, 1]])
        return inside, across / strain.volume

    def _unflowed(self, state: PlasticState) -> tuple[np.ndarray | None, PlasticState]:
        """Q (3m, 2, 2), None for I, and the state with the plastic strain that is not in it."""
        if self.metal.hardening.kinematic or not state.strain.any():
            return None, state
        mean = 0.5 * (state.strain[:, 0] + state.strain[:, 1])
        left = np.column_stack([mean, mean, np.zeros_like(mean)])
        return np.eye(2) + _exponential(-state.strain), replace(state, strain=left)

    def _strain(self, displacement: np.ndarray, unflowed: np.ndarray | None) -> LogStrain:
        gradient = self.gradient(displacement)
        if unflowed is not None:
            gradient = gradient @ unflowed + (unflowed - np.eye(2))
        return LogStrain(gradient)

    def _slopes_of(self, unflowed: np.ndarray | None) -> np.ndarray:
        """Slopes (m, 3, 6, 2) [1/m] of the shape functions along the axes of F Q."""
        if unflowed is None:
            return self._slopes
        return self._slopes @ unflowed.reshape(-1, 3, 2, 2)

    def _at(
        self, displacement: np.ndarray
    ) -> tuple[LogStrain, PlasticStep, np.ndarray, np.ndarray | None]:
        """The strain E, the step from the accepted state in its axes, the stress conjugate to it,
        and Q."""
        if self._known[0] is self.state and np.array_equal(self._known[1], displacement):
            return self._known[2]
        unflowed, left = self._unflowed(self.state)
        strain = self._strain(displacement, unflowed)
        metal = np.where(self._coated[:, None], 0.0, strain.strain)
        step = return_mapping(self.metal, metal, left)
        conjugate, _ = stress_of(self._shear, self._ratio, strain.strain, step.state)
        self._known = self.state, displacement, (strain, step, conjugate, unflowed)
        return self._known[2]

    def _balanced(self, slopes: np.ndarray, strain: LogStrain, conjugate: np.ndarray) -> np.ndarray:
        first, _ = _first_piola(strain, conjugate)
        weighted = (first * self.areas.reshape(-1, 1, 1)).reshape(-1, 3, 2, 2)
        nodal = (slopes @ weighted.transpose(0, 1, 3, 2)).sum(axis=1)
        return nodal_sums(self.body.elements, nodal, len(self.body.nodes))

    def _tangent(
        self, slopes: np.ndarray, strain: LogStrain, step: PlasticStep, conjugate: np.ndarray
    ) -> csr_matrix:
        """Elements that do not flow keep theirs until they have deformed further."""
        flows = step.yields.reshape(-1, 3).any(axis=1)
        further = np.abs(strain.deformed - self._linearised_at).reshape(len(flows), -1).max(axis=1)
        renewed = np.flatnonzero(flows | self._flowed | (further > UNCHANGED))
        self._flowed = flows
        softening = np.zeros((len(flows), 3, 3, 3))
        softening.reshape(-1, 3, 3)[step.yields] = step.softening
        for begin in range(0, len(renewed), CHUNK):
            some = renewed[begin : begin + CHUNK]
            points = (3 * some[:, None] + np.arange(3)).ravel()
            near, area = strain.at(points), self.areas[some].reshape(-1, 1, 1)
            inner = self._elastic[self._coated[points].astype(int)]
            inner -= softening[some].reshape(-1, 3, 3)
            material = near.tangent(conjugate[points], inner) * area
            piola = _first_piola(near, conjugate[points])[1] * area
            self._blocks[some] = _element_tangents(slopes[some], near.deformed, material, piola)
            self._linearised_at[points] = near.deformed
        blocks = self._blocks.reshape(-1, 4)
        total = [np.bincount(self._place, one, len(self._column)) for one in blocks.T]
        data = np.stack(total, axis=-1).reshape(-1, 2, 2)
        return bsr_matrix((data, self._column, self._start), self._stiffness.shape).tocsr()


def _exponential(strain: np.ndarray) -> np.ndarray:
    """exp(dev) - I (k, 2, 2) of strains (k, 3) xx, zz, xz without their mean in the plane."""
    apart, shear = 0.5 * (strain[:, 0] - strain[:, 1]), strain[:, 2]
    size = np.hypot(apart, shear)
    part = np.sinh(size) / np.where(size > 0.0, size, 1.0)
    grown = 2.0 * np.sinh(0.5 * size) ** 2
    rows = grown + part * apart, part * shear, part * shear, grown - part * apart
    return np.stack(rows, axis=-1).reshape(-1, 2, 2)


def _in_turn(before: np.ndarray, more: np.ndarray) -> np.ndarray:
    """Plastic strain (k, 3) that ends a step from `before`, of which `more` has what it adds in the
    axes after `before`, and the whole mean in the plane."""
    first, second = _exponential(before), _exponential(more)
    both = LogStrain(first + second + second @ first).strain * [1.0, 1.0, 0.5]
    return both + (0.5 * (more[:, 0] + more[:, 1]))[:, None] * [1.0, 1.0, 0.0]


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
