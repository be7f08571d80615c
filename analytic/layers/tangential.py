"""Normal displacement of a layered body's surface under hats of sliding traction.

    (T q)_i = int phi_i uz dx,      uz of the wave q e^ikx: i sign(k) C(k) q

with the `coupling` C of `analytic.layers.layered`. Beside `analytic.layers.operator` it makes the
compliance of a surface that slides (`analytic.operators.tangential.CoupledPair`). Being odd it does
no work. Where the layer slides on its base, a net traction Q is held by its two ends: the one is
stretched and the other pressed, and the surface is left higher by nu Q/(2 G) on one side than on
the other.

    h   pitch [m]      k   wavenumber [1/m]      t   thickness [m]      q   traction in +x [Pa]
"""

import numpy as np

from analytic.layers.kernel import hat_coupling
from analytic.layers.layered import LayeredBody
from analytic.operators.convolution import Convolution, made_once


class TangentialLayer(Convolution):
    """T of a layered body, hat tractions (n,) [Pa] in +x to weighted displacements (n,) [m^2].

    count  number of elements      pitch    h [m]
    body   the layer and its base
    """

    def __init__(self, count: int, pitch: float, body: LayeredBody) -> None:
        self.pitch, self.body = pitch, body
        scale = pitch**2 / (2.0 * np.pi * body.material.shear_modulus)
        column = scale * hat_coupling(count, pitch / body.thickness, body.contrast)
        column[0] = 0.0  # odd, but for rounding
        # no inverse to approximate
        super().__init__(column, lambda cycles: np.full(len(cycles), np.inf), row=-column)

    @made_once
    def coarsened(self) -> "TangentialLayer":
        """The same body under elements twice as wide, centred on nodes 1, 3, 5, …"""
        return TangentialLayer(self.count // 2, 2.0 * self.pitch, self.body)
