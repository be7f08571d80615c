"""Partition of frictional heat between two bodies in contact, solved and not assumed.

Both bodies have the same temperature on the contact and no other exchange; what friction makes
there goes into one or the other. With q the flux into body 1 on hats phi_i over the contact,
Q = mu p V that of the friction and B_j = integral N_a phi_i dx of body j:

    C_1 dT_1/dt + A_1 T_1 - B_1 q = 0
    C_2 dT_2/dt + A_2 T_2 + B_2 q = B_2 Q
    B_1^T T_1 - B_2^T T_2         = (b_2 - b_1) integral phi_i dx

as one system. T_j rises from the bulk temperature b_j [K]. Hats are cut off at the ends of a patch,
where the fluxes jump. The surfaces' meshes need not match each other or the hats.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from scipy.sparse import block_diag, bmat, csr_matrix

from fem.body.sums import matrix_of
from fem.body.surface import Surface, hat_points
from fem.heat.body import ThermalBody
from fem.heat.conduction import Conduction
from fem.heat.transient import march
from fem.solver.mumps import solve_once

# Of hats over the spacing of the finer surface's nodes; with a quarter the fluxes alternate.
LEAST_PITCH = 0.8


@dataclass(frozen=True)
class Partition:
    """Heat and temperatures of both bodies at one time.

    x           (m,) [m] nodes of the hats in contact      flux   (2, m) [W/m^2] into each body
    temperature (n_1,), (n_2,) [K] rises at the nodes      share  of all heat that body 1 takes
    """

    x: np.ndarray
    flux: np.ndarray
    temperature: tuple[np.ndarray, np.ndarray]
    share: float


class FrictionalHeat:
    """Two bodies heated on the contact between the ends of `x` (m,) [m], ascending.

    contact  (m - 1,) whether the surfaces touch between one x and the next; None: all along

    Raises ValueError if nothing touches, if x does not ascend or leaves a surface, or if hats are
    finer than the nodes of both surfaces, which leaves the fluxes undetermined.
    """

    def __init__(
        self,
        bodies: tuple[Conduction, Conduction],
        x: np.ndarray,
        contact: np.ndarray | None = None,
    ) -> None:
        contact = np.ones(len(x) - 1, dtype=bool) if contact is None else np.asarray(contact)
        if not contact.any():
            raise ValueError("no part of the surfaces is in contact")
        touching = np.pad(contact, 1)
        self.nodes = np.flatnonzero(touching[1:] | touching[:-1])
        self.x, self.bodies = np.asarray(x, dtype=float), bodies
        self._hats = [hat_integrals(side.body, self.x, contact)[:, self.nodes] for side in bodies]
        first, second = self._hats
        pitch, middle = np.diff(self.x)[contact], (0.5 * (self.x[1:] + self.x[:-1]))[contact]
        spaced = np.min([node_spacing(side.body.surface, middle) for side in bodies], axis=0)
        if np.any(pitch < spaced * LEAST_PITCH):
            raise ValueError(
                f"hats of {pitch.min():g} m are finer than the nodes of both surfaces: mesh one of "
                "them more finely, or take fewer hats"
            )
        count = len(self.nodes)
        self._sizes = [first.shape[0], second.shape[0], count]
        rows = [
            [bodies[0].matrix, None, -first],
            [None, bodies[1].matrix, second],
            [first.T, -second.T, None],
        ]
        self._matrix = bmat(rows, format="csr")
        self._held = np.concatenate([*(side.held for side in bodies), np.zeros(count, dtype=bool)])

    def steady(self, heat: np.ndarray, bulk: tuple[float, float] = (0.0, 0.0)) -> Partition:
        """Partition of `heat` (m,) [W/m^2] at x, linear between. FemError: nothing holds a body."""
        free, whole = ~self._held, np.zeros(len(self._held))
        inner = self._matrix[free][:, free]
        whole[free] = solve_once(inner, self._load(heat, bulk)[free], symmetric=False)
        return self._parted(whole, heat)

    def transient(
        self,
        heat: Callable[[float], np.ndarray],
        times: np.ndarray,
        bulk: tuple[float, float] = (0.0, 0.0),
    ) -> Iterator[Partition]:
        """Partitions at `times` (k,) [s] of the heat (m,) [W/m^2] at each, with both bodies at
        their bulk temperatures at the first, where the partition is not known (NaN)."""
        count = self._sizes[2]
        stored = [*(side.body.capacity for side in self.bodies), csr_matrix((count, count))]
        capacity, start = block_diag(stored, format="csr"), np.zeros(len(self._held))
        system = capacity, self._matrix, self._held, lambda t: self._load(heat(t), bulk)
        states = march(*system, times, start)
        for time, state in zip(times, states, strict=True):
            if time == times[0]:
                state[-count:] = np.nan
            yield self._parted(state, heat(time))

    def _load(self, heat: np.ndarray, bulk: tuple[float, float]) -> np.ndarray:
        first, second = self._hats
        apart = (bulk[1] - bulk[0]) * np.asarray(first.sum(axis=0)).ravel()
        parts = [np.zeros(self._sizes[0]), second @ heat[self.nodes], apart]
        return np.concatenate(parts)

    def _parted(self, state: np.ndarray, heat: np.ndarray) -> Partition:
        first, second, taken = np.split(state, np.cumsum(self._sizes)[:-1])
        heat, width = heat[self.nodes], np.asarray(self._hats[0].sum(axis=0)).ravel()
        share = float(width @ taken / (width @ heat)) if np.any(heat) else np.nan
        return Partition(
            self.x[self.nodes], np.stack([taken, heat - taken]), (first, second), share
        )


def node_spacing(surface: Surface, x: np.ndarray) -> np.ndarray:
    """Length (k,) [m] of the surface's edges at x (k,) [m] over their degree."""
    edge = np.searchsorted(surface.edges[:, 2], x)
    return (surface.edges[edge, 2] - surface.edges[edge, 0]) / surface.degree


def hat_integrals(body: ThermalBody, x: np.ndarray, contact: np.ndarray) -> csr_matrix:
    """B (n, m) [m]: integral N_a phi_i dx over the parts between x (m,) [m] in `contact`."""
    points = hat_points(body.surface, x)
    column = points.column + 1
    weight = points.weight * contact[column[0]][:, None]
    value = np.einsum("aeg,eg,heg->ahe", points.shape, weight, points.hat)
    row = body.surface.point[points.node][:, None, :]
    return matrix_of(value, row, column, (len(body.nodes), len(x)))
