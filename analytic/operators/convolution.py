"""Compliance on a uniform grid that depends on the distance of two elements alone, by FFT.

On a line the matrix is Toeplitz and the FFT is padded with zeros to a circulant that contains it;
on a periodic line the matrix is the circulant.

    n    elements                           c    first column of the matrix [m^2/Pa]
    S    symbol: transform of c, at a number of cycles per pitch [m^2/Pa]"""

from collections.abc import Callable
from functools import cached_property
from typing import Self

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft
from scipy.linalg import solve_toeplitz
from scipy.linalg.lapack import dposv

_BUFFER = 31 * 2**20  # bytes; glibc's own limit is 32 MiB
DIRECT = 160  # nodes from which iterating is faster than a Cholesky factor
LEVINSON, DIRECT_IN_A_ROW = 64, 256  # nodes in a row between which Levinson's recursion is fastest
CROPS, CROPPED_FROM = 8, 4096  # lengths of stretches, and nodes from which they pay
_MARGIN = 8  # a line is closed to a ring for the inverse by an eighth of its length


class Convolution:
    """The matrix C_ij = column[i - j] for i >= j and row[j - i] above, applied in n log n.

    column    (n,) [m^2/Pa]; periodic: of the circulant
    symbol    positive S at given cycles per pitch (0 to 1/2) [m^2/Pa], for `precondition`;
              where it is infinite, at the mean, the inverse is zero; of a periodic line it is
              known and need not be given
    row       (n,) [m^2/Pa], row[0] = column[0]; default the column: a symmetric matrix
    periodic  whether element n is element 0
    ring      nodes of the closed line on which `precondition` works: n where periodic, else more
    inverse_symbol  (ring // 2 + 1,) 1/S [Pa/m^2]"""

    skew = False  # as of `analytic.operators.half_plane.ModelOperator`

    def __init__(
        self,
        column: np.ndarray,
        symbol: Callable[[np.ndarray], np.ndarray] | None,
        row: np.ndarray | None = None,
        periodic: bool = False,
    ) -> None:
        # Freed arrays up to 32 MiB then stay with the process, and a pair of FFTs costs half: glibc
        # raises the threshold of what it gives back to the size of the largest block ever freed.
        np.empty(_BUFFER, dtype=np.uint8)
        self.column, self.row = column, column if row is None else row
        self.symmetric = row is None
        self.symbol, self._shorter = symbol, {}
        self.count = len(column)
        self.periodic = periodic
        self._length = self.count if periodic else next_fast_len(2 * self.count, real=True)
        circulant = column
        if not periodic:
            circulant = np.zeros(self._length)
            circulant[: self.count] = column
            circulant[self._length - self.count + 1 :] = self.row[:0:-1]
        self._transfer = rfft(circulant)
        if row is None:
            self._transfer = np.ascontiguousarray(self._transfer.real)

    @cached_property
    def ring(self) -> int:
        reach = self.count + self.count // _MARGIN
        return self.count if self.periodic else next_fast_len(reach + 1, real=True)

    @cached_property
    def inverse_symbol(self) -> np.ndarray:
        if self.symbol is None:
            return 1.0 / self._transfer.real
        return 1.0 / self.symbol(np.arange(self.ring // 2 + 1) / self.ring)

    @cached_property
    def coarser(self) -> Self | None:
        """Operator on elements twice as wide, centred on nodes 1, 3, 5, …; `arguments` are those of
        its constructor beside the number of elements and their `pitch`."""
        return type(self)(self.count // 2, 2.0 * self.pitch, *self.arguments)

    def apply(self, pressure: np.ndarray) -> np.ndarray:
        """Weighted displacements (n,) [m^2] of nodal pressures (n,) [Pa]."""
        spectrum = rfft(pressure, self._length)
        spectrum *= self._transfer
        return irfft(spectrum, self._length)[: self.count]

    def precondition(self, weighted_displacement: np.ndarray) -> np.ndarray:
        """Approximate inverse of `apply`, positive definite: division by the symbol. Of
        displacements on the ring, or on as many of its nodes as are given."""
        spectrum = rfft(weighted_displacement, self.ring)
        spectrum *= self.inverse_symbol
        return irfft(spectrum, self.ring)[: len(weighted_displacement)]

    def solve(self, nodes: np.ndarray, right: np.ndarray) -> np.ndarray | None:
        """Pressures (m, k) of these nodes alone under which they sink by `right` (m, k). None where
        there are so many that iterating is faster."""
        count = len(nodes)
        if LEVINSON <= count <= DIRECT_IN_A_ROW and self.symmetric:
            start = self._start_of_row(nodes)
            if start is not None:
                in_a_row = np.concatenate((right[start:], right[:start]))
                solution = solve_toeplitz(self.column[:count], in_a_row, check_finite=False)
                return np.concatenate((solution[count - start :], solution[: count - start]))
        if count > DIRECT:
            return None
        return cholesky_solve(self.block(nodes), right)

    def cropped(self, span: int) -> "Convolution | None":
        """Operator on a shorter stretch of the line with `span` nodes; cached. None where that
        would not be much shorter, and on a periodic line."""
        length = -(-CROPS * span // self.count) * self.count // CROPS
        length = max(length, span)
        if self.periodic or self.count < CROPPED_FROM or length > 0.75 * self.count:
            return None
        if length not in self._shorter:
            row = None if self.symmetric else self.row[:length]
            self._shorter[length] = Convolution(self.column[:length], self.symbol, row)
        return self._shorter[length]

    def _start_of_row(self, nodes: np.ndarray) -> int | None:
        """Which of the nodes starts the row without a gap that they form, None if they do not."""
        breaks = np.flatnonzero(np.diff(nodes) > 1)
        if len(breaks) == 0:
            return 0
        closed = self.periodic and nodes[0] == 0 and nodes[-1] == self.count - 1
        return breaks[0] + 1 if closed and len(breaks) == 1 else None

    def block(self, nodes: np.ndarray) -> np.ndarray:
        """The matrix's rows and columns of these nodes (m,), as an array (m, m) [m^2/Pa]."""
        distance = nodes[:, None] - nodes
        if self.periodic:
            return self.column[distance % self.count]
        if self.symmetric:
            return self.column[np.abs(distance)]
        return np.where(distance >= 0, self.column[distance], self.row[-distance])


def cholesky_solve(matrix: np.ndarray, right: np.ndarray) -> np.ndarray | None:
    """Solution (m, k), or None where the symmetric matrix is not positive definite. Straight from
    LAPACK: around small matrices checks take longer than the work."""
    _, solution, failed = dposv(matrix, right, overwrite_a=True)
    return None if failed else solution
