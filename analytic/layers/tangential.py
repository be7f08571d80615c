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
from scipy.fft import irfft
from scipy.special import zeta

from analytic.layers.aliases import alias_sum
from analytic.layers.kernel import hat_coupling
from analytic.layers.layered import LayeredBody, wave_compliance
from analytic.layers.operator import aliases_of
from analytic.operators.convolution import Convolution, made_once
from analytic.operators.periodic import FEWEST


class TangentialLayer(Convolution):
    """T of a layered body, hat tractions (n,) [Pa] in +x to weighted displacements (n,) [m^2].

    count     number of elements      pitch    h [m]
    body      the layer and its base
    periodic  the hats repeat after count h; the mean traction leaves the surface level
    """

    def __init__(self, count: int, pitch: float, body: LayeredBody, periodic: bool = False) -> None:
        self.pitch, self.body = pitch, body
        if periodic:
            symbol = coupling_symbol(np.arange(count // 2 + 1) / count, pitch, body)
            column = irfft(1j * symbol, count)
        else:
            scale = pitch**2 / (2.0 * np.pi * body.material.shear_modulus)
            column = scale * hat_coupling(count, pitch / body.thickness, body.contrast)
        column[0] = 0.0  # odd, but for rounding
        super().__init__(
            column,
            lambda cycles: np.full(len(cycles), np.inf),  # no inverse to approximate
            row=-column,
            periodic=periodic,
        )

    @made_once
    def coarsened(self) -> "TangentialLayer | None":
        """The same body under elements twice as wide, centred on nodes 1, 3, 5, …"""
        half, odd = divmod(self.count, 2)
        if self.periodic and (odd or half < FEWEST):
            return None
        return TangentialLayer(half, 2.0 * self.pitch, self.body, self.periodic)


def coupling_symbol(cycles: np.ndarray, pitch: float, body: LayeredBody) -> np.ndarray:
    """Eigenvalues of the periodic T over i [m^2/Pa], at `cycles` from 0 to 1/2; none of the mean.

    h C(k) sinc^4 summed over aliases, those of -k with the other sign.
    """
    beyond = aliases_of(pitch, body)
    total = np.zeros(len(cycles))
    inside = cycles > 0.0

    def wave(seen: np.ndarray) -> np.ndarray:
        return pitch * wave_compliance(body, 2.0 * np.pi * seen / pitch).coupling

    total[inside] = alias_sum(wave, cycles[inside], beyond, odd=True)
    power = (np.sin(np.pi * cycles) / np.pi) ** 4
    rest = power * (zeta(5.0, beyond + cycles) - zeta(5.0, beyond - cycles))
    e = body.contrast.e
    return total - pitch**2 * e / (4.0 * np.pi * body.material.shear_modulus) * rest
