r"""Rough contacts with an exact solution, made from their pressures: on half-planes and on layers.

Choose the pressures; the initial gap follows. On patch j of centre c, half-width b, s = (x - c)/b,

    p = sqrt(1 - s^2) q(s),   q = sum_n c_n U_n(s) > 0 for all real s

(U_n, T_n: Chebyshev's polynomials). With v = z - sqrt(z - 1) sqrt(z + 1), z = s + i depth/b, the
potential of the pressure and the displacement of the half-plane's surface, in units of b, are

    I(z) = (1/pi) int p(t)/(z - t) dt = sum_n c_n v^(n+1)
    u = -(2 b/E*) Re sum_n c_n V_n,    V_0 = v^2/4 - ln(v)/2,   V_n = v^(n+2)/2(n+2) - v^n/2n

but for a constant: on the patch v = e^(i acos s) and I = sum_n c_n T_(n+1), outside |v| < 1. (From
int sqrt(1 - t^2) U_n(t)/(x - t) dt = pi T_(n+1)(x), Abramowitz and Stegun 22.13.4.) Stresses follow
from I as `analytic.exact.hertz` says.

Were the initial gap to go on beyond the patch as it is inside, the loaded surfaces would part by

    W_j = (2 b/E*) int_1^|s| sqrt(t^2 - 1) q(+-t) dt > 0.

Between two patches the gap under load is the mean of their two W, weighted by a polynomial of
degree 2 SMOOTHNESS + 1 whose first SMOOTHNESS derivatives vanish at both edges; beyond the last
patches it is W. So it is positive wherever nothing presses, zero elsewhere, and the initial gap,
g0 = gap - u, has SMOOTHNESS continuous derivatives everywhere, more inside every patch.

A layer or coating of thickness t adds to u the integral over its waves of what its base adds
(`analytic.layers.layered`); with w = k t, J Bessel's functions, C the half-plane's compliance,

    u+ = (1/pi) int (C+ - C)(k) Re P(k) e^ikx dk
    P = pi b sum_n c_n i^-n (n + 1) J_(n+1)(k b)/(k b) e^-ikc,  summed over the patches,

less a constant that makes it finite at k = 0. C+ - C falls like e^-2w: Gauss points on panels leave
rounding. Stresses in the layer get the same integral of the waves' stresses."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.polynomial import Polynomial, chebyshev
from scipy.special import jv

from analytic.layers.kernel import finest_scale, wave_panels
from analytic.layers.layered import LayeredBody, added, added_stress
from analytic.material import Material, combined_modulus
from analytic.numerics import points_below
from analytic.stress.elements import FrictionStress
from analytic.stress.potential import stresses
from analytic.stress_state import Extremum, StressState

SMOOTHNESS = 6  # continuous derivatives of the initial gap
_HIGHEST = 40.0  # w (2 - z/t) beyond which nothing is added
_TOGETHER = 256  # points that waves are summed at together
# A search starts at these x and depths [half-widths] of each patch, and closes in on the best.
_PLACES = 1.5 * np.sin(0.5 * np.pi * np.linspace(-1.0, 1.0, 41))
_DEPTHS = np.array([0.0, *np.geomspace(0.01, 3.0, 24)])
_STARTS, _ZOOMS, _ZOOM = 3, 28, 0.5


@dataclass(frozen=True)
class PressurePatch:
    """A stretch of contact: `centre`, `half_width` [m], coefficients c_n [Pa] of q."""

    centre: float
    half_width: float
    coefficients: tuple[float, ...]

    @property
    def edges(self) -> tuple[float, float]:
        return self.centre - self.half_width, self.centre + self.half_width

    @property
    def load(self) -> float:
        """[N/m]: U_n is orthogonal to U_0 under the square root."""
        return 0.5 * np.pi * self.half_width * self.coefficients[0]

    @cached_property
    def shape(self) -> Polynomial:
        """q(s) [Pa]."""
        second = [Polynomial([1.0]), Polynomial([0.0, 2.0])]  # U_n
        while len(second) < len(self.coefficients):
            second.append(second[1] * second[-1] - second[-2])
        return sum(c * u for c, u in zip(self.coefficients, second, strict=False))

    @property
    def peak(self) -> float:
        """Largest pressure [Pa], where (1 - s^2) q' = s q."""
        s = Polynomial([0.0, 1.0])
        steady = ((1.0 - s**2) * self.shape.deriv() - s * self.shape).roots()
        inside = steady.real[(abs(steady.imag) < 1e-9) & (abs(steady.real) < 1.0)]
        return float((np.sqrt(1.0 - inside**2) * self.shape(inside)).max())

    def pressure(self, x: np.ndarray) -> np.ndarray:
        """p(x) [Pa], zero outside."""
        s = (x - self.centre) / self.half_width
        return np.sqrt(np.maximum((1.0 - s) * (1.0 + s), 0.0)) * np.where(
            abs(s) < 1.0, self.shape(s), 0.0
        )

    def sinking(self, x: np.ndarray, inner: bool = False) -> np.ndarray:
        """-u E*/2 [N/m] at x [m] but for a constant; `inner`: as it is inside, continued."""
        s, total = (x - self.centre) / self.half_width, 0.0
        v = _decaying(s, np.zeros_like(s))
        for n, c in enumerate(self.coefficients):
            if inner:
                line = [0.0] * (n + 2) + [1.0]
                rest = chebyshev.chebval(s, [0.0] * n + [1.0]) / n if n else 0.0
                total = total + 0.5 * c * (chebyshev.chebval(s, line) / (n + 2) - rest)
            else:
                rest = (v**n).real / n if n else np.log(abs(v))
                total = total + 0.5 * c * ((v ** (n + 2)).real / (n + 2) - rest)
        return self.half_width * total

    def stress(self, x: np.ndarray, z: np.ndarray, friction: float) -> StressState:
        """Stresses [Pa] of the half-plane at x, z >= 0 [m] under p and q = friction p in +x."""
        s, depth = (x - self.centre) / self.half_width, z / self.half_width
        v, value, slope = _decaying(s, depth), 0.0, 0.0
        root = 0.5 * (1.0 / v - v)
        for n, c in enumerate(self.coefficients):
            value = value + c * v ** (n + 1)
            slope = slope - c * (n + 1) * v ** (n + 1)
        slope = depth * slope / np.where(root == 0.0, 1.0, root)
        return FrictionStress.of(stresses(value, slope)).at(friction)

    def transform(self, k: np.ndarray) -> np.ndarray:
        """int p(x) e^-ikx dx [N/m] of wavenumbers k [1/m] > 0."""
        kb, total = k * self.half_width, 0.0
        for n, c in enumerate(self.coefficients):
            total = total + c * (-1j) ** n * (n + 1) * jv(n + 1, kb) / kb
        return np.pi * self.half_width * total * np.exp(-1j * k * self.centre)


@dataclass(frozen=True)
class ManufacturedContact:
    """Pressures, and the initial gap under which they are those of an exact contact."""

    patches: tuple[PressurePatch, ...]  # from left to right, apart from each other
    body: Material  # that of its layer where it has one
    roller: Material | None = None  # None: rigid
    layer: LayeredBody | None = None  # what the body is but a half-plane, or None
    friction: float = 0.0  # q = friction p in +x, of stresses; it moves no surface

    def __post_init__(self) -> None:
        edges = np.array([patch.edges for patch in self.patches]).ravel()
        if np.any(np.diff(edges) <= 0.0):
            raise ValueError("patches must be given from left to right and lie apart")
        for patch in self.patches:
            roots = patch.shape.roots()
            if patch.shape(0.0) <= 0.0 or np.any(abs(roots.imag) < 1e-9):
                raise ValueError("q must be positive for all real s")

    @property
    def modulus(self) -> float:
        """E* [Pa]."""
        return combined_modulus(self.body, self.roller)

    @property
    def load(self) -> float:
        return float(sum(patch.load for patch in self.patches))

    @property
    def peak_pressure(self) -> float:
        return max(patch.peak for patch in self.patches)

    @property
    def contact_length(self) -> float:
        return float(sum(2.0 * patch.half_width for patch in self.patches))

    @property
    def ends(self) -> tuple[float, float]:
        """First and last contact [m]."""
        return self.patches[0].edges[0], self.patches[-1].edges[1]

    def pressure(self, x: np.ndarray) -> np.ndarray:
        """p(x) [Pa]."""
        x = np.asarray(x, dtype=float)
        return sum(patch.pressure(x) for patch in self.patches)

    def displacement(self, x: np.ndarray) -> np.ndarray:
        """Displacement of the surfaces towards each other [m] at x (n,) [m], but for a constant."""
        x = np.asarray(x, dtype=float)
        half_plane = -2.0 / self.modulus * sum(patch.sinking(x) for patch in self.patches)
        if self.layer is None:
            return half_plane
        self._check_reach(x)
        k, load, weights = self._waves
        w = k * self.layer.thickness
        constant = self.load * weights * np.exp(-(w**2))
        share = 4.0 * np.exp(-2.0 * w) * added(self.layer.contrast, w)[0] / w
        share = share * 2.0 / self.body.plane_strain_modulus
        parts = np.split(x, np.arange(_TOGETHER, len(x), _TOGETHER))
        waves = [(np.exp(1j * np.outer(part, k)) @ (load * share)).real for part in parts]
        return half_plane + np.concatenate(waves) - np.sum(constant * share)

    def loaded_gap(self, x: np.ndarray) -> np.ndarray:
        """Gap [m] at x [m] under the pressures: zero where these are, positive elsewhere."""
        x = np.asarray(x, dtype=float)
        gap = np.zeros_like(x)
        parts = [
            2.0 / self.modulus * (patch.sinking(x, inner=True) - patch.sinking(x))
            for patch in self.patches
        ]
        for left, right, before, after in zip(
            self.patches, self.patches[1:], parts, parts[1:], strict=False
        ):
            low, high = left.edges[1], right.edges[0]
            here = (x > low) & (x < high)
            step = _step((x[here] - low) / (high - low))
            gap[here] = before[here] * (1.0 - step) + after[here] * step
        first, last = x < self.ends[0], x > self.ends[1]
        gap[first], gap[last] = parts[0][first], parts[-1][last]
        return gap

    def gap(self, x: np.ndarray) -> np.ndarray:
        """Initial gap g0 [m] at x (n,) [m], but for a constant."""
        return self.loaded_gap(x) - self.displacement(x)

    def stress(self, x: np.ndarray, z: np.ndarray) -> StressState:
        """Stresses [Pa] in the body at x, z >= 0 [m], broadcast; of a layer within it."""
        x, z = points_below(x, z)
        total = StressState(*np.zeros((3, *x.shape)))
        for patch in self.patches:
            total = total.plus(1.0, patch.stress(x, z, self.friction))
        if self.layer is None:
            return total
        self._check_reach(x)
        k, load, _ = self._waves
        load = load / self.layer.thickness
        sums, mu = np.zeros((3, *x.shape)), self.friction
        for depth in np.unique(z):
            p, q = added_stress(self.layer, k, np.full(len(k), depth))
            wave = np.exp(1j * np.outer(x[z == depth], k)) * load
            even, odd = wave.real, wave.imag
            sums[:, z == depth] = (
                even @ p.sx - odd @ (mu * q.sx),
                even @ p.sz - odd @ (mu * q.sz),
                odd @ p.txz + even @ (mu * q.txz),
            )
        return total.plus(1.0, StressState(*sums))

    def extremes(self, depth: float) -> dict[str, Extremum]:
        """Largest tau1 and largest |txz| by name, 0 <= z <= `depth` [m] below the patches."""
        return {
            "tau1": self._highest(lambda stress: stress.tau1, depth),
            "txz": self._highest(lambda stress: abs(stress.txz), depth),
        }

    def _highest(self, value: Callable[[StressState], np.ndarray], depth: float) -> Extremum:
        """Best of points around every patch, then of ever closer ones around the best of these."""
        starts = []
        for patch in self.patches:
            along = patch.centre + patch.half_width * _PLACES
            x, z = np.meshgrid(along, patch.half_width * _DEPTHS)
            inside = z <= depth
            x, z = x[inside], z[inside]
            values = value(self.stress(x, z))
            for best in np.argsort(values)[-_STARTS:]:
                starts.append((values[best], x[best], z[best], 0.1 * patch.half_width))
        top, *place, step = np.array(sorted(starts)[-_STARTS:]).T
        place, rows = np.column_stack(place), np.arange(len(top))
        stencil = np.array([(i, j) for i in range(-2, 3) for j in range(-2, 3)]) / 2.0
        for _ in range(_ZOOMS):
            at = place[:, None] + step[:, None, None] * stencil
            at[..., 1] = np.clip(at[..., 1], 0.0, depth)
            values = value(self.stress(at[..., 0], at[..., 1]))
            best = values.argmax(axis=1)
            values, at = values[rows, best], at[rows, best]
            place = np.where((values > top)[:, None], at, place)
            top, step = np.maximum(values, top), _ZOOM * step
        best = top.argmax()
        return Extremum(float(top[best]), *map(float, place[best]))

    @cached_property
    def _waves(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Wavenumbers k [1/m], the pressures' transform [N/m] times weights k t / pi, and these."""
        thickness, extent = self.layer.thickness, np.ptp(self.ends)
        contrast = self.layer.contrast
        w, weights = wave_panels(_HIGHEST, 4.0 * extent / thickness, finest_scale(contrast))
        load = sum(patch.transform(w / thickness) for patch in self.patches)
        return w / thickness, load * weights / np.pi, weights / np.pi

    def _check_reach(self, x: np.ndarray) -> None:
        """Raise ValueError for x that the waves are not dense enough for."""
        extent = np.ptp(self.ends)
        if np.any(x < self.ends[0] - extent) or np.any(x > self.ends[1] + extent):
            raise ValueError("x must lie within the contact's extent from its ends")


def random_patches(
    seed: int, count: int, half_width: float, pressure: float
) -> tuple[PressurePatch, ...]:
    """`count` patches about x = 0 within `half_width` [m], peaks up to about `pressure` [Pa].
    Half-widths, distances, peaks and q = (s - u)^2 + v^2 are drawn from the seed."""
    draw = np.random.default_rng(seed)
    widths = np.exp(draw.uniform(-0.6, 0.6, count))
    apart = draw.uniform(0.3, 1.5, count - 1) * (widths[1:] + widths[:-1])
    right = np.cumsum(2.0 * widths) + np.append(0.0, np.cumsum(apart))
    centres, whole = right - widths, right[-1]
    unit, made = 2.0 * half_width / whole, []
    for centre, width in zip(centres, widths, strict=True):
        u, v = draw.uniform(-0.6, 0.6), draw.uniform(0.7, 1.6)
        shape = np.array([u**2 + v**2 + 0.25, -u, 0.25])
        patch = PressurePatch((centre - 0.5 * whole) * unit, width * unit, tuple(shape))
        scale = pressure * draw.uniform(0.4, 1.0) / patch.peak
        made.append(PressurePatch(patch.centre, patch.half_width, tuple(scale * shape)))
    return tuple(made)


def _decaying(s: np.ndarray, depth: np.ndarray) -> np.ndarray:
    """v at s, depth >= 0 in half-widths: the root of v + 1/v = 2 z with |v| <= 1."""
    z = np.empty(np.shape(s), dtype=complex)
    z.real, z.imag = s, np.abs(depth)
    return 1.0 / (z + np.sqrt(z - 1.0) * np.sqrt(z + 1.0))


def _step(s: np.ndarray) -> np.ndarray:
    """Polynomial from 0 at s = 0 to 1 at s = 1, flat at both to SMOOTHNESS derivatives."""
    m = SMOOTHNESS
    bump = Polynomial([0.0, 1.0]) ** m * Polynomial([1.0, -1.0]) ** m
    whole = bump.integ()
    return whole(s) / whole(1.0)
