"""A rigid parabola pressed on a layer on a rigid base, where no closed form exists: ten digits.

layer_contact.json says how its figures were found, by two independent derivations.

Nomenclature: a half-width [m], t thickness [m], R radius [m], E' = E/(1 - nu^2) [Pa].
"""

import json
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from analytic.layers.layered import Base

TABLE = Path(__file__).with_name("layer_contact.json")


@dataclass(frozen=True)
class LayerReference:
    """A contact in units of the layer.

    half_width      a/t
    poissons_ratio  nu; None where figures over E' are the same at any
    peak_pressure   p0 R/(E' t)
    load            P R/(E' t^2)
    error           of both, relative, by the two derivations
    """

    half_width: float
    poissons_ratio: float | None
    base: Base
    peak_pressure: float
    load: float
    error: float


@cache
def layer_references() -> tuple[LayerReference, ...]:
    """All contacts of the table."""
    return tuple(
        LayerReference(
            half_width=float(row["a_over_t"]),
            poissons_ratio=None if row["nu"] == "any" else float(row["nu"]),
            base=row["base"],
            peak_pressure=float(row["p0_R_over_Eprime_t"]),
            load=float(row["P_R_over_Eprime_t2"]),
            error=float(row["rel_error_estimate"]),
        )
        for row in json.loads(TABLE.read_text(encoding="utf-8"))["cases"]
    )
