"""Stresses of a solved body under one friction coefficient."""

import numpy as np

from fem.body.elasticity import MeshedBody
from fem.body.surface import Direction, straight_down
from fem.stress.stress import Beside, NodalStress, nodal_stresses
from fem.stress.surface_load import SurfaceLoad


def nodal_stress(
    body: MeshedBody,
    displacement: np.ndarray,
    hats: np.ndarray,
    pressure: np.ndarray,
    friction: float = 0.0,
    direction: Direction = straight_down,
    beside: Beside | None = None,
) -> NodalStress:
    """Stresses under the displacement (n, 2) [m] due to a pressure (count,) [Pa] and its sliding
    traction, by `nodal_stresses`."""
    load = SurfaceLoad(body, hats, pressure, np.array([friction]), direction)
    return nodal_stresses(displacement[:, None], load, beside and (beside,))[0]
