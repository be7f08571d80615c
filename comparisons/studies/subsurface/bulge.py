"""What a sliding contact raises ahead of itself, against what it leaves behind.

In: the finite elements' levels and the fields in the window. Out: height, place, extent and energy
of the bulge by friction coefficient, its curve, and the same of every patch.

    v(x)    how far the traction q = mu p, in +x on the body, raises the surface [m]
    c       centre of the load       s   distance from it
    B(s)    v(c + s) - v(c - s): no datum enters, and no sinking by the pressure
    h       a^2/R, penetration of a roller of the radius R

On a half-plane a traction leaves the surface ahead lower by a step (Johnson 1985, section 2.4)

    B(s) = -(1 - 2 nu) (1 + nu)/E  int q dx over |x - c| <= s,

whatever the roughness: no bulge, but the opposite of one, constant outside the contact and absent
where nu = 1/2. Below a rigid roller it is -(pi/4) mu (1 - 2 nu)/(1 - nu) h. It does no work on the
pressure, for its kernel is odd: int p v dx = 0. The bulge is what B exceeds this step by: it takes
a base below, flow, or slopes of a boundary that is meshed as it is. The same holds about the centre
of any patch's load, as far as the next patches: B and the step there are those of the patch."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import griddata

from analytic.statistics.penetration import contact_kind, relative_penetration
from comparisons.common.numbers import percent, plain, significant, with_unit
from comparisons.drawing import style
from comparisons.drawing.blocks import Block, Heading, Note, Pictures, TextTable
from comparisons.figures.convergence import grid_convergence
from comparisons.figures.figure import (
    Column,
    Figure,
    Figures,
    Findings,
    Series,
    columns_of,
    figures_of,
)
from comparisons.figures.quantity import Quantity
from comparisons.figures.uncertainty import Uncertainty, far_boundary, iteration, of_increments
from comparisons.models.level import Level, ModelRun
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.studies import contact
from comparisons.studies.statistics.study import STRAIN, patch_loads
from comparisons.studies.study import WHY_NOT, Run, Solved, Study

NAME, MODEL = "bulge", "finite_element"
QUANTITIES = {
    "height": Quantity("bulge ahead of the load's centre", "m"),
    "half_plane": Quantity("the half-plane's step there", "m"),
    "at": Quantity("distance of the bulge from the centre", "m"),
    "end": Quantity("distance from which it is below half its height", "m"),  # within 20 a
    "penetration": Quantity("penetration h", "m"),
    "over_penetration": Quantity("bulge over h"),
    "relative_penetration": Quantity("h/R"),
    "contact": Quantity("half of the contact length", "m"),
    "work_scale": Quantity("P h", "J/m"),
    "plastic_strain": Quantity("largest plastic strain"),
    "work": Quantity("work of the pressure on what the traction raises, over that without signs"),
    "energy": Quantity("elastic energy ahead less behind", "J/m"),
    "energy_ahead": Quantity("share of the elastic energy that is ahead"),
}
CURVE, PATCHES = "curve", "patches"
DISTANCES = np.geomspace(0.02, 20.0, 121)  # a
NEAR = 5.0  # a: within which the largest excess is looked for
ORDER = 1.0  # formal
HALF = 0.5  # of its height: where a bulge ends
FARTHEST = 5.0  # a, of the picture
BULGE = {"color": "#222222", "marker": "_", "linewidth": 0.8}
NOTE = """By how much the sliding traction leaves the surface ahead of the load's centre higher than
as far behind it. Half-plane: lower by a step, exact for the same pressure. Bulge: what the finite
elements exceed that by; h = a²/R. Work: that of the pressure on what the traction raises, over the
same without signs. Energy: elastic, ahead less behind in the field, and by model the share ahead.
Patches: about the centre of each one's own load, as far as the next, over its own h; class by h/R.
"""


@dataclass(frozen=True)
class Excess:
    """The largest excess of B over the half-plane's, whose `half_plane` is exact for its pressure:
    height, half_plane, at and end [m], each with its uncertainty [m]."""

    values: Mapping[str, float | None]  # None: no end within 20 a
    uncertainties: Mapping[str, float]  # of an end by the levels; infinite where one has none
    curve: np.ndarray  # (n,) [m] B of the finest level
    tilt: float  # of the surface, that the far boundary makes


def needs(solved: Solved) -> str | None:
    """What it takes and the scene does not have."""
    scene = solved.problem.scene
    elements, few = scene.finite_element, len(scene.load.friction) == 1
    lone = scene.profile and (few or elements.coupled) and not elements.plastic
    if MODEL not in solved.plan.models or not any(scene.load.friction):
        return "it takes the finite elements, and friction"
    if lone and elements.deformation == "finite":
        return "it takes small strains: at finite ones every friction has pressures of its own"
    if lone and not few:
        return "it takes finite_element.coupled = false: the same pressures at every friction"
    return "it takes a second friction coefficient, such as 0" if lone else None


def solve(solved: Solved, before: Mapping[str, Findings], tasks: object) -> Findings:
    """At every friction coefficient above 0; `before` has the models' figures."""
    figures, series = [], []
    known = Figures(before[contact.NAME].figures)
    length = known.one(quantity="contact_length", source=MODEL)
    for friction in solved.problem.scene.load.friction:
        if friction > 0.0:
            of_friction, tables = _found(solved, friction, Uncertainty(length.uncertainty.parts))
            figures += of_friction
            series += tables
    return Findings(tuple(figures), tuple(series))


def half_plane_rise(
    problem: Problem, level: Level, friction: float, s: np.ndarray, centre: float
) -> np.ndarray:
    """B(s) [m] of the half-plane at distances s (n,) [m] from a centre [m] under a level's
    pressure, exact."""
    body, x = problem.scene.body.material, level.grid.x
    nu = body.poissons_ratio
    carried = np.append(0.0, np.cumsum(level.solution.pressure * level.grid.weights))
    edges = np.append(x, x[-1] + level.grid.pitch) - 0.5 * level.grid.pitch
    load = _across(centre, s, edges, carried)
    return -(1.0 - 2.0 * nu) * (1.0 + nu) / body.youngs_modulus * friction * load


def elastic_energy(
    problem: Problem, level: Level, window: Window, friction: float
) -> tuple[float, float]:
    """Elastic strain energy [J/m] in the window behind and ahead of the load's centre, as far to
    both sides of it as the window reaches. In all of a half-plane it is infinite."""
    from scipy.integrate import cumulative_trapezoid, trapezoid

    field, centre, body = level.stress(friction).field, _centre(level), problem.scene.body.material
    nu, mesh = body.poissons_ratio, level.field_on_mesh
    sy = nu * (field.sx + field.sz)
    if mesh is not None and "sy" in mesh.others:  # plastic strain leaves another
        sy = griddata(mesh.points, mesh.others["sy"], tuple(np.meshgrid(window.x, window.z)))
    square = field.sx**2 + field.sz**2 + sy**2 + 2.0 * field.txz**2
    density = (1.0 + nu) * square - nu * (field.sx + field.sz + sy) ** 2
    density = np.nan_to_num(density / (2.0 * body.youngs_modulus))  # above a meshed profile: 0
    reach = min(window.x[-1] - centre, centre - window.x[0])
    up_to = cumulative_trapezoid(trapezoid(density, window.z, axis=0), window.x, initial=0.0)
    back, middle, front = np.interp(centre + reach * np.arange(-1, 2), window.x, up_to)
    return float(middle - back), float(front - middle)


def _found(
    solved: Solved, friction: float, of_length: Uncertainty
) -> tuple[list[Figure], list[Series]]:
    """Figures of the finite elements at one friction coefficient, the curve B(s), and on a profile
    the patches; `of_length` is the uncertainty of the contact length."""
    run = solved.runs[MODEL].under(friction)
    problem, at = solved.problem, {"friction": friction}
    a, radius, level = problem.hertz.half_width, problem.scene.roller.radius, run.finest
    s, h = a * DISTANCES, a**2 / radius
    centres = [_centre(level) for level in run.levels]
    whole = _excess(problem, run, friction, s, centres, NEAR * a)
    known = {n: (value, _over(whole.uncertainties[n], value)) for n, value in whole.values.items()}
    height, stated = known["height"]
    known |= {
        "over_penetration": (height / h, stated),
        "penetration": (h, None),
        "relative_penetration": ((a / radius) ** 2, None),
        "work_scale": (problem.hertz.load_per_length * h, None),
        "contact": (0.5 * level.contact_length, of_length),
    }
    if STRAIN in level.field_on_mesh.others:
        fields = (level.field_on_mesh for level in run.levels)
        strains = [float(field.others[STRAIN].max()) for field in fields]
        known["plastic_strain"] = _settled(strains, level)
    if len(level.field_on_mesh.displacement) > 1:  # of one coefficient v is not known by itself
        places = zip(run.levels, centres, strict=True)
        works = [_work(level, friction, centre, known["at"][0]) for level, centre in places]
        known["work"] = _settled(works, level)
    figures = [
        figure
        for name, (value, stated) in known.items()
        for figure in figures_of(NAME, MODEL, {name: value}, stated, at)
    ]
    columns = {
        "distance": Column(tuple(s.tolist()), "m"),
        "rise": Column(tuple(whole.curve.tolist()), "m", (whole.uncertainties["height"],) * len(s)),
    }
    tables = [Series(CURVE, columns, MODEL, at)]
    if problem.scene.profile:
        tables.append(_by_patch(problem, run, friction, whole.tilt))
    return [*figures, *_energies(solved, friction)], tables


def _over(size: float, value: float | None) -> Uncertainty:
    """Of a value, by an uncertainty in its unit."""
    return Uncertainty({"numerical": float(size / (abs(value or 0.0) or 1.0))})


def _settled(values: Sequence[float], level: Level) -> tuple[float, Uncertainty]:
    """The last of values on all levels, as certain as these and the iteration make it."""
    size = grid_convergence(values, ORDER).uncertainty + iteration(level) * abs(values[-1])
    return values[-1], _over(size, values[-1])


def _work(level: Level, friction: float, centre: float, s: float) -> float:
    """int p v dx over the same of |v|; v counts from its mean at the distance s on both sides."""
    load, (x, rise) = level.solution.pressure * level.grid.weights, _rise(level, friction)
    moved = np.interp(level.grid.x, x, rise)
    moved -= 0.5 * np.sum(np.interp(centre + s * np.array([-1.0, 1.0]), x, rise))
    return float(load @ moved / (load @ np.abs(moved)))


def _energies(solved: Solved, friction: float) -> Iterator[Figure]:
    """The finite elements' energy ahead less that behind, and each model's share ahead."""
    for name, run in solved.runs.items():
        levels = run.under(friction).levels
        stored = [elastic_energy(solved.problem, lv, solved.window, friction) for lv in levels]
        known = {"energy": [front - back for back, front in stored]} if name == MODEL else {}
        known["energy_ahead"] = [front / (back + front) for back, front in stored]
        for quantity, values in known.items():
            value, stated = _settled(values, run.finest)
            yield from figures_of(NAME, name, {quantity: value}, stated, {"friction": friction})


def _by_patch(problem: Problem, run: ModelRun, friction: float, tilt: float) -> Series:
    """About the centre of each patch's load, as far as the next patches and 5 of its half-widths;
    its h is 4 P/(pi E*) of its load P."""
    level, wanted = run.finest, problem.scene.statistics
    ends, (loads, centres, peaks) = level.patches, patch_loads(level)
    depth = relative_penetration(peaks, problem.modulus)
    rule = (wanted.metal, wanted.lubricated) if wanted else ("ferrous", False)
    kinds, rows, sizes = contact_kind(depth["sphere"], depth["ridge"], *rule), [], []
    before, after = np.append(-np.inf, ends[:-1, 1]), np.append(ends[1:, 0], np.inf)
    for k, (start, stop) in enumerate(ends):
        reach = min(centres[k] - before[k], after[k] - centres[k], NEAR * 0.5 * (stop - start))
        s = reach * DISTANCES / DISTANCES[-1]
        here = [centres[k]] * len(run.levels)
        excess = _excess(problem, run, friction, s, here, reach, tilt)
        h = 4.0 * loads[k] / (np.pi * problem.modulus)
        rows.append(
            {
                "start": float(start),
                "stop": float(stop),
                "penetration": float(h),
                "over_penetration": float(excess.values["height"] / h),
                "relative_penetration": float(depth["ridge"][k]),
                "kind": str(kinds[k]),
                **excess.values,
            }
        )
        over = float(excess.uncertainties["height"] / h)
        sizes.append({"over_penetration": over, **excess.uncertainties})
    units = {name: quantity.unit for name, quantity in QUANTITIES.items()}
    uncertainties = {name: [row[name] for row in sizes] for name in sizes[0]}
    columns = columns_of(rows, units | {"start": "m", "stop": "m"}, uncertainties)
    return Series(PATCHES, columns, MODEL, {"friction": friction})


def _excess(
    problem: Problem,
    run: ModelRun,
    friction: float,
    s: np.ndarray,
    centres: list[float],
    near: float,
    tilt: float | None = None,
) -> Excess:
    """The bulge within `near` [m] of each level's centre [m].

    tilt  by which the curve is uncertain, times s: the step of an unbounded body is constant, that
          of a block held at its far boundary falls evenly on the way. None: it is read off the
          farthest s, where bulges have ended; 0 of a body with its own base or sides"""

    def of_level(level: Level, centre: float) -> tuple[np.ndarray, np.ndarray]:
        curve = _across(centre, s, *_rise(level, friction))
        return curve, curve - half_plane_rise(problem, level, friction, s, centre)

    curves, excesses = zip(*map(of_level, run.levels, centres), strict=True)
    curve, excess = curves[-1], excesses[-1]
    if tilt is None:
        is_bounded = {problem.scene.body.thickness, problem.scene.body.width} != {None}
        tilt = 0.0 if is_bounded else far_boundary(excess[-1] / s[-1])
    top = int(np.argmax(excess[s <= near]))
    ends = [_end(s, values, top) for values in excesses]
    settled = np.inf if None in ends else float(grid_convergence(ends, ORDER).uncertainty)
    size = grid_convergence([values[top] for values in excesses], ORDER).uncertainty
    size += iteration(run.finest) * abs(curve[top]) + tilt * s[top]
    longer = [of_level(level, centres[0])[1] for level in run.longer_increments]
    size = float(size + of_increments([values[top] for values in (*longer, excesses[0])]))
    values = {"height": excess[top], "half_plane": curve[top] - excess[top], "at": s[top]}
    values = {name: float(value) for name, value in values.items()} | {"end": ends[-1]}
    # what is read at the same place is as uncertain as the height
    spacing = float(np.diff(s)[min(top, len(s) - 2)])
    sizes = {"height": size, "half_plane": size, "at": spacing, "end": settled}
    return Excess(values, sizes, curve, tilt)


def _end(s: np.ndarray, excess: np.ndarray, top: int) -> float | None:
    """From where an excess (n,) [m] at distances s (n,) [m] is below half of that at `top`."""
    half = HALF * excess[top]
    below = top + np.flatnonzero(excess[top:] < half)[:1]
    if not len(below) or below[0] == top:
        return None
    (far,) = below
    return float(np.interp(half, excess[[far, far - 1]], s[[far, far - 1]]))


def _rise(level: Level, friction: float) -> tuple[np.ndarray, np.ndarray]:
    """Places (n,) [m] of the mesh's surface and v (n,) [m] there: the difference to another
    coefficient, in proportion. Of one coefficient alone on a smooth body the whole displacement:
    what the pressure adds is even."""
    field = level.field_on_mesh
    rise = -field.displacement[friction][field.top, 1]
    for other in sorted(set(field.displacement) - {friction})[:1]:
        rise = (rise + field.displacement[other][field.top, 1]) * friction / (friction - other)
    return field.points[field.top, 0], rise


def _across(centre: float, s: np.ndarray, x: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Values (n,) at places x (n,) a distance s ahead of a centre, less those behind."""
    return np.interp(centre + s, x, values) - np.interp(centre - s, x, values)


def _centre(level: Level) -> float:
    load = level.solution.pressure * level.grid.weights
    return float(load @ level.grid.x / load.sum())


@dataclass(frozen=True)
class Bulge:
    """At one friction coefficient, for whoever shows it: values [SI] by quantity."""

    friction: float
    figures: Mapping[str, Figure]
    energy_ahead: tuple[float, ...]  # by model
    curve: Series
    patches: Series | None

    def value(self, name: str) -> float | None:
        return self.figures[name].value if name in self.figures else None


def bulges_of(findings: Findings | None) -> list[Bulge]:
    """By friction coefficient; none where it was not measured."""
    bulges = []
    for curve in findings.series if findings else ():
        if curve.name == CURVE:
            known = [f for f in findings.figures if f.at == curve.at]
            shares = tuple(f.value for f in known if f.quantity == "energy_ahead")
            figures = {f.quantity: f for f in known if f.source == MODEL}
            patches = findings.table(PATCHES, **curve.at)
            bulges.append(Bulge(curve.at["friction"], figures, shares, curve, patches))
    return bulges


def blocks(run: Run) -> list[Block]:
    """A row for each friction coefficient above 0 and each patch."""
    heading, findings = Heading("Bulge ahead of the sliding contact"), run.findings[NAME]
    if (why := findings.said(WHY_NOT)) is not None:
        table = TextTable("Not measured", ("because",), ((why,),))
        return [Block("stresses", (heading, table, Note(NOTE)))]
    a, rows = run.problem.hertz.half_width, []
    for bulge in bulges_of(findings):
        end, work = bulge.value("end"), significant(bulge.value("work"), 1)
        end = "beyond 20 a" if end is None else significant(end / a, 3)
        over = significant(bulge.value("energy") / bulge.value("work_scale"), 3)
        energy = f"{over} ({', '.join(map(percent, bulge.energy_ahead))})"
        values = {name: figure.value for name, figure in bulge.figures.items()}
        height = bulge.figures["height"]
        raised = _raised(values, height.numerical * height.scale, a)
        rows.append((plain(bulge.friction), *raised, end, work, energy))
        patches = bulge.patches.rows() if bulge.patches else []
        for k, patch in enumerate(patches, 1):
            size = bulge.patches.columns["height"].uncertainty[k - 1]
            rows.append((f"patch {k}, {patch['kind']}", *_raised(patch, size, a), "", "", ""))
    head = ("friction", "bulge", "half-plane's step", "bulge over h", "h/R", "at s/a")
    head += ("half of it at s/a", "work", "energy over P h (share ahead)")
    table = TextTable("Finite elements", head, tuple(rows))
    return [Block("stresses", (heading, Pictures(("bulge",)), table, Note(NOTE)))]


def _raised(values: Mapping[str, float], uncertainty: float, a: float) -> tuple[str, ...]:
    """Bulge, step, both ratios and the place, of a whole contact or of a patch."""
    stated = f" ± {with_unit(uncertainty, 'm', 1)}" if np.isfinite(uncertainty) else ""
    height, step = (with_unit(values[name], "m", 3) for name in ("height", "half_plane"))
    ratios = (values["over_penetration"], values["relative_penetration"], values["at"] / a)
    return height + stated, step, *(significant(ratio, 3) for ratio in ratios)


def bulge_picture(run: Run) -> style.Picture | None:
    """The surface ahead over the distance from it; None where the run has no bulge."""
    bulges = bulges_of(run.findings.get(NAME))
    if not bulges:
        return None
    a = run.problem.hertz.half_width
    h = a**2 / run.problem.scene.roller.radius
    drawn = style.figure(style.COLUMN, 2.6)
    [axes] = style.stacked(drawn, [(0.35, 1.75)], 0.75)
    for number, bulge in enumerate(bulges):
        s = np.array(bulge.curve.columns["distance"].values) / a
        rise = np.array(bulge.curve.columns["rise"].values)
        look = {"label": f"friction {plain(bulge.friction)}", "linewidth": 1.3}
        look["linestyle"] = style.DASHES[number % len(style.DASHES)]
        axes.plot(s[s <= FARTHEST], rise[s <= FARTHEST] / h, **look)
        step = bulge.value("half_plane")
        ends = np.array([step, step + bulge.value("height")]) / h
        axes.plot(np.full(2, bulge.value("at") / a), ends, **BULGE)
    axes.axhline(0.0, color="#222222", linewidth=0.7)
    axes.set(xlim=(0.0, FARTHEST), xlabel="s/a", ylabel="ahead − behind, over h")
    axes.legend(ncols=4, loc="lower right", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.1)
    largest = "; ".join(
        f"friction {plain(bulge.friction)}: {significant(bulge.value('over_penetration'), 3)} h"
        for bulge in bulges
    )
    words = "Surface ahead of the sliding contact less that as far behind it, raised by the "
    words += f"traction alone, over the distance from the load's centre. Bulge: {largest}."
    caption = f"{words} Bars: it, from the half-plane's exact step up; h = a²/R."
    return style.picture(drawn, words, caption)


def _applies(solved: Solved) -> bool:
    stress = solved.problem.scene.stress
    return stress is not None and stress.bulge


STUDY = Study(
    name=NAME,
    quantities=QUANTITIES,
    solve=solve,
    applies=_applies,
    needs=needs,
    blocks=blocks,
    pictures={"bulge": bulge_picture},
)
