"""What follows from `material` in a scene, and what wins beside it."""

from scenes import STEEL, resolved

from analytic.material import Law, ThermalMaterial
from comparisons.output.plausibility import warnings_about
from comparisons.scenes.materials import solids
from comparisons.scenes.surface import surface_of

LOAD = {"per_length": 1e6}
CARBON = solids()["carbon steel"]


def scene(body, roller=None, **sections):
    return resolved(
        {"roller": {"radius": 8e-3} | (roller or STEEL), "body": body, "load": LOAD} | sections
    )


def warned(made):
    return [line for line in warnings_about(made, surface_of(made)) if "third-order" in line]


def test_moduli_and_the_measured_law_follow_from_the_name():
    made = scene({"material": "carbon steel"})
    assert made.body.material == CARBON.material
    assert made.body.material.law.standard_errors == CARBON.law.standard_errors
    assert not warned(made)


def test_another_name_of_a_solid_is_read_as_its_first():
    assert scene({"material": "Hecla 37"}).tables["body"]["material"] == "carbon steel"


def test_a_solid_without_constants_has_no_law():
    made = scene({"material": "100Cr6"}, {"material": "silicon nitride"})
    assert made.body.law is None
    assert made.body.youngs_modulus == 210e9
    assert (
        made.roller.material.youngs_modulus == solids()["silicon nitride"].material.youngs_modulus
    )
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
