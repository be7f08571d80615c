"""The numbers that judge the claims, each read off one model's level (`views.View`).

Lengths in a, stresses in p0, shares and ratios without a unit. "Smooth maximum" is the largest
tau1 of the smooth contact without friction, 0.3003 p0.
"""

import numpy as np

from comparisons.studies.paper.claims.measures import (
    agreement_depth,
    highest_point,
    joining_level,
    share_joined,
    top_of_zone,
    valley,
)
from comparisons.studies.paper.claims.views import Reading, View

NEAR, DEEP = 0.1, 0.5  # a: asperities shear above the one, the smooth contact below the other
ALIKE = 0.05  # of the smooth maximum: fields nearer to each other than that are alike
HALF, CORE = 0.5, 0.8  # of the smooth maximum: what counts as highly sheared; as the core of it
SLIDING = 0.1  # friction of the paper's sliding contacts


def contact_ratio(view: View) -> float:
    """Sum of the contact patches over 2a."""
    return 0.5 * view.level.contact_length / view.problem.hertz.half_width


def peak_pressure(view: View) -> float:
    return float(view.level.solution.pressure.max() / view.problem.hertz.peak_pressure)


def carried(view: View) -> float:
    """Integral of the pressures over the load."""
    grid, hertz = view.level.grid, view.problem.hertz
    return float(grid.weights @ view.level.solution.pressure / hertz.load_per_length)


def pressed_beyond(limit: float) -> Reading:
    """Share of the contact patches whose peak pressure exceeds `limit` [p0]."""

    def reading(view: View) -> float:
        x, pressure = view.level.grid.x, view.level.solution.pressure
        most = limit * view.problem.hertz.peak_pressure
        peaks = [pressure[_within(x, patch)].max() for patch in view.level.patches]
        return float(np.mean(np.array(peaks) > most))

    return reading


def sheared_beyond(limit: float) -> Reading:
    """Share of the contact patches under which tau1 exceeds `limit` smooth maxima."""

    def reading(view: View) -> float:
        tau1 = view.stress(0.0).tau1[view.z <= NEAR]
        x = view.x * view.problem.hertz.half_width
        peaks = [tau1[:, _within(x, patch)].max() for patch in view.level.patches]
        return float(np.mean(np.array(peaks) > limit * view.smooth_maximum))

    return reading


def largest(name: str, friction: float = 0.0) -> Reading:
    """Largest tau1 | txz [p0]."""
    return lambda view: view.extreme(name, friction).value


def largest_over_smooth(view: View) -> float:
    return view.extreme("tau1", 0.0).value / view.smooth_maximum


def depth_of_largest(view: View) -> float:
    return view.extreme("tau1", 0.0).z


def largest_near(view: View) -> float:
    """Largest tau1 of the asperities, down to NEAR, in smooth maxima."""
    tau1 = view.stress(0.0).tau1
    return float(tau1[highest_point(tau1, _near(view))] / view.smooth_maximum)


def depth_of_largest_near(view: View) -> float:
    row, _ = highest_point(view.stress(0.0).tau1, _near(view))
    return float(view.z[row])


def depth_of_agreement(view: View) -> float:
    """Depth below which tau1 is nowhere more than ALIKE smooth maxima from the smooth field."""
    difference = view.stress(0.0).tau1 - view.smooth(0.0).tau1
    return agreement_depth(view.z, difference, ALIKE * view.smooth_maximum)


def section_agreement(view: View) -> float:
    """The same on the vertical through the peak asperity alone."""
    difference = view.stress(0.0).tau1 - view.smooth(0.0).tau1
    column = difference[:, [peak_column(view)]]
    return agreement_depth(view.z, column, ALIKE * view.smooth_maximum)


def peak_column(view: View) -> int:
    """Column of the largest tau1 of the asperities without friction."""
    return highest_point(view.stress(0.0).tau1, _near(view))[1]


def low_layer(view: View) -> float:
    """Least tau1 between asperity and depth on that vertical, over the smaller of both maxima."""
    column = view.stress(0.0).tau1[:, peak_column(view)]
    shallow = np.argmax(np.where(view.z <= NEAR, column, -np.inf))
    deep = np.argmax(np.where(view.z >= DEEP, column, -np.inf))
    return valley(column, int(shallow), int(deep))


def reach_against_smooth(level: float) -> Reading:
    """How much nearer to the surface what is joined with the Hertz zone at `level` smooth maxima
    comes than in the smooth contact, without friction [a]."""

    def reading(view: View) -> float:
        rough, smooth = (stress.tau1 for stress in (view.stress(0.0), view.smooth(0.0)))
        return _reach(view, smooth, level) - _reach(view, rough, level)

    return reading


def open_to_surface(friction: float) -> Reading:
    """Highest level at which the Hertz zone is joined with the surface, in smooth maxima."""

    def reading(view: View) -> float:
        tau1 = view.stress(friction).tau1
        surface = np.zeros(tau1.shape, dtype=bool)
        surface[0] = True
        return joining_level(tau1, _hertz_zone(view, tau1), surface) / view.smooth_maximum

    return reading


def joined(friction: float) -> Reading:
    """Of what the asperities shear beyond HALF, the share joined with the Hertz zone."""

    def reading(view: View) -> float:
        tau1 = view.stress(friction).tau1
        part = _near(view) & (np.abs(view.x) <= 1.0)
        level = HALF * view.smooth_maximum
        return share_joined(tau1, view.weights, level, _hertz_zone(view, tau1), part)

    return reading


def edge_shear(friction: float) -> Reading:
    """Mean of tau1 over the depth below x = +a [p0]."""

    def reading(view: View) -> float:
        column = view.stress(friction).tau1[:, np.argmin(np.abs(view.x - 1.0))]
        return float(view.weights[:, 0] @ column / np.sum(view.weights))

    return reading


def edge_ratio(view: View) -> float:
    """That with friction over that without."""
    return edge_shear(SLIDING)(view) / edge_shear(0.0)(view)


def _reach(view: View, tau1: np.ndarray, level: float) -> float:
    level = level * view.smooth_maximum
    return top_of_zone(view.z, tau1, level, _hertz_zone(view, tau1))


def _hertz_zone(view: View, tau1: np.ndarray) -> tuple[int, int]:
    """Place of the largest tau1 below DEEP."""
    return highest_point(tau1, (view.z >= DEEP)[:, None])


def _near(view: View) -> np.ndarray:
    return (view.z <= NEAR)[:, None]


def _within(x: np.ndarray, patch: np.ndarray) -> np.ndarray:
    """Points of a patch; the nearest one where none lies in it."""
    inside = (x >= patch[0]) & (x <= patch[1])
    if not np.any(inside):
        inside[np.argmin(np.abs(x - patch.mean()))] = True
    return inside
