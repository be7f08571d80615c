"""References in a hundred decimal digits, where cancellation that ruins doubles is harmless.

Nothing here shares formulas with the code that is judged: line loads' potential (Johnson 1985,
sections 2.2 to 2.4), fourth differences of x^4 ln x, and Airy's function of a wave in a layer,
whose constants come from a linear system.

    f(z)  Airy's stress function is f(z) cos kx:  sz = -k^2 f,  txz = k f' sin kx,
          2G uz = ((1-nu) f''' - (2-nu) k^2 f')/k^2,  2G ux = ((1-nu) f'' + nu k^2 f)/k sin kx
"""

from mpmath import atan2, exp, log, lu_solve, mpf, pi, sqrt, workdps

from analytic.layers.layered import LayeredBody
from analytic.material import Material

hundred_digits = workdps(100)


@hundred_digits
def galerkin_log(offset: int) -> mpf:
    """int int (1-|s|)(1-|t|) ln|x + t - s| ds dt at a whole offset x >= 0."""
    total = mpf(0)
    for shift, weight in ((-2, 1), (-1, -4), (0, 6), (1, -4), (2, 1)):
        y = mpf(abs(offset + shift))
        if y:
            total += weight * y**4 * log(y)
    # the primitive x^4 ln x / 24 - 25 x^4 / 288, four times differenced
    return total / 24 - mpf(25) / 12


@hundred_digits
def hat_parts(x: float, z: float) -> tuple[float, float, float, float]:
    """sx, sz, txz under a unit hat of pressure and sx under one of traction; pitch 1, z > 0."""
    x, z = mpf(x), mpf(z)
    sz = logs = turn = stretch = mpf(0)
    for shift, weight in ((1, 1), (0, -2), (-1, 1)):
        y = x + shift
        half_log, angle = log(y * y + z * z) / 2, atan2(z, y)
        sz += weight * y * angle
        logs += weight * half_log
        turn += weight * angle
        stretch += weight * y * half_log
    parts = (sz + 2 * z * logs, sz, -z * turn, 3 * z * turn - 2 * stretch)
    return tuple(float(part / pi) for part in parts)


@hundred_digits
def hertz_parts(x: float, z: float) -> tuple[float, float, float, float]:
    """sx, sz, txz under sqrt(1-x^2) and sx under a traction like it; x, z in half-widths, z > 0.

    McEwen's m and n (Johnson 1985, eq. 4.49), and for the traction eq. 7.8.
    """
    x, z = mpf(x), mpf(z)
    even = 1 - x * x + z * z
    root = sqrt(even * even + 4 * x * x * z * z)
    m, n = sqrt((root + even) / 2), sqrt((root - even) / 2)
    n = -n if x < 0 else n
    square = m * m + n * n
    sx = -(m * (1 + (z * z + n * n) / square) - 2 * z)
    sz = -m * (1 - (z * z + n * n) / square)
    txz = -n * (m * m - z * z) / square
    traction = n * (2 - (z * z - m * m) / square) - 2 * x
    return tuple(float(part) for part in (sx, sz, txz, traction))


@hundred_digits
def wave_compliance(body: LayeredBody, wavenumber: float) -> float:
    """uz [m/Pa] of the surface under a wave of unit pressure, k [1/m] > 0."""
    k, t = mpf(wavenumber), mpf(body.thickness)
    falling, rising = (-1, 0), (1, k * t)  # e^-kz, and e^kz that ends as 1 at z = t
    waves = [(sign, power, shift) for sign, shift in (falling, rising) for power in (0, 1)]
    top = [_wave(sign, power, mpf(0), shift) for sign, power, shift in waves]
    below = [_wave(sign, power, k * t, shift) for sign, power, shift in waves]
    rows = [[f[0] for f in top], [f[1] for f in top]]
    if isinstance(body.base, Material):
        foot = [_wave(-1, power, mpf(0), 0) for power in (0, 1)]  # of a half-plane: e^-k(z-t)
        rows = [[*row, 0, 0] for row in rows]
        rows += [[f[j] for f in below] + [-f[j] for f in foot] for j in (0, 1)]
        for moved in (_along, _down):
            upper = [moved(body.material, f) for f in below]
            rows.append(upper + [-moved(body.base, f) for f in foot])
    else:
        bonded = body.base == "bonded"
        rows.append([_down(body.material, f) for f in below])
        rows.append([_along(body.material, f) if bonded else f[1] for f in below])
    amounts = lu_solve(rows, [1 / k**2] + [0] * (len(rows) - 1))
    return float(sum(a * _down(body.material, f) for a, f in zip(amounts, top, strict=False)) * k)


def _along(material: Material, f: tuple[mpf, ...]) -> mpf:
    """ux over k, by f and its derivatives in kz."""
    nu = mpf(material.poissons_ratio)
    return ((1 - nu) * f[2] + nu * f[0]) * (1 + nu) / mpf(material.youngs_modulus)


def _down(material: Material, f: tuple[mpf, ...]) -> mpf:
    """uz over k, by f and its derivatives in kz."""
    nu = mpf(material.poissons_ratio)
    return ((1 - nu) * f[3] - (2 - nu) * f[1]) * (1 + nu) / mpf(material.youngs_modulus)


def _wave(sign: int, power: int, place: mpf, shift: mpf) -> tuple[mpf, ...]:
    """y^power e^(sign y - shift) at y = `place`, and its first three derivatives."""
    value = exp(sign * place - shift)
    if power == 0:
        return tuple(value * sign**order for order in range(4))
    return tuple(value * (sign**order * place + order * sign ** (order + 1)) for order in range(4))
