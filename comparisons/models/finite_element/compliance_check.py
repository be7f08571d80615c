"""What a check of the finite elements' compliance before any contact found, and what it tells.

Their displacements under given pressures are held against those of an analytic surface, with no
contact in between: under one pressure element, a column of the compliance, and under waves. The
figures name the error:

    mesh      elements make a body too stiff, the more the shorter the wave: short waves are off
    modulus   all waves are off alike: the elastic constants
    block     short waves are right, columns are off far from their load: the block's size, or how
              it is held
    geometry  as `block`, but the analytic surface lacks what the finite elements have
    neither   mesh and body are right; what differs in a contact is the contact's
"""

from dataclasses import asdict, dataclass

import numpy as np

from comparisons.common.numbers import given_percent, percent

# Part of the displacement by which waves of so many pressure elements may be too stiff, with one
# edge under each element. Quadratic elements leave 5 % and 1 % there, near nu = 1/2 8 % and 2 %;
# edges of two pressure elements 18 % and 4 %, of four 78 % and 17 %, linear ones 35 % and 21 %.
SHORT_WAVES = {4.0: 0.15, 8.0: 0.05}
# Difference that all longer waves share, and what they may differ by: its own fourth, or a mesh's.
SHARED, SPREAD, MESH_SPREAD = 0.02, 0.25, 0.04
# Part of a column, far from its load. A right mesh and body leave up to 6e-4, a coating a thousand
# times as stiff 2e-3, nu = 0.4999 3e-3; blocks of 40, 20 and 12 half-widths 2e-3, 7e-3 and 2e-2.
BEYOND = 5e-3


@dataclass(frozen=True)
class Column:
    """Under the pressure element at x [m]: the L2 norm of the difference over the column's own,
    and the part of it `beyond` the elements next to x."""

    x: float
    difference: float
    beyond: float


@dataclass(frozen=True)
class Wave:
    """Under a packet of waves of a length [m], so many pressure `elements`: the difference of the
    work of pressures on displacements over that work; negative where finite elements are stiffer"""

    length: float
    elements: float
    difference: float


@dataclass(frozen=True)
class Differences:
    """Of the finite elements from an analytic surface."""

    columns: tuple[Column, ...]
    waves: tuple[Wave, ...]

    @property
    def worst_column(self) -> Column:
        return max(self.columns, key=lambda column: column.difference)

    @property
    def worst_wave(self) -> Wave:
        return max(self.waves, key=lambda wave: abs(wave.difference))


@dataclass(frozen=True)
class OperatorCheck:
    """Of one level.

    nearest     from the analytic surface that is nearest to the scene's bodies
    datum       whether displacements count from a base; else a constant was removed
    lacks       what the nearest surface leaves out of these finite elements
    half_plane  from half-planes of body and roller, where the body is `finite`: what it is that
                makes it so; this difference is the body's effect and no error
    verdict     neither | mesh | modulus | block | geometry, and why
    """

    nearest: Differences
    datum: bool
    lacks: tuple[str, ...]
    half_plane: Differences | None
    finite: tuple[str, ...]
    verdict: str
    because: str

    def as_dict(self) -> dict:
        """For result.json."""
        found = asdict(self.nearest)
        effect = None
        if self.half_plane is not None:
            effect = {"of": list(self.finite), **asdict(self.half_plane)}
        return {
            "verdict": self.verdict,
            "because": self.because,
            "datum_removed": not self.datum,
            **{name: list(found[name]) for name in ("columns", "waves")},
            "lacks": list(self.lacks),
            "body_effect": effect,
        }


def judged(found: Differences, lacks: tuple[str, ...]) -> tuple[str, str]:
    """Verdict and why. Where the nearest surface `lacks` something the body is not judged."""
    shared = 0.0 if lacks else _shared([w.difference for w in found.waves if w.elements >= 8.0])
    for wave in found.waves:
        bound = SHORT_WAVES.get(wave.elements)
        if bound is not None and wave.difference - shared < -bound:
            return "mesh", (
                f"waves of {wave.elements:g} pressure elements are too stiff by "
                f"{percent(shared - wave.difference)}, more than {given_percent(bound)}"
            )
    if shared:
        return "modulus", (
            f"all waves are off alike, by {percent(shared, signed=True)}: the elastic constants"
        )
    far = max(column.beyond for column in found.columns)
    text = f"{percent(far)} of a column is off far from its load"
    if far > BEYOND and lacks:
        return "geometry", f"{text}; the analytic surface lacks {' and '.join(lacks)}"
    if far > BEYOND:
        return (
            "block",
            f"{text}, more than {given_percent(BEYOND)}: the block's size, or how it is held",
        )
    return "neither", "short waves and columns far from their load are right"


def _shared(differences: list[float]) -> float:
    """What all waves are off by, zero where they are not alike."""
    if len(differences) < 2:
        return 0.0
    least = min(differences, key=abs)
    spread = max(abs(np.array(differences) - least))
    alike = spread <= max(SPREAD * abs(least), MESH_SPREAD)
    return least if alike and abs(least) > SHARED else 0.0
