"""Normal displacement of a layered body's surface under hats of pressure and of sliding traction.

    (C p)_i = int phi_i uz dx,   uz of the wave p e^ikx: C(k) p      (`analytic.layers.layered`)
    (T q)_i = int phi_i uz dx,   uz of the wave q e^ikx: i sign(k) C(k) q, C its `coupling`

The coefficients are integrals over all waves (`analytic.layers.kernel`); the approximate inverse
sees each wave with its nearest aliases k + 2 pi j/h.

Displacements and an approach count from a rigid base. A half-plane below leaves them undefined up
to a constant, as in `analytic.operators.half_plane`.

T beside C makes the compliance of a surface that slides (`analytic.operators.tangential`). Being
odd it does no work. Where the layer slides on its base, a net traction Q is held by its two ends,
one stretched and one pressed, which leaves the surface higher by nu Q/(2 G) on one side.

    h   pitch [m]      k   wavenumber [1/m]      t   thickness [m]      L   datum [m]
    p   pressure [Pa]  q   traction in +x [Pa]"""

import numpy as np

from analytic.layers.kernel import hat_compliance, hat_coupling
from analytic.layers.layered import LayeredBody, normal_compliance
from analytic.operators.convolution import Convolution


class LayeredSurface(Convolution):
    """Compliance of a layered body under hats on a free line, applied by FFT.

    count    number of elements      pitch    h [m]
    body     the layer and its base
    datum    L [m] where the base is a half-plane; default the support (count + 1) h and four
             times what the layer spreads a load to, which makes the operator positive definite"""

    def __init__(
        self, count: int, pitch: float, body: LayeredBody, datum: float | None = None
    ) -> None:
        self.pitch, self.body = pitch, body
        self.datum = (count + 1) * pitch + 4.0 * _spread(body) if datum is None else datum
        self.arguments = body, self.datum
        log_datum = float(np.log(self.datum / pitch))
        scale = pitch**2 / (2.0 * np.pi * body.material.shear_modulus)
        column = scale * hat_compliance(count, pitch / body.thickness, body.contrast, log_datum)
        super().__init__(column, self._symbol)

    def _symbol(self, cycles: np.ndarray) -> np.ndarray:
        """sum over j = -1, 0, 1 of h C(k + 2 pi j/h) sinc^4 [m^2/Pa], positive at every wave."""
        if not self.body.rigid:  # the mean: any positive value
            cycles = np.where(cycles == 0.0, 0.5 * cycles[min(1, len(cycles) - 1)], cycles)
        seen = np.abs(cycles + np.array([[-1.0], [0.0], [1.0]]))
        waves = normal_compliance(self.body, 2.0 * np.pi * seen / self.pitch)
        return self.pitch * np.sum(np.sinc(seen) ** 4 * waves, axis=0)


class TangentialLayer(Convolution):
    """T of a layered body, hat tractions (n,) [Pa] in +x to weighted displacements (n,) [m^2].

    count  number of elements      pitch    h [m]
    body   the layer and its base"""

    def __init__(self, count: int, pitch: float, body: LayeredBody) -> None:
        self.pitch, self.body, self.arguments = pitch, body, (body,)
        scale = pitch**2 / (2.0 * np.pi * body.material.shear_modulus)
        column = scale * hat_coupling(count, pitch / body.thickness, body.contrast)
        column[0] = 0.0  # odd, but for rounding
        # no inverse needs it: waves of a thin layer have none that is near a half-plane's
        super().__init__(column, np.zeros_like, row=-column)


def _spread(body: LayeredBody) -> float:
    """Length to which a layer stiffer than its base spreads a load, as a plate does [m]."""
    return body.thickness * max(1.0, np.cbrt(body.contrast.softness))
