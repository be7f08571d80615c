"""Contact of a meshed body's surface with a roller above it, and Newton's method for both.

The pressure lambda >= 0 is continuous and linear between the corners of the rough body's surface,
a force per undeformed length of x. Where it acts, the mean of the gap over its hat is zero:

    g = z_roller(x) - z,    integral N_i g dX = 0 where lambda_i > 0, >= 0 elsewhere

x, z being current. The force is lambda (-dg) + mu lambda (1, z_roller') towards +x on the
rough body, so that lambda dX / dx is Cauchy's pressure and mu its friction. A primal-dual active
set changes with every step of Newton's method (Laursen, Computational
Contact and Impact Mechanics, ch. 5). Small strains: the same with x = X and all slopes zero.

The roller moves along x so that the mean tangential displacement between the surfaces, weighted by
pressure, vanishes, as on half-planes: there no far boundary says how far friction drags. A disc
also turns: in place of its surface's displacement there is that of its middle.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.sparse import block_diag, bmat, csr_matrix

from tests.finite_strain_check.solid import InvertedError, Solid

_GAUSS = np.polynomial.legendre.leggauss(4)
GAUSS, WEIGHTS = 0.5 * (_GAUSS[0] + 1.0), 0.5 * _GAUSS[1]
SETTLED = 1e-6  # last change of the pressures, of the largest
STEPS = 60
PREFIX, QAMD = "finite_strain_check_", 6  # approximate minimum degree, for some nearly full rows
Shape = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray, np.ndarray]]


class NotSettledError(Exception):
    """Newton's method does not converge."""


def line_shapes(t: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Quadratic shape functions (..., 3) left, middle, right of 0 <= t <= 1, and derivatives."""
    first = np.stack([4 * t - 3, 4 - 8 * t, 4 * t - 1], axis=-1)
    second = np.broadcast_to([4.0, -8.0, 4.0], first.shape)
    return (
        np.stack([(1 - t) * (1 - 2 * t), 4 * t * (1 - t), t * (2 * t - 1)], axis=-1),
        first,
        second,
    )


@dataclass
class State:
    """Displacements (n, 2) of the bodies, pressures at the surface's corners, those that are
    active, those that are held at the hardness, approach, and the roller's shift along x."""

    moved: list[np.ndarray]
    pressure: np.ndarray
    active: np.ndarray
    capped: np.ndarray
    approach: float = 0.0
    shift: float = 0.0


@dataclass(frozen=True)
class SurfacePair:
    """A rough body below a roller.

    rough, roller  the bodies; a rigid roller is its shape: height, slope and curvature of x
    gap            initial gap (of x) at small strains, None at finite ones
    load           vertical force per length, friction mu
    cap            of Cauchy's pressure; where it is reached, the bodies overlap
    middle         (n, 2) what the displacements of a disc's nodes move its middle by along x
    """

    rough: Solid
    roller: Solid | Shape
    load: float
    friction: float
    reach: float
    gap: Callable[[np.ndarray], np.ndarray] | None = None
    cap: float = np.inf
    middle: np.ndarray | None = None

    @property
    def solids(self) -> list[Solid]:
        return [s for s in (self.rough, self.roller) if isinstance(s, Solid)]

    @cached_property
    def edges(self) -> np.ndarray:
        """The rough body's surface edges that may touch, (k, 3), without holes."""
        edges = self.rough.mesh.surface
        return edges[(np.abs(self.rough.mesh.nodes[edges, 0]) < self.reach).all(axis=1)]

    @cached_property
    def roller_edges(self) -> np.ndarray:
        """Edges of the roller's surface (k, 3) that are no steeper than 60 degrees."""
        edges = self.roller.mesh.surface
        x, z = self.roller.places[edges[:, [0, 2]]].T
        return edges[np.abs(z[1] - z[0]) < np.sqrt(3.0) * (x[1] - x[0])]

    @cached_property
    def x(self) -> np.ndarray:
        """Undeformed x (k + 1,) of the pressures."""
        return self.rough.mesh.nodes[[*self.edges[:, 0], self.edges[-1, 2]], 0]

    @cached_property
    def weights(self) -> np.ndarray:
        """Integrals of the hats."""
        lengths = np.diff(self.x)
        return 0.5 * (np.append(lengths, 0.0) + np.insert(lengths, 0, 0.0))

    def start(self) -> State:
        """Nothing has moved; everything within half the reach is taken to touch."""
        inside = np.abs(self.x) < 0.5 * self.reach
        moved = [np.zeros_like(s.places) for s in self.solids]
        return State(moved, np.zeros(len(self.x)), inside, np.zeros_like(inside))

    def _now(self, body: int, state: State) -> np.ndarray:
        """Points (n, 2) of a body's nodes; at small strains their x stays, and z starts at 0."""
        solid, moved = self.solids[body], state.moved[body]
        if self.gap is not None:
            return np.stack([solid.mesh.nodes[:, 0], moved[:, 1]], axis=1)
        return solid.places + moved + [body * state.shift, 0.0]

    def terms(self, state: State) -> dict[str, np.ndarray]:
        """Terms at integration points (p): gap, slope, the roller's derivative of x and curvature,
        corners and hats (p, 2) of the pressure, weight, and rows (p, 12) of the derivatives
        D, F, X, Z of `assembled`.

        Integrals end at the corners of both surfaces, else friction would stick to the roller's.
        """
        small, now = self.gap is not None, self._now(0, state)
        deformable = isinstance(self.roller, Solid)
        breaks = np.arange(len(self.edges) + 1.0)
        if deformable:
            edges, above = self.roller_edges, self._now(1, state)
            corners = above[[*edges[:, 0], edges[-1, 2]], 0]
            met = (corners > now[self.edges[0, 0], 0]) & (corners < now[self.edges[-1, 2], 0])
            breaks = np.sort(np.concatenate([breaks, _met(now[self.edges, 0], corners[met])]))
        width = np.diff(breaks)
        breaks, width = breaks[:-1][width > 1e-12], width[width > 1e-12]
        edge = np.repeat((breaks + 0.5 * width).astype(int), len(GAUSS))
        t = (breaks[:, None] + width[:, None] * GAUSS).ravel() - edge
        weight = (width[:, None] * WEIGHTS).ravel() * np.diff(self.x)[edge]
        shape, ends = line_shapes(t)[0], self.edges[edge]
        x, z = np.einsum("pa,pai->ip", shape, now[ends])
        rows = {name: np.zeros((len(x), 12)) for name in "DFXZ"}
        rows["D"][:, 0:6:2], rows["F"][:, 1:6:2] = shape, shape
        numbers = np.full((len(x), 12), -1)
        numbers[:, :6] = self.rough.numbers[ends].reshape(-1, 6)
        slope, bend, along = 0.0 * x, 0.0 * x, np.ones_like(x)
        if deformable:
            met = _met(above[edges, 0], x)
            at = met.astype(int)
            shape, first, second = line_shapes(met - at)
            nodes, there = above[edges[at]], self.roller.numbers[edges[at]].reshape(-1, 6)
            rows["D"][:, 6::2], rows["F"][:, 7::2] = -shape, -shape
            numbers[:, 6:] = np.where(there >= 0, there + self.solids[0].count, -1)
            height = np.einsum("pa,pa->p", shape, nodes[..., 1])
            if not small:
                rows["X"][:, 6::2], rows["Z"][:, 7::2] = first, first
                along, rise = np.einsum("pa,pai->ip", first, nodes)
                bent = np.einsum("pa,pai->ip", second, nodes)
                slope = rise / along
                bend = (bent[1] - slope * bent[0]) / along
        elif small:
            height = 0.0 * x
        else:
            height, slope, bend = self.roller(x - state.shift)
        gap = height - z - state.approach + (self.gap(x) if small else 0.0)
        terms = {"gap": gap, "slope": slope, "bend": bend, "along": along, "weight": weight}
        hats = np.stack([1.0 - t, t], axis=1)
        return terms | rows | {"numbers": numbers, "hats": hats, "corner": edge[:, None] + [0, 1]}

    def assembled(self, state: State) -> tuple[np.ndarray, csr_matrix]:
        """Residual and tangent of displacements, active pressures, approach and shift. With `rows`
        of `terms`, s the roller's slope and u all displacements:

            D u, F u  how far the rough body's point moves past the roller's, along x and along z
            X u, Z u  what changes the derivatives of the roller's x and z along its edge
        """
        linear = [s.linearised(u) for s, u in zip(self.solids, state.moved, strict=True)]
        count = sum(s.count for s in self.solids)
        t = self.terms(state)
        d, f, by_x, by_z, s = (t[name] for name in (*"DFXZ", "slope"))
        s, along, mu = s[:, None], t["along"][:, None], self.friction
        push = s * d - f + mu * (d + s * f)  # the force of a unit pressure
        normal = s * d - f  # the gap's derivative
        turned = (by_z - s * by_x + t["bend"][:, None] * d) / along  # the slope's derivative
        weight, hats, corner = t["weight"], t["hats"], t["corner"]
        pressure = (hats * state.pressure[corner]).sum(axis=1)
        loaded = np.flatnonzero(pressure != 0.0)
        part = [a[loaded] for a in (d, f, by_x, by_z, s, along, turned)]
        tangent = -(weight * pressure)[loaded, None, None] * _bent(*part, mu)
        numbers = t["numbers"]
        geometric = _summed(numbers[loaded], numbers[loaded], tangent, (count, count))
        # unknown are pressures of active corners; others are zero, or at the hardness
        every = count, len(self.x)
        pushes, means = (
            _summed(numbers, corner, (weight[:, None] * by)[..., None] * hats[:, None], every)
            for by in (push, normal)
        )
        forces, means = pushes[:, state.active], means[:, state.active]
        shares = (weight * (1.0 - mu * t["slope"]))[:, None] * hats
        upward = np.bincount(corner.ravel(), shares.ravel(), len(self.x))
        lifted, upward = upward @ state.pressure, upward[state.active]
        leaning = np.zeros(count)
        sent = -mu * (weight * pressure)[:, None] * turned
        np.add.at(leaning, numbers[numbers >= 0], sent[numbers >= 0])
        gaps = self._weighted_gaps(t)
        # the roller's shift does to the contact what all its surface's displacement along x does,
        # the opposite of the rough body's
        own_x = np.zeros(count)
        own_x[self.rough.numbers[np.unique(self.edges), 0]] = 1.0
        dragged = np.zeros(count)
        if self.gap is None:
            share = weight * pressure
            known = numbers >= 0
            parts = (share / share.sum())[:, None] * d
            if self.middle is not None:
                parts[:, 6:] = 0.0
            dragged = np.bincount(numbers[known], parts[known], count)
            if self.middle is not None:
                dragged[self.rough.count :] -= self.middle[~self.roller.held].ravel()
        moved = np.concatenate(
            [u[~s.held].ravel() for s, u in zip(self.solids, state.moved, strict=True)]
        )
        residual = np.concatenate(
            [
                np.concatenate([force for force, _ in linear]) - pushes @ state.pressure,
                gaps[state.active],
                [lifted - self.load, dragged @ moved - state.shift],
            ]
        )
        stiffness = block_diag([matrix for _, matrix in linear])
        spread = self.weights[state.active][:, None]
        matrix = bmat(
            [
                [stiffness + geometric, -forces, None, -(geometric @ own_x)[:, None]],
                [means.T, None, -spread, -(means.T @ own_x)[:, None]],
                [leaning[None], upward[None], None, [[-leaning @ own_x]]],
                [dragged[None], None, None, [[-1.0]]],
            ],
            format="csr",
        )
        return residual, matrix

    def solved(self, state: State, log: Callable[[str], None] = lambda text: None) -> State:
        """Equilibrium from a state that is near enough. Raises NotSettledError."""
        pressure = np.where(state.active | state.capped, state.pressure, 0.0)
        state = replace(state, moved=[u.copy() for u in state.moved], pressure=pressure)
        for step in range(STEPS):
            try:
                residual, matrix = self.assembled(state)
            except InvertedError:
                raise NotSettledError("an element is turned inside out") from None
            change = _solution(matrix, -residual)
            start = 0
            for solid, u in zip(self.solids, state.moved, strict=True):
                u[~solid.held] += change[start : start + solid.count].reshape(-1, 2)
                start += solid.count
            before = state.pressure.copy()
            state.pressure[state.active] += change[start:-2]
            state.approach += change[-2]
            state.shift += change[-1]
            gaps, cap = self._weighted_gaps(self.terms(state)), self.cap * self.stretch(state)
            capped = np.where(state.capped, gaps < 0.0, state.pressure > cap)
            touching = np.where(state.active, state.pressure > 0.0, (gaps < 0.0) | state.capped)
            others = np.count_nonzero((touching & ~capped) != state.active)
            state.pressure = np.where(capped, cap, np.where(touching, state.pressure, 0.0))
            last = np.abs(state.pressure - before).max() / np.abs(state.pressure).max()
            state.active, state.capped = touching & ~capped, capped
            log(f"  {step}: change {last:.1e}, {others} corners, shift {state.shift:.5g}")
            if last < SETTLED and not others:
                if touching[[0, -1]].any():
                    raise NotSettledError("the contact reaches the ends of the fine mesh")
                return state
        raise NotSettledError(f"after {STEPS} steps")

    def stretch(self, state: State) -> np.ndarray:
        """Deformed over undeformed length along x at the corners."""
        stretch, middle = np.ones(len(self.x)), self.edges[:, 1]
        if self.gap is None:
            now = self._now(0, state)[middle, 0]
            stretch[1:-1] = np.diff(now) / np.diff(self.rough.mesh.nodes[middle, 0])
        return stretch

    def _weighted_gaps(self, t: dict[str, np.ndarray]) -> np.ndarray:
        """Integrals of the gap times each hat."""
        parts = (t["weight"] * t["gap"])[:, None] * t["hats"]
        return np.bincount(t["corner"].ravel(), parts.ravel(), len(self.x))


def _met(edges: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Where x lies on a line of edges (k, 3) of ascending x: number of the edge plus the share."""
    corners = np.append(edges[:, 0], edges[-1, 2])
    at = np.clip(np.searchsorted(corners, x, side="right") - 1, 0, len(edges) - 1)
    t = (x - corners[at]) / (corners[at + 1] - corners[at])
    for _ in range(8):
        shape, first, _ = line_shapes(t)
        t = t - ((shape * edges[at]).sum(axis=1) - x) / (first * edges[at]).sum(axis=1)
    return at + np.clip(t, 0.0, 1.0 - 1e-12)


def _bent(d, f, by_x, by_z, s, along, turned, mu):
    """Derivative (p, 12, 12) of the force of a unit pressure."""

    def product(a, b):
        return a[:, :, None] * b[:, None, :]

    rolled = d / along  # the derivative of the point on the roller
    normal = product(by_z - s * by_x, rolled) + product(d, turned)
    return normal + mu * (product(f, turned) - product(by_x + s * by_z, rolled))


def _summed(rows, columns, values, shape) -> csr_matrix:
    row, column = np.broadcast_arrays(rows[:, :, None], columns[:, None, :])
    stays = (row >= 0) & (column >= 0) & (values != 0.0)
    return csr_matrix((values[stays], (row[stays], column[stays])), shape=shape)


def _solution(matrix: csr_matrix, right: np.ndarray) -> np.ndarray:
    """Solve by MUMPS, whose own choice of an ordering takes as long as the rest."""
    from petsc4py import PETSc

    PETSc.Options()[f"{PREFIX}mat_mumps_icntl_7"] = QAMD  # only options reach it in all releases
    a = PETSc.Mat().createAIJ(matrix.shape, csr=(matrix.indptr, matrix.indices, matrix.data))
    solver = PETSc.KSP().create()
    solver.setOperators(a)
    solver.setType("preonly")
    method = solver.getPC()
    method.setType("lu")
    method.setFactorSolverType("mumps")
    method.setFactorSetUpSolverType()
    factor = method.getFactorMatrix()
    factor.setOptionsPrefix(PREFIX)
    factor.setMumpsIcntl(14, 60)
    b = PETSc.Vec().createWithArray(right)
    x = b.duplicate()
    solver.solve(b, x)
    step = x.array.copy()
    for item in (factor, method, solver, a, b, x):  # all: what is left to Python is not freed
        item.destroy()
    if not np.isfinite(step).all():
        raise NotSettledError("the matrix is singular")
    return step
