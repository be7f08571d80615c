"""References in a hundred decimal digits, by the standard library's numbers.

Nothing here knows how the product computes the same: line loads' potential (Johnson 1985, sections
2.2 to 2.4), fourth differences of x^4 ln x, and Airy's function of a wave in a layer, whose
constants come from a linear system. With a hundred digits, cancellation that leaves doubles none is
harmless.

    f(z)  Airy's stress function is f(z) cos kx:  sz = -k^2 f,  txz = k f' sin kx,
          2G uz = ((1-nu) f''' - (2-nu) k^2 f')/k^2,  2G ux = ((1-nu) f'' + nu k^2 f)/k sin kx
"""

from decimal import Decimal, localcontext
from functools import cache

from analytic.layers.layered import LayeredBody
from analytic.material import Material

DIGITS = 100
ZERO, ONE, TWO = Decimal(0), Decimal(1), Decimal(2)


def galerkin_log(offset: int) -> Decimal:
    """int int (1-|s|)(1-|t|) ln|x + t - s| ds dt at a whole offset x >= 0."""
    with localcontext() as context:
        context.prec = DIGITS
        total = ZERO
        for shift, weight in ((-2, 1), (-1, -4), (0, 6), (1, -4), (2, 1)):
            y = Decimal(abs(offset + shift))
            if y:
                total += weight * y**4 * y.ln()
        # the primitive x^4 ln x / 24 - 25 x^4 / 288, four times differenced
        return +(total / 24 - Decimal(25) / 12)


def hat_parts(x: float, z: float) -> tuple[float, float, float, float]:
    """sx, sz, txz under a unit hat of pressure and sx under one of traction; pitch 1, z > 0."""
    with localcontext() as context:
        context.prec = DIGITS
        x, z = Decimal(x), Decimal(z)
        sz = logs = turn = stretch = ZERO
        for shift, weight in ((1, 1), (0, -2), (-1, 1)):
            y = x + shift
            log, angle = (y * y + z * z).ln() / 2, _angle(z, y)
            sz += weight * y * angle
            logs += weight * log
            turn += weight * angle
            stretch += weight * y * log
        sx = sz + 2 * z * logs
        return tuple(
            float(part / _pi()) for part in (sx, sz, -z * turn, 3 * z * turn - 2 * stretch)
        )


def hertz_parts(x: float, z: float) -> tuple[float, float, float, float]:
    """sx, sz, txz under sqrt(1-x^2) and sx under a traction like it; x, z in half-widths, z > 0.

    McEwen's m and n (Johnson 1985, eq. 4.49), and for the traction eq. 7.8.
    """
    with localcontext() as context:
        context.prec = DIGITS
        x, z = Decimal(x), Decimal(z)
        even = 1 - x * x + z * z
        root = (even * even + 4 * x * x * z * z).sqrt()
        m, n = ((root + even) / 2).sqrt(), ((root - even) / 2).sqrt()
        n = -n if x < 0 else n
        square = m * m + n * n
        sx = -(m * (1 + (z * z + n * n) / square) - 2 * z)
        sz = -m * (1 - (z * z + n * n) / square)
        txz = -n * (m * m - z * z) / square
        traction = n * (2 - (z * z - m * m) / square) - 2 * x
        return tuple(float(part) for part in (sx, sz, txz, traction))


def wave_sinking(body: LayeredBody, wavenumber: float) -> float:
    """uz [m/Pa] of the surface under a wave of unit pressure, k [1/m] > 0."""
    with localcontext() as context:
        context.prec = DIGITS
        k, t = Decimal(wavenumber), Decimal(body.thickness)
        layer = _Half(body.material)
        falling, rising = (-ONE, ZERO), (ONE, k * t)  # e^-kz, and e^kz that ends as 1 at z = t
        waves = [(s, power, fall) for s, fall in (falling, rising) for power in (0, 1)]
        top = [_wave(s, power, ZERO, fall) for s, power, fall in waves]
        below = [_wave(s, power, k * t, fall) for s, power, fall in waves]
        rows = [[f[0] for f in top], [f[1] for f in top]]
        right = [ONE / k**2, ZERO]
        foot = []  # of a half-plane below: e^-k(z-t)
        if isinstance(body.base, Material):
            foot = [_wave(-ONE, power, ZERO, ZERO) for power in (0, 1)]
            base = _Half(body.base)
            rows += [[f[j] for f in below] + [-f[j] for f in foot] for j in (0, 1)]
            for moved in (_Half.along, _Half.down):
                rows.append([moved(layer, f) for f in below] + [-moved(base, f) for f in foot])
        else:
            rows.append([layer.down(f) for f in below])
            bonded = body.base == "bonded"
            rows.append([layer.along(f) if bonded else f[1] for f in below])
        rows = [row + [ZERO] * (len(waves) + len(foot) - len(row)) for row in rows]
        amounts = _solved(rows, right + [ZERO] * (len(rows) - 2))
        return float(sum(a * layer.down(f) for a, f in zip(amounts, top, strict=False)) * k)


class _Half:
    """Displacements of a material by f and its derivatives in kz, over k."""

    def __init__(self, material: Material) -> None:
        self.nu = Decimal(material.poissons_ratio)
        self.twice = Decimal(material.youngs_modulus) / (1 + self.nu)

    def along(self, f: tuple[Decimal, ...]) -> Decimal:
        return ((1 - self.nu) * f[2] + self.nu * f[0]) / self.twice

    def down(self, f: tuple[Decimal, ...]) -> Decimal:
        return ((1 - self.nu) * f[3] - (2 - self.nu) * f[1]) / self.twice


def _wave(sign: Decimal, power: int, place: Decimal, shift: Decimal) -> tuple[Decimal, ...]:
    """y^power e^(sign y - shift) at y = `place`, and its first three derivatives."""
    value = (sign * place - shift).exp()
    if power == 0:
        return tuple(value * sign**order for order in range(4))
    return tuple(value * (sign**order * place + order * sign ** (order + 1)) for order in range(4))


def _solved(rows: list[list[Decimal]], right: list[Decimal]) -> list[Decimal]:
    """Gauss' elimination with the largest pivot of each column."""
    system = [[*row, value] for row, value in zip(rows, right, strict=True)]
    size = len(system)
    for i in range(size):
        pivot = max(range(i, size), key=lambda r: abs(system[r][i]))
        system[i], system[pivot] = system[pivot], system[i]
        for r in range(size):
            if r != i:
                factor = system[r][i] / system[i][i]
                system[r] = [a - factor * b for a, b in zip(system[r], system[i], strict=True)]
    return [system[i][size] / system[i][i] for i in range(size)]


def _angle(z: Decimal, y: Decimal) -> Decimal:
    """atan2(z, y) for z > 0."""
    if abs(y) < z:
        return _pi() / 2 - _arctangent(y / z)
    return _arctangent(z / y) + (_pi() if y < 0 else ZERO)


def _arctangent(ratio: Decimal) -> Decimal:
    """For |ratio| <= 1: halved angles, then the series."""
    halvings = 0
    while abs(ratio) > Decimal("0.01"):
        ratio = ratio / (1 + (1 + ratio * ratio).sqrt())
        halvings += 1
    total, power, order = ZERO, ratio, 1
    while power and abs(power) > abs(ratio) * Decimal(10) ** -(DIGITS + 2):
        total += power / order
        power, order = -power * ratio * ratio, order + 2
    return total * TWO**halvings


@cache
def _pi() -> Decimal:
    with localcontext() as context:
        context.prec = DIGITS + 5
        return 16 * _arctangent(ONE / 5) - 4 * _arctangent(ONE / 239)
