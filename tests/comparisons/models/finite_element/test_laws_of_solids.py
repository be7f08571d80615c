"""The change of peak pressure and length by a law of elasticity, as `peak_change` has it, against
full solutions at finite deformation under a rigid roller."""

from functools import cache

import pytest
from scenes import finite_elements, problem

from analytic.material import Law, Material
from analytic.material.third_order import LENGTH_OVER_PEAK, peak_change
from comparisons.scenes.materials import solids

RATIO = 0.05  # half-width over radius


@cache
def pressed(material: Material) -> tuple[float, float]:
    """Peak pressure [Pa] and contact length [m]."""
    body = {"youngs_modulus": material.youngs_modulus, "poissons_ratio": material.poissons_ratio}
    body["law"] = material.law.name
    if material.law.murnaghan is not None:
        body["murnaghan"] = dict(zip("lmn", material.law.murnaghan, strict=True))
    tables = {
        "roller": {"radius": 5e-3, "rigid": True},
        "body": body,
        "load": {"hertz_peak_pressure": 0.5 * RATIO * material.plane_strain_modulus},
        "finite_element": {"deformation": "finite"},
    }
    posed = problem(tables)
    level = finite_elements(posed)
    return float(level.solution.pressure.max()), level.contact_length


def changes(material: Material) -> tuple[float, float]:
    """Of peak pressure and length from the neo-Hookean law, over p0/E."""
    neo_hookean = Material(material.youngs_modulus, material.poissons_ratio, Law())
    strain = 0.5 * RATIO * material.plane_strain_modulus / material.youngs_modulus
    pairs = zip(pressed(material), pressed(neo_hookean), strict=True)
    return tuple((value / plain - 1.0) / strain for value, plain in pairs)


@pytest.mark.parametrize(
    "name", ["carbon steel", "aluminium alloy", "tungsten", "niobium", "fused silica", "PMMA"]
)
def test_measured_laws_change_a_contact_as_their_constants_say(name):
    """Of first order in the load; what is left is of the next order, 3 % of strain here."""
    material = solids()[name].material
    expected = peak_change(material.law, material)
    peak, length = changes(material)
    assert peak == pytest.approx(expected, rel=0.2, abs=0.1)
    assert length == pytest.approx(LENGTH_OVER_PEAK * peak, rel=0.3, abs=0.1)


@pytest.mark.parametrize("law", [Law("hencky"), Law("st-venant-kirchhoff")])
@pytest.mark.parametrize("poissons_ratio", [0.1, 0.3, 0.45])
def test_other_laws_too(law, poissons_ratio):
    material = Material(2e9, poissons_ratio, law)
    peak, _ = changes(material)
    assert peak == pytest.approx(peak_change(law, material), rel=0.04)


def test_the_third_constant_has_no_part_in_plane_strain():
    material = solids()["carbon steel"].material
    ell, m, _ = material.law.murnaghan
    without = Material(
        material.youngs_modulus, material.poissons_ratio, Law("murnaghan", (ell, m, 0.0))
    )
    assert pressed(without) == pressed(material)
