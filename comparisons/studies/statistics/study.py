"""The rough cylinder of a scene over three decades of load, beside its solved contact.

The theory's surfaces are random, and so are the ones it is held against: traces with the scene's
power spectrum and new phases, solved by the elastic half-plane. The scene's own trace is one more.

In: a scene with [statistics], and its solved models. Out: series, whose columns are

    summits   of the trace as pressed, filtered or thinned, a row each: `peaks` expected by
              `moments` of its spectrum or counted (`peaks`), the `summits` of a surface by either
    loads     a row a load, from the scene's own down
      figures.S.Q   Q of FIGURES by S: `moments` and `peaks`, the rough cylinder on these summits;
                    `trace`, the half-plane under the scene's own; `random`, on average under others
      half_width    [m] Hertz's           patches  in contact, on average under random traces
      persson.S     [Pa] mean real pressure by Persson's theory under the pressures of `moments`, of
                    an `isotropic` surface and of one with `ridges` across the plane
      even          [Pa] the same of as many ridges as patches, of the profile's mean radius and
                    under even shares of the load, by Hertz: right where few touch and none merges
      causes.C      factors of the mean real pressure by `moments` over `random`, whose product
                    less 1 is the `difference`
    patches   of each model: `depth` is h/R (`analytic.statistics.penetration`), `kinds` elastic,
              plastic or cutting, `radius` [m] that of the ridge that Hertz has it on,
              `plastic_strain` the largest below it where the model flows"""

from collections.abc import Mapping
from contextlib import nullcontext, suppress
from dataclasses import asdict, replace
from fnmatch import fnmatchcase
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import stdtrit

from analytic.contact.equilibrium import Constraints
from analytic.contact.patches import contact_patches
from analytic.exact.hertz import hertz_from_load
from analytic.grid import HatGrid
from analytic.profile import Profile
from analytic.statistics.nominally_flat import persson_fraction
from analytic.statistics.penetration import contact_kind, relative_penetration
from analytic.statistics.summits import counted_peaks, spectral_moments, summits_of_peaks
from analytic.surface.filters import filtered
from analytic.surface.roughness import shortest_wavelength
from analytic.surface.synthetic import same_spectrum
from comparisons.common.errors import SceneError
from comparisons.common.tasks import LATER, Here, Tasks
from comparisons.figures.figure import Column, Findings, Series, columns_of
from comparisons.judging import contact
from comparisons.judging.study import Solved
from comparisons.models.analytic import expected_of
from comparisons.models.level import STRAIN, Level, MeshField, refuse_too_large
from comparisons.models.operators import operator_of, pressed_on
from comparisons.models.problem import Problem

if TYPE_CHECKING:
    from analytic.statistics.rough_bodies import RoughContact

NAME = "statistics"
STEPS, PER_DECADE = 7, 2  # loads: from the scene's own down to a thousandth
CUTOFFS, THINNED = (1.0, 2.0, 4.0, 8.0), (2, 4)  # shortest wavelengths; every so many samples
QUANTILE = 0.975
# Sum of the patches, load over it, and the half-width of the smooth contact with the same mean |x|
# of the pressure.
FIGURES = ("real_length", "mean_real_pressure", "effective_half_width")
PRESSURE = "mean_real_pressure"
# By patterns of columns' names.
UNITS = {"load": "N/m", "peaks.*.density": "1/m", "summits.*.density": "1/m²"}
UNITS |= dict.fromkeys(("*real_length", "*half_width", "size", "*.radius", "*.deviation"), "m")
UNITS |= {"*.mean": "m"} | dict.fromkeys((f"*.{PRESSURE}", "even", "persson.*"), "Pa")


def begin(solved: Solved, tasks: Tasks) -> None:
    """Make the random traces known. Raises SceneError, one line, for a profile without
    statistics."""
    problem, scene = solved.problem, solved.problem.scene
    if solved.runs:
        return
    try:
        summit_rows(problem.surface.profile, scene.statistics.cutoffs)
        _cylinders(problem, problem.hertz.load_per_length)
    except (ValueError, ArithmeticError) as error:
        raise SceneError(f"{scene.source}: statistics: {error}") from None
    cost = expected_of(problem.grid(problem.pitches[0]).count).seconds
    load, pitch = _step(problem, STEPS - 1)
    finest = _grid(problem, load, problem.surface.profile, 0.5 * pitch)
    refuse_too_large(problem, expected_of(finest.count), "[statistics] of light loads", 0.5 * pitch)
    seconds = STEPS * scene.statistics.traces * cost
    tasks.add(NAME, _loads, problem, seconds=seconds, urgency=LATER)


def solve(solved: Solved, before: Mapping[str, Findings], tasks: Tasks) -> Findings:
    """Patches are as uncertain as the worst of their model's figures, which `before` has."""
    problem, wanted = solved.problem, solved.problem.scene.statistics
    summits = summit_rows(problem.surface.profile, wanted.cutoffs)
    series = [_table("summits", summits), _table("loads", *tasks.result(NAME))]
    for name in solved.runs:
        stated = (f for f in before[contact.NAME].figures if f.source == name and f.levels)
        worst = max(figure.numerical for figure in stated)
        for at, level in solved.contacts(name):
            series.append(Series("patches", patch_columns(problem, level, worst), name, at))
    series.append(Series("traces", {"traces": Column((wanted.traces,))}))
    return Findings(series=tuple(series))


def _table(
    name: str, rows: list[dict[str, object]], uncertainties: Mapping[str, list[float]] = {}
) -> Series:
    columns = columns_of(rows, uncertainties=uncertainties)
    for key, column in columns.items():
        unit = next((unit for pattern, unit in UNITS.items() if fnmatchcase(key, pattern)), "")
        columns[key] = replace(column, unit=unit)
    return Series(name, columns)


def summit_rows(profile: Profile, cutoffs: tuple[float, ...] | None) -> list[dict[str, object]]:
    """Columns of the profile as pressed, at every cut-off [m] and from every so many of its
    samples, with the `size` [m] of either. Raises ValueError for a profile without statistics and a
    given cut-off that does not suit the trace."""
    rows = [_summits(profile, "as pressed", profile.spacing, strict=True)]
    for cutoff in cutoffs or np.multiply(CUTOFFS, shortest_wavelength(profile)).tolist():
        with nullcontext() if cutoffs else suppress(ValueError):
            rows.append(_summits(filtered(profile, short_cutoff=cutoff), "cut-off", cutoff))
    for every in THINNED:
        thin = Profile(profile.x[::every], profile.height[::every])
        rows.append(_summits(thin, "sampling", thin.spacing))
    return rows


def _summits(
    profile: Profile, treatment: str, size: float, strict: bool = False
) -> dict[str, object]:
    """Peaks, expected and counted, and summits by either; counted ones where they are enough."""
    moments = spectral_moments(profile)
    row = {"treatment": treatment, "size": size, "bandwidth": moments.bandwidth}
    row["rms_slope"] = float(np.sqrt(moments.m2))
    known = {"peaks.moments": moments.peaks(), "summits.moments": moments.summits()}
    with nullcontext() if strict else suppress(ValueError):
        known["peaks.peaks"] = counted_peaks(profile)
        known["summits.peaks"] = summits_of_peaks(known["peaks.peaks"], moments)
    return row | {f"{n}.{key}": v for n, by in known.items() for key, v in asdict(by).items()}


def _cylinders(problem: Problem, load: float) -> "list[RoughContact]":
    """Rough cylinders on summits by moments and by counting."""
    from analytic.statistics.rough_bodies import rough_cylinder

    profile, radius = problem.surface.profile, problem.scene.roller.radius
    moments = spectral_moments(profile)
    both = moments.summits(), summits_of_peaks(counted_peaks(profile), moments)
    return [rough_cylinder(load, radius, problem.modulus, summits) for summits in both]


def _loads(here: Here, problem: Problem) -> tuple[list[dict[str, float]], dict[str, list[float]]]:
    """A row a load, from the heaviest, and the uncertainties of some of their columns."""
    here.callback("half-plane: random traces")
    measured, wanted = problem.surface.profile, problem.scene.statistics
    traces = [same_spectrum(measured, wanted.seed + number) for number in range(wanted.traces)]
    rows, sizes = [], []
    for step in range(STEPS):
        load, pitch = _step(problem, step)
        pressed = [(measured, pitch), (measured, 0.5 * pitch), *((t, pitch) for t in traces)]
        solved = np.array([_pressed(problem, load, *trace) for trace in pressed])
        row, unsure = _row(problem, load, solved)
        rows, sizes = [*rows, row], [*sizes, unsure]
    return rows, {name: [of_load[name] for of_load in sizes] for name in sizes[0]}


def _step(problem: Problem, step: int) -> tuple[float, float]:
    """Load [N/m] and pitch [m]: light loads touch little."""
    load = problem.hertz.load_per_length * 10.0 ** (-step / PER_DECADE)
    return load, problem.pitch_of(1 + step // PER_DECADE)


def _grid(problem: Problem, load: float, profile: Profile, pitch: float) -> HatGrid:
    radius, relief = problem.scene.roller.radius, float(np.ptp(profile.height))
    half_width = hertz_from_load(load, radius, problem.modulus).half_width
    reach = 2.0 * half_width + np.sqrt(2.0 * radius * relief)
    return HatGrid.within(max(-reach, profile.x[0]), min(reach, profile.x[-1]), pitch)


def _pressed(problem: Problem, load: float, profile: Profile, pitch: float) -> list[float]:
    """FIGURES of the elastic half-plane, and how many patches there are."""
    grid = _grid(problem, load, profile, pitch)
    traced = replace(problem, surface=replace(problem.surface, profile=profile))
    operator = operator_of(problem, grid, frozenset())
    solution = pressed_on(traced, grid, operator, Constraints(load=load))
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


def _row(
    problem: Problem, load: float, solved: np.ndarray
) -> tuple[dict[str, float], dict[str, float]]:
    """Columns of one load, and the uncertainty of some.

    solved (2 + n, 4): the scene's trace on coarse and on fine elements, and random ones, whose mean
    is as sure as the 95 % interval of it."""
    radius, modulus = problem.scene.roller.radius, problem.modulus
    (coarse, fine), random = solved[:2], solved[2:]
    mean, count = random.mean(axis=0), len(random)
    error = stdtrit(count - 1, QUANTILE) * random.std(axis=0, ddof=1) / np.sqrt(count)
    cylinders, moments = _cylinders(problem, load), spectral_moments(problem.surface.profile)
    first, patches, slope = cylinders[0], mean[3], float(np.sqrt(moments.m2))
    isotropic, ridges = (
        load / (2.0 * float(first.steps @ persson_fraction(first.pressure, modulus, rms)))
        for rms in (np.sqrt(2.0) * slope, slope)
    )
    ridge = hertz_from_load(load / patches, moments.peaks().radius, modulus)
    sources = {"trace": fine, "random": mean}
    for by, c in zip(("moments", "peaks"), cylinders, strict=True):
        sources[by] = load / c.mean_real_pressure, c.mean_real_pressure, c.effective_width
    row = {"load": load, "half_width": hertz_from_load(load, radius, modulus).half_width}
    for source, figures in sources.items():
        row |= {f"figures.{source}.{n}": float(v) for n, v in zip(FIGURES, figures, strict=False)}
    theory, pressed = (row[f"figures.{source}.{PRESSURE}"] for source in ("moments", "random"))
    row |= {
        "patches": float(patches),
        "persson.isotropic": isotropic,
        "persson.ridges": ridges,
        "even": 0.25 * np.pi * ridge.peak_pressure,
        "causes.summits alone": theory / isotropic,
        "causes.ridges": isotropic / ridges,
        "causes.few contacts": ridges / pressed,
        "difference": theory / pressed - 1.0,
    }
    shares = {"random": error / mean, "trace": np.abs(coarse / fine - 1.0)}
    sizes = {
        f"figures.{source}.{name}": float(share) * row[f"figures.{source}.{name}"]
        for source, of_source in shares.items()
        for name, share in zip(FIGURES, of_source, strict=False)
    }
    unsure = sum(share[FIGURES.index(PRESSURE)] for share in shares.values())
    return row, sizes | {"difference": theory / pressed * float(unsure)}


def patch_columns(problem: Problem, level: Level, unsure: float) -> dict[str, Column]:
    """Every patch of a level, from `start` to `stop`: load, peak, and how deep it is penetrated,
    all `unsure` relative to themselves. Pressures belong to the nearest patch."""
    (start, stop), wanted = level.patches.T, problem.scene.statistics
    places = np.searchsorted(0.5 * (stop[:-1] + start[1:]), level.grid.x)
    load = np.bincount(places, level.grid.weights * level.solution.pressure, len(start))
    peak = np.zeros(len(start))
    np.maximum.at(peak, places, level.solution.pressure)
    depth = relative_penetration(peak, problem.modulus)
    radius = np.pi * problem.modulus * (stop - start) ** 2 / (16.0 * load)
    values = {"start": start, "stop": stop, "load": load, "peak": peak, "radius": radius}
    values |= {f"depth.{name}": share for name, share in depth.items()}
    field = level.mesh_field
    if isinstance(field, MeshField) and STRAIN in field.others:
        values["plastic_strain"] = [_strain_below(field, *ends) for ends in level.patches]
    units = {"start": "m", "stop": "m", "load": "N/m", "peak": "Pa", "radius": "m"}
    columns = {}
    for name, numbers in values.items():
        numbers = tuple(map(float, numbers))
        sizes = tuple(unsure * abs(number) for number in numbers)
        columns[name] = Column(numbers, units.get(name, ""), sizes)
    for how, flow, cut in (("book", "book", "book"), ("exact", "sphere", "ridge")):
        kinds = contact_kind(depth[flow], depth[cut], wanted.metal, wanted.lubricated)
        columns[f"kinds.{how}"] = Column(tuple(map(str, kinds)))
    return columns


def _strain_below(field: MeshField, start: float, stop: float) -> float:
    """The largest below a patch, no deeper than that is wide: first flow is at 0.4 of it."""
    x, z = field.points.T
    below = (x >= start) & (x <= stop) & (z <= stop - start)
    return float(np.max(field.others[STRAIN][below], initial=0.0))
