"""Measures of contacts at their extremes: contact conditions, other solvers, their cost."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
from scipy.linalg import toeplitz
from scipy.optimize import lsq_linear

from analytic.contact.coupled import solve_coupled
from analytic.contact.equilibrium import Constraints
from analytic.contact.patches import contact_patches
from analytic.contact.problem import KKT_TOLERANCE, ContactSolution
from analytic.grid import HatGrid, roller_gap
from analytic.operators.elements import hat_galerkin
from analytic.operators.half_plane import HalfPlane, ModelOperator
from comparisons.campaigns.cases import (
    CONDITION,
    COST,
    TIMES_THE_ORDINARY,
    CaseFigures,
    bounded,
    relative_error,
)
from comparisons.figures.figure import Figure
from comparisons.models.level import Level

MOST_APPLICATIONS = 300  # of the operator, in one contact
MOST_TIMES = 10.0  # the applications of the ordinary contact on as many nodes
MOST_NODES = 512  # in contact, for their condition number
LEAST_SQUARES = 1e-8  # of the peak: error of bounded least squares
SAME = 1e-9  # of the peak: difference of pressures that should be equal
Constants = Sequence[float]  # Young's modulus [Pa] and Poisson's ratio


@dataclass(frozen=True)
class LoadedContact:
    """A grid contact and its solution."""

    x: np.ndarray  # (n,) [m] nodes
    weighted_gap: np.ndarray  # (n,) [m^2] initial gap
    # operator, constraints: as solved with
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

    contact_length = Level.contact_length

    def figures(self, *figures: Figure) -> CaseFigures:
        """The figures, the contact conditions, and the operator's applications; with the condition
        number of the compliance of few nodes in contact."""
        spent = float(self.solution.iterations["applications"])
        times = spent / ordinary_applications(len(self.x))
        limits = (
            bounded("applications", spent, MOST_APPLICATIONS, "the most of a contact"),
            bounded("cost", times, MOST_TIMES, "the ordinary contact on as many nodes"),
        )
        accounts = costs(self.solution, times)
        touching = np.flatnonzero(self.pressure > 0.0)
        if len(touching) <= MOST_NODES:
            condition = np.linalg.cond(self.operator.block(touching))
            accounts += (
                Figure(CONDITION, "of the nodes in contact", "computed", float(condition)),
            )
        return *figures, *residual_figures(self.solution), *limits, *accounts


def load_contact(
    operator: ModelOperator, x: np.ndarray, weighted_gap: np.ndarray, constraints: Constraints
) -> LoadedContact:
    weights = np.full(operator.count, operator.pitch)
    solution = solve_coupled(operator, weighted_gap, weights, constraints)
    return LoadedContact(x, weighted_gap, operator, constraints, solution)


def load_line(
    operator: ModelOperator, height: np.ndarray, constraints: Constraints
) -> LoadedContact:
    """Press a rigid flat on heights (n,) [m], averaged over the hats."""
    x = operator.pitch * (np.arange(operator.count) - 0.5 * (operator.count - 1))
    return load_contact(operator, x, operator.pitch * -height, constraints)


def load_cylinder(
    operator: ModelOperator, radius: float, constraints: Constraints
) -> LoadedContact:
    """Press a parabola of `radius` [m] on a flat."""
    half = operator.count // 2
    grid = HatGrid(operator.pitch, -half, operator.count - 1 - half)
    return load_contact(operator, grid.x, grid.hat_integrals(roller_gap(radius)), constraints)


def residual_figures(solution: ContactSolution) -> CaseFigures:
    return tuple(
        bounded(name, value, KKT_TOLERANCE, "the contact conditions")
        for name, value in vars(solution.residuals).items()
    )


def costs(solution: ContactSolution, times_the_ordinary: float) -> CaseFigures:
    counts = solution.iterations | {TIMES_THE_ORDINARY: times_the_ordinary}
    return tuple(Figure(COST, name, "computed", float(number)) for name, number in counts.items())


@cache
def ordinary_applications(count: int) -> int:
    """Applications for a smooth steel cylinder that touches a third of as many hats."""
    half_width = count / 6.0
    modulus, radius = 1.0, 50.0 * count
    load = np.pi * modulus * half_width**2 / (4.0 * radius)
    contact = load_cylinder(HalfPlane(count, 1.0, modulus), radius, Constraints(load=load))
    return max(1, contact.solution.iterations["applications"])


def dense_matrix(count: int, pitch: float, modulus: float, coupling: float = 0.0) -> np.ndarray:
    """Compliance (n, n) [m^2/Pa] by the elements' formulas; datum as the operators have it."""
    scale = 2.0 * pitch**2 / (np.pi * modulus)
    even = -scale * (hat_galerkin(np.arange(count)) - np.log(count + 1.0))
    odd = np.full(count, coupling * pitch**2 / modulus)
    odd[0] = 0.0
    if count > 1:
        odd[1] *= 11.0 / 12.0
    return toeplitz(even + odd, even - odd)


def dense_violation(contact: LoadedContact, modulus: float, coupling: float = 0.0) -> Figure:
    """Largest violation of the contact conditions by a matrix that the solver never formed.
    Relative to the range of the displacements, or to 1 % of the largest where they hardly vary."""
    pitch, pressure, gap = contact.pitch, contact.pressure, contact.weighted_gap
    displacement = dense_matrix(len(pressure), pitch, modulus, coupling) @ pressure / pitch
    opening = gap / pitch - np.min(gap / pitch) + displacement
    free = (pressure > 0.0) & (pressure < contact.constraints.hardness)
    approach = np.mean(opening[free]) if free.any() else np.max(opening[pressure > 0.0])
    gap = opening - approach
    wrong = np.where(free, np.abs(gap), np.where(pressure > 0.0, gap, -gap))
    scale = max(np.ptp(displacement), 1e-2 * np.abs(displacement).max())
    violation = float(max(0.0, wrong.max()) / scale)
    reference = "the contact conditions by a dense matrix"
    return bounded("gap against pressure", violation, KKT_TOLERANCE, reference)


def least_squares_deviation(contact: LoadedContact, modulus: float) -> Figure:
    """Deviation from the pressures by scipy's bounded least squares at the same approach."""
    pitch, gap = contact.pitch, contact.weighted_gap / contact.pitch
    matrix = dense_matrix(len(contact.pressure), pitch, modulus)
    depth = contact.solution.approach - np.min(gap)
    unit = pitch * depth / np.abs(matrix).max()
    # the size of a gap that nothing closes does not matter
    rise = np.minimum((gap - np.min(gap)) / depth, 1e3)
    factor = np.linalg.cholesky(matrix * unit / (pitch * depth))
    target = np.linalg.solve(factor, 1.0 - rise)
    bounds = (0.0, contact.constraints.hardness / unit)
    expected = unit * lsq_linear(factor.T, target, bounds, method="bvls", tol=1e-14).x
    return deviation(contact.pressure, expected, "pressure", LEAST_SQUARES, "least squares")


def deviation(
    values: np.ndarray, expected: np.ndarray, name: str, high: float, reference: str
) -> Figure:
    """Largest difference, relative to the largest expected value."""
    value = float(np.abs(values - expected).max() / np.abs(expected).max())
    return bounded(name, value, high, reference)


def peak_and_length(
    contact: LoadedContact | Level, exact: tuple[float, float], highs: tuple[float, float]
) -> CaseFigures:
    """Relative errors of peak pressure and contact length; Hertz's `exact` peak [Pa] and half-width
    [m]."""
    values = contact.solution.pressure.max(), 0.5 * contact.contact_length
    named = zip(("peak pressure", "contact length"), values, exact, highs, strict=True)
    return tuple(relative_error(*one, "Hertz, exact") for one in named)


def flowed_figure(flowed: np.ndarray, pitch: float, half_width: float) -> Figure:
    """Length of the hats at the hardness (n,) against 2 `half_width` [m], in hats."""
    off = abs(np.count_nonzero(flowed) * pitch - 2.0 * half_width) / pitch
    return bounded("flowed length", off, 2.0, "flattened cylinder, exact, in hats")
