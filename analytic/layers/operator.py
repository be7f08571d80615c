"""Compliance of a layered body's surface: Galerkin hats on a free line.

    (C p)_i = int phi_i uz dx,   uz of the wave p e^ikx: C(k) p      (`analytic.layers.layered`)

The hats see a wave together with its aliases k + 2 pi j/h. From some j on the layer is a
half-plane, whose aliases have a closed sum; before that C(k) sinc^4(k h/2 pi) is positive and
summed by `analytic.layers.aliases`, at a cost that hardly depends on how thin the layer is.

Displacements and an approach count from a rigid base. A half-plane below leaves them undefined up
to a constant, as in `analytic.operators.half_plane`.

    h   pitch [m]      k   wavenumber [1/m]      t   thickness [m]      L   datum [m]
"""

import numpy as np
from scipy.fft import irfft, next_fast_len

from analytic.layers.aliases import alias_sum, rounded_up
from analytic.layers.kernel import hat_compliance
from analytic.layers.layered import LayeredBody, normal_compliance
from analytic.operators.convolution import Convolution, made_once
from analytic.operators.periodic import hat_aliases

_HALF_PLANE = 22.0  # k t from which a layer is a half-plane to rounding
_FORGOTTEN = 50.0  # distance over t from which a rigid base leaves nothing: no slower than e^-0.739


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
        column = free_coefficients(count, pitch, body, self.datum)
        super().__init__(column, self._symbol)

    @made_once
    def coarsened(self) -> "LayeredSurface":
        """The same body under elements twice as wide, centred on nodes 1, 3, 5, …"""
        return LayeredSurface(self.count // 2, 2.0 * self.pitch, self.body, self.datum)

    def _symbol(self, cycles: np.ndarray) -> np.ndarray:
        """Positive at every wave [m^2/Pa]."""
        if not self.body.rigid:  # the mean: any positive value
            cycles = np.where(cycles == 0.0, 0.5 * cycles[min(1, len(cycles) - 1)], cycles)
        return hat_symbol(cycles, self.pitch, self.body)


def hat_symbol(cycles: np.ndarray, pitch: float, body: LayeredBody) -> np.ndarray:
    """sum over j of h C(k + 2 pi j/h) sinc^4, k h/2 pi = `cycles` from 0 to 1/2 [m^2/Pa].

    cycles = 0 needs a rigid base.
    """
    beyond = aliases_of(pitch, body)
    total = pitch * alias_sum(lambda c: _normal(body, 2.0 * np.pi * c / pitch), cycles, beyond)
    scale = pitch**2 / (np.pi * body.material.plane_strain_modulus)
    return total + scale * hat_aliases(cycles, beyond)


def _normal(body: LayeredBody, k: np.ndarray) -> np.ndarray:
    """C(k) [m/Pa], any shape, from k t = _HALF_PLANE on that of a half-plane."""
    compliance = np.empty(k.shape)
    long = k * body.thickness < _HALF_PLANE
    compliance[long] = normal_compliance(body, k[long])
    compliance[~long] = 2.0 / (body.material.plane_strain_modulus * k[~long])
    return compliance


def aliases_of(pitch: float, body: LayeredBody) -> int:
    """An alias j > 0 from which on a hat's waves see a half-plane, whatever their cycles."""
    least = 0.5 + _HALF_PLANE * pitch / (2.0 * np.pi * body.thickness)
    return rounded_up(1 + int(np.ceil(least)))


def free_coefficients(count: int, pitch: float, body: LayeredBody, datum: float) -> np.ndarray:
    """Weighted displacement at distances 0 … count - 1 of a hat of unit pressure (n,) [m^2/Pa].

    On a rigid base the free line is a periodic one whose period is so long that the images are
    gone. Where the layer is too thick for that, and on a half-plane, the kernel is integrated.
    """
    ratio = pitch / body.thickness
    margin = int(np.ceil(_FORGOTTEN / ratio))
    if body.rigid and margin <= max(count, 2**15):
        length = next_fast_len(count + margin, real=True)
        symbol = hat_symbol(np.arange(length // 2 + 1) / length, pitch, body)
        return irfft(symbol, length)[:count]
    scale = pitch**2 / (2.0 * np.pi * body.material.shear_modulus)
    return scale * hat_compliance(count, ratio, body.contrast, float(np.log(datum / pitch)))


def _spread(body: LayeredBody) -> float:
    """Length to which a layer stiffer than its base spreads a load, as a plate does [m]."""
    return body.thickness * max(1.0, np.cbrt(body.contrast.softness))
