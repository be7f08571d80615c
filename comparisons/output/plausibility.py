"""Plausibility warnings: signs in a scene of a missing or mistaken unit.

A scene with `radius = 8` for 8 mm, `youngs_modulus = 207` for 207 GPa or a trace in the wrong unit
is solved like any other. Nothing here is refused; the user is warned."""

from collections.abc import Iterator

import numpy as np

from analytic.surface.outliers import spikes
from analytic.surface.roughness import shortest_wavelength
from comparisons.common.numbers import as_written, significant, with_unit
from comparisons.judging.study import Run
from comparisons.scenes.materials import solids
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import ProfileInfo, SceneSurface, smooth_contact

LARGEST_RADIUS = 5.0  # [m]; rolls of mills have less
SOFTEST, STIFFEST = 1e3, 1.5e12  # [Pa] Young's modulus: gels, diamond
LONGEST_TRACE = 0.25  # [m] that stylus instruments drive
# Rms slopes of measured surfaces: polished have more than the first, sawn less than the second.
SMOOTHEST, STEEPEST = 1e-4, 1.0
LIGHTEST, HEAVIEST = 5e-5, 0.3  # half-width over radius: steel at some MPa, rubber pressed flat
FEWEST_ELEMENTS = 8  # to a wave: peak pressures are then known to some per cent
LONGEST_BRIDGE = 5  # samples: a line across more than that is no surface any more
EDGE = 0.02  # of the contact that a field need not hold
FEWEST_SAMPLES = 4  # to a contact, which is else a matter of the curve between samples


def warnings_about(scene: Scene, surface: SceneSurface) -> list[str]:
    """One sentence each, before anything is solved."""
    warnings, radius = [], scene.roller.radius
    if radius > LARGEST_RADIUS and not scene.periodic:
        warnings.append(
            f"roller.radius is {as_written(radius, 'm')}: a number without unit is in m"
        )
    for section, material in (("body", scene.body.material), ("roller", scene.roller.material)):
        if material is not None and not SOFTEST <= material.youngs_modulus <= STIFFEST:
            modulus = f"{section}.youngs_modulus is {as_written(material.youngs_modulus, 'Pa')}"
            warnings.append(f"{modulus}: a number without unit is in Pa")
    warnings += _of_solids(scene)
    return [*warnings, *_of_load(scene), *warnings_about_surface(surface.info)]


def warnings_about_surface(info: ProfileInfo | None) -> list[str]:
    """Warnings about a measured trace alone."""
    return [] if info is None or info.path is None else [*_of_trace(info)]


def warnings_about_result(run: Run) -> list[str]:
    """Warnings that only the solution shows."""
    model = next(iter(run.runs.values()))
    surface, solution = run.problem.surface, model.finest.solution
    peak, modulus = float(solution.pressure.max()), run.problem.modulus
    warnings = []
    if peak > modulus:
        warnings.append(
            f"the peak pressure of {with_unit(peak, 'Pa')} exceeds the combined modulus of "
            f"{with_unit(modulus, 'Pa')}, which no material bears: check load and profile units"
        )
    info, length = surface.info, model.finest.contact_length
    if info is not None and length < FEWEST_SAMPLES * info.spacing:
        warnings.append(
            f"the whole contact, {with_unit(length, 'm')}, is shorter than {FEWEST_SAMPLES} "
            f"samples of the profile ({with_unit(info.spacing, 'm')} apart): what is pressed is "
            "the curve between them"
        )
    start, stop = model.finest.patches[[0, -1], [0, 1]]
    inside = np.array([start, stop]) + EDGE * (stop - start) * np.array([1.0, -1.0])
    if run.window is not None and not run.window.holds(inside).all():
        low, high = (with_unit(end, "m") for end in run.window.ends)
        warnings.append(
            f"stress.half_range: there is contact beyond {low} to {high}, and largest stresses are "
            "sought within alone"
        )
    if surface.profile is not None:
        per_wave = shortest_wavelength(surface.profile) / model.finest.grid.pitch
        if per_wave < FEWEST_ELEMENTS:
            warnings.append(
                f"the shortest wave has {significant(per_wave, 2)} pressure elements on the finest "
                f"level: at fewer than {FEWEST_ELEMENTS} its pressures are not known (budget, "
                "resolution)"
            )
    return warnings


def _of_solids(scene: Scene) -> Iterator[str]:
    """Measured third-order constants that are left unused beside other moduli."""
    for name in ("roller", "body"):
        section = getattr(scene, name)
        solid = solids()[section.solid] if section.solid else None
        if solid and solid.has_constants and section.departures and section.law is None:
            written = " and ".join(f"{name}.{field}" for field in section.departures)
            yield (
                f"{written}: {solid.name} has another value, to which its measured third-order "
                "constants belong: they are not used"
            )


def _of_load(scene: Scene) -> Iterator[str]:
    if scene.load.kind == "approach" or scene.periodic:
        return
    smooth = smooth_contact(scene)
    ratio = smooth.half_width / scene.roller.radius
    if LIGHTEST <= ratio <= HEAVIEST:
        return
    yield (
        f"load: smooth bodies would have {with_unit(smooth.peak_pressure, 'Pa')} and a half-width "
        f"of {with_unit(smooth.half_width, 'm')}, {significant(ratio, 2)} of the radius: check "
        "load, radius and moduli (1 N/um is 1e6 N/m)"
    )


def _of_trace(info: ProfileInfo) -> Iterator[str]:
    slope = info.roughness.rms_slope
    if info.doubt:
        yield info.doubt
    if info.length > LONGEST_TRACE:
        yield f"profile: the trace is {with_unit(info.length, 'm')} long: check x_unit or spacing"
    if slope == 0.0:
        yield "profile: every height is the same once the form is off: check the file"
    elif not SMOOTHEST <= slope <= STEEPEST:
        height = with_unit(info.roughness.rq, "m")
        yield (
            f"profile: the rms slope is {significant(slope, 2)} at an Rq of {height}: check x_unit "
            "and z_unit"
        )
    if info.stretch is not None:
        start, stop = info.stretch
        if stop - start > LONGEST_BRIDGE * info.spacing:
            yield (
                f"profile: nothing was measured from {with_unit(start, 'm')} to "
                f"{with_unit(stop, 'm')}: what is pressed there is a straight line"
            )
    if (outliers := spikes(info.trace)) is not None:
        one = outliers.count == 1
        yield (
            f"profile: {'a spike stands' if one else f'{outliers.count} spikes stand'} out of the "
            f"trace, {'' if one else 'the largest '}by {with_unit(outliers.height, 'm')} at x = "
            f"{with_unit(outliers.place, 'm')}: dirt and lost contact are pressed like the surface"
        )
