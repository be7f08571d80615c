"""Steady conduction in a body whose material moves past the contact.

    rho c V w . grad T = div(k grad T),   k dT/dn = flux in at the surface,

in the frame of the contact; discretised A T = f. Temperatures T rise from the bulk's.

Where a half-plane goes on beyond the mesh ("open"), what leaves is that of a line source at
`centre`, whose temperature (Carslaw and Jaeger 1959, section 10.7) is

    G = exp(V x / (2 kappa)) K0(|V| r / (2 kappa)),   -k dT/dn = h T,   h = -k d(ln G)/dn,

at rest ln(reach / r), whatever its strength. What is left is the effect of the source's width, by
the square of width over distance about its middle.

Elements that resolve the thermal layers (`meshes.thermal_layer`) need no upwinding: surface errors
over the largest temperature with a uniform band |x| < l (Jaeger), block 10 l, V l/(2 kappa) = 1000:

    quadratic elements to a layer    1/2      1        2        2, linear
    temperature, at worst            3e-2     4e-3     7e-4     2e-2
    largest temperature              3e-3     1e-4     7e-6     7e-5

Equal elements of l/128 that grow right behind the band leave 0.08 to 0.1 in the wake.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.sparse import csr_matrix
from scipy.special import k0e, k1e

from fem.body.sums import matrix_of
from fem.body.surface import boundary_points
from fem.body.triangle import edge_shapes
from fem.heat.body import ThermalBody

Boundary = Literal["held", "insulated", "open"]
Flanks = Literal["held", "insulated", "open", "flow"]
POINTS, WEIGHTS = np.polynomial.legendre.leggauss(5)


@dataclass(frozen=True)
class Surroundings:
    """Conditions below the body and on its two sides; its surface beside the flux is insulated.

    "held"       temperatures are given, those of the bulk unless others are
    "insulated"  no heat passes by conduction; moving material carries its own out
    "open"       the half-plane goes on
    "flow"       held where material comes in, insulated where it goes out; held at rest
    """

    base: Boundary = "held"
    sides: Flanks = "flow"


class Conduction:
    """A body's conduction with `velocity` [m/s] of its surface's material, in +x if positive.

    centre  x [m] of the line source that stands for the heat far away
    reach   [m] where an open body at rest has the temperature from which rises count
    matrix  A (n, n) [W/(m K)]
    held    (n,) nodes of given temperature

    Raises ValueError if a body that is not flat is open, or one at rest that has no `reach` beyond
    its mesh: it has no steady state.
    """

    def __init__(
        self,
        body: ThermalBody,
        velocity: float = 0.0,
        surroundings: Surroundings = Surroundings(),
        centre: float = 0.0,
        reach: float = np.inf,
    ) -> None:
        self.body, self.velocity, self.surroundings = body, velocity, surroundings
        flat = body.numbering.flat
        side = boundary_points(flat, body.mesh.spec)
        kinds = {"bottom": surroundings.base}
        for name, inwards in (("left", velocity > 0.0), ("right", velocity < 0.0)):
            kind = surroundings.sides
            flow = "held" if inwards or not velocity else "insulated"
            kinds[name] = flow if kind == "flow" else kind
        self.held = np.zeros(len(flat), dtype=bool)
        self.matrix = body.conduction + velocity * body.convection
        for name, kind in kinds.items():
            if kind == "held":
                self.held[getattr(side, name)] = True
            elif kind == "open":
                self.matrix = self.matrix + self._leaving(name, getattr(side, name), centre, reach)

    def _leaving(self, name: str, node: np.ndarray, centre: float, reach: float) -> csr_matrix:
        """integral N_a h N_b on one side (n, n) [W/(m K)]."""
        numbering, material = self.body.numbering, self.body.material
        axis, normal = {"left": (1, -1.0), "right": (1, 1.0), "bottom": (0, 1.0)}[name]
        node = node[np.argsort(numbering.flat[node, axis])]
        degree = numbering.degree
        edge = node[np.arange(0, len(node) - 1, degree)[:, None] + np.arange(degree + 1)]
        shape = edge_shapes(0.5 * (1.0 + POINTS), degree)
        place = np.einsum("ga,eac->egc", shape, numbering.flat[edge]) - (centre, 0.0)
        length = np.ptp(numbering.flat[edge][:, :, axis], axis=1)
        rate = 0.5 * self.velocity / material.diffusivity
        r = np.hypot(*np.moveaxis(place, -1, 0))
        if not np.isinf(self.body.radius) or not (rate or r.max() < reach < np.inf):
            raise ValueError("an open body is flat, and at rest its mesh ends within its reach")
        if rate:
            decay = abs(rate) * k1e(abs(rate) * r) / k0e(abs(rate) * r)
        else:
            decay = 1.0 / (r * np.log(reach / r))
        outwards = normal * place[..., 1 - axis] / r
        h = material.conductivity * (decay * outwards - rate * normal * axis)
        value = np.einsum("eg,g,e,ga,gb->eab", h, 0.5 * WEIGHTS, length, shape, shape)
        return matrix_of(value, edge[:, :, None], edge[:, None, :], self.body.conduction.shape)
