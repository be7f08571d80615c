"""Another tolerance for every judged figure: where it is taken, and where refinement ends."""

import pytest
from scenes import SMOOTH, changed, resolved, run_of

from comparisons.cli import main
from comparisons.scenes.scene import Scene, with_tolerance


class TestTolerance:
    def test_it_replaces_each_that_the_scene_has(self):
        tightened = with_tolerance(Scene.read("smooth"), 0.005)
        assert tightened.tolerances == dict.fromkeys(
            ("peak_pressure", "contact_length", "tau1_max"), 5e-3
        )
        assert tightened.tables["tolerance"] == tightened.tolerances

    @pytest.mark.parametrize("wrong", ["0", "1", "-0.1", "nan"])
    def test_not_every_number_is_one(self, wrong, capsys):
        assert main(["run", "smooth", "--tolerance", wrong]) == 2
        assert "--tolerance: is " in capsys.readouterr().err

    def test_refinement_stops_where_it_is_met(self):
        coarse = resolved(changed(SMOOTH, resolution={"pitch": 1e-4}))
        levels = {}
        for tolerance in (0.2, 2e-3):
            outcome = run_of(with_tolerance(coarse, tolerance), "half_plane")
            assert outcome.solved.refinement == "every judged quantity is resolved"
            levels[tolerance] = len(outcome.runs["half_plane"].levels)
        assert levels[0.2] == 3 < levels[2e-3]
