"""A scene as the mechanical problem that both models solve.

Symbols: R radius of relative curvature, E* combined modulus, P load per length, a and p0
half-width and peak pressure of the smooth (Hertz) contact under the same load. A periodic surface
is posed on one period L, under a flat body: R is infinite, the smooth contact touches everywhere,
a = L/2, p0 is the mean pressure, P = p0 L."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Self

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.exact.hertz import HertzContact
from analytic.exact.westergaard import FlatContact
from analytic.grid import HatGrid, roller_gap
from analytic.material import dundurs_constants
from analytic.profile import surface
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import SceneSurface

MOST_LEVELS = 8  # of a run
COUPLED = "normal_tangential_coupling"  # name of an effect
TABOR = 3.0  # hardness over yield stress (D. Tabor, The Hardness of Metals, 1951)
FIRST_TOUCH_POINTS = 100_001
LEAST_BLOCK = 0.25  # of the span of pressures: half-width that an unbounded block counts in
# Depth of an unbounded periodic body over its period: a wave of it is off by 1e-7 at half of that.
PERIODS_DEEP = 3.0
LEAST_EXTENT = 8.0  # of the farthest pressure: width and depth of an unbounded block
# Grid beyond the outermost contact, in half-widths. The edge of a contact is found from the six
# elements beyond it, which are as wide as a smooth contact's are few.
MARGIN, SMOOTH_MARGIN = 0.15, 0.5
NORM_STEP, LEAST_COLUMNS = 4, 16  # a power of two, and the columns that are left at least
WIDTHS_DEEP = 3.0  # of a body of finite width: below that its sides have made all stresses even


@dataclass(frozen=True)
class Window:
    """Points of a field: every x (k,) [m] at every depth z (m,) [m], z from 0 on. The spacing in x
    is the pitch of every level's pressure elements times or over a power of two."""

    x: np.ndarray
    z: np.ndarray
    ends: tuple[float, float]  # x [m] between which extremes are searched, however dense x is

    def holds(self, x: np.ndarray) -> np.ndarray:
        """Whether x [m] lie where extremes are searched."""
        return (x >= self.ends[0]) & (x <= self.ends[1])

    @property
    def norm_step(self) -> int:
        """Of so many x one is enough for the norm of a difference on a level that is not shown."""
        return NORM_STEP if len(self.x) > LEAST_COLUMNS * NORM_STEP else 1

    def columns(self, step: int) -> slice:
        """Every `step`-th x, a power of two: still points of the levels whose own all x are."""
        return slice(-round(self.x[0] / self._spacing) % step, None, step)

    def every(self, step: int) -> Self:
        """The window of these columns."""
        return replace(self, x=self.x[self.columns(step)])

    def stride(self, pitch: float) -> int:
        """Pressure elements of a pitch [m] from one x to the next, 1 where x is finer."""
        return 2 ** max(0, self._octaves(pitch))

    def subdivisions(self, pitch: float) -> int:
        """Parts into which x divides a pitch [m], 1 where x is coarser."""
        return 2 ** max(0, -self._octaves(pitch))

    def _octaves(self, pitch: float) -> int:
        return round(np.log2(self._spacing / pitch))

    @property
    def _spacing(self) -> float:
        return (self.x[-1] - self.x[0]) / (len(self.x) - 1)


@dataclass(frozen=True)
class Levels:
    """Numbers of levels, whatever time they take, instead of as many as the budget allows."""

    models: int  # of each model
    effects: int | None = None  # of the effects, at most


@dataclass(frozen=True)
class Problem:
    """Problem that both models solve."""

    scene: Scene
    surface: SceneSurface  # run in where the scene asks for that
    modulus: float  # E* of roller and body [Pa]
    hertz: HertzContact | FlatContact  # the smooth contact under the same load
    extent: tuple[float, float]  # (2,) [m] stretch of the surface that contact may reach
    # of the first levels, coarse to fine, each half of the one before [m]
    pitches: tuple[float, ...]
    # (k,) [m] where one ends and the next begins: largest values are compared at the same asperity
    asperities: tuple[float, ...] = ()
    # points of the common field, which largest stresses are searched about; None without [stress]
    window: Window | None = field(default=None, compare=False)
    levels: Levels | None = None  # None: as the scene's resolution and budget have it
    flows: bool = False  # the extent is as wide as flow may make the contact
    least_block: float = 0.0  # [m] width and depth that an unbounded block has at least

    @property
    def most_levels(self) -> int:
        return MOST_LEVELS if self.levels is None else self.levels.models

    @property
    def time(self) -> float:
        """Time that solving may take [s], by the laws of cost."""
        return self.scene.budget.time if self.levels is None else np.inf

    @property
    def reference_pitch(self) -> float:
        """Pitch of the third level [m], which element sizes and depths refer to."""
        return self.pitches[0] / 4.0

    def pitch_of(self, number: int) -> float:
        """Pitch [m] of a level, coarse to fine; the first has number 1."""
        return self.pitches[0] / 2.0 ** (number - 1)

    @property
    def period(self) -> float | None:
        """[m] after which the surface repeats; None: it does not."""
        return self.surface.profile.length if self.scene.periodic else None

    @property
    def rough_boundary(self) -> bool:
        """Whether the trace is the boundary of the finite elements, and not in the gap alone."""
        settings = self.scene.finite_element
        return settings.deformation == "finite" and self.surface.profile is not None

    @property
    def width(self) -> float | None:
        """[m] of the rough body, or its period; None: unbounded."""
        return self.period or self.scene.body.width

    @property
    def unbounded(self) -> tuple[float, float]:
        """Width and depth [m] of the block that stands for an unbounded body. In half-widths of the
        smooth contact, or of a wider extent of pressures: a light load on a rough surface touches
        far beyond its Hertz contact, and beside the roller's centre."""
        if self.period is not None:
            return self.period, PERIODS_DEEP * self.period
        half_width = max(self.hertz.half_width, LEAST_BLOCK * (self.extent[1] - self.extent[0]))
        farthest = max(abs(self.extent[0]), abs(self.extent[1]))
        size = max(self.scene.finite_element.block * half_width, LEAST_EXTENT * farthest)
        size = max(size, self.least_block)
        return size, max(size, WIDTHS_DEEP * (self.scene.body.width or 0.0))

    @property
    def margin(self) -> float:
        """[m] of the grid beyond the outermost contact."""
        return (SMOOTH_MARGIN if self.scene.profile is None else MARGIN) * self.hertz.half_width

    def under(self, friction: float) -> "Problem":
        """The problem under one of the scene's friction coefficients alone."""
        return replace(self, scene=self.scene.unchecked({"load.friction": (friction,)}))

    @cached_property
    def gap(self) -> Callable[[np.ndarray], np.ndarray]:
        """Initial gap g0(x) [m] under a parabola, but for a constant."""
        return self.gap_under("parabola")

    @cached_property
    def finite_element_gap(self) -> Callable[[np.ndarray], np.ndarray]:
        """Initial gap g0(x) [m] of the finite elements' roller, but for a constant."""
        return self.gap_under(self.scene.finite_element.roller_shape)

    def gap_under(self, shape: str) -> Callable[[np.ndarray], np.ndarray]:
        """Initial gap g0(x) [m] under a "parabola" or a "circle", but for a constant."""
        curve = None if self.surface.profile is None else surface(self.surface.profile)
        return roller_gap(self.scene.roller.radius, curve, shape)

    @property
    def knots(self) -> np.ndarray | None:
        """x (k,) [m] where the gap's third derivative jumps, None if smooth."""
        if self.period is not None:
            one = self.surface.profile.x[:-1]
            return np.concatenate([one + k * self.period for k in (-2, -1, 0, 1, 2)])
        return None if self.scene.profile is None else self.surface.profile.x

    @cached_property
    def first_touch(self) -> float:
        """Smallest initial gap g0 [m]: an approach counts from there."""
        return float(self.gap(np.linspace(*self.extent, FIRST_TOUCH_POINTS)).min())

    @property
    def largest_friction(self) -> float:
        """The coefficient that partial slip and heat are computed for."""
        return max(self.scene.load.friction)

    @property
    def dundurs_beta(self) -> float:
        return dundurs_constants(self.scene.body.material, self.scene.roller.material)[1]

    @property
    def coupling(self) -> float:
        """Friction times Dundurs' beta, by which traction moves surfaces; 0 where that is out.
        Of several coefficients the largest."""
        return self.largest_friction * self.dundurs_beta if self.scene.load.coupled else 0.0

    @property
    def shares_factor(self) -> bool:
        """Whether the roller's block is the body's but for a factor on its modulus."""
        scene, settings, roller = self.scene, self.scene.finite_element, self.scene.roller.material
        bounds = scene.body.thickness, scene.body.width, scene.coating
        # at finite deformation a body's boundary is its shape
        same_body = bounds == (None, None, None) and not settings.nonlinear
        alike = roller is not None and roller.poissons_ratio == scene.body.poissons_ratio
        return alike and same_body and settings.roller_body == "half-plane"

    @property
    def half_plane_effects(self) -> frozenset[str]:
        """Names of the effects that the scene's half-plane has: none, or COUPLED."""
        return frozenset({COUPLED} if self.coupling else ())

    def grid(self, pitch: float) -> HatGrid:
        if self.period is not None:
            return HatGrid.around(self.period, round(self.period / pitch))
        return HatGrid.within(*self.extent, pitch)

    def constraints(self, load: float | None = None) -> Constraints:
        """Load and hardness of the scene; `load` [N/m] in place of the scene's own."""
        hardness = np.inf if self.scene.body.hardness is None else self.scene.body.hardness
        return Constraints(load=load or self.hertz.load_per_length, hardness=hardness)

    @property
    def widest(self) -> Constraints:
        """The constraints under which contact spreads as far as flow may take it: pressures are
        then at most what a flat punch bears while friction shears the surface off, (1 + pi/2) k,
        and that at which it does, k/mu; k = Y/sqrt 3 (Johnson 1985, sections 6.2 and 7.6)."""
        plain = self.constraints()
        if not self.flows:
            return plain
        return replace(plain, hardness=min(plain.hardness, least_of_flow(self.scene)))


def least_of_flow(scene: Scene) -> float:
    """The least pressure [Pa] that contact may spread at, where the body flows (`widest`)."""
    least = (1.0 + 0.5 * np.pi) / max(1.0, (1.0 + 0.5 * np.pi) * max(scene.load.friction))
    return least * scene.body.yield_stress / 3**0.5


def mean_height(problem: Problem, grid: HatGrid) -> np.ndarray:
    """Heights (n,) [m] of the rough body's surface without load, averaged over each hat."""
    if problem.scene.profile is None:
        return np.zeros(grid.count)
    return grid.hat_integrals(problem.surface.profile.spline(), problem.knots) / grid.weights
