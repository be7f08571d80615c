"""Surface compliance as an operator: pressure in, weighted normal displacement out.

Pressures are hats on a uniform grid: nodal values p_i [Pa] at x_i = x_0 + i h, linear between,
zero one pitch beyond the ends. An operator C maps them to the Galerkin averages of the normal
displacement, (C p)_i = integral phi_i u_z dx [m^2], u_z [m] positive into the body. C is
symmetric. The contact solver knows nothing else of the body.

    h    pitch [m]           E*   modulus [Pa]            L    datum length [m]
    phi  hat of height 1     u    displacement [m]        k    wavenumber [1/m]"""

import warnings
from functools import cached_property
from typing import Protocol, Self

import numpy as np
import scipy.linalg
from scipy.linalg import LinAlgError, LinAlgWarning

from analytic.grid import restricted
from analytic.operators.convolution import Convolution, cholesky_solve
from analytic.operators.elements import at_whole_offsets

RIDGE = 1e-9  # of the largest diagonal entry, added before a dense matrix is factored
FURTHEST = 500.0  # ln(L'/L) of a datum L': the largest that numbers of any unit of length hold


class ComplianceOperator(Protocol):
    """Anything that turns hat pressures (n,) [Pa] into weighted displacements (n,) [m^2]."""

    def apply(self, pressure: np.ndarray) -> np.ndarray: ...


class ModelOperator(ComplianceOperator, Protocol):
    """A compliance that also offers an approximate inverse and a coarser version of itself.

    count         nodes
    periodic      whether the grid closes on itself: node `count` is node 0
    skew          whether it has a part that is not symmetric; then `normal` is the one that is
    ring          nodes of the closed line that `precondition` takes displacements on;
                  None where it takes those of the grid
    precondition  a positive definite approximation of the inverse
    solve         pressures (m, k) of few nodes (m,) alone that sink by given right sides (m, k),
                  or None: they are not so few, or nothing can be factored
    block         the matrix's rows and columns of some nodes
    cropped       the same on a stretch that holds a number of nodes in a row, or None
    coarser       the same on elements twice as wide, centred on nodes 1, 3, 5, …, or None"""

    count: int
    periodic: bool
    skew: bool
    ring: int | None
    coarser: "ModelOperator | None"

    def precondition(self, weighted_displacement: np.ndarray) -> np.ndarray: ...

    def solve(self, nodes: np.ndarray, right: np.ndarray) -> np.ndarray | None: ...

    def block(self, nodes: np.ndarray) -> np.ndarray: ...

    def cropped(self, span: int) -> "ModelOperator | None": ...


class HalfPlane(Convolution):
    """Compliance of a half-plane, exact log-kernel coefficients, applied by FFT.

    u_z(x) = -(2 / (pi E*)) integral p(s) ln(|x - s| / L) ds (Johnson 1985, eq. 2.25).
    Displacements are defined up to a constant. With the grid's support as datum length L, four
    times its logarithmic capacity, the operator is positive definite and scales with the unit of
    length. With E* of two bodies the displacement is the sum of both.

    count    number of elements      pitch    h [m]
    modulus  E* [Pa], or E' of one body
    datum    L [m]; default the support (count + 1) h"""

    def __init__(
        self, count: int, pitch: float, modulus: float, datum: float | None = None
    ) -> None:
        self.pitch, self.modulus = pitch, modulus
        self.datum = (count + 1) * pitch if datum is None else datum
        self.arguments = modulus, self.datum
        self._further = max(0.0, np.log(self.datum / ((count + 1) * pitch)))
        scale = 2.0 * pitch**2 / (np.pi * modulus)
        column = -scale * (at_whole_offsets(count) + np.log(pitch / self.datum))
        super().__init__(column, self._symbol)

    def on_base(self, compliance: float) -> "HalfPlane":
        """Half-plane on a base that gives way by `compliance` c [m^2/N] times the load: C + c w w'.
        That is the datum L exp(pi E* c / 2), for c >= 0 and up to FURTHEST."""
        further = np.clip(0.5 * np.pi * self.modulus * compliance, 0.0, FURTHEST)
        datum = self.datum * float(np.exp(further))
        return HalfPlane(self.count, self.pitch, self.modulus, datum)

    def _symbol(self, cycles: np.ndarray) -> np.ndarray:
        """2 / (E* |k|) seen through the hats, with the nearest aliases [m^2/Pa].
        A hat's transform is sinc^2 and stands twice (pressure and average). On a datum beyond the
        support the mean sinks further, c h^2 a node of the ring (`on_base`):
        without it a search for pressures first moves off, and may end as rounding what is none."""
        c = np.where(cycles == 0.0, 0.5 * cycles[1], cycles)  # the mean: any positive value
        sine = np.sin(np.pi * c) / np.pi
        aliases = 1.0 / c, 1.0 / (1.0 - c), 1.0 / (1.0 + c)
        # each (sine / |c + j|)^4 / |c + j|
        seen = sum((sine * alias) ** 2 * (sine * alias) ** 2 * alias for alias in aliases)
        seen[cycles == 0.0] += 2.0 * self._further / cycles[1]
        return self.pitch**2 / (np.pi * self.modulus) * seen


class SumOfConvolutions(Convolution):
    """Two surfaces or more on the same elements as one: their matrices and symbols added.

    bodies  with the same count, pitch and periodicity, of any kind"""

    def __init__(self, *bodies: Convolution) -> None:
        if len({(body.count, body.periodic) for body in bodies}) != 1:
            raise ValueError("bodies to be added must have the same elements")
        self.bodies, self.pitch, periodic = bodies, bodies[0].pitch, bodies[0].periodic
        super().__init__(
            sum(body.column for body in bodies),
            None if periodic else lambda cycles: sum(body.symbol(cycles) for body in bodies),
            None if all(body.symmetric for body in bodies) else sum(body.row for body in bodies),
            periodic=periodic,
        )

    @cached_property
    def coarser(self) -> "SumOfConvolutions | None":
        """Sum of the same bodies on elements twice as wide, centred on nodes 1, 3, 5, …"""
        coarser = [body.coarser for body in self.bodies]
        return None if None in coarser else SumOfConvolutions(*coarser)


class DenseCompliance:
    """A compliance given as its matrix (n, n) [m^2/Pa], for a body that no model comes close to.
    Its symmetric part is positive definite, and all that counts unless it is `skew`. Nodes are then
    solved by elimination: 1500 in 0.1 s."""

    periodic = False
    ring = None

    def __init__(self, matrix: np.ndarray, skew: bool = False) -> None:
        even = 0.5 * (matrix + matrix.T)
        self.matrix, self.count, self.skew = matrix if skew else even, len(matrix), skew
        # hats finer than a body's elements leave it rank-deficient where nothing touches
        ridge = RIDGE * np.max(np.diag(even)) * np.eye(self.count)
        self._factor = scipy.linalg.cho_factor(even + ridge)

    def apply(self, pressure: np.ndarray) -> np.ndarray:
        """Weighted displacements (n,) [m^2] of nodal pressures (n,) [Pa]."""
        return self.matrix @ pressure

    def block(self, nodes: np.ndarray) -> np.ndarray:
        """The matrix's rows and columns of these nodes (m,), as an array (m, m) [m^2/Pa]."""
        return self.matrix[np.ix_(nodes, nodes)]

    def cropped(self, span: int) -> None:
        """No part of a body has a compliance that depends on distances alone."""

    @cached_property
    def coarser(self) -> Self:
        """Matrix of the same body on hats twice as wide, centred on nodes 1, 3, 5, …"""
        rows = restricted(self.matrix, self.periodic)
        return type(self)(restricted(rows.T, self.periodic).T, self.skew)

    @cached_property
    def normal(self) -> "DenseCompliance":
        """The symmetric part; where every set of nodes can be eliminated nothing asks for it."""
        return DenseCompliance(self.matrix)

    def precondition(self, weighted_displacement: np.ndarray) -> np.ndarray:
        """The inverse of the symmetric part but for a small ridge, close while every element is in
        contact."""
        return scipy.linalg.cho_solve(self._factor, weighted_displacement)

    def solve(self, nodes: np.ndarray, right: np.ndarray) -> np.ndarray | None:
        """Pressures (m, k) of these nodes alone under which they sink by `right` (m, k). None where
        hats finer than a body's elements leave nothing to factor."""
        if not self.skew:
            return cholesky_solve(self.block(nodes), right)
        with warnings.catch_warnings():
            warnings.simplefilter("error", LinAlgWarning)
            try:
                return scipy.linalg.solve(self.block(nodes), right, check_finite=False)
            except (LinAlgError, LinAlgWarning):
                return None
