"""Flow of von Mises with linear isotropic hardening, in plane strain, at many points at once.

The stress at the end of a step is the elastic one brought back to the yield surface along its
own deviator; with linear hardening that is one division (Simo and Hughes 1998, Computational
Inelasticity, box 3.2). What the tangent of this map loses against the elastic one is the
consistent tangent of the same source, and what makes Newton's method quadratic.

Nomenclature
    e, g       strains exx, ezz and gxz = 2 exz; eyy = 0
    ep, k      plastic strain and equivalent plastic strain, sum of sqrt(2/3 dep:dep)
    s, q       deviator of stress, and sqrt(3/2 s:s), the equivalent stress
    Y, H       yield stress in tension [Pa]; its rise with k [Pa]
    G, dk      shear modulus [Pa]; rise of k in the step, (q - Y - H k) / (3 G + H)
"""

from dataclasses import dataclass

import numpy as np

from analytic.material import Material

# Of the deviator's map from (exx, ezz, gxz) to (exx', ezz', exz).
DEVIATOR = np.array([[2.0, -1.0, 0.0], [-1.0, 2.0, 0.0], [0.0, 0.0, 1.5]]) / 3.0


@dataclass(frozen=True)
class ElasticPlastic:
    """A metal: `elastic` until its equivalent stress reaches `yield_stress` [Pa] > 0.

    hardening_modulus   rise of the yield stress with the equivalent plastic strain [Pa] >= 0. A
                        bar in tension then has the slope E H / (E + H); with 0 it flows at the
                        yield stress without end
    """

    elastic: Material
    yield_stress: float
    hardening_modulus: float = 0.0

    def __post_init__(self) -> None:
        if not (np.isfinite(self.yield_stress) and self.yield_stress > 0.0):
            raise ValueError(f"the yield stress must be positive, not {self.yield_stress:g} Pa")
        if not (np.isfinite(self.hardening_modulus) and self.hardening_modulus >= 0.0):
            raise ValueError(
                f"the hardening modulus must not be negative, not {self.hardening_modulus:g} Pa"
            )


@dataclass(frozen=True)
class PlasticState:
    """What a metal remembers at k points.

    strain       (k, 3) plastic exx, ezz, exz; eyy is minus the sum of the first two
    equivalent   (k,) equivalent plastic strain, never falling
    """

    strain: np.ndarray
    equivalent: np.ndarray

    @classmethod
    def virgin(cls, count: int) -> "PlasticState":
        return cls(np.zeros((count, 3)), np.zeros(count))


@dataclass(frozen=True)
class Flow:
    """One step at k points, from a state to the next.

    state    at the end
    yields   (k,) whether the point flowed in this step
    lost     (points that flow, 3, 3) [Pa] elastic less consistent tangent, of sx, sz, txz by exx,
             ezz, gxz; symmetric
    """

    state: PlasticState
    yields: np.ndarray
    lost: np.ndarray


def flow(metal: ElasticPlastic, strain: np.ndarray, before: PlasticState) -> Flow:
    """Where the strain (k, 3) exx, ezz, gxz leads from the state `before`."""
    shear, hardening = metal.elastic.shear_modulus, metal.hardening_modulus
    trial = 2.0 * shear * (strain @ DEVIATOR.T - before.strain)
    across = trial[:, 0] + trial[:, 1]
    square = trial[:, 0] ** 2 + trial[:, 1] ** 2 + across**2 + 2.0 * trial[:, 2] ** 2
    q = np.sqrt(1.5 * square)
    excess = q - metal.yield_stress - hardening * before.equivalent
    yields = excess > 0.0
    trial, q = trial[yields], q[yields]
    rise = excess[yields] / (3.0 * shear + hardening)

    plastic, equivalent = before.strain.copy(), before.equivalent.copy()
    along = 1.5 * trial / q[:, None]
    plastic[yields] += rise[:, None] * along
    equivalent[yields] += rise
    turned = 6.0 * shear**2 * rise / q
    stiff = 4.0 * shear**2 / (3.0 * shear + hardening)
    lost = turned[:, None, None] * DEVIATOR
    lost += (stiff - 2.0 / 3.0 * turned)[:, None, None] * along[:, :, None] * along[:, None, :]
    return Flow(PlasticState(plastic, equivalent), yields, lost)


def stress(
    metal: ElasticPlastic, strain: np.ndarray, state: PlasticState
) -> tuple[np.ndarray, np.ndarray]:
    """sx, sz, txz (k, 3) and sy (k,) [Pa] of a strain (k, 3) exx, ezz, gxz in a state."""
    shear, nu = metal.elastic.shear_modulus, metal.elastic.poissons_ratio
    volume = strain[:, 0] + strain[:, 1]
    mean = 2.0 * shear * (1.0 + nu) / (3.0 * (1.0 - 2.0 * nu)) * volume
    deviator = 2.0 * shear * (strain @ DEVIATOR.T - state.strain)
    across = mean - deviator[:, 0] - deviator[:, 1]
    return deviator + np.outer(mean, [1.0, 1.0, 0.0]), across
