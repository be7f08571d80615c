"""A body under a pressure along any direction: its displacement, and the stresses of it."""

import numpy as np

from fem.body.elasticity import ElasticBody, MeshedBody
from fem.body.surface import Direction, hat_forces, straight_down, tangent_of
from fem.stress.stress import NodalStress, nodal_stresses
from fem.stress.surface_load import SurfaceLoad


def nodal_stress(
    body: MeshedBody,
    displacement: np.ndarray,
    hats: np.ndarray,
    pressure: np.ndarray,
    friction: float = 0.0,
    direction: Direction = straight_down,
) -> NodalStress:
    """Stresses under the displacement (n, 2) [m] due to a pressure (count,) [Pa] and its sliding
    traction, by `nodal_stresses`."""
    load = SurfaceLoad(body, hats, pressure, np.array([friction]), direction)
    return nodal_stresses(displacement[:, None], load)[0]


def displacement_under(
    body: ElasticBody, hats: np.ndarray, pressure: np.ndarray, friction: float, direction: Direction
) -> np.ndarray:
    """The displacement (n, 2) [m] due to a pressure (count,) [Pa] and its sliding traction."""
    forces = (hat_forces(body.surface, hats, along) for along in (direction, tangent_of(direction)))
    down, along = (force @ pressure for force in forces)
    load = np.zeros(body.nodes.shape)
    load[body.surface.point] = (down + friction * along).reshape(-1, 2)
    return body.solve(load)
