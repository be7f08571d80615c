"""The scenes of the check, their solution by these finite elements, and what is kept of it.

Nobody has tuned the project on them: pieces of the shipped traces, positions and loads taken
at once. `values.json` holds their figures, from meshes down to 1/16 um under the asperities,
and of `ground-unrun` with friction, down to 1/4 um.
"""

import json
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from comparisons.scenes.scene import Scene
from comparisons.scenes.surface import surface_of
from tests.finite_strain_check.figures import ContactFigures, figures
from tests.finite_strain_check.solve import Task, solutions
from tests.scenes import PROFILES

VALUES = Path(__file__).parent / "values.json"
# Young's modulus [GPa] and Poisson's ratio of the body; one under a rigid roller is of steel.
BODIES = {"rigid": (210, 0.3), "steel": (210, 0.3), "aluminium": (70, 0.33), "ceramic": (310, 0.27)}
SIZES = np.array([8.0, 4.0, 2.0, 1.0])  # of elements, over the finest
FINEST, WIDE = 0.0625, 300.0  # um; from that half-width on elements are four times as large
REACH = 2.0  # half-widths of the smooth contact within which the coarsest mesh is fine
# How figures are called in result.json, and their names and units here. The project's length at
# finite deformation is that of the deformed surface.
QUANTITIES = {
    "peak_pressure": ("peak", 1e9),
    "contact_length": ("deformed_length", 1e-6),
    "undeformed_contact_length": ("length", 1e-6),
    "tau1_max": ("tau1", 1e9),
    "txz_max_abs": ("txz", 1e9),
}


def scene(
    trace: str, body: str, friction: float, position: int, radius: float, load: float
) -> dict[str, object]:
    """Tables of a scene on a ground trace at a position [um]: radius [mm], load [N/um]."""

    def elastic(modulus: int, ratio: float) -> dict[str, object]:
        fields = {"youngs_modulus": f"{modulus} GPa", "poissons_ratio": ratio}
        return fields | {"law": "neo-hookean"}

    rigid, of_body = body == "rigid", elastic(*BODIES[body])
    of_roller = {"rigid": True} if rigid else elastic(*BODIES["steel"])
    roller, on = "rigid roller" if rigid else "roller of 210 GPa", of_body["youngs_modulus"]
    file = PROFILES / f"ground_{trace.replace('-', '_')}.csv"
    place = f"{trace.capitalize()} surface at {position} um"
    return {
        "title": f"{place}, {roller} on {on}, friction {friction}",
        "roller": {"radius": f"{radius} mm"} | of_roller,
        "body": of_body,
        "profile": {"file": str(file), "x_unit": "um", "z_unit": "um", "form": "none"},
        "load": {"per_length": f"{load} N/um", "friction": friction, "position": f"{position} um"},
        "stress": {"depth": 0.5, "half_range": 1.5, "points": [400, 100]},
        # as the independent elements, though such bodies flow at such stresses
        "finite_element": {"plastic": False},
    }


SCENES = {
    "ground-unrun-sliding": scene("unrun", "steel", 0.1, 1118, 7.5706, 3.55)
    | {
        "title": "The scene ground-unrun with friction 0.1: unrun ground surface (computed "
        "stand-in) against a smooth roller",
        "stress": {"depth": 1.0, "half_range": 1.5, "points": [600, 100]},
    },
    "polished-ceramic-sliding": scene("polished", "ceramic", 0.1, 1900, 8, 0.15),
    "polished-rigid": scene("polished", "rigid", 0, 700, 8, 0.1),
    "polished-rigid-sliding": scene("polished", "rigid", 0.1, 1400, 8, 0.1),
    "run-in-aluminium": scene("run-in", "aluminium", 0, 1700, 6, 0.1),
    "run-in-rigid-sliding": scene("run-in", "rigid", 0.1, 500, 6, 0.2),
    "run-in-steel-sliding": scene("run-in", "steel", 0.1, 1100, 6, 0.15),
    "unrun-aluminium-sliding": scene("unrun", "aluminium", 0.1, 900, 5, 0.06),
    "unrun-rigid": scene("unrun", "rigid", 0, 1300, 5, 0.1),
    "unrun-rigid-sliding": scene("unrun", "rigid", 0.1, 1330, 5, 0.2),
    "unrun-steel": scene("unrun", "steel", 0, 600, 4, 0.12),
    "unrun-steel-sliding": scene("unrun", "steel", 0.1, 1500, 4, 0.12),
}


def task_of(scene: Scene, friction: float, law: str | tuple[float, float] = "neo-hookean") -> Task:
    """The scene's trace, bodies and load per length."""

    def constants(material) -> tuple[float, float]:
        return material.youngs_modulus / 1e9, material.poissons_ratio

    surface = surface_of(scene)
    return Task(
        x=surface.profile.x * 1e6,
        height=surface.profile.height * 1e6,
        body=constants(scene.body.material),
        roller=scene.roller.material and constants(scene.roller.material),
        radius=scene.roller.radius * 1e6,
        load=scene.load.value / 1e3,
        friction=friction,
        law=law,
    )


def levels_of(task: Task) -> np.ndarray:
    """Sizes [um] of the elements that touch, coarse to fine."""
    return SIZES * FINEST * (4.0 if task.half_width > WIDE else 1.0)


def solved(
    task: Task, levels: Sequence[float], log: Callable[[str], None] = lambda text: None
) -> list[ContactFigures]:
    """Figures on every mesh, coarse to fine."""
    return [figures(*end) for end in solutions(task, levels, REACH * task.half_width, log)]


def kept(by_level: list[ContactFigures], levels: Sequence[float]) -> dict:
    """Values for `values.json`, SI units: the finest mesh's figures, and as uncertainties what
    the last refinement by two changed; all meshes; the largest tau1 of each asperity in contact."""
    fine, coarse = by_level[-1], by_level[-2]

    def figure(name: str, unit: float) -> dict[str, float]:
        value = getattr(fine, name)
        return {"value": value * unit, "uncertainty": abs(value - getattr(coarse, name)) * unit}

    values = {key: figure(*terms) for key, terms in QUANTITIES.items()}
    for key, name in (("peak_pressure", "peak"), ("tau1_max", "tau1"), ("txz_max_abs", "txz")):
        places = (getattr(fine, f"{name}_{axis}", 0.0) * 1e-6 for axis in ("x", "depth"))
        values[key]["x"], values[key]["depth"] = places
    meshes = [
        {"element": size * 1e-6} | {q: getattr(f, n) * unit for q, (n, unit) in QUANTITIES.items()}
        for size, f in zip(levels, by_level, strict=True)
    ]
    names = ("start", "end", "peak_pressure", "tau1_max", "x", "depth")
    units = np.array([1e-6, 1e-6, 1e9, 1e9, 1e-6, 1e-6])
    patches = [dict(zip(names, (units * patch).tolist(), strict=True)) for patch in fine.patches]
    return {"figures": values, "meshes": meshes, "patches": patches}


def read_values() -> dict[str, dict]:
    """Values by scene, as `kept` made them."""
    return json.loads(VALUES.read_text())


def write_values(values: dict[str, dict]) -> None:
    """The whole file, with seven digits."""

    def rounded(value):
        if isinstance(value, dict):
            return {name: rounded(item) for name, item in value.items()}
        return [rounded(v) for v in value] if isinstance(value, list) else float(f"{value:.7g}")

    scenes = (f'"{name}": {json.dumps(rounded(scene))}' for name, scene in sorted(values.items()))
    VALUES.write_text("{\n" + ",\n".join(scenes) + "\n}\n")
