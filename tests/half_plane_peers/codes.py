"""The half-plane codes under comparison: this project's, Tamaas and ContactMechanics.

Operators, kernels and plans are made once for a size and reused where a code allows it. Tamaas,
whose models start from their last solution, makes a model each time, at a hundredth of its time.
"""

import contextlib
import io
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial
from typing import Literal

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import solve_contact
from tests.half_plane_peers.cases import LineCase
from tests.half_plane_peers.yardstick import operator_of
from tests.harness import AbsentError


@dataclass(frozen=True)
class LineAnswer:
    """Pressures (n,) [Pa] at the nodes, and the steps taken, where the code reports them."""

    pressure: np.ndarray
    steps: int | None


@dataclass(frozen=True)
class LineCode:
    """One configuration of one code.

    element     "hat", "strip" or "point": its discretisation
    solve       from case, tolerance and largest number of steps
    tolerances  of the code's own stopping criterion, loosest first
    """

    name: str
    element: str
    solve: Callable[[LineCase, float, int], LineAnswer]
    tolerances: tuple[float, ...]


def decades(first: int, last: int) -> tuple[float, ...]:
    """10^first, 10^(first - 1), …, 10^last."""
    return tuple(10.0**power for power in range(first, last - 1, -1))


def crosscheck() -> list[LineCode]:
    """This project's solver: strips, to which the peers' points are nearest, then hats."""
    return [
        LineCode(f"crosscheck, {element}s", element, partial(_solved, element), decades(-12, -12))
        for element in ("strip", "hat")
    ]


def _solved(
    element: Literal["strip", "hat"], case: LineCase, _tolerance: float, _most: int
) -> LineAnswer:
    operator = operator_of(case.count, element, case.periodic)
    gap = case.hat_averages if element == "hat" else case.gaps
    weights = np.full(case.count, case.pitch)
    constraints = Constraints(load=case.load)
    solution = solve_contact(operator, case.pitch * gap, weights, constraints)
    return LineAnswer(solution.pressure, solution.iterations["applications"])


def tamaas() -> list[LineCode]:
    """Tamaas' line model and its Polonsky-Keer solver (Rey et al. 2017).

    Of what Tamaas 2.9 offers on a line this is the fastest: with gaps for pressures as unknowns it
    takes hundreds of times as long, by its saturated solver tens of times. Its solvers for friction
    and its operator for an unbounded surface refuse a line. Raises AbsentError.
    """
    try:
        import tamaas
    except ImportError as missing:
        raise AbsentError("Tamaas is not installed: pip install tamaas") from missing
    tamaas.set_log_level(tamaas.LogLevel.error)

    def solve(case: LineCase, tolerance: float, most: int) -> LineAnswer:
        length = case.pitch * case.count
        kind = tamaas.model_type.basic_1d
        model = tamaas.ModelFactory.createModel(kind, [length], [case.count])
        model.E, model.nu = 1.0, 0.0
        solver = tamaas.PolonskyKeerRey(model, case.heights, tolerance)
        solver.max_iter = most
        solver.solve(case.load / length)
        return LineAnswer(model.traction.copy(), None)

    return [LineCode(f"Tamaas {tamaas.__version__}", "point", solve, decades(-7, -15))]


def contact_mechanics() -> list[LineCode]:
    """ContactMechanics' periodic line by NuMPI, which comes with it.

    Polonsky and Keer's conjugate gradients under a given load with restarts, often faster than
    those of ContactMechanics itself. Raises AbsentError.
    """
    try:
        import ContactMechanics
        from NuMPI.Optimization import constrained_conjugate_gradients_with_restart
    except ImportError as missing:
        raise AbsentError(
            "ContactMechanics is not installed: pip install ContactMechanics"
        ) from missing

    @cache
    def body(count: int, length: float):
        return ContactMechanics.PeriodicFFTElasticHalfSpace((count,), 1.0, (length,))

    def solve(case: LineCase, tolerance: float, most: int) -> LineAnswer:
        substrate = body(case.count, case.pitch * case.count)
        mean = case.load / case.count
        with contextlib.redirect_stdout(io.StringIO()):  # it prints warnings
            result = constrained_conjugate_gradients_with_restart(
                lambda force: substrate.evaluate_disp(-force) - case.heights,
                lambda force: substrate.evaluate_disp(-force),
                np.full(case.count, mean),
                jac=False,
                mean_val=mean,
                gtol=tolerance * np.ptp(case.heights),
                maxiter=most,
            )
        return LineAnswer(result.x / case.pitch, result.nit)

    name = f"ContactMechanics {ContactMechanics.__version__}"
    return [LineCode(name, "point", solve, decades(-6, -13))]
