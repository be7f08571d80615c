"""What a periodic surface takes: a flat body and a mean pressure; and what it does not."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from comparisons.scenes.fields import allowed

if TYPE_CHECKING:
    from comparisons.scenes.scene import SceneBase

# Sections that need a single contact under a roller, or bodies that are not linear.
WITHOUT = ("running_in", "scatter", "statistics", "heat", "partial_slip", "answers")
LINEAR = {
    "finite_element.deformation": "linear",
    "finite_element.plastic": False,
    "finite_element.roller_shape": "parabola",
    "finite_element.roller_body": "half-plane",
    "finite_element.far_field": "held",
    "load.coupled": False,
}
LINEAR |= {"stress.bulge": False, "body.width": None, "roller.support": None}
LINEAR |= {"finite_element.coupled": (None, False), "finite_element.gap": (None, "reference")}


def misfits(scene: "SceneBase") -> Iterator[tuple[str, str]]:
    """Fields of a scene that do not fit whether its surface is periodic, and what is wrong."""
    profile, load = scene.profile, scene.load
    if not is_periodic(scene):
        if scene.roller.radius is None:
            yield "roller.radius", f"is missing; allowed is {allowed(type(scene.roller), 'radius')}"
        if load.mean_pressure is not None:
            where = "under a roller, whose load is per length"
            yield "load.mean_pressure", f"is given {where}; allowed with profile.periodic = true"
        return
    if scene.roller.radius is not None:
        flat = "is given beside profile.periodic = true, where the smooth body is flat"
        yield "roller.radius", f"{flat}; allowed is none"
    if load.mean_pressure is None:
        yield f"load.{load.kind}", "is given for a periodic surface; allowed is load.mean_pressure"
    if profile.wavelength is not None and profile.length is not None:
        waves = profile.length / profile.wavelength
        if abs(waves - round(waves)) > 1e-9 * waves:
            yield "profile.length", f"is {waves:g} wavelengths; allowed is a whole number of them"
    for name in WITHOUT:
        if getattr(scene, name, None):
            yield name, "is given for a periodic surface; allowed is none"
    for name, fits in LINEAR.items():
        section, _, field = name.partition(".")
        value = getattr(getattr(scene, section), field, None)
        options = fits if isinstance(fits, tuple) else (fits,)
        if getattr(scene, section) is not None and value not in options:
            words = ", ".join(_in_toml(option) for option in options if option is not None)
            yield name, f"is {_in_toml(value)} for a periodic surface; allowed is {words or 'none'}"
    if scene.body.base == "frictionless" and max(load.friction) > 0.0:
        slides = f"is {max(load.friction):g} on a periodic body on a frictionless base"
        yield "load.friction", f'{slides}; allowed is friction = 0 or body.base = "bonded"'


def is_periodic(scene: "SceneBase") -> bool:
    return scene.profile is not None and bool(scene.profile.periodic)


def _in_toml(value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return f'"{value}"' if isinstance(value, str) else "given" if value is not None else "none"
