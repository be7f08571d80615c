"""The dimensionless groups of a map: how a scene takes a value of each; and its axes.

    a, p0   half-width [m] and peak pressure [Pa] of the smooth contact under the scene's load
    t, w    thickness and width of the body [m]        R   radius of relative curvature [m]
    mu      coefficient of friction                    H   hardness [Pa]
    beta    Dundurs' constant of body and roller       E   Young's moduli [Pa]
    E', Ec  modulus of roller, of coating [Pa]         h   thickness of the coating [m]

Each group also says which of the half-plane's assumptions the finite elements drop for it. All
else stays as in the scene, but for what follows from its lengths: waves that are stretched keep
their slopes. Groups that change a are set before those that are measured by it.
"""

import re
import tomllib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

import numpy as np

from analytic.exact.hertz import HertzContact
from analytic.material import dundurs_constants
from analytic.surface.roughness import shortest_wavelength
from comparisons.common.errors import InputError, SceneError, nearest
from comparisons.models.problem import Problem
from comparisons.scenes.profile import ProfileSection
from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import smooth_contact, surface_of

WAVY = "sinusoid", "self-affine", "ground"  # kinds of profiles whose waves can be stretched
# Their fields that are lengths along x, and those that heights are proportional to.
LENGTHS = ("length", "wavelength", "shortest_wavelength", "roll_off_wavelength")
LENGTHS += ("longest_wavelength", "cutoff", "short_cutoff")
HEIGHTS = "amplitude", "rms_height"
SHORTEST = 4.0  # samples of a profile's shortest wave, where it names none

Changes = dict[str, object]  # values of a scene's fields by their names


@dataclass(frozen=True)
class Group:
    """A dimensionless group, one of groups.toml."""

    # which fields give a scene a value of the group
    set_to: Callable[[Scene, float], Changes]
    # the group's value of a scene, where it says how large an effect is, and the scene has one
    value_of: Callable[[Problem], float | None]
    # symbol, label: for axes, short and in words
    symbol: str
    label: str
    span: tuple[float, float]  # its range unless another one is asked for
    # fields of [finite_element] that drop the assumption that the group is about
    finite_element: Mapping[str, object] = field(default_factory=dict)
    section: str | None = None  # that a scene must have
    early: bool = False  # the group changes a
    # up to which errors a map's scale is straight: larger where they change sign amid the map
    straight: float = 1e-3


def _smooth(scene: Scene) -> HertzContact:
    """The smooth contact of half-planes under a scene's load, which groups refer to."""
    _refuse_load(scene, "mean_pressure")
    return smooth_contact(scene)


def _refuse_load(scene: Scene, kind: str) -> None:
    if scene.load.kind == kind:
        raise SceneError(
            f"{scene.source}: load.{kind}: is no load that groups can refer to; allowed for a "
            "map is per_length or hertz_peak_pressure"
        )


def scene_with(scene: Scene, values: Mapping[str, float]) -> Scene:
    """The scene in which every named group has its value. Raises SceneError where it does not have
    what a group is about."""
    _refuse_load(scene, "approach")
    draft, changes = scene, {}
    for name in sorted(values, key=lambda name: not GROUPS[name].early):
        section = GROUPS[name].section
        if section is not None and getattr(scene, section) is None:
            needed = f"is missing; allowed for its groups is [{section}]"
            raise SceneError(f"{scene.source}: {section}: {needed}")
        fields = GROUPS[name].set_to(draft, values[name])
        changes |= fields  # those that change a are checked before others take a from them
        draft = scene.changed(changes) if GROUPS[name].early else draft.unchecked(fields)
    return scene.changed(changes | {"finite_element": finite_elements(scene, values)})


def finite_elements(scene: Scene, names: Iterable[str]) -> dict:
    """The scene's [finite_element] without the assumptions that the named groups are about."""
    settings = scene.written.get("finite_element", {})
    for name in names:
        settings |= GROUPS[name].finite_element
    return settings


def _size(name: str, problem: Problem) -> float:
    extent = getattr(problem.scene.body, name)
    return 0.0 if extent is None else problem.hertz.half_width / extent


def _slope(problem: Problem) -> float:
    info = problem.surface.info
    return 0.0 if info is None else info.roughness.rms_slope


def _wavelength(problem: Problem) -> float | None:
    profile = problem.scene.profile
    if profile is None:
        return None
    made = profile.kind in WAVY
    shortest = _shortest(profile) if made else shortest_wavelength(problem.surface.profile)
    return shortest / problem.hertz.half_width


def _shortest(profile: ProfileSection) -> float:
    """Wave [m] of a made profile."""
    if profile.kind == "sinusoid":
        return profile.wavelength
    spacing = profile.length / (profile.samples - 1)
    return profile.shortest_wavelength or SHORTEST * spacing


def _set_size(name: str, scene: Scene, value: float) -> Changes:
    return {f"body.{name}": _smooth(scene).half_width / value}


def _set_radius(scene: Scene, value: float) -> Changes:
    """Set the load: a = 2 p0 R / E*."""
    if not scene.roller.rigid:
        raise SceneError(
            f"{scene.source}: roller: is elastic; allowed with a_over_radius, which needs finite "
            "deformation, is roller.rigid = true"
        )
    peak = 0.5 * value * _smooth(scene).combined_modulus
    return {"load.per_length": None, "load.hertz_peak_pressure": peak}


def _set_friction(scene: Scene, value: float) -> Changes:
    _refuse_load(scene, "mean_pressure")
    beta = abs(dundurs_constants(scene.body.material, scene.roller.material)[1])
    if beta == 0.0:
        raise SceneError(
            f"{scene.source}: body: has the roller's elastic constants, so that friction moves "
            "nothing; allowed with friction_dundurs are unlike bodies or a rigid roller"
        )
    return {"load.friction": (value / beta,), "load.coupled": False}


def _set_hardness(scene: Scene, value: float) -> Changes:
    """Set hardness, the half-plane's largest pressure, and yield stress; their ratio stays."""
    body = scene.body
    if body.hardness is None or body.yield_stress is None:
        raise SceneError(
            f"{scene.source}: body.yield_stress: is missing; allowed with "
            "peak_pressure_over_hardness are body.hardness and body.yield_stress"
        )
    factor = _smooth(scene).peak_pressure / value / body.hardness
    if body.hardening is not None:
        raise SceneError(
            f"{scene.source}: body.hardening: is given; allowed with peak_pressure_over_hardness "
            "is body.hardening_modulus"
        )
    names = ("hardness", "yield_stress", "hardening_modulus")
    sizes = {name: getattr(body, name) for name in names}
    return {f"body.{name}": size * factor for name, size in sizes.items() if size is not None}


def _set_modulus_ratio(scene: Scene, value: float) -> Changes:
    if scene.roller.rigid:
        raise SceneError(
            f"{scene.source}: roller.rigid: is true; allowed with modulus_ratio is an elastic one"
        )
    return {"roller.youngs_modulus": value * scene.body.youngs_modulus}


def _made_profile(scene: Scene, group: str) -> ProfileSection:
    if scene.profile is None or scene.profile.kind not in WAVY:
        raise SceneError(
            f"{scene.source}: profile: cannot be changed along {group}; allowed there is kind = "
            + ", ".join(f'"{kind}"' for kind in WAVY)
        )
    return scene.profile


def _scaled(profile: ProfileSection, names: Iterable[str], factor: float) -> Changes:
    """Those of the named fields of a profile that are sizes, times a factor."""
    sizes = {name: getattr(profile, name) for name in names}
    return {f"profile.{n}": size * factor for n, size in sizes.items() if isinstance(size, float)}


def _set_wavelength(scene: Scene, value: float) -> Changes:
    """Scale the profile: x and heights by one factor, so that slopes stay."""
    profile, position = _made_profile(scene, "wavelength_over_a"), scene.load.position
    factor = value * _smooth(scene).half_width / _shortest(profile)
    changes = _scaled(profile, (*LENGTHS, *HEIGHTS), factor)
    return changes if position is None else changes | {"load.position": position * factor}


def _set_slope(scene: Scene, value: float) -> Changes:
    profile = _made_profile(scene, "rms_slope")
    factor = value / surface_of(scene, standard=False).info.roughness.rms_slope
    return _scaled(profile, (*HEIGHTS, "rms_slope"), factor)


def _modulus_ratio(section: str, problem: Problem) -> float | None:
    """Ratio of plane strain moduli, which contacts know of; that of Young's where bodies are alike
    in Poisson's ratio."""
    other, body = problem.scene.elastic_sections.get(section), problem.scene.body.material
    return other and other.material.plane_strain_modulus / body.plane_strain_modulus


FUNCTIONS = {  # set_to, value_of
    "a_over_thickness": (partial(_set_size, "thickness"), partial(_size, "thickness")),
    "a_over_width": (partial(_set_size, "width"), partial(_size, "width")),
    "a_over_radius": (
        _set_radius,
        lambda posed: posed.hertz.half_width / posed.scene.roller.radius,
    ),
    "rms_slope": (_set_slope, _slope),
    "wavelength_over_a": (_set_wavelength, _wavelength),
    "friction_dundurs": (
        _set_friction,
        lambda problem: max(problem.scene.load.friction) * abs(problem.dundurs_beta),
    ),
    "peak_pressure_over_hardness": (_set_hardness, lambda problem: None),
    "poissons_ratio": (
        lambda scene, value: {"body.poissons_ratio": value},
        lambda problem: problem.scene.body.poissons_ratio,
    ),
    "modulus_ratio": (_set_modulus_ratio, partial(_modulus_ratio, "roller")),
    "coating_over_a": (
        lambda scene, value: {"coating.thickness": value * _smooth(scene).half_width},
        lambda posed: (
            posed.scene.coating and posed.scene.coating.thickness / posed.hertz.half_width
        ),
    ),
    "coating_modulus_ratio": (
        lambda scene, value: {"coating.youngs_modulus": value * scene.body.youngs_modulus},
        partial(_modulus_ratio, "coating"),
    ),
}
GROUPS = {
    name: Group(*FUNCTIONS[name], **fields)
    for name, fields in tomllib.loads(
        Path(__file__).with_name("groups.toml").read_text(encoding="utf-8")
    ).items()
}

Axis = dict[str, object]  # of map.json: group, symbol, label, logarithmic, values
FIGURES = 6  # significant, of the values: the same on every machine
SPANS_DECADES = 3.0  # largest over smallest value from which an axis is logarithmic
FEWEST, MOST = 2, 200  # values of an axis
_NUMBER = r"(\d*\.?\d+(?:[eE][+-]?\d+)?)"
_AXIS = re.compile(rf"\s*([\w-]+)\s*(?:=\s*{_NUMBER}\s*:\s*{_NUMBER}\s*)?", re.ASCII)
_POINTS = re.compile(r"\s*(\d+)\s*[x×]\s*(\d+)\s*", re.ASCII)


def axis_of(text: str, count: int, option: str) -> Axis:
    """The axis that "GROUP" or "GROUP=FROM:TO" means: so many values of a group, ascending, of
    equal ratios where it is logarithmic, else of equal differences. Raises InputError, which names
    the `option`, for anything else."""
    parts = _AXIS.fullmatch(text)
    if not parts:
        raise InputError(f"{option}: is {text!r}; allowed is GROUP or GROUP=FROM:TO")
    name = parts[1].replace("-", "_")
    if name not in GROUPS:
        raise InputError(
            f"{option}: there is no group {parts[1]}; the nearest is {nearest(name, GROUPS)}; "
            f"allowed are {', '.join(GROUPS)}"
        )
    low, high = GROUPS[name].span
    if parts[2]:
        low, high = float(parts[2]), float(parts[3])
        if not low < high or (low == 0.0 and name != "poissons_ratio"):
            raise InputError(
                f"{option}: the range is {parts[2]}:{parts[3]}; allowed are two numbers above 0, "
                "the smaller one first"
            )
    logarithmic = low > 0.0 and high / low >= SPANS_DECADES
    values = (np.geomspace if logarithmic else np.linspace)(low, high, count)
    return {
        "group": name,
        "symbol": GROUPS[name].symbol,
        "label": GROUPS[name].label,
        "logarithmic": logarithmic,
        "values": [float(f"{value:.{FIGURES}g}") for value in values],
    }


def counts_of(text: str) -> tuple[int, int]:
    parts = _POINTS.fullmatch(text)
    counts = tuple(map(int, parts.groups())) if parts else ()
    if not counts or not all(FEWEST <= count <= MOST for count in counts):
        raise InputError(
            f"--points: is {text!r}; allowed is NxM, from {FEWEST} to {MOST} values each"
        )
    return counts


def usual_axes(scene: Scene) -> tuple[str, str]:
    if scene.profile is not None and scene.profile.kind in WAVY:
        return "wavelength_over_a", "rms_slope"
    if any(scene.load.friction) and scene.roller.rigid:
        return "a_over_thickness", "friction_dundurs"
    return "a_over_thickness", "a_over_radius" if scene.roller.rigid else "a_over_width"
