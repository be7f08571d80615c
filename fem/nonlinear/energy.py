"""Where the work of a contact on a body that flows goes: into elastic energy, and into flow.

Over an increment from a state 0 to a state 1 the body's strains are in the mean balance with the
mean of its nodal forces, so that at small strains, whatever the increment,

    (F0 + F1)/2 . (u1 - u0)  =  W1 - W0  +  sum_q w_q (s0 + s1)/2 : (ep1 - ep0),

to the accuracy of the equilibrium: `work`, `stored` and `plastic_work` balance. What increments
miss of the true path is in `plastic_work`, which along that path belongs to the state,

    sum_q w_q (integral Y dk + H'/3 ep : ep),

the `flowed` energy. The two differ by what a trapezoid misses, of second order in the increments.
At finite strains F turns with the surface, and the work misses as much.

Nomenclature: F nodal forces [N/m], u displacement [m], s stress conjugate to the strain [Pa], W
elastic energy [J/m]; ep, k, Y, H', w as of `fem.nonlinear.plasticity`."""

from dataclasses import dataclass, fields

import numpy as np

from fem.nonlinear.plasticity import ElasticPlastic, PlasticBody, PlasticState


@dataclass(frozen=True)
class Energies:
    """Of one meter of a body [J/m], since it was virgin or between two states."""

    work: float  # of the contact on the body
    stored: float  # elastic energy
    plastic_work: float  # on the plastic strain, by mean stresses of each increment
    flowed: float  # the same by the flow stress, of the states alone

    @property
    def left(self) -> float:
        """Work that is not accounted for."""
        return self.work - self.stored - self.plastic_work

    def __sub__(self, before: "Energies") -> "Energies":
        return Energies(*(getattr(self, f.name) - getattr(before, f.name) for f in fields(self)))


class EnergyAccount:
    """The energies of a body from increment to increment."""

    def __init__(self, body: PlasticBody) -> None:
        self._body, self._area = body, body.areas.ravel()
        self._moved = self._force = np.zeros(body.held.shape)
        self._stress, self._plastic = np.zeros((2, body.areas.size, 4))
        self.now = Energies(0.0, 0.0, 0.0, 0.0)

    def add(self, force: np.ndarray, displacement: np.ndarray) -> None:
        """An increment to a displacement (n, 2) [m] under nodal forces (n, 2) [N/m] on the body,
        those of a support that moves among them."""
        body = self._body
        strain = body.strain(displacement)
        stress = np.column_stack(body.conjugate_stress(strain, body.state))
        plastic = plastic_parts(body.state)
        elastic = np.column_stack([strain, np.zeros(len(strain))]) - plastic
        mean, flow = 0.5 * (self._stress + stress), plastic - self._plastic
        way = displacement - self._moved
        self.now = Energies(
            work=self.now.work + 0.5 * float(np.sum((self._force + force) * way)),
            stored=0.5 * float(self._area @ (stress * elastic).sum(axis=1)),
            plastic_work=self.now.plastic_work + float(self._area @ (mean * flow).sum(axis=1)),
            flowed=float(self._area @ flow_energy(body.metal, body.state)),
        )
        self._force, self._moved = force, displacement
        self._stress, self._plastic = stress, plastic


def flow_energy(metal: ElasticPlastic, state: PlasticState) -> np.ndarray:
    """What flow has taken (k,) [J/m^3] to a state."""
    moved = equivalent_of(plastic_parts(state))
    return metal.hardening.work(state.equivalent) + 0.5 * metal.hardening.kinematic * moved**2


def plastic_parts(state: PlasticState) -> np.ndarray:
    """Plastic exx, ezz, gxz, eyy (k, 4) of a state."""
    xx, zz, xz = state.strain.T
    return np.column_stack([xx, zz, 2.0 * xz, -xx - zz])


def equivalent_of(parts: np.ndarray) -> np.ndarray:
    """Equivalent strain (k,) of plastic exx, ezz, gxz, eyy (k, 4)."""
    return np.sqrt(2.0 / 3.0 * (parts**2 @ [1.0, 1.0, 0.5, 1.0]))
