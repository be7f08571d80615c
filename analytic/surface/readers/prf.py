"""PRF, the text format of Taylor Hobson and of the NPL's softgauges: one profile, evenly sampled.

Records end in a line EOR. The first names the axes, `CX M count unit scale type` and `CZ` alike,
the second the sample distance, `SPACING CX distance`, in the unit of CX times its scale; in the
third every line is a height, in the unit of CZ times its scale.
Source: NPL, softgauges, data file formats (resource.npl.co.uk/softgauges/Help.htm)."""

import re
from pathlib import Path

import numpy as np

from analytic.surface.readers.source import MAX_BYTES, ProfileError, read_lines
from analytic.surface.readers.topography import Topography

FORMAT = "PRF"
HEAD = re.compile(rb"\s*\d+\s+\d+\s*\r?\n[^\n]*\n\s*CX\s+\S+\s")
UNITS = {"MM": 1e-3, "UM": 1e-6, "NM": 1e-9, "M": 1.0, "IN": 0.0254}


def is_prf(head: bytes) -> bool:
    """Whether a file that begins with these bytes is one."""
    return HEAD.match(head) is not None


def read_prf(path: Path) -> Topography:
    """The heights [m] of the file; ProfileError, one line, where it is damaged."""
    records: list[list[list[str]]] = [[]]
    for line in read_lines(path, MAX_BYTES):
        words = line.split()
        if words[:1] == ["EOR"]:
            records.append([])
        elif words and words[0] != "EOF":
            records[-1].append(words)
    try:
        axes, settings, rows = records[:3]
        scales = {words[0]: UNITS[words[3].upper()] * float(words[4]) for words in axes[2:4]}
        count = int(float(axes[3][2]))
        (spacing,) = (float(words[2]) for words in settings if words[:2] == ["SPACING", "CX"])
        heights = np.array([words[0] for words in rows], dtype=float) * scales["CZ"]
    except KeyError as error:
        known = f"of its axes and units {error} is not known; known units are {', '.join(UNITS)}"
        raise _damaged(path, known) from error
    except (ValueError, IndexError, OverflowError) as error:
        raise _damaged(path, "its records are not axes, settings and heights") from error
    if len(heights) != count:
        raise _damaged(path, f"it holds {len(heights)} heights of {count}")
    step = spacing * scales["CX"]
    heights = np.where(np.isfinite(heights), heights, np.nan)
    return Topography(path, heights, (step, step), None, 1.0, FORMAT)


def _damaged(path: Path, message: str) -> ProfileError:
    return ProfileError(path, f"is a damaged PRF file: {message}")
