"""The tractions on the surface of a body, and the stresses there.

Nomenclature
    t, n               unit tangent towards +x and unit normal out of the body, (k, 2)
    s_tt, s_nn, s_nt   stress along the surface, across it, shear
"""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from scipy.interpolate import CubicSpline

from fem.body.elasticity import MeshedBody
from fem.body.surface import Direction, nodal_on, straight_down, tangent_of
from fem.stress.kinks import Kinks


@dataclass(frozen=True)
class SurfaceLoad:
    """Hat pressures on a body and the sliding traction that goes with them; or several of these,
    one a friction coefficient, which adds an axis (c,) to kinks and tractions."""

    body: MeshedBody
    hats: np.ndarray  # [m] nodes of the hats, as of `fem.compliance.operator`
    pressure: np.ndarray  # (count,) [Pa]
    friction: float | np.ndarray  # (c,); times the pressure is the sliding traction towards +x
    # of the pressure: its force (d_x, d_z) per length of x at x [m], (slope, 1) of a smooth roller
    direction: Direction = straight_down
    # (count,) [Pa] towards +x beside all of these
    traction: np.ndarray | None = field(default=None, kw_only=True)

    @cached_property
    def kinks(self) -> Kinks:
        """Points where the load's slope along the surface jumps."""
        bend, of_traction = self._bend(self._nodal), self._bend(self._nodal_traction)
        at = (bend != 0.0) | (of_traction != 0.0)
        x, bend = self.hats[at], bend[at]
        along = self.tangent(x) @ [1.0, 1j]
        # from a force per length of x, differentiated along x, to both by length of arc
        per_force = 1j * bend * along.real**2 / along
        jump = (self._force(x) @ [1.0, 1j]).T * per_force
        if self.traction is not None:
            per_force = 1j * of_traction[at] * along.real**2 / along
            jump = jump + self._along(x) @ [1.0, 1j] * per_force
        return Kinks(x + 1j * self.surface(x), along, jump.T)

    def _bend(self, nodal: np.ndarray) -> np.ndarray:
        """Jumps of the slope of nodal values at the hats' nodes."""
        slope = np.diff(nodal) / np.diff(self.hats)
        periodic = len(self.hats) == len(self.pressure) + 1
        before, after = (slope[-1], slope[0]) if periodic else (0.0, 0.0)
        return np.diff(slope, prepend=before, append=after)

    def tangent(self, x: np.ndarray) -> np.ndarray:
        """t (k, 2) at x (k,) [m]."""
        return tangent_on(self.surface, x)

    def across(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """s_nn and s_nt (k, …) [Pa] at x (k,) [m]."""
        t, force = self.tangent(x), self._force(x)
        t = t.reshape(len(x), *(1,) * (force.ndim - 2), 2)
        pressure = np.interp(x, self.hats, self._nodal).reshape(*t.shape[:-1], 1)
        load = pressure * t[..., :1] * force
        if self.traction is not None:
            further = np.interp(x, self.hats, self._nodal_traction)[:, None] * self._along(x)
            load = load + t[..., :1] * further.reshape(t.shape)
        return (load * normal(t)).sum(-1), (load * t).sum(-1)

    @cached_property
    def _nodal(self) -> np.ndarray:
        return nodal_on(self.hats, self.pressure)

    @cached_property
    def _nodal_traction(self) -> np.ndarray:
        none = self.traction is None
        return np.zeros(len(self.hats)) if none else nodal_on(self.hats, self.traction)

    def _along(self, x: np.ndarray) -> np.ndarray:
        """Force (k, 2) per length of x under unit traction."""
        return np.stack(tangent_of(self.direction)(x), axis=-1)

    @cached_property
    def surface(self) -> CubicSpline:
        """z [m] of the surface at x [m]: a smooth curve through its points."""
        top = self.body.top
        return CubicSpline(top.x, self.body.points[top.point, 1])

    def _force(self, x: np.ndarray) -> np.ndarray:
        """Force (k, …, 2) per length of x under unit pressure, its sliding traction included."""
        along = self._along(x)
        down = np.stack(self.direction(x), axis=-1)
        if np.ndim(self.friction):
            along, down = along[:, None], down[:, None]
        return down + np.multiply.outer(self.friction, [1.0, 1.0]) * along


def tangent_on(surface: CubicSpline, x: np.ndarray) -> np.ndarray:
    """t (k, 2) at x (k,) [m] of a surface z(x) [m]."""
    rise = surface(x, 1)
    return np.column_stack([np.ones_like(rise), rise]) / np.hypot(1.0, rise)[:, None]


def normal(t: np.ndarray) -> np.ndarray:
    """n (..., 2) to tangents t (..., 2)."""
    return np.stack([t[..., 1], -t[..., 0]], axis=-1)


def to_surface(t: np.ndarray, stress: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """s_tt, s_nn, s_nt (...) of sx, sz, txz (..., 3) at tangents t (..., 2)."""
    n = normal(t)

    def component(a: np.ndarray, b: np.ndarray) -> np.ndarray:
        mixed = a[..., 0] * b[..., 1] + a[..., 1] * b[..., 0]
        weights = np.stack([a[..., 0] * b[..., 0], a[..., 1] * b[..., 1], mixed], axis=-1)
        return (weights * stress).sum(-1)

    return component(t, t), component(n, n), component(t, n)


def from_surface(t: np.ndarray, s_tt: np.ndarray, s_nn: np.ndarray, s_nt: np.ndarray) -> np.ndarray:
    """sx, sz, txz (..., 3) of s_tt, s_nn, s_nt (...) at tangents t (..., 2)."""
    n = normal(t)

    def component(i: int, j: int) -> np.ndarray:
        mixed = t[..., i] * n[..., j] + n[..., i] * t[..., j]
        direct = s_tt * t[..., i] * t[..., j] + s_nn * n[..., i] * n[..., j]
        return direct + s_nt * mixed

    return np.stack([component(0, 0), component(1, 1), component(0, 1)], axis=-1)
