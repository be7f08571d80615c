"""The rough cylinder of a scene over three decades of load, beside its solved contact.

The theory's surfaces are random, and so are the ones it is held against: traces with the scene's
power spectrum and new phases, solved by the elastic half-plane. The scene's own trace is one more.
"""

from collections.abc import Mapping
from contextlib import nullcontext, suppress
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import stdtrit

from analytic.contact.equilibrium import Constraints
from analytic.contact.patches import contact_patches
from analytic.contact.problem import solve_contact
from analytic.exact.hertz import hertz_from_load
from analytic.grid import HatGrid, roller_gap
from analytic.operators.half_plane import HalfPlane
from analytic.profile import Profile, surface
from analytic.statistics.nominally_flat import persson_fraction
from analytic.statistics.summits import counted_peaks, spectral_moments, summits_of_peaks
from analytic.surface.filters import filtered
from analytic.surface.roughness import shortest_wavelength
from analytic.surface.synthetic import same_spectrum
from comparisons.common.errors import SceneError
from comparisons.common.tasks import LATER, Here, Tasks
from comparisons.figures.figure import Findings
from comparisons.models.half_plane import expected_of
from comparisons.models.problem import Problem
from comparisons.studies import contact
from comparisons.studies.statistics import show
from comparisons.studies.statistics.figures import (
    NAME,
    ContactFigures,
    LoadRow,
    RoughContactStatistics,
    SummitRow,
)
from comparisons.studies.statistics.patches import patch_states
from comparisons.studies.study import Solved, Study

if TYPE_CHECKING:
    from analytic.statistics.rough_bodies import RoughContact

STEPS, PER_DECADE = 7, 2  # loads: from the scene's own down to a thousandth
CUTOFFS, THINNED = (1.0, 2.0, 4.0, 8.0), (2, 4)  # shortest wavelengths; every so many samples
QUANTILE = 0.975


def begin(solved: Solved, tasks: Tasks) -> None:
    """Make the random traces known. Raises SceneError, one line, for a profile without
    statistics."""
    problem, scene = solved.problem, solved.problem.scene
    if solved.runs:
        return
    try:
        rows = summit_rows(problem.surface.profile, scene.statistics.cutoffs)
        _cylinders(problem, problem.hertz.load_per_length, rows[0])
    except (ValueError, ArithmeticError) as error:
        raise SceneError(f"{scene.source}: statistics: {error}") from None
    cost = expected_of(problem.grid(problem.pitches[0]).count).seconds
    seconds = STEPS * scene.statistics.traces * cost
    tasks.add(NAME, _loads, problem, rows[0], seconds=seconds, urgency=LATER)


def solve(solved: Solved, before: Mapping[str, Findings], tasks: Tasks) -> Findings:
    problem, wanted = solved.problem, solved.problem.scene.statistics
    patches = {name: patch_states(problem, run.finest) for name, run in solved.runs.items()}
    rows = summit_rows(problem.surface.profile, wanted.cutoffs)
    found = RoughContactStatistics(rows, tasks.result(NAME), wanted.traces, patches)
    return replace(found.findings(before[contact.NAME]), data=found)


def summit_rows(profile: Profile, cutoffs: tuple[float, ...] | None) -> tuple[SummitRow, ...]:
    """Of the profile as pressed, at every cut-off [m] and from every so many of its samples. Raises
    ValueError for a profile without statistics and a given cut-off that does not suit the trace."""
    rows = [_summits(profile, "as pressed", profile.spacing, strict=True)]
    for cutoff in cutoffs or np.multiply(CUTOFFS, shortest_wavelength(profile)).tolist():
        with nullcontext() if cutoffs else suppress(ValueError):
            rows.append(_summits(filtered(profile, short_cutoff=cutoff), "cut-off", cutoff))
    for every in THINNED:
        thin = Profile(profile.x[::every], profile.height[::every])
        rows.append(_summits(thin, "sampling", thin.spacing))
    return tuple(rows)


def _summits(profile: Profile, treatment: str, size: float, strict: bool = False) -> SummitRow:
    found, counted, summits = spectral_moments(profile), None, None
    with nullcontext() if strict else suppress(ValueError):
        counted = counted_peaks(profile)
        summits = summits_of_peaks(counted, found)
    by_both = (found.peaks(), counted), (found.summits(), summits)
    return SummitRow(treatment, size, found.bandwidth, float(np.sqrt(found.m2)), *by_both)


def _cylinders(problem: Problem, load: float, row: SummitRow) -> "dict[str, RoughContact]":
    from analytic.statistics.rough_bodies import rough_cylinder

    given = load, problem.scene.roller.radius, problem.modulus
    each = (rough_cylinder(*given, summits) for summits in row.summits)
    return dict(zip(("moments", "peaks"), each, strict=True))


def _loads(here: Here, problem: Problem, summits: SummitRow) -> tuple[LoadRow, ...]:
    """Every load, from the heaviest."""
    here.callback("half-plane: random traces")
    own, wanted = problem.surface.profile, problem.scene.statistics
    traces = [same_spectrum(own, wanted.seed + number) for number in range(wanted.traces)]
    rows = []
    for step in range(STEPS):
        load = problem.hertz.load_per_length * 10.0 ** (-step / PER_DECADE)
        pitch = problem.pitches[0] / 2.0 ** (step // PER_DECADE)  # light loads touch little
        given = [(own, pitch), (own, 0.5 * pitch), *((trace, pitch) for trace in traces)]
        solved = np.array([_pressed(problem, load, *each) for each in given])
        rows.append(_row(problem, load, summits, solved))
    return tuple(rows)


def _pressed(problem: Problem, load: float, profile: Profile, pitch: float) -> list[float]:
    """ContactFigures of the elastic half-plane, and how many patches there are."""
    radius, relief = problem.scene.roller.radius, float(np.ptp(profile.height))
    half_width = hertz_from_load(load, radius, problem.modulus).half_width
    reach = 2.0 * half_width + np.sqrt(2.0 * radius * relief)
    grid = HatGrid.within(max(-reach, profile.x[0]), min(reach, profile.x[-1]), pitch)
    gap = grid.hat_integrals(roller_gap(radius, surface(profile)), profile.x)
    operator = HalfPlane(grid.count, pitch, problem.modulus)
    solution = solve_contact(operator, gap, grid.weights, Constraints(load=load))
    pressure = solution.pressure
    if not solution.converged or pressure[0] > 0.0 or pressure[-1] > 0.0:
        raise SceneError(
            f"{problem.scene.source}: statistics: under a random trace the contact reaches its end "
            "or is not found; allowed is a lighter load or a longer trace"
        )
    patches = contact_patches(grid.x, pressure, solution.gap)
    length = float(np.ptp(patches, axis=1).sum())
    width = 0.75 * np.pi * float(np.abs(grid.x) @ pressure / pressure.sum())
    return [length, load / length, width, len(patches)]


def _row(problem: Problem, load: float, summits: SummitRow, solved: np.ndarray) -> LoadRow:
    """solved (2 + n, 4): the scene's trace on coarse and on fine elements, and random ones."""
    radius, modulus, slope = problem.scene.roller.radius, problem.modulus, summits.rms_slope
    (coarse, fine), random = solved[:2], solved[2:]
    mean, count = random.mean(axis=0), len(random)
    error = stdtrit(count - 1, QUANTILE) * random.std(axis=0, ddof=1) / np.sqrt(count)
    cylinders, patches = _cylinders(problem, load, summits), float(mean[3])
    ridge = hertz_from_load(load / patches, summits.peaks[0].radius, modulus)

    def figures(values: np.ndarray) -> ContactFigures:
        return ContactFigures(*map(float, values[:3]))

    def persson(slope: float) -> float:
        first = cylinders["moments"]
        share = persson_fraction(first.pressure, modulus, slope)
        return load / (2.0 * float(first.steps @ share))

    theories = {
        name: ContactFigures(load / c.mean_real_pressure, c.mean_real_pressure, c.effective_width)
        for name, c in cylinders.items()
    }
    return LoadRow(
        load=load,
        half_width=hertz_from_load(load, radius, modulus).half_width,
        figures=theories | {"trace": figures(fine), "random": figures(mean)},
        grid=figures(coarse / fine - 1.0),
        scatter=figures(error / mean),
        patches=patches,
        persson={"isotropic": persson(np.sqrt(2.0) * slope), "ridges": persson(slope)},
        even=0.25 * np.pi * ridge.peak_pressure,
    )


def _applies(solved: Solved) -> bool:
    return solved.problem.scene.statistics is not None and "half_plane" in solved.plan.models


STUDY = Study(
    name=NAME,
    quantities={},
    solve=solve,
    applies=_applies,
    begin=begin,
    data=RoughContactStatistics,
    blocks=show.blocks,
    pictures={"statistics": show.statistics_pictures},
    lines=show.lines,
)
