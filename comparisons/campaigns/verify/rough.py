"""Rough contacts with an exact solution: as scenes, and on the library's operators.

Their initial gap is made from the pressures (`analytic.exact.manufactured`), so that there are as
many patches as one likes, of any widths, on a half-plane, a layer or a coating. A scene's roughness
is what the gap lies below a roller's parabola, sampled so densely that its spline leaves errors far
below any stated uncertainty."""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial

import numpy as np

from analytic.exact.cases import ALUMINIUM, CERAMIC, STEEL
from analytic.exact.manufactured import ManufacturedContact, random_patches
from analytic.layers.layered import LayeredBody
from analytic.layers.operator import LayeredSurface
from analytic.material import Material
from analytic.profile import Profile
from analytic.surface.readers.files import MeasuredProfile
from comparisons.campaigns.verify.operators import OperatorContact
from comparisons.campaigns.verify.scenes import (
    LINEAR,
    ExactScene,
    elastic_table,
    fine_half_plane,
    spread,
)
from comparisons.models.problem import Problem
from comparisons.scenes.surface import KnownTrace

HALF_PLANES, FINITE_ELEMENTS, LAYERS = 20, 3, 4
# Third level: pressure elements on half of a mean patch. With fewer the first level has not the
# order of the others yet, and the uncertainties are ten times the errors.
ELEMENTS, MESHED = (40.0, 110.0), (30.0, 80.0)  # of the half-plane and layer, of finite elements
FRICTIONS = (0.0, 0.1)
MANY, FEW = (3, 5, 4, 7, 6), (3, 2, 4)  # patches, by what a solution costs
REACH = 1e-4  # [m] half of the distance from the first to the last contact
PRESSURE = 2e9  # [Pa] of the highest asperities
SAMPLES, BEYOND = 4001, 0.6  # of the trace, and its length beside the contact over REACH
DEPTH = 0.4  # of REACH: depth of the window, within every layer and coating
SOURCE = "displacement of the chosen pressures, analytic/exact/manufactured.py"
HALF_PLANE = "half-plane"
# What is pressed: steel, or a layer or coating with its thickness and base.
BODIES: dict[str, LayeredBody | None] = {
    HALF_PLANE: None,
    "bonded layer": LayeredBody(STEEL, 0.8 * REACH, "bonded"),
    "hard coating": LayeredBody(CERAMIC, 0.4 * REACH, ALUMINIUM),
    "frictionless layer": LayeredBody(STEEL, 1.5 * REACH, "frictionless"),
    "soft coating": LayeredBody(ALUMINIUM, 0.5 * REACH, STEEL),
    "nearly incompressible layer": LayeredBody(Material(207e9, 0.45), 1.0 * REACH, "bonded"),
}
LAYERED = [name for name in BODIES if name != HALF_PLANE]


def rough_contact(
    seed: int, body: str = HALF_PLANE, counts: tuple[int, ...] = MANY
) -> ManufacturedContact:
    """Patches drawn from the seed, on one of BODIES; what is layered is under a rigid roller."""
    patches = random_patches(seed, counts[seed % len(counts)], REACH, PRESSURE)
    friction, layer = FRICTIONS[seed % len(FRICTIONS)], BODIES[body]
    material, roller = (STEEL, STEEL) if layer is None else (layer.material, None)
    return ManufacturedContact(patches, material, roller, layer, friction)


def rough_scenes(
    half_planes: int = HALF_PLANES, finite_elements: int = FINITE_ELEMENTS, layers: int = LAYERS
) -> tuple[ExactScene, ...]:
    """Scenes of so many half-planes for the half-plane and for finite elements, and of LAYERED for
    finite elements; with the model error where there are finite elements."""
    bodies = [HALF_PLANE] * (half_planes + finite_elements) + LAYERED[:layers]
    resolutions = spread(half_planes, ELEMENTS) + spread(len(bodies) - half_planes, MESHED)
    scenes = []
    for seed, (body, elements) in enumerate(zip(bodies, resolutions, strict=True)):
        contact = rough_contact(seed, body, MANY if seed < half_planes else FEW)
        scene = rough_scene(_name(seed, body, contact), contact, elements)
        reference = partial(_no_error, scene) if body == HALF_PLANE else fine_half_plane
        asked = {"models": ("half_plane",)} if seed < half_planes else {"half_plane": reference}
        scenes.append(replace(scene, **asked))
    return tuple(scenes)


def rough_scene(name: str, contact: ManufacturedContact, elements: float) -> ExactScene:
    """The scene of a contact, with so many elements on half a mean patch on the third level."""
    tables = {
        "roller": {"radius": roller_radius(contact), **elastic_table(contact.roller)},
        "body": elastic_table(contact.body),
        "profile": {"file": "manufactured", "form": "none"},
        "load": {"per_length": contact.load, "friction": contact.friction, "coupled": False},
        "stress": {
            "half_range": f"{1.1 * REACH} m",
            "depth": f"{DEPTH * REACH} m",
            "points": [60, 20],
        },
        "resolution": {"pitch": 4.0 * _half_patch(contact) / elements},
        "budget": LINEAR,
    }
    layer = contact.layer
    if layer is not None and layer.rigid:
        tables["body"] |= {"thickness": layer.thickness, "base": layer.base}
    elif layer is not None:
        tables["coating"] = tables["body"] | {"thickness": layer.thickness}
        tables["body"] = elastic_table(layer.base)
    extremes = contact.extremes(DEPTH * REACH)
    exact = {
        "peak_pressure": contact.peak_pressure,
        "contact_length": contact.contact_length,
        "tau1_max": extremes["tau1"].value,
        "tau1_max_depth": extremes["tau1"].z,
        "txz_max_abs": extremes["txz"].value,
    }
    name += f", {elements:g} elements"
    x = np.linspace(-1.0, 1.0, SAMPLES) * (1.0 + BEYOND) * REACH  # 0 in the middle
    roughness = Profile(x, 0.5 * x**2 / roller_radius(contact) - contact.gap(x))
    trace = KnownTrace(MeasuredProfile(roughness, "text", None, 0, 0), None)
    solved = contact.pressure, ("finite_element",), trace
    return ExactScene(name, SOURCE, "rough", tables, exact, *solved)


def rough_operator_contacts() -> tuple[OperatorContact, ...]:
    """Layers and coatings on the library's own operators."""
    return tuple(_operator_contact(seed, body) for seed, body in enumerate(LAYERED * 2))


def _operator_contact(seed: int, body: str) -> OperatorContact:
    contact, margin = rough_contact(seed, body), 0.5 * REACH
    return OperatorContact(
        *(_name(seed, body, contact), SOURCE, "rough", "layer"),
        make=partial(LayeredSurface, body=contact.layer),
        gap=contact.gap,
        load=contact.load,
        span=(contact.ends[0] - margin, contact.ends[1] + margin),
        scale=_half_patch(contact),
        exact={name: getattr(contact, name) for name in ("peak_pressure", "contact_length")},
        patches=len(contact.patches),
    )


def roller_radius(contact: ManufacturedContact) -> float:
    """R [m] of a roller whose smooth contact would be as wide as the rough one under its load."""
    half_width = 0.5 * np.ptp(contact.ends)
    return float(0.25 * np.pi * contact.modulus * half_width**2 / contact.load)


def _no_error(scene: ExactScene, problem: Problem) -> Mapping[str, float]:
    return scene.exact


def _half_patch(contact: ManufacturedContact) -> float:
    return 0.5 * contact.contact_length / len(contact.patches)


def _name(seed: int, body: str, contact: ManufacturedContact) -> str:
    return f"rough {body} {seed}, {len(contact.patches)} patches, friction {contact.friction:g}"
