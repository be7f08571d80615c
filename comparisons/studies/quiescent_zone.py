"""The quiescent zone: a layer of low shear between the asperities' zone and the Hertz zone.

    f(z)    root mean square of tau1 over |x| <= a at the depth z: f^2 is the mean density of the
            shear energy in the plane times 2 G
    f_H     largest f from DEEP a on: the Hertz zone
    f_q     least f of the dip between f_H and a shallower maximum f_A, the asperities' zone; of
            several dips the one that falls farthest below both
    level   f_q / f_H                 ratio   f_q / min(f_A, f_H)

The zone reaches over the depths about the least f where f < QUIET min(f_A, f_H). It is

    quiescent         ratio < QUIET
    no asperity zone  else, and level < QUIET: shear grows with depth as below smooth bodies
    bridged           else: from the asperities down it falls nowhere below QUIET of both; f_q is
                      then the least f below the largest one

and inconclusive where the uncertainty of the ratio reaches across QUIET. A mean square has no edge
or peak that a mesh or a window could miss, every depth and place counts alike in both models, and
nothing says beforehand how deep asperities reach. The same rule on the largest tau1 below a single
asperity tells which of them bridge the zone.

QUIET is three quarters: by Lundberg and Palmgren, life goes with tau^-9.3 (c/e = 31/3 : 10/9), and
a quarter less shear lasts an order of magnitude longer."""

from dataclasses import dataclass, fields
from math import inf, isfinite, nan

import numpy as np
from scipy.interpolate import CubicSpline

from comparisons.figures.convergence import grid_convergence
from comparisons.figures.uncertainty import iteration
from comparisons.models.level import Level, ModelRun
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.studies.contact import DEEP, by_repetition

QUIET = 0.75
QUIESCENT, BRIDGED, SMOOTH, UNCLEAR = "quiescent", "bridged", "no asperity zone", "inconclusive"
FINE = 16  # points to an interval of depth, between which the spline through it is searched
ORDER = 1.0  # formal, as of the fields' norms
DEEPEST = 0.8  # a: as far down the Hertz zone's maximum may lie, and the fields must reach
SHORT = 0.02  # of what they must reach to, by which they may end before


@dataclass(frozen=True)
class ShearDip:
    """Shear over depth between two maxima, on any scales of both."""

    level: float  # as above
    ratio: float
    depth: float  # of the least shear
    start: float  # of the zone; nan where there is none, as the stop
    stop: float
    asperity: float  # the maxima of both zones
    asperity_depth: float
    hertz: float
    hertz_depth: float
    status: str  # quiescent | bridged | no asperity zone


FIGURES = tuple(each.name for each in fields(ShearDip) if each.type is float)


def shear_dip(z: np.ndarray, shear: np.ndarray, deep: float) -> ShearDip:
    """The dip of `shear` (m,) over depths z (m,), ascending from the surface; the Hertz zone's
    maximum is sought from `deep` on. Between the points runs a C2 cubic spline."""
    known = np.isfinite(shear)
    places = np.arange(np.count_nonzero(known), dtype=float)
    fine = np.linspace(0.0, places[-1], FINE * (len(places) - 1) + 1)
    spline = CubicSpline(z[known], shear[known])
    z = np.interp(fine, places, z[known])
    bottom = int(np.argmax(np.where(z >= deep, spline(z), -inf)))
    z, shear = z[: bottom + 1], spline(z[: bottom + 1])
    hertz, peak = shear[-1], int(np.argmax(shear))
    low = int(np.argmax(np.minimum(np.maximum.accumulate(shear), hertz) - shear))
    top = int(np.argmax(shear[: low + 1]))
    if peak < bottom and shear[low] >= QUIET * min(shear[top], hertz):
        low, top = peak + int(np.argmin(shear[peak:])), peak
    least = min(shear[top], hertz)
    level, ratio = shear[low] / hertz, shear[low] / least if least > 0.0 else 1.0
    ends, status = (nan, nan), SMOOTH if level < QUIET else BRIDGED
    if ratio < QUIET:
        status, loud = QUIESCENT, np.flatnonzero(shear >= QUIET * least)
        above, below = loud[loud < low][-1], loud[loud > low][0]
        pairs = [above + 1, above], [below - 1, below]
        ends = tuple(np.interp(QUIET * least, shear[pair], z[pair]) for pair in pairs)
    figures = (level, ratio, z[low], *ends, shear[top], z[top], hertz, z[-1])
    return ShearDip(*map(float, figures), status)


def mean_shear(problem: Problem, window: Window, tau1: np.ndarray, every: int = 1) -> np.ndarray:
    """Root mean square (m,) of tau1 (m, k) over |x| <= a, on every n-th column of the window; of
    what lies in the body where its boundary is rough."""
    a, x = problem.hertz.half_width, window.x[::every]
    half = 0.5 * (x[1] - x[0])
    weights = np.clip(np.minimum(x + half, a) - np.maximum(x - half, -a), 0.0, None)
    square = tau1[:, ::every] ** 2
    inside = np.where(np.isfinite(square), weights, 0.0)
    with np.errstate(invalid="ignore"):
        return np.sqrt(np.sum(np.nan_to_num(square) * inside, axis=1) / np.sum(inside, axis=1))


def zone_of(
    problem: Problem, level: Level, window: Window, friction: float, every: int = 1
) -> ShearDip:
    """Of one level, read on every n-th row and column of the window; Pa and m."""
    tau1 = level.stress(friction).field.tau1[::every]
    shear = mean_shear(problem, window, tau1, every)
    return shear_dip(window.z[::every], shear, DEEP * problem.hertz.half_width)


@dataclass(frozen=True)
class AsperityDip:
    """Below one asperity: its place and length of contact [m], and the dip of the largest shear."""

    x: float
    length: float
    dip: ShearDip


def asperity_dips(
    problem: Problem, level: Level, window: Window, friction: float
) -> list[AsperityDip]:
    """The dip under each asperity that touches at |x| <= a, its zone as wide as the asperity."""
    a, tau1 = problem.hertz.half_width, level.stress(friction).field.tau1
    found, tau1 = [], np.where(np.isfinite(tau1), tau1, -inf)
    for start, stop in zip((-inf, *problem.asperities), (*problem.asperities, inf), strict=True):
        columns = (window.x >= max(start, -a)) & (window.x < min(stop, a))
        patches = np.clip(level.patches, max(start, -a), min(stop, a))
        lengths = np.diff(patches, axis=1)[:, 0]
        if not np.any(columns) or lengths.sum() <= 0.0:
            continue
        shear = np.max(tau1[:, columns], axis=1)
        place = float(lengths @ patches.mean(axis=1) / lengths.sum())
        dip = shear_dip(window.z, np.where(np.isfinite(shear), shear, nan), DEEP * a)
        found.append(AsperityDip(place, float(lengths.sum()), dip))
    return found


@dataclass(frozen=True)
class QuiescentZone:
    """Of one model at one friction: the dip on its finest level, what numerical error may account
    for in each of its figures, and the dips below single asperities."""

    friction: float
    dip: ShearDip
    uncertainty: dict[str, float]
    asperities: tuple[AsperityDip, ...]

    @property
    def status(self) -> str:
        across = abs(self.dip.ratio - QUIET) <= self.uncertainty["ratio"]
        return UNCLEAR if across else self.dip.status

    def as_dict(self) -> dict:
        """For result.json: SI, None for what is unknown or not there."""
        figures = {
            name: {"value": _known(getattr(self.dip, name)), "uncertainty": _known(size)}
            for name, size in self.uncertainty.items()
        }
        below = [
            {"x": each.x, "length": each.length, "level": each.dip.level, "status": each.dip.status}
            for each in self.asperities
        ]
        bridged = sum(each["status"] == BRIDGED for each in below)
        account = {"bridged": bridged, "asperities": below}
        return {"friction": self.friction, "status": self.status, **figures, **account}


def quiescent_zone(
    problem: Problem, run: ModelRun, window: Window, friction: float
) -> QuiescentZone:
    """Of a finished run of one model. Uncertainty: discretisation, far boundary, iteration, and
    what reading every second row and column of the window changes, added."""
    levels = [zone_of(problem, level, window, friction) for level in run.levels]
    coarse = zone_of(problem, run.finest, window, friction, every=2)
    repeated = by_repetition(
        run,
        lambda level: {k: getattr(zone_of(problem, level, window, friction), k) for k in FIGURES},
    )
    found = {}
    for name in FIGURES:
        values = [getattr(each, name) for each in levels]
        size = grid_convergence(values, ORDER).uncertainty if np.all(np.isfinite(values)) else nan
        size += iteration(run.finest) * abs(values[-1]) + abs(getattr(coarse, name) - values[-1])
        found[name] = float(size + sum(repeated[name]))
    asperities = tuple(asperity_dips(problem, run.finest, window, friction))
    return QuiescentZone(friction, levels[-1], found, asperities)


def quiescent_zones(
    problem: Problem, runs: dict[str, ModelRun], window: Window | None
) -> dict | None:
    """The content of result.json: by model, one entry a friction coefficient. None without a rough
    profile or fields; `why` in place of the models where the field does not reach far enough."""
    if problem.scene.profile is None or window is None:
        return None
    ends = min(window.x[-1], -window.x[0]), window.z[-1]
    for name, end, least in zip(("half_range", "depth"), ends, (1.0, DEEPEST), strict=True):
        if end < least * problem.hertz.half_width * (1.0 - SHORT):
            return {"why": f"stress.{name} is less than {least:g} a"}
    return {
        name: [
            quiescent_zone(problem, run, window, mu).as_dict() for mu in problem.scene.load.friction
        ]
        for name, run in runs.items()
    }


def _known(value: float) -> float | None:
    return value if isfinite(value) else None
