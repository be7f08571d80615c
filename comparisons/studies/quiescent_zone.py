"""The quiescent zone: a layer of low shear between the asperities' zone and the Hertz zone.

In: the fields of a solved scene with a rough surface. Out: the dip's figures by model and friction,
its state, and the asperities that bridge it.

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
or peak that a mesh or a window could miss, every depth and x counts alike in both models, and
nothing says beforehand how deep asperities reach. The same rule on the largest tau1 below a single
asperity tells which of them bridge the zone.

QUIET is three quarters: by Lundberg and Palmgren, life goes with tau^-9.3 (c/e = 31/3 : 10/9), and
a quarter less shear lasts an order of magnitude longer."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise
from math import inf, isfinite, nan
from operator import attrgetter

import numpy as np
from scipy.interpolate import CubicSpline

from comparisons.common.numbers import plain, significant
from comparisons.figures.figure import Column, Figure, Findings, Series, Statement
from comparisons.figures.quantity import LABELS, Quantity
from comparisons.figures.uncertainty import Reading, iteration
from comparisons.judging.rule import judged_by
from comparisons.judging.study import Case, Run, Solved, Study
from comparisons.models.level import Level, Solution
from comparisons.models.problem import Problem

NAME = "quiescent_zone"
_depth = partial(Quantity, unit="m", scale=attrgetter("half_width"), over=(1.0, "a"))
QUANTITIES = {  # of a dip, in the order of `shear_dips`
    "level": Quantity("least shear over the Hertz zone's"),
    "ratio": Quantity("least shear over the smaller maximum"),
    "depth": _depth("depth of the least shear"),
    "start": _depth("where the quiescent zone starts"),
    "stop": _depth("where the quiescent zone stops"),
    "asperity": Quantity("largest shear of the asperities' zone", "Pa"),
    "asperity_depth": _depth("its depth"),
    "hertz": Quantity("largest shear of the Hertz zone", "Pa"),
    "hertz_depth": _depth("its depth"),
}
STATE, ASPERITIES = "state", "asperities"
NOTE = """The layer of low shear between the asperities' stresses and those of the Hertz
contact, where the root mean square of τ₁ over |x| ≤ a is less than three quarters of its maxima
above and below; shaded in the sections. Bridged: it is less nowhere on the way down. No asperity
zone: it grows with depth as below smooth bodies. An asperity bridges the zone where the largest τ₁
below it does not fall so far."""
QUIET = 0.75
QUIESCENT, BRIDGED, SMOOTH, UNCLEAR = "quiescent", "bridged", "no asperity zone", "inconclusive"
DEEP = 0.5  # a: where the Hertz zone begins
FINE = 16  # points to an interval of depth, between which the spline through it is searched
ORDER = 1.0  # formal, as of the fields' norms
DEEPEST = 0.8  # a: as far down the Hertz zone's maximum may lie, and the fields must reach
SHORT = 0.02  # of what they must reach to, by which they may end before


def shear_dips(z: np.ndarray, shears: np.ndarray, deep: float) -> list[dict[str, float]]:
    """The QUANTITIES of the dip of each of `shears` (k, m) over depths z (m,), ascending from the
    surface, on any scales of both; ends of no zone are nan. The Hertz zone's maximum is sought from
    `deep` on. Between the points runs a C2 cubic spline, searched at FINE points an interval."""
    known = np.isfinite(shears)
    if not known.all():
        alone = (shear_dips(z[k], row[k][None], deep) for k, row in zip(known, shears, strict=True))
        return [dip for [dip] in alone]
    places = np.arange(len(z), dtype=float)
    fine = np.interp(np.linspace(0.0, places[-1], FINE * (len(z) - 1) + 1), places, z)
    return [_dip(fine, shear, deep) for shear in CubicSpline(z, shears, axis=1)(fine)]


def _dip(z: np.ndarray, shear: np.ndarray, deep: float) -> dict[str, float]:
    bottom = int(np.argmax(np.where(z >= deep, shear, -inf)))
    z, shear = z[: bottom + 1], shear[: bottom + 1]
    hertz, peak = shear[-1], int(np.argmax(shear))
    low = int(np.argmax(np.minimum(np.maximum.accumulate(shear), hertz) - shear))
    top = int(np.argmax(shear[: low + 1]))
    if peak < bottom and shear[low] >= QUIET * min(shear[top], hertz):
        low, top = peak + int(np.argmin(shear[peak:])), peak
    least = min(shear[top], hertz)
    level = shear[low] / hertz if hertz > 0.0 else 1.0
    ratio = shear[low] / least if least > 0.0 else 1.0
    ends = nan, nan
    if ratio < QUIET:
        loud = np.flatnonzero(shear >= QUIET * least)
        above, below = loud[loud < low][-1], loud[loud > low][0]
        pairs = [above + 1, above], [below - 1, below]
        ends = tuple(np.interp(QUIET * least, shear[pair], z[pair]) for pair in pairs)
    numbers = (level, ratio, z[low], *ends, shear[top], z[top], hertz, z[-1])
    return dict(zip(QUANTITIES, map(float, numbers), strict=True))


def state_of(dip: Mapping[str, float]) -> str:
    """State of the quiescent zone: whether there is one, and if not, why."""
    if dip["ratio"] < QUIET:
        return QUIESCENT
    return SMOOTH if dip["level"] < QUIET else BRIDGED


def mean_shear(problem: Problem, tau1: np.ndarray, every: int = 1) -> np.ndarray:
    """Root mean square (m,) of tau1 (m, k) over |x| <= a, on every n-th column of the window; of
    what lies in the body where its boundary is rough."""
    a, x = problem.hertz.half_width, problem.window.x[::every]
    half = 0.5 * (x[1] - x[0])
    weights = np.clip(np.minimum(x + half, a) - np.maximum(x - half, -a), 0.0, None)
    square = tau1[:, ::every] ** 2
    inside = np.where(np.isfinite(square), weights, 0.0)
    with np.errstate(invalid="ignore"):
        return np.sqrt(np.sum(np.nan_to_num(square) * inside, axis=1) / np.sum(inside, axis=1))


def zone_of(problem: Problem, level: Level, every: int = 1) -> dict[str, float]:
    """`shear_dips` of one level, read on every n-th row and column of the window; Pa and m."""
    tau1 = level.stress.field.tau1[::every]
    shear = mean_shear(problem, tau1, every)
    [dip] = shear_dips(problem.window.z[::every], shear[None], DEEP * problem.hertz.half_width)
    return dip


def asperity_rows(problem: Problem, level: Level) -> list[dict[str, object]]:
    """Rows, one an asperity that touches at |x| <= a, of a zone as wide: x and length of its
    contact [m], and the dip of the largest shear below it."""
    a, tau1, window = problem.hertz.half_width, level.stress.field.tau1, problem.window
    rows, shears, tau1 = [], [], np.where(np.isfinite(tau1), tau1, -inf)
    for ends in pairwise(np.clip((-inf, *problem.asperities, inf), -a, a)):
        columns = slice(*np.searchsorted(window.x, ends))
        patches = np.clip(level.patches, *ends)
        lengths = np.diff(patches, axis=1)[:, 0]
        length = float(lengths.sum())
        if columns.start == columns.stop or length <= 0.0:
            continue
        shear = np.max(tau1[:, columns], axis=1)
        shears.append(np.where(np.isfinite(shear), shear, nan))
        rows.append({"x": float(lengths @ patches.mean(axis=1) / length), "length": length})
    dips = shear_dips(window.z, np.array(shears), DEEP * a) if shears else ()
    return [
        row | {"level": dip["level"], "state": state_of(dip)}
        for row, dip in zip(rows, dips, strict=True)
    ]


def zone_figures(case: Case, run: Solution) -> tuple[tuple[Figure, ...], str]:
    """Figures of a model: the dip on its finest level, and its state. Uncertainty: discretisation,
    far boundary, iteration, and what reading every second row and column of the window changes."""
    coarse, unsolved = zone_of(case.problem, run.finest, 2), iteration(run.finest.solution)

    def how(name: str, value: float) -> Reading:
        return Reading(ORDER, abs(value) or 1.0, iteration=unsolved * bool(value))

    figures, read = {}, partial(zone_of, case.problem)
    for name, figure in judged_by(NAME, [run], read, how, case.at).items():
        stated, apart = figure.uncertainty, abs(coarse[name] - figure.value) / figure.scale
        parts = {**stated.parts, "reading": apart}
        parts = {cause: size if isfinite(size) else inf for cause, size in parts.items()}
        if isfinite(figure.value):
            figures[name] = replace(figure, uncertainty=replace(stated, parts=parts))
    ratio, state = figures["ratio"], state_of({name: f.value for name, f in figures.items()})
    is_unclear = abs(ratio.value - QUIET) <= ratio.numerical * ratio.scale
    return tuple(figures.values()), UNCLEAR if is_unclear else state


def needs(solved: Solved) -> str | None:
    """Why the field does not show a zone, None where it does."""
    window, half_width = solved.problem.window, solved.problem.hertz.half_width
    if solved.problem.scene.periodic:
        return "below a periodic surface there is no Hertz zone"
    ends = min(window.x[-1], -window.x[0]), window.z[-1]
    for name, end, least in zip(("half_range", "depth"), ends, (1.0, DEEPEST), strict=True):
        if end < least * half_width * (1.0 - SHORT):
            return f"stress.{name} is less than {least:g} a"
    return None


def solve(solved: Solved, before: Mapping[str, Findings], tasks: object) -> Findings:
    """Dips of every model at every friction coefficient, and those below single asperities."""
    figures, series, states = [], [], []
    units = {"x": "m", "length": "m", "level": "", "state": ""}.items()
    for name in solved.runs:
        for case in solved.cases:
            of_zone, state = zone_figures(case, case.runs[name])
            figures += of_zone
            states.append(Statement(STATE, state, name, case.at))
            rows = asperity_rows(case.problem, case.runs[name].finest)
            columns = {key: Column(tuple(row[key] for row in rows), unit) for key, unit in units}
            series.append(Series(ASPERITIES, columns, name, case.at))
    return Findings(tuple(figures), tuple(series), tuple(states))


@dataclass(frozen=True)
class Zone:
    """One model's zone at one friction coefficient, for whoever shows it."""

    model: str
    friction: float
    state: str
    figures: dict[str, Figure]  # by quantity, as far as there are any
    bridged: int  # so many of the asperities
    asperities: int


def zones_of(findings: Findings | None) -> list[Zone]:
    """Zones by model, then by friction coefficient."""
    zones = []
    for said in findings.statements if findings else ():
        if said.name == STATE:
            known = (f for f in findings.figures if (f.source, f.at) == (said.source, said.at))
            states = findings.table(ASPERITIES, said.source, **said.at).columns["state"].values
            figures, friction = {f.quantity: f for f in known}, said.at["friction"]
            counts = states.count(BRIDGED), len(states)
            zones.append(Zone(said.source, friction, said.text, figures, *counts))
    return zones


def facts(run: Run) -> list[tuple[str, str]]:
    """Numbers of asperities that bridge the zone, by model and friction coefficient."""
    return [
        (
            f"asperities that bridge it, {LABELS[zone.model]}, friction {plain(zone.friction)}",
            f"{zone.bridged} of {zone.asperities}",
        )
        for zone in zones_of(run.findings[NAME])
    ]


def lines(run: Run) -> list[tuple[str, str]]:
    """The first model's zone at every friction coefficient."""
    zones, a = zones_of(run.findings[NAME]), run.problem.hertz.half_width
    said = "; ".join(_said(zone, a) for zone in zones if zone.model == zones[0].model)
    return [("quiescent zone", said)] if said else []


def _said(zone: Zone, a: float) -> str:
    words = zone.state
    if words == QUIESCENT:
        ends = (significant(zone.figures[name].value / a, 3) for name in ("start", "stop"))
        words = f"{' a to '.join(ends)} a deep"
    if words != BRIDGED and zone.bridged:
        words += f", bridged under {zone.bridged} of {zone.asperities} asperities"
    level = significant(zone.figures["level"].value, 3)
    return f"friction {plain(zone.friction)}: {words}, least shear {level} of the Hertz zone's"


STUDY = Study(
    name=NAME,
    quantities=QUANTITIES,
    applies=lambda solved: bool(solved.problem.scene.profile and solved.problem.window),
    needs=needs,
    solve=solve,
    title="Quiescent zone",
    section="stresses",
    note=NOTE,
    shown=(*tuple(QUANTITIES)[:5], STATE),
    facts=facts,
    lines=lines,
)
