"""Flow at finite strains through a scene: a light load is that of small strains."""

import numpy as np
import pytest
from scenes import STEEL, changed, finite_elements, problem

LIGHT = {
    "roller": {"radius": 0.8, "rigid": True},
    "body": {**STEEL, "yield_stress": 1e8, "law": "hencky"},
    "load": {"hertz_peak_pressure": 2.4e8, "friction": 0.1},
    "resolution": {"elements": 4, "levels": 2},
    "stress": {"points": [20, 10]},
}


COATING = {"thickness": 1e-3, "youngs_modulus": 300e9, "poissons_ratio": 0.25, "law": "hencky"}


def level_of(deformation, coating):
    settings = {"plastic": True, "deformation": deformation}
    scene = LIGHT | ({"coating": coating} if coating else {})
    return finite_elements(problem(changed(scene, finite_element=settings)), fields=True)


@pytest.mark.parametrize("coating", [None, COATING], ids=["bare", "coated"])
def test_at_light_loads_finite_strains_are_small(coating):
    small, finite = (level_of(deformation, coating) for deformation in ("linear", "finite"))
    assert small.plastic_strain == pytest.approx(finite.plastic_strain, rel=0.02) != 0.0
    assert finite.contact_length == pytest.approx(small.contact_length, rel=2e-3)
    peaks = [level.solution.pressure.max() for level in (small, finite)]
    assert peaks[1] == pytest.approx(peaks[0], rel=2e-3)
    largest = [level.stress.extremes["tau1"].value for level in (small, finite)]
    assert np.isfinite([level.stress.maxima["txz"] for level in (small, finite)]).all()
    assert largest[1] == pytest.approx(largest[0], rel=5e-3)
    assert finite.mesh_field.others["residual_von_mises"].max() > 1e6
    assert finite.material is not None and small.material is None


@pytest.mark.parametrize("deformation", ["linear", "finite"])
def test_no_shear_is_larger_than_the_metal_bears(deformation):
    """Without hardening that is Y/sqrt 3; over J, where Kirchhoff's stress flows."""
    posed = problem(
        {
            "roller": {"radius": 8e-3, "rigid": True},
            "body": {**STEEL, "yield_stress": 340e6},
            "load": {"hertz_peak_pressure": 1.3e9, "friction": 0.2},
            "stress": {"points": [120, 40]},
            "finite_element": {"plastic": True, "deformation": deformation},
            "resolution": {"pitch": "20 um"},
        }
    )
    level = finite_elements(posed, fields=True)
    bulk = posed.scene.body.material.bulk_modulus
    compressed = level.solution.pressure.max() / bulk if deformation == "finite" else 0.0
    stress = level.stress
    for name, most in (("tau1", 340e6 / 3**0.5), ("txz", 340e6 / 3**0.5), ("von_mises", 340e6)):
        assert abs(stress.extremes[name].value) <= most * np.exp(compressed) * (1.0 + 1e-12)
    assert stress.extremes["tau1"].value == pytest.approx(340e6 / 3**0.5, rel=0.01)
