"""Roughness parameters as drawings and instruments state them: filtered, over section lengths.

The profile is filtered (`filters`), and cut into at most five whole section lengths of one cut-off
each in the middle of the trace, at least half a cut-off from its ends. Its parameters are those of
ISO 21920-2:2021 (ISO 4287:1997 but for its name for the length), by exact integrals of the spline.

The automatic cut-off is that of ISO 4288:1996, table 1 (ISO 21920-3:2021, classes Sc1 to Sc5):
the shortest one whose Ra does not exceed the range that belongs to it."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.interpolate import PPoly

from analytic.profile import Profile
from analytic.surface.filters import LONGEST_CUTOFF, REACH, SHORTEST_CUTOFF, check_cutoff, filtered
from analytic.surface.roughness import crossings, figures_of, stretch_of, turning_points

SECTIONS = 5
# ISO 4288:1996, table 1: largest Ra [m] of a cut-off [m]; ISO 3274:1996, table 1: its lambda_s [m].
CLASSES = (
    (0.02e-6, 0.08e-3, 2.5e-6),
    (0.1e-6, 0.25e-3, 2.5e-6),
    (2.0e-6, 0.8e-3, 2.5e-6),
    (10.0e-6, 2.5e-3, 8e-6),
    (80.0e-6, 8e-3, 25e-6),
)
HEIGHT_DISCRIMINATION = 0.1  # of Rz: lower hills and shallower dales do not end an element

END_SAMPLES = 30  # over which the ends of a spline are forgotten, to rounding


@dataclass(frozen=True)
class StandardRoughness:
    """Parameters of the filtered profile (ISO 21920-2:2021) over `sections` cut-offs."""

    cutoff: float  # [m] lambda_c
    short_cutoff: float | None  # [m] lambda_s
    sections: int  # section lengths in the evaluation length
    start: float  # [m] position on the trace where the first section begins
    ra: float  # [m] mean of |z|
    rq: float  # [m] root mean square of z
    rsk: float  # skewness of z, 0 for a flat profile
    rku: float  # kurtosis
    rt: float  # [m] highest peak to deepest valley of the whole evaluation length
    rz: float  # [m] the same of each section, averaged
    rdq: float  # root mean square of dz/dx
    # [m] mean width of elements, a hill and a dale each, told apart by a tenth of Rz; None: none
    rsm: float | None


def standard_roughness(
    profile: Profile, cutoff: float, short_cutoff: float | None = None
) -> StandardRoughness:
    """Parameters at a cut-off [m]; raises ValueError as `filtered` does.

    profile       without its form, unfiltered
    short_cutoff  [m] None: short waves stay"""
    curve = _evaluated(profile, cutoff, short_cutoff)
    sections = round((curve.x[-1] - curve.x[0]) / cutoff)
    ends = curve.x[0] + cutoff * np.arange(sections + 1)
    figures, pieces = figures_of(curve, 0.0), [stretch_of(curve, a, b) for a, b in pairwise(ends)]
    rz = float(np.mean([np.ptp(piece(turning_points(piece))) for piece in pieces]))
    return StandardRoughness(
        cutoff=cutoff,
        short_cutoff=short_cutoff,
        sections=sections,
        start=float(curve.x[0]),
        **{name: getattr(figures, name) for name in ("ra", "rq", "rsk", "rku", "rt")},
        rz=rz,
        rdq=figures.rms_slope,
        rsm=_mean_width(curve, HEIGHT_DISCRIMINATION * rz),
    )


def _evaluated(profile: Profile, cutoff: float, short_cutoff: float | None) -> PPoly:
    """The filtered profile on its section lengths."""
    check_cutoff(profile, cutoff)
    sections = min(SECTIONS, int((profile.length / cutoff - 1.0) * (1.0 + 1e-9)))
    length = sections * cutoff
    start = float(profile.x[0]) + 0.5 * (profile.length - length)
    # What lies farther away than the filters reach would only cost time.
    margin = REACH * (cutoff + (short_cutoff or 0.0)) + END_SAMPLES * profile.spacing
    near = (profile.x >= start - margin) & (profile.x <= start + length + margin)
    part = Profile(profile.x[near], profile.height[near])
    return stretch_of(filtered(part, cutoff, short_cutoff).spline(), start, start + length)


def standard_cutoff(profile: Profile) -> float:
    """The cut-off [m] that ISO 4288:1996, table 1 gives by Ra. Raises ValueError where the trace is
    too short for the cut-off that its Ra asks for, too coarse for any, or rougher than the
    table."""
    for most, cutoff, _ in CLASSES:
        if cutoff < SHORTEST_CUTOFF * profile.spacing:
            continue
        if cutoff > LONGEST_CUTOFF * profile.length:
            raise ValueError(
                f"the trace of {1e3 * profile.length:.4g} mm is too short for the standard's "
                f"cut-off of {1e3 * cutoff:g} mm, which its roughness asks for; allowed is a "
                "cut-off in figures"
            )
        if figures_of(_evaluated(profile, cutoff, None), 0.0).ra <= most:
            return cutoff
    raise ValueError(
        "no cut-off of the standard (0.08 mm to 8 mm, Ra up to 80 um) suits the trace; "
        "allowed is a cut-off in figures"
    )


def standard_short_cutoff(profile: Profile, cutoff: float) -> float | None:
    """lambda_s [m] that belongs to `cutoff` [m] (ISO 3274:1996, table 1). None where the samples
    are too far apart for it: they are what limits the short waves then."""
    fitting = (short for _, long, short in CLASSES if long >= cutoff * (1.0 - 1e-9))
    short = next(fitting, CLASSES[-1][2])
    if short >= cutoff:
        return None
    try:
        check_cutoff(profile, short)
    except ValueError:
        return None
    return short


def _mean_width(curve: PPoly, height: float) -> float | None:
    """Mean width [m] of whole elements, from one upward crossing of the mean line to the next.
    Hills lower than `height` [m], and dales that are shallower, are taken as part of what lies
    beside them; so are the stretches before the first and after the last crossing."""
    places = crossings(curve)
    if len(places) < 3:
        return None
    starts = places[:-1]
    # their middles see to it that every stretch between two crossings has a place
    inside = np.sort(np.append(turning_points(curve), starts + 0.5 * np.diff(places)))
    inside = inside[(inside >= places[0]) & (inside <= places[-1])]  # one may round to an end
    first = np.searchsorted(inside, starts)
    heights = curve(inside)
    high, low = np.maximum.reduceat(heights, first), np.minimum.reduceat(heights, first)
    counts = np.maximum(high, -low) >= height
    hill, starts = (high > -low)[counts], starts[counts]
    upward = starts[hill & np.concatenate(([True], ~hill))[: len(hill)]]
    if len(upward) < 2:
        return None
    return float((upward[-1] - upward[0]) / (len(upward) - 1))
