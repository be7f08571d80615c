"""A small picture of a curve for the terminal: braille dots, or plain characters."""

import numpy as np

# Bits of a braille character's dots: rows from the top, columns from the left (Unicode, U+2800).
BRAILLE = np.array([[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]])
PLAIN = {(False, False): " ", (True, False): "'", (False, True): ".", (True, True): ":"}


def drawn(x: np.ndarray, y: np.ndarray, columns: int, rows: int, plain: bool = False) -> list[str]:
    """The curve through (x, y), x ascending, as `rows` lines of `columns` characters.

    In each column of dots it spans from its lowest to its highest value there, as a pen would.
    plain   ASCII: two dots one above the other a character, instead of braille's four by two
    """
    across, down = (1, 2) if plain else (2, 4)
    dots = _dots(x, y, columns * across, rows * down)
    blocks = dots.reshape(rows, down, columns, across).transpose(0, 2, 1, 3)
    if plain:
        return ["".join(PLAIN[tuple(block[:, 0])] for block in line) for line in blocks]
    codes = 0x2800 + np.sum(blocks * BRAILLE, axis=(2, 3))
    return ["".join(map(chr, line)) for line in codes]


def _dots(x: np.ndarray, y: np.ndarray, width: int, height: int) -> np.ndarray:
    """(height, width) of which dots the curve covers, the top row first."""
    ends = np.linspace(x[0], x[-1], width + 1)
    at_ends = np.interp(ends, x, y)
    column = np.clip(np.searchsorted(ends, x, side="right") - 1, 0, width - 1)
    low = np.minimum(at_ends[:-1], at_ends[1:])
    high = np.maximum(at_ends[:-1], at_ends[1:])
    np.minimum.at(low, column, y)
    np.maximum.at(high, column, y)
    bottom, top = float(y.min()), float(y.max())
    size = (top - bottom) or 1.0
    first = np.minimum(height * (low - bottom) / size, height - 1).astype(int)
    last = np.maximum(np.ceil(height * (high - bottom) / size).astype(int) - 1, first)
    level = np.arange(height)[::-1, None]
    return (level >= first) & (level <= last)
