"""What the theories of rough contact say of a scene, as a run keeps it."""

from dataclasses import asdict, dataclass
from math import prod

from analytic.statistics.nominally_flat import Summits


@dataclass(frozen=True)
class SummitRow:
    """Of the trace, filtered or thinned: its peaks, expected by moments and counted, and the
    summits by either; the latter None where they are too few."""

    treatment: str  # as pressed | cut-off | sampling
    size: float  # [m] the cut-off or the sampling interval
    bandwidth: float
    rms_slope: float
    peaks: tuple[Summits, Summits | None]
    summits: tuple[Summits, Summits | None]


@dataclass(frozen=True)
class ContactFigures:
    """[m], [Pa], [m]: sum of the patches, load over it, and the half-width of the smooth contact
    with the same mean |x| of the pressure; or changes of them, relative."""

    real_length: float
    mean_real_pressure: float
    effective_half_width: float


@dataclass(frozen=True)
class LoadRow:
    """One load [N/m], and Hertz's half-width [m] under it."""

    load: float
    half_width: float
    # of the rough cylinder on summits by `moments` and by `peaks`; of the half-plane under the
    # scene's own `trace` and, on average, under `random` ones
    figures: dict[str, ContactFigures]
    grid: ContactFigures  # what halving the pressure elements changes under the trace
    scatter: ContactFigures  # half of the 95 % interval of the random traces' mean
    patches: float  # in contact, on average over the random traces
    # mean real pressure [Pa] by Persson's theory under the pressures of `moments`, of an
    # `isotropic` surface, and of one with `ridges` across the plane
    persson: dict[str, float]
    # the same of as many ridges as `patches`, of the profile's mean radius and under even shares of
    # the load, by Hertz: right where few touch and none has merged
    even: float

    @property
    def causes(self) -> dict[str, float]:
        """Factors of the mean real pressure by `moments` over `random`."""
        theory, solved = (self.figures[name].mean_real_pressure for name in ("moments", "random"))
        isotropic, ridges = self.persson["isotropic"], self.persson["ridges"]
        factors = theory / isotropic, isotropic / ridges, ridges / solved
        return dict(zip(("summits alone", "ridges", "few contacts"), factors, strict=True))

    @property
    def difference(self) -> tuple[float, float]:
        """That ratio less 1, and its uncertainty: scatter of the traces, pressure elements."""
        ratio = prod(self.causes.values())
        parts = self.scatter.mean_real_pressure, self.grid.mean_real_pressure
        return ratio - 1.0, ratio * sum(map(abs, parts))


@dataclass(frozen=True)
class PatchState:
    """A patch of contact, from `start` to `stop` [m]."""

    start: float
    stop: float
    load: float  # [N/m]
    peak: float  # [Pa]
    radius: float  # [m] of the ridge that Hertz has it on
    depth: dict[str, float]  # h/R: book, sphere, ridge (`analytic.statistics.penetration`)
    kinds: dict[str, str]  # elastic | plastic | cutting, by the `book` and `exact`
    plastic_strain: float | None  # largest below it, None where the model does not flow


@dataclass(frozen=True)
class RoughContactStatistics:
    """All of it; so many random `traces` were solved, `patches` are by model."""

    summits: tuple[SummitRow, ...]
    loads: tuple[LoadRow, ...]
    traces: int
    patches: dict[str, tuple[PatchState, ...]]

    def as_dict(self) -> dict:
        """For JSON."""
        found = asdict(self)
        for row, content in zip(self.loads, found["loads"], strict=True):
            difference, uncertainty = row.difference
            content |= {"causes": row.causes, "difference": difference, "uncertainty": uncertainty}
        return found
