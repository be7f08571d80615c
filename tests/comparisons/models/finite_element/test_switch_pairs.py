"""Every two switches of the finite elements together: solved with finite figures, or refused."""

from itertools import combinations
from pathlib import Path

import numpy as np
import pytest

from comparisons.common.errors import SceneError
from comparisons.common.progress import Stages
from comparisons.models.finite_element.level import finite_element_level
from comparisons.models.finite_element.mesh import Refinement
from comparisons.models.plan import make_plan
from comparisons.models.problem import problem_of
from comparisons.models.window import window_of
from comparisons.scenes.resolve import resolve_tables

STEEL = {"youngs_modulus": 210e9, "poissons_ratio": 0.3}
BASE = {
    "roller": {"radius": 8e-3, "rigid": True},
    "body": dict(STEEL),
    "load": {"hertz_peak_pressure": 1.5e9, "friction": 0.2},
    "stress": {"points": [11, 5]},
    "resolution": {"pitch": "20 um"},
    "finite_element": {"block": 20, "growth": 0.5},
}
SWITCHES = {
    "rough": {
        "profile": {"kind": "sinusoid", "wavelength": 1.2e-4, "amplitude": 2e-7},
        "finite_element": {"geometry": "rough"},
    },
    "displaced": {"finite_element": {"gap": "displaced"}},
    "circle": {"finite_element": {"roller_shape": "circle"}},
    "elastic": {"roller": {"rigid": False, "youngs_modulus": 300e9, "poissons_ratio": 0.25}},
    "disc": {
        "roller": {"rigid": False, "youngs_modulus": 300e9, "poissons_ratio": 0.25},
        "finite_element": {"roller_body": "disc"},
    },
    "coupled": {"finite_element": {"coupled": True}},
    "finite": {"finite_element": {"deformation": "finite", "coupled": True}},
    "plastic": {
        "body": {"yield_stress": 0.8e9},
        "finite_element": {"plastic": True, "coupled": True},
    },
    "P1": {"finite_element": {"element": "P1"}},
    "P3": {"finite_element": {"element": "P3"}},
    "far": {"finite_element": {"far_field": "half-plane"}},
    "coated": {"coating": {"thickness": 3e-5, "youngs_modulus": 400e9, "poissons_ratio": 0.2}},
    "layer": {"body": {"thickness": 3e-4}},
    "width": {"body": {"width": 4e-3}},
    "hard": {"body": {"hardness": 1.4e9}},
}


def merged(*changes: dict) -> dict:
    tables = {name: dict(fields) for name, fields in BASE.items()}
    for change in changes:
        for name, fields in change.items():
            tables[name] = {**tables.get(name, {}), **fields}
    return tables


REFUSED = {
    frozenset(pair)
    for pair in [
        ("elastic", "finite"),
        ("disc", "finite"),
        ("finite", "plastic"),
        ("finite", "coated"),
        ("finite", "far"),
        ("finite", "hard"),
        ("finite", "P1"),
        ("finite", "P3"),
        ("plastic", "P1"),
        ("plastic", "P3"),
        ("plastic", "far"),
        ("plastic", "coated"),
        ("far", "coated"),
        ("far", "layer"),
        ("far", "width"),
    ]
}


@pytest.mark.parametrize("pair", list(combinations(SWITCHES, 2)), ids="-".join)
def test_pair(pair):
    tables = merged(*(SWITCHES[name] for name in pair))
    if frozenset(pair) in REFUSED:
        with pytest.raises(SceneError, match=r"made\.toml: finite_element\.\w+: .*allowed"):
            resolve_tables(tables, name="made", folder=Path("."), source="made.toml")
        return
    problem = problem_of(resolve_tables(tables, name="made", folder=Path("."), source="made.toml"))
    plan, window = make_plan(problem, ("finite_element",)), window_of(problem)
    refinement = Refinement(problem.pitches[0])
    level = finite_element_level(problem, plan, refinement, window, Stages())
    solution = level.solution
    assert solution.converged
    assert solution.load == pytest.approx(problem.hertz.load_per_length, rel=1e-6)
    assert 0.5 < solution.pressure.max() / problem.hertz.peak_pressure < 2.5
    found = [solution.pressure, solution.gap, level.displacement, level.patches]
    for stress in level.mesh_field.stresses.values():
        found += [stress.sx, stress.sz, stress.txz]
    found += [*level.mesh_field.others.values(), level.mesh_field.poissons_ratio]
    assert all(np.isfinite(values).all() for values in found)
