"""The half-plane with a cap on its pressure, judged by finite elements that flow.

In: the levels of a whole model that flows. Out: the caps with which the half-plane has its contact
length, or its peak pressure, over the yield stress Y; and what each cap leaves wrong.

A metal that flows bears about 3 Y where elastic metal confines it (Tabor), less next to first flow
and under friction. Contact length and mean pressure have one cap, for the load is the same. A peak
pressure is a mean over neighbouring elements (`fem.nonlinear.press_plastic`)."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.optimize import brentq

from analytic.contact.patches import contact_patches
from analytic.contact.problem import ContactError
from analytic.grid import HatGrid
from analytic.operators.tangential import CoupledHalfPlane
from comparisons.common.numbers import percent, plain, significant, with_unit
from comparisons.drawing.blocks import TextTable
from comparisons.figures.convergence import grid_convergence
from comparisons.figures.figure import Figure, Figures
from comparisons.figures.quantity import QUANTITIES as COMPARED
from comparisons.figures.quantity import WHOLE, Quantity
from comparisons.figures.uncertainty import Uncertainty, length_resolution, of_increments
from comparisons.models.problem import Problem, pressed_on
from comparisons.studies.model_error.estimates import TABOR
from comparisons.studies.model_error.model_error import Solutions
from comparisons.studies.model_error.quantities_of_interest import quantities_of

BY_LENGTH, BY_PEAK, OF_SCENE = "cap by length", "cap by peak", "cap of the scene"
OF_TABOR = f"cap of {TABOR:g} Y"
CAP, OVER_YIELD, MEAN = "cap", "cap_over_yield", "mean_pressure"
PEAK, LENGTH = "peak_pressure", "contact_length"
QUANTITIES = {
    CAP: Quantity("cap on the pressure", "Pa"),
    OVER_YIELD: Quantity("cap over yield stress, H/Y"),
    PEAK: COMPARED[PEAK],
    LENGTH: COMPARED[LENGTH],
    MEAN: Quantity("mean pressure of the contact", "Pa"),
}
SETTLED = 1e-4  # of a cap that is searched
BELOW = 0.8  # of the whole's mean pressure: the least cap that may give its contact length
NOTE = """Pressure cap: the half-plane with a cap on its pressure (*body.hardness*) against the
whole model, which flows. By length: the cap with which the half-plane has the whole's contact
length, and so its mean pressure; by peak: the largest pressure that the whole bears."""


@dataclass(frozen=True)
class _Flowing:
    """The whole model on one level, or by other increments, and the half-plane beside it."""

    problem: Problem
    grid: HatGrid
    length: float  # [m] of the whole's contact
    peak: float  # [Pa] its largest pressure

    def pressed(self, cap: float) -> tuple[float, float]:
        """Largest pressure [Pa] and contact length [m] of the half-plane under a cap [Pa]."""
        grid, problem = self.grid, self.problem
        operator = CoupledHalfPlane(grid.count, grid.pitch, problem.modulus, problem.coupling)
        solution = pressed_on(problem, grid, operator, replace(problem.constraints(), hardness=cap))
        patches = contact_patches(grid.x, solution.pressure, solution.gap)
        return float(solution.pressure.max()), float(np.ptp(patches, axis=1).sum())

    @cached_property
    def by_length(self) -> float | None:
        """The cap [Pa] that gives the whole's contact length; None where flow does not add to it.
        It lies between the whole's mean pressure and the elastic peak."""
        peak, shortest = self.pressed(np.inf)
        if shortest >= self.length:
            return None
        # edges are found between nodes: a contact all at its cap may seem shorter than it is
        least = BELOW * self.problem.hertz.load_per_length / self.length
        return brentq(
            lambda cap: self.pressed(cap)[1] - self.length, least, peak, rtol=SETTLED, xtol=1.0
        )

    def values(self, cap: float) -> dict[str, float]:
        """The cap, and relative to the whole, what the half-plane has wrong under it."""
        peak, length = self.pressed(cap)
        over_yield = cap / self.problem.scene.body.yield_stress
        wrong = {PEAK: peak / self.peak, LENGTH: length / self.length, MEAN: self.length / length}
        return {CAP: cap, OVER_YIELD: over_yield} | {n: ratio - 1.0 for n, ratio in wrong.items()}


def figures_of_caps(problem: Problem, solutions: Solutions) -> list[Figure]:
    """At one friction coefficient: each cap and, against the whole, what it leaves wrong."""
    try:
        return list(_figures(problem, solutions))
    except ContactError:
        return []  # a capped contact reaches the end of the pressure elements


def _figures(problem: Problem, solutions: Solutions) -> Iterator[Figure]:
    repeated, levels = _flowing(problem, solutions)
    scene, finest = problem.scene, levels[-1]
    of_scene = {OF_SCENE: scene.body.hardness} if scene.body.hardness else {}
    fixed = of_scene or {OF_TABOR: TABOR * scene.body.yield_stress}
    rows = {BY_PEAK: lambda solution: solution.peak}
    rows |= {name: lambda solution, cap=cap: cap for name, cap in fixed.items()}
    if all(solution.by_length is not None for solution in (*repeated, *levels)):
        rows = {BY_LENGTH: lambda solution: solution.by_length} | rows
    mean = problem.hertz.load_per_length / finest.length
    scales = {PEAK: finest.peak, LENGTH: finest.length, MEAN: mean}
    resolution = length_resolution(finest.grid.pitch, 1) / finest.length
    for name, cap_of in rows.items():
        first = [solution.values(cap_of(solution)) for solution in repeated]
        there = [solution.values(cap_of(solution)) for solution in levels]
        for quantity, value in there[-1].items():
            differs = quantity in scales
            scale = 1.0 if differs else value
            sequence = [solution[quantity] / scale for solution in there]
            increments = [solution[quantity] / scale for solution in first]
            least = resolution if quantity in (LENGTH, MEAN) else 0.0
            parts = {
                "discretisation": grid_convergence(sequence, 1.0, least).uncertainty,
                "increments": of_increments(increments) if first else np.inf,
            }
            yield Figure(
                study="yield",
                quantity=quantity,
                source=name,
                value=value,
                at={"friction": solutions.friction},
                against=WHOLE if differs else None,
                scale=scales.get(quantity, scale),
                uncertainty=Uncertainty(parts),
            )


def _flowing(problem: Problem, solutions: Solutions) -> tuple[list[_Flowing], list[_Flowing]]:
    """The whole on the coarsest level by longer increments and its own, empty where these have no
    solution; and on all of its levels."""
    elements = solutions.runs["finite_element"]
    grids = [level.grid for level in elements.levels]
    levels = solutions.of_scene if solutions.contains_all else solutions.wholes
    longer = solutions.longer
    if longer is None:  # the scene's own finite elements flow
        again = elements.longer_increments
        longer = [quantities_of(level, problem, solutions.friction) for level in again]
        longer += solutions.of_scene[:1] if longer else []

    def made(grid: HatGrid, solution: object) -> _Flowing:
        peak, length = solution.figures[PEAK].max(), solution.figures[LENGTH][0]
        return _Flowing(problem, grid, float(length), float(peak))

    return (
        [made(grids[0], solution) for solution in longer],
        [made(grid, solution) for grid, solution in zip(grids, levels, strict=False)],
    )


def cap_table(known: Figures, frictions: Sequence[float]) -> TextTable | None:
    """A row for each cap and friction coefficient; None without any."""
    rows = []
    for friction in frictions:
        there = known.of(friction=friction)
        for name in dict.fromkeys(figure.source for figure in there.of(quantity=CAP)):
            cap, over, *wrong = (
                there.one(quantity=quantity, source=name) for quantity in QUANTITIES
            )
            ratio = f"{significant(over.value, 3)} ± {percent(over.numerical)}"
            errors = (f"{_size(f)} ± {percent(f.numerical)}" for f in wrong)
            rows.append((name, plain(friction), with_unit(cap.value, "Pa", 3), ratio, *errors))
    head = ("cap", "friction", "H", "H/Y", "peak pressure", "contact length", "mean pressure")
    return TextTable("Half-plane with a pressure cap", head, tuple(rows)) if rows else None


def cap_sentence(known: Figures, friction: float) -> str:
    """What cap gives the contact length, and what it leaves; empty without one."""
    there = known.of(source=BY_LENGTH, friction=friction)
    over, peak = there.one(quantity=OVER_YIELD), there.one(quantity=PEAK)
    if over is None:
        return ""
    hardness = with_unit(there.one(quantity=CAP).value, "Pa", 3)
    return (
        f"body.hardness = {hardness}, {significant(over.value, 2)} Y ± {percent(over.numerical)}, "
        f"gives the half-plane the whole's contact length; its peak pressure is then {_size(peak)} "
        f"± {percent(peak.numerical)} off"
    )


def _size(error: Figure) -> str:
    return percent(error.value, signed=True, uncertainty=error.numerical)
