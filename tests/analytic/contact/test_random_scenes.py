"""Two hundred seeded scenes, from almost smooth to barely touching: every one must be solved.

The contact conditions are evaluated anew with a dense matrix, which the solver never forms; few
nodes are also solved by bounded least squares. What a scene costs is bounded, so that a search
that goes astray shows even where it ends well.

Rounding limits what a scene can ask: gaps are known to 1e-16 of their range, so compressions
stay above 1e-6 of it where the approach is prescribed and the residuals below 1e-8 of them.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest
from scipy.linalg import circulant, toeplitz
from scipy.optimize import lsq_linear

from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import ContactSolution, solve_contact
from analytic.operators.elements import hat_galerkin
from analytic.operators.half_plane import HalfPlane
from analytic.operators.periodic import PeriodicHalfPlane, hat_aliases

SEEDS = range(3, 1000, 5)  # five is prime to the number of shapes: each comes as often
FEW = 40  # nodes that bounded least squares solve quickly
RESIDUAL = 1e-8
APPLICATIONS = 300


@dataclass(frozen=True)
class Scene:
    """One contact problem: nodes, pitch [m], modulus [Pa], weighted gaps (n,) [m^2]."""

    label: str
    periodic: bool
    pitch: float
    modulus: float
    gap: np.ndarray
    constraints: Constraints

    @property
    def count(self) -> int:
        return len(self.gap)

    @property
    def weights(self) -> np.ndarray:
        return np.full(self.count, self.pitch)

    def solved(self) -> ContactSolution:
        kind = PeriodicHalfPlane if self.periodic else HalfPlane
        operator = kind(self.count, self.pitch, self.modulus)
        return solve_contact(operator, self.gap, self.weights, self.constraints)

    def matrix(self) -> np.ndarray:
        """The compliance (n, n) [m^2/Pa], from the elements' formulas."""
        count, scale = self.count, self.pitch**2 / (np.pi * self.modulus)
        if not self.periodic:
            datum = -np.log(count + 1.0)
            return toeplitz(-2.0 * scale * (hat_galerkin(np.arange(count)) + datum))
        symbol = np.append(count, hat_aliases(np.arange(1, count // 2 + 1) / count))
        return scale * circulant(np.fft.irfft(symbol, count))


def spectral(rng, count: int, amplitude) -> np.ndarray:
    """Periodic Gaussian heights (n,) whose waves 1, 2, … have these relative amplitudes."""
    order = np.arange(1, count // 2 + 1)
    waves = amplitude(order) * np.exp(2j * np.pi * rng.random(len(order)))
    heights = np.fft.irfft(np.append(0.0, waves * rng.rayleigh(size=len(order))), count)
    return heights / np.std(heights)


def self_affine(rng, count: int) -> np.ndarray:
    hurst = rng.uniform(0.0, 1.2)
    return spectral(rng, count, lambda order: order ** (-0.5 - hurst))


def band(rng, count: int) -> np.ndarray:
    lowest = rng.integers(1, count // 4 + 1)
    return spectral(rng, count, lambda order: (order >= lowest) & (order <= 2 * lowest))


def white(rng, count: int) -> np.ndarray:
    return rng.standard_normal(count)


def smooth(rng, count: int) -> np.ndarray:
    return np.zeros(count)


def wave(rng, count: int) -> np.ndarray:
    whole = rng.integers(1, count // 3 + 1)
    return np.cos(2.0 * np.pi * whole * np.arange(count) / count + rng.uniform(0.0, 6.0))


def few_waves(rng, count: int) -> np.ndarray:
    return sum(rng.standard_normal() * wave(rng, count) for _ in range(4))


def valleys(rng, count: int) -> np.ndarray:
    """Blunt peaks and deep valleys, as after grinding."""
    return -np.exp(-rng.uniform(0.3, 1.5) * self_affine(rng, count))


def plateaus(rng, count: int) -> np.ndarray:
    heights = self_affine(rng, count)
    return np.minimum(heights, np.quantile(heights, rng.uniform(0.1, 0.95)))


def spike(rng, count: int) -> np.ndarray:
    heights = 0.01 * rng.integers(2) * self_affine(rng, count)
    heights[rng.integers(count)] += 1.0
    return heights


def twin_peaks(rng, count: int) -> np.ndarray:
    heights = self_affine(rng, count)
    return heights + heights[::-1]


def steps(rng, count: int) -> np.ndarray:
    length = rng.integers(1, count // 3 + 2)
    return np.repeat(rng.standard_normal(count), length)[:count]


def saw(rng, count: int) -> np.ndarray:
    return np.arange(count) % float(rng.integers(2, count // 2 + 1))


SHAPES = (
    *(self_affine, band, white, smooth, wave, few_waves),
    *(valleys, plateaus, spike, twin_peaks, steps, saw),
)


def scene(seed: int) -> Scene:
    """A scene drawn from `seed`: shapes, units, amplitudes, loads, hardness, both kinds of ends."""
    rng = np.random.default_rng([seed, 1991])
    count = int(np.exp(rng.uniform(np.log(8.0), np.log(2001.0))))
    periodic = bool(rng.random() < 0.4)
    pitch, modulus = 10.0 ** rng.uniform(-9.0, 1.0), 10.0 ** rng.uniform(0.0, 12.0)
    length = count * pitch
    shape = SHAPES[seed % len(SHAPES)]
    heights = shape(rng, count)
    amplitude = length * 10.0 ** rng.uniform(-9.0, -1.0)
    gap = -amplitude * heights / (np.ptp(heights) or 1.0)
    if rng.random() < (0.3 if periodic else 0.6):
        off = (np.arange(count) - 0.5 * count) / count - rng.uniform(-0.3, 0.3)
        rise = (
            0.5 * off**2 if not periodic else (1.0 - np.cos(2.0 * np.pi * off)) / (4.0 * np.pi**2)
        )
        gap = gap + length * 10.0 ** rng.uniform(-6.0, 0.0) * rise
    span = np.ptp(gap) or amplitude
    if np.ptp(gap) > 0.0 and rng.random() < 0.5:  # a polyline averaged over the hats
        around = np.pad(gap, 1, mode="wrap" if periodic else "edge")
        gap = (around[:-2] + 4.0 * gap + around[2:]) / 6.0
    gap = gap + rng.integers(-1, 2) * 0.3 * span
    capped, by_load = rng.random() < 1.0 / 3.0, rng.random() < 0.6
    hardness = np.inf
    if capped:  # from all but rigid-plastic to a hardness that nothing reaches
        hardness = modulus * span / length * 10.0 ** rng.uniform(-2.0, 3.0)
    if by_load:
        load = modulus * span * 10.0 ** rng.uniform(-8.0, 2.0)
        if capped and load >= 0.99 * hardness * length:
            load = hardness * length * 10.0 ** rng.uniform(-4.0, -0.01)
        constraints = Constraints(load=load, hardness=hardness)
    else:
        depth = span * 10.0 ** rng.uniform(-6.0, 1.0)
        constraints = Constraints(approach=np.min(gap) + depth, hardness=hardness)
    label = (
        f"scene {seed}: {shape.__name__}, {count} nodes, {'periodic' if periodic else 'free'}, "
        f"{'load' if by_load else 'approach'}, {'capped' if capped else 'no cap'}"
    )
    return Scene(label, periodic, pitch, modulus, pitch * gap, constraints)


def residuals(case: Scene, solution: ContactSolution, matrix: np.ndarray) -> dict[str, float]:
    """Every contact condition, dimensionless; the lowest gap is taken as zero against rounding."""
    pressure, weights, hardness = solution.pressure, case.weights, case.constraints.hardness
    lowest = np.min(case.gap) / case.pitch
    sunk = matrix @ pressure / weights
    reach = (case.gap - lowest * weights) / weights + sunk
    free = (pressure > 0.0) & (pressure < hardness)
    scale = max(np.ptp(sunk), 1e-2 * np.max(np.abs(sunk))) or 1.0  # a flat sinks evenly
    approach = solution.approach - lowest
    if case.constraints.load is not None and free.any():
        approach = np.mean(reach[free])  # as the touching nodes have it
    gap = reach - approach
    off = abs(solution.approach - lowest - approach)
    load = case.constraints.load
    rounding = 3e-15 * (abs(solution.approach) if load is None else abs(approach))
    largest = np.max(pressure) or 1.0
    return {
        "approach": max(0.0, off - 1e-15 * abs(solution.approach)) / scale,
        "load": 0.0 if load is None else abs(weights @ pressure / load - 1.0),
        "touching": max(0.0, np.max(np.abs(gap[free]), initial=0.0) - rounding) / scale,
        "penetration": max(0.0, -np.min(gap[pressure <= 0.0], initial=0.0)) / scale,
        "open under the cap": max(0.0, np.max(gap[pressure >= hardness], initial=0.0)) / scale,
        "tension": max(0.0, -np.min(pressure)) / largest,
        "excess": max(0.0, np.max(pressure) / hardness - 1.0),
    }


def bounded_least_squares(case: Scene, approach: float, matrix: np.ndarray) -> np.ndarray:
    """Pressures (n,) [Pa] of least energy between 0 and H at a given approach [m]."""
    lowest = np.min(case.gap) / case.pitch
    depth = approach - lowest
    beyond = 1e3 * depth  # a gap that nothing closes may be any such gap
    unit = case.modulus * depth / (case.count * case.pitch)
    gap = np.minimum((case.gap / case.pitch - lowest) / depth, beyond / depth)
    factor = np.linalg.cholesky(matrix * unit / (case.pitch * depth))
    target = np.linalg.solve(factor, 1.0 - gap)
    cap = case.constraints.hardness / unit
    return unit * lsq_linear(factor.T, target, (0.0, cap), method="bvls", tol=1e-14).x


@cache
def outcome(seed: int) -> tuple[Scene, ContactSolution]:
    case = scene(seed)
    return case, case.solved()


def check(case: Scene, solution: ContactSolution) -> None:
    assert solution.converged, case.label
    left = residuals(case, solution, case.matrix())
    assert max(left.values()) <= RESIDUAL, (case.label, left)
    assert solution.iterations["applications"] <= APPLICATIONS, (case.label, solution.iterations)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_scene_is_solved_at_a_proportionate_cost(seed):
    check(*outcome(seed))


def test_few_nodes_agree_with_bounded_least_squares():
    few = [(case, one) for case, one in map(outcome, SEEDS) if case.count <= FEW]
    checked = [(case, one) for case, one in few if one.pressure.any()]
    assert len(checked) > 40
    for case, one in checked:
        expected = bounded_least_squares(case, one.approach, case.matrix())
        departure = np.max(np.abs(one.pressure - expected)) / np.max(expected)
        assert departure <= 1e-8, case.label


@pytest.mark.parametrize("count", [1, 2, 3, 7, 128, 129, 513])
@pytest.mark.parametrize("share", [1e-6, 0.5, 0.9, 0.999, 1.0 - 1e-9])
def test_loads_up_to_what_the_hardness_carries(count, share):
    limits = Constraints(load=share * count, hardness=1.0)
    heights = np.random.default_rng(count).standard_normal(count)
    for amplitude in (0.0, 1e-3, 1.0):
        case = Scene(f"amplitude {amplitude}", False, 1.0, 1.0, amplitude * heights, limits)
        check(case, case.solved())
