"""An answer from outside as data: in the project's axes and signs, in SI units."""

from dataclasses import dataclass

import numpy as np

from analytic.numerics import runs_of
from comparisons.models.level import StressResult

TOUCHING = 0.02  # of the largest pressure: what stresses of a mesh leave beside a contact is less


@dataclass(frozen=True)
class Answer:
    """One solution from outside, of one file."""

    file: str  # that it was read from
    sha256: str
    x: np.ndarray  # (n,) [m] along the surface, ascending
    pressure: np.ndarray  # (n,) [Pa] as given: also where it is negative
    # at the nodes of a mesh in the window, depths from its own surface, and on the window, nan
    # outside the mesh; None: pressures alone
    stress: StressResult | None = None
    depth_spacing: float = 0.0  # [m] in depth, of the nodes next to the largest tau1
    of_mesh: bool = False  # the pressures are stresses on the surface of a mesh
    shear: np.ndarray | None = None  # (n,) [Pa] traction towards +x; None: not given
    columns: str = ""  # names of those of a table, with the units that they name

    @property
    def load(self) -> float:
        """[N/m] that the pressures carry; of a mesh those in contact, for far from it the stresses
        on coarse elements are small but add up."""
        carried = np.where(self.touching, self.pressure, 0.0) if self.of_mesh else self.pressure
        return float(0.5 * (carried[1:] + carried[:-1]) @ np.diff(self.x))

    @property
    def touching(self) -> np.ndarray:
        """(n,) whether a point is in contact."""
        least = TOUCHING if self.of_mesh or self.stress is not None else 0.0
        return self.pressure > least * max(0.0, float(self.pressure.max()))

    @property
    def spacing(self) -> float:
        """[m] from point to point in contact, median."""
        steps = np.diff(self.x)
        inside = self.touching[1:] & self.touching[:-1]
        return float(np.median(steps[inside] if inside.any() else steps))

    def on(self, x: np.ndarray) -> np.ndarray:
        """Pressures [Pa] at x [m], zero where nothing touches."""
        pressure = np.where(self.touching, self.pressure, 0.0)
        return np.interp(x, self.x, pressure, left=0.0, right=0.0)

    @property
    def patches(self) -> np.ndarray:
        """Contact patches (k, 2) [m]: an edge where the line through the squares of the last two
        pressures vanishes, as at a smooth edge the square root does, and before the next point."""
        first, after = runs_of(self.touching)
        return np.stack([self._edges(first, -1), self._edges(after - 1, 1)], axis=1)

    def _edges(self, last: np.ndarray, way: int) -> np.ndarray:
        """x (k,) [m] of the edges that lie one `way` from the last points in contact."""
        x, squares = self.x, self.pressure**2
        beyond, inner = (np.clip(last + step, 0, len(x) - 1) for step in (way, -way))
        rise = squares[inner] - squares[last]
        step = (x[last] - x[inner]) / np.where(rise > 0.0, rise, np.inf)
        edge = np.where(rise > 0.0, x[last] + squares[last] * step, 0.5 * (x[last] + x[beyond]))
        return np.clip(edge, *np.sort([x[last], x[beyond]], axis=0))
