"""Another tolerance for every judged figure: where it is taken, and where refinement ends."""

from scenes import SMOOTH, changed, resolved, run_of

from comparisons.scenes.scene import Scene, with_tolerance


def test_it_replaces_each_that_the_scene_has():
    tightened = with_tolerance(Scene.read("smooth"), 0.005)
    judged = "peak_pressure", "contact_length", "tau1_max"
    assert tightened.tolerances == dict.fromkeys(judged, 5e-3)
    assert tightened.tables["tolerance"] == tightened.tolerances


def test_refinement_stops_where_it_is_met():
    coarse = resolved(changed(SMOOTH, resolution={"pitch": 1e-4}))
    levels = []
    for tolerance in (0.2, 2e-3):
        outcome = run_of(with_tolerance(coarse, tolerance), "half_plane")
        assert outcome.solved.refinement == "every judged quantity is resolved"
        levels.append(len(outcome.runs["half_plane"].levels))
    assert levels[0] == 3 < levels[1]
