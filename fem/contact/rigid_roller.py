"""Contact of a rigid roller with the deformed surface, at its current position and normal.

    g_i = integral phi_i (z + s(x)) dX,   (x, z) = (X + u_x, Z + u_z)
    T p = integral N p ((s', 1) + friction (1, -s')) dX

The roller's normal at the current x of a surface point is (s', 1) up to its length, so that the
force is the gap's derivative. p is the pressure's vertical force per undeformed length of x, and
p / (dx/dX) the pressure on the deformed surface. With friction's part the load is the integral of
(1 - friction s') p dX.

Nomenclature: X, Z point of the undeformed body [m], u displacement [m], s(x) rise of the roller
above its lowest point [m], at x = 0, p hat pressures [Pa], phi_i hats, N shape functions."""

from collections.abc import Callable, Sequence

import numpy as np
from scipy.sparse import diags

from fem.body.elasticity import ElasticBody
from fem.body.sums import matrix_of
from fem.body.surface import hat_points
from fem.contact.terms import ContactTerms

# s, s' and s'' at x
Roller = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray, np.ndarray]]

# Part of the radius beyond which a circle goes on straight, slope 2: hats without contact lie there
STEEPEST = 2.0 / np.sqrt(5.0)


def circle(radius: float) -> Roller:
    """A circular roller of this radius [m]."""

    def rise(x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        inside = np.clip(x, -STEEPEST * radius, STEEPEST * radius)
        below = np.sqrt(radius**2 - inside**2)
        slope = inside / below
        bend = np.where(x == inside, radius**2 / below**3, 0.0)
        return inside**2 / (radius + below) + slope * (x - inside), slope, bend

    return rise


def parabola(radius: float) -> Roller:
    """x^2 / 2R, the half-plane's roller; flat for an infinite radius."""

    def rise(x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        return x**2 / (2.0 * radius), x / radius, np.full_like(x, 1.0 / radius)

    return rise


class HatsOnSurface:
    """Points under hats (count + 2,) [m] of a body's surface. The hats belong to points of the
    undeformed body. Raises ValueError if one sticks out of the surface.

    nodes     of all displacements, of which the body's are the first; None: there are no others
    cuts      further x [m] that no Gauss rule spans
    x, z      (q, 2 nodes) take x and z at the q points from those of the nodes
    hats      (q, count) values of the hats
    weight    (q,) [m] of the points
    weighted  (q, count) [m] hats times weight"""

    def __init__(
        self,
        body: ElasticBody,
        hats: np.ndarray,
        nodes: int | None = None,
        cuts: Sequence[float] = (),
    ) -> None:
        points, count = hat_points(body.surface, hats, cuts), len(hats) - 2
        self.weight = points.weight.ravel()
        number = np.arange(points.x.size).reshape(points.x.shape)
        node = body.surface.point[points.node][..., None]
        size = number.size, 2 * (nodes or len(body.nodes))
        self.x, self.z = (matrix_of(points.shape, number, 2 * node + c, size) for c in (0, 1))
        column = points.column[..., None] + 1
        self.hats = matrix_of(points.hat, number, column, (number.size, count + 2))[:, 1:-1]
        self.weighted = diags(self.weight) @ self.hats


class CurrentContact:
    """Contact of a body's surface with a rigid roller, on the hats (count + 2,) [m]. Raises
    ValueError if one sticks out of the surface."""

    def __init__(
        self, body: ElasticBody, hats: np.ndarray, roller: Roller, friction: float = 0.0
    ) -> None:
        self.frictionless, self._friction, self._roller = not friction, friction, roller
        self._points, self._undeformed = HatsOnSurface(body, hats), body.nodes

    def loaded(
        self, displacement: np.ndarray, pressure: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """The gap (count,) [m^2] and the nodal forces (2n,) [N/m] of `at` alone: cheaper."""
        on, place = self._points, (self._undeformed + displacement).ravel()
        rise, slope, _ = self._roller(on.x @ place)
        load = on.weight * (on.hats @ pressure)
        force = on.x.T @ (load * (slope + self._friction))
        force += on.z.T @ (load * (1.0 - self._friction * slope))
        return on.hats.T @ (on.weight * (on.z @ place + rise)), force

    def at(self, displacement: np.ndarray, pressure: np.ndarray) -> ContactTerms:
        """Terms as of `fem.contact.terms.Contact`, on the deformed surface."""
        on, place = self._points, (self._undeformed + displacement).ravel()
        rise, slope, bend = self._roller(on.x @ place)
        gap = on.hats.T @ (on.weight * (on.z @ place + rise))
        along, down = on.x.T @ diags(slope) @ on.weighted, on.z.T @ on.weighted
        force = gradient = (along + down).tocsr()
        load = diags(bend * on.weight * (on.hats @ pressure))
        turning = on.x.T @ load @ on.x
        if not self.frictionless:
            sliding = on.x.T @ on.weighted - on.z.T @ diags(slope) @ on.weighted
            force = gradient + self._friction * sliding
            turning = turning - self._friction * (on.z.T @ load @ on.x)
        return ContactTerms(gap, gradient, force.tocsr(), turning.tocsr())
