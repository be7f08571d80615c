"""A line contact with an exact solution: the problem, the pressure, the figures; and its makers.

A numerical model takes the problem and is judged by the rest."""

import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path

import numpy as np

from analytic.exact.flattened_cylinder import flattened_cylinder
from analytic.exact.hertz import hertz_extremes, hertz_from_peak_pressure
from analytic.exact.rounded_punch import rounded_punch_from_half_width
from analytic.exact.sliding import sliding_from_load
from analytic.exact.westergaard import westergaard_from_mean_pressure
from analytic.grid import roller_gap
from analytic.material import Material, combined_modulus, dundurs_constants

Curve = Callable[[np.ndarray], np.ndarray]
Pair = tuple[Material, Material | None]
"""Body and roller; a roller of None is rigid."""

STEEL = Material(207e9, 0.3)
ALUMINIUM = Material(70e9, 0.33)
CERAMIC = Material(310e9, 0.26)
MATERIALS = {"steel": STEEL, "aluminium": ALUMINIUM, "ceramic": CERAMIC, "rigid": None}
MATERIALS["rubber"] = Material(5e6, 0.49)


@dataclass(frozen=True)
class ExactContact:
    """A contact problem and its exact solution; x [m] as in the scene, q = friction p in +x."""

    name: str
    source: str  # of the solution
    body: Material
    roller: Material | None  # None: rigid
    load: float  # [N/m]; a wavelength's where periodic
    gap: Curve  # initial gap g0(x) [m] but for a constant
    half_range: float  # [m]: the contact lies well inside |x| < half_range
    pressure: Curve  # exact p(x) [Pa], zero outside the contact
    # exact figures [SI] by name: peak_pressure, contact_length, left_edge and right_edge always;
    # where known peak_position, mean_gap, tau1_max, tau1_max_depth, txz_max_abs, flowed_length.
    # Periodic cases count one patch.
    quantities: Mapping[str, float]
    friction: float = 0.0  # of the traction; it also shifts the pressure where `coupled`
    knots: tuple[float, ...] = ()  # x [m] where g0 is not smooth
    period: float | None = None  # [m] of pressure and gap, or None
    hardness: float = np.inf  # largest pressure [Pa]

    @property
    def combined_modulus(self) -> float:
        """E* [Pa] of the two materials."""
        return combined_modulus(self.body, self.roller)

    @property
    def dundurs_beta(self) -> float:
        """Dundurs' beta of the pair, the roller as first body."""
        return dundurs_constants(self.body, self.roller)[1]

    @property
    def coupled(self) -> bool:
        """Whether the traction moves the surface vertically and so changes the pressure."""
        return self.friction * self.dundurs_beta != 0.0


def hertz_case(
    name: str, pair: Pair, radius: float, peak_pressure: float, friction: float = 0.0
) -> ExactContact:
    """Cylinder of `radius` [m] under `peak_pressure` [Pa]; with friction only where uncoupled."""
    hertz = hertz_from_peak_pressure(peak_pressure, radius, combined_modulus(*pair))
    if friction and dundurs_constants(*pair)[1]:
        raise ValueError("friction between these materials is a sliding case")
    a, extremes = hertz.half_width, hertz_extremes(hertz, friction)
    stresses = {"tau1_max": extremes.tau1.value, "tau1_max_depth": extremes.tau1.z}
    stresses["txz_max_abs"] = max(extremes.txz_max.value, -extremes.txz_min.value)
    return ExactContact(
        name,
        "Hertz 1882; Smith and Liu 1953 (Johnson 1985, sections 4.2 and 7.1)",
        *pair,
        load=hertz.load_per_length,
        gap=roller_gap(radius),
        half_range=1.5 * a,
        pressure=hertz.pressure,
        quantities=_figures(hertz.peak_pressure, -a, a, 0.0) | stresses,
        friction=friction,
    )


def punch_case(
    name: str, pair: Pair, half_width: float, flat_share: float, corner_radius: float
) -> ExactContact:
    """Punch in contact over `half_width` a [m], b = `flat_share` a, corners of R [m]."""
    modulus = combined_modulus(*pair)
    b = flat_share * half_width
    punch = rounded_punch_from_half_width(half_width, b, corner_radius, modulus)
    return ExactContact(
        name,
        "Ciavarella, Hills and Monno 1998",
        *pair,
        load=punch.load_per_length,
        gap=punch.gap,
        half_range=1.5 * half_width,
        pressure=punch.pressure,
        quantities=_figures(punch.peak_pressure, -half_width, half_width),
        knots=(-b, b),
    )


def sliding_case(
    name: str, pair: Pair, radius: float, load_per_length: float, friction: float
) -> ExactContact:
    """Cylinder of `radius` [m] that slides under P [N/m] on a body of other elastic constants."""
    modulus, beta = combined_modulus(*pair), dundurs_constants(*pair)[1]
    contact = sliding_from_load(load_per_length, radius, modulus, friction, beta)
    return ExactContact(
        name,
        "Johnson 1985, section 7.2",
        *pair,
        load=load_per_length,
        gap=roller_gap(radius),
        half_range=2.0 * contact.half_width,
        pressure=contact.pressure,
        quantities=_figures(contact.peak_pressure, *contact.edges, contact.peak_position),
        friction=friction,
    )


def capped_case(
    name: str, pair: Pair, radius: float, peak_pressure: float, share: float
) -> ExactContact:
    """Cylinder under the load of `peak_pressure` [Pa], capped at `share` of that."""
    modulus = combined_modulus(*pair)
    hertz = hertz_from_peak_pressure(peak_pressure, radius, modulus)
    hardness = share * peak_pressure
    flat = flattened_cylinder(hertz.load_per_length, radius, modulus, hardness)
    return ExactContact(
        name,
        "derived in exact.flattened_cylinder",
        *pair,
        load=hertz.load_per_length,
        gap=roller_gap(radius),
        half_range=1.5 * flat.contact,
        pressure=flat.pressure,
        quantities=_figures(hardness, -flat.contact, flat.contact)
        | {"flowed_length": 2.0 * flat.flowed},
        hardness=hardness,
    )


def wave_case(
    name: str, pair: Pair, wavelength: float, amplitude: float, share: float
) -> ExactContact:
    """Sinusoid of `wavelength`, `amplitude` [m] under `share` of the pressure that closes it."""
    modulus = combined_modulus(*pair)
    closing = np.pi * modulus * amplitude / wavelength
    wave = westergaard_from_mean_pressure(share * closing, wavelength, amplitude, modulus)
    return ExactContact(
        name,
        "Westergaard 1939 (Johnson 1985, section 13.2)",
        *pair,
        load=wave.load_per_wavelength,
        gap=partial(_wave_gap, wavelength, amplitude),
        half_range=0.5 * wavelength,
        pressure=wave.pressure,
        quantities=_figures(wave.peak_pressure, -wave.half_width, wave.half_width, 0.0)
        | {"mean_gap": wave.mean_gap},
        period=wavelength,
    )


MAKERS = {
    "hertz": hertz_case,
    "punch": punch_case,
    "sliding": sliding_case,
    "capped": capped_case,
    "wave": wave_case,
}


def _wave_gap(wavelength: float, amplitude: float, x: np.ndarray) -> np.ndarray:
    return 2.0 * amplitude * np.sin(np.pi * x / wavelength) ** 2


def _figures(
    peak_pressure: float, left: float, right: float, position: float | None = None
) -> dict[str, float]:
    """Figures that every contact has, by its peak pressure [Pa], its edges and its peak's x [m]."""
    edges = {"contact_length": right - left, "left_edge": left, "right_edge": right}
    place = {} if position is None else {"peak_position": position}
    return {"peak_pressure": peak_pressure} | edges | place


@cache
def exact_contacts() -> tuple[ExactContact, ...]:
    """The gallery of cases.toml, that every numerical model is held to."""
    gallery = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
    return tuple(
        MAKERS[kind](name, (MATERIALS[body], MATERIALS[roller]), *parameters)
        for kind, cases in gallery["contacts"].items()
        for name, body, roller, *parameters in cases
    )
