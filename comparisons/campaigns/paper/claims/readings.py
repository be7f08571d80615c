"""The numbers that judge the claims.

In: one level of one model (`LevelView`), and what claims.toml calls a reading with. Out: a number.

Lengths in a, stresses in p0: half-width and peak pressure of the smooth (Hertz) contact under the
same load. Shares and ratios have no unit. "Smooth maximum" is the largest tau1 of the smooth
contact without friction, 0.3003 p0."""

from dataclasses import dataclass

import numpy as np

from analytic.exact.hertz import hertz_stress
from analytic.operators.tangential import CoupledHalfPlane
from analytic.stress.field import friction_field
from analytic.stress.points import stress_at
from analytic.stress.potential import Element
from analytic.stress_state import Extremum, StressState
from comparisons.campaigns.paper.claims.zones import (
    agreement_depth,
    highest_point,
    joining_level,
    share_joined,
    top_of_zone,
)
from comparisons.models.level import Level
from comparisons.models.nearest_operator import solve_on
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.studies.comparison import layer_thickness
from comparisons.studies.quiescent_zone import QUIET, ShearDip, mean_shear, shear_dip, zone_of

NEAR, DEEP = 0.1, 0.5  # a: asperities shear above the one, the smooth contact below the other
AGREEMENT = 0.05  # of the smooth maximum: fields nearer to each other than that agree
HALF, CORE = 0.5, 0.8  # of the smooth maximum: what counts as highly sheared; as the core of it
SLIDING = 0.1  # friction of the paper's sliding contacts
ACROSS = np.array([0.0, 0.25, 0.48, 0.5, 0.52, 0.75])  # elements: both sides of edges too
SHALLOWEST = 0.02  # sampling intervals: the least depth at which the sum of elements is read
EDGE = 0.9  # a: farther out the elements' error at the edge of the contact shows
# Waves of a body that may bridge the quiescent zone [a]; their severity [p0] is the mean pressure
# that would close them, pi E* height / wavelength.
WAVES = np.geomspace(0.2, 0.8, 9)
SEVERITY = 2.0


@dataclass(frozen=True)
class LevelView:
    """What a number is read off: lengths in a, stresses in p0."""

    model: str  # half_plane | finite_element
    problem: Problem
    level: Level
    window: Window
    every: int = 1  # n: each n-th row and column of the window is read, x = 0 among them

    @property
    def columns(self) -> slice:
        return slice((len(self.window.x) // 2) % self.every, None, self.every)

    @property
    def rows(self) -> slice:
        return slice(None, None, self.every)

    @property
    def x(self) -> np.ndarray:
        """(k,) x/a of the window's columns."""
        return self.window.x[self.columns] / self.problem.hertz.half_width

    @property
    def z(self) -> np.ndarray:
        """(m,) z/a of the window's rows."""
        return self.window.z[self.rows] / self.problem.hertz.half_width

    @property
    def weights(self) -> np.ndarray:
        """(m, 1) depth [a] that each row stands for."""
        return layer_thickness(self.z)[:, None]

    @property
    def smooth_maximum(self) -> float:
        """Largest tau1 of the smooth contact without friction [p0]."""
        return self.problem.hertz.tau1_max / self.problem.hertz.peak_pressure

    def stress(self, friction: float) -> StressState:
        """(m, k) on the window [p0]."""
        field, p0 = self.level.stress(friction).field, self.problem.hertz.peak_pressure
        parts = (field.sx, field.sz, field.txz)
        return StressState(*(part[self.rows, self.columns] / p0 for part in parts))

    def smooth(self, friction: float) -> StressState:
        """(m, k) of the smooth contact, exact [p0]."""
        hertz = self.problem.hertz
        x, z = self.window.x[self.columns], self.window.z[self.rows, None]
        exact = hertz_stress(hertz, x, z, friction)
        return StressState(
            *(part / hertz.peak_pressure for part in (exact.sx, exact.sz, exact.txz))
        )

    def extreme(self, name: str, friction: float) -> Extremum:
        """Largest tau1 | |txz|, found off the grid: value [p0], x and z [a]."""
        extremum, hertz = self.level.stress(friction).extremes[name], self.problem.hertz
        a = hertz.half_width
        return Extremum(abs(extremum.value) / hertz.peak_pressure, extremum.x / a, extremum.z / a)


def contact_ratio(view: LevelView) -> float:
    """Sum of the contact patches over 2a."""
    return 0.5 * view.level.contact_length / view.problem.hertz.half_width


def peak_pressure(view: LevelView) -> float:
    return float(view.level.solution.pressure.max() / view.problem.hertz.peak_pressure)


def carried_load(view: LevelView) -> float:
    """Integral of the pressures over the load."""
    grid, hertz = view.level.grid, view.problem.hertz
    return float(grid.weights @ view.level.solution.pressure / hertz.load_per_length)


def pressed_beyond(view: LevelView, limit: float) -> float:
    """Share of the contact patches whose peak pressure exceeds `limit` [p0]."""
    x, pressure = view.level.grid.x, view.level.solution.pressure
    most = limit * view.problem.hertz.peak_pressure
    peaks = [pressure[_within(x, patch)].max() for patch in view.level.patches]
    return float(np.mean(np.array(peaks) > most))


def sheared_beyond(view: LevelView, limit: float) -> float:
    """Share of the contact patches under which tau1 exceeds `limit` smooth maxima."""
    tau1 = view.stress(0.0).tau1[view.z <= NEAR]
    x = view.x * view.problem.hertz.half_width
    peaks = [tau1[:, _within(x, patch)].max() for patch in view.level.patches]
    return float(np.mean(np.array(peaks) > limit * view.smooth_maximum))


def largest(view: LevelView, name: str, friction: float = 0.0) -> float:
    """Largest tau1 | txz [p0]."""
    return view.extreme(name, friction).value


def largest_over_smooth(view: LevelView) -> float:
    return view.extreme("tau1", 0.0).value / view.smooth_maximum


def depth_of_largest(view: LevelView) -> float:
    return view.extreme("tau1", 0.0).z


def largest_near(view: LevelView) -> float:
    """Largest tau1 of the asperities, down to NEAR, in smooth maxima."""
    tau1 = view.stress(0.0).tau1
    return float(tau1[highest_point(tau1, _near(view))] / view.smooth_maximum)


def depth_of_largest_near(view: LevelView) -> float:
    row, _ = highest_point(view.stress(0.0).tau1, _near(view))
    return float(view.z[row])


def depth_of_agreement(view: LevelView) -> float:
    """Depth below which tau1 is nowhere more than AGREEMENT smooth maxima from the smooth field."""
    difference = view.stress(0.0).tau1 - view.smooth(0.0).tau1
    return agreement_depth(view.z, difference, AGREEMENT * view.smooth_maximum)


def section_agreement(view: LevelView) -> float:
    """That depth on the vertical through the peak asperity alone."""
    difference = view.stress(0.0).tau1 - view.smooth(0.0).tau1
    column = difference[:, [peak_column(view)]]
    return agreement_depth(view.z, column, AGREEMENT * view.smooth_maximum)


def peak_column(view: LevelView) -> int:
    """Column of the largest tau1 of the asperities without friction."""
    return highest_point(view.stress(0.0).tau1, _near(view))[1]


def low_layer(view: LevelView) -> float:
    """Least tau1 between asperity and depth on that vertical, over the smaller of both maxima."""
    return shear_dip(view.z, view.stress(0.0).tau1[:, peak_column(view)], DEEP).ratio


def zone_ratio(view: LevelView, friction: float) -> float:
    """Least mean shear of the quiescent zone over the smaller of the maxima above and below."""
    return _zone(view, friction).ratio


def zone_end(view: LevelView, name: str) -> float:
    """Where the quiescent zone begins (start) or ends (stop) without friction [a]."""
    return getattr(_zone(view, 0.0), name) / view.problem.hertz.half_width


def _zone(view: LevelView, friction: float) -> ShearDip:
    return zone_of(view.problem, view.level, view.window, friction, view.every)


def reach_against_smooth(view: LevelView, level: float) -> float:
    """Depth of the top of the Hertz zone in the smooth contact, less that in this one [a].
    The zone is what is joined with the largest deep tau1 at `level` smooth maxima, no friction."""
    rough, smooth = (stress.tau1 for stress in (view.stress(0.0), view.smooth(0.0)))
    return _top_of_hertz_zone(view, smooth, level) - _top_of_hertz_zone(view, rough, level)


def open_to_surface(view: LevelView, friction: float) -> float:
    """Highest level at which the Hertz zone is joined with the surface, in smooth maxima."""
    tau1 = view.stress(friction).tau1
    surface = np.zeros(tau1.shape, dtype=bool)
    surface[0] = True
    return joining_level(tau1, _hertz_zone(view, tau1), surface) / view.smooth_maximum


def joined_share(view: LevelView, friction: float) -> float:
    """Of what the asperities shear beyond HALF, the share joined with the Hertz zone."""
    tau1 = view.stress(friction).tau1
    part = _near(view) & (np.abs(view.x) <= 1.0)
    level = HALF * view.smooth_maximum
    return share_joined(tau1, view.weights, level, _hertz_zone(view, tau1), part)


def bridging_wavelength(view: LevelView, friction: float) -> float:
    """Shortest wave [a], a crest under the roller's middle, over whose zone the mean shear falls
    nowhere below QUIET of both maxima; infinite where there is none up to 0.8 a."""
    ratios = np.array([_bridging_ratio(view, wave, friction) for wave in WAVES])
    bridging = np.flatnonzero(ratios >= QUIET)
    if len(bridging) == 0:
        return np.inf
    pair = slice(max(bridging[0] - 1, 0), bridging[0] + 1)
    return float(np.exp(np.interp(QUIET, ratios[pair], np.log(WAVES[pair]))))


def _bridging_ratio(view: LevelView, wave: float, friction: float) -> float:
    """Least mean shear over the smaller maximum, under waves [a] on the view's smooth body."""
    problem, grid, window = view.problem, view.level.grid, view.window
    hertz, length = problem.hertz, wave * problem.hertz.half_width
    height = SEVERITY * hertz.peak_pressure * length / (np.pi * problem.modulus)
    weighted_gap = grid.hat_integrals(
        lambda x: problem.gap(x) - height * np.cos(2.0 * np.pi * x / length), problem.knots
    )
    operator = CoupledHalfPlane(grid.count, grid.pitch, problem.modulus, 0.0)
    pressure = solve_on(operator, weighted_gap, grid.weights, problem.constraints()).pressure
    spacing = window.subdivisions(grid.pitch), "hat", window.stride(grid.pitch)
    points = (window.x[0], window.x[-1]), window.z[view.rows]
    field = friction_field(grid.x, pressure, *points, *spacing).at(friction)
    shear = mean_shear(problem, window, field.stress.tau1, view.every)
    return shear_dip(field.z, shear, DEEP * hertz.half_width).ratio


def edge_ratio(view: LevelView) -> float:
    """Mean of tau1 over the depth below x = +a, with friction over without."""
    column, weights = np.argmin(np.abs(view.x - 1.0)), view.weights[:, 0]
    sliding, resting = (
        weights @ view.stress(friction).tau1[:, column] / np.sum(view.weights)
        for friction in (SLIDING, 0.0)
    )
    return float(sliding / resting)


def _top_of_hertz_zone(view: LevelView, tau1: np.ndarray, level: float) -> float:
    level = level * view.smooth_maximum
    return top_of_zone(view.z, tau1, level, _hertz_zone(view, tau1))


def _hertz_zone(view: LevelView, tau1: np.ndarray) -> tuple[int, int]:
    """Place of the largest tau1 below DEEP."""
    return highest_point(tau1, (view.z >= DEEP)[:, None])


def _near(view: LevelView) -> np.ndarray:
    return (view.z <= NEAR)[:, None]


def _within(x: np.ndarray, patch: np.ndarray) -> np.ndarray:
    """Points of a patch; the nearest one where none lies in it."""
    inside = (x >= patch[0]) & (x <= patch[1])
    if not np.any(inside):
        inside[np.argmin(np.abs(x - patch.mean()))] = True
    return inside


def axis_error(view: LevelView) -> float:
    """Largest error of sx and sz on the axis, anywhere down to the window's end [p0]."""
    return _axis_error(view, np.inf)


def error_below_sampling(view: LevelView) -> float:
    """Largest error of sx and sz on the axis, at depths less than one pressure element [p0].
    The half-plane's by uniform strips, which the paper sums."""
    if view.model == "half_plane":
        z, hertz = _below(view.level.grid.pitch), view.problem.hertz
        strips = stress_at(view.level.grid.x, view.level.solution.pressure, 0.0, 0.0, z, "strip")
        errors = _normal_errors(strips, hertz_stress(hertz, 0.0, z), hertz.peak_pressure)
        return float(np.max(errors))
    return _axis_error(view, view.level.grid.pitch / view.problem.hertz.half_width)


def error_on_rough_surface(view: LevelView, element: Element, largest: bool = False) -> float:
    """Error of sx and sz at depths less than a sampling interval of the trace, sliding [p0].
    The sum over elements that are one sampling interval wide, against the level's own finer
    pressures joined linearly. The root mean square of all errors, or the largest."""
    grid, pressure, hertz = view.level.grid, view.level.solution.pressure, view.problem.hertz
    coarser = max(1, round(view.problem.surface.info.spacing / grid.pitch))
    nodes = slice(grid.count // 2 % coarser, None, coarser)
    pitch, reach = coarser * grid.pitch, EDGE * hertz.half_width
    x = grid.x[nodes]
    places = (x[:, None] + pitch * ACROSS).ravel()
    places = places[np.abs(places) <= reach]
    z = _below(pitch)
    stress = stress_at(x, pressure[nodes], SLIDING, places, z, element)
    reference = stress_at(grid.x, pressure, SLIDING, places, z)
    errors = _normal_errors(stress, reference, hertz.peak_pressure)
    return float(np.max(errors) if largest else np.sqrt(np.mean(errors**2)))


def _below(pitch: float) -> np.ndarray:
    """Depths (8, 1) [m] less than a pitch [m]."""
    return np.geomspace(SHALLOWEST, 1.0, 8)[:, None] * pitch


def _normal_errors(stress: StressState, reference: StressState, unit: float = 1.0) -> np.ndarray:
    """Amounts (2, ...) by which sx and sz of two stresses differ, over a unit."""
    return np.abs([stress.sx - reference.sx, stress.sz - reference.sz]) / unit


def _axis_error(view: LevelView, depth: float) -> float:
    middle, rows = np.argmin(np.abs(view.x)), view.z <= depth
    errors = _normal_errors(view.stress(0.0), view.smooth(0.0))
    return float(np.max(errors[:, rows, middle]))
