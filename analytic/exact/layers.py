"""Rigid cylinder of radius R on an elastic layer of thickness t on a rigid base, without friction.

The layer is bonded to the base, or slides on it but stays ("frictionless"). Between the limits of
thick and thin layers no closed form exists: layer_contact.json holds ten digits, and says how they
were found by two independent derivations. a is the half-width [m], p0 the peak pressure [Pa], P the
load per length [N/m], nu and E' = E/(1 - nu^2) [Pa] are the layer's."""

import json
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from analytic.layers.layered import Base

TABLE = Path(__file__).with_name("layer_contact.json")


@dataclass(frozen=True)
class LayerReference:
    """A contact in units of the layer."""

    half_width: float  # a/t
    poissons_ratio: float | None  # nu; None where figures over E' are the same at any
    base: Base
    peak_pressure: float  # p0 R/(E' t)
    load: float  # P R/(E' t^2)
    error: float  # of both, relative, by the two derivations


@cache
def layer_references() -> tuple[LayerReference, ...]:
    """All contacts of layer_contact.json."""
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
