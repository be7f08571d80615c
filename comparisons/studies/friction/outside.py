"""Tractions of answers from outside beside a model's, at the end of the scene's path of loads."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from analytic.numerics import runs_of
from comparisons.figures.convergence import REGULAR
from comparisons.figures.figure import Figure
from comparisons.figures.uncertainty import Uncertainty
from comparisons.judging.rule import relative_l2
from comparisons.studies.answers.answer import Answer
from comparisons.studies.friction.half_planes import SlippedLevel

# Of friction times pressure: tractions below it are taken for those of sticking. Next to the end of
# a zone they rise like a root, so that this is half a per cent of its length off; of both alike.
STUCK = 0.9


def outside_figures(
    answers: Mapping[str, tuple[Answer, ...]],
    levels: Sequence[SlippedLevel],
    model: Figure,
    tolerance: float,
) -> Iterator[Figure]:
    """Figures of the finest answer of each name that has tractions: the length that sticks, its
    difference from a `model`'s, and the relative L2 norm of both tractions' difference there.

    Both lengths are read in one way, each end of a zone to the spacing of the answer's points. The
    norm's uncertainty is what these points leave out of the model's own traction, and what the
    last level changed of that traction, whose error is of first order."""
    grid, state = levels[-1].grid, levels[-1].states[-1]
    traction = state.traction
    reference, _ = _stuck(state.normal.pressure, traction, model.friction, grid.pitch)
    for name, resolutions in answers.items():
        answer = resolutions[-1]
        if answer.shear is None:
            continue
        pressure = answer.on(grid.x)
        shear = np.where(pressure > 0.0, np.interp(grid.x, answer.x, answer.shear), 0.0)
        length, zones = _stuck(pressure, shear, model.friction, grid.pitch)
        read = 2.0 * answer.spacing * max(1, zones) ** 0.5
        common = {"study": model.study, "source": name, "at": model.at}
        scale = length or grid.pitch
        yield Figure(
            quantity=model.quantity,
            value=length,
            scale=scale,
            uncertainty=Uncertainty({"answer": read / scale}),
            **common,
        )
        stated = Uncertainty({"answer": read / model.scale, "model": model.numerical})
        yield Figure(
            quantity=model.quantity,
            value=(length - reference) / model.scale,
            against=model.source,
            scale=model.scale,
            uncertainty=stated,
            bounds=(-tolerance, tolerance),
            **common,
        )
        seen = np.interp(answer.x, grid.x, traction, left=0.0, right=0.0)
        left, refined = relative_l2(np.interp(grid.x, answer.x, seen), traction), np.inf
        for before in levels[-2:-1]:
            coarser = np.interp(grid.x, before.grid.x, before.states[-1].traction)
            refined = REGULAR * relative_l2(coarser, traction)
        yield Figure(
            quantity="traction_l2",
            value=relative_l2(shear, traction),
            against=model.source,
            uncertainty=Uncertainty({"answer": left, "model": refined}),
            **common,
        )


def _stuck(
    pressure: np.ndarray, shear: np.ndarray, friction: float, pitch: float
) -> tuple[float, int]:
    """Length [m] that sticks, and number of zones, of tractions (n,) [Pa] on a grid."""
    held = (pressure > 0.0) & (np.abs(shear) < STUCK * friction * pressure)
    first, after = runs_of(held)
    return float(pitch * (after - first).sum()), len(first)
