"""Compliance of a layered body's surface: Galerkin hats on a free line.

    (C p)_i = int phi_i uz dx,   uz of the wave p e^ikx: C(k) p      (`analytic.layers.layered`)

The coefficients are integrals over all waves (`analytic.layers.kernel`); the approximate inverse
sees each wave with its nearest aliases k + 2 pi j/h.

Displacements and an approach count from a rigid base. A half-plane below leaves them undefined up
to a constant, as in `analytic.operators.half_plane`.

    h   pitch [m]      k   wavenumber [1/m]      t   thickness [m]      L   datum [m]
"""

import numpy as np

from analytic.layers.kernel import hat_compliance
from analytic.layers.layered import LayeredBody, normal_compliance
from analytic.operators.convolution import Convolution, made_once


class LayeredSurface(Convolution):
    """Compliance of a layered body under hats on a free line, applied by FFT.

    count    number of elements      pitch    h [m]
    body     the layer and its base
    datum    L [m] where the base is a half-plane; default the support (count + 1) h and four
             times what the layer spreads a load to, which makes the operator positive definite
    """

    def __init__(
        self, count: int, pitch: float, body: LayeredBody, datum: float | None = None
    ) -> None:
        self.pitch, self.body = pitch, body
        self.datum = (count + 1) * pitch + 4.0 * _spread(body) if datum is None else datum
        log_datum = float(np.log(self.datum / pitch))
        scale = pitch**2 / (2.0 * np.pi * body.material.shear_modulus)
        column = scale * hat_compliance(count, pitch / body.thickness, body.contrast, log_datum)
        super().__init__(column, self._symbol)

    @made_once
    def coarsened(self) -> "LayeredSurface":
        """The same body under elements twice as wide, centred on nodes 1, 3, 5, …"""
        return LayeredSurface(self.count // 2, 2.0 * self.pitch, self.body, self.datum)

    def _symbol(self, cycles: np.ndarray) -> np.ndarray:
        """sum over j = -1, 0, 1 of h C(k + 2 pi j/h) sinc^4 [m^2/Pa], positive at every wave."""
        if not self.body.rigid:  # the mean: any positive value
            cycles = np.where(cycles == 0.0, 0.5 * cycles[min(1, len(cycles) - 1)], cycles)
        seen = np.abs(cycles + np.array([[-1.0], [0.0], [1.0]]))
        waves = normal_compliance(self.body, 2.0 * np.pi * seen / self.pitch)
        return self.pitch * np.sum(np.sinc(seen) ** 4 * waves, axis=0)


def _spread(body: LayeredBody) -> float:
    """Length to which a layer stiffer than its base spreads a load, as a plate does [m]."""
    return body.thickness * max(1.0, np.cbrt(body.contrast.softness))
