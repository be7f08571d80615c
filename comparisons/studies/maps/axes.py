"""The two axes of a map: which groups, from where to where, and at how many values."""

import difflib
import re
from dataclasses import dataclass

import numpy as np

from comparisons.common.errors import InputError
from comparisons.studies.maps.groups import GROUPS

FIGURES = 6  # decimal, of the values: the same on every machine
SPANS_DECADES = 3.0  # largest over smallest value from which an axis is logarithmic
FEWEST, MOST = 2, 200  # values of an axis
_AXIS = re.compile(r"\s*([\w-]+)\s*(?:=\s*([^:\s]+)\s*:\s*([^:\s]+)\s*)?")
_POINTS = re.compile(r"\s*(\d+)\s*[x×]\s*(\d+)\s*")


@dataclass(frozen=True)
class Axis:
    """`count` values of a group from `low` to `high`."""

    group: str
    low: float
    high: float
    count: int

    @property
    def logarithmic(self) -> bool:
        return self.low > 0.0 and self.high / self.low >= SPANS_DECADES

    @property
    def values(self) -> tuple[float, ...]:
        """Ascending; of equal ratios on a logarithmic axis, else of equal differences."""
        spaced = np.geomspace if self.logarithmic else np.linspace
        found = spaced(self.low, self.high, self.count)
        return tuple(float(f"{value:.{FIGURES}g}") for value in found)

    def __str__(self) -> str:
        """As it is asked for."""
        return f"{self.group}={self.low:g}:{self.high:g}"


def axis_of(given: str, count: int, option: str) -> Axis:
    """The axis that "GROUP" or "GROUP=FROM:TO" means.

    Raises InputError, which names the `option`, for anything else.
    """
    found = _AXIS.fullmatch(given)
    if not found:
        raise InputError(f"{option}: is {given!r}; allowed is GROUP or GROUP=FROM:TO")
    name = found[1].replace("-", "_")
    if name not in GROUPS:
        near = difflib.get_close_matches(name, GROUPS, n=1, cutoff=0.0)[0]
        raise InputError(
            f"{option}: there is no group {found[1]}; the nearest is {near}; "
            f"allowed are {', '.join(GROUPS)}"
        )
    low, high = GROUPS[name].span
    if found[2]:
        try:
            low, high = float(found[2]), float(found[3])
        except ValueError:
            low = high = np.nan
        if not (0.0 <= low < high < np.inf):
            raise InputError(
                f"{option}: the range is {found[2]}:{found[3]}; allowed are two numbers, "
                "from 0 on, the smaller one first"
            )
        if low == 0.0 and name != "poissons_ratio":
            raise InputError(f"{option}: {name} begins at 0; allowed is above 0")
    return Axis(name, low, high, count)


def counts_of(given: str) -> tuple[int, int]:
    """The numbers of values that "NxM" means: along x, along y."""
    found = _POINTS.fullmatch(given)
    counts = tuple(map(int, found.groups())) if found else ()
    if not counts or not all(FEWEST <= count <= MOST for count in counts):
        raise InputError(
            f"--points: is {given!r}; allowed is NxM, from {FEWEST} to {MOST} values each"
        )
    return counts


def usual_axes(tables: dict) -> tuple[str, str]:
    """Groups for a scene, where none are asked for: what it has most of."""
    load, profile = tables["load"], tables.get("profile") or {}
    if profile.get("kind") in ("sinusoid", "self-affine", "ground"):
        return "wavelength_over_a", "rms_slope"
    rigid = tables["roller"].get("rigid", False)
    if np.max(load.get("friction", 0.0)) > 0.0 and rigid:
        return "a_over_thickness", "friction_dundurs"
    return "a_over_thickness", "a_over_radius" if rigid else "a_over_width"
