"""Running-in: a roller pressed on at position after position until no asperity flows any more.

At each position the contact is solved with the pressure at most the hardness. Where that
holds, the surfaces would still overlap; plastic flow takes the overlap off the profile, so that
the same load at the same position is carried elastically from then on. Sweeps over all positions
follow each other until one moves next to nothing: the profile has settled. What flows is lost:
there is no pile-up beside a flattened asperity, no hardening, and no residual stress.

    z   height [m]               x_c  position of the roller's centre [m]
    g   mean gap over a hat [m]  d    overlap -g where p = H, else 0 [m]
    p   pressure [Pa]            H    hardness [Pa]

The profile is lowered at its samples and, where hats are narrower, at their middles, which become
samples: by d_i in the middle of hat i and between by the C2 cubic spline through these, whose kinks
attract no pressure, but not where no hat flowed: right to second order in the pitch.

Between samples the profile is a spline, which rises a little beside a flattened crest: by 0.3 % of
the largest lowering with hats a 20th of the shortest wave apart and 0.1 % at a 40th; where a wave
has no more than 3.4 samples by 3 to 4 % with hats at the samples, 1 to 2 % at half the spacing."""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.interpolate import CubicSpline

from analytic.contact.equilibrium import SET_TOLERANCE, Constraints
from analytic.contact.problem import ContactSolution, solve_contact
from analytic.exact.hertz import hertz_from_load
from analytic.grid import HatGrid, roller_gap
from analytic.operators.half_plane import HalfPlane
from analytic.profile import Profile
from analytic.surface.form import trapezoid_widths

SMALLEST_SWEEP = 1e-3  # of all the volume moved: a sweep that moves no more is the last
SWEEPS = 10  # at most, unless the caller says otherwise
HATS = 2.0  # on the profile's spacing, unless the caller says otherwise
NEAR = 0.25  # of the pitch: a sample so near to the middle of a hat stands for it
SPLINE_REACH = 64  # samples beyond which a spline no longer feels its end: 0.27^64 is 1e-36

Status = Literal["settled", "passes spent"]


@dataclass(frozen=True)
class Pass:
    """The roller pressed on once."""

    position: float  # x_c [m] on the trace
    volume: float  # taken off the profile, per unit length [m^2]
    lowering: float  # largest overlap taken off [m]
    # whether contact reaches an end of the trace, beyond which nothing supports the roller
    at_end: bool
    converged: bool  # whether the contact solution did; `residual` is its worst
    residual: float


@dataclass(frozen=True)
class RunIn:
    """A profile after running-in."""

    before: Profile  # the profile as it was given
    profile: Profile  # its samples, and in the swept stretch the middles of hats, lowered
    lowering: np.ndarray  # (n,) [m] how far each of these was lowered, >= 0
    constraints: Constraints  # load and hardness
    passes: tuple[Pass, ...]  # in order; `sweeps` of them over all positions
    sweeps: int
    pitch: float  # of the pressure hats [m]
    # settled: the last sweep moved at most SMALLEST_SWEEP of the volume of all; passes spent: it
    # moved more, and no further sweep was allowed
    status: Status

    @property
    def volume(self) -> float:
        """Taken off in all passes, per unit length [m^2]."""
        return float(sum(one.volume for one in self.passes))

    @property
    def largest_lowering(self) -> float:
        """Largest lowering of any sample by all passes together [m]."""
        return float(self.lowering.max())

    @property
    def converged(self) -> bool:
        """Whether every pass's contact solution converged."""
        return all(one.converged for one in self.passes)


def run_in(
    profile: Profile,
    radius: float,
    modulus: float,
    constraints: Constraints,
    positions: np.ndarray,
    *,
    pitch: float | None = None,
    sweeps: int = SWEEPS,
) -> RunIn:
    """Run a profile in under a smooth cylinder on a half-plane.

    radius       R of relative curvature [m]     modulus  E* [Pa]
    constraints  the load [N/m] and a finite hardness [Pa]
    positions    (k,) x_c [m] on the trace, swept in this order
    pitch        of the pressure hats [m]; default half the profile's spacing
    sweeps       at most

    Raises ValueError for what makes no sense, ContactError if the trace cannot carry the load."""
    positions = np.asarray(positions, dtype=float)
    _check(profile, constraints, positions, sweeps)
    pitch = pitch or profile.spacing / HATS
    surface = _Surface(profile, radius, modulus, constraints, pitch, positions)
    passes: list[Pass] = []
    status: Status = "passes spent"
    for _ in range(sweeps):
        passes.extend(surface.press(position) for position in positions)
        moved = [one.volume for one in passes]
        if sum(moved[-len(positions) :]) <= SMALLEST_SWEEP * sum(moved):
            status = "settled"
            break
    return RunIn(
        before=profile,
        profile=Profile(surface.x + surface.origin, surface.height - surface.lowering),
        lowering=surface.lowering,
        constraints=constraints,
        passes=tuple(passes),
        sweeps=len(passes) // len(positions),
        pitch=surface.whole.pitch,
        status=status,
    )


def _check(profile: Profile, constraints: Constraints, positions: np.ndarray, sweeps: int) -> None:
    if constraints.load is None or not np.isfinite(constraints.hardness):
        raise ValueError("running-in needs a load and a finite hardness")
    if positions.ndim != 1 or len(positions) == 0:
        raise ValueError("running-in needs a list of at least one position")
    outside = ~((positions > profile.x[0]) & (positions < profile.x[-1]))
    if np.any(outside):
        raise ValueError(
            f"a position of running-in lies at {positions[outside][0]:g} m, off the trace from "
            f"{profile.x[0]:g} m to {profile.x[-1]:g} m"
        )
    if sweeps < 1:
        raise ValueError(f"running-in needs at least one sweep, not {sweeps}")


class _Surface:
    """The profile at work: its samples `x` with heights that passes lower.
    Hats are centred on whole pitches from the trace's first sample. A pass solves on those that its
    contact can reach, the same number at every position: all passes share an operator, and each
    starts from the pressures of the one before at its position."""

    def __init__(
        self,
        profile: Profile,
        radius: float,
        modulus: float,
        constraints: Constraints,
        pitch: float,
        positions: np.ndarray,
    ) -> None:
        self.radius, self.modulus, self.constraints = radius, modulus, constraints
        self.origin = float(profile.x[0])
        self.whole = HatGrid.within(0.0, profile.length, pitch)
        # nothing farther out could touch, even if the highest peak stood there
        hertz = hertz_from_load(constraints.load, radius, modulus)
        carried = max(2.0 * hertz.half_width, constraints.load / constraints.hardness)
        reach = carried + np.sqrt(2.0 * radius * np.ptp(profile.height))
        self._span(reach)
        places = positions - self.origin
        middles, samples = self.whole.x, profile.x - self.origin
        swept = (middles >= places.min() - reach) & (middles <= places.max() + reach)
        right = np.clip(np.searchsorted(samples, middles), 1, len(samples) - 1)
        apart = np.minimum(np.abs(middles - samples[right - 1]), np.abs(samples[right] - middles))
        self.x = np.union1d(samples, middles[swept & (apart > NEAR * pitch)])
        self.widths = trapezoid_widths(self.x)
        self.height = profile.spline()(np.clip(self.x + self.origin, *profile.x[[0, -1]]))
        self.lowering = np.zeros_like(self.x)
        self.starts: dict[tuple[float, int], np.ndarray] = {}

    def _span(self, reach: float) -> None:
        """Let passes look for contact up to `reach` [m] from the roller's centre."""
        self.reach = reach
        count = int(np.ceil(min(2.0 * reach / self.whole.pitch, float(self.whole.count))))
        self.operator = HalfPlane(max(count, 3), self.whole.pitch, self.modulus)

    def press(self, position: float) -> Pass:
        """Solve the capped contact at one position [m] and take off what overlaps."""
        grid, solution = self._contact(position - self.origin)
        capped = solution.pressure >= self.constraints.hardness * (1.0 - SET_TOLERANCE)
        overlap = np.where(capped, np.maximum(-solution.gap, 0.0), 0.0)
        part = self._part(grid, 0)
        # an end of the trace, beyond the last hat's middle, goes down with it
        places = np.clip(self.x[part], *grid.x[[0, -1]])
        flowed = np.interp(places, grid.x, overlap) > 0.0
        taken = np.where(flowed, np.maximum(CubicSpline(grid.x, overlap)(places), 0.0), 0.0)
        self.lowering[part] += taken
        first, last = np.flatnonzero(solution.pressure > 0.0)[[0, -1]] + grid.first
        return Pass(
            position=float(position),
            volume=float(self.widths[part] @ taken),
            lowering=float(overlap.max()),
            at_end=bool(first == self.whole.first or last == self.whole.last),
            converged=solution.converged,
            residual=solution.residuals.worst,
        )

    def _contact(self, place: float) -> tuple[HatGrid, ContactSolution]:
        """The contact at one position, on as many hats as it needs."""
        whole = self.whole
        while True:
            first = round(place / whole.pitch) - self.operator.count // 2
            first = int(np.clip(first, whole.first, whole.last - self.operator.count + 1))
            grid = HatGrid(whole.pitch, first, first + self.operator.count - 1)
            solution = solve_contact(
                self.operator,
                self._gap(place, grid),
                grid.weights,
                self.constraints,
                self.starts.get((place, grid.count)),
            )
            touching = np.flatnonzero(solution.pressure > 0.0)
            cut_left = touching[0] == 0 and grid.first > whole.first
            cut_right = touching[-1] == grid.count - 1 and grid.last < whole.last
            if not (cut_left or cut_right):
                self.starts[place, grid.count] = solution.pressure
                return grid, solution
            self._span(2.0 * self.reach)

    def _gap(self, place: float, grid: HatGrid) -> np.ndarray:
        """Weighted gap (n,) [m^2] under the roller at a position, over the profile as it is now."""
        near = self._part(grid, SPLINE_REACH)
        height = Profile(self.x[near], (self.height - self.lowering)[near]).spline()
        gap = roller_gap(self.radius, lambda from_centre: height(from_centre + place))
        return grid.hat_integrals(lambda x: gap(x - place), height.x)

    def _part(self, grid: HatGrid, beyond: int) -> slice:
        """Samples under the feet of a grid's hats, and so many `beyond` on either side."""
        start, stop = (grid.first - 1) * grid.pitch, (grid.last + 1) * grid.pitch
        slack = NEAR * grid.pitch
        low = np.searchsorted(self.x, start - slack) - beyond
        high = np.searchsorted(self.x, stop + slack) + beyond
        return slice(max(low, 0), high)
