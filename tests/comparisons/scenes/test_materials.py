"""Every solid of materials.toml is complete and has its sources; numbers are those of the source;
solids that a body may be like; what follows from `material` in a scene, and what wins beside it."""

import numpy as np
import pytest
from scenes import STEEL, resolved

from analytic.material import Law, Material, ThermalMaterial
from analytic.material.third_order import CONSTANTS, peak_change
from comparisons.output.plausibility import warnings_about
from comparisons.scenes.materials import (
    kinds_like,
    measured_solids,
    names_for,
    scaled_law,
    solid_named,
    solids,
    sources,
    typical_range,
)
from comparisons.scenes.surface import surface_of

RANGES = {
    "youngs_modulus": (1e6, 1e12),
    "poissons_ratio": (0.1, 0.495),
    "density": (900.0, 20000.0),
    "conductivity": (0.1, 500.0),
    "specific_heat": (200.0, 2500.0),
    "expansion": (1e-7, 3e-4),
}


def keys_of(solid):
    values = (*solid.values.values(), *solid.typical.values())
    return {
        *solid.law_sources,
        *solid.alias_sources,
        *(key for value in values for key in value.sources),
    }


@pytest.mark.parametrize("solid", solids().values(), ids=lambda solid: solid.name)
def test_every_solid_is_complete_and_has_its_sources(solid):
    assert solid.description
    assert "youngs_modulus" in solid.values
    assert "density" in solid.values
    # a law that was measured, or a word that none was found
    assert (solid.law is None) == bool(solid.missing)
    assert bool(solid.law_sources) == (solid.law is not None)
    assert keys_of(solid) <= sources().keys()
    for name, value in solid.values.items():
        low, high = RANGES[name]
        assert low <= value.value <= high, name
    for value in solid.typical.values():
        assert value.span is None or value.span[0] < value.value < value.span[1]


def test_every_source_is_used():
    used = {key for solid in solids().values() for key in keys_of(solid)}
    assert used == sources().keys()


def test_names_are_of_one_solid_each():
    names = [
        name.casefold()
        for solid in solids().values()
        for name in {solid.name.casefold(), *map(str.casefold, solid.aliases)}
    ]
    assert len(names) == len(set(names))


# What the sources print, in GPa: l, m, n, or what they give in place of them.
PRINTED = {
    "nickel steel S/NVT": {"l": -56, "m": -671, "n": -785, "errors": (20, 6, 7)},
    "rail steel": {"l": -248, "m": -623, "n": -714, "errors": (6.944, 25.543, 19.278)},
    "carbon steel": {"l": -385 / 2 - 282, "m": -282 - 2 * 177, "n": -4 * 177},
    "austenitic stainless steel": {"l": 34 / 2 - 552, "m": -552 - 2 * 100, "n": -4 * 100},
    "molybdenum": {"l": -301, "m": -852, "n": -908},  # as COMSOL rounds them: -300, -850, -910
    "tungsten": {"l": -472.5, "m": -792, "n": -1068},
    "copper": {"l": -160, "m": -620, "n": -1590},
    "iron": {"l": -170, "m": -770, "n": -1520},
    "aluminium": {"l": -143, "m": -297, "n": -345},
    "niobium": {"l": -610, "m": -220, "n": 300},
    "polystyrene": {"l": -18.9, "m": -13.3, "n": -10.0},
    "PMMA": {"l": -10.9, "m": -7.7, "n": -1.4},
}


@pytest.mark.parametrize(("name", "printed"), PRINTED.items())
def test_third_order_constants_are_those_of_the_source(name, printed):
    law = solids()[name].law
    printed = dict(printed)
    errors = printed.pop("errors", None)
    assert law.murnaghan == pytest.approx([1e9 * value for value in printed.values()], rel=1e-9)
    if errors:
        assert law.standard_errors == pytest.approx([1e9 * error for error in errors], rel=1e-9)


def test_fused_silica_has_the_signs_and_pressure_derivatives_of_other_sources():
    """Wang et al. (1992): all third-order constants but C456, the smallest, are positive. The
    derivatives are of a sphere under helium, K' = -6.0 and G' = -3.5."""
    solid = solids()["fused silica"]
    ell, m, n = solid.law.murnaghan
    names = [name for name in CONSTANTS if name.startswith("c") and name != "c456"]
    every = [float(np.dot(CONSTANTS[name], (ell, m, n))) for name in names]
    assert len(names) == 5 and min(every) > abs(0.25 * n)
    lame, shear = solid.material.lame_constants
    bulk = solid.material.bulk_modulus
    assert -2.0 * (9.0 * ell + n) / (9.0 * bulk) == pytest.approx(-6.0, rel=0.03)
    by_pressure = -(3.0 * m - n / 2.0 + 3.0 * lame + 3.0 * shear) / (3.0 * bulk)
    assert by_pressure == pytest.approx(-3.5, rel=0.08)


def test_moduli_follow_from_what_was_measured():
    steel = solids()["carbon steel"].material
    assert steel.lame_constants == pytest.approx((111e9, 82.1e9))
    carbide = solids()["tungsten carbide"].material
    assert (carbide.bulk_modulus, carbide.shear_modulus) == pytest.approx((357.5e9, 253.5e9))
    silica = solids()["fused silica"].material
    lame, shear = silica.lame_constants
    assert ((lame + 2.0 * shear) / 2200.0) ** 0.5 == pytest.approx(5930.0)
    assert (shear / 2200.0) ** 0.5 == pytest.approx(3750.0)
    assert solids()["brass"].material.poissons_ratio == pytest.approx(0.335)


@pytest.mark.parametrize(
    ("name", "others"),
    [
        ("borosilicate glass", [" PYREX "]),
        ("100Cr6", ["1.3505", "AISI 52100", "JIS SUJ2", "100CR6"]),
        ("16MnCr5", ["1.7131", "SAE 5115"]),
        ("18CrNiMo7-6", ["1.6587", "17CrNiMo6", "18 CrNiMo 7-6"]),
        ("42CrMo4", ["W.-Nr. 1.7225", "AISI/SAE 4140", "scm440"]),
        ("C45", ["1.0503", "AISI 1045", "S45C"]),
        ("ductile iron", ["EN-GJS-400-15", "EN GJS 500-7", "FCD400"]),
        ("EN-GJS-700-2", ["EN-JS1070", "GGG-70", "FCD700"]),
    ],
)
def test_a_solid_is_known_by_its_other_names_in_any_case(name, others):
    assert all(solid_named(other) is solids()[name] for other in others)


def test_no_other_steel_is_offered_for_one_that_is_not_known():
    """20MnCr5 is spelled much like 16MnCr5, and is another steel."""
    steels = ", ".join(solid.name for solid in solids().values() if solid.kind == "steel")
    for name in ("20MnCr5", "34CrNiMo6", "18CrNiMo7-7", "1.7139", "AISI 8620", "SCM435", "C46"):
        assert solid_named(name) is None
        assert names_for(name) == f"the known steels are {steels}"
    irons = "iron, grey iron, ductile iron, EN-GJS-700-2"
    assert names_for("EN-GJL-300") == f"the known irons are {irons}"
    assert names_for("unobtainium") == f"the known solids are {', '.join(solids())}"
    assert names_for("carbn steel") == 'did you mean "carbon steel"?'
    assert names_for("42CrMoS4") == 'did you mean "42CrMo4"?'


def test_a_class_has_its_own_measured_solids_or_those_of_wider_ones():
    def names(*kinds: str) -> list[str]:
        return [solid.name for solid in measured_solids(*kinds)]

    assert names("aluminium") == ["aluminium", "aluminium alloy"]
    assert len(names("steel")) == 7 and "austenitic stainless steel" in names("steel")
    assert names("titanium") == names("iron") == names("metal")  # no titanium alloy, one iron
    assert set(names("steel", "iron")) == {*names("steel"), "iron"}
    assert names("ceramic") == names() and "fused silica" in names()
    assert names("semicrystalline polymer") == ["polystyrene", "PMMA"]


def test_constants_scale_with_the_shear_modulus():
    for solid in measured_solids():
        body = Material(2.0 * solid.material.youngs_modulus, solid.material.poissons_ratio)
        scaled = scaled_law(solid, body)
        assert peak_change(scaled, body) == pytest.approx(peak_change(solid.law, solid.material))


def test_a_body_is_like_solids_of_about_its_constants():
    assert kinds_like(207e9, 0.3) == ("steel", "iron")
    assert kinds_like(70e9, 0.33) == ("aluminium",)
    assert kinds_like(71e9, 0.21) == ("glass",)
    assert kinds_like(207e9, 0.1) == ()


def test_typical_strengths_are_the_solids_or_those_of_its_class():
    low, high = typical_range("yield_stress", "carbon steel", ("steel",))
    assert (low, high) == solids()["carbon steel"].typical["yield_stress"].span
    of_class = typical_range("yield_stress", "rail steel", ("steel",))
    assert of_class[0] <= low and high <= of_class[1]
    assert typical_range("yield_stress", None, ()) is None


LOAD = {"per_length": 1e6}
CARBON = solids()["carbon steel"]


def scene(body, roller=None, **sections):
    bodies = {"roller": {"radius": 8e-3} | (roller or STEEL), "body": body}
    return resolved(bodies | {"load": LOAD} | sections)


def warned(made):
    return [line for line in warnings_about(made, surface_of(made)) if "third-order" in line]


def test_moduli_and_the_measured_law_follow_from_the_name():
    made = scene({"material": "Hecla 37"})
    assert made.tables["body"]["material"] == "carbon steel"
    assert made.body.material == CARBON.material
    assert made.body.material.law.standard_errors == CARBON.law.standard_errors
    assert not warned(made)


def test_a_solid_without_constants_has_no_law():
    made = scene({"material": "100Cr6"}, {"material": "silicon nitride"})
    assert made.body.law is None
    assert made.body.youngs_modulus == 210e9
    nitride = solids()["silicon nitride"].material
    assert made.roller.material.youngs_modulus == nitride.youngs_modulus
    assert not warned(made)


def test_a_rubber_is_neo_hookean_beside_another_modulus_too():
    made = scene({"material": "natural rubber", "youngs_modulus": "3 MPa"})
    assert (made.body.law, made.body.youngs_modulus) == ("neo-hookean", 3e6)
    assert not warned(made)


def test_measured_constants_do_not_belong_to_another_modulus():
    made = scene({"material": "carbon steel", "youngs_modulus": "207 GPa", "poissons_ratio": 0.3})
    assert made.body.law is None
    assert made.body.material.law == Law()
    assert made.body.departures == ["youngs_modulus", "poissons_ratio"]
    [warning] = warned(made)
    assert warning.startswith("body.youngs_modulus and body.poissons_ratio: carbon steel has anoth")


def test_a_figure_of_a_scene_does_not_change_by_a_name_beside_its_moduli():
    plain, named = scene(STEEL), scene({"material": "100Cr6", **STEEL})
    assert plain.body.material == named.body.material


def test_a_law_beside_the_name_wins():
    assert scene({"material": "carbon steel", "law": "hencky"}).body.material.law == Law("hencky")
    constants = {"l": -1e9, "m": -2e9, "n": -3e9}
    made = scene({"material": "carbon steel", "murnaghan": constants})
    assert made.body.material.law == Law("murnaghan", (-1e9, -2e9, -3e9))
    named = scene({"material": "carbon steel", "law": "murnaghan"})
    assert named.body.material.law == CARBON.law


def test_what_follows_is_written_out_and_read_again():
    made = scene({"material": "fused silica"}, heat=HEAT, load=LOAD | {"friction": 0.1})
    again = resolved(made.tables)
    assert again.tables == made.tables
    assert again.body.material == made.body.material


def test_another_modulus_in_a_sweep_drops_the_law():
    made = scene({"material": "carbon steel"}).changed("body.youngs_modulus", 200e9)
    assert made.body.law is None
    assert made.body.poissons_ratio == CARBON.material.poissons_ratio


def test_a_coating_takes_moduli():
    coating = {"thickness": 2e-6, "material": "DLC", "poissons_ratio": 0.2}
    assert scene(STEEL, coating=coating).coating.material.youngs_modulus == 259e9


HEAT = {"speed": 1.0, "roller_conductivity": 46.0, "roller_density": 7850.0}
HEAT |= {"roller_specific_heat": 460.0}


def test_thermal_constants_follow_where_heat_does_not_give_them():
    sliding = LOAD | {"friction": 0.1}
    made = scene({"material": "fused silica"}, heat=HEAT, load=sliding)
    assert made.heat.body == ThermalMaterial(1.4, 2200.0, 750.0)
    assert made.heat.body_expansion is None
    denser = scene({"material": "fused silica"}, heat=HEAT | {"body_density": 2201.0}, load=sliding)
    assert denser.heat.body == ThermalMaterial(1.4, 2201.0, 750.0)
    stressed = {"heat": HEAT | {"stresses": True}, "stress": {}, "load": sliding}
    assert scene({"material": "fused silica"}, **stressed).heat.body_expansion == 6.5e-7
