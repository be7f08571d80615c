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
a base below, or flow.
"""

import numpy as np
from scipy.integrate import cumulative_trapezoid, trapezoid

from comparisons.assessment.convergence import grid_convergence
from comparisons.assessment.uncertainty import far_boundary, iteration
from comparisons.models.level import Level, ModelRun
from comparisons.models.problem import Problem
from comparisons.models.window import Window

DISTANCES = np.geomspace(0.02, 20.0, 121)  # a
ORDER = 1.0  # formal
HALF = 0.5  # of its height: where a bulge ends


def bulges(problem: Problem, runs: dict[str, ModelRun], window: Window | None) -> dict | None:
    """The content of result.json: `why` there are no figures, or one entry a friction coefficient
    above 0. None where the scene does not ask for it."""
    scene = problem.scene
    if scene.stress is None or not scene.stress.bulge:
        return None
    sliding = [mu for mu in scene.friction if mu > 0.0]
    for lacks, needed in (
        ("finite_element" not in runs or not sliding, "the finite elements, and friction"),
        (scene.finite_element.geometry == "rough", "a flat boundary (finite_element.geometry)"),
        (scene.profile and len(scene.friction) == 1, "a second friction coefficient, such as 0"),
    ):
        if lacks:
            return {"why": f"it takes {needed}"}
    return {"why": None, "by_friction": [_bulge(problem, runs, window, mu) for mu in sliding]}


def half_plane_rise(problem: Problem, level: Level, friction: float, s: np.ndarray) -> np.ndarray:
    """B(s) [m] of the half-plane at distances s (n,) [m] under a level's pressure, exact."""
    body, x = problem.scene.body, level.grid.x
    nu = body.poissons_ratio
    carried = np.append(0.0, np.cumsum(level.solution.pressure * level.grid.weights))
    edges = np.append(x, x[-1] + level.grid.pitch) - 0.5 * level.grid.pitch
    load = _across(level, s, edges, carried)
    return -(1.0 - 2.0 * nu) * (1.0 + nu) / body.youngs_modulus * friction * load


def energy_ahead(problem: Problem, level: Level, window: Window, friction: float) -> float:
    """Share of the strain energy in the window, as far to both sides of the load's centre as it
    reaches, that lies ahead. In all of a half-plane the energy is infinite."""
    field, centre = level.stress(friction).field, _centre(level)
    nu = problem.scene.body.poissons_ratio
    reach = min(window.x[-1] - centre, centre - window.x[0])
    normal = (1.0 - nu) * (field.sx**2 + field.sz**2) - 2.0 * nu * field.sx * field.sz
    density = 0.5 * normal + field.txz**2  # in plane strain, times E/(1 + nu)
    up_to = cumulative_trapezoid(trapezoid(density, window.z, axis=0), window.x, initial=0.0)
    back, middle, front = np.interp(centre + reach * np.arange(-1, 2), window.x, up_to)
    return float((front - middle) / (front - back))


def _bulge(problem: Problem, runs: dict[str, ModelRun], window: Window, friction: float) -> dict:
    """Of the finite elements at one friction coefficient, lengths in m.

    height        largest excess of B over the half-plane's, within 5 a
    uncertainty   of it: discretisation, iteration and, of an unbounded body, its far boundary
    at, end       s there, and from where the excess is below half of it; None: not within 20 a
    half_plane    B of the half-plane there, exact for its pressure
    over_penetration, relative_penetration   height / h and h / R
    work          int p v dx over the same of |v|: what the traction's rise stores or releases; None
                  of one friction coefficient, where v is not known by itself
    energy_ahead  by model: share ahead of c in the strain energy of the window's fields
    distance, rise   the curve B(s) itself
    """
    a, radius, run = problem.hertz.half_width, problem.scene.roller_radius, runs["finite_element"]
    s, curves, excesses = a * DISTANCES, [], []
    for level in run.levels:
        x, rise = _rise(level, friction)
        curves.append(_across(level, s, x, rise))
        excesses.append(curves[-1] - half_plane_rise(problem, level, friction, s))
    curve, excess, level = curves[-1], excesses[-1], run.finest
    top = int(np.argmax(excess[s <= 5.0 * a]))
    below = np.flatnonzero(excess[top:] < HALF * excess[top])
    uncertainty = grid_convergence([each[top] for each in excesses], ORDER).uncertainty
    uncertainty += iteration(level) * abs(curve[top])
    if problem.scene.thickness is None and problem.scene.width is None:
        # the step is constant to infinity; held at a far boundary it falls evenly on the way there
        uncertainty += far_boundary(np.interp(2.0 * s[top], s, curve), curve[top])
    load = level.solution.pressure * level.grid.weights
    moved, several = np.interp(level.grid.x, x, rise), len(problem.scene.friction) > 1
    moved -= 0.5 * np.sum(np.interp(_centre(level) + s[top] * np.array([-1.0, 1.0]), x, rise))
    ahead = {name: energy_ahead(problem, r.finest, window, friction) for name, r in runs.items()}
    return {
        "friction": friction,
        "height": float(excess[top]),
        "uncertainty": float(uncertainty) if np.isfinite(uncertainty) else None,
        "at": float(s[top]),
        "end": float(s[top + below[0]]) if len(below) else None,
        "half_plane": float(curve[top] - excess[top]),
        "over_penetration": float(excess[top] / (a**2 / radius)),
        "relative_penetration": (a / radius) ** 2,
        "work": float(load @ moved / (load @ np.abs(moved))) if several else None,
        "energy_ahead": ahead,
        "distance": s.tolist(),
        "rise": curve.tolist(),
    }


def _rise(level: Level, friction: float) -> tuple[np.ndarray, np.ndarray]:
    """Places (n,) [m] of the mesh's surface and v (n,) [m] there: the difference to another
    coefficient, in proportion. Of one coefficient alone on a smooth body the whole displacement:
    what the pressure adds is even."""
    field = level.field_on_mesh
    x, z = field.points.T
    top = np.flatnonzero(z <= 1e-9 * np.ptp(z))
    top = top[np.argsort(x[top])]
    rise = -field.displacement[friction][top, 1]
    for other in sorted(set(field.displacement) - {friction})[:1]:
        rise = (rise + field.displacement[other][top, 1]) * friction / (friction - other)
    return x[top], rise


def _across(level: Level, s: np.ndarray, x: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Values (n,) at places x (n,) a distance s ahead of the load's centre, less those behind."""
    centre = _centre(level)
    return np.interp(centre + s, x, values) - np.interp(centre - s, x, values)


def _centre(level: Level) -> float:
    load = level.solution.pressure * level.grid.weights
    return float(load @ level.grid.x / load.sum())
