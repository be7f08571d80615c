"""A contact problem on a grid of hats, its solution, and the figures that every one is held to."""

from dataclasses import dataclass, replace
from functools import cache

import numpy as np
from scipy.linalg import toeplitz
from scipy.optimize import lsq_linear

from analytic.contact.coupled import solve_coupled
from analytic.contact.equilibrium import Constraints
from analytic.contact.patches import contact_patches
from analytic.contact.problem import KKT_TOLERANCE, ContactSolution, solve_contact
from analytic.grid import HatGrid, roller_gap
from analytic.operators.elements import hat_galerkin
from analytic.operators.half_plane import HalfPlane, ModelOperator
from analytic.operators.tangential import CoupledHalfPlane
from comparisons.studies.robustness.row import Figure

APPLICATIONS = 300  # of the operator, the most that a contact may take
TIMES = 10.0  # what the ordinary contact on as many nodes takes, the most
LEAST_SQUARES = 1e-8  # of the peak: what bounded least squares leave
SAME = 1e-9  # of the peak: what pressures may differ by that should be the same


@dataclass(frozen=True)
class Pressed:
    """A grid contact and its solution.

    x         (n,) [m] nodes        gap  (n,) weighted initial gap [m^2]
    operator  as solved with        constraints  as given
    """

    x: np.ndarray
    gap: np.ndarray
    operator: ModelOperator
    constraints: Constraints
    solution: ContactSolution

    @property
    def pitch(self) -> float:
        return float(self.x[1] - self.x[0])

    @property
    def pressure(self) -> np.ndarray:
        return self.solution.pressure

    @property
    def patches(self) -> np.ndarray:
        return contact_patches(self.x, self.solution.pressure, self.solution.gap)

    @property
    def contact_length(self) -> float:
        """Sum of the patches [m]."""
        return float(np.ptp(self.patches, axis=1).sum())


def press(
    operator: ModelOperator, pitch: float, gap: np.ndarray, constraints: Constraints
) -> Pressed:
    """Press a surface whose gap (n,) [m], averaged over the hats, is given."""
    count = operator.count
    weights = np.full(count, pitch)
    solve = solve_coupled if hasattr(operator, "skew") else solve_contact
    solution = solve(operator, pitch * gap, weights, constraints)
    x = pitch * (np.arange(count) - 0.5 * (count - 1))
    return Pressed(x, pitch * gap, operator, constraints, solution)


def press_cylinder(
    count: int, pitch: float, radius: float, modulus: float, constraints: Constraints
) -> Pressed:
    """Press a parabola about the middle of a half-plane's grid."""
    grid = HatGrid(pitch, -(count // 2), count - 1 - count // 2)
    weighted_gap = grid.hat_integrals(roller_gap(radius))
    operator = HalfPlane(grid.count, pitch, modulus)
    solution = solve_contact(operator, weighted_gap, grid.weights, constraints)
    return Pressed(grid.x, weighted_gap, operator, constraints, solution)


def residual_figures(solution: ContactSolution) -> tuple[tuple[Figure, ...], dict[str, float]]:
    """The contact conditions as figures, and by name for the row's checks."""
    checks = dict(vars(solution.residuals))
    figures = tuple(
        Figure(name, value, KKT_TOLERANCE, "the contact conditions")
        for name, value in checks.items()
    )
    return figures, checks


def cost_figures(solution: ContactSolution, count: int) -> tuple[tuple[Figure, ...], dict]:
    """Applications of the operator, and how many times the ordinary contact's they are."""
    spent = float(solution.iterations["applications"])
    usual = ordinary_applications(count)
    cost = {
        **{name: float(number) for name, number in solution.iterations.items()},
        "times_the_ordinary": spent / usual,
    }
    figures = (
        Figure("applications", spent, APPLICATIONS, "the most a contact may take"),
        Figure("cost", spent / usual, TIMES, "times the ordinary contact on as many nodes"),
    )
    return figures, cost


@cache
def ordinary_applications(count: int) -> int:
    """Of a smooth steel cylinder that touches a third of as many hats."""
    half_width = count / 6.0
    modulus, radius = 1.0, 50.0 * count
    load = np.pi * modulus * half_width**2 / (4.0 * radius)
    pressed = press_cylinder(count, 1.0, radius, modulus, Constraints(load=load))
    return max(1, pressed.solution.iterations["applications"])


def dense_matrix(count: int, pitch: float, modulus: float, coupling: float = 0.0) -> np.ndarray:
    """Compliance (n, n) [m^2/Pa] by the elements' formulas; datum as the operators have it."""
    scale = 2.0 * pitch**2 / (np.pi * modulus)
    even = -scale * (hat_galerkin(np.arange(count)) - np.log(count + 1.0))
    odd = np.full(count, coupling * pitch**2 / modulus)
    odd[0] = 0.0
    if count > 1:
        odd[1] *= 11.0 / 12.0
    return toeplitz(even + odd, even - odd)


def dense_departure(pressed: Pressed, modulus: float, coupling: float = 0.0) -> Figure:
    """Largest violation of the contact conditions by a matrix that the solver never formed.

    Over the range of the displacements, or the largest of them where the load leaves none.
    """
    pitch, pressure = pressed.pitch, pressed.pressure
    sunk = dense_matrix(len(pressure), pitch, modulus, coupling) @ pressure / pitch
    hardness = pressed.constraints.hardness
    reach = pressed.gap / pitch - np.min(pressed.gap / pitch) + sunk
    free = (pressure > 0.0) & (pressure < hardness)
    approach = np.mean(reach[free]) if free.any() else np.max(reach[pressure > 0.0])
    gap = reach - approach
    wrong = np.where(free, np.abs(gap), np.where(pressure > 0.0, gap, -gap))
    scale = max(np.ptp(sunk), 1e-2 * np.abs(sunk).max())
    return Figure(
        "gap against pressure",
        float(max(0.0, wrong.max()) / scale),
        KKT_TOLERANCE,
        "the contact conditions by a dense matrix",
    )


def least_squares_departure(pressed: Pressed, modulus: float) -> Figure:
    """Largest difference from bounded least squares at the same approach, of the peak."""
    matrix = dense_matrix(len(pressed.pressure), pressed.pitch, modulus)
    expected = least_squares(
        matrix, pressed.gap, pressed.pitch, pressed.solution.approach, pressed.constraints.hardness
    )
    return departure(pressed.pressure, expected, "pressure", LEAST_SQUARES, "least squares")


def least_squares(
    matrix: np.ndarray, gap: np.ndarray, pitch: float, approach: float, hardness: float = np.inf
) -> np.ndarray:
    """Pressures (n,) of a dense compliance under a weighted gap (n,), by scipy's bounded ones."""
    lowest = np.min(gap) / pitch
    depth = approach - lowest
    unit = pitch * depth / np.abs(matrix).max()
    rise = np.minimum((gap / pitch - lowest) / depth, 1e3)  # what nothing closes may be any gap
    factor = np.linalg.cholesky(matrix * unit / (pitch * depth))
    target = np.linalg.solve(factor, 1.0 - rise)
    bounds = (0.0, hardness / unit)
    return unit * lsq_linear(factor.T, target, bounds, method="bvls", tol=1e-14).x


def departure(
    found: np.ndarray, expected: np.ndarray, name: str, most: float, against: str
) -> Figure:
    """Largest difference, of the largest expected amount."""
    found, expected = np.asarray(found, dtype=float), np.asarray(expected, dtype=float)
    value = float(np.abs(found - expected).max() / np.abs(expected).max())
    return Figure(name, value, most, against)


def mirrored(pressed: Pressed) -> Pressed:
    """The same problem seen from the other side, solved anew."""
    operator, gap = pressed.operator, pressed.gap[::-1]
    if isinstance(operator, CoupledHalfPlane):
        operator = CoupledHalfPlane(
            operator.count, operator.pitch, operator.modulus, -operator.friction_dundurs
        )
    solve = solve_coupled if hasattr(operator, "skew") else solve_contact
    weights = np.full(operator.count, pressed.pitch)
    solution = solve(operator, gap, weights, pressed.constraints)
    return replace(pressed, gap=gap, operator=operator, solution=solution)
