"""Partition of frictional heat between two bodies in contact, solved and not assumed.

Both bodies have the same temperature on the contact and no other exchange; what friction makes
there goes into one or the other. With q the flux into body 1 on hats phi_i over the contact,
Q = mu p V that of the friction and B_j = integral N_a phi_i dx of body j:

    A_1 T_1 - B_1 q       = 0
    A_2 T_2 + B_2 q       = B_2 Q
    B_1^T T_1 - B_2^T T_2 = 0

as one system. T_j rises from the bulk temperature of both [K]. Hats are cut off at the ends of a
patch, where the fluxes jump. The surfaces' meshes need not match each other or the hats.
"""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import bmat, csr_matrix

from fem.body.sums import matrix_of
from fem.body.surface import Surface, hat_points
from fem.heat.body import ThermalBody
from fem.heat.conduction import Conduction
from fem.solver.mumps import solve_once

# Of hats over the spacing of the finer surface's nodes; with a quarter the fluxes alternate.
LEAST_PITCH = 0.8


@dataclass(frozen=True)
class Partition:
    """Heat and temperatures of both bodies.

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

    def steady(self, heat: np.ndarray) -> Partition:
        """Partition of `heat` (m,) [W/m^2] at x, linear between. FemError: nothing holds a body."""
        free, heat, ends = ~self._held, heat[self.nodes], np.cumsum(self._sizes)[:-1]
        whole, load = np.zeros((2, len(free)))
        load[slice(*ends)] = self._hats[1] @ heat
        whole[free] = solve_once(self._matrix[free][:, free], load[free], symmetric=False)
        first, second, taken = np.split(whole, ends)
        width = np.asarray(self._hats[0].sum(axis=0)).ravel()
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
