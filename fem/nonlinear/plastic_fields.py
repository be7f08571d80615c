"""Stress and plastic strain of a pressed metal at the mesh's points.

Known is either at three points of each element, which make a linear field there; a mesh point has
the mean of what the elements around it say, by area. Patches of higher degree, as for elastic
stresses (`fem.stress.recovery`), would overshoot at the edge of the plastic zone, where both have
kinks.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from analytic.stress_state import StressState, von_mises
from fem.body.triangle import GAUSS, reference_nodes
from fem.nonlinear.plasticity import PlasticBody
from fem.nonlinear.press_plastic import PlasticContact

# Values at the six nodes of those at the three points, joined linearly.
_EXTENDED = np.column_stack([np.ones(6), reference_nodes(2)]) @ np.linalg.inv(
    np.column_stack([np.ones(3), GAUSS])
)


@dataclass(frozen=True)
class PlasticFields:
    """Under one load, or of what is left without one, at the mesh's n points.

    stress               in the plane (n,) [Pa]
    sy                   across the plane (n,) [Pa]; not nu (sx + sz) where the metal has flowed
    equivalent_strain    equivalent plastic strain (n,), zero where the metal has not flowed
    """

    stress: StressState
    sy: np.ndarray
    equivalent_strain: np.ndarray

    @cached_property
    def von_mises(self) -> np.ndarray:
        """Equivalent stress (n,) [Pa]."""
        return von_mises(self.stress, self.sy)


def plastic_fields(body: PlasticBody, contact: PlasticContact) -> PlasticFields:
    """Stresses and plastic strain of a body under a contact of its history."""
    inside, across = body.stress(contact.displacement, contact.state)
    sampled = np.column_stack([inside, across, contact.state.equivalent])
    sx, sz, txz, sy, strain = _at_points(body, sampled).T
    return PlasticFields(StressState(sx, sz, txz), sy, np.maximum(strain, 0.0))


def _at_points(body: PlasticBody, sampled: np.ndarray) -> np.ndarray:
    """Means (n, k) at the mesh points of values (3m, k) at the elements' three points."""
    elements, areas = body.body.elements, body.areas.sum(axis=1)
    values = _EXTENDED @ sampled.reshape(len(elements), 3, -1) * areas[:, None, None]
    count = len(body.body.nodes)
    total = np.bincount(elements.ravel(), np.repeat(areas, 6), minlength=count)
    columns = [
        np.bincount(elements.ravel(), v.ravel(), minlength=count) for v in values.T.swapaxes(1, 2)
    ]
    return np.column_stack(columns) / total[:, None]
