"""Laws of elasticity at finite strains, in plane strain; all are Hooke's for small ones.

    neo-hookean          W = mu/2 (tr C - 2) - mu ln J + lambda/2 (ln J)^2
    hencky               W = mu tr (ln U)^2 + lambda/2 (ln J)^2
    st-venant-kirchhoff  W = mu tr E^2 + lambda/2 (tr E)^2
    murnaghan            W = (lambda + 2 mu)/2 I1^2 - 2 mu I2
                             + (l + 2m)/3 I1^3 - 2m I1 I2 + n I3

with F = I + grad u, C = F'F, U = C^(1/2), J = det F, E = (C - I)/2 and its invariants I1, I2, I3;
in plane strain I3 = 0, but n I2 is stress across the plane. Sources: Bonet and Wood, Nonlinear
Continuum Mechanics for Finite Element Analysis, 2nd ed., eq. 6.27; Hencky, Z. techn. Phys. 9
(1928) 215; Murnaghan, Am. J. Math. 59 (1937) 235. Constants l, m, n of rail steel were measured by
Egle and Bray, J. Acoust. Soc. Am. 60 (1976) 741.

Hencky's tr (ln U)^2 = (ln J)^2 / 2 + artanh^2(sqrt y) / 2, y = 1 - J^2/t^2, t = tr C / 2, has no
singular derivative at equal stretches, where y = 0, as a series in y."""

from functools import reduce
from typing import TYPE_CHECKING

import numpy as np

from analytic.material import Law

if TYPE_CHECKING:
    from ufl.core.expr import Expr

SERIES_TO = 0.01  # y up to which Hencky's functions are summed as series, to 1e-13 there
# artanh^2(sqrt y) / y and artanh(sqrt y) / sqrt y in powers of y
SQUARE = (1.0, 2.0 / 3.0, 23.0 / 45.0, 44.0 / 105.0, 563.0 / 1575.0, 3254.0 / 10395.0)
ROOT = tuple(1.0 / (2 * k + 1) for k in range(6))


def energy(law: Law, gradient: "Expr", mu: "Expr", lame: "Expr", unit: float) -> "Expr":
    """W as an UFL expression of the displacement's `gradient`, in a `unit` [Pa], in which are
    Lame's constants mu and lambda too."""
    import ufl

    deformed = ufl.Identity(2) + gradient
    volume, right = ufl.det(deformed), deformed.T * deformed
    if law.name in ("st-venant-kirchhoff", "murnaghan"):
        strain = 0.5 * (gradient + gradient.T + gradient.T * gradient)
        first, second = ufl.tr(strain), ufl.det(strain)
        ell, m, _ = (constant / unit for constant in law.murnaghan or (0.0, 0.0, 0.0))
        quadratic = (0.5 * lame + mu) * first**2 - 2.0 * mu * second
        return quadratic + (ell + 2.0 * m) / 3.0 * first**3 - 2.0 * m * first * second
    log = ufl.ln(volume)
    if law.name == "neo-hookean":
        return 0.5 * mu * (ufl.tr(right) - 2.0) - mu * log + 0.5 * lame * log**2
    # t - J without cancellation
    apart = 0.5 * ((gradient[0, 0] - gradient[1, 1]) ** 2 + (gradient[0, 1] + gradient[1, 0]) ** 2)
    half = apart + volume
    y = apart * (half + volume) / half**2
    root = ufl.sqrt(ufl.max_value(y, SERIES_TO))
    far = (0.5 * ufl.ln((1.0 + root) / (1.0 - root))) ** 2
    square = ufl.conditional(ufl.lt(y, SERIES_TO), y * _sum(SQUARE, y), far)
    return 0.5 * (mu + lame) * log**2 + 0.5 * mu * square


def cauchy_stress(
    gradient: np.ndarray, mu: np.ndarray, lame: np.ndarray, law: Law | None = None
) -> np.ndarray:
    """sx, sz, txz and, across the plane, sy (..., 4) [Pa] of displacement gradients (..., 2, 2),
    d u_i / d X_j, for Lame's constants mu and lambda (...) [Pa]."""
    law = Law() if law is None else law
    f = np.eye(2) + gradient
    volume = _determinant(f)
    left = f @ np.swapaxes(f, -1, -2)
    eye = np.eye(2)
    if law.name == "neo-hookean":
        across = lame * np.log(volume)
        stress = _times(mu, left) + _times(across - mu, eye)
    elif law.name == "hencky":
        log, half = np.log(volume), 0.5 * np.trace(left, axis1=-2, axis2=-1)
        apart = (gradient[..., 0, 0] - gradient[..., 1, 1]) ** 2
        apart = 0.5 * (apart + (gradient[..., 0, 1] + gradient[..., 1, 0]) ** 2)
        y = apart * (half + volume) / half**2
        root = np.sqrt(np.maximum(y, SERIES_TO))
        factor = np.where(y < SERIES_TO, _sum(ROOT, y), np.arctanh(root) / root)
        across = lame * log
        stress = _times(mu * factor / half, left - _times(half, eye))
        stress = stress + _times(mu * log + across, eye)
    else:
        ell, m, n = law.murnaghan or (0.0, 0.0, 0.0)
        strain = 0.5 * (np.swapaxes(f, -1, -2) @ f - eye)
        first, second = np.trace(strain, axis1=-2, axis2=-1), _determinant(strain)
        shear = 2.0 * (mu + m * first)
        mean = (lame + 2.0 * mu) * first + (ell + 2.0 * m) * first**2 - 2.0 * m * second
        mean = mean - shear * first
        piola = _times(shear, strain) + _times(mean, eye)  # Piola and Kirchhoff's second
        stress, across = f @ piola @ np.swapaxes(f, -1, -2), mean + n * second
    parts = [stress[..., 0, 0], stress[..., 1, 1], stress[..., 0, 1], across]
    return np.stack(parts, axis=-1) / volume[..., None]


def _determinant(tensor: np.ndarray) -> np.ndarray:
    return tensor[..., 0, 0] * tensor[..., 1, 1] - tensor[..., 0, 1] * tensor[..., 1, 0]


def _times(scalar: np.ndarray, tensor: np.ndarray) -> np.ndarray:
    return np.asarray(scalar)[..., None, None] * tensor


def _sum(coefficients: tuple[float, ...], y: object):
    """The polynomial in y."""
    return reduce(lambda total, coefficient: coefficient + y * total, reversed(coefficients))
