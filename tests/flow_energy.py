"""Where the work of a contact on a body that flows goes: into elastic energy, and into flow.

Over an increment from a state 0 to a state 1 the body's strains are in the mean balance with the
mean of its nodal forces, so that at small strains, whatever the increment,

    (F0 + F1)/2 . (u1 - u0)  =  W1 - W0  +  sum_q w_q (s0 + s1)/2 : (ep1 - ep0),

to the accuracy of the equilibrium: `work`, `stored` and `plastic_work` balance. What increments
miss of the true path is in `plastic_work`, which along that path belongs to the state,

    sum_q w_q (integral Y dk + H'/3 ep : ep),

the `flowed` energy. The two differ by what a trapezoid misses, of second order in the increments.
At finite strains F turns with the surface, and the work misses as much; so does the plastic work by
the change of ln Up, where that turns.

Nomenclature: F nodal forces [N/m], u displacement [m], s stress conjugate to the strain [Pa], W
elastic energy [J/m]; ep, k, Y, H', w as of `fem.nonlinear.plasticity`."""

from dataclasses import dataclass

import numpy as np

from fem.nonlinear.finite_plasticity import FinitePlasticBody
from fem.nonlinear.plasticity import PlasticBody, PlasticState, stress_of
from fem.nonlinear.press_finite import FiniteLoadHistory
from fem.nonlinear.press_plastic import LoadHistory

GAUSS = np.polynomial.legendre.leggauss(16)


@dataclass(frozen=True)
class Energies:
    """Energies of one meter of a body [J/m], since it was virgin."""

    work: float  # of the contact on the body
    stored: float  # elastic energy
    plastic_work: float  # on the plastic strain, by mean stresses of each increment
    flowed: float  # the same by the flow stress, of the states alone

    @property
    def left(self) -> float:
        """Work that is not accounted for."""
        return self.work - self.stored - self.plastic_work


class Accounted:
    """The energies of a history of loads, from increment to increment.

    energies  one for each contact of the history"""

    def __init__(self, *arguments: object) -> None:
        super().__init__(*arguments)
        self._moved = self._loaded = np.zeros(self.body.held.shape)
        self._stress, self._plastic = np.zeros((2, self.body.areas.size, 4))
        self._now, self.energies = Energies(0.0, 0.0, 0.0, 0.0), []

    def contact(self, load: float, iterations: int) -> object:
        self.energies.append(self._now)
        return super().contact(load, iterations)

    def release(self) -> None:
        super().release()
        self._book(np.zeros(self.body.held.shape))

    def _accept(self, state: object) -> None:
        super()._accept(state)
        self._book(self._nodal_force())

    def _book(self, force: np.ndarray) -> None:
        """Enter the increment that ended under nodal forces (n, 2) [N/m] of the contact."""
        body, displacement = self.body, self.state.displacements[0]
        elastic, stress = _balance(body, displacement)
        plastic, area = _parts(body.state), body.areas.ravel()
        mean, flow = 0.5 * (self._stress + stress), plastic - self._plastic
        way = displacement - self._moved
        self._now = Energies(
            work=self._now.work + 0.5 * float(np.sum((self._loaded + force) * way)),
            stored=0.5 * float(area @ (stress * elastic).sum(axis=1)),
            plastic_work=self._now.plastic_work + float(area @ (mean * flow).sum(axis=1)),
            flowed=float(area @ _flowed(body, plastic)),
        )
        self._loaded, self._moved = force, displacement
        self._stress, self._plastic = stress, plastic


class AccountedHistory(Accounted, LoadHistory):
    """The energies at small strains."""

    def _nodal_force(self) -> np.ndarray:
        return self._compliance.load(self.state.pressure, self._friction)


class AccountedFiniteHistory(Accounted, FiniteLoadHistory):
    """The energies at finite strains, on a body whose far end is held."""

    def _nodal_force(self) -> np.ndarray:
        return self._force(self.state)


def _balance(body: PlasticBody, displacement: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Elastic strain exx, ezz, gxz, eyy (3m, 4) in the accepted state and the stress xx, zz, xz, yy
    (3m, 4) [Pa] that works on it; at finite strains the logarithmic one."""
    strain, state = body.strain(displacement), body.state
    if isinstance(body, FinitePlasticBody):
        unflowed, state = body._unflowed(state)
        strain = body._strain(displacement, unflowed).strain
    across = state.strain[:, 0] + state.strain[:, 1]
    elastic = np.column_stack([strain - [1.0, 1.0, 2.0] * state.strain, across])
    return elastic, np.column_stack(stress_of(body._shear, body._ratio, strain, state))


def _flowed(body: PlasticBody, plastic: np.ndarray) -> np.ndarray:
    """Energy (3m,) [J/m^3] that flow took up to the accepted state, of plastic strains (3m, 4)."""
    (at, weight), k = GAUSS, body.state.equivalent
    hardening = body.metal.hardening
    work = 0.5 * k * (hardening.stress(0.5 * np.outer(k, 1.0 + at)) @ weight)
    return work + hardening.kinematic / 3.0 * (plastic**2 @ [1.0, 1.0, 0.5, 1.0])


def _parts(state: PlasticState) -> np.ndarray:
    """Plastic exx, ezz, gxz, eyy (k, 4) of a state."""
    xx, zz, xz = state.strain.T
    return np.column_stack([xx, zz, 2.0 * xz, -xx - zz])
