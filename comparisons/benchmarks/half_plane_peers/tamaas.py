"""Tamaas under comparison: its line model and its Polonsky-Keer solver (Rey et al. 2017).

Of what Tamaas 2.9 offers on a line this is the fastest: with gaps for pressures as unknowns it
takes hundreds of times as long, by its saturated solver tens of times. Its solvers for friction
and its operator for a surface without end refuse a line.
"""

from comparisons.benchmarks.half_plane_peers.cases import Case
from comparisons.benchmarks.half_plane_peers.code import AbsentError, Answer, Code, decades


def codes() -> list[Code]:
    """Raises AbsentError where Tamaas is not installed."""
    try:
        import tamaas
    except ImportError as missing:
        raise AbsentError("Tamaas is not installed: pip install tamaas") from missing
    tamaas.set_log_level(tamaas.LogLevel.error)

    class Steps(tamaas.Functional):
        """Adds nothing to what is minimised and counts how often its gradient is asked for."""

        def __init__(self) -> None:
            super().__init__()
            self.taken = 0

        def computeF(self, *_) -> float:
            return 0.0

        def computeGradF(self, *_) -> None:
            self.taken += 1

    def run(case: Case, tolerance: float, most: int, steps: Steps | None) -> Answer:
        model = tamaas.ModelFactory.createModel(
            tamaas.model_type.basic_1d, [case.pitch * case.count], [case.count]
        )
        model.E, model.nu = 1.0, 0.0
        solver = tamaas.PolonskyKeerRey(model, case.heights, tolerance)
        solver.max_iter = most
        if steps is not None:
            solver.addFunctionalTerm(steps)
        solver.solve(case.load / (case.pitch * case.count))
        return Answer(model.traction.copy(), None)

    def solve(case: Case, tolerance: float, most: int) -> Answer:
        return run(case, tolerance, most, None)

    def count(case: Case, tolerance: float, most: int) -> int:
        steps = Steps()
        run(case, tolerance, most, steps)
        return steps.taken

    return [Code(f"Tamaas {tamaas.__version__}", "point", solve, decades(-7, -15), count)]
