"""What the theories of rough contact say of a scene, as a run keeps it."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from math import prod

from analytic.statistics.nominally_flat import Summits
from comparisons.figures.figure import Column, Findings, Series

NAME = "statistics"
UNITS = dict.fromkeys(("size", "radius", "deviation", "start", "stop", "half_width"), "m")
UNITS |= dict.fromkeys(("real_length", "effective_half_width"), "m")
UNITS |= dict.fromkeys(("mean_real_pressure", "peak", "even", "isotropic", "ridges"), "Pa")
UNITS |= {"load": "N/m"}
RATIOS = ("causes", "depth")  # tables without a unit


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

    def findings(self, known: Findings) -> Findings:
        """As tables; patches are as uncertain as the worst of their model's `known` figures."""
        series = [
            Series("summits", columns_of([flat(asdict(row)) for row in self.summits], {})),
            _of_loads(self.loads),
        ]
        for name, patches in self.patches.items():
            own = [f for f in known.figures if f.source == name and f.levels]
            worst = max(figure.numerical for figure in own)
            rows = [flat(asdict(patch)) for patch in patches]
            sizes = {
                key: [worst * abs(row[key]) for row in rows]
                for key, value in rows[0].items()
                if isinstance(value, float)
            }
            series.append(Series("patches", columns_of(rows, sizes), name))
        series.append(Series("traces", {"traces": Column((self.traces,))}))
        return Findings(series=tuple(series))


def _of_loads(loads: tuple[LoadRow, ...]) -> Series:
    """Of the solved ones: by the scatter of the random traces, and by the pressure elements."""
    rows, sizes = [], {}
    for load in loads:
        difference, uncertainty = load.difference
        content = asdict(load) | {"causes": load.causes, "difference": difference}
        del content["grid"], content["scatter"]  # they are uncertainties
        rows.append(flat(content))
        unsure = {"random": load.scatter, "trace": load.grid}
        for source, found in unsure.items():
            for name, share in asdict(found).items():
                value = getattr(load.figures[source], name)
                sizes.setdefault(f"figures.{source}.{name}", []).append(abs(share * value))
        sizes.setdefault("difference", []).append(uncertainty)
    return Series("loads", columns_of(rows, sizes))


def flat(content: Mapping[str, object], before: str = "") -> dict[str, object]:
    """Nested tables as one, with dots in the names; pairs are by `moments` and by `peaks`."""
    found: dict[str, object] = {}
    for name, value in content.items():
        if isinstance(value, tuple | list):
            value = dict(zip(("moments", "peaks"), value, strict=True))
        if isinstance(value, dict):
            found |= flat(value, f"{before}{name}.")
        elif value is not None:
            found[before + name] = value
    return found


def columns_of(rows: list[dict], sizes: Mapping[str, list[float]]) -> dict[str, Column]:
    names = dict.fromkeys(name for row in rows for name in row)
    return {
        name: Column(
            tuple(row.get(name) for row in rows),
            "" if name.startswith(RATIOS) else UNITS.get(name.rpartition(".")[2], ""),
            tuple(sizes[name]) if name in sizes else None,
        )
        for name in names
    }
