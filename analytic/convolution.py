"""Compliance on a uniform grid that depends on the distance of two elements alone, by FFT.

On a line the matrix is Toeplitz and the FFT is padded with zeros to a circulant that contains it;
on a periodic line the matrix is the circulant.

    n    elements                           c    first column of the matrix [m^2/Pa]
    S    symbol: transform of c, at a number of cycles per pitch [m^2/Pa]
"""

from collections.abc import Callable

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft

_KEPT = 31 * 2**20  # bytes; glibc's own limit is 32 MiB
_MARGIN = 8  # a line is closed to a ring for the inverse by an eighth of its length


class Convolution:
    """The matrix C_ij = column[i - j] for i >= j and row[j - i] above, applied in n log n.

    column    (n,) [m^2/Pa]; periodic: of the circulant
    symbol    positive S at given cycles per pitch (0 to 1/2) [m^2/Pa], for `precondition`;
              where it is infinite, at the mean, the inverse is zero
    row       (n,) [m^2/Pa], row[0] = column[0]; default the column: a symmetric matrix
    periodic  whether element n is element 0
    ring      nodes of the closed line on which `precondition` works: n where periodic, else more
    """

    def __init__(
        self,
        column: np.ndarray,
        symbol: Callable[[np.ndarray], np.ndarray],
        row: np.ndarray | None = None,
        periodic: bool = False,
    ) -> None:
        _keep_large_buffers()
        self.column, self.row = column, column if row is None else row
        self.count = len(column)
        self.periodic = periodic
        self.applications = 0
        self._length = self.count if periodic else next_fast_len(2 * self.count, real=True)
        circulant = column if periodic else _embedded(column, self.row, self._length)
        self._transfer = rfft(circulant)
        if row is None:
            self._transfer = np.ascontiguousarray(self._transfer.real)
        reach = self.count + self.count // _MARGIN
        self.ring = self.count if periodic else next_fast_len(reach + 1, real=True)
        self._inverse_symbol = 1.0 / symbol(np.arange(self.ring // 2 + 1) / self.ring)

    def apply(self, pressure: np.ndarray) -> np.ndarray:
        """Weighted displacements (n,) [m^2] of nodal pressures (n,) [Pa]."""
        self.applications += 1
        spectrum = rfft(pressure, self._length)
        spectrum *= self._transfer
        return irfft(spectrum, self._length)[: self.count]

    def precondition(self, displacement: np.ndarray) -> np.ndarray:
        """Approximate inverse of `apply`, positive definite: division by the symbol.

        Of displacements on the ring, or on as many of its nodes as are given.
        """
        spectrum = rfft(displacement, self.ring)
        spectrum *= self._inverse_symbol
        return irfft(spectrum, self.ring)[: len(displacement)]

    def block(self, nodes: np.ndarray) -> np.ndarray:
        """The matrix's rows and columns of these nodes (m,), as an array (m, m) [m^2/Pa]."""
        distance = nodes[:, None] - nodes
        if self.periodic:
            return self.column[distance % self.count]
        if self.row is self.column:
            return self.column[np.abs(distance)]
        return np.where(distance >= 0, self.column[distance], self.row[-distance])


def _embedded(column: np.ndarray, row: np.ndarray, length: int) -> np.ndarray:
    """Circulant of `length` >= 2n - 1 whose leading block is the Toeplitz matrix."""
    circulant = np.zeros(length)
    circulant[: len(column)] = column
    circulant[length - len(column) + 1 :] = row[:0:-1]
    return circulant


def _keep_large_buffers() -> None:
    """Let freed arrays up to 32 MiB stay with the process: a pair of FFTs then costs half.

    glibc maps fresh pages for every array above a threshold and gives them back when it is
    freed. The threshold rises to the size of the largest block ever freed.
    """
    np.empty(_KEPT, dtype=np.uint8)
