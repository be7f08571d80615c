"""Repetitions: what counts as a figure that moved, and by what it is measured."""

import json

import pytest
from comparisons.output.changes import movement, stated_for

from comparisons.studies.study import Run


@pytest.fixture(scope="module")
def figures(smooth_outcome: Run) -> dict:
    """Of both models, as result.json holds them."""
    return json.loads(json.dumps(smooth_outcome.result))


class TestFigures:
    """What counts as moved, and by what it is measured."""

    def altered(self, figures, alter):
        content = json.loads(json.dumps(figures))
        alter(content)
        return movement(figures, content)

    def test_times_memory_and_texts_are_no_figures(self, figures):
        def alter(content):
            for entries in content["models"].values():
                entries[0]["cost"]["seconds"]["contact"] = 77.0
                entries[0]["cost"]["peak_memory"] = 1
                entries[0]["cost"]["unknowns"] += 1
            content["validity"]["why"] = "because"

        found = self.altered(figures, alter)
        assert found.moved == () and found.rounding == 0

    def test_rounding_is_counted_apart(self, figures):
        def alter(content):
            content["hertz"]["half_width"] *= 1.0 + 1e-12

        found = self.altered(figures, alter)
        assert (found.moved, found.rounding) == ((), 1)

    def test_what_states_nothing_may_not_move(self, figures):
        def alter(content):
            content["hertz"]["half_width"] *= 1.0 + 1e-6

        (row,) = self.altered(figures, alter).beyond
        assert (row.path, row.by) == ("hertz.half_width", "")
        assert row.change == pytest.approx(1e-6, rel=1e-6)

    def test_a_verdict_that_changed_is_a_finding(self, figures):
        def alter(content):
            content["validity"]["verdict"] = "fails"

        (row,) = self.altered(figures, alter).beyond
        assert (row.recorded, row.repeated) == ("inconclusive", "fails")

    def test_a_figure_that_went_is_a_finding_and_a_new_one_is_not(self, figures):
        def alter(content):
            del content["models"]["half_plane"][0]["contact"]["peak_pressure"]
            content["hertz"]["depth"] = 1.0

        found = self.altered(figures, alter)
        assert [row.path for row in found.beyond] == ["models.half_plane[0].contact.peak_pressure"]
        assert found.moved[0].repeated is None and found.new == 1

    def test_patches_move_by_the_length_that_they_do_not_share(self, figures):
        def alter(content):
            contact = content["models"]["finite_element"][0]["contact"]
            ((start, stop),) = contact["patches"]
            middle, gap = 0.5 * (start + stop), 0.01 * (stop - start)
            contact["patches"] = [[start, middle - gap], [middle, stop]]

        (row,) = self.altered(figures, alter).moved
        assert row.change == pytest.approx(0.01, rel=1e-9)
        assert row.by == "contact_length" and row.beyond

    def test_a_place_is_measured_by_the_half_width(self, figures):
        """Not by itself: on the axis it is rounding."""

        def alter(content):
            content["models"]["half_plane"][0]["stress"]["tau1_max_at"][0] = 1e-12

        found = self.altered(figures, alter)
        assert (found.moved, found.rounding) == ((), 1)

    @pytest.mark.parametrize(
        ("path", "of"),
        [
            (("models", "finite_element", 0, "contact", "peak_pressure"), "peak_pressure"),
            (("models", "finite_element", 0, "stress", "von_mises_max"), "tau1_max"),
            (("models", "finite_element", 0, "stress", "txz_max_abs"), "txz_max_abs"),
            (("comparison", "tau1_max", 0, "finite_element"), "tau1_max"),
        ],
    )
    def test_what_is_stated_is_that_of_the_record(self, figures, path, of):
        value = figures
        for part in path:
            value = value[part]
        total = figures["models"]["finite_element"][0]["uncertainty"][of]["total"]
        assert stated_for(path, value, figures).allowed == pytest.approx(total * value)

    def test_zone_and_bulge_by_what_they_state(self, figures):
        level = {"value": 0.4, "uncertainty": 0.01}
        stated = {
            "quiescent_zone": {"half_plane": [{"level": level}]},
            "bulge": {"by_friction": [{"height": 2e-8, "uncertainty": 3e-9, "rise": [1e-8]}]},
        }
        recorded = figures | stated
        zone = ("quiescent_zone", "half_plane", 0, "level", "value")
        assert stated_for(zone, 0.4, recorded).allowed == 0.01
        for place in (("height",), ("rise", 0)):
            found = stated_for(("bulge", "by_friction", 0, *place), 2e-8, recorded)
            assert found.allowed == 3e-9
        assert stated_for(("bulge", "by_friction", 0, "at"), 1e-4, recorded).allowed > 0.0

    def test_what_follows_from_the_pressures_moves_with_them(self, figures):
        totals = [
            each["total"]
            for model in figures["models"].values()
            for entry in model
            for each in entry["uncertainty"].values()
        ]
        for path in (("heat", "peclet", "body"), ("statistics", "theory", 0)):
            assert 0.0 < stated_for(path, 3.0, figures).allowed <= 3.0 * max(totals)

    def test_a_difference_by_its_own_uncertainty(self, figures):
        row = figures["comparison"]["tau1_max"][0]
        path = ("comparison", "tau1_max", 0, "difference")
        assert stated_for(path, row["difference"], figures).allowed == row["uncertainty"]
