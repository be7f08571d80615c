"""What a sliding contact raises ahead of itself, against what it leaves behind.

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

import numpy as np
from scipy.integrate import cumulative_trapezoid, trapezoid
from scipy.interpolate import griddata

from analytic.statistics.penetration import contact_kind, relative_penetration
from comparisons.figures.convergence import grid_convergence
from comparisons.figures.uncertainty import far_boundary, iteration, of_increments
from comparisons.models.level import Level, ModelRun
from comparisons.models.problem import Problem
from comparisons.models.window import Window
from comparisons.studies.statistics.patches import STRAIN, patch_loads

DISTANCES = np.geomspace(0.02, 20.0, 121)  # a
NEAR = 5.0  # a: within which the largest excess is looked for
ORDER = 1.0  # formal
HALF = 0.5  # of its height: where a bulge ends


def bulges(problem: Problem, runs: dict[str, ModelRun], window: Window | None) -> dict | None:
    """The content of result.json: `why` there are no figures, or one entry a friction coefficient
    above 0. None where the scene does not ask for it."""
    scene = problem.scene
    if scene.stress is None or not scene.stress.bulge:
        return None
    sliding = [mu for mu in scene.load.friction if mu > 0.0]
    lone = scene.profile and len(scene.load.friction) == 1 and not scene.finite_element.plastic
    finite = scene.finite_element.deformation == "finite"
    for lacks, needed in (
        ("finite_element" not in runs or not sliding, "the finite elements, and friction"),
        (
            lone and finite,
            "small strains: at finite ones a profile is solved at one friction alone",
        ),
        (lone, "a second friction coefficient, such as 0"),
    ):
        if lacks:
            return {"why": f"it takes {needed}"}
    return {"why": None, "by_friction": [_bulge(problem, runs, window, mu) for mu in sliding]}


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


def _bulge(problem: Problem, runs: dict[str, ModelRun], window: Window, friction: float) -> dict:
    """Of the finite elements at one friction coefficient, lengths in m.

    height        largest excess of B over the half-plane's, within 5 a
    uncertainty   of it: discretisation, iteration and, of an unbounded body, its far boundary
    at, end       s there, and from where the excess is below half of it; None: not within 20 a
    end_uncertainty  by the levels; None where one has no end
    half_plane    B of the half-plane there, exact for its pressure
    penetration, over_penetration, relative_penetration   h, height / h and h / R
    contact       half its length: over R the slope of the roller at its edges
    work_scale    P h [J/m]
    plastic_strain   the largest, None without flow
    work          int p v dx over the same of |v|: what the traction's rise stores or releases; None
                  of one friction coefficient, where v is not known by itself
    energy, energy_uncertainty   [J/m] elastic energy ahead of c less that behind it, in the window
    energy_ahead  by model: the share ahead
    distance, rise   the curve B(s) itself
    patches       on a profile: start, stop, kind by h/R, and the above of every patch by itself,
                  as far as the next patches and 5 of its half-widths; h = 4 P/(pi E*) of its load P
    """
    a, radius, run = problem.hertz.half_width, problem.scene.roller.radius, runs["finite_element"]
    s, level, h = a * DISTANCES, run.finest, a**2 / radius
    centres = [_centre(each) for each in run.levels]
    whole, curve, tilt = _excess(problem, run, friction, s, centres, NEAR * a)
    load = level.solution.pressure * level.grid.weights
    field, (x, rise) = level.field_on_mesh, _rise(level, friction)
    moved, several = np.interp(level.grid.x, x, rise), len(field.displacement) > 1
    beside = centres[-1] + whole["at"] * np.array([-1.0, 1.0])
    moved -= 0.5 * np.sum(np.interp(beside, x, rise))
    stored = [elastic_energy(problem, each, window, friction) for each in run.levels]
    finest = {n: elastic_energy(problem, r.finest, window, friction) for n, r in runs.items()}
    ahead = [front - back for back, front in stored]
    unsure = grid_convergence(ahead, ORDER).uncertainty + iteration(level) * abs(ahead[-1])
    return {
        "friction": friction,
        **whole,
        "penetration": h,
        "over_penetration": whole["height"] / h,
        "relative_penetration": (a / radius) ** 2,
        "contact": 0.5 * level.contact_length,
        "work_scale": problem.hertz.load_per_length * h,
        "plastic_strain": float(field.others[STRAIN].max()) if STRAIN in field.others else None,
        "work": float(load @ moved / (load @ np.abs(moved))) if several else None,
        "energy": ahead[-1],
        "energy_uncertainty": _finite(unsure),
        "energy_ahead": {name: front / (back + front) for name, (back, front) in finest.items()},
        "distance": s.tolist(),
        "rise": curve.tolist(),
        "patches": _by_patch(problem, run, friction, tilt) if problem.scene.profile else [],
    }


def _by_patch(problem: Problem, run: ModelRun, friction: float, tilt: float) -> list[dict]:
    level, wanted = run.finest, problem.scene.statistics
    ends, (loads, centres, peaks) = level.patches, patch_loads(level)
    depth = relative_penetration(peaks, problem.modulus)
    rule = (wanted.metal, wanted.lubricated) if wanted else ("ferrous", False)
    kinds, found = contact_kind(depth["sphere"], depth["ridge"], *rule), []
    before, after = np.append(-np.inf, ends[:-1, 1]), np.append(ends[1:, 0], np.inf)
    for k, (start, stop) in enumerate(ends):
        reach = min(centres[k] - before[k], after[k] - centres[k], NEAR * 0.5 * (stop - start))
        s = reach * DISTANCES / DISTANCES[-1]
        here = [centres[k]] * len(run.levels)
        own, _, _ = _excess(problem, run, friction, s, here, reach, tilt)
        h = 4.0 * loads[k] / (np.pi * problem.modulus)
        of_patch = {"start": start, "stop": stop, "penetration": h}
        of_patch |= {
            "over_penetration": own["height"] / h,
            "relative_penetration": depth["ridge"][k],
        }
        of_patch = {name: float(value) for name, value in of_patch.items()}
        found.append({**of_patch, "kind": str(kinds[k]), **own})
    return found


def _excess(
    problem: Problem,
    run: ModelRun,
    friction: float,
    s: np.ndarray,
    centres: list[float],
    near: float,
    tilt: float | None = None,
) -> tuple[dict, np.ndarray, float]:
    """Height, place and end of the largest excess within `near` [m] of each level's centre [m], B
    (n,) [m] on the finest level, and the tilt of the surface that the far boundary makes: the step
    is constant to infinity, and held there it falls evenly on the way. None: from the farthest s,
    where bulges have ended; 0 of a body with its own base or sides."""

    def of_level(level: Level, centre: float) -> tuple[np.ndarray, np.ndarray]:
        curve = _across(centre, s, *_rise(level, friction))
        return curve, curve - half_plane_rise(problem, level, friction, s, centre)

    curves, excesses = zip(*map(of_level, run.levels, centres), strict=True)
    curve, excess = curves[-1], excesses[-1]
    if tilt is None:
        own = problem.scene.body.thickness is not None or problem.scene.body.width is not None
        tilt = 0.0 if own else far_boundary(excess[-1] / s[-1])
    top = int(np.argmax(excess[s <= near]))
    ends = [_end(s, each, top) for each in excesses]
    settled = None if None in ends else grid_convergence(ends, ORDER).uncertainty
    uncertainty = grid_convergence([each[top] for each in excesses], ORDER).uncertainty
    uncertainty += iteration(run.finest) * abs(curve[top]) + tilt * s[top]
    longer = [of_level(level, centres[0])[1] for level in run.longer_increments]
    uncertainty += of_increments([each[top] for each in (*longer, excesses[0])])
    found = {
        "height": float(excess[top]),
        "uncertainty": _finite(uncertainty),
        "at": float(s[top]),
        "end": ends[-1],
        "end_uncertainty": _finite(settled),
        "half_plane": float(curve[top] - excess[top]),
    }
    return found, curve, tilt


def _end(s: np.ndarray, excess: np.ndarray, top: int) -> float | None:
    """From where an excess (n,) [m] at distances s (n,) [m] is below half of that at `top`."""
    half = HALF * excess[top]
    below = top + np.flatnonzero(excess[top:] < half)[:1]
    if not len(below) or below[0] == top:
        return None
    (far,) = below
    return float(np.interp(half, excess[[far, far - 1]], s[[far, far - 1]]))


def _finite(size: float | None) -> float | None:
    return float(size) if size is not None and np.isfinite(size) else None


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
