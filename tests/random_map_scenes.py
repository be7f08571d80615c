"""Random scenes of a finished map's kind, solved as its points are.

`python -m tests.random_map_scenes modulus-coating 44` adds as many, each with random groups, moduli
and radius, to tests/data/random_map_scenes.json; they hold what is said between a map's points
(tests/comparisons/campaigns/maps/test_answer.py)."""

import json
import sys
from pathlib import Path

import numpy as np

from comparisons.campaigns.grid import Point
from comparisons.campaigns.maps.groups import scene_with
from comparisons.campaigns.maps.map import finished_map
from comparisons.campaigns.maps.point import solve_point
from comparisons.scenes.scene import Origin, Scene

DATA = Path(__file__).parent / "data/random_map_scenes.json"
QUANTITIES = ("peak_pressure", "contact_length", "tau1_max")


def solved(name: str, number: int) -> dict:
    """Values (x, y) of the map's groups, and each quantity's model error and its uncertainty."""
    content, draw = finished_map(name), np.random.default_rng([number, 29])
    axes, tables = (content["x"], content["y"]), dict(content["scene"])
    ends = (np.log([axis["values"][0], axis["values"][-1]]) for axis in axes)
    at = [float(f"{np.exp(draw.uniform(*span)):.6g}") for span in ends]
    larger, stiffer = np.exp(draw.uniform(-1.0, 1.0, 2))
    for section in {"roller", "body", "coating"} & tables.keys():
        table = tables[section] = dict(tables[section])
        for key, factor in (("radius", larger), ("youngs_modulus", stiffer)):
            if key in table:
                table[key] *= factor
    values = dict(zip((axis["group"] for axis in axes), at, strict=True))
    scene = scene_with(Scene.of(tables, Origin(f"{name}-{number}")), values)
    answer = solve_point(Point(values, QUANTITIES[0], scene, None, ""))
    known = {name: answer["quantities"][name] for name in QUANTITIES}
    errors = {name: [q["difference"], q["uncertainty"]] for name, q in known.items()}
    return {"map": name, "at": at, "errors": errors}


def main(name: str, count: int) -> None:
    for number in range(count):
        known = [*json.loads(DATA.read_text()), solved(name, number)]
        rows = ",\n".join(json.dumps(row) for row in known)
        DATA.write_text(f"[\n{rows}\n]\n")


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]))
