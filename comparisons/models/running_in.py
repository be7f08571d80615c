"""A scene's surface after running-in, and what was assumed of it."""

from dataclasses import replace

import numpy as np

from analytic.contact.equilibrium import Constraints
from analytic.contact.problem import ContactError
from analytic.exact.hertz import hertz_from_load
from analytic.material import combined_modulus
from analytic.profile import Profile
from analytic.running_in import run_in
from analytic.surface.roughness import roughness, shortest_wavelength
from comparisons.common.errors import SceneError
from comparisons.common.numbers import as_written, with_unit
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import SceneSurface, smooth_contact

# Of the shortest wave: 1.5 % of the volume moved on ground surfaces. Twice as many would leave
# 0.4 %, and edges of plateaus so sharp that both models take one level more to resolve them.
HATS_PER_WAVE = 20.0
MOST_HATS = 60_000  # on the Hertz contact; a pass on so many takes about a tenth of a second
FEWEST_HATS, MOST_ON_TRACE = 8, 4_000_000  # on the trace
COARSE = 1.5  # times the pitch wanted: less than that is the rounding to a power of two
SMOOTH_HATS = 80  # and at least so many on its half-width


def run_in_surface(scene: Scene, surface: SceneSurface) -> SceneSurface:
    """The surface of a scene, run in; itself where there is nothing to do. Raises SceneError if
    the trace cannot carry the load at the hardness."""
    settings, profile = scene.running_in, surface.profile
    if settings is None or surface.run_in is not None:
        return surface
    radius = scene.roller.radius
    modulus = combined_modulus(scene.roller.material, scene.body.material)
    load = settings.load or smooth_contact(scene).load_per_length  # its own, or the scene's
    half_width = hertz_from_load(load, radius, modulus).half_width
    wanted = min(_wanted(profile), half_width / SMOOTH_HATS)
    wanted = max(wanted, 2.0 * half_width / MOST_HATS)
    # the sample spacing over a power of two, or times one where there would be too many
    pitch = profile.spacing * 2.0 ** round(np.log2(wanted / profile.spacing))
    count = profile.length / pitch
    if not FEWEST_HATS <= count <= MOST_ON_TRACE:
        raise SceneError(
            f"{scene.source}: running_in: needs {count:.2g} pressure elements of {pitch:.3g} m on "
            f"a trace of {profile.length:.3g} m; allowed are {FEWEST_HATS} to "
            f"{MOST_ON_TRACE:g}, by another load or trace"
        )
    limits = Constraints(load=load, hardness=settings.hardness)
    places = np.array(settings.places(surface.position)) - surface.position
    sweeps = settings.sweeps
    try:
        done = run_in(profile, radius, modulus, limits, places, pitch=pitch, sweeps=sweeps)
    except ContactError as error:
        where = f"{scene.source}: running_in.hardness"
        raise SceneError(f"{where}: {error}; allowed is more") from error
    info = replace(surface.info, roughness=roughness(done.profile))
    return replace(surface, profile=done.profile, info=info, run_in=done)


def _wanted(profile: Profile) -> float:
    """The pitch [m] that resolves the surface."""
    return min(shortest_wavelength(profile) / HATS_PER_WAVE, profile.spacing)


def running_in_assumptions(scene: Scene, surface: SceneSurface) -> list[str]:
    """The assumptions of running-in, and where it fell short."""
    done, settings = surface.run_in, scene.running_in
    listed = [
        f"running-in: at {as_written(settings.hardness, 'Pa')} asperities of a half-plane flow "
        "without friction; what flows is lost, nothing rises beside it and nothing hardens"
    ]
    if done is None:
        return listed
    if done.pitch > COARSE * _wanted(done.before):
        apart = with_unit(done.pitch, "m", 3)
        shortest = with_unit(shortest_wavelength(done.before), "m", 3)
        listed.append(
            f"running-in: its pressures stood {apart} apart, too coarse for the shortest waves of "
            f"the surface ({shortest}): asperities between them have not flowed enough"
        )
    if done.status != "settled":
        listed.append(
            f"running-in: the surface has not settled in {done.sweeps} sweeps over "
            f"{len(settings.places(surface.position))} positions"
        )
    if ended(surface):
        places = ", ".join(as_written(place, "m") for place in ended(surface))
        ends = "the roller touches the end of the trace, beyond which nothing carries it"
        listed.append(f"running-in: from {places} {ends}")
    return listed


def ended(surface: SceneSurface) -> list[float]:
    """Positions [m] on the trace from which the roller touched an end of it."""
    places = dict.fromkeys(one.position for one in surface.run_in.passes if one.at_end)
    return [place + surface.position for place in places]
