"""Plasticity of von Mises with hardening, in plane strain, and a body with it.

Return mapping: the elastic predictor of the stress, less the back stress, is projected onto the
yield surface along its deviator (Simo and Hughes 1998, Computational Inelasticity, boxes 3.1 and
3.2, with the consistent tangent, which makes Newton's method quadratic). Linear kinematic hardening
needs no state of its own: the back stress is (2/3) H' ep.

    f(u) = K u - sum_q w_q B_q' 2 G ep_q        K_t(u) = K - sum_q w_q B_q' (C - C_ep) B_q

dolfinx assembles the elastic stiffness K; numpy adds the plastic terms at three points to an
element, where there is flow. dolfinx's quadrature functions give the same to rounding (a test
compares them) in the same time or longer, but their interfaces differ between releases. Three
points an element are as many isochoric conditions as a quadratic triangle can fulfil: the limit
load of a flat punch is right.

Nomenclature
    e, g       strains exx, ezz and gxz = 2 exz; eyy = 0
    ep, k      plastic strain and equivalent plastic strain, sum of sqrt(2/3 dep:dep)
    s, q       deviator of stress less back stress, and sqrt(3/2 s:s), the equivalent stress [Pa]
    Y(k), H    flow stress in tension [Pa] (`analytic.material.hardening`); its derivative [Pa]
    H'         kinematic modulus [Pa]
    G, dk      shear modulus [Pa]; increment of k, from q - (3 G + H') dk = Y(k + dk)
    C, C_ep    elastic and consistent tangent [Pa]
    u, B, w    displacement [m], strains of the shape functions [1/m], area of a point [m^2]"""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_matrix

from analytic.material import Material
from analytic.material.hardening import Hardening
from fem.body.elasticity import ElasticBody
from fem.body.sums import matrix_of, nodal_sums
from fem.body.triangle import GAUSS, jacobians, shapes, slopes

# Maps (exx, ezz, gxz) to the deviator (exx', ezz', exz).
DEVIATOR = np.array([[2.0, -1.0, 0.0], [-1.0, 2.0, 0.0], [0.0, 0.0, 1.5]]) / 3.0
GAUSS_WEIGHT = 1.0 / 6.0  # of each of the three points on the reference triangle, of area 1/2


@dataclass(frozen=True)
class ElasticPlastic:
    """A metal: `elastic` until its equivalent stress reaches the yield stress of `hardening`."""

    elastic: Material
    hardening: Hardening


@dataclass(frozen=True)
class PlasticState:
    """Internal variables of a metal at k points."""

    strain: np.ndarray  # (k, 3) plastic exx, ezz, exz; eyy is minus the sum of the first two
    equivalent: np.ndarray  # (k,) equivalent plastic strain

    @classmethod
    def virgin(cls, count: int) -> "PlasticState":
        return cls(np.zeros((count, 3)), np.zeros(count))


@dataclass(frozen=True)
class PlasticStep:
    """One step at k points, from a state to the next."""

    state: PlasticState  # at the end
    yields: np.ndarray  # (k,) whether the point flows in this step
    # (points that flow, 3, 3) [Pa] elastic minus consistent tangent C - C_ep, of sx, sz, txz by
    # exx, ezz, gxz; symmetric
    softening: np.ndarray


def return_mapping(metal: ElasticPlastic, strain: np.ndarray, before: PlasticState) -> PlasticStep:
    """The step from the state `before` to a strain (k, 3) exx, ezz, gxz."""
    shear, hardening = metal.elastic.shear_modulus, metal.hardening
    trial = 2.0 * shear * (strain @ DEVIATOR.T - before.strain)
    if hardening.kinematic:
        trial -= 2.0 / 3.0 * hardening.kinematic * before.strain
    across = trial[:, 0] + trial[:, 1]
    square = trial[:, 0] ** 2 + trial[:, 1] ** 2 + across**2 + 2.0 * trial[:, 2] ** 2
    q = np.sqrt(1.5 * square)
    yields = q > hardening.stress(before.equivalent)
    trial, q = trial[yields], q[yields]
    stiffness = 3.0 * shear + hardening.kinematic
    rise = hardening.increment(q, before.equivalent[yields], stiffness)

    plastic, equivalent = before.strain.copy(), before.equivalent.copy()
    along = 1.5 * trial / q[:, None]
    plastic[yields] += rise[:, None] * along
    equivalent[yields] += rise
    turned = 6.0 * shear**2 * rise / q
    stiff = 4.0 * shear**2 / (stiffness + hardening.slope(equivalent[yields]))
    softening = turned[:, None, None] * DEVIATOR
    softening += (stiff - 2.0 / 3.0 * turned)[:, None, None] * along[:, :, None] * along[:, None]
    return PlasticStep(PlasticState(plastic, equivalent), yields, softening)


def stress_of(
    shear: float | np.ndarray, nu: float | np.ndarray, strain: np.ndarray, state: PlasticState
) -> tuple[np.ndarray, np.ndarray]:
    """sx, sz, txz (k, 3) and sy (k,) [Pa] of a strain (k, 3) exx, ezz, gxz in a state, by the shear
    modulus [Pa] and Poisson's ratio, or by those of every point (k,)."""
    volume = strain[:, 0] + strain[:, 1]
    mean = 2.0 * shear * (1.0 + nu) / (3.0 * (1.0 - 2.0 * nu)) * volume
    deviator = np.asarray(2.0 * shear)[..., None] * (strain @ DEVIATOR.T - state.strain)
    across = mean - deviator[:, 0] - deviator[:, 1]
    return deviator + np.outer(mean, [1.0, 1.0, 0.0]), across


class PlasticBody:
    """`body` of an elastic-plastic metal with the body's elastic constants, and its plastic state.
    A coating stays elastic.

    held    (n, 2) components that the support holds
    points  (3m, 2) [m] quadrature points, three of each element in turn
    areas   (m, 3) [m^2] of these points
    state   of the metal there at the end of the last accepted step

    Raises ValueError unless elastic constants are the body's, and displacements quadratic."""

    symmetric, softness = True, np.ones(1)

    def __init__(self, body: ElasticBody, metal: ElasticPlastic) -> None:
        if metal.elastic != body.material:
            raise ValueError("the metal's elastic constants must be those of the body")
        if body.degree != 2:
            raise ValueError(f"plastic flow wants displacements of degree 2, not {body.degree}")
        self.body, self.metal, self.held = body, metal, body.held
        nodes = body.nodes[body.elements]
        self.points = (shapes(GAUSS) @ nodes).reshape(-1, 2)
        jacobian = jacobians(nodes, GAUSS)
        # of the shape functions (m, 3, 6, 2) by x and z
        self._slopes = slopes(GAUSS) @ np.linalg.inv(jacobian)
        self.areas = GAUSS_WEIGHT * np.linalg.det(jacobian)
        self._stiffness = body.stiffness()
        self.state = PlasticState.virgin(self.areas.size)
        self._coated = np.repeat(body.coated, 3)  # (3m,) points that stay elastic
        self._shear, self._ratio = np.repeat([body.shear_modulus, body.poissons_ratio], 3, axis=1)

    def gradient(self, displacement: np.ndarray) -> np.ndarray:
        """du_i/dx_j (3m, 2, 2) of a displacement (n, 2) [m]."""
        nodal = displacement[self.body.elements]
        return (nodal.transpose(0, 2, 1)[:, None] @ self._slopes).reshape(-1, 2, 2)

    def strain(self, displacement: np.ndarray) -> np.ndarray:
        """exx, ezz, gxz (3m, 3) of a displacement (n, 2) [m]."""
        slope = self.gradient(displacement)
        return np.column_stack([slope[:, 0, 0], slope[:, 1, 1], slope[:, 0, 1] + slope[:, 1, 0]])

    def step(self, displacement: np.ndarray) -> PlasticStep:
        """The step from the accepted state to a displacement (n, 2) [m]."""
        strain = np.where(self._coated[:, None], 0.0, self.strain(displacement))
        return return_mapping(self.metal, strain, self.state)

    def linearised(self, displacement: np.ndarray) -> tuple[np.ndarray, csr_matrix]:
        """Internal force (n, 2) [N/m] and its derivative (2n, 2n) [Pa] at a displacement (n, 2).
        For the step from the accepted state. Rows and columns of held components are as in
        `ElasticBody.stiffness`."""
        step = self.step(displacement)
        return self._force(displacement, step), self._stiffness - self._softening(step)

    def force(self, displacement: np.ndarray) -> np.ndarray:
        """The internal force alone."""
        return self._force(displacement, self.step(displacement))

    def _force(self, displacement: np.ndarray, step: PlasticStep) -> np.ndarray:
        elastic = (self._stiffness @ displacement.ravel()).reshape(-1, 2)
        return elastic - self.plastic_force(step.state)

    def plastic_force(self, state: PlasticState) -> np.ndarray:
        """Nodal forces (n, 2) [N/m] that move an elastic body as the plastic strain of a state."""
        eigenstress = 2.0 * self.metal.elastic.shear_modulus * state.strain
        return np.where(self.held, 0.0, self.force_of(eigenstress))

    def accept(self, displacement: np.ndarray) -> None:
        """Make the end of the step to a displacement (n, 2) [m] the accepted state."""
        self.state = self.step(displacement).state

    def stress(
        self, displacement: np.ndarray, state: PlasticState
    ) -> tuple[np.ndarray, np.ndarray]:
        """sx, sz, txz (3m, 3) and sy (3m,) [Pa] under a displacement (n, 2) [m] in a state."""
        return stress_of(self._shear, self._ratio, self.strain(displacement), state)

    def bearable(self, equivalent: np.ndarray, mean: np.ndarray) -> np.ndarray:
        """Largest equivalent stress (k,) [Pa] at equivalent plastic strains (k,) and means of the
        three normal stresses (k,) [Pa]; as if a moved yield surface had moved straight."""
        hardening = self.metal.hardening
        return hardening.stress(equivalent) + hardening.kinematic * equivalent

    def force_of(self, stress: np.ndarray) -> np.ndarray:
        """Nodal forces (n, 2) [N/m] in balance with sx, sz, txz (3m, 3) [Pa]."""
        element = np.flatnonzero(stress.any(axis=1).reshape(-1, 3).any(axis=1))
        s = stress.reshape(-1, 3, 3)[element] * self.areas[element][..., None]
        tensor = s[..., [[0, 2], [2, 1]]]
        nodal = (self._slopes[element] @ tensor).sum(axis=1)
        return nodal_sums(self.body.elements[element], nodal, len(self.body.nodes))

    def _softening(self, step: PlasticStep) -> csr_matrix:
        """Elastic minus consistent tangent (2n, 2n) [Pa], zero on held components."""
        yields = step.yields.reshape(-1, 3)
        element = np.flatnonzero(yields.any(axis=1))
        softening = np.zeros((len(element), 3, 3, 3))
        softening[yields[element]] = step.softening
        softening *= self.areas[element][..., None, None]
        slope = self._slopes[element]
        strain = np.zeros((len(element), 3, 3, 6, 2))
        strain[:, :, 0, :, 0] = strain[:, :, 2, :, 1] = slope[..., 0]
        strain[:, :, 1, :, 1] = strain[:, :, 2, :, 0] = slope[..., 1]
        strain = strain.reshape(-1, 3, 3, 12)
        strain *= ~self.held[self.body.elements[element]].reshape(-1, 1, 1, 12)
        rows = (softening @ strain).reshape(-1, 9, 12)
        block = strain.reshape(-1, 9, 12).transpose(0, 2, 1) @ rows
        nodes = self.body.elements[element]
        component = (2 * nodes[:, :, None] + np.arange(2)).reshape(-1, 12)
        place = component[:, :, None], component[:, None, :]
        return matrix_of(block, *place, self._stiffness.shape)
