"""Stated uncertainties held to true errors: one pair for each case, quantity and model."""

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from comparisons.assessment.comparison import figures, relative_l2, uncertainties
from comparisons.assessment.refinement import refined
from comparisons.common.progress import ProgressCallback, no_progress
from comparisons.common.quantities import QUANTITIES
from comparisons.models.level_cache import level_cache
from comparisons.models.plan import make_plan
from comparisons.models.problem import problem_of
from comparisons.models.window import window_of
from comparisons.scenes.resolve import resolve_tables
from comparisons.studies.verify.scenes import ROUND_OFF, ExactScene

LEAST_COVERAGE = 0.95
WIDEST = 5.0  # median of stated uncertainty over true error
FEWEST = 200  # pairs that tell
# Largest relative error of a figure on the third level, three to five times what is met.
CEILINGS = {
    "peak_pressure": 1e-3,
    "contact_length": 5e-3,
    "tau1_max": 1e-2,
    "tau1_max_depth": 5e-2,
    "txz_max_abs": 5e-3,
    "mean_gap": 1e-3,
}
# Of tau1_max where the whole surface in contact shears alike, so that the elements' own waves next
# to the edge decide on the largest: 1 to 3 % too large at any resolution.
SURFACE_CEILING = 0.06


@dataclass(frozen=True)
class Pair:
    """One figure of one model against its exact value.

    kind         of the case: Hertz | surface | sliding | hardness | layer | wave | punch
    levels       figures on all levels, coarse to fine [SI]
    exact        [SI]
    uncertainty  as stated, relative to `scale`: iteration, discretisation, domain
    scale        [SI] what errors are relative to: the figure, or the smooth contact's where the
                 figure vanishes
    behaviour    of the levels, by `comparisons.assessment.uncertainty`
    order        observed, None where it means nothing
    converged    all levels met their contact conditions
    """

    case: str
    source: str
    kind: str
    model: str
    quantity: str
    levels: tuple[float, ...]
    exact: float
    uncertainty: tuple[float, float, float]
    scale: float
    behaviour: str
    order: float | None
    converged: bool

    @property
    def stated(self) -> float:
        """Stated uncertainty, relative."""
        return sum(self.uncertainty)

    @property
    def error(self) -> float:
        """True error, relative, with its sign."""
        return (self.levels[-1] - self.exact) / self.scale

    @property
    def tells(self) -> bool:
        """Whether the error is more than rounding: else it is covered, and has no width."""
        return bool(abs(self.error) > ROUND_OFF)

    @property
    def covered(self) -> bool:
        return bool(abs(self.error) <= max(self.stated, ROUND_OFF))

    @property
    def width(self) -> float | None:
        """Stated uncertainty over true error; None where the error is rounding."""
        return self.stated / abs(self.error) if self.tells else None

    @property
    def ceiling(self) -> float:
        """Largest relative error that it may have."""
        if (self.kind, self.quantity) == ("surface", "tau1_max"):
            return SURFACE_CEILING
        return CEILINGS[self.quantity]

    @property
    def close(self) -> bool:
        """Whether the figure itself is right, however its uncertainty is stated."""
        return bool(self.converged and abs(self.error) <= self.ceiling)

    def as_dict(self) -> dict:
        """For verify.json."""
        iteration, discretisation, domain = self.uncertainty
        return {
            "case": self.case,
            "kind": self.kind,
            "model": self.model,
            "quantity": self.quantity,
            "levels": list(self.levels),
            "exact": self.exact,
            "error": self.error,
            "uncertainty": {
                "iteration": iteration,
                "discretisation": discretisation,
                "domain": domain,
                "total": self.stated,
            },
            "covered": self.covered,
            "width": self.width,
            "behaviour": self.behaviour,
            "order": self.order,
            "close": self.close,
            "source": self.source,
        }


@dataclass(frozen=True)
class Coverage:
    """Of some pairs: `count`, how many of them `tell` more than rounding, the share of those that
    is `covered`, and median and 90 % quantile of their `width`s; NaN where none tells."""

    count: int
    tell: int
    covered: float
    median_width: float
    large_width: float

    @property
    def holds(self) -> bool:
        return self.covered >= LEAST_COVERAGE and self.median_width <= WIDEST


def coverage(pairs: Iterable[Pair]) -> Coverage:
    """Pairs whose error is rounding are left out of both statistics: they would only flatter."""
    pairs = list(pairs)
    telling = [pair for pair in pairs if pair.tells]
    if not telling:
        return Coverage(len(pairs), 0, np.nan, np.nan, np.nan)
    widths = [pair.width for pair in telling]
    return Coverage(
        len(pairs),
        len(telling),
        float(np.mean([pair.covered for pair in telling])),
        float(np.median(widths)),
        float(np.quantile(widths, 0.9)),
    )


@dataclass(frozen=True)
class Solved:
    """A scene solved by one model: its `pairs`, and relative L2 errors of the pressures on all
    levels where those are known."""

    pairs: tuple[Pair, ...]
    pressure_errors: tuple[float, ...] | None


def solved(scene: ExactScene, model: str, callback: ProgressCallback = no_progress) -> Solved:
    """Solve a scene with one model, as `run` does, and hold each figure to the exact one."""
    resolved = resolve_tables(
        scene.tables, name="verify", folder=Path("."), source=f"verify: {scene.name}"
    )
    problem = problem_of(resolved)
    plan = make_plan(problem, (model,))
    window = window_of(problem) if plan.stress else None
    with TemporaryDirectory(prefix="crosscheck-") as folder:
        checkpoint = level_cache(Path(folder) / "run", resolved, plan)
        runs, _ = refined(problem, plan, window, checkpoint, callback)
    run, (friction,) = runs[model], resolved.friction
    stated = uncertainties(run, problem, friction)
    history = [figures(level, problem, friction) for level in run.levels]
    pairs = []
    for quantity, exact in scene.exact.items():
        parts = stated[quantity]
        value = history[-1][quantity]
        pairs.append(
            Pair(
                case=scene.name,
                source=scene.source,
                kind=scene.kind,
                model=model,
                quantity=quantity,
                levels=tuple(level[quantity] for level in history),
                exact=float(exact),
                uncertainty=(parts.iteration, parts.discretisation, parts.domain),
                scale=abs(value) or QUANTITIES[quantity].scale(problem.hertz),
                behaviour=parts.convergence.behaviour,
                order=parts.convergence.order,
                converged=all(level.solution.converged for level in run.levels),
            )
        )
    errors = None
    if scene.pressure is not None:
        errors = tuple(
            relative_l2(level.solution.pressure, scene.pressure(level.grid.x))
            for level in run.levels
        )
    return Solved(tuple(pairs), errors)
