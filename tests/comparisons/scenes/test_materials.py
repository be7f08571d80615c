"""Every solid of materials.toml is complete and has its sources; numbers are those of the source;
the pairs that bound a class."""

import re

import pytest

from analytic.material import Law, Material
from analytic.material.third_order import peak_change
from comparisons.common.units import COMMON_UNITS
from comparisons.scenes.materials import (
    ELASTIC,
    SOLIDS,
    THERMAL,
    bounding_laws,
    bounding_solids,
    classes,
    scaled_law,
    solid_named,
    solids,
    sources,
)

CLASSES = {"steel": 2, "iron": 2, "aluminium": 2, "copper": 2, "titanium": 1, "hard metal": 1}
CLASSES |= {
    "ceramic": 1,
    "glass": 3,
    "glassy polymer": 2,
    "semicrystalline polymer": 3,
    "rubber": 2,
}
RANGES = {
    "youngs_modulus": (1e6, 1e12),
    "poissons_ratio": (0.1, 0.495),
    "density": (900.0, 20000.0),
    "conductivity": (0.1, 500.0),
    "specific_heat": (200.0, 2500.0),
    "expansion": (1e-7, 3e-4),
}


def values_of(solid):
    return (*solid.values.values(), *solid.typical.values())


def keys_of(solid):
    return {*solid.law_sources, *(key for value in values_of(solid) for key in value.sources)}


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


def test_every_source_is_used_and_says_where_it_was_read():
    used = {key for solid in solids().values() for key in keys_of(solid)}
    assert used == sources().keys()


def test_names_are_of_one_solid_each():
    names = [
        name.casefold()
        for solid in solids().values()
        for name in {solid.name.casefold(), *map(str.casefold, solid.aliases)}
    ]
    assert len(names) == len(set(names))


@pytest.mark.parametrize(("kind", "count"), CLASSES.items())
def test_classes_have_their_solids(kind, count):
    assert sum(solid.kind == kind for solid in solids().values()) >= count


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


def test_fused_silica_has_the_pressure_derivatives_and_c111_of_its_sources():
    solid = solids()["fused silica"]
    ell, m, n = solid.law.murnaghan
    lame, shear = solid.material.lame_constants
    bulk = solid.material.bulk_modulus
    assert 2.0 * ell + 4.0 * m == pytest.approx(467e9)
    assert -2.0 * (9.0 * ell + n) / (9.0 * bulk) == pytest.approx(-6.0)
    assert -(3.0 * m - n / 2.0 + 3.0 * lame + 3.0 * shear) / (3.0 * bulk) == pytest.approx(-3.5)


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


def test_a_solid_is_known_by_its_other_names_in_any_case():
    assert solid_named(" PYREX ") is solids()["borosilicate glass"]
    assert solid_named("52100") is solids()["100Cr6"]
    assert solid_named("unobtainium") is None


@pytest.mark.parametrize("kind", [*classes(), None])
def test_bounding_laws_are_scaled_and_in_order(kind):
    body = Material(210e9, 0.3)
    low, high = bounding_laws(kind, 210e9, 0.3)
    assert peak_change(low, body) < peak_change(high, body)
    twice = bounding_laws(kind, 420e9, 0.3)
    for law, stiffer in zip((low, high), twice, strict=True):
        assert peak_change(stiffer, Material(420e9, 0.3)) == pytest.approx(peak_change(law, body))


def test_a_class_is_bounded_by_its_own_solids_or_by_wider_ones():
    def names(kind):
        return [solid.name for solid in bounding_solids(kind, 210e9, 0.3)]

    assert names("steel") == ["nickel steel", "austenitic stainless steel"]
    assert names("aluminium") == ["aluminium", "aluminium alloy"]
    # no titanium alloy, one iron
    assert names("titanium") == names("iron") == names("metal") == ["tungsten", "aluminium alloy"]
    assert names("ceramic") == names(None) == ["fused silica", "aluminium alloy"]
    assert names("semicrystalline polymer") == ["PMMA", "polystyrene"]
    assert bounding_laws("rubber", 3e6, 0.49) == (Law("neo-hookean"), Law("hencky"))


def test_every_solid_lies_within_the_bounds_of_its_class():
    for solid in solids().values():
        if solid.has_constants:
            body = solid.material
            bounds = bounding_laws(solid.kind, body.youngs_modulus, body.poissons_ratio)
            low, high = (peak_change(law, body) for law in bounds)
            assert low <= peak_change(scaled_law(solid, body), body) <= high


def test_a_class_that_is_none_is_refused():
    with pytest.raises(ValueError, match="must be one of"):
        bounding_laws("cheese", 1e9, 0.3)


def test_thermal_and_elastic_fields_are_what_a_scene_takes():
    assert set(RANGES) == {*ELASTIC, *THERMAL}


def test_the_file_has_no_unit_that_takes_long_to_look_up():
    """pint takes ten times as long to load as a scene to read."""
    text = SOLIDS.read_text(encoding="utf-8")
    units = re.findall(r'(?:=|from|to) "[-+]?[\d.]+(?:e[-+]?\d+)? ([^" ]+)"', text)
    assert set(units) <= COMMON_UNITS.keys()
    assert len(units) > 250
