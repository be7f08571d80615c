"""The numbers that judge the claims.

In: one level of one model (`LevelView`), whose methods claims.toml calls by name. Out: a number.

Lengths in a, stresses in p0: half-width and peak pressure of the smooth (Hertz) contact under the
same load. Shares and ratios have no unit. "Smooth maximum" is the largest tau1 of the smooth
contact without friction, 0.3003 p0.

Fields (m, k) have one row a depth from the surface down. Two points belong to one zone where a path
leads from one to the other, over sides or corners, on which the field stays at a level."""

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import label

from analytic.exact.hertz import hertz_stress
from analytic.operators.tangential import CoupledHalfPlane
from analytic.stress.field import friction_field
from analytic.stress.points import stress_at
from analytic.stress.potential import Element
from analytic.stress_state import Extremum, StressState
from comparisons.models.level import Level
from comparisons.models.nearest_operator import solve_on
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.studies.comparison import layer_thickness
from comparisons.studies.subsurface.quiescent_zone import (
    QUIET,
    ShearDip,
    mean_shear,
    shear_dip,
    zone_of,
)

NEAR, DEEP = 0.1, 0.5  # a: asperities shear above the one, the smooth contact below the other
AGREEMENT = 0.05  # of the smooth maximum: fields nearer to each other than that agree
HALF = 0.5  # of the smooth maximum: what counts as highly sheared
SLIDING = 0.1  # friction of the paper's sliding contacts
ACROSS = np.array([0.0, 0.25, 0.48, 0.5, 0.52, 0.75])  # elements: both sides of edges too
SHALLOWEST = 0.02  # sampling intervals: the least depth at which the sum of elements is read
EDGE = 0.9  # a: farther out the elements' error at the edge of the contact shows
# Waves of a body that may bridge the quiescent zone [a]; their severity [p0] is the mean pressure
# that would close them, pi E* height / wavelength.
WAVES = np.geomspace(0.2, 0.8, 9)
SEVERITY = 2.0
NEIGHBOURS = np.ones((3, 3))  # of a point, in its zone
BISECTIONS = 40  # of the range in which a level is sought: to 1e-12 of it

Point = tuple[int, int]  # row and column of a field


@dataclass(frozen=True)
class LevelView:
    """What a number is read off, and the numbers: lengths in a, stresses in p0."""

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
        parts = (exact.sx, exact.sz, exact.txz)
        return StressState(*(part / hertz.peak_pressure for part in parts))

    def extreme(self, name: str, friction: float) -> Extremum:
        """Largest tau1 | |txz|, sought off the grid: value [p0], x and z [a]."""
        extremum, hertz = self.level.stress(friction).extremes[name], self.problem.hertz
        a = hertz.half_width
        return Extremum(abs(extremum.value) / hertz.peak_pressure, extremum.x / a, extremum.z / a)

    def contact_ratio(self) -> float:
        """Sum of the contact patches over 2a."""
        return 0.5 * self.level.contact_length / self.problem.hertz.half_width

    def peak_pressure(self) -> float:
        return float(self.level.solution.pressure.max() / self.problem.hertz.peak_pressure)

    def carried_load(self) -> float:
        """Integral of the pressures over the load."""
        grid, hertz = self.level.grid, self.problem.hertz
        return float(grid.weights @ self.level.solution.pressure / hertz.load_per_length)

    def pressed_beyond(self, limit: float) -> float:
        """Share of the contact patches whose peak pressure exceeds `limit` [p0]."""
        x, pressure = self.level.grid.x, self.level.solution.pressure
        most = limit * self.problem.hertz.peak_pressure
        peaks = [pressure[_within(x, patch)].max() for patch in self.level.patches]
        return float(np.mean(np.array(peaks) > most))

    def sheared_beyond(self, limit: float) -> float:
        """Share of the contact patches under which tau1 exceeds `limit` smooth maxima."""
        tau1 = self.stress(0.0).tau1[self.z <= NEAR]
        x = self.x * self.problem.hertz.half_width
        peaks = [tau1[:, _within(x, patch)].max() for patch in self.level.patches]
        return float(np.mean(np.array(peaks) > limit * self.smooth_maximum))

    def largest(self, name: str, friction: float = 0.0) -> float:
        """Largest tau1 | txz [p0]."""
        return self.extreme(name, friction).value

    def largest_over_smooth(self) -> float:
        return self.largest("tau1") / self.smooth_maximum

    def depth_of_largest(self) -> float:
        return self.extreme("tau1", 0.0).z

    def largest_near(self) -> float:
        """Largest tau1 of the asperities, down to NEAR, in smooth maxima."""
        return float(self.stress(0.0).tau1[self._asperity()] / self.smooth_maximum)

    def depth_of_largest_near(self) -> float:
        return float(self.z[self._asperity()[0]])

    def _asperity(self) -> Point:
        """Where the asperities' tau1 is largest without friction."""
        return highest_point(self.stress(0.0).tau1, self._near())

    def _near(self) -> np.ndarray:
        return (self.z <= NEAR)[:, None]

    def depth_of_agreement(self) -> float:
        """Depth below which tau1 is nowhere more than AGREEMENT smooth maxima from the smooth's."""
        difference = self.stress(0.0).tau1 - self.smooth(0.0).tau1
        return agreement_depth(self.z, difference, AGREEMENT * self.smooth_maximum)

    def section_agreement(self) -> float:
        """That depth on the vertical through the peak asperity alone."""
        difference = self.stress(0.0).tau1 - self.smooth(0.0).tau1
        column = difference[:, [self._asperity()[1]]]
        return agreement_depth(self.z, column, AGREEMENT * self.smooth_maximum)

    def low_layer(self) -> float:
        """Least tau1 between asperity and depth on that vertical, over the smaller maximum."""
        return shear_dip(self.z, self.stress(0.0).tau1[:, self._asperity()[1]], DEEP).ratio

    def zone_ratio(self, friction: float) -> float:
        """Least mean shear of the quiescent zone over the smaller of the maxima above and below."""
        return self._quiescent_zone(friction).ratio

    def zone_end(self, name: str) -> float:
        """Where the quiescent zone begins (start) or ends (stop) without friction [a]."""
        return getattr(self._quiescent_zone(0.0), name) / self.problem.hertz.half_width

    def _quiescent_zone(self, friction: float) -> ShearDip:
        return zone_of(self.problem, self.level, self.window, friction, self.every)

    def reach_against_smooth(self, level: float) -> float:
        """Depth of the top of the Hertz zone in the smooth contact, less that in this one [a]. The
        zone is what is joined with the largest deep tau1 at `level` smooth maxima, no friction."""
        fields = self.smooth(0.0).tau1, self.stress(0.0).tau1
        level = level * self.smooth_maximum
        smooth, rough = (top_of_zone(self.z, f, level, self._hertz_zone(f)) for f in fields)
        return smooth - rough

    def open_to_surface(self, friction: float) -> float:
        """Highest level at which the Hertz zone is joined with the surface, in smooth maxima."""
        tau1 = self.stress(friction).tau1
        surface = np.zeros(tau1.shape, dtype=bool)
        surface[0] = True
        return joining_level(tau1, self._hertz_zone(tau1), surface) / self.smooth_maximum

    def joined_share(self, friction: float) -> float:
        """Of what the asperities shear beyond HALF, the share joined with the Hertz zone."""
        tau1 = self.stress(friction).tau1
        part = self._near() & (np.abs(self.x) <= 1.0)
        level = HALF * self.smooth_maximum
        return share_joined(tau1, self.weights, level, self._hertz_zone(tau1), part)

    def _hertz_zone(self, tau1: np.ndarray) -> Point:
        """Where tau1 is largest below DEEP."""
        return highest_point(tau1, (self.z >= DEEP)[:, None])

    def bridging_wavelength(self, friction: float) -> float:
        """Shortest wave [a], a crest under the roller's middle, over whose zone the mean shear
        falls nowhere below QUIET of both maxima; infinite where there is none up to 0.8 a."""
        ratios = np.array([self._bridging_ratio(wave, friction) for wave in WAVES])
        bridging = np.flatnonzero(ratios >= QUIET)
        if len(bridging) == 0:
            return np.inf
        pair = slice(max(bridging[0] - 1, 0), bridging[0] + 1)
        return float(np.exp(np.interp(QUIET, ratios[pair], np.log(WAVES[pair]))))

    def _bridging_ratio(self, wave: float, friction: float) -> float:
        """Least mean shear over the smaller maximum, under waves [a] on this smooth body."""
        problem, grid, window = self.problem, self.level.grid, self.window
        hertz, length = problem.hertz, wave * problem.hertz.half_width
        height = SEVERITY * hertz.peak_pressure * length / (np.pi * problem.modulus)
        weighted_gap = grid.hat_integrals(
            lambda x: problem.gap(x) - height * np.cos(2.0 * np.pi * x / length), problem.knots
        )
        operator = CoupledHalfPlane(grid.count, grid.pitch, problem.modulus, 0.0)
        pressure = solve_on(operator, weighted_gap, grid.weights, problem.constraints()).pressure
        spacing = window.subdivisions(grid.pitch), "hat", window.stride(grid.pitch)
        points = (window.x[0], window.x[-1]), window.z[self.rows]
        field = friction_field(grid.x, pressure, *points, *spacing).at(friction)
        shear = mean_shear(problem, window, field.stress.tau1, self.every)
        return shear_dip(field.z, shear, DEEP * hertz.half_width).ratio

    def edge_ratio(self) -> float:
        """Mean of tau1 over the depth below x = +a, with friction over without."""
        column, weights = np.argmin(np.abs(self.x - 1.0)), self.weights[:, 0]
        sliding, resting = (
            weights @ self.stress(friction).tau1[:, column] / np.sum(self.weights)
            for friction in (SLIDING, 0.0)
        )
        return float(sliding / resting)

    def axis_error(self, depth: float = np.inf) -> float:
        """Largest error of sx and sz on the axis, anywhere down to a depth [a] [p0]."""
        middle, rows = np.argmin(np.abs(self.x)), self.z <= depth
        errors = _normal_errors(self.stress(0.0), self.smooth(0.0))
        return float(np.max(errors[:, rows, middle]))

    def error_below_sampling(self) -> float:
        """Largest error of sx and sz on the axis, at depths less than one pressure element [p0].
        The half-plane's by uniform strips, which the paper sums."""
        grid, hertz = self.level.grid, self.problem.hertz
        if self.model != "half_plane":
            return self.axis_error(grid.pitch / hertz.half_width)
        z = _below(grid.pitch)
        strips = stress_at(grid.x, self.level.solution.pressure, 0.0, 0.0, z, "strip")
        errors = _normal_errors(strips, hertz_stress(hertz, 0.0, z), hertz.peak_pressure)
        return float(np.max(errors))

    def error_on_rough_surface(self, element: Element, largest: bool = False) -> float:
        """Error [p0] of sx and sz, sliding, above the depth of one sampling interval of the trace:
        of elements as wide as that, against the level's own finer pressures joined linearly. The
        root mean square of all errors, or the largest."""
        grid, pressure, hertz = self.level.grid, self.level.solution.pressure, self.problem.hertz
        coarser = max(1, round(self.problem.surface.info.spacing / grid.pitch))
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


def _within(x: np.ndarray, patch: np.ndarray) -> np.ndarray:
    """Points of a patch; the nearest one where none lies in it."""
    inside = (x >= patch[0]) & (x <= patch[1])
    if not np.any(inside):
        inside[np.argmin(np.abs(x - patch.mean()))] = True
    return inside


def _below(pitch: float) -> np.ndarray:
    """Depths (8, 1) [m] less than a pitch [m]."""
    return np.geomspace(SHALLOWEST, 1.0, 8)[:, None] * pitch


def _normal_errors(stress: StressState, reference: StressState, unit: float = 1.0) -> np.ndarray:
    """Amounts (2, ...) by which sx and sz of two stresses differ, over a unit."""
    return np.abs([stress.sx - reference.sx, stress.sz - reference.sz]) / unit


def agreement_depth(z: np.ndarray, difference: np.ndarray, tolerance: float) -> float:
    """Depth, in the unit of z (m,), below which |difference| (m, k) stays within a tolerance.
    Between two depths the largest difference is taken as linear. 0 where the tolerance holds at
    every depth; the last depth where it does not hold even there."""
    largest = np.max(np.abs(difference), axis=1)
    beyond = np.flatnonzero(largest > tolerance)
    if len(beyond) == 0:
        return 0.0
    last = beyond[-1]
    if last == len(z) - 1:
        return float(z[-1])
    share = (largest[last] - tolerance) / (largest[last] - largest[last + 1])
    return float(z[last] + share * (z[last + 1] - z[last]))


def zone(field: np.ndarray, level: float, seed: Point) -> np.ndarray:
    """Points (m, k) joined with `seed` at a level; none if the seed is below it."""
    zones, _ = label(field >= level, structure=NEIGHBOURS)
    return (zones == zones[seed]) & (zones > 0)


def top_of_zone(z: np.ndarray, field: np.ndarray, level: float, seed: Point) -> float:
    """Least depth, in the unit of z (m,), of what is joined with `seed` at a level.
    Between the first row of the zone and the row above it the field is taken as linear. The last
    depth where there is no zone."""
    inside = zone(field, level, seed)
    rows = np.flatnonzero(inside.any(axis=1))
    if len(rows) == 0:
        return float(z[-1])
    row = rows[0]
    if row == 0:
        return float(z[0])
    here, above = field[row, inside[row]], field[row - 1, inside[row]]
    share = np.max((here - level) / (here - above))
    return float(z[row] - share * (z[row] - z[row - 1]))


def joining_level(field: np.ndarray, seed: Point, target: np.ndarray) -> float:
    """Highest level at which `seed` is joined with any point of `target` (m, k)."""
    low, high = float(np.min(field)), float(field[seed])
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        if np.any(zone(field, middle, seed) & target):
            low = middle
        else:
            high = middle
    return low


def share_joined(
    field: np.ndarray, weights: np.ndarray, level: float, seed: Point, part: np.ndarray
) -> float:
    """Of the area in `part` (m, k) at or above a level, the share joined with `seed`; 0 if empty.

    weights  (m, 1) or (m, k), the area that a point stands for"""
    area = np.broadcast_to(weights, field.shape)
    above = part & (field >= level)
    total = float(np.sum(area[above]))
    joined = float(np.sum(area[above & zone(field, level, seed)]))
    return joined / total if total > 0.0 else 0.0


def highest_point(field: np.ndarray, part: np.ndarray) -> Point:
    """Where the field is largest inside `part`, (m, 1) or (m, k)."""
    row, column = np.unravel_index(np.argmax(np.where(part, field, -np.inf)), field.shape)
    return int(row), int(column)
