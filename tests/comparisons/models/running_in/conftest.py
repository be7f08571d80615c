"""A wavy scene that is run in, and the smooth contact of its pair."""

import copy
from collections.abc import Callable

import pytest
import scenes
from scenes import STEEL

from analytic.exact.hertz import HertzContact, hertz_from_load
from comparisons.scenes.scene import Scene

LOAD, RADIUS = 2e5, 10e-3
PAIR = hertz_from_load(LOAD, RADIUS, 210e9 / 1.82)
HARDNESS = 1.25 * PAIR.peak_pressure
WAVY = {
    "roller": {"radius": RADIUS, **STEEL},
    "body": dict(STEEL),
    "profile": {"kind": "sinusoid", "wavelength": 40e-6, "amplitude": 0.1e-6},
    "load": {"per_length": LOAD},
    "running_in": {"hardness": HARDNESS, "stroke": 60e-6, "passes": 5},
}


@pytest.fixture(scope="session")
def wavy() -> dict:
    """The scene as tables."""
    return copy.deepcopy(WAVY)


@pytest.fixture(scope="session")
def pair() -> HertzContact:
    """Its smooth contact, under its load."""
    return PAIR


@pytest.fixture(scope="session")
def hardness() -> float:
    """Of the running-in [Pa]."""
    return HARDNESS


@pytest.fixture(scope="session")
def resolved(wavy) -> Callable[..., Scene]:
    """`resolved(changes)`: it with fields of sections replaced; None takes a field or a section
    away."""

    def changed(changes: dict | None = None) -> Scene:
        fields = {}
        for section, table in (changes or {}).items():
            named = {f"{section}.{name}": value for name, value in (table or {}).items()}
            fields |= {section: None} if table is None else named
        return scenes.resolved(wavy, "wavy").changed(fields)

    return changed
