"""A scene as resolved: everything that is asked for, in SI, with the profile in place.

x along the surface with its origin under the roller's centre, heights positive out of the body
with their zero on the mean line. `comparisons.scenes.resolve` makes it from a file.
"""

import copy
import math
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path

from analytic.material import Material
from analytic.profile import Profile
from analytic.running_in import RunIn
from analytic.surface.form import RemovedForm
from analytic.surface.roughness import Roughness
from analytic.surface.roughness_standard import StandardRoughness

MOST_LEVELS = 8  # of a run
CUT_OFF = 3.0  # standard deviations beyond which an uncertain input is not sampled


@dataclass(frozen=True)
class Load:
    """What presses the roller on.

    kind   load_per_length [N/m] | hertz_peak_pressure [Pa] of the smooth pair | approach [m]
    """

    kind: str
    value: float


@dataclass(frozen=True)
class Yielding:
    """Yield `stress` [Pa] in tension, and hardening modulus `hardening` [Pa]."""

    stress: float
    hardening: float


@dataclass(frozen=True)
class Coated:
    """A coating of `material` and `thickness` [m], bonded to the body."""

    material: Material
    thickness: float


@dataclass(frozen=True)
class RunningIn:
    """How the surface is run in before it is pressed.

    hardness   [Pa] at which asperities flow
    load       [N/m], None for the scene's own
    positions  [m] of the roller's centre on the trace as it was given, in order
    sweeps     over all of them, at most
    """

    hardness: float
    load: float | None
    positions: tuple[float, ...]
    sweeps: int


@dataclass(frozen=True)
class ProfileInfo:
    """Where the profile comes from, and its figures after the form was removed.

    source     the file as the scene names it, or the kind of a made profile
    samples, length [m], spacing [m] (median)   of the whole trace
    form       what was taken away
    roughness  figures of what is left and is pressed
    cutoff, short_cutoff  [m] of the filter, None where there is none
    standard   parameters after ISO 21920-2 of the whole trace, whatever is pressed
    standard_why  why there are none
    trace      as read or made: with its form, unfiltered, at its own positions
    path, sha256, format   of the file that was read, None for a made profile
    place      the line of a map that it is, in words
    bridged, trimmed  lost samples: interpolated between their neighbours; dropped at the ends
    stretch    [m] from where to where the longest bridge goes, None without any
    """

    source: str
    samples: int
    length: float
    spacing: float
    form: RemovedForm
    roughness: Roughness
    path: Path | None = field(default=None, compare=False)
    trace: Profile | None = field(default=None, compare=False, repr=False)
    sha256: str | None = None
    bridged: int = 0
    trimmed: int = 0
    stretch: tuple[float, float] | None = None
    format: str | None = None
    place: str | None = None
    cutoff: float | None = None
    short_cutoff: float | None = None
    standard: StandardRoughness | None = None
    standard_why: str | None = None

    def as_dict(self) -> dict:
        """The same for JSON, without `path`, which another machine does not have, and `trace`."""
        figures = asdict(replace(self, path=None, trace=None))
        del figures["path"], figures["trace"]
        nested = ("form", "roughness", "standard")
        return figures | {name: _finite(figures[name]) for name in nested if figures[name]}

    def surface(self) -> dict:
        """The surface's figures, as pressed and by the standard, for JSON."""
        plain = self.as_dict()
        names = ("cutoff", "short_cutoff", "standard", "standard_why")
        return {"pressed": plain["roughness"], **{name: plain[name] for name in names}}


@dataclass(frozen=True)
class Extent:
    """A positive length, in m or in Hertz half-widths as it was given."""

    value: float
    in_half_widths: bool

    def metres(self, half_width: float) -> float:
        """The length [m] where the Hertz half-width is `half_width` [m]."""
        return self.value * half_width if self.in_half_widths else self.value


@dataclass(frozen=True)
class StressWindow:
    """The points of the subsurface field: |x| <= half_range, 0 <= z <= depth; `points` (nx, nz)."""

    depth: Extent
    half_range: Extent
    points: tuple[int, int]


@dataclass(frozen=True)
class AnswerSource:
    """Where an answer from outside is, and how to read it.

    files           one for each resolution
    length, stress  the file's units [m], [Pa]
    columns         of a table: those of x and pressure, by name or number
    up              axis of the file out of the rough body, with its sign; None: found out
    x_origin, z_origin  [m] where the scene's origin lies in the file: along x and along `up`
    pressure        array of a mesh that holds the contact pressure; None: the stress on its top
    step            of several in time, from 0; None: the last
    friction        coefficient that it is of; None: the only one
    scatter         relative, of measured data; None: not stated
    """

    name: str
    files: tuple[str, ...]
    length: float
    stress: float
    columns: tuple[str | int, ...]
    up: str | None
    x_origin: float
    z_origin: float
    pressure: str | None
    step: int | None
    friction: float | None
    scatter: float | None


@dataclass(frozen=True)
class FiniteElementSettings:
    """Which of the half-plane's assumptions the finite-element model keeps.

    geometry      flat: the roughness is in the gap | rough: it is the boundary
    gap           reference: at the place before loading, pressure along the mean normal |
                  displaced: on the deformed surface, pressure along the roller's normal
    roller_shape  parabola | circle
    roller_body   half-plane | disc: an elastic roller is a block, or a sector of its own circle
    coupled       the sliding traction moves the surfaces
    deformation   linear | finite: current shape and normals, hyperelastic
    plastic       the body yields where its yield stress is reached
    element       P1 | P2 | P3: degree of the displacements
    far_field     held: an unbounded body ends at a fixed boundary | half-plane: at one that moves
                  as a half-plane does there
    block         width and depth, in Hertz half-widths, of the stand-in for an unbounded body
    growth        element size gained per distance from the contact
    """

    geometry: str
    gap: str
    roller_shape: str
    roller_body: str
    coupled: bool
    deformation: str
    plastic: bool
    element: str
    far_field: str
    block: float
    growth: float

    @property
    def degree(self) -> int:
        """Of the displacements' polynomials."""
        return int(self.element[1:])


@dataclass(frozen=True)
class Resolution:
    """`pitch` [m] of the coarsest pressure elements (None: automatic); `levels` to begin with, and
    the `most` where quantities are not resolved."""

    pitch: float | None
    levels: int
    most: int = MOST_LEVELS


@dataclass(frozen=True)
class Budget:
    """What a run may take: `time` [s] by the laws of cost, not by a clock, and `memory` [bytes];
    whether it computes `effects` that the scene's finite elements do not model, and where "all",
    those too that cannot change a verdict; on how many `levels` at most (None: as the time
    allows)."""

    time: float
    memory: float
    effects: bool | str = True
    levels: int | None = None


@dataclass(frozen=True)
class Spread:
    """How uncertain an input is: normal by a standard `deviation`, `relative` to the scene's own
    value or in SI, cut off at CUT_OFF deviations; or uniform over a `range` in SI."""

    deviation: float = 0.0
    relative: bool = False
    range: tuple[float, float] | None = None

    def size(self, own: float) -> float:
        """Standard deviation about the scene's `own` value, in SI."""
        return self.deviation * (abs(own) if self.relative else 1.0)

    def ends(self, own: float) -> tuple[float, float]:
        """The smallest and the largest value that is sampled."""
        far = CUT_OFF * self.size(own)
        return self.range or (own - far, own + far)


@dataclass(frozen=True)
class Scatter:
    """Uncertain inputs of a scene, by name.

    samples             of each of two independent designs
    correlation_length  [m] of the noise, 0: white
    """

    samples: int
    seed: int
    inputs: dict[str, Spread]
    correlation_length: float


@dataclass(frozen=True)
class ResolvedScene:
    """Everything one run needs.

    name             the scene's file without its ending
    source           what messages call the scene: its path
    roller           None is a rigid roller
    hardness         [Pa] cap on the contact pressure, or None
    yielding         of the body in the finite elements; None: elastic
    coating          of the body in the finite elements; None: one material
    thickness, width [m] of the body, None where it is unbounded
    base             bonded | frictionless, None without thickness
    profile          None is a smooth body
    running_in       None: the surface is pressed as it is
    friction         coefficients, one result for each
    coupled          the half-plane's surfaces are moved by the sliding traction
    position         [m] where x = 0 lies on the trace as it was given
    stress           None: no field is asked for
    tolerance        relative, by the name of the compared quantity; others are not judged
    tables           the scene file with SI numbers and every default written out: resolving
                     them again, in a folder that holds the profile's file, gives this scene
    scatter          None: inputs are taken as exact
    run_in           what running-in did to the surface, None until it was done; then the
                     profile and its figures are those after it
    answers          from outside, beside those of the models
    """

    name: str
    source: str = field(compare=False)
    title: str
    roller_radius: float
    roller: Material | None
    body: Material
    hardness: float | None
    yielding: Yielding | None
    coating: Coated | None
    thickness: float | None
    width: float | None
    base: str | None
    profile: Profile | None = field(compare=False)
    profile_info: ProfileInfo | None
    load: Load
    running_in: RunningIn | None
    friction: tuple[float, ...]
    coupled: bool
    position: float
    stress: StressWindow | None
    tolerance: dict[str, float]
    finite_element: FiniteElementSettings
    resolution: Resolution
    budget: Budget
    tables: dict = field(repr=False)
    scatter: Scatter | None = None
    run_in: RunIn | None = field(default=None, compare=False, repr=False)
    answers: tuple[AnswerSource, ...] = ()

    @property
    def as_measured(self) -> Profile | None:
        """The profile before any running-in."""
        return self.profile if self.run_in is None else self.run_in.before

    def as_dict(self) -> dict:
        """For JSON: `tables` with the scene's name and what became of its profile."""
        return {
            "name": self.name,
            "title": self.title,
            "profile": None,
            "running_in": None,
            "stress": None,
            **copy.deepcopy(self.tables),
            "profile_info": self.profile_info.as_dict() if self.profile_info else None,
        }


def _finite(figures: dict) -> dict:
    """The figures with None for what JSON has no number for."""
    return {
        name: None if isinstance(value, float) and not math.isfinite(value) else value
        for name, value in figures.items()
    }
