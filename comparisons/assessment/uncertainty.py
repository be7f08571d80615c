"""The uncertainty of a figure: by cause, and how the causes add up.

Discretisation comes from a sequence of refined grids. Each level halves the element size of the one
before. From the last three values f3, f2, f1 (finest last) follow the observed order p and the grid
convergence index (Roache 1998, chapter 5; order limited as in Eça and Hoekstra 2014):

    d21 = f1 - f2, d32 = f2 - f3     p = log2(d32 / d21)     U = F d / (2^p - 1),  F = 1.25

with p limited to [LOWEST_ORDER, formal order] and d the larger of |d21| and |d32| / 2^formal, so
that two values which happen to agree do not pass for convergence.

Most sequences show no order: the error of a contact depends on where its edge falls between two
nodes, another place on each level, so that it is a power of the element size times a factor of
either sign. The power is at least 1, which the square root at the edge leaves to the worst of
figures. Where a sequence oscillates, or falls faster than its formal order, U is d itself; Roache's
3 d / (2^formal - 1), for two grids, is the same for a formal order of 2. Measured on 1170 figures
of 280 contacts with exact answers and numbers of elements drawn at random: 96 % of the errors are
covered, half of the uncertainties are less than 4.0 times the error.

A far boundary, too, is judged by its effect: what halving its distance changes is as many times
smaller than what is left of it as a step of refinement of order 1/2 would be. Stresses below a held
block's contact were seen to go with order 0.5 to 1 of its size.

A sequence that has settled to round-off gets what is left of its differences, and no figure an
uncertainty below the `resolution` that it is read with: three grids may share a wrong digit.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from comparisons.models.level import Level

LOWEST_ORDER = 1.0
FACTOR = 1.25  # of safety, on three grids
DOMAIN = 1.0 / (2.0**0.5 - 1.0)  # of the change that half the distance makes
TWO_GRIDS = 3.0  # of safety, where the order is not observed (Roache 1998)
ROUND_OFF = 1e-12  # relative differences below this are round-off
ORDER_MARGIN = 0.25  # an order this little beyond its limits is still regular

# A contact residual r leaves errors of up to this multiple of r in the pressures: 1e-6 of the
# displacements' range was seen to leave 2e-3.
PRESSURE_PER_RESIDUAL = 2e3
# Of a pitch: how well `contact_patches` finds the edge of a smooth contact between two nodes, at
# any place of it and on every level (0.047 at worst in 280 contacts).
EDGE_FOUND = 0.05
LENGTHS = ("contact_length", "contact_ratio")  # quantities that are read with that resolution

Behaviour = Literal[
    "settled", "monotone", "irregular", "oscillating", "diverging", "too few levels"
]


@dataclass(frozen=True)
class Convergence:
    """A figure's limit under refinement.

    value        on the finest level, in the figure's unit
    limit        Richardson's value where the sequence is monotone, else `value`
    uncertainty  of `value`, absolute; infinite when fewer than three levels are known
    order        observed order, None where it has no meaning
    behaviour    how the last three values follow each other
    """

    value: float
    limit: float
    uncertainty: float
    order: float | None
    behaviour: Behaviour


def grid_convergence(
    values: Sequence[float], formal_order: float, resolution: float = 0.0
) -> Convergence:
    """Convergence of `values` (coarse to fine, each level of half the size).

    resolution  least uncertainty with which the figure can be read on the finest grid, in its unit
    """
    value = float(values[-1])
    if len(values) < 3:
        return Convergence(value, value, np.inf, None, "too few levels")
    coarse, middle, fine = (float(v) for v in values[-3:])
    last, before = fine - middle, middle - coarse
    scale = max(abs(coarse), abs(middle), abs(fine))
    if max(abs(last), abs(before)) <= ROUND_OFF * scale:
        left = max(abs(last), abs(before), resolution)
        return Convergence(value, value, left, None, "settled")
    change = max(abs(last), abs(before) / 2.0**formal_order)
    if last * before < 0.0:
        return Convergence(value, value, max(change, resolution), None, "oscillating")
    observed = float(np.log2(abs(before) / abs(last))) if last != 0.0 != before else None
    if last == 0.0 or (observed is not None and observed > formal_order + ORDER_MARGIN):
        return Convergence(value, value, max(change, resolution), observed, "irregular")
    order = float(np.clip(observed or LOWEST_ORDER, LOWEST_ORDER, formal_order))
    uncertainty = max(FACTOR * change / (2.0**order - 1.0), resolution)
    if observed is None or 0.0 < observed < LOWEST_ORDER - ORDER_MARGIN:
        return Convergence(value, value, uncertainty, observed, "irregular")
    if observed <= 0.0:
        return Convergence(value, value, uncertainty, observed, "diverging")
    limit = fine + last / (2.0**order - 1.0)
    return Convergence(value, limit, uncertainty, observed, "monotone")


@dataclass(frozen=True)
class Uncertainty:
    """Relative uncertainty of a figure, by cause; `convergence` says how refinement went."""

    iteration: float
    discretisation: float
    domain: float
    convergence: Convergence

    @property
    def total(self) -> float:
        """Sum of the parts: they are bounds, not random."""
        return self.iteration + self.discretisation + self.domain


# How the parts are composed, one function a rule.


def largest_iteration(*levels: Level) -> float:
    """Relative, of pressures, by the largest contact residual: figures of one model, norms of two
    models, effects, and claims of the paper."""
    return PRESSURE_PER_RESIDUAL * max(level.solution.residuals.worst for level in levels)


def summed_iteration(*levels: Level) -> float:
    """Relative, of pressures, by the sum of contact residuals: the models' difference on a map."""
    return PRESSURE_PER_RESIDUAL * sum(level.solution.residuals.worst for level in levels)


def far_boundary(moved: float, first: float = 0.0) -> float:
    """In the figure's unit, by its values on the coarsest level with a block of half the size and
    with the whole one: everywhere. For a norm of their difference `moved` is that norm."""
    return DOMAIN * abs(moved - first)


def length_resolution(pitch: float, patches: int) -> float:
    """How finely the length of contact [m] in a number of patches can be read: one model's length,
    in a run and in `verify`.

    The errors of a patch's two edges may add; those of different patches are independent.
    """
    return 2.0 * EDGE_FOUND * pitch * float(np.sqrt(patches))


def effect_discretisation(values: Sequence[float], formal_order: float, resolution: float) -> float:
    """Of an effect by `grid_convergence`; on two levels by the lowest order, on one infinite."""
    if len(values) == 2:
        change = abs(float(values[-1]) - float(values[-2]))
        return max(TWO_GRIDS * change / (2.0**LOWEST_ORDER - 1.0), resolution)
    return grid_convergence(values, formal_order, resolution).uncertainty


def effect_resolution(level: Level) -> float:
    """The same of an effect, relative: two lengths on one grid, taken to err in opposite ways."""
    return 2.0 * length_resolution(level.grid.pitch, len(level.patches)) / level.contact_length


def relative_resolution(one: Level, other: Level) -> float:
    """The same of (one - other) / other: the models' difference on a map."""
    edges = [length_resolution(level.grid.pitch, len(level.patches)) for level in (one, other)]
    ratio = one.contact_length / other.contact_length
    return (edges[0] + ratio * edges[1]) / other.contact_length


def difference_of_figures(own: float, ratio: float, reference: float) -> float:
    """Of (figure - reference) / reference, in a run's comparison and in the model error.

    own        uncertainty of the figure, relative to the reference
    ratio      figure over reference
    reference  relative uncertainty of the reference. It counts |ratio| times, to first order, and
               not less than whole: a figure that vanishes says nothing of its reference.
    """
    return own + max(1.0, abs(ratio)) * reference


def difference_of_norms(refined: float, domain: float, parts: tuple[float, ...]) -> float:
    """Of the norm of the half-plane against the whole model: by its own refinement and the far
    boundary, or after the triangle's inequality by its `parts`, for norms of two levels may agree
    by chance."""
    return max(refined + domain, sum(parts))
