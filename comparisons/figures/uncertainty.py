"""The uncertainty of a figure: by cause, and how uncertainties are composed. All of it is here.

    iteration       by what is left of the contact conditions
    discretisation  by the sequence of levels (`comparisons.figures.convergence`), of pressures and
                    shears at a crest at least what a finer grid makes of it
                    (`comparisons.models.crest`): there levels have no limit that a fit could know
    domain          DOMAIN times what halving the distance D of the far boundary changes: all of
                    its effect, where that goes with D^-0.5. Stresses below the contact of a held
                    block were seen to go with D^-0.5 to D^-1
    increments      of a load under which a body flows, by the coarsest level solved again with
                    increments twice and four times as long. In one increment an edge of contact
                    travels over a pressure element: refinement of the mesh leaves their error

One rule composes them: every part bounds an error of unknown sign, and bounds add linearly,

    U(figure) = iteration + discretisation + domain + increments
    U(sum of c f) = sum of |c| U(f)

Roots of sums of squares would need errors that are independent of each other. These are not: both
models have the same pressure elements, all levels the same solver and block, and an error that
refinement has not shown yet shows in several parts at once. So it is for a model's figures, for
effects and model errors, and for points of maps.

A difference of two solutions on the same pressure elements, or its norm, is a figure with a
sequence of its own: what these elements leave out is in both. Against exact values (zero, in 40
figures of smooth and rough contacts that both models solved) all are covered so, on median by 4.8
times the error; by the sum of both models' own discretisations, 18 times. What they lack of a crest
is not in both alike: it counts in the difference as in either model.

No figure has an uncertainty of discretisation below the resolution that it is read with."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import reduce
from operator import add

import numpy as np

from analytic.contact.problem import ContactSolution
from comparisons.figures.convergence import TWO_GRIDS, Convergence, grid_convergence

COVERAGE = 0.95  # of true errors by stated uncertainties: what `verify` demands and measures
DOMAIN = 1.0 / (2.0**0.5 - 1.0)  # of the change that half the distance makes
# A contact residual r leaves errors of up to this multiple of r in the pressures: 1e-6 of the
# displacements' range was seen to leave 2e-3.
PRESSURE_PER_RESIDUAL = 2e3
# Of a pitch: how well `contact_patches` finds the edge of a smooth contact between two nodes, at
# any position of it and on every level (0.047 at worst in 280 contacts).
EDGE_FOUND = 0.05


@dataclass(frozen=True)
class Uncertainty:
    """Uncertainty of a figure, relative to its scale: bounds by cause, whose sum is the `total`;
    infinite where one is unknown, none where exact. `convergence` says how refinement went."""

    parts: Mapping[str, float] = field(default_factory=dict)
    convergence: Convergence | None = None

    @property
    def total(self) -> float:
        return reduce(add, self.parts.values(), 0.0)


@dataclass(frozen=True)
class Reading:
    """Reading of a quantity: what is known of its figure beside the values on the levels."""

    order: float  # formal, of its convergence
    # [SI] of the figure, or what a difference is over; all else is relative to it
    scale: float = 1.0
    resolution: float = 0.0  # how finely it is read
    iteration: float = 0.0  # what is left of the contact conditions
    least: float = 0.0  # of what discretisation leaves
    tolerance: float | None = None  # of what is judged
    place: tuple[float, ...] | None = None


def by_levels(
    values: Sequence[float], reading: Reading, repeated: tuple[float, float], unit: float
) -> Uncertainty:
    """Uncertainty of a figure by its values on the levels, coarse to fine, and by what far boundary
    and increments of flow leave of it; a `unit` of these is the scale."""
    known = grid_convergence(values, reading.order, reading.resolution * unit)
    domain, increments = (size / unit for size in repeated)
    left = max(known.uncertainty / unit, reading.least)
    parts = {"iteration": reading.iteration, "discretisation": left}
    return Uncertainty(parts | {"domain": domain, "increments": increments}, known)


def iteration(*solutions: ContactSolution) -> float:
    """Relative, of pressures and what follows from them, by the contact residuals of all that a
    figure, a difference or a norm is made from."""
    return PRESSURE_PER_RESIDUAL * sum(solution.residuals.worst for solution in solutions)


def far_boundary(moved: float, first: float) -> float:
    """Uncertainty by the far boundary, in the figure's unit, from its values on the coarsest level
    with a block of half the size and with the full one."""
    return DOMAIN * abs(moved - first)


def of_increments(values: Sequence[float]) -> float:
    """Uncertainty by increments, in the figure's unit, from its values on the coarsest level with
    increments that halve, the last as on all levels. The error is of order one in their length;
    each change shows how large, and the largest counts with the factor of safety of two grids."""
    changes = np.abs(np.diff(values)) / 2.0 ** np.arange(len(values) - 2, -1, -1)
    return TWO_GRIDS * float(changes.max(initial=0.0))


def length_resolution(pitch: float, patches: int) -> float:
    """Resolution of the length of contact [m] in a number of patches on a grid. The errors
    of a patch's two edges may add; those of different patches are independent."""
    return 2.0 * EDGE_FOUND * pitch * float(np.sqrt(patches))


def peak_resolution(pressure: np.ndarray) -> float:
    """Resolution of the largest pressure from nodal pressures (n,), relative to it. Two
    models have their peaks at different points between the nodes. Off by half a pitch, a node is an
    eighth of the second difference too low, and so is an interpolation to other nodes."""
    top = int(np.argmax(pressure))
    before, high, after = np.pad(pressure, 1)[top : top + 3]
    return float(2.0 * (2.0 * high - before - after) / 8.0 / high) if high > 0.0 else 0.0


def difference_of_figures(figure: float, ratio: float, reference: float) -> float:
    """Uncertainty of (figure - reference) / reference, in the comparison and in the model error.

    figure     uncertainty of the figure, relative to the reference
    ratio      figure over reference
    reference  relative uncertainty of the reference. It counts |ratio| times, to first order, and
               once at least: a figure that vanishes says nothing of its reference."""
    return figure + max(1.0, abs(ratio)) * reference
