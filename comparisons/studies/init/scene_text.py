"""A scene file with every field of a measured profile's scene in it, each explained.

What a field may hold is not repeated here: `comparisons.scenes.schema.fields.allowed` says it, as
error messages do.
"""

import json
import re
from collections.abc import Mapping
from textwrap import wrap

from comparisons.scenes.schema.fields import allowed
from comparisons.scenes.schema.scene import SECTIONS as TABLES
from comparisons.scenes.schema.scene import SceneFile

# By field: meaning, and the example that stands for it where it is not used, as TOML.
Fields = dict[str, tuple[str, str]]

TITLE = ("heading of tables and of the report", '"Ground disc against a smooth roller"')

SECTIONS: dict[str, tuple[str, Fields]] = {
    "roller": (
        "The smooth body that presses.",
        {
            "radius": ("radius of relative curvature", '"10 mm"'),
            "youngs_modulus": ("Young's modulus", '"210 GPa"'),
            "poissons_ratio": ("Poisson's ratio", "0.3"),
            "rigid": ("a roller that keeps its shape, instead of the two before", "true"),
        },
    ),
    "body": (
        "The rough body.",
        {
            "youngs_modulus": ("Young's modulus", '"210 GPa"'),
            "poissons_ratio": ("Poisson's ratio", "0.3"),
            "hardness": ("most that the contact pressure reaches", '"7 GPa"'),
            "thickness": ("of a layer on a rigid base; without it a half-plane", '"5 mm"'),
            "base": ("what the layer's base holds, with thickness", '"bonded"'),
            "width": ("between free sides; without it unbounded", '"40 mm"'),
            "yield_stress": ("in tension, with finite_element.plastic", '"1 GPa"'),
            "hardening_modulus": ("stress a plastic strain, with yield_stress", '"10 GPa"'),
        },
    ),
    "profile": (
        "The measured surface.",
        {
            "file": ("where it is", '"trace.csv"'),
            "x_unit": ("of the positions in the file, where it does not say", '"um"'),
            "z_unit": ("of the heights in the file, where it does not say", '"um"'),
            "spacing": ("of the samples, where the file holds heights alone", '"0.5 um"'),
            "row": ("of an areal map, counted from 0", "0"),
            "column": ("of an areal map instead, counted from 0", "0"),
            "line": (
                "across an areal map instead, from one point to another",
                '[["0 um", "10 um"], ["500 um", "10 um"]]',
            ),
            "form": ("what is taken off before the surface is pressed", '"line"'),
            "dropouts": ("samples that were lost: an error, or on a line between", '"bridge"'),
            "cutoff": ("longer waves are taken off (Gaussian filter, ISO 16610-21)", '"auto"'),
            "short_cutoff": ("shorter waves are taken off", '"2.5 um"'),
        },
    ),
    "load": (
        "What presses the roller on: one of the first three.",
        {
            "hertz_peak_pressure": ("peak pressure that smooth bodies would have", '"1 GPa"'),
            "per_length": ("load", '"3.85 N/um"'),
            "approach": ("of a rigid roller to a layer", '"2 um"'),
            "friction": ("coefficient; sliding pulls the body towards +x", "[0.0, 0.1]"),
            "position": ("of the roller on the trace; without it the middle", '"1118 um"'),
            "coupled": ("sliding traction moves the surfaces", "true"),
        },
    ),
    "stress": (
        "The field below the surface; without this section there is none.",
        {
            "depth": ("down to", "1.0"),
            "half_range": ("to both sides of the roller's centre", "1.5"),
            "points": ("of the field", "[300, 100]"),
        },
    ),
    "tolerance": (
        "What the models are judged by: a difference, relative. Others are shown.",
        {
            "peak_pressure": ("largest pressure", "0.02"),
            "contact_length": ("sum of the patches that touch", "0.02"),
            "tau1_max": ("largest principal shear stress", "0.02"),
            "contact_ratio": ("contact length over that of smooth bodies", "0.02"),
            "pressure_l2": ("the whole curve of pressure", "0.02"),
            "tau1_max_depth": ("where the largest principal shear stress is", "0.05"),
            "txz_max_abs": ("largest orthogonal shear stress", "0.02"),
            "tau1_field_near": ("the whole field next to the surface", "0.05"),
            "tau1_field_deep": ("the whole field deeper down", "0.02"),
        },
    ),
    "coating": (
        "A layer bonded to the body, in the finite elements.",
        {
            "thickness": ("of the coating", '"2 um"'),
            "youngs_modulus": ("Young's modulus", '"400 GPa"'),
            "poissons_ratio": ("Poisson's ratio", "0.22"),
        },
    ),
    "running_in": (
        "The surface is run in before it is pressed: what flows is taken off.",
        {
            "hardness": ("pressure at which asperities flow", '"7 GPa"'),
            "stroke": ("of the roller about its own place", '"0.1 mm"'),
            "passes": ("places along the stroke", "9"),
            "positions": ("places on the trace, instead of stroke", '["600 um", "700 um"]'),
            "sweeps": ("over all places, at most", "10"),
            "load": ("while it is run in; without it that of the scene", '"3.85 N/um"'),
        },
    ),
    "finite_element": (
        "Which of the half-plane's assumptions the finite elements keep.",
        {
            "geometry": ("the roughness as part of the gap, or as rough boundary", '"rough"'),
            "gap": ("measured before loading, or on the deformed surface", '"displaced"'),
            "roller_shape": ("shape of the roller", '"circle"'),
            "roller_body": ("of an elastic roller", '"disc"'),
            "coupled": ("sliding traction moves the surfaces", "true"),
            "deformation": ("small, or finite under a rigid roller", '"finite"'),
            "plastic": ("the body yields, with body.yield_stress", "true"),
            "element": ("degree of the displacements", '"P2"'),
            "far_field": ("outer boundary of an unbounded body", '"held"'),
            "block": ("width and depth that stand for unbounded, in half-widths", "400"),
            "growth": ("of elements with the distance from the contact", "0.2"),
        },
    ),
    "resolution": (
        "How fine; by default as the surface asks for.",
        {
            "pitch": ("of the coarsest pressure elements", '"2 um"'),
            "levels": ("of refinement that are always solved", "3"),
        },
    ),
    "budget": (
        "What a run may take before refinement ends.",
        {
            "time": ("of both models", '"300 s"'),
            "memory": ("of the finite elements", '"8 GB"'),
            "effects": ("compute what the half-plane does not model, where it may matter", "true"),
        },
    ),
}


WIDTH = 96
NO_BREAK = "\N{NO-BREAK SPACE}"
HEAD = """\
# A scene for crosscheck, as TOML. Numbers are in SI; text has a unit: "8.2 mm", "207 GPa".
# Lines that start with "#" and a blank explain the line below them; those that start with "#"
# alone are fields that are not used: take the sign away to use them.
"""

Values = Mapping[str, Mapping[str, str]]


def scene_text(title: str, values: Values, notes: Values) -> str:
    """The text of a scene file.

    values  by section and field: what it is set to, as TOML; other fields stand there unused
    notes   by section and field: a remark
    """
    heading = f"{TITLE[0]}; allowed is {allowed(SceneFile, 'title')}"
    lines = [HEAD, *_comment(heading), f"title = {toml(title)}"]
    for section, (words, fields) in SECTIONS.items():
        used = values.get(section, {})
        lines += ["", *_comment(words), f"{'' if used else '#'}[{section}]"]
        for name, (meaning, example) in fields.items():
            said = f"{meaning}; allowed is {allowed(TABLES[section], name)}"
            note = notes.get(section, {}).get(name)
            lines += _comment(f"{said} ({note})" if note else said)
            lines.append(f"{name} = {used[name]}" if name in used else f"#{name} = {example}")
    return "\n".join(lines) + "\n"


def toml(text: str) -> str:
    """A text as TOML writes it."""
    return json.dumps(text, ensure_ascii=False)


def _comment(text: str) -> list[str]:
    """Lines that explain; text in quotes stays on one line."""
    whole = re.sub(r'"[^"]*"', lambda quoted: quoted[0].replace(" ", NO_BREAK), text)
    lines = wrap(whole, WIDTH, break_long_words=False, break_on_hyphens=False)
    return [f"# {line}".replace(NO_BREAK, " ") for line in lines]
