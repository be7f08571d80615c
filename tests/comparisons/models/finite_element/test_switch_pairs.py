"""Every two switches of the finite elements together: solved with finite figures, or refused."""

from itertools import combinations

import numpy as np
import pytest
from scenes import STEEL, changed, finite_elements, problem, resolved

from comparisons.common.errors import SceneError

BASE = {
    "roller": {"radius": 8e-3, "rigid": True},
    "body": dict(STEEL),
    "load": {"hertz_peak_pressure": 1.5e9, "friction": 0.2},
    "stress": {"points": [11, 5]},
    "resolution": {"pitch": "20 um"},
    "finite_element": {"block": 20, "growth": 0.5},
}
SWITCHES = {
    "rough": {"profile": {"kind": "sinusoid", "wavelength": 1.2e-4, "amplitude": 2e-7}},
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
    "coated": {"coating": {"thickness": 3e-5, "youngs_modulus": 400e9, "poissons_ratio": 0.2}},
    "layer": {"body": {"thickness": 3e-4}},
    "width": {"body": {"width": 4e-3}},
    "hard": {"body": {"hardness": 1.4e9}},
}


REFUSED = {frozenset((body, element)) for body in ("finite", "plastic") for element in ("P1", "P3")}


@pytest.mark.parametrize("pair", list(combinations(SWITCHES, 2)), ids="-".join)
def test_pair(pair):
    one, other = (SWITCHES[name] for name in pair)
    tables = changed(changed(BASE, **one), **other)
    if frozenset(pair) in REFUSED:
        with pytest.raises(SceneError, match=r"made\.toml: finite_element\.\w+: .*allowed"):
            resolved(tables)
        return
    posed = problem(tables)
    level = finite_elements(posed, fields=True)
    solution = level.solution
    assert solution.converged
    assert solution.load == pytest.approx(posed.hertz.load_per_length, rel=1e-6)
    assert 0.5 < solution.pressure.max() / posed.hertz.peak_pressure < 2.5
    arrays = [solution.pressure, solution.gap, level.displacement, level.patches]
    for stress in level.field_on_mesh.stresses.values():
        arrays += [stress.sx, stress.sz, stress.txz]
    arrays += [*level.field_on_mesh.others.values(), level.field_on_mesh.poissons_ratio]
    assert all(np.isfinite(values).all() for values in arrays)
