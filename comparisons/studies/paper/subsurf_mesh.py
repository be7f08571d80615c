"""The half-plane's stresses on SUBSURF's own kind of mesh: even columns and layers."""

import numpy as np

from analytic.stress.points import friction_stress_at
from comparisons.results.outcome import Outcome
from comparisons.studies.paper.subsurf import SubsurfFile, Value

COLUMNS, LAYERS = 251, 101
HALF_RANGE, DEPTH = 1.25, 1.0  # a, of the mesh
COMPONENTS = {"tau1": "principal shear", "txz": "orthogonal shear"}


def subsurf_files(
    outcome: Outcome, columns: int = COLUMNS, layers: int = LAYERS
) -> dict[str, SubsurfFile]:
    """By file name, both shear stresses at every friction coefficient of a run.

    The mesh stands centred under the pressures, from the first contact to the last.
    """
    level, hertz = outcome.runs["half_plane"].finest, outcome.problem.hertz
    centre = 0.5 * float(level.patches[0, 0] + level.patches[-1, 1])
    x = centre + hertz.half_width * np.linspace(-HALF_RANGE, HALF_RANGE, columns)
    z = hertz.half_width * np.linspace(0.0, DEPTH, layers)
    field = friction_stress_at(level.grid.x, level.solution.pressure, x, z[:, None])
    found = {}
    for friction in outcome.problem.scene.friction:
        stress = field.at(friction)
        for name in COMPONENTS:
            header = _header(outcome, name, friction, x, z)
            values = getattr(stress, name) / hertz.peak_pressure
            file = f"{outcome.problem.scene.name}-{name}-mu{friction:g}.txt"
            found[file] = SubsurfFile(values, header)
    return found


def _header(
    outcome: Outcome, name: str, friction: float, x: np.ndarray, z: np.ndarray
) -> dict[str, dict[str, Value]]:
    scene, hertz = outcome.problem.scene, outcome.problem.hertz
    level, info = outcome.runs["half_plane"].finest, outcome.problem.scene.profile_info
    profile: dict[str, Value] = {"title": scene.title, "file": "none: smooth"}
    if info is not None:
        profile |= {
            "file": info.source,
            "samples": info.samples,
            "spacing": info.spacing,
            "length": info.length,
            "ra": info.roughness.ra,
            "rq": info.roughness.rq,
            "rms_slope": info.roughness.rms_slope,
            "roller_position": scene.position,
        }
    return {
        "profile": profile,
        "contact": {
            "radius": hertz.radius,
            "combined_modulus": hertz.combined_modulus,
            "load_per_length": hertz.load_per_length,
            "half_width": hertz.half_width,
            "peak_pressure": hertz.peak_pressure,
            "elements": level.grid.count,
            "element_width": level.grid.pitch,
            "highest_pressure": float(level.solution.pressure.max()),
            "contact_length": level.contact_length,
            "contacts": len(level.patches),
        },
        "stress": {
            "component": f"{COMPONENTS[name]} over peak_pressure",
            "friction": friction,
            "columns": len(x),
            "layers": len(z),
            "x_first": float(x[0]),
            "x_step": float((x[-1] - x[0]) / (len(x) - 1)),
            "z_first": float(z[0]),
            "z_step": float((z[-1] - z[0]) / (len(z) - 1)),
        },
    }
