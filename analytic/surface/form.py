"""Removing a measured trace's form before its roughness is pressed: mean, tilt or arc.

All fits are least squares of the height, each sample weighted by the stretch of x that it
stands for (trapezoid rule), so that crowded samples do not pull the fit.

Nomenclature
  u       x from the middle of the trace over its half length l, -1 <= u <= 1
  s       sine of the arc's slope angle; s0 at u = 0, and s = s0 - k u along a circle
  k       l / radius, positive where the arc is convex (its middle stands out of the body)"""

from dataclasses import dataclass
from math import inf, isinf, sqrt

import numpy as np

from analytic.profile import Profile

FORMS = ("none", "mean", "line", "arc")
STEEPEST = 0.999  # sine of the slope angle: beyond it heights over x no longer describe an arc
STEPS = 100  # Gauss-Newton needs 2 to 10; more than this means that it does not converge
CLOSE = 1e-3  # of the residual: changes of the fit below this converge without supervision
LAST_CHANGE = 1e-9  # of the residual: the last change of the fit
STRAIGHT = 64.0 * np.finfo(float).eps  # a sagitta below this part of the heights is rounding


@dataclass(frozen=True)
class RemovedForm:
    """Form that `remove_form` took away."""

    kind: str  # none | mean | line | arc
    mean: float = 0.0  # [m] mean height of the trace before removal; 0 if nothing was removed
    # slope of the line, or of the arc in the middle of the trace; 0 for the others
    slope: float = 0.0
    # [m] of the arc, positive if convex (crowned), negative if concave, inf if straight
    radius: float = inf

    def __str__(self) -> str:
        mean, slope = f"mean height {self.mean:.6g} m", f"slope {self.slope:.6g}"
        if self.kind == "none":
            return "no form removed"
        if self.kind == "mean":
            return f"{mean} removed"
        if self.kind == "line":
            return f"line removed: {mean}, {slope}"
        if isinf(self.radius):
            return f"arc removed: straight (no radius), {mean}, {slope}"
        bend = "convex" if self.radius > 0.0 else "concave"
        return f"arc removed: {bend}, radius {abs(self.radius):.6g} m, {mean}, {slope}"


def remove_form(profile: Profile, form: str) -> tuple[Profile, RemovedForm]:
    """The profile without its `form` (none | mean | line | arc), and what that form was. x stays as
    it is. Raises ValueError for another form, or if no arc fits the trace."""
    if form not in FORMS:
        raise ValueError(f"form is {form!r}; allowed: {', '.join(FORMS)}")
    if form == "none":
        return profile, RemovedForm("none")
    weight = trapezoid_widths(profile.x)
    mean = float(np.average(profile.height, weights=weight))
    level = profile.height - mean
    half = 0.5 * profile.length
    u = (profile.x - profile.x[0]) / half - 1.0
    if form == "mean":
        return Profile(profile.x, level), RemovedForm("mean", mean)
    if form == "line":
        offset, slope = _weighted_fit(np.stack((np.ones_like(u), u), axis=1), level, weight)
        return (
            Profile(profile.x, level - (offset + slope * u)),
            RemovedForm("line", mean, float(slope) / half),
        )
    offset, s0, k = _fit_arc(u, level / half, weight)
    arc, _ = _arc(u, s0, k)
    straight = 0.5 * abs(k) * half <= STRAIGHT * np.max(np.abs(profile.height))
    return (
        Profile(profile.x, level - half * (offset + arc)),
        RemovedForm("arc", mean, s0 / sqrt(1.0 - s0**2), inf if straight else half / k),
    )


def trapezoid_widths(x: np.ndarray) -> np.ndarray:
    """Stretch of x that each sample stands for, (n,) [m]; they add up to the length."""
    steps = np.diff(x)
    return 0.5 * (np.append(steps, 0.0) + np.append(0.0, steps))


def _weighted_fit(basis: np.ndarray, target: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Coefficients (m,) of the `basis` (n, m) that fit `target` (n,) best."""
    root = np.sqrt(weight / np.sum(weight))
    return np.linalg.lstsq(basis * root[:, None], target * root, rcond=None)[0]


def _arc(u: np.ndarray, s0: float, k: float) -> tuple[np.ndarray, np.ndarray]:
    """Height (n,) over half length of a circle through (0, 0), and its derivatives (n, 2) by s0, k.
    Along a circle s = s0 - k u and height' = s / c with c = sqrt(1 - s^2), so that the height is
    (c - c0) / k. Written as u (s0 + s) / (c0 + c) it subtracts nothing and holds at k = 0 too."""
    s = s0 - k * u
    c, c0 = np.sqrt((1.0 - s) * (1.0 + s)), sqrt((1.0 - s0) * (1.0 + s0))
    above, below = s0 + s, c0 + c
    by_s0 = u * (2.0 * below + above * (s / c + s0 / c0)) / below**2
    by_k = -(u**2) * (below + above * s / c) / below**2
    return u * above / below, np.stack((by_s0, by_k), axis=1)


def _fit_arc(u: np.ndarray, height: np.ndarray, weight: np.ndarray) -> tuple[float, float, float]:
    """Offset, s0 and k of the circle nearest to `height` (over half length), by Gauss-Newton.
    From the parabola on, a step that leaves the circle or does not improve the fit is shortened;
    once the steps are close to the end, where rounding hides their gain, they are taken whole.
    Raises ValueError if there is no way on while the step wanted is still large."""
    ones = np.ones_like(u)
    offset, slope, bend = _weighted_fit(np.stack((ones, u, -0.5 * u**2), axis=1), height, weight)
    s0 = slope / np.hypot(1.0, slope)
    k = bend * (1.0 - s0**2) ** 1.5
    scale = min(1.0, 0.95 * STEEPEST / max(abs(s0) + abs(k), 1e-300))
    state = np.array([offset, scale * s0, scale * k])
    rounding = STRAIGHT * np.max(np.abs(height))

    def misfit(trial: np.ndarray) -> float:
        if abs(trial[1]) + abs(trial[2]) >= STEEPEST:
            return inf
        return np.sqrt(
            np.average((height - trial[0] - _arc(u, *trial[1:])[0]) ** 2, weights=weight)
        )

    for _ in range(STEPS):
        arc, slopes = _arc(u, *state[1:])
        jacobian = np.column_stack((ones, slopes))
        wanted = _weighted_fit(jacobian, height - state[0] - arc, weight)
        change = np.sqrt(np.average((jacobian @ wanted) ** 2, weights=weight))
        residual = misfit(state)
        accepted = inf if change <= CLOSE * residual + rounding else residual
        shares = (2.0**-halving for halving in range(30))
        share = next((a for a in shares if misfit(state + a * wanted) < accepted), None)
        if share is None:
            break
        state = state + share * wanted
        if change <= LAST_CHANGE * residual + rounding:
            return float(state[0]), float(state[1]), float(state[2])
    raise ValueError(
        "no circular arc fits the profile: it would stand upright at an end; remove a line instead"
    )
