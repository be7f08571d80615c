"""Logarithmic strain in the plane, and stresses and tangents from its space to Green's.

    E = 1/2 ln C,   S = T : 2 dE/dC,   dS = (2 dE/dC)' D (2 dE/dC) + T : 4 d2E/dC2

for a stress T(E) conjugate to E with the tangent D (Miehe, Apel and Lambrecht 2002, Comput. Methods
Appl. Mech. Eng. 191, 3383-3425). In the plane all is closed in q = (t, d, c), where

    C = [[t + d, c], [c, t - d]],   E = 1/2 ln J I + h [[d, c], [c, -d]],   r = d^2 + c^2,
    J^2 = t^2 - r,                  h = artanh(sqrt(r) / t) / (2 sqrt r),

and each derivative of h by r follows from the one before. Where the stretches are nearly equal, y =
r / t^2 small, h and they are power series in y.

Nomenclature: H displacement gradient, F = I + H, C = F'F, J = det F, S Piola and Kirchhoff's second
stress [Pa], Green's strain (C - I)/2 as (xx, zz, 2 xz)."""

from copy import copy

import numpy as np

from fem.nonlinear.laws import SERIES_TO
from fem.solver.mumps import FemError

TERMS = np.arange(8)  # of the series, to 1e-16 at SERIES_TO
FIRST = 1.0 / (2 * TERMS + 1)  # of 2 t h
SECOND = (TERMS + 1) / (2 * TERMS + 3)  # of 2 t^3 dh/dr
THIRD = (TERMS + 2) * (TERMS + 1) / (2 * TERMS + 5)  # of 2 t^5 d2h/dr2
# dq / d(Exx, Ezz, 2 Exz) of Green's strain
FROM_GREEN = np.array([[1.0, 1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 0.0, 1.0]])


class LogStrain:
    """E of displacement gradients H (k, 2, 2), H_ij = du_i/dX_j. FemError where J is not positive.

    deformed   F (k, 2, 2)
    volume     J (k,)
    strain     (k, 3) Exx, Ezz, 2 Exz"""

    def __init__(self, gradient: np.ndarray) -> None:
        (a, b), (c, e) = np.moveaxis(gradient, 0, -1)
        rise = a + e + a * e - b * c
        if not np.all(rise > -1.0):
            raise FemError("an element is inverted")
        self.deformed, self.volume = np.eye(2) + gradient, 1.0 + rise
        xx, zz = a + 0.5 * (a**2 + c**2), e + 0.5 * (b**2 + e**2)
        self._t, self._d, self._c = 1.0 + xx + zz, xx - zz, b + c + a * b + c * e
        self._r = self._d**2 + self._c**2
        self._h = self._derivatives_of_h()
        half, h = 0.5 * np.log1p(rise), self._h[0]
        self.strain = np.column_stack([half + h * self._d, half - h * self._d, 2.0 * h * self._c])

    def at(self, some: np.ndarray) -> "LogStrain":
        """Strain of some of the k."""
        part = copy(self)
        vars(part).update((name, of[some]) for name, of in vars(self).items() if name != "_h")
        part._h = tuple(array[some] for array in self._h)
        return part

    def _derivatives_of_h(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """h, dh/dr and d2h/dr2 at fixed t."""
        t, square = self._t, self.volume**2
        y = self._r / t**2
        near = y < SERIES_TO
        r = np.where(near, 1.0, self._r)
        root = np.sqrt(r)
        h = np.arctanh(np.where(near, 0.0, root / t)) / (2.0 * root)
        first = (0.5 * t / square - h) / (2.0 * r)
        second = (0.5 * t / square**2 - 3.0 * first) / (2.0 * r)
        series = zip((FIRST, SECOND, THIRD), (h, first, second), (1, 3, 5), strict=True)
        return tuple(
            np.where(near, np.polynomial.polynomial.polyval(y, some) / (2.0 * t**power), far)
            for some, far, power in series
        )

    def _slopes(self) -> np.ndarray:
        """dE/dq (k, 3, 3), rows Exx, Ezz, 2 Exz."""
        t, d, c, square = self._t, self._d, self._c, self.volume**2
        h, first, _ = self._h
        of_half = np.stack([0.5 * t, -0.5 * d, -0.5 * c], axis=-1) / square[:, None]
        of_h = np.stack([-0.5 / square, 2.0 * d * first, 2.0 * c * first], axis=-1)
        along, across = d[:, None] * of_h, 2.0 * c[:, None] * of_h
        along[:, 1] += h
        across[:, 2] += 2.0 * h
        return np.stack([of_half + along, of_half - along, across], axis=1)

    def piola(self, stress: np.ndarray) -> np.ndarray:
        """S (k, 3) xx, zz, xz of T (k, 3)."""
        return (stress[:, None] @ self._slopes())[:, 0] @ FROM_GREEN

    def tangent(self, stress: np.ndarray, tangent: np.ndarray) -> np.ndarray:
        """dS (k, 3, 3) [Pa] by Green's xx, zz, 2 xz, of T (k, 3) and D (k, 3, 3) or (3, 3)."""
        t, d, c, square = self._t, self._d, self._c, self.volume**2
        _, first, second = self._h
        slopes = self._slopes()
        total = slopes.transpose(0, 2, 1) @ (tangent @ slopes)
        mean, apart, shear = stress[:, 0] + stress[:, 1], stress[:, 0] - stress[:, 1], stress[:, 2]
        amount = apart * d + 2.0 * shear * c
        along = np.stack([np.zeros_like(d), apart, 2.0 * shear], axis=-1)
        of_h = np.stack([-0.5 / square, 2.0 * d * first, 2.0 * c * first], axis=-1)
        turned = along[:, :, None] * of_h[:, None]
        total += turned + turned.transpose(0, 2, 1)
        # second derivatives by t; t and r; r; and the first by r: of 1/2 ln J and of h
        by_tt = -0.5 * mean * (t**2 + self._r) / square**2 + amount * t / square**2
        by_tr = 0.5 * mean * t / square**2 - 0.5 * amount / square**2
        by_rr = -0.25 * mean / square**2 + amount * second
        by_r = -0.25 * mean / square + amount * first
        total[:, 0, 0] += by_tt
        for i, one in ((1, d), (2, c)):
            total[:, 0, i] += 2.0 * one * by_tr
            total[:, i, 0] += 2.0 * one * by_tr
            total[:, i, i] += 2.0 * by_r
            for j, other in ((1, d), (2, c)):
                total[:, i, j] += 4.0 * one * other * by_rr
        return FROM_GREEN.T @ total @ FROM_GREEN
