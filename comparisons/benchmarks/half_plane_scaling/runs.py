"""One contact problem at one size: its time, its transforms, the time of one, and its memory."""

import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache, partial

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft

from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import ContactSolution, solve_contact
from analytic.operators.convolution import Convolution
from analytic.operators.half_plane import HalfPlane, ModelOperator
from analytic.operators.periodic import PeriodicHalfPlane
from comparisons.benchmarks.half_plane_peers import cases as peers_cases
from comparisons.benchmarks.half_plane_scaling.growth import Growth
from comparisons.benchmarks.half_plane_scaling.memory import peak_memory

COARSEST = 1024  # nodes, 16 to the shortest wave
SEED = 1
BUDGET = 10.0  # seconds of repeats
PAIRS = 30  # timed for the median of one


@dataclass(frozen=True)
class Problem:
    """What the solver is given: the operator's making, weighted gaps (n,) [m^2], load [N/m]."""

    count: int
    operator: Callable[[], Convolution]
    gap: np.ndarray
    load: float


def rough(count: int) -> Problem:
    """The line that COARSEST nodes resolve, closed, a tenth of it in contact."""
    waves, load = _line()
    return Problem(
        count=count,
        operator=lambda: PeriodicHalfPlane(count, 1.0 / count, 1.0),
        gap=peers_cases.averages(waves, count) / count,
        load=load,
    )


@lru_cache(maxsize=1)
def _line() -> tuple[np.ndarray, float]:
    waves = peers_cases.rough_waves(COARSEST, SEED, peers_cases.SHORTEST / COARSEST)
    return waves, peers_cases.load_for_share(8 * COARSEST, waves)


def cylinder(count: int) -> Problem:
    """Hertz, half of the nodes in contact, on a free line."""
    case = peers_cases.cylinder(count)
    return Problem(
        count=count,
        operator=lambda: HalfPlane(count, 1.0 / count, 1.0),
        gap=case.averages / count,
        load=case.load,
    )


class Counted:
    """An operator that notes the length of every transform: on its own grid, stretches of the line
    included, and on coarser ones."""

    def __init__(self, operator: Convolution, own: list[int], coarser: list[int]) -> None:
        self._operator, self._own, self._coarser = operator, own, coarser

    def __getattr__(self, name: str):
        return getattr(self._operator, name)

    def apply(self, pressure: np.ndarray) -> np.ndarray:
        self._own.append(_length(self._operator))
        return self._operator.apply(pressure)

    def precondition(self, displacement: np.ndarray) -> np.ndarray:
        self._own.append(self._operator.ring)
        return self._operator.precondition(displacement)

    def cropped(self, span: int) -> "Counted | None":
        stretch = self._operator.cropped(span)
        return None if stretch is None else Counted(stretch, self._own, self._coarser)

    def coarsened(self) -> "Counted | None":
        coarse = self._operator.coarsened()
        return None if coarse is None else Counted(coarse, self._coarser, self._coarser)


def grown(make: Callable[[int], Problem], count: int, repeats: int) -> Growth:
    """Time the problem `repeats` times or while BUDGET lasts, count and weigh it once each."""
    problem = make(count)
    finest: list[int] = []
    coarser: list[int] = []
    operator = problem.operator()
    longest = _length(operator)
    solution = _solved(lambda: Counted(operator, finest, coarser), problem)
    if not solution.converged:
        raise ArithmeticError(f"{problem.count} nodes: {solution.residuals}")
    seconds = _median(lambda: _solved(problem.operator, problem), repeats)
    wave = np.random.default_rng(SEED).random(longest)
    return Growth(
        count=problem.count,
        seconds=seconds,
        exchanges=solution.iterations["exchanges"],
        finest=sum(finest) / longest,
        pairs=(sum(finest) + sum(coarser)) / longest,
        pair=_median(lambda: irfft(rfft(wave), longest), PAIRS),
        memory=peak_memory(partial(prepared, make, count)),
    )


def prepared(make: Callable[[int], Problem], count: int) -> Callable[[], ContactSolution]:
    """The problem, ready to be solved."""
    problem = make(count)
    return partial(_solved, problem.operator, problem)


def _length(operator: Convolution) -> int:
    """Of the transform of one application."""
    return operator.count if operator.periodic else next_fast_len(2 * operator.count, real=True)


def _solved(build: Callable[[], ModelOperator], problem: Problem) -> ContactSolution:
    weights = np.full(problem.count, 1.0 / problem.count)
    return solve_contact(build(), problem.gap, weights, Constraints(load=problem.load))


def _median(work: Callable[[], object], repeats: int) -> float:
    """Seconds of the processor."""
    spent: list[float] = []
    work()
    while len(spent) < repeats and sum(spent) < BUDGET:
        start = time.process_time()
        work()
        spent.append(time.process_time() - start)
    return statistics.median(spent)
