"""The gallery: line contacts with exact solutions that every numerical model is held to."""

from functools import cache

from analytic.exact.cases import (
    ExactContact,
    capped_case,
    hertz_case,
    punch_case,
    sliding_case,
    wave_case,
)
from analytic.material import Material

STEEL = Material(207e9, 0.3)
ALUMINIUM = Material(70e9, 0.33)
CERAMIC = Material(310e9, 0.26)
RUBBER = Material(5e6, 0.49)


@cache
def exact_contacts() -> tuple[ExactContact, ...]:
    """All cases of the gallery."""
    return (
        hertz_case("Hertz, steel on steel", STEEL, STEEL, 8.2e-3, 1.4e9),
        hertz_case("Hertz, steel on steel, friction 0.1", STEEL, STEEL, 8.2e-3, 4.15e9, 0.1),
        hertz_case("Hertz, steel on steel, friction 0.3", STEEL, STEEL, 8.2e-3, 1.4e9, 0.3),
        hertz_case("Hertz, light load", STEEL, STEEL, 50e-3, 1e6),
        hertz_case("Hertz, ceramic on aluminium", ALUMINIUM, CERAMIC, 20e-3, 0.5e9),
        hertz_case("Hertz, rigid on rubber", RUBBER, None, 100e-3, 0.2e6),
        punch_case("rounded punch, flat 0.3", STEEL, None, 1e-3, 0.3, 0.1),
        punch_case("rounded punch, flat 0.6", STEEL, STEEL, 1e-3, 0.6, 0.2),
        punch_case("rounded punch, flat 0.9", ALUMINIUM, STEEL, 5e-3, 0.9, 0.5),
        punch_case("rounded punch, flat 0.99", STEEL, STEEL, 5e-3, 0.99, 0.05),
        sliding_case("sliding, rigid on steel, friction 0.1", STEEL, None, 10e-3, 1e6, 0.1),
        sliding_case("sliding, rigid on steel, friction 0.5", STEEL, None, 10e-3, 1e6, 0.5),
        sliding_case("sliding, rigid on steel, friction -0.3", STEEL, None, 10e-3, 1e6, -0.3),
        sliding_case("sliding, steel on aluminium, friction 1", ALUMINIUM, STEEL, 5e-3, 1e5, 1.0),
        sliding_case("sliding, rubber on steel, friction 1", STEEL, RUBBER, 50e-3, 1e3, 1.0),
        capped_case("flattened cylinder, hardness 0.9", STEEL, STEEL, 8.2e-3, 1.4e9, 0.9),
        capped_case("flattened cylinder, hardness 0.7", STEEL, None, 8.2e-3, 1.4e9, 0.7),
        wave_case("Westergaard, 0.01 of closing", STEEL, STEEL, 100e-6, 0.1e-6, 0.01),
        wave_case("Westergaard, 0.2 of closing", STEEL, None, 1e-3, 1e-6, 0.2),
        wave_case("Westergaard, 0.9 of closing", ALUMINIUM, STEEL, 100e-6, 0.5e-6, 0.9),
        wave_case("Westergaard, full contact", STEEL, STEEL, 100e-6, 0.1e-6, 1.5),
    )
