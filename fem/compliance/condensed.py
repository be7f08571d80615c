"""The compliance of bodies condensed onto the hats: exact and dense, or of shifted columns.

Nomenclature: C compliance [m^2/Pa] of hat pressures p [Pa]."""

from collections.abc import Callable

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft

ROOM = 64  # columns by which the space for them grows
SAMPLES = 12  # columns that the shifted one is the mean of
LEAST_SYMBOL = 1e-9  # of the largest one: a compliance may be singular


class Condensed:
    """C (count, count) [m^2/Pa] of which only the columns of hats under pressure are formed, when
    they are first asked for: a back-substitution each, of less than half of a rough trace's hats.

    columns  gives those (count, k) of hats (k,)"""

    def __init__(self, columns: Callable[[np.ndarray], np.ndarray], count: int) -> None:
        self._form, self._known = columns, np.zeros((count, 0), order="F")
        self._place, self._hats = np.full(count, -1), np.zeros(0, dtype=int)

    def of(self, hats: np.ndarray) -> np.ndarray:
        """Columns (count, k) of hats (k,)."""
        self._have(hats)
        return self._known[:, self._place[hats]]

    def _have(self, hats: np.ndarray) -> None:
        new = hats[self._place[hats] < 0]
        if len(new) == 0:
            return
        start, stop = len(self._hats), len(self._hats) + len(new)
        if stop > self._known.shape[1]:
            more = np.empty((len(self._place), stop + ROOM), order="F")
            more[:, :start] = self._known[:, :start]
            self._known = more
        self._known[:, start:stop] = self._form(new)
        self._place[new] = np.arange(start, stop)
        self._hats = np.append(self._hats, new)

    def __matmul__(self, pressure: np.ndarray) -> np.ndarray:
        """C p (count,) [m^2]."""
        self._have(np.flatnonzero(pressure))
        return self._known[:, : len(self._hats)] @ pressure[self._hats]

    def __getitem__(self, block: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
        """The block of `numpy.ix_` of rows and columns."""
        rows, hats = block
        self._have(hats.ravel())
        return self._known[rows, self._place[hats]]


class ShiftInvariant:
    """C [m^2/Pa] near that of `Condensed`: a column is that of any other hat, shifted, the mean of
    a few. It costs no back-substitution a hat, and no memory. Between hats on elements of one size
    it is right within a per cent.

    columns  as of `Condensed`
    hats     (k,) some on the refined surface"""

    def __init__(
        self, columns: Callable[[np.ndarray], np.ndarray], count: int, hats: np.ndarray
    ) -> None:
        some = np.unique(np.linspace(0, len(hats) - 1, SAMPLES).round().astype(int))
        self._count, self._kernel = count, np.zeros(2 * count - 1)  # by the distance in hats
        missing = np.ones(2 * count - 1, dtype=bool)
        for sampled in hats[some], np.array([0, count - 1]):  # from the ends what is farther off
            total, times = np.zeros(2 * count - 1), np.zeros(2 * count - 1)
            for hat, column in zip(sampled, columns(sampled).T, strict=True):
                there = slice(count - 1 - hat, 2 * count - 1 - hat)
                total[there] += column
                times[there] += 1.0
            new = missing & (times > 0.0)
            self._kernel[new], missing = total[new] / times[new], missing & ~new
        self._size = next_fast_len(2 * count - 1, real=True)
        wrapped = np.zeros(self._size)
        wrapped[np.arange(1 - count, count)] = self._kernel
        self._symbol = rfft(wrapped)
        # the kernel's even part, continued on the ring: a jump would show at every wave number
        away = np.arange(self._size)
        away = np.minimum(np.minimum(away, self._size - away), count - 1)
        ring = self._kernel[count - 1 + away] + self._kernel[count - 1 - away]
        symbol = np.abs(rfft(0.5 * ring))
        self._inverse = 1.0 / np.maximum(symbol, LEAST_SYMBOL * symbol.max())

    def __matmul__(self, pressure: np.ndarray) -> np.ndarray:
        """C p (count,) [m^2]."""
        return irfft(self._symbol * rfft(pressure, self._size), self._size)[: self._count]

    def inverse(self, moved: np.ndarray, hats: np.ndarray) -> np.ndarray:
        """Pressures (k,) under which hats (k,) are moved by about (k,) [m^2], and others little."""
        line = np.zeros(self._count)
        line[hats] = moved
        return irfft(self._inverse * rfft(line, self._size), self._size)[hats]

    def __getitem__(self, block: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
        """The block of `numpy.ix_` of rows and columns."""
        rows, hats = block
        return self._kernel[rows - hats + self._count - 1]
