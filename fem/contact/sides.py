"""Which hats touch, which are open, which are at the hardness: how that changes between steps.

A hat that breaks its sign condition changes sides: an open one that overlaps and a crushed one
that opens are freed, a free one goes to the bound that its pressure is beyond. All at once is
quickest and may cycle with a hardness. When the number of broken conditions has not fallen for
PATIENCE exchanges, only the worst of them go, half as many each time that this happens again.
"""

import numpy as np

OPEN, FREE, FULL = -1, 0, 1
PATIENCE = 3


class Exchanges:
    """The sides (count,) of the hats, each OPEN, FREE or FULL, and how exchanges went so far.

    pressure   guessed (count,) [Pa]: hats are open where it is zero, else free
    hardness   H [Pa]
    load       P [N/m] if it is prescribed: some hat must be free then
    weights    w (count,) [m]
    """

    def __init__(
        self, pressure: np.ndarray, hardness: float, load: float | None, weights: np.ndarray
    ) -> None:
        self.sides = np.where(pressure > 0.0, FREE, OPEN)
        self.hardness, self.load, self.weights = hardness, load, weights
        self._fewest, self._patience, self._share = len(pressure) + 1, PATIENCE, 1.0

    def exchange(self, pressure: np.ndarray, gap: np.ndarray, stiff: float) -> None:
        """Change the sides after a step that led to a pressure (count,) [Pa] and a mean gap [m].

        `stiff` [Pa/m] makes pressures and gaps comparable where the worst are looked for.
        """
        joins = (self.sides == OPEN) & (gap < 0.0)
        leaves = (self.sides == FULL) & (gap > 0.0)
        lifts = (self.sides == FREE) & (pressure < 0.0)
        yields = (self.sides == FREE) & (pressure > self.hardness)
        broken = joins | leaves | lifts | yields
        count = np.count_nonzero(broken)
        if count < self._fewest:
            self._fewest, self._patience = count, PATIENCE
        else:
            self._patience -= 1
            if self._patience == 0:
                self._share, self._patience = 0.5 * self._share, PATIENCE
        if self._share < 1.0 and count:
            off = np.where(joins | leaves, stiff * np.abs(gap), 0.0)
            off[lifts] = -pressure[lifts]
            off[yields] = pressure[yields] - self.hardness
            some = max(1, int(self._share * count))
            broken &= off >= np.sort(off)[-some]
        self.sides = self.sides.copy()
        self.sides[broken & (joins | leaves)] = FREE
        self.sides[broken & lifts] = OPEN
        self.sides[broken & yields] = FULL

    def free_some(self, gap: np.ndarray) -> None:
        """Free hats where none is and a load is prescribed: the approach would be open."""
        if self.load is None or (self.sides == FREE).any():
            return
        full = self.sides == FULL
        self.sides = self.sides.copy()
        if not full.any():
            self.sides[np.argmin(gap)] = FREE
        elif self.hardness * self.weights[full].sum() >= self.load:
            self.sides[full] = FREE
        else:
            self.sides[~full] = FREE
