"""Compliance on a uniform grid that depends on the distance of two elements alone, by FFT.

On a line the matrix is Toeplitz and the FFT is padded with zeros to a circulant that contains it;
on a periodic line the matrix is the circulant.

    n    elements                           c    first column of the matrix [m^2/Pa]
    m    length of the circulant            S    symbol: transform of c over m [m^2/Pa]
"""

from collections.abc import Callable

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft

_KEPT = 31 * 2**20  # bytes; glibc's own limit is 32 MiB


class Convolution:
    """The matrix C_ij = column[i - j] for i >= j and row[j - i] above, applied in n log n.

    column    (n,) [m^2/Pa]; periodic: of the circulant
    symbol    positive S at given cycles per pitch (0 to 1/2) [m^2/Pa], for `precondition`;
              where it is infinite, at the mean, the inverse is zero
    row       (n,) [m^2/Pa], row[0] = column[0]; default the column: a symmetric matrix
    periodic  whether element n is element 0
    """

    def __init__(
        self,
        column: np.ndarray,
        symbol: Callable[[np.ndarray], np.ndarray],
        row: np.ndarray | None = None,
        periodic: bool = False,
    ) -> None:
        _keep_large_buffers()
        self.count = len(column)
        self.periodic = periodic
        self.applications = 0
        self._length = self.count if periodic else next_fast_len(2 * self.count, real=True)
        circulant = column if periodic else _embedded(column, row, self._length)
        self._transfer = rfft(circulant)
        if row is None:
            self._transfer = np.ascontiguousarray(self._transfer.real)
        cycles = np.arange(self._length // 2 + 1) / self._length
        self._inverse_symbol = 1.0 / symbol(cycles)

    def apply(self, pressure: np.ndarray) -> np.ndarray:
        """Weighted displacements (n,) [m^2] of nodal pressures (n,) [Pa]."""
        self.applications += 1
        return self._convolve(pressure, self._transfer)

    def precondition(self, displacement: np.ndarray) -> np.ndarray:
        """Approximate inverse of `apply`, positive definite: division by the symbol."""
        return self._convolve(displacement, self._inverse_symbol)

    def _convolve(self, values: np.ndarray, transfer: np.ndarray) -> np.ndarray:
        spectrum = rfft(values, self._length)
        spectrum *= transfer
        return irfft(spectrum, self._length)[: self.count]


def _embedded(column: np.ndarray, row: np.ndarray | None, length: int) -> np.ndarray:
    """Circulant of `length` >= 2n - 1 whose leading block is the Toeplitz matrix."""
    row = column if row is None else row
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
