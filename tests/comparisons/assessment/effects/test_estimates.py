"""Estimates are larger than the effects: on every point of the maps, and in the stresses."""

import json
from pathlib import Path

import pytest
from scenes import problem, resolved

import comparisons.studies.maps
from comparisons.assessment.effects.estimates import estimates
from comparisons.scenes.files import read_toml
from comparisons.studies.maps.groups import Origin, tables_with

FINISHED = Path(comparisons.studies.maps.__file__).parent / "finished"
MAPS = sorted(path.stem for path in FINISHED.glob("*.json"))


def test_there_are_maps():
    assert len(MAPS) >= 2


@pytest.mark.parametrize("name", MAPS)
def test_they_bound_every_point_of_a_finished_map(name):
    """What the half-plane is off by, beyond its uncertainty, is at most the sum of estimates."""
    content = json.loads((FINISHED / f"{name}.json").read_text(encoding="utf-8"))
    origin = Origin(name, FINISHED)
    base = resolved(read_toml(FINISHED / f"{name}.toml"), name, FINISHED)
    checked, tight = 0, 0.0
    for point in content["points"]:
        if point["status"] != "solved":
            continue
        groups = {content[axis]["group"]: point[axis] for axis in ("x", "y")}
        tables = tables_with(base.tables, groups, origin)
        posed = problem(tables)
        found = point["quantities"]
        peak = found["peak_pressure"]["half_plane"]
        sizes = estimates(posed, peak, peak)
        del sizes["law_of_elasticity"]  # the maps take one law
        for quantity, error in found.items():
            if error["uncertainty"] is None:
                continue
            bound = sum(effect.get(quantity, 0.0) for effect in sizes.values())
            proven = abs(error["difference"]) - error["uncertainty"]
            assert proven <= bound, (groups, quantity)
            tight = max(tight, proven / bound)
            checked += 1
    assert checked >= 4 * 60
    assert tight > 0.3  # nor are they idle: somewhere an effect is a third of its bound
