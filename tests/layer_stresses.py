"""Stresses in a layer under a line of hats, normal and tangential, and its coupling compliance."""

from dataclasses import dataclass

import numpy as np

from analytic.layers.layered import LayeredBody, coupling
from analytic.layers.stress import AddedStress
from analytic.material import Material
from analytic.stress.field import StressField, friction_field
from analytic.stress_state import StressState

LAYER = Material(210e9, 0.3)
BASES = {
    "bonded": "bonded",
    "frictionless": "frictionless",
    "stiffer": Material(1e12, 0.45),
    "softer": Material(3e9, 0.0),
}


@dataclass(frozen=True)
class LayerField:
    """Stresses [Pa] of shape (len(z), len(x)) under p alone and under q = p in +x alone."""

    x: np.ndarray
    z: np.ndarray
    normal: StressState
    traction: StressState

    def at(self, friction: float) -> StressField:
        """The field under p and q = friction * p in +x."""
        return StressField(self.x, self.z, self.normal.plus(friction, self.traction))


def layer_field(
    body: LayeredBody,
    x_nodes: np.ndarray,
    pressure: np.ndarray,
    x_range: tuple[float, float],
    z: np.ndarray,
    subdivisions: int = 1,
    below: bool = False,
) -> LayerField:
    """Stresses on the levels z (k,) [m], ascending, 0 <= z <= t or `below`, within x_range; the
    rest as of `friction_field`. On a frictionless base nothing holds a net traction Q but the layer
    itself: its two ends, sx = -+Q/2t far off."""
    field = friction_field(x_nodes, pressure, x_range, z, subdivisions)
    added = AddedStress.of(body, x_nodes, pressure, x_range).field(field.x, z, below)
    normal = field.stress.normal.plus(1.0, StressState(*added[:3]))
    traction = field.stress.traction.plus(1.0, StressState(*added[3:]))
    return LayerField(field.x, field.z, normal, traction)


def coupling_compliance(body: LayeredBody, wavenumber: np.ndarray) -> np.ndarray:
    """uz of the surface under waves of traction [m/Pa]: uz cos kx under sin kx, k [1/m] > 0."""
    scale = body.thickness / (2.0 * body.material.shear_modulus)
    w = np.asarray(wavenumber * body.thickness, dtype=float)
    return scale * coupling(body.contrast, w) / w
