"""What stays elastic in a contact with flow, condensed onto the hats: exact, and dense.

Nomenclature: C compliance [m^2/Pa] of hat pressures p [Pa], w integrals of the hats [m]."""

import numpy as np

from fem.contact.nonlinear import CONTACT, HatStates
from fem.solver.mumps import FemError

MOST_HATS = 3000  # for which compliances are formed: a back-substitution each, 72 MB a matrix
MOST_EXCHANGES = 100  # of hats that touch and hats that do not


class ElasticContact:
    """Contact on a compliance C (count, count) [m^2/Pa] of both surfaces together."""

    def __init__(self, flexible: np.ndarray, weights: np.ndarray) -> None:
        self.flexible, self._weights = flexible, weights

    def __call__(self, gap: np.ndarray, load: float, start: np.ndarray) -> tuple[np.ndarray, float]:
        """Pressure (count,) [Pa] and approach [m] under a load [N/m] > 0, for a weighted gap
        (count,) [m^2], from a guessed pressure. Raises FemError where the active set cycles."""
        weights, flexible = self._weights, self.flexible
        stiff = weights.mean() / flexible.diagonal().mean()
        hats = HatStates(start, np.inf, load, weights)
        hats.keep_one_in_contact(gap / weights)
        for _ in range(MOST_EXCHANGES):
            before, on = hats.states.copy(), np.flatnonzero(hats.states == CONTACT)
            system = np.zeros((len(on) + 1, len(on) + 1))
            system[:-1, :-1] = flexible[np.ix_(on, on)] * stiff
            system[:-1, -1], system[-1, :-1] = -weights[on], weights[on]
            found = np.linalg.solve(system, np.append(-stiff * gap[on], load))
            pressure, approach = np.zeros_like(gap), float(found[-1]) / stiff
            pressure[on] = found[:-1]
            opening = (gap + flexible @ pressure) / weights - approach
            opening[on] = 0.0
            hats.exchange(pressure, opening, stiff)
            hats.keep_one_in_contact(opening)
            if np.array_equal(before, hats.states):
                return pressure, approach
        raise FemError(f"the contact did not settle in {MOST_EXCHANGES} exchanges")
