"""Posing of a scene as the problem that both models solve (`comparisons.models.problem`): how far
contact may reach, how fine its elements are, and what is refused."""

from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise

import numpy as np

from analytic.exact.hertz import hertz_from_load
from analytic.exact.westergaard import FlatContact
from analytic.grid import HatGrid
from analytic.material import combined_modulus
from analytic.surface.roughness import shortest_wavelength
from comparisons.common.errors import SceneError
from comparisons.models.operators import LAYERS, is_layered, operator_of, patches_of, pressed_on
from comparisons.models.problem import Levels, Problem, least_of_flow
from comparisons.models.running_in import run_in_surface
from comparisons.models.window import window_of
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import SceneSurface, smooth_contact, surface_of

SMOOTH_ELEMENTS = 77.3  # pressure elements on a half-width, third level; no edge on a node
HATS_PER_WAVE = 40.0  # third level; the first then has 10 to the shortest wavelength
MOST_HATS = 6000  # on the contact at the third level; more only where refinement asks for it
FEWEST_ELEMENTS, MOST_ELEMENTS = 8, 2_000_000  # of the coarsest and of the finest level
SEARCH_HATS = 2000  # of the solutions that search for the extent of the contact
FULL = 0.99  # of what a stretch carries at the hardness; its hats leave out a little at the ends
STANDS_OUT = 0.25  # of the largest pressure: prominence that makes a peak an asperity of its own
FIGURES = 5  # decimal, of the pressure elements on a half-width at the third level
NARROW = 8.0  # stretch over contact beyond which the extent is searched again
WIDEST_CIRCLE = 0.8  # of the radius that pressures may extend to
# Thickness of a body or its coating, in half-widths of the smooth contact: elements as fine as a
# thinner one takes are more than can be held, and the rounding of a thicker one shows at its top.
THINNEST, THICKEST = 1e-3, 1e6
STIFFEST = 1e9  # times the body's modulus, of a coating; as soft at least: a gel on diamond is 1e-9
LAST_LOAD_CHANGE = 1e-3  # relative change of the load that no longer moves the mesh
MOST_ROUNDS = 12  # of loads for a prescribed approach


def problem_of(
    scene: Scene,
    surface: SceneSurface | None = None,
    load: float | None = None,
    levels: Levels | None = None,
) -> Problem:
    """Set up the problem of a scene; `load` [N/m] where the scene prescribes the approach.
    The surface, by default read as the scene says, is run in first, where the scene asks for it
    and it was not done yet. Raises SceneError where the contact would reach beyond the trace, the
    load exceeds what the surface can carry at its hardness, or the pressure elements are too coarse
    or too many, or the window of [stress] shows nothing or leaves the body."""
    surface = run_in_surface(scene, surface or surface_of(scene))
    modulus = combined_modulus(scene.roller.material, scene.body.material)
    if scene.periodic:
        problem = _on_one_period(scene, surface, modulus)
    else:
        problem = _under_roller(scene, surface, modulus, load)
    problem = replace(problem, levels=levels)
    problem = replace(problem, pitches=_pitches(problem))
    _check_count(problem)
    _check_circle(problem)
    problem = replace(problem, asperities=_asperities(problem))
    return problem if scene.stress is None else replace(problem, window=window_of(problem))


def settled(
    scene: Scene,
    surface: SceneSurface,
    pressed: Callable[[Problem], tuple[float, np.ndarray]],
    levels: Levels | None = None,
) -> Problem:
    """The scene's problem under the load of its approach, to LAST_LOAD_CHANGE or better.

    pressed  load [N/m] and patches (k, 2) [m] of a problem at the approach, on its own grid
    Each round solves on the grid for the load of the one before. Raises SceneError if the rounds
    do not settle."""
    wanted = scene.load.value
    # a rigid body of the roller's shape would cut the surface over twice this half-width
    half_width = np.sqrt(scene.roller.radius * wanted)
    modulus = scene.body.material.plane_strain_modulus
    load = np.pi * modulus * half_width**2 / (4.0 * scene.roller.radius)
    for _ in range(MOST_ROUNDS):
        problem = problem_of(scene, surface, load, levels)
        pitch = problem.pitches[-1]
        before, (load, patches) = load, pressed(problem)
        low, high = problem.extent
        if patches[0, 0] < low + pitch or patches[-1, 1] > high - pitch:
            load = 2.0 * before  # the contact fills the grid: it carries more than that
        elif abs(load - before) <= LAST_LOAD_CHANGE * load:
            return problem_of(scene, surface, load, levels)
    raise SceneError(
        f"{scene.source}: load.approach: no load was found that gives {wanted:g} m; allowed is a "
        "load (per_length) instead"
    )


def load_on_layer(scene: Scene, surface: SceneSurface) -> float:
    """The load [N/m] of the scene's approach on the endless layer, without friction."""

    def pressed(problem: Problem) -> tuple[float, np.ndarray]:
        grid = problem.grid(problem.pitches[-1])
        depth = scene.load.value + problem.first_touch
        limits = replace(problem.constraints(), load=None, approach=depth)
        solution = pressed_on(problem, grid, operator_of(problem, grid), limits)
        return solution.load, patches_of(grid, solution)

    return settled(scene, surface, pressed).hertz.load_per_length


def _under_roller(
    scene: Scene, surface: SceneSurface, modulus: float, load: float | None
) -> Problem:
    """The smooth contact, and how far that of the scene may reach."""
    if scene.load.kind == "approach":
        hertz = hertz_from_load(load, scene.roller.radius, modulus)
    else:
        hertz = smooth_contact(scene)
    _check_layers(scene, hertz.half_width)
    extent = -1.5 * hertz.half_width, 1.5 * hertz.half_width
    plastic, body = scene.finite_element.plastic, scene.body
    # flow that is found beside the half-plane may spread the contact, too
    asked = body.yield_stress is not None and scene.budget.effects and scene.tolerances
    flows = plastic or bool(
        asked and (scene.profile is not None or hertz.peak_pressure > least_of_flow(scene))
    )
    problem = Problem(scene, surface, modulus, hertz, extent, pitches=(), flows=flows)
    plain = scene.profile is None and body.width is None and body.hardness is None
    plain = plain and scene.coating is None and not problem.flows
    if not plain or problem.coupling:
        try:
            problem = replace(problem, extent=_contact_extent(problem))
        except SceneError:
            if plastic or not problem.flows:
                raise
            problem = replace(problem, flows=False)  # the half-plane fits; flow has no solution
            problem = replace(problem, extent=_contact_extent(problem))
    return problem


def _on_one_period(scene: Scene, surface: SceneSurface, modulus: float) -> Problem:
    """One period of the surface, all of which may touch."""
    half, mean = 0.5 * surface.profile.length, scene.load.value
    _check_layers(scene, half)
    hardness = scene.body.hardness
    if hardness is not None and mean >= FULL * hardness:
        raise SceneError(
            f"{scene.source}: load.mean_pressure: is {mean:g} Pa at a body.hardness of "
            f"{hardness:g} Pa; allowed is less than {FULL * hardness:.3g} Pa"
        )
    smooth = FlatContact(half, mean, modulus)
    return Problem(scene, surface, modulus, smooth, (-half, half), pitches=())


def _check_layers(scene: Scene, half_width: float) -> None:
    """Refuse a layer too thin or thick for a mesh, and a coating that is nothing, or rigid."""
    if scene.coating is not None:
        coating, body = scene.coating.youngs_modulus, scene.body.youngs_modulus
        if not body / STIFFEST <= coating <= body * STIFFEST:
            raise SceneError(
                f"{scene.source}: coating.youngs_modulus: is {coating:g} Pa on a body of "
                f"{body:.3g} Pa; allowed is from {body / STIFFEST:.3g} Pa to "
                f"{body * STIFFEST:.3g} Pa"
            )
    layers = {"body": scene.body.thickness, "coating": scene.coating and scene.coating.thickness}
    if scene.load.kind == "approach":  # without deformation; the load is not known yet
        half_width = np.sqrt(2.0 * scene.roller.radius * scene.load.value)
    for name, thickness in layers.items():
        if thickness and not THINNEST * half_width <= thickness <= THICKEST * half_width:
            raise SceneError(
                f"{scene.source}: {name}.thickness: is {thickness:g} m under a contact of "
                f"{half_width:.3g} m half-width; allowed is from {THINNEST:g} to {THICKEST:g} "
                f"half-widths, {THINNEST * half_width:.3g} m to {THICKEST * half_width:.3g} m"
            )


def surface_ends(problem: Problem) -> tuple[float, float]:
    """Ends [m] of the trace or the body, whichever come first; infinite without either."""
    start, stop, scene = -np.inf, np.inf, problem.scene
    if problem.surface.profile is not None:
        start, stop = problem.surface.profile.x[[0, -1]]
    if scene.body.width is not None:
        start, stop = max(start, -0.5 * scene.body.width), min(stop, 0.5 * scene.body.width)
    return start, stop


def _contact_extent(problem: Problem) -> tuple[float, float]:
    """Outermost contact with a margin [m], by coarse half-plane solutions on fitting stretches."""
    scene, half_width, load = problem.scene, problem.hertz.half_width, problem.hertz.load_per_length
    start, stop = surface_ends(problem)
    narrowest = load / problem.constraints().hardness
    if narrowest > 2.0 * scene.roller.radius:
        softest = 0.5 * load / scene.roller.radius
        raise SceneError(
            f"{scene.source}: body.hardness: is {scene.body.hardness:g} Pa, which carries the "
            f"load on {narrowest:.3g} m, more than the roller is wide; allowed is {softest:.3g} Pa "
            "or more"
        )
    profile = problem.surface.profile
    relief = 0.0 if profile is None else float(np.ptp(profile.height))
    if not start < 0.0 < stop:
        raise SceneError(f"{scene.source}: load.position: the roller's centre is off the body")
    # this far out the surface is below the roller even if the highest peak stood there
    outermost = max(2.0 * half_width, load / problem.widest.hardness)
    outermost += np.sqrt(2.0 * scene.roller.radius * relief)
    while True:
        low, high = max(start, -outermost), min(stop, outermost)
        touching = (low, high)
        if load < FULL * problem.widest.hardness * (high - low):
            touching, slack = _search_extent(problem, low, high)
            if touching[0] > low + slack and touching[1] < high - slack:
                break
        if low == start or high == stop:
            raise SceneError(_too_wide(scene, touching, (low, high)))
        outermost *= 2.0
    # a contact far smaller than the stretch it was looked for on is looked at again, closer
    while high - low > NARROW * (touching[1] - touching[0] + slack):
        around = max(touching[1] - touching[0], slack)
        low, high = max(low, touching[0] - around), min(high, touching[1] + around)
        touching, slack = _search_extent(problem, low, high)
    margin = problem.margin + 2.0 * slack
    return float(max(low, touching[0] - margin)), float(min(high, touching[1] + margin))


def _too_wide(scene: Scene, touching: tuple, ends: tuple) -> str:
    body = "trace" if scene.profile is not None else "body"
    capped = "" if scene.body.hardness is None else " at this hardness (body.hardness)"
    return (
        f"{scene.source}: load: the contact{capped} reaches the end of the {body} "
        f"({touching[0]:.4g} m to {touching[1]:.4g} m of {ends[0]:.4g} m to {ends[1]:.4g} m); "
        "allowed is a load, a radius and a position that keep it inside"
    )


def _search_extent(problem: Problem, low: float, high: float) -> tuple[tuple[float, float], float]:
    """First and last contact [m] of either model in a range, and what is too near its ends [m]."""
    frictions, problems = problem.scene.load.friction, [problem]
    if problem.coupling:
        problems = [problem.under(mu) for mu in (min(frictions), max(frictions))]
    touched = [_touched(one, (low, high), one.half_plane_effects) for one in problems]
    if is_layered(problem.scene):
        touched.append(_touched(problem, (low, high)))
    starts, stops = zip(*touched, strict=True)
    return (min(starts), max(stops)), 2.0 * (high - low) / SEARCH_HATS


def _touched(
    problem: Problem, ends: tuple[float, float], effects: frozenset[str] = LAYERS
) -> tuple[float, float]:
    """First and last contact [m] in a range by SEARCH_HATS hats, on layers or the half-plane."""
    grid = HatGrid.within(*ends, np.ptp(ends) / SEARCH_HATS)
    solution = pressed_on(problem, grid, operator_of(problem, grid, effects), problem.widest)
    first, *_, last = patches_of(grid, solution).ravel().tolist()
    return first, last


def _pitches(problem: Problem) -> tuple[float, ...]:
    """Pitches of the first levels: fine enough for the shortest wave, or for the smooth edge."""
    scene = problem.scene
    levels = scene.resolution.levels if problem.levels is None else problem.levels.models
    asked, elements = scene.resolution.pitch, scene.resolution.elements
    if scene.resolution.nodes:
        asked = 2.0 ** (levels - 1) * np.ptp(problem.extent) / scene.resolution.nodes
    if asked or elements:
        asked = asked or problem.hertz.half_width / elements
        return tuple(_whole(problem, asked) / 2.0**k for k in range(levels))
    finest = problem.hertz.half_width / SMOOTH_ELEMENTS
    if is_layered(scene) and problem.period is None:
        start, stop = _touched(problem, problem.extent)
        finest = min(finest, 0.5 * (stop - start) / SMOOTH_ELEMENTS)
    if scene.profile is not None:
        finest = min(finest, shortest_wavelength(problem.surface.profile) / HATS_PER_WAVE)
    # a light load on a crest touches far less than the Hertz contact of the roller
    span = problem.extent[1] - problem.extent[0]
    finest = max(min(finest, span / (2.0 * SMOOTH_ELEMENTS)), span / MOST_HATS)
    # what the rounding of a spectrum leaves would otherwise end in another mesh on another machine
    finest = problem.hertz.half_width / float(f"{problem.hertz.half_width / finest:.{FIGURES}g}")
    return tuple(_whole(problem, 4.0 * finest) / 2.0**k for k in range(levels))


def _whole(problem: Problem, pitch: float) -> float:
    """Pitch of a periodic surface, or a smaller one, that goes into the period 4 to 7 times a
    power of two, so that grids can be halved again and again."""
    if problem.period is None:
        return pitch
    count = max(FEWEST_ELEMENTS, problem.period / pitch * (1.0 - 1e-9))
    power = 2.0 ** (np.floor(np.log2(count)) - 2)
    return problem.period / (power * np.ceil(count / power))


def standing_out(values: np.ndarray, least: float) -> list[int]:
    """Indices of the largest values (n,) between falls of `least` or more on both sides."""
    places, place, low, rises = [], 0, values[0], False
    for k, value in enumerate(values):
        if not rises:
            low = min(low, value)
            rises = value >= low + least
            place = k
        elif value > values[place]:
            place = k
        elif value <= values[place] - least:
            places.append(place)
            low, rises = value, False
    return places


def _asperities(problem: Problem) -> tuple[float, ...]:
    """Between the half-plane's peaks of pressure that stand out, in the middle of what lies lowest:
    the open gap, mostly. It moves no figure, so that the coarsest pressures are enough."""
    if problem.scene.profile is None:
        return ()
    grid = problem.grid(problem.pitches[0])
    half_plane = operator_of(problem, grid, problem.half_plane_effects)
    pressure = pressed_on(problem, grid, half_plane).pressure
    peaks = standing_out(pressure, STANDS_OUT * pressure.max())
    valleys = []
    for start, stop in pairwise(peaks):
        between = pressure[start : stop + 1]
        lowest = start + np.flatnonzero(between == between.min())
        valleys.append(float(grid.x[lowest[[0, -1]]].mean()))
    return tuple(valleys)


def _check_circle(problem: Problem) -> None:
    """Refuse a circle that the grid of pressures, or on a layer the contact, reaches around."""
    scene, farthest = problem.scene, float(np.abs(problem.extent).max())
    if scene.finite_element.roller_shape != "circle":
        return
    widest = WIDEST_CIRCLE * scene.roller.radius
    if farthest > widest and is_layered(scene):
        farthest = np.abs(_touched(problem, problem.extent)).max()
    if farthest > widest:
        reach = f"{farthest:.3g} m from the centre of a roller of {scene.roller.radius:.3g} m"
        raise SceneError(
            f'{scene.source}: finite_element.roller_shape: is "circle", but the contact may reach '
            f"to {reach}; allowed is a lighter load or a larger radius"
        )


def _check_count(problem: Problem) -> None:
    """Refuse pressure elements that are too few to show a contact, or too many to hold."""
    where = f"{problem.scene.source}: resolution.pitch"
    length = problem.extent[1] - problem.extent[0]
    coarsest, finest = problem.pitches[0], problem.pitches[-1]
    if length < FEWEST_ELEMENTS * coarsest:
        raise SceneError(
            f"{where}: is {coarsest:g} m; allowed is at most {length / FEWEST_ELEMENTS:.3g} m for "
            f"a contact of {length:.3g} m"
        )
    if length > MOST_ELEMENTS * finest:
        least = length / MOST_ELEMENTS * 2.0 ** (len(problem.pitches) - 1)
        raise SceneError(
            f"{where}: {coarsest:g} m needs {length / finest:.3g} pressure elements at the finest "
            f"of {len(problem.pitches)} levels; allowed is at least {least:.3g} m, "
            f"{MOST_ELEMENTS:g} elements"
        )
