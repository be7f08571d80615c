"""A scene as resolved: everything that is asked for, in SI, with the profile in place.

x along the surface with its origin under the roller's centre, heights positive out of the body
with their zero on the mean line. `comparisons.scenes.resolve` makes it from a file."""

import copy
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path

from analytic.material import Material, ThermalMaterial
from analytic.profile import Profile
from analytic.running_in import RunIn
from analytic.surface.form import RemovedForm
from analytic.surface.roughness import Roughness
from analytic.surface.roughness_standard import StandardRoughness
from comparisons.common.numbers import finite

MOST_LEVELS = 8  # of a run
CUT_OFF = 3.0  # standard deviations beyond which an uncertain input is not sampled


@dataclass(frozen=True)
class Load:
    """What presses the roller on."""

    kind: str  # load_per_length [N/m] | hertz_peak_pressure [Pa] of the smooth pair | approach [m]
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
    """How the surface is run in before it is pressed."""

    hardness: float  # [Pa] at which asperities flow
    load: float | None  # [N/m], None for the scene's own
    positions: tuple[float, ...]  # [m] of the roller's centre on the trace as given, in order
    sweeps: int  # over all of them, at most


@dataclass(frozen=True)
class ProfileInfo:
    """Where the profile comes from, and its figures after the form was removed."""

    source: str  # the file as the scene names it, or the kind of a made profile
    samples: int  # of the whole trace
    length: float  # [m]
    spacing: float  # [m], median
    form: RemovedForm  # what was taken away
    roughness: Roughness  # figures of what is left and is pressed
    path: Path | None = field(default=None, compare=False)  # of the file, None for a made profile
    # as read or made: with its form, unfiltered, at its own positions
    trace: Profile | None = field(default=None, compare=False, repr=False)
    sha256: str | None = None  # of the file
    bridged: int = 0  # lost samples that were interpolated between their neighbours
    trimmed: int = 0  # lost samples that were dropped at the ends
    stretch: tuple[float, float] | None = None  # [m] of the longest bridge, from where to where
    format: str | None = None  # of the file
    place: str | None = None  # the line of a map that it is, in words
    cutoff: float | None = None  # [m] of the filter, None where there is none
    short_cutoff: float | None = None  # [m]
    # parameters after ISO 21920-2 of the whole trace, whatever is pressed
    standard: StandardRoughness | None = None
    standard_why: str | None = None  # why there are none

    def as_dict(self) -> dict:
        """The same for JSON, without `path`, which another machine does not have, and `trace`."""
        figures = asdict(replace(self, path=None, trace=None))
        del figures["path"], figures["trace"]
        nested = ("form", "roughness", "standard")
        return figures | {name: finite(figures[name]) for name in nested if figures[name]}

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
    """The points of the subsurface field: |x| <= half_range, 0 <= z <= depth; `points` (nx, nz).
    `bulge` asks for what sliding raises ahead of the contact."""

    depth: Extent
    half_range: Extent
    points: tuple[int, int]
    bulge: bool = False


@dataclass(frozen=True)
class AnswerSource:
    """Where an answer from outside is, and how to read it."""

    name: str
    files: tuple[str, ...]  # one for each resolution
    length: float  # the file's unit [m]
    stress: float  # the file's unit [Pa]
    columns: tuple[str | int, ...]  # of a table: those of x and pressure, by name or number
    up: str | None  # axis of the file out of the rough body, with its sign; None: found out
    x_origin: float  # [m] where the scene's origin lies in the file, along its x
    z_origin: float  # [m], along `up`
    pressure: str | None  # array of a mesh that holds it; None: minus the stress on its top
    step: int | None  # of several in time, from 0; None: the last
    friction: float | None  # coefficient that it is of; None: the only one
    scatter: float | None  # relative, of measured data; None: not stated


@dataclass(frozen=True)
class FiniteElementSettings:
    """Which of the half-plane's assumptions the finite-element model keeps."""

    geometry: str  # flat: the roughness is in the gap | rough: it is the boundary
    # reference: at the place before loading, pressure along the mean normal | displaced: on the
    # deformed surface, pressure along the roller's normal
    gap: str
    roller_shape: str  # parabola | circle
    roller_body: str  # of an elastic roller: half-plane, a block | disc, a sector of its circle
    coupled: bool  # the sliding traction moves the surfaces
    deformation: str  # linear | finite: current shape and normals, hyperelastic
    plastic: bool  # the body yields where its yield stress is reached
    element: str  # P1 | P2 | P3: degree of the displacements
    # held: an unbounded body ends at a fixed boundary | half-plane: at one that moves as a
    # half-plane does there
    far_field: str
    block: float  # width and depth, in Hertz half-widths, of the stand-in for an unbounded body
    growth: float  # element size gained per distance from the contact

    @property
    def degree(self) -> int:
        """Of the displacements' polynomials."""
        return int(self.element[1:])


@dataclass(frozen=True)
class Resolution:
    """`pitch` [m] of the coarsest pressure elements, or `elements` of them on a half-width of the
    smooth contact (None: automatic); `levels` to begin with, and the `most` where quantities are
    not resolved."""

    pitch: float | None
    levels: int
    most: int = MOST_LEVELS
    elements: float | None = None


@dataclass(frozen=True)
class Budget:
    """What a run may take: `time` [s] by the laws of cost, not by a clock, and `memory` [bytes];
    whether it computes `effects` that the scene's finite elements do not model, and where "all",
    those too that cannot change a verdict; on at most so many `levels` (None: as time allows)."""

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
    """Uncertain inputs of a scene, by name."""

    samples: int  # of each of two independent designs
    seed: int
    inputs: dict[str, Spread]
    correlation_length: float  # [m] of the noise, 0: white


@dataclass(frozen=True)
class RoughnessStatistics:
    """What is asked of the statistics of rough contact."""

    traces: int  # random ones of the profile's spectrum, from `seed` on
    seed: int
    cutoffs: tuple[float, ...] | None  # [m] under which summits are counted; None: chosen
    metal: str  # ferrous | nonferrous: by which h/R an asperity flows
    lubricated: bool  # by which it cuts


@dataclass(frozen=True)
class Heat:
    """Sliding that heats both bodies."""

    speed: float  # [m/s] of sliding, above 0
    # speed over the mean of both surfaces' speeds past the contact, from -2 (the contact stays on
    # the body) to 2 (it stays on the roller), not 0
    slide_to_roll: float
    body: ThermalMaterial
    roller: ThermalMaterial
    coating: ThermalMaterial | None  # None without one
    bulk_temperature: float  # [K] of both bodies
    base: str  # of a body with thickness: held at that temperature | insulated
    reach: float  # [m] from the contact to where a body that it stays on has that temperature
    tolerance: float  # relative, of temperatures and thermal stresses
    expansion: float | None = None  # [1/K] of the body; None: no thermal stresses are asked for
    coating_expansion: float | None = None

    @property
    def velocities(self) -> tuple[float, float]:
        """[m/s] of the body's and the roller's surface past the contact, towards +x. Their
        difference is minus the speed: the roller drags the body towards +x."""
        mean = -self.speed / self.slide_to_roll
        return mean - 0.5 * self.speed, mean + 0.5 * self.speed


@dataclass(frozen=True)
class ResolvedScene:
    """Everything one run needs."""

    name: str  # the scene's file without its ending
    source: str = field(compare=False)  # what messages call the scene: its path
    title: str
    roller_radius: float
    roller: Material | None  # None: rigid
    body: Material
    hardness: float | None  # [Pa] cap on the contact pressure, or None
    yielding: Yielding | None  # of the body in the finite elements; None: elastic
    coating: Coated | None  # of the body in the finite elements; None: one material
    thickness: float | None  # [m] of the body, None where it is unbounded
    width: float | None  # [m], as the thickness
    base: str | None  # bonded | frictionless, None without thickness
    profile: Profile | None = field(compare=False)  # None: smooth
    profile_info: ProfileInfo | None
    load: Load
    running_in: RunningIn | None  # None: the surface is pressed as it is
    friction: tuple[float, ...]  # coefficients, one result for each
    coupled: bool  # the half-plane's surfaces are moved by the sliding traction
    position: float  # [m] where x = 0 lies on the trace as it was given
    stress: StressWindow | None  # None: no field is asked for
    tolerance: dict[str, float]  # relative, by compared quantity; others are not judged
    finite_element: FiniteElementSettings
    resolution: Resolution
    budget: Budget
    # the scene file with SI numbers and every default written out: resolving them again, in a
    # folder that holds the profile's file, gives this scene
    tables: dict = field(repr=False)
    scatter: Scatter | None = None  # None: inputs are taken as exact
    statistics: RoughnessStatistics | None = None  # of rough contact; None: not asked for
    # what running-in did, None until it was done; then the profile and its figures are after it
    run_in: RunIn | None = field(default=None, compare=False, repr=False)
    answers: tuple[AnswerSource, ...] = ()  # from outside, beside those of the models
    heat: Heat | None = None  # None: no temperature is asked for

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
