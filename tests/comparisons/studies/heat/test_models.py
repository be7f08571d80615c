"""The heat of friction in half-spaces and in finite bodies, against closed forms and transforms."""

from dataclasses import replace

import numpy as np
import pytest
from heat_loads import reach_of_half_plane, under_band
from moving_band import band_maximum, band_mean
from scenes import BOTH_CONDUCT, SMOOTH, half_plane_at, problem

from analytic.grid import HatGrid
from comparisons.figures.convergence import grid_convergence
from comparisons.studies.heat.finite_elements import finite_element_heat
from comparisons.studies.heat.half_space import half_space_heat, peclet_numbers, what_it_contains

INSULATOR = {"roller_conductivity": 1e-6, "roller_density": 2e-4}  # of a diffusivity like steel's
INSULATING_BODY = {name.replace("roller", "body"): value for name, value in INSULATOR.items()}
LAYER = {"conductivity": 2.0, "density": 5000.0, "specific_heat": 500.0}
SCENE = SMOOTH | {
    "load": {"hertz_peak_pressure": 1e9, "friction": 0.1},
    "heat": {"speed": 2.0, "slide_to_roll": 0.5, **BOTH_CONDUCT},
}
FAR = 3e-5  # relative, by the open boundary of a block of ten half-widths
SOFT = {"thickness": 20e-6, "youngs_modulus": 210e9, "poissons_ratio": 0.3}


def made(body=None, coating=None, **heat):
    tables = SCENE | {"body": SCENE["body"] | (body or {}), "heat": SCENE["heat"] | heat}
    return problem(tables | ({"coating": coating} if coating else {}))


def through_layers(posed, level, held=True):
    """Rise (n,) [K] of the body's surface under all heat, by transforms on a long line: the surface
    resistance of a layer (thickness, or coating on a half-space) at each wave number."""
    heat, grid = posed.scene.heat, level.grid
    flux = 0.1 * heat.speed * level.solution.pressure
    ring, start = 2**18, 2**17
    line = np.zeros(ring)
    line[start : start + grid.count] = flux
    wave = 2.0 * np.pi * np.fft.rfftfreq(ring, grid.pitch)
    wave[0] = wave[1]

    def conduction(material):
        root = np.sqrt(wave**2 + 1j * wave * heat.velocities[0] / material.diffusivity)
        return material.conductivity * root, root

    below, decay = conduction(heat.body)
    resistance = 1.0 / below
    if posed.scene.body.thickness is not None:
        across = np.tanh(decay * posed.scene.body.thickness)
        resistance = across / below if held else 1.0 / (below * across)
    if posed.scene.coating is not None:
        above, decay = conduction(heat.coating)
        across = np.tanh(decay * posed.scene.coating.thickness)
        ratio = above * resistance
        resistance = (ratio + across) / (1.0 + ratio * across) / above
    resistance[0] = 0.0
    rise = np.fft.irfft(np.fft.rfft(line) * resistance, ring)
    upstream = rise[start + 3 * grid.count]  # where there is no rise on an endless line
    return rise[start : start + grid.count] - upstream


def test_equal_bodies_that_roll_and_slide_share_nearly_evenly():
    posed = made(slide_to_roll=0.01)
    heat = half_space_heat(posed, half_plane_at(posed))
    numbers = peclet_numbers(posed)
    exact = np.sqrt(numbers["body"]) / sum(np.sqrt(number) for number in numbers.values())
    assert heat.fraction == pytest.approx(exact, rel=1e-3)
    assert heat.figures["flash_temperature"] == heat.body.max()


def test_reversed_roles_mirror():
    one, other = made(slide_to_roll=2.0), made(slide_to_roll=-2.0)
    first, second = (half_space_heat(posed, half_plane_at(posed)) for posed in (one, other))
    assert first.body == pytest.approx(second.roller[::-1], rel=1e-6)
    assert first.fraction == pytest.approx(1.0 - second.fraction)


@pytest.mark.parametrize(
    ("body", "coating", "base"),
    [
        ({}, None, "held"),
        ({"thickness": 130e-6}, None, "held"),
        ({"thickness": 60e-6}, None, "insulated"),
        ({}, SOFT, "held"),
        ({"thickness": 200e-6}, SOFT, "held"),
    ],
)
def test_finite_bodies_against_transforms(body, coating, base):
    """The roller takes no heat: the body's surface has all of it."""
    heat_section = dict(INSULATOR)
    if coating:
        heat_section |= {f"coating_{name}": value for name, value in LAYER.items()}
    if base == "insulated":
        heat_section["base"] = base
    posed = made(body, coating, **heat_section, slide_to_roll=2.0)
    level = half_plane_at(posed)
    heat = finite_element_heat(posed, level)
    assert heat.fraction == pytest.approx(1.0, abs=1e-4)
    exact = through_layers(posed, level, base == "held")
    # next to the ends of contact the flux is not that of the hats
    inside = np.flatnonzero(heat.heat)[2:-2]
    assert heat.body[inside] == pytest.approx(exact[inside], abs=2e-3 * exact.max())
    contained = {"thickness": "thickness" in (body or {}), "coating": bool(coating), "roller": True}
    assert list(what_it_contains(posed)) == [name for name, has in contained.items() if has]


def test_elements_follow_the_slower_of_body_and_coating():
    """A thick coating that conducts slowly, Peclet number 330 of its own: 0.4 % at worst within
    the contact; elements as the body's own diffusivity wants them err by 1.5 %."""
    coat = {f"coating_{name}": value for name, value in LAYER.items()} | INSULATOR
    posed = made({}, SOFT | {"thickness": 100e-6}, **coat, slide_to_roll=2.0, speed=4.0)
    level = half_plane_at(posed)
    heat, exact = finite_element_heat(posed, level), through_layers(posed, level)
    inside = np.flatnonzero(heat.heat)[2:-2]
    assert heat.body[inside] == pytest.approx(exact[inside], abs=6e-3 * exact.max())


def test_a_square_at_rest_is_a_half_space_with_its_reach():
    posed = made(slide_to_roll=-2.0, reach=1e-3, **INSULATOR)
    level = half_plane_at(posed)
    finite, half_space = finite_element_heat(posed, level), half_space_heat(posed, level)
    largest = half_space.figures["flash_temperature"]
    assert finite.figures["flash_temperature"] == pytest.approx(largest, rel=1e-3)
    assert finite.body[[0, -1]] == pytest.approx(half_space.body[[0, -1]], rel=3e-3)
    nearer = half_space_heat(made(slide_to_roll=-2.0, reach=9.9e-4, **INSULATOR), level)
    assert nearer.figures["flash_temperature"] < (1.0 - 2e-3) * largest  # what it could tell


@pytest.mark.parametrize("reach", [None, 2e-3])
def test_a_roller_at_rest_is_narrower_than_its_half_space(reach):
    """All heat enters the roller. A disc's contact sees a half-space that reaches farther."""
    posed = made(slide_to_roll=2.0, **INSULATING_BODY, **({"reach": reach} if reach else {}))
    level, heat, radius = half_plane_at(posed), posed.scene.heat, posed.scene.roller.radius
    far = heat.reach or radius
    farther = reach_of_half_plane(far, radius) / far
    disc, flat = (finite_element_heat(posed, level, without=w) for w in (set(), {"roller"}))
    assert disc.fraction == pytest.approx(0.0, abs=1e-4)
    step = np.log(farther) * disc.heat.sum() * level.grid.pitch
    inside = disc.heat > 0.0
    rise = (disc.roller - flat.roller)[inside]
    assert rise == pytest.approx(step / (np.pi * heat.roller.conductivity), rel=2e-2)
    half_space = half_space_heat(posed, level)
    mean = half_space.figures["mean_temperature"]
    assert flat.figures["mean_temperature"] == pytest.approx(mean, rel=2e-3)


def test_a_fast_roller_is_a_half_space():
    """Only the heated part is meshed; a slow one is warmer than a half-space."""
    for speed, least, most in ((20.0, 2e-4, 2e-3), (2.0, 1e-3, 1e-2), (0.05, 0.01, 0.1)):
        posed = made(slide_to_roll=-2.0, speed=speed, **INSULATING_BODY)
        level = half_plane_at(posed)
        disc, flat = (finite_element_heat(posed, level, without=w) for w in (set(), {"roller"}))
        assert disc.fraction == pytest.approx(0.0, abs=1e-4)
        one, other = (heat.figures["mean_temperature"] for heat in (disc, flat))
        assert least < one / other - 1.0 < most


def test_largest_temperature_of_a_band():
    """A band of uniform pressure: Jaeger's, 0.5 % by finite elements."""
    posed = made(slide_to_roll=2.0, **INSULATOR)
    level = half_plane_at(posed)
    half = 100e-6
    grid = HatGrid.within(-1.3 * half, 1.3 * half, half / 80)
    pressure = np.where(np.abs(grid.x) < half * (1 + 1e-9), 1e9, 0.0)
    solution = replace(level.solution, pressure=pressure)
    level = replace(level, grid=grid, solution=solution)
    material, speed = posed.scene.heat.body, posed.scene.heat.speed
    heat = 0.1 * speed * 1e9
    for contact in (half_space_heat(posed, level), finite_element_heat(posed, level)):
        peclet = speed * half / (2.0 * material.diffusivity)
        exact = band_maximum(peclet)[0] * heat * half / material.conductivity
        # the flux falls to zero over one more pitch on either side
        assert contact.figures["flash_temperature"] == pytest.approx(exact, rel=5e-3)


def of_band(peclet, number):
    """k T / (q l) of the band: the largest, and the mean."""
    law = {"layers": 0.5 * 2**number, "growth": 0.4 / np.sqrt(2.0**number)}
    _, load, rise = under_band(peclet, 0.2 / 2**number, **law)
    return rise.max(), 0.5 * load @ rise


@pytest.mark.parametrize("peclet", [0.1, 1.0, 2.0, 10.0, 100.0])
def test_three_levels_of_finite_elements_cover_the_error(peclet):
    """Against Jaeger's band."""
    levels = np.array([of_band(peclet, number) for number in range(3)])
    exact = band_maximum(peclet)[0], band_mean(peclet)
    for values, true in zip(levels.T, exact, strict=True):
        result = grid_convergence(values, 2.0, FAR * true)
        assert abs(result.value - true) <= result.uncertainty < 2e-3 * true
